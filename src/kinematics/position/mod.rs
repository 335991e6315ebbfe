//! Position functions U(φ): where the driver asks the driven object to be.
//!
//! A position function is pure. It gives U with its geometric transfer
//! functions U′, U″ and U‴ at any driver displacement φ it can reach, says
//! where it changes its formula ([`Breaks`]) and which interval of φ it
//! reaches. The system evaluates [`Position`], a closed set for speed, with one
//! open variant.
//!
//! The functions `slider_crank`, `four_bar` and `slotted_link` are massless short forms of
//! linkages (`short_form`) and take their closure from there. `function`, `spec` and the
//! functions themselves are imported by their own files, since this module knows linkages.

mod assembly_range;
pub(crate) mod cam;
mod four_bar;
mod function;
mod interpolated;
mod linkage;
mod short_form;
pub(crate) mod sine;
mod slider_crank;
mod slotted_link;
pub(crate) mod spec;
pub(crate) mod table;
#[cfg(test)]
mod tests;

pub use crate::kinematics::motion::{Cycle, CycleSpec, LawName, LawSpec};
pub use assembly_range::OutOfReach;
pub use cam::Cam;
pub use four_bar::FourBar;
pub use function::PositionFunction;
pub use interpolated::ChebyshevInterpolation;
pub use linkage::LinkageOutput;
pub(crate) use linkage::reach as linkage_reach;
pub use slider_crank::SliderCrank;
pub use slotted_link::SlottedLink;
pub use spec::{
    CamSpec, CustomPosition, PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput,
};
pub use table::Table;

use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::math::fourier::{Terms, TermsOnInterval};
use crate::math::jet::Jet;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A position function, ready to be evaluated.
#[derive(Clone, Debug)]
pub enum Position {
    /// U = ratio·φ + offset.
    Ratio {
        /// U′: dimensionless, metres per radian or radians per metre.
        ratio: f64,
        /// U at φ = 0.
        offset: f64,
    },
    /// U = amplitude·sin(harmonic·φ + phase) + offset.
    Sine {
        /// Half the full stroke (rad or m).
        amplitude: f64,
        /// Oscillations per turn of the driver.
        harmonic: f64,
        /// Phase at φ = 0 (rad).
        phase: f64,
        /// Middle of the stroke (rad or m).
        offset: f64,
    },
    /// U = Σ a_k·φᵏ, coefficients in SI, lowest power first.
    Polynomial(Vec<f64>),
    /// A spline through points.
    Table(Table),
    /// A slider-crank.
    SliderCrank(SliderCrank),
    /// A four-bar linkage.
    FourBar(FourBar),
    /// A slotted link.
    SlottedLink(SlottedLink),
    /// A cam.
    Cam(Cam),
    /// A plan of motion: any number of rises, dwells and returns.
    Plan(Box<Cycle>),
    /// An output of a linkage, over its input coordinate.
    Linkage(LinkageOutput),
    /// Anything else.
    Custom(Arc<dyn PositionFunction>),
}

impl Position {
    /// The position function that a scene describes.
    ///
    /// # Errors
    /// Everything wrong with its numbers, paths relative to `position`
    /// (`slider_crank.rod`, `table.points[3]`).
    pub fn new(spec: &PositionSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        match *spec {
            PositionSpec::Ratio { ratio, offset } => {
                faults.finite("ratio.ratio", ratio);
                faults.finite("ratio.offset", offset);
                faults.check()?;
                Ok(Self::Ratio { ratio, offset })
            }
            PositionSpec::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } => {
                faults.finite("sine.amplitude", amplitude);
                faults.finite("sine.harmonic", harmonic);
                faults.finite("sine.phase", phase);
                faults.finite("sine.offset", offset);
                faults.check()?;
                Ok(Self::Sine {
                    amplitude,
                    harmonic,
                    phase,
                    offset,
                })
            }
            PositionSpec::Polynomial { ref coefficients } => polynomial(coefficients),
            PositionSpec::Table {
                ref points,
                periodic,
                end_slopes,
            } => Table::new(points, periodic, end_slopes).map(Self::Table),
            PositionSpec::SliderCrank {
                crank,
                rod,
                offset,
                branch,
                phase,
            } => SliderCrank::new(crank, rod, offset, branch, phase).map(Self::SliderCrank),
            PositionSpec::FourBar {
                crank,
                coupler,
                rocker,
                frame,
                branch,
                phase,
            } => FourBar::new([crank, coupler, rocker, frame], branch, phase).map(Self::FourBar),
            PositionSpec::SlottedLink(ref spec) => SlottedLink::new(spec).map(Self::SlottedLink),
            PositionSpec::Cam(ref cam) => Cam::new(cam).map(Self::Cam),
            PositionSpec::Custom(ref custom) => Ok(Self::Custom(custom.0.clone())),
            PositionSpec::Plan(ref spec) => match Cycle::new(spec) {
                Ok(cycle) => Ok(Self::Plan(Box::new(cycle))),
                Err(found) => {
                    faults.absorb("plan", found);
                    faults.check()?;
                    Err(Vec::new())
                }
            },
        }
    }

    /// Ratio and offset of U = ratio·φ + offset; `None`: it is another function.
    pub fn constant_ratio(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Ratio { ratio, offset } => Some([ratio, offset]),
            Self::Sine { .. }
            | Self::Polynomial(_)
            | Self::Table(_)
            | Self::SliderCrank(_)
            | Self::FourBar(_)
            | Self::SlottedLink(_)
            | Self::Cam(_)
            | Self::Plan(_)
            | Self::Linkage(_)
            | Self::Custom(_) => None,
        }
    }

    /// Slope of a straight line, and its value at zero; `None`: it is none.
    pub(crate) fn straight_line(&self) -> Option<[f64; 2]> {
        match self {
            Self::Ratio { ratio, offset } => Some([*ratio, *offset]),
            Self::Polynomial(own) if own.len() <= 2 => {
                let coefficient = |power: usize| own.get(power).copied().unwrap_or(0.0);
                Some([coefficient(1), coefficient(0)])
            }
            Self::Polynomial(_)
            | Self::Sine { .. }
            | Self::Table(_)
            | Self::SliderCrank(_)
            | Self::FourBar(_)
            | Self::SlottedLink(_)
            | Self::Cam(_)
            | Self::Plan(_)
            | Self::Linkage(_)
            | Self::Custom(_) => None,
        }
    }

    /// Oscillations in a turn.
    pub(crate) fn lobes(&self) -> f64 {
        match self {
            Self::Sine { harmonic, .. } => harmonic.abs(),
            Self::Ratio { .. }
            | Self::Polynomial(_)
            | Self::Table(_)
            | Self::SliderCrank(_)
            | Self::FourBar(_)
            | Self::SlottedLink(_)
            | Self::Cam(_)
            | Self::Plan(_)
            | Self::Linkage(_)
            | Self::Custom(_) => 1.0,
        }
    }

    /// Period of U over its argument and its advance in it; `None`: it repeats nowhere, or is
    /// straight.
    pub(crate) fn period(&self) -> Option<(f64, f64)> {
        match self {
            Self::Sine { harmonic, .. } => (*harmonic != 0.0).then(|| (TAU / harmonic.abs(), 0.0)),
            Self::SliderCrank(_) | Self::Cam(_) => Some((TAU, 0.0)),
            Self::FourBar(linkage) => {
                let turn = linkage.jet(TAU).value - linkage.jet(0.0).value;
                turn.is_finite().then(|| (TAU, TAU * (turn / TAU).round()))
            }
            Self::SlottedLink(linkage) => linkage.gain_in_turn().map(|advance| (TAU, advance)),
            Self::Plan(plan) => {
                let spec = plan.spec();
                spec.period.map(|period| (period, spec.advance))
            }
            Self::Linkage(output) => output.period(),
            Self::Table(table) => {
                let (first, last) = table.ends();
                table.is_periodic().then_some((last - first, 0.0))
            }
            Self::Ratio { .. } | Self::Polynomial(_) | Self::Custom(_) => None,
        }
    }

    /// U over one period of its argument in closed form, piece by piece; `None`: it repeats
    /// nowhere, or it has no closed form.
    pub(crate) fn closed_form(&self) -> Option<Vec<TermsOnInterval>> {
        match self {
            Self::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } => {
                let half = 0.5 * self.period()?.0;
                let place = [0.0, half];
                let terms = Terms::constant(*offset);
                Some(vec![TermsOnInterval {
                    middle: 0.0,
                    half,
                    terms: terms.plus_sine([*amplitude, *harmonic, *phase], place),
                }])
            }
            Self::Cam(cam) => Some(cam.closed_form()),
            Self::Plan(plan) => plan.closed_form(),
            Self::Table(table) => table.closed_form(),
            Self::Ratio { .. }
            | Self::Polynomial(_)
            | Self::SliderCrank(_)
            | Self::FourBar(_)
            | Self::SlottedLink(_)
            | Self::Linkage(_)
            | Self::Custom(_) => None,
        }
    }

    /// U and its first three derivatives at `phi`, by the formula of `segment`.
    ///
    /// Not numbers where a linkage cannot be assembled ([`Self::reach_from`]).
    // The two shortest formulas stand in the caller's loop: a call would cost
    // as much as they do.
    #[inline(always)]
    pub fn jet(&self, segment: i64, phi: f64) -> Jet {
        match self {
            Self::Ratio { ratio, offset } => Jet {
                value: ratio * phi + offset,
                first: *ratio,
                ..Jet::default()
            },
            Self::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } => sine::jet([*amplitude, *harmonic, *phase, *offset], phi),
            _ => self.longer_jet(segment, phi),
        }
    }

    /// [`Self::jet`] of all but the shortest formulas.
    #[inline(never)]
    fn longer_jet(&self, segment: i64, phi: f64) -> Jet {
        match self {
            Self::Ratio { .. } | Self::Sine { .. } => self.jet(segment, phi),
            Self::Polynomial(coefficients) => horner(coefficients, phi),
            Self::Table(table) => table.jet(segment, phi),
            Self::SliderCrank(linkage) => linkage.jet(phi),
            Self::FourBar(linkage) => linkage.jet(phi),
            Self::SlottedLink(linkage) => linkage.jet(phi),
            Self::Cam(cam) => cam.jet(segment, phi),
            Self::Plan(cycle) => cycle.jet(segment, phi),
            Self::Linkage(output) => output.jet(phi),
            Self::Custom(function) => function.jet(segment, phi),
        }
    }

    /// Breaks: where the formula changes.
    pub fn breaks(&self) -> Breaks {
        match self {
            Self::Table(table) => table.breaks().clone(),
            Self::Cam(cam) => cam.breaks().clone(),
            Self::Plan(cycle) => cycle.breaks().clone(),
            Self::Custom(function) => function.breaks(),
            Self::Ratio { .. }
            | Self::Sine { .. }
            | Self::Polynomial(_)
            | Self::SliderCrank(_)
            | Self::FourBar(_)
            | Self::SlottedLink(_)
            | Self::Linkage(_) => Breaks::NONE,
        }
    }

    /// The open interval of φ around `phi` in which the function exists;
    /// `None`: everywhere. At its ends the linkage is in a dead-centre position.
    ///
    /// # Errors
    /// The function has no value at `phi` (or `phi` is exactly a dead-centre position).
    pub fn reach_from(&self, phi: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        match self {
            Self::SliderCrank(linkage) => linkage.reach_from(phi),
            Self::FourBar(linkage) => linkage.reach_from(phi),
            Self::Linkage(output) => output.reach_from(phi),
            Self::SlottedLink(linkage) => linkage.reach_from(phi),
            Self::Custom(function) => match function.reach() {
                Some(interval) if !(interval.0 < phi && phi < interval.1) => Err(OutOfReach {
                    intervals: vec![interval],
                }),
                reach => Ok(reach),
            },
            Self::Ratio { .. }
            | Self::Sine { .. }
            | Self::Polynomial(_)
            | Self::Table(_)
            | Self::Cam(_)
            | Self::Plan(_) => Ok(None),
        }
    }
}

fn polynomial(coefficients: &[f64]) -> Result<Position, Vec<Fault>> {
    let mut faults = Faults::default();
    if coefficients.is_empty() {
        let hint = "give at least one, lowest power first";
        faults.add("polynomial.coefficients", "there are no coefficients", hint);
    }
    for (power, &coefficient) in coefficients.iter().enumerate() {
        faults.finite(&format!("polynomial.coefficients[{power}]"), coefficient);
    }
    faults.check()?;
    Ok(Position::Polynomial(coefficients.to_vec()))
}

/// A polynomial and its derivatives by repeated synthetic division.
fn horner(coefficients: &[f64], phi: f64) -> Jet {
    let [mut value, mut first, mut second, mut third] = [0.0f64; 4];
    for coefficient in coefficients.iter().rev() {
        third = third * phi + second;
        second = second * phi + first;
        first = first * phi + value;
        value = value * phi + coefficient;
    }
    Jet {
        value,
        first,
        second: 2.0 * second,
        third: 6.0 * third,
    }
}

/// A reach found in the crank's angle θ = φ + phase, in φ.
fn shifted(
    reach: Result<Option<(f64, f64)>, OutOfReach>,
    phase: f64,
) -> Result<Option<(f64, f64)>, OutOfReach> {
    let shift = |(from, to): (f64, f64)| (from - phase, to - phase);
    match reach {
        Ok(interval) => Ok(interval.map(shift)),
        Err(OutOfReach { intervals }) => Err(OutOfReach {
            intervals: intervals.into_iter().map(shift).collect(),
        }),
    }
}

impl Faults {
    /// Requires the length of a link: squares of lengths must stay numbers.
    fn length(&mut self, path: &str, length: f64) {
        if !(1e-9..=1e9).contains(&length) {
            let message = format!("{length} m is no length of a link");
            self.add(path, message, "give a length between 1 nm and 1e9 m");
        }
    }

    /// Requires the branch of a linkage: +1 or −1.
    fn branch(&mut self, path: &str, branch: f64) {
        if branch != 1.0 && branch != -1.0 {
            let message = format!("{branch} names no branch");
            self.add(path, message, "give + or -");
        }
    }
}
