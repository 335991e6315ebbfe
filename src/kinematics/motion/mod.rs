//! Motions: dimensionless laws of motion, splines, and the prescribed motion of a drive over time.

pub mod cycle;
mod defined;
pub mod law;
mod run_up;
mod spec;
mod spline;
pub mod stroke;
mod written;

pub use cycle::{Cycle, CycleSpec};
pub use law::{Law, LawName, LawSpec, RunLawName, RunLawSpec};
pub use run_up::LawRunUp;
pub use spec::DriveMotionSpec;
pub use spline::Spline;
pub use written::WrittenMotion;

use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::math::expression::Repetition;
use crate::math::jet::Jet;
use crate::math::narrow::{Narrow, narrow_stretches};

/// Prescribed motion φ(t) of a drive.
#[derive(Clone, Debug)]
pub enum DriveMotion {
    /// φ = angle + speed·t.
    Constant {
        /// Speed (rad/s), any sign.
        speed: f64,
        /// φ at t = 0 (rad).
        angle: f64,
    },
    /// φ = angle + speed·t + acceleration·t²/2.
    Accelerated {
        /// Acceleration (rad/s²), any sign.
        acceleration: f64,
        /// Speed at t = 0 (rad/s).
        speed: f64,
        /// φ at t = 0 (rad).
        angle: f64,
    },
    /// ω(τ) = speed·(3τ² − 2τ³), τ = t/time, from rest; constant after `time`.
    /// Speed and acceleration are continuous, the jerk jumps at `time`.
    RunUp {
        /// Final speed (rad/s), any sign.
        speed: f64,
        /// Duration of the run-up (s), > 0.
        time: f64,
        /// φ at t = 0 (rad).
        angle: f64,
    },
    /// A plan of motion over time: run-ups and moves by laws of motion, dwells,
    /// once or in cycles.
    Plan(Box<Cycle>),
    /// A run-up by a law of motion: φ = angle + speed·time·θ(t/time)/θ′(1),
    /// then on with `speed`.
    LawRunUp(Box<LawRunUp>),
    /// A smooth spline through given points (t, φ). Its end slopes are those
    /// of the polynomials through the four points nearest each end. Before the
    /// first and after the last point the drive turns on with the speed it has
    /// there: the acceleration jumps at both.
    Table(Spline),
    /// φ as an expression of time.
    Written(Box<WrittenMotion>),
}

impl DriveMotion {
    /// The motion that a scene describes.
    ///
    /// # Errors
    /// Numbers that are not finite, a run-up that takes no time, a faulty law or
    /// plan, a table with
    /// fewer than three or not ascending points; paths relative to `motion`.
    pub fn new(spec: &DriveMotionSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        match *spec {
            DriveMotionSpec::Constant { speed, angle } => {
                faults.finite("speed", speed);
                faults.finite("angle", angle);
                faults.check()?;
                Ok(Self::Constant { speed, angle })
            }
            DriveMotionSpec::Accelerated {
                acceleration,
                speed,
                angle,
            } => {
                faults.finite("acceleration", acceleration);
                faults.finite("start_speed", speed);
                faults.finite("angle", angle);
                faults.check()?;
                Ok(Self::Accelerated {
                    acceleration,
                    speed,
                    angle,
                })
            }
            DriveMotionSpec::RunUp {
                speed,
                time,
                angle,
                ref law,
            } => {
                faults.finite("run_up.speed", speed);
                faults.positive("run_up.time", time);
                faults.finite("run_up.angle", angle);
                faults.check()?;
                let Some(spec) = law else {
                    return Ok(Self::RunUp { speed, time, angle });
                };
                match LawRunUp::new(spec, speed, time, angle) {
                    Ok(run_up) => Ok(Self::LawRunUp(Box::new(run_up))),
                    Err(found) => {
                        faults.absorb("run_up.law", found);
                        faults.check()?;
                        Err(Vec::new())
                    }
                }
            }
            DriveMotionSpec::Plan(ref spec) => match Cycle::new(spec) {
                Ok(cycle) => Ok(Self::Plan(Box::new(cycle))),
                Err(found) => {
                    faults.absorb("plan", found);
                    faults.check()?;
                    Err(Vec::new())
                }
            },
            DriveMotionSpec::Written {
                ref expression,
                factor,
            } => {
                let motion = WrittenMotion::new(expression, factor)?;
                Ok(Self::Written(Box::new(motion)))
            }
            DriveMotionSpec::Table { ref points } => {
                faults.points("table", points, 3);
                faults.check()?;
                let spline = Spline::through(points);
                if !spline.is_finite() {
                    let message = "the curve through these points has slopes too great for numbers";
                    faults.add("table", message, "space the points more regularly");
                }
                faults.check()?;
                Ok(Self::Table(spline))
            }
        }
    }

    /// Displacement, speed, acceleration and jerk at `time`, by the formula of `segment`.
    #[inline(always)]
    pub fn jet(&self, segment: i64, time: f64) -> Jet {
        match self {
            Self::Constant { speed, angle } => uniform(*angle, *speed, time),
            _ => self.longer_jet(segment, time),
        }
    }

    /// [`Self::jet`] of all but constant speed.
    #[inline(never)]
    fn longer_jet(&self, segment: i64, time: f64) -> Jet {
        match self {
            Self::Constant { speed, angle } => uniform(*angle, *speed, time),
            Self::Accelerated {
                acceleration,
                speed,
                angle,
            } => Jet {
                value: angle + (speed + 0.5 * acceleration * time) * time,
                first: speed + acceleration * time,
                second: *acceleration,
                third: 0.0,
            },
            Self::RunUp {
                speed,
                time: duration,
                angle,
            } => {
                if segment > 0 {
                    return uniform(angle + 0.5 * speed * duration, *speed, time - duration);
                }
                let tau = time / duration;
                Jet {
                    value: angle + speed * duration * tau * tau * tau * (1.0 - 0.5 * tau),
                    first: speed * tau * tau * (3.0 - 2.0 * tau),
                    second: speed / duration * 6.0 * tau * (1.0 - tau),
                    third: speed / (duration * duration) * (6.0 - 12.0 * tau),
                }
            }
            Self::Plan(cycle) => cycle.jet(segment, time),
            Self::LawRunUp(run_up) => run_up.jet(segment, time),
            Self::Written(written) => written.jet(segment, time),
            Self::Table(spline) => {
                let (first, last) = spline.ends();
                match usize::try_from(segment) {
                    Err(_) | Ok(0) => continued(spline, first, time),
                    Ok(number) if number < spline.knots().len() => spline.jet_of(number - 1, time),
                    Ok(_) => continued(spline, last, time),
                }
            }
        }
    }

    /// The stretches between two times of a segment in which the speed changes so briefly
    /// that long steps would pass over it unseen.
    pub(crate) fn narrow_stretches(&self, segment: i64, from: f64, to: f64) -> Vec<Narrow> {
        let speed = |time: f64| self.jet(segment, time).first;
        match self {
            // Their formulas are simple between breaks.
            Self::Constant { .. }
            | Self::Accelerated { .. }
            | Self::RunUp { .. }
            | Self::Plan(_)
            | Self::LawRunUp(_) => Vec::new(),
            Self::Written(written) => {
                let bounds = |a, b| written.speeds(segment, a, b);
                narrow_stretches(from, to, bounds, speed)
            }
            Self::Table(spline) => {
                let bounds = |a: f64, b: f64| {
                    let knots = spline.knots();
                    let inner = knots.partition_point(|&knot| knot <= a)
                        ..knots.partition_point(|&knot| knot < b);
                    let inner = knots.get(inner).unwrap_or_default().iter().copied();
                    let speeds = inner.chain([a, b]).map(speed);
                    speeds.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], speed| {
                        [low.min(speed), high.max(speed)]
                    })
                };
                narrow_stretches(from, to, bounds, speed)
            }
        }
    }

    /// Times at which any derivative jumps, ascending: [`Self::breaks`]; of a plan that repeats,
    /// those of its first cycle.
    pub fn joints(&self) -> Vec<f64> {
        match self {
            Self::Constant { .. } | Self::Accelerated { .. } => Vec::new(),
            Self::RunUp { time, .. } => vec![*time],
            Self::Plan(cycle) => cycle.breaks().points.clone(),
            Self::LawRunUp(run_up) => run_up.breaks(),
            Self::Written(written) => written.breaks().points.clone(),
            Self::Table(spline) => spline.knots().to_vec(),
        }
    }

    /// True when it repeats for ever, but for an advance with each cycle, as a plan that
    /// repeats does and an expression of which it is proved.
    pub fn repeats(&self) -> bool {
        match self {
            Self::Plan(cycle) => cycle.breaks().period.is_some(),
            Self::Written(written) => match written.repetition() {
                Some(Repetition::Cycles { .. }) => true,
                Some(Repetition::Line(_)) | None => false,
            },
            Self::Constant { .. }
            | Self::Accelerated { .. }
            | Self::RunUp { .. }
            | Self::LawRunUp(_)
            | Self::Table(_) => false,
        }
    }

    /// Times at which the formula changes.
    pub fn breaks(&self) -> Breaks {
        let points = match self {
            Self::Constant { .. } | Self::Accelerated { .. } => Vec::new(),
            Self::RunUp { time, .. } => vec![*time],
            Self::Plan(cycle) => return cycle.breaks().clone(),
            Self::Written(written) => return written.breaks().clone(),
            Self::LawRunUp(run_up) => run_up.breaks(),
            // (Beside a point the formula of one interval is wrong by the cube of the distance.)
            Self::Table(spline) => spline.knots().to_vec(),
        };
        Breaks {
            points,
            period: None,
        }
    }
}

/// Motion with constant speed.
#[inline(always)]
fn uniform(start: f64, speed: f64, elapsed: f64) -> Jet {
    Jet {
        value: start + speed * elapsed,
        first: speed,
        ..Jet::default()
    }
}

/// A spline's straight continuation beyond one of its ends.
fn continued(spline: &Spline, end: f64, time: f64) -> Jet {
    let jet = spline.jet(end);
    uniform(jet.value, jet.first, time - end)
}

#[cfg(test)]
mod tests {
    use super::cycle::{CycleSpec, Motion, Station};
    use super::{DriveMotion, DriveMotionSpec, LawName, RunLawName};
    use crate::math::jet::Jet;

    fn station(at: f64, displacement: f64, motion: Motion) -> Station {
        Station {
            at,
            displacement,
            speed: None,
            acceleration: None,
            order: 2,
            motion,
        }
    }

    fn motions() -> Vec<DriveMotion> {
        [
            DriveMotionSpec::Constant {
                speed: -7.0,
                angle: 0.3,
            },
            DriveMotionSpec::RunUp {
                speed: 30.0,
                time: 0.4,
                angle: -1.0,
                law: None,
            },
            DriveMotionSpec::RunUp {
                speed: -20.0,
                time: 0.5,
                angle: 0.4,
                law: Some(RunLawName::UnequalTrapezoid.into()),
            },
            DriveMotionSpec::Plan(CycleSpec {
                stations: vec![
                    station(0.0, 0.0, Motion::Law(LawName::ModifiedSine.into())),
                    station(0.3, 2.0, Motion::Dwell),
                    station(0.4, 2.0, Motion::Smooth),
                ],
                period: Some(0.7),
                advance: 0.5,
                phase: 0.0,
            }),
            DriveMotionSpec::Table {
                points: vec![(0.0, 0.0), (0.2, 1.0), (0.5, 1.5), (0.6, 3.0), (1.0, 2.0)],
            },
            DriveMotionSpec::Accelerated {
                acceleration: -3.0,
                speed: 2.0,
                angle: 0.5,
            },
        ]
        .iter()
        .map(|spec| DriveMotion::new(spec).unwrap())
        .collect()
    }

    #[test]
    fn speed_acceleration_and_jerk_agree_with_differences() {
        let h = 1e-5;
        for motion in motions() {
            let breaks = motion.breaks();
            for time in [-0.05, 0.07, 0.31, 0.39, 0.47, 0.55, 1.3] {
                let segment = breaks.segment_at(time, 1.0);
                let [left, middle, right] = [-h, 0.0, h].map(|d| motion.jet(segment, time + d));
                let slope = |f: fn(&Jet) -> f64| (f(&right) - f(&left)) / (2.0 * h);
                approx::assert_abs_diff_eq!(slope(|j| j.value), middle.first, epsilon = 1e-6);
                approx::assert_abs_diff_eq!(slope(|j| j.first), middle.second, epsilon = 1e-5);
                approx::assert_abs_diff_eq!(slope(|j| j.second), middle.third, epsilon = 1e-4);
            }
        }
    }

    #[test]
    fn displacement_and_speed_are_continuous_where_the_formula_changes() {
        for motion in motions() {
            let breaks = motion.breaks();
            let shift = i64::from(breaks.period.is_some());
            for (segment, &time) in breaks.points.iter().enumerate() {
                let segment = segment as i64 - shift;
                let (left, right) = (motion.jet(segment, time), motion.jet(segment + 1, time));
                approx::assert_relative_eq!(left.value, right.value, epsilon = 1e-14);
                approx::assert_relative_eq!(left.first, right.first, epsilon = 1e-12);
                if matches!(motion, DriveMotion::RunUp { .. }) {
                    approx::assert_abs_diff_eq!(left.second, right.second, epsilon = 1e-12);
                    assert!((left.third - right.third).abs() > 1.0);
                }
            }
        }
    }

    #[test]
    fn a_run_up_reaches_its_speed_and_half_the_angle() {
        let motion = &motions()[1];
        let jet = motion.jet(0, 0.4);
        approx::assert_relative_eq!(jet.first, 30.0, max_relative = 1e-15);
        approx::assert_relative_eq!(jet.value, -1.0 + 0.5 * 30.0 * 0.4, max_relative = 1e-15);
        approx::assert_relative_eq!(motion.jet(1, 1.4).value, 35.0, max_relative = 1e-15);
    }

    #[test]
    fn a_run_up_by_a_law_reaches_its_speed_with_the_acceleration_of_the_law() {
        let motion = &motions()[2];
        let breaks = motion.breaks();
        assert_eq!(motion.jet(breaks.segment_at(-0.1, 1.0), -0.1).value, 0.4);
        let jet = motion.jet(breaks.segment_at(0.5, 1.0), 0.5);
        approx::assert_relative_eq!(jet.first, -20.0, max_relative = 1e-14);
        // θ″/θ′ of the unequal trapezoid is 1/σ.
        let filling = 1.0 - 0.625 * (1.0 - 2.0 / std::f64::consts::PI);
        let jet = motion.jet(breaks.segment_at(0.1, 1.0), 0.1);
        let wanted = -20.0 / 0.5 / filling;
        approx::assert_relative_eq!(jet.second, wanted, max_relative = 1e-13);
    }

    #[test]
    fn faults_name_the_place() {
        let bad = DriveMotionSpec::Table {
            points: vec![(0.0, 0.0), (0.0, f64::NAN)],
        };
        let faults = DriveMotion::new(&bad).unwrap_err();
        let paths: Vec<_> = faults.iter().map(|fault| fault.path.as_str()).collect();
        assert_eq!(paths, ["table", "table[1][1]", "table[1]"]);
        let bad = DriveMotionSpec::RunUp {
            speed: 1.0,
            time: 0.0,
            angle: f64::INFINITY,
            law: None,
        };
        assert_eq!(DriveMotion::new(&bad).unwrap_err().len(), 2);
    }
}
