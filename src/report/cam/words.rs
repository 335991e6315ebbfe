//! Places and lengths of a cam in words.

use crate::kinematics::cam::At;
use crate::report::quantity::{DIGITS, result, with_unit};

pub(super) fn angle_at(at: At) -> String {
    format!("{} at {}", degrees(at.value), degrees(at.phi))
}

pub(super) fn degrees(angle: f64) -> String {
    format!("{} deg", result(clean(angle.to_degrees()), DIGITS))
}

pub(super) fn length(value: f64) -> String {
    with_unit(value, "m", DIGITS)
}

/// A value whose rounding of zero reads as zero.
pub(super) fn clean(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}
