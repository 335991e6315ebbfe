//! What a position function is, wherever it comes from.

use crate::kinematics::breaks::Breaks;
use crate::math::jet::Jet;
use std::fmt;

/// A position function that this library does not know, supplied by its user.
pub trait PositionFunction: fmt::Debug + Send + Sync {
    /// U and its first three derivatives at `phi`, by the formula of `segment`
    /// (see [`Breaks`]), which may be asked a little beyond the segment's edges.
    fn jet(&self, segment: i64, phi: f64) -> Jet;

    /// Breaks: where the formula changes.
    fn breaks(&self) -> Breaks {
        Breaks::NONE
    }

    /// The interval of φ in which the function exists; `None`: everywhere.
    fn reach(&self) -> Option<(f64, f64)> {
        None
    }
}
