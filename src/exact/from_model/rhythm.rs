//! How a prescribed motion goes on for ever: evenly, or in periods.

use super::prescribed::{PrescribedMotion, Stage};
use crate::kinematics::motion::DriveMotion;
use crate::math::expression::Repetition;

/// Rhythm: how a motion goes on for ever after some time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rhythm {
    /// With constant speed (rad/s).
    Uniform(f64),
    /// It repeats with this period (s), advanced by so much (rad).
    Periodic(f64, f64),
    /// Neither.
    None,
}

impl PrescribedMotion {
    /// Period of a motion that repeats itself from t = 0 on (s); 0 where it is uniform.
    pub(super) fn period(&self) -> Option<f64> {
        match (self.settling_time() <= 0.0).then(|| self.rhythm())? {
            Rhythm::Uniform(_) => Some(0.0),
            Rhythm::Periodic(period, _) => Some(period),
            Rhythm::None => None,
        }
    }

    /// Rhythm of the motion after [`Self::settling_time`].
    pub(crate) fn rhythm(&self) -> Rhythm {
        let settled = self.settling_time();
        let formulas = self.formulas(settled);
        let speed = self.at(&formulas, 0, settled).speed;
        let mut rhythm = match self.drive_motion() {
            None => {
                let terms = self.terms().iter();
                let terms = terms.map(|(ratio, term)| term.rhythm().scaled(*ratio));
                terms.fold(Rhythm::Uniform(0.0), Rhythm::sum_with)
            }
            Some(DriveMotion::Constant { .. }) => Rhythm::Uniform(speed),
            Some(DriveMotion::Accelerated { acceleration, .. }) => match *acceleration {
                0.0 => Rhythm::Uniform(speed),
                _ => Rhythm::None,
            },
            // They go on with the speed that they have reached.
            Some(DriveMotion::RunUp { .. } | DriveMotion::LawRunUp(_) | DriveMotion::Table(_)) => {
                Rhythm::Uniform(speed)
            }
            // A plan that does not repeat rests after its last station.
            Some(DriveMotion::Plan(plan)) => {
                let spec = plan.spec();
                let repeats = |period| Rhythm::Periodic(period, spec.advance);
                spec.period.map_or(Rhythm::Uniform(speed), repeats)
            }
            Some(DriveMotion::Written(written)) => match written.repetition() {
                Some(Repetition::Line(slope)) => Rhythm::Uniform(slope),
                Some(Repetition::Cycles { period, advance }) => Rhythm::Periodic(period, advance),
                None => Rhythm::None,
            },
        };
        for stage in &self.stages {
            rhythm = stage.rhythm(rhythm);
        }
        rhythm
    }
}

impl Rhythm {
    /// Rhythm of the motion times a ratio.
    fn scaled(self, ratio: f64) -> Self {
        match self {
            Self::Uniform(speed) => Self::Uniform(ratio * speed),
            Self::Periodic(period, advance) => Self::Periodic(period, ratio * advance),
            Self::None => Self::None,
        }
    }

    /// Rhythm of the sum of two motions.
    fn sum_with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Uniform(one), Self::Uniform(other)) => Self::Uniform(one + other),
            (Self::Uniform(speed), Self::Periodic(period, advance))
            | (Self::Periodic(period, advance), Self::Uniform(speed)) => {
                Self::Periodic(period, advance + speed * period)
            }
            (Self::Periodic(one, advance), Self::Periodic(other, gained)) => {
                // The longer period, of which the other is a whole fraction.
                if let Some(turns) = as_whole_number(one / other) {
                    Self::Periodic(one, advance + turns * gained)
                } else if let Some(turns) = as_whole_number(other / one) {
                    Self::Periodic(other, turns * advance + gained)
                } else {
                    Self::None
                }
            }
            (Self::None, _) | (_, Self::None) => Self::None,
        }
    }
}

impl Stage {
    /// Period of U over its argument and its advance in it; `None`: U is
    /// straight (`Ok` holds its slope) or repeats nowhere (`Err`).
    fn period(&self) -> Result<(f64, f64), Option<f64>> {
        match (self.position.straight_line(), self.position.period()) {
            (Some(line), _) => Err(Some(line[0])),
            (None, Some(period)) => Ok(period),
            // (A sine without oscillations is constant.)
            (None, None) if self.position.lobes() == 0.0 => Err(Some(0.0)),
            (None, None) => Err(None),
        }
    }

    /// Rhythm of what the stage makes of an input.
    fn rhythm(&self, input: Rhythm) -> Rhythm {
        match (self.period(), input) {
            (_, Rhythm::None) => Rhythm::None,
            (_, Rhythm::Uniform(0.0)) => Rhythm::Uniform(0.0),
            (_, Rhythm::Periodic(time, 0.0)) => Rhythm::Periodic(time, 0.0),
            (Err(Some(slope)), Rhythm::Uniform(speed)) => {
                Rhythm::Uniform(self.lever * slope * speed)
            }
            (Err(Some(slope)), Rhythm::Periodic(time, advance)) => {
                Rhythm::Periodic(time, self.lever * slope * advance)
            }
            (Err(None), _) => Rhythm::None,
            (Ok((period, turn)), Rhythm::Uniform(speed)) => {
                Rhythm::Periodic(period / speed.abs(), self.lever * turn * speed.signum())
            }
            (Ok((period, turn)), Rhythm::Periodic(time, advance)) => {
                let (times, turns) = match as_whole_number(advance / period) {
                    Some(turns) => (1.0, turns),
                    None => match as_whole_number(period / advance) {
                        Some(times) => (times.abs(), times.signum()),
                        None => return Rhythm::None,
                    },
                };
                Rhythm::Periodic(time * times, self.lever * turn * turns)
            }
        }
    }
}

/// A ratio that is a whole number of moderate size, other than zero.
fn as_whole_number(ratio: f64) -> Option<f64> {
    let nearest = ratio.round();
    let near = (ratio - nearest).abs() <= 1e-12 * nearest.abs();
    (near && nearest != 0.0 && nearest.abs() <= 64.0).then_some(nearest)
}
