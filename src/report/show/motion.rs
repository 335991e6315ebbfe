//! Prescribed motions of drives as formulas.

use super::position::plan_words;
use super::units;
use crate::dynamics::model::Coordinate;
use crate::kinematics::motion::DriveMotion;
use crate::report::math::{Expr, Index, Relation, symbol};
use crate::report::quantity::{significant, with_unit};

/// φ(t) of a prescribed drive as a formula.
pub fn formula(motion: &DriveMotion, coordinate: Coordinate) -> Expr {
    let time = || symbol("t", Index::None);
    let turns = coordinate == Coordinate::Turning;
    let amount = |value: f64| match turns {
        true => Expr::Angle(value),
        false => Expr::Number(value),
    };
    match motion {
        DriveMotion::Constant { speed: 0.0, angle } => amount(*angle),
        DriveMotion::Constant { speed, angle } => {
            Expr::sum(vec![amount(*speed).times(time()), amount(*angle)])
        }
        DriveMotion::Accelerated {
            acceleration,
            speed,
            angle,
        } => {
            let square = amount(0.5 * acceleration).times(time().expr().squared());
            Expr::sum(vec![square, amount(*speed).times(time()), amount(*angle)])
        }
        DriveMotion::RunUp {
            speed,
            time: duration,
            angle,
        } => {
            // ∫ω(3τ² − 2τ³)dt = ω·T·(τ³ − τ⁴/2), and ω·(t − T/2) after that.
            let tau = || time().expr().over(Expr::Number(*duration));
            let power = |exponent| Expr::Power(Box::new(tau()), exponent);
            let shape = power(3).minus(power(4).over(Expr::Number(2.0)));
            let start = |moved: Expr| Expr::sum(vec![moved, amount(*angle)]);
            let early = amount(speed * duration).times(shape);
            let late = time().expr().minus(Expr::Number(duration / 2.0));
            Expr::Cases(vec![
                (
                    start(early),
                    time()
                        .expr()
                        .compare(Relation::Less, Expr::Number(*duration)),
                ),
                (
                    start(amount(*speed).times(late)),
                    Expr::Words("after that".into()),
                ),
            ])
        }
        DriveMotion::Plan(plan) => Expr::Words(plan_words(plan)),
        DriveMotion::LawRunUp(run_up) => Expr::Words(format!(
            "run-up from {} to {} in {} s by the law: {}",
            with_unit(run_up.angle, units(coordinate).displacement, 6),
            with_unit(run_up.speed, units(coordinate).speed, 6),
            significant(run_up.time, 6),
            run_up.spec.words()
        )),
        DriveMotion::Written(written) => {
            let text = written.text().to_owned();
            match written.factor() {
                1.0 => Expr::Words(text),
                factor => Expr::Number(factor).times(Expr::Words(format!("({text})"))),
            }
        }
        DriveMotion::Table(spline) => {
            let (from, to) = spline.ends();
            Expr::Words(format!(
                "smooth spline through a table from t = {} s to {} s",
                significant(from, 6),
                significant(to, 6)
            ))
        }
    }
}

/// A prescribed motion in a few words, for the box of the drive.
pub fn summary(motion: &DriveMotion, coordinate: Coordinate) -> String {
    let speed_words = |speed: f64| match coordinate {
        Coordinate::Turning => with_unit(speed, "rad/s", 4),
        Coordinate::Sliding => with_unit(speed, "m/s", 4),
    };
    let acceleration_words = |acceleration: f64| match coordinate {
        Coordinate::Turning => with_unit(acceleration, "rad/s²", 4),
        Coordinate::Sliding => with_unit(acceleration, "m/s²", 4),
    };
    match motion {
        DriveMotion::Constant { speed: 0.0, .. } => "held".into(),
        DriveMotion::Constant { speed, .. } => speed_words(*speed),
        DriveMotion::Accelerated { acceleration, .. } => acceleration_words(*acceleration),
        DriveMotion::RunUp { speed, time, .. } => {
            format!("to {} in {}", speed_words(*speed), with_unit(*time, "s", 4))
        }
        DriveMotion::Plan(plan) => format!("plan of {} stations", plan.spec().stations.len()),
        DriveMotion::LawRunUp(run_up) => format!(
            "to {} in {}",
            speed_words(run_up.speed),
            with_unit(run_up.time, "s", 4)
        ),
        DriveMotion::Table(_) => "table over time".into(),
        DriveMotion::Written(written) => written.text().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::formula;
    use crate::dynamics::model::Coordinate;
    use crate::kinematics::motion::DriveMotion;
    use crate::report::math::Expr;

    #[test]
    fn a_run_up_is_written_in_both_parts() {
        let motion = DriveMotion::RunUp {
            speed: 10.0,
            time: 2.0,
            angle: 0.5,
        };
        let Expr::Cases(cases) = formula(&motion, Coordinate::Turning) else {
            panic!("no cases");
        };
        let jet = |t: f64| motion.jet(i64::from(t >= 2.0), t).value;
        assert_eq!(cases[0].0.unicode(), "20·((t/2)³ − (t/2)⁴/2) + 0.5");
        let early = |t: f64| 20.0 * ((t / 2.0).powi(3) - (t / 2.0).powi(4) / 2.0) + 0.5;
        approx::assert_relative_eq!(early(1.3), jet(1.3), max_relative = 1e-12);
        assert_eq!(cases[1].0.unicode(), "10·(t − 1) + 0.5");
        approx::assert_relative_eq!(10.0 * (3.0 - 1.0) + 0.5, jet(3.0), max_relative = 1e-12);
    }
}
