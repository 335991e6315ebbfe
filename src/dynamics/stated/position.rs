//! Position functions as a scene states them.

use super::curve::Curve;
use super::law::StatedLaw;
use super::local::{Local, differentiate};
use super::plan::StatedPlan;
use crate::kinematics::position::{
    Position, PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput,
};
use std::f64::consts::TAU;

/// Share of a radian or of a metre over which a function without a formula is differenced.
const REACH: f64 = 0.02;

/// A position function in the terms of the scene.
#[derive(Clone, Debug)]
pub(crate) enum StatedPosition {
    /// By a formula of its own.
    Formula(Formula),
    /// A function of which nothing but values is known: an output of a linkage, or one that
    /// is supplied in code. Its derivatives are differences of these.
    Values(Position),
    /// It is not checked, and why.
    Unknown(&'static str),
}

/// The formulas.
#[derive(Clone, Debug)]
pub(crate) struct Formula(Form);

#[derive(Clone, Debug)]
enum Form {
    Polynomial(Vec<f64>),
    /// Amplitude, harmonic, phase, offset.
    Sine([f64; 4]),
    Curve(Curve),
    SliderCrank {
        crank: f64,
        rod: f64,
        offset: f64,
        branch: f64,
        phase: f64,
    },
    /// Crank, coupler, rocker, frame.
    FourBar {
        lengths: [f64; 4],
        branch: f64,
        phase: f64,
    },
    SlottedLink(SlottedLinkSpec),
    Cam(Box<Cam>),
    Plan(Box<StatedPlan>),
}

#[derive(Clone, Debug)]
struct Cam {
    lift: f64,
    /// Rise, dwell, return.
    angles: [f64; 3],
    laws: [StatedLaw; 2],
    phase: f64,
}

impl StatedPosition {
    /// What a scene says of a position function.
    pub(crate) fn new(spec: &PositionSpec) -> Self {
        let form = match spec {
            PositionSpec::Ratio { ratio, offset } => Form::Polynomial(vec![*offset, *ratio]),
            PositionSpec::Polynomial { coefficients } => Form::Polynomial(coefficients.clone()),
            PositionSpec::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } => Form::Sine([*amplitude, *harmonic, *phase, *offset]),
            PositionSpec::Table {
                points,
                periodic: true,
                ..
            } => Form::Curve(Curve::periodic(points)),
            PositionSpec::Table {
                points, end_slopes, ..
            } => Form::Curve(Curve::clamped(points, *end_slopes)),
            PositionSpec::SliderCrank {
                crank,
                rod,
                offset,
                branch,
                phase,
            } => Form::SliderCrank {
                crank: *crank,
                rod: *rod,
                offset: *offset,
                branch: *branch,
                phase: *phase,
            },
            PositionSpec::FourBar {
                crank,
                coupler,
                rocker,
                frame,
                branch,
                phase,
            } => Form::FourBar {
                lengths: [*crank, *coupler, *rocker, *frame],
                branch: *branch,
                phase: *phase,
            },
            PositionSpec::SlottedLink(spec) => Form::SlottedLink(*spec),
            PositionSpec::Cam(cam) => {
                let laws = [&cam.rise_law, &cam.return_law].map(StatedLaw::stroke);
                let [Some(rise), Some(back)] = laws else {
                    return Self::Unknown("the conditions of its polynomial are too many");
                };
                Form::Cam(Box::new(Cam {
                    lift: cam.lift,
                    angles: [cam.rise, cam.dwell, cam.return_angle],
                    laws: [rise, back],
                    phase: cam.phase,
                }))
            }
            PositionSpec::Plan(plan) => match StatedPlan::new(plan) {
                Some(plan) => Form::Plan(Box::new(plan)),
                None => return Self::Unknown("the smooth motions of its plan are too many"),
            },
            PositionSpec::Custom(custom) => {
                return Self::Values(Position::Custom(custom.0.clone()));
            }
        };
        Self::Formula(Formula(form))
    }

    /// A position function that no text states: its formula where that is plain, else its
    /// values.
    pub(crate) fn of_unstated_position(position: &Position) -> Self {
        match position {
            Position::Ratio { ratio, offset } => {
                Self::Formula(Formula(Form::Polynomial(vec![*offset, *ratio])))
            }
            Position::Sine { .. }
            | Position::Polynomial(_)
            | Position::Table(_)
            | Position::SliderCrank(_)
            | Position::FourBar(_)
            | Position::SlottedLink(_)
            | Position::Cam(_)
            | Position::Plan(_)
            | Position::Linkage(_)
            | Position::Custom(_) => Self::Values(position.clone()),
        }
    }

    /// U with its derivatives by φ, and by how much these are unsure; `None` where it is not
    /// known.
    pub(crate) fn at(&self, phi: f64) -> Option<(Local, [f64; 2])> {
        match self {
            Self::Formula(formula) => Some((formula.0.at(phi), [0.0; 2])),
            Self::Values(position) => {
                let value = |phi| {
                    position
                        .jet(position.breaks().segment_at(phi, 1.0), phi)
                        .value
                };
                Some(differentiate(value, phi, REACH))
            }
            Self::Unknown(_) => None,
        }
    }

    /// What is left out of its value: whole turns of a linkage.
    pub(crate) fn whole_turn(&self) -> Option<f64> {
        match self {
            Self::Formula(Formula(Form::FourBar { .. } | Form::SlottedLink(_))) => Some(TAU),
            Self::Formula(_) | Self::Values(_) | Self::Unknown(_) => None,
        }
    }
}

impl Form {
    fn at(&self, phi: f64) -> Local {
        let x = Local::variable(phi);
        match self {
            Self::Polynomial(coefficients) => {
                let mut sum = Local::default();
                for (power, factor) in coefficients.iter().enumerate() {
                    let k = power as f64;
                    let power_of = |less: f64| if k < less { 0.0 } else { phi.powf(k - less) };
                    sum = sum
                        + Local::new(
                            power_of(0.0),
                            k * power_of(1.0),
                            k * (k - 1.0) * power_of(2.0),
                        )
                        .scale(*factor);
                }
                sum
            }
            Self::Sine([amplitude, harmonic, phase, offset]) => {
                let angle = x.scale(*harmonic).shift(*phase);
                angle.sin().scale(*amplitude).shift(*offset)
            }
            Self::Curve(curve) => curve.at(phi),
            Self::SliderCrank {
                crank,
                rod,
                offset,
                branch,
                phase,
            } => {
                let theta = x.shift(*phase);
                let across = theta.sin().scale(*crank).shift(-offset);
                let along = (-(across * across)).shift(rod * rod).sqrt();
                theta.cos().scale(*crank) + along.scale(*branch)
            }
            Self::FourBar {
                lengths,
                branch,
                phase,
            } => four_bar(*lengths, *branch, x.shift(*phase)),
            Self::SlottedLink(spec) => slotted_link(spec, x.shift(spec.phase)),
            Self::Cam(cam) => cam.at(phi),
            Self::Plan(plan) => plan.at(phi),
        }
    }
}

impl Cam {
    fn at(&self, phi: f64) -> Local {
        let theta = (phi + self.phase).rem_euclid(TAU);
        let [rise, dwell, back] = self.angles;
        let end = rise + dwell + back;
        let unit = if theta < rise {
            self.laws[0].at(theta / rise).faster(1.0 / rise)
        } else if theta < rise + dwell {
            Local::new(1.0, 0.0, 0.0)
        } else if theta < end {
            self.laws[1].at((end - theta) / back).faster(-1.0 / back)
        } else {
            Local::default()
        };
        unit.scale(self.lift)
    }
}

/// Angle of the rocker, but for whole turns: that of the line from its pivot to the crank's
/// end, and by the law of cosines the angle between them.
fn four_bar([a, b, c, d]: [f64; 4], branch: f64, theta: Local) -> Local {
    let (x, y) = (theta.cos().scale(a).shift(-d), theta.sin().scale(a));
    let square = x * x + y * y;
    let distance = square.sqrt();
    let cosine = square.shift(c * c - b * b) * distance.scale(2.0 * c).inverse();
    Local::angle(x, y) - cosine.acos().scale(branch)
}

/// Angles, but for whole turns, and distances of a slotted link.
fn slotted_link(spec: &SlottedLinkSpec, input: Local) -> Local {
    let (l, d) = (spec.crank, spec.frame);
    match (spec.driver, spec.output) {
        (SlottedDriver::Crank, output) => {
            let (x, y) = (input.cos().scale(l).shift(d), input.sin().scale(l));
            match output {
                SlottedOutput::Link => Local::angle(x, y),
                SlottedOutput::Block => (x * x + y * y).sqrt(),
                SlottedOutput::Crank => input,
            }
        }
        (SlottedDriver::Block, output) => {
            let crank = (input * input)
                .shift(-d * d - l * l)
                .scale(0.5 / (d * l))
                .acos();
            // The crank turns counterclockwise as the block moves away: from −π to 0.
            let crank = crank.scale(-spec.branch);
            match output {
                SlottedOutput::Link => {
                    Local::angle(crank.cos().scale(l).shift(d), crank.sin().scale(l))
                }
                SlottedOutput::Crank => crank,
                SlottedOutput::Block => input,
            }
        }
    }
}

/// A value moved by whole turns to where it is nearest to another one.
pub(crate) fn nearest_by_turns(value: f64, turn: f64, other: f64) -> f64 {
    value + turn * ((other - value) / turn).round()
}

#[cfg(test)]
mod tests {
    use super::{StatedPosition, TAU, nearest_by_turns};
    use crate::kinematics::motion::LawName;
    use crate::kinematics::position::{
        CamSpec, Position, PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput,
    };

    fn agree(spec: &PositionSpec, places: impl Fn(f64) -> f64) {
        let (own, other) = (StatedPosition::new(spec), Position::new(spec).unwrap());
        for k in -40..40 {
            let phi = places(0.0131 + 0.25 * f64::from(k));
            let (mut own_there, _) = own.at(phi).unwrap();
            let other = other.jet(other.breaks().segment_at(phi, 1.0), phi);
            if let Some(turn) = own.whole_turn() {
                own_there.value = nearest_by_turns(own_there.value, turn, other.value);
            }
            let scale = 1.0 + other.second.abs();
            approx::assert_abs_diff_eq!(own_there.value, other.value, epsilon = 1e-12);
            approx::assert_abs_diff_eq!(own_there.first, other.first, epsilon = 1e-11 * scale);
            approx::assert_abs_diff_eq!(own_there.second, other.second, epsilon = 1e-9 * scale);
        }
    }

    #[test]
    fn position_functions_are_those_that_runs_are_computed_with() {
        let points = vec![(0.0, 0.1), (1.0, 0.4), (2.5, 0.0), (TAU, 0.1)];
        for periodic in [true, false] {
            let table = PositionSpec::Table {
                points: points.clone(),
                periodic,
                end_slopes: (0.2, -0.1),
            };
            agree(&table, |x| x);
        }
        let plain = [
            PositionSpec::Ratio {
                ratio: -0.4,
                offset: 2.0,
            },
            PositionSpec::Sine {
                amplitude: 0.3,
                harmonic: 3.0,
                phase: 0.4,
                offset: 1.0,
            },
            PositionSpec::Polynomial {
                coefficients: vec![1.0, -0.5, 0.25, 0.01],
            },
            PositionSpec::Cam(CamSpec {
                lift: 0.02,
                rise: 2.0,
                dwell: 0.7,
                return_angle: 1.6,
                rise_law: LawName::ModifiedTrapezoid.into(),
                return_law: LawName::Polynomial4567.into(),
                phase: 0.7,
            }),
        ];
        plain.iter().for_each(|spec| agree(spec, |x| x));
        for branch in [1.0, -1.0] {
            let crank = PositionSpec::SliderCrank {
                crank: 0.1,
                rod: 0.3,
                offset: 0.04,
                branch,
                phase: 0.3,
            };
            agree(&crank, |x| x);
            for lengths in [[0.1, 0.3, 0.25, 0.32], [0.3, 0.25, 0.28, 0.1]] {
                let [crank, coupler, rocker, frame] = lengths;
                let linkage = PositionSpec::FourBar {
                    crank,
                    coupler,
                    rocker,
                    frame,
                    branch,
                    phase: 0.2,
                };
                agree(&linkage, |x| x);
            }
            for (driver, output) in [
                (SlottedDriver::Crank, SlottedOutput::Link),
                (SlottedDriver::Crank, SlottedOutput::Block),
                (SlottedDriver::Block, SlottedOutput::Link),
                (SlottedDriver::Block, SlottedOutput::Crank),
            ] {
                for frame in [0.3, 0.06] {
                    let spec = PositionSpec::SlottedLink(SlottedLinkSpec {
                        crank: 0.1,
                        frame,
                        driver,
                        output,
                        branch,
                        phase: 0.01,
                    });
                    match driver {
                        SlottedDriver::Crank => agree(&spec, |x| x),
                        // Within its travel.
                        SlottedDriver::Block => agree(&spec, |x| {
                            let near = f64::abs(frame - 0.1) + 0.01;
                            near + (frame + 0.1 - 0.01 - near) * (0.5 + 0.4 * x.sin()) - 0.01
                        }),
                    }
                }
            }
        }
    }
}
