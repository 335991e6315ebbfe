//! Motions: dimensionless laws of motion, splines, and the prescribed motion of a drive over time.

use crate::breaks::Breaks;
use crate::jet::Jet;

/// Prescribed motion φ(t) of a drive.
#[derive(Clone, Debug)]
pub enum DriveMotion {
    /// φ = angle + speed·t.
    Constant {
        /// Speed (rad/s), any sign, not zero.
        speed: f64,
        /// φ at t = 0 (rad).
        angle: f64,
    },
}

impl DriveMotion {
    /// Displacement, speed, acceleration and jerk at `time`, by the formula of `segment`.
    #[inline]
    pub fn jet(&self, _segment: i64, time: f64) -> Jet {
        match self {
            Self::Constant { speed, angle } => Jet {
                value: angle + speed * time,
                first: *speed,
                ..Jet::default()
            },
        }
    }

    /// Times at which the formula changes.
    pub fn breaks(&self) -> Breaks {
        Breaks::NONE
    }
}
