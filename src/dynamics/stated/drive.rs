//! Motions of drives as a scene states them.

use super::curve::Curve;
use super::law::StatedLaw;
use super::local::Local;
use super::plan::StatedPlan;
use crate::kinematics::motion::{DriveMotion, DriveMotionSpec};
use crate::math::expression::{Expression, OPEN, Third};

/// The motion of a drive in the terms of the scene.
#[derive(Clone, Debug)]
pub(crate) enum StatedDrive {
    /// By a formula of its own.
    Formula(Box<Formula>),
    /// A motion that is supplied in code: it is its own statement.
    Own(DriveMotion),
    /// It is not checked, and why.
    Unknown(&'static str),
}

/// The formulas.
#[derive(Clone, Debug)]
pub(crate) struct Formula(Form);

#[derive(Clone, Debug)]
enum Form {
    /// φ₀ + ω·t + ε·t²/2.
    Accelerated([f64; 3]),
    RunUp {
        law: Option<StatedLaw>,
        speed: f64,
        time: f64,
        angle: f64,
    },
    Plan(StatedPlan),
    Written {
        expression: Expression,
        factor: f64,
    },
    Curve(Curve),
}

impl StatedDrive {
    /// What a scene says of the motion of a drive.
    pub(crate) fn new(spec: &DriveMotionSpec) -> Self {
        let form = match spec {
            DriveMotionSpec::Constant { speed, angle } => Form::Accelerated([*angle, *speed, 0.0]),
            DriveMotionSpec::Accelerated {
                acceleration,
                speed,
                angle,
            } => Form::Accelerated([*angle, *speed, *acceleration]),
            DriveMotionSpec::RunUp {
                speed,
                time,
                angle,
                law,
            } => {
                let law = match law.as_ref().map(StatedLaw::run_up) {
                    None => None,
                    Some(Some(law)) => Some(law),
                    Some(None) => return Self::Unknown("its conditions are too many"),
                };
                Form::RunUp {
                    law,
                    speed: *speed,
                    time: *time,
                    angle: *angle,
                }
            }
            DriveMotionSpec::Plan(plan) => match StatedPlan::new(plan) {
                Some(plan) => Form::Plan(plan),
                None => return Self::Unknown("the smooth motions of its plan are too many"),
            },
            DriveMotionSpec::Written { expression, factor } => Form::Written {
                expression: expression.clone(),
                factor: *factor,
            },
            DriveMotionSpec::Table { points } => Form::Curve(Curve::through(points)),
        };
        Self::Formula(Box::new(Formula(form)))
    }

    /// φ with its derivatives by the time; `None` where it is not known.
    pub(crate) fn at(&self, time: f64) -> Option<Local> {
        match self {
            Self::Formula(formula) => Some(formula.0.at(time)),
            Self::Own(motion) => {
                let jet = motion.jet(motion.breaks().segment_at(time, 1.0), time);
                Some(Local::new(jet.value, jet.first, jet.second))
            }
            Self::Unknown(_) => None,
        }
    }
}

impl Form {
    fn at(&self, time: f64) -> Local {
        let t = Local::variable(time);
        match self {
            Self::Accelerated([angle, speed, acceleration]) => {
                t.scale(*speed).shift(*angle) + (t * t).scale(0.5 * acceleration)
            }
            Self::RunUp {
                law,
                speed,
                time: duration,
                angle,
            } => {
                // The angle that the full speed would make in the time, by the share of it.
                let share = match law {
                    None => 0.5,
                    Some(law) => 1.0 / law.at(1.0).first,
                };
                let way = speed * duration * share;
                if time <= 0.0 {
                    return Local::new(*angle, 0.0, 0.0);
                }
                if time >= *duration {
                    return Local::new(angle + way + speed * (time - duration), *speed, 0.0);
                }
                let x = t.scale(1.0 / duration);
                let unit = match law {
                    // θ = 2·τ³ − τ⁴: θ′ = 6·τ² − 4·τ³.
                    None => (x * x * x).scale(2.0) - x * x * x * x,
                    Some(law) => law.at(time / duration).faster(1.0 / duration),
                };
                unit.scale(way).shift(*angle)
            }
            Self::Plan(plan) => plan.at(time),
            Self::Written { expression, factor } => {
                evaluate_expression(expression, time).scale(*factor)
            }
            Self::Curve(curve) => curve.at(time),
        }
    }
}

/// An expression of time, evaluated as it stands: every condition is looked at anew.
fn evaluate_expression(expression: &Expression, time: f64) -> Local {
    let at = Third::variable(time);
    let jet = expression.program().value.evaluate(&[at], &|_| OPEN).0;
    Local::new(jet.value, jet.first, jet.second)
}

#[cfg(test)]
mod tests {
    use super::StatedDrive;
    use crate::kinematics::motion::{DriveMotion, DriveMotionSpec, RunLawName};
    use crate::math::expression::Expression;

    #[test]
    fn motions_are_those_that_runs_are_computed_with() {
        let written = |text: &str| DriveMotionSpec::Written {
            expression: Expression::new(text, &["t"]).unwrap(),
            factor: 0.7,
        };
        let run_up = |law: Option<RunLawName>| DriveMotionSpec::RunUp {
            speed: -20.0,
            time: 0.5,
            angle: 0.4,
            law: law.map(Into::into),
        };
        for spec in [
            DriveMotionSpec::Constant {
                speed: -7.0,
                angle: 0.3,
            },
            DriveMotionSpec::Accelerated {
                acceleration: -3.0,
                speed: 2.0,
                angle: 0.5,
            },
            run_up(None),
            run_up(Some(RunLawName::UnequalTrapezoid)),
            DriveMotionSpec::Table {
                points: vec![(0.0, 0.0), (0.2, 1.0), (0.5, 1.5), (0.6, 3.0), (1.0, 2.0)],
            },
            written("0.3*sin(20*t) + (t < 0.4 ? 0 : (t - 0.4)^3)"),
            written("max(0, sin(2*pi*t))^3"),
        ] {
            let (own, other) = (StatedDrive::new(&spec), DriveMotion::new(&spec).unwrap());
            for k in 0..60 {
                let time = 0.0137 + 0.02 * f64::from(k);
                let own = own.at(time).unwrap();
                let other = other.jet(other.breaks().segment_at(time, 1.0), time);
                approx::assert_abs_diff_eq!(own.value, other.value, epsilon = 1e-12);
                approx::assert_abs_diff_eq!(own.first, other.first, epsilon = 1e-11);
                approx::assert_abs_diff_eq!(own.second, other.second, epsilon = 1e-9);
            }
        }
    }
}
