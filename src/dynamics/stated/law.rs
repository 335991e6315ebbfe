//! Dimensionless laws of motion as a scene states them.

use super::curve::{Curve, Sum};
use super::local::Local;
use crate::kinematics::motion::law::PolynomialSpec;
use crate::kinematics::motion::{LawName, LawSpec, RunLawSpec};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};

/// A law of a stroke from rest to rest, or of a run-up.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum StatedLaw {
    Harmonic,
    Cycloidal,
    Polynomial345,
    Polynomial4567,
    Polynomial(Sum),
    Curve(Curve),
    Trapezoid([f64; 2]),
    Sections(Box<Sections>),
}

/// Run-up, uniform motion and run-out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sections {
    up: StatedLaw,
    out: StatedLaw,
    skewness: f64,
    uniform: f64,
}

impl StatedLaw {
    /// A law of a stroke; `None` where its conditions do not determine it.
    pub(crate) fn stroke(spec: &LawSpec) -> Option<Self> {
        Some(match spec {
            LawSpec::Named(name) => Self::named(*name),
            LawSpec::Scca { b, d } => Self::mirrored(*b, *d, 0.0),
            LawSpec::Sections(sections) => Self::Sections(Box::new(Sections {
                up: Self::run_up(&sections.run_up)?,
                out: Self::run_up(&sections.run_out)?,
                skewness: sections.skewness,
                uniform: sections.uniform,
            })),
            LawSpec::Polynomial(spec) => polynomial(spec)?,
            LawSpec::Table(points) => Self::Curve(Curve::clamped(points, (0.0, 0.0))),
        })
    }

    /// A law of a run-up.
    pub(crate) fn run_up(spec: &RunLawSpec) -> Option<Self> {
        Some(match spec {
            RunLawSpec::Trapezoid { s1, s2 } => Self::Trapezoid([*s1, *s2]),
            RunLawSpec::Polynomial(spec) => polynomial(spec)?,
            RunLawSpec::Table(points) => {
                let [_, (_, _, slope)] = Curve::through(points).ends();
                Self::Curve(Curve::clamped(points, (0.0, slope)))
            }
        })
    }

    fn named(name: LawName) -> Self {
        match name {
            LawName::Harmonic => Self::Harmonic,
            LawName::Cycloidal => Self::Cycloidal,
            LawName::Polynomial345 => Self::Polynomial345,
            LawName::Polynomial4567 => Self::Polynomial4567,
            LawName::Parabolic => Self::mirrored(0.0, 0.0, 0.0),
            LawName::ModifiedTrapezoid => Self::mirrored(0.25, 0.25, 0.0),
            LawName::ModifiedSine => Self::mirrored(0.25, 0.75, 0.0),
            LawName::ModifiedConstantVelocity => Self::mirrored(0.25, 0.75, 0.5),
        }
    }

    fn mirrored(b: f64, d: f64, uniform: f64) -> Self {
        Self::Sections(Box::new(Sections {
            up: Self::Trapezoid([b, d]),
            out: Self::Trapezoid([b, d]),
            skewness: 1.0,
            uniform,
        }))
    }

    /// θ and its derivatives at 0 ≤ τ ≤ 1.
    pub(crate) fn at(&self, tau: f64) -> Local {
        let t = Local::variable(tau);
        match self {
            Self::Harmonic => (-t.scale(PI).cos()).shift(1.0).scale(0.5),
            Self::Cycloidal => t - t.scale(TAU).sin().scale(1.0 / TAU),
            Self::Polynomial345 => {
                let cube = t * t * t;
                cube.scale(10.0) - (cube * t).scale(15.0) + (cube * t * t).scale(6.0)
            }
            Self::Polynomial4567 => {
                let fourth = t * t * t * t;
                fourth.scale(35.0) - (fourth * t).scale(84.0) + (fourth * t * t).scale(70.0)
                    - (fourth * t * t * t).scale(20.0)
            }
            Self::Polynomial(sum) => sum.at(tau),
            Self::Curve(curve) => curve.at(tau),
            Self::Trapezoid(shares) => {
                let whole = trapezoid(*shares, 1.0).value;
                trapezoid(*shares, tau).scale(1.0 / whole)
            }
            Self::Sections(sections) => sections.at(tau),
        }
    }
}

impl Sections {
    fn at(&self, tau: f64) -> Local {
        let rise = (1.0 - self.uniform) / (1.0 + self.skewness);
        let fall = rise * self.skewness;
        let [up, out] = [&self.up, &self.out].map(|law| law.at(1.0).first);
        let speed = 1.0 / (rise / up + self.uniform + fall / out);
        let (before, behind) = (speed * rise / up, speed * fall / out);
        if tau < rise {
            return self.up.at(tau / rise).scale(before).faster(1.0 / rise);
        }
        if tau <= 1.0 - fall {
            return Local::new(before + speed * (tau - rise), speed, 0.0);
        }
        let back = self.out.at((1.0 - tau) / fall).scale(behind);
        (-back.faster(-1.0 / fall)).shift(1.0)
    }
}

fn polynomial(spec: &PolynomialSpec) -> Option<StatedLaw> {
    let sum = Sum::polynomial_with_derivatives(&spec.start, &spec.end, &spec.through)?;
    Some(StatedLaw::Polynomial(sum))
}

/// Both integrals of an acceleration that rises from 0 to 1 as a quarter sine over the share
/// s1, stays, and falls as a quarter cosine over the share s2.
fn trapezoid([s1, s2]: [f64; 2], tau: f64) -> Local {
    let (p, q) = (s1 * FRAC_2_PI, s2 * FRAC_2_PI);
    if tau < s1 {
        let x = tau / s1 * FRAC_PI_2;
        return Local::new(p * (tau - p * x.sin()), p * (1.0 - x.cos()), x.sin());
    }
    let flat = |y: f64| Local::new(p * (s1 - p) + p * y + 0.5 * y * y, p + y, 1.0);
    if tau <= 1.0 - s2 {
        return flat(tau - s1);
    }
    let (end, y) = (flat(1.0 - s2 - s1), tau - (1.0 - s2));
    let x = y / s2 * FRAC_PI_2;
    Local::new(
        end.value + end.first * y + q * q * (1.0 - x.cos()),
        end.first + q * x.sin(),
        x.cos(),
    )
}

#[cfg(test)]
mod tests {
    use super::StatedLaw;
    use crate::kinematics::motion::law::SectionsSpec;
    use crate::kinematics::motion::{Law, LawName, LawSpec, RunLawName, RunLawSpec};

    fn agree(own: &StatedLaw, other: &Law) {
        for k in 0..50 {
            let tau = (f64::from(k) + 0.37) / 50.0;
            let (own, other) = (own.at(tau), other.at(tau));
            approx::assert_abs_diff_eq!(own.value, other.value, epsilon = 1e-12);
            approx::assert_abs_diff_eq!(own.first, other.first, epsilon = 1e-11);
            approx::assert_abs_diff_eq!(own.second, other.second, epsilon = 1e-9);
        }
    }

    #[test]
    fn laws_are_those_that_runs_are_computed_with() {
        let mut strokes: Vec<LawSpec> = LawName::ALL.into_iter().map(LawSpec::from).collect();
        strokes.push(LawSpec::Scca { b: 0.3, d: 0.5 });
        strokes.push(LawSpec::Sections(SectionsSpec {
            run_up: RunLawName::UnequalTrapezoid.into(),
            run_out: RunLawSpec::Trapezoid { s1: 0.1, s2: 0.7 },
            skewness: 1.7,
            uniform: 0.2,
        }));
        strokes.push(LawSpec::Table(vec![
            (0.0, 0.0),
            (0.3, 0.2),
            (0.6, 0.7),
            (1.0, 1.0),
        ]));
        for spec in strokes {
            agree(
                &StatedLaw::stroke(&spec).unwrap(),
                &Law::of_stroke(&spec).unwrap(),
            );
        }
        let mut runs: Vec<RunLawSpec> = RunLawName::ALL.into_iter().map(RunLawSpec::from).collect();
        runs.push(RunLawSpec::Table(vec![(0.0, 0.0), (0.5, 0.2), (1.0, 1.0)]));
        for spec in runs {
            agree(
                &StatedLaw::run_up(&spec).unwrap(),
                &Law::of_run_up(&spec).unwrap(),
            );
        }
    }
}
