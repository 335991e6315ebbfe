//! The kinematics of a linkage as text, table, document, page and picture.

mod csv;
mod document;
mod drawing;
mod page;
mod plots;
mod text;

pub use csv::kinematics_csv;
pub use document::document;
pub use drawing::{drawing, picture};
pub use page::{KinematicsReport, page};
pub use text::text;

use crate::report::quantity::{significant, with_unit};
use crate::studies::kinematics::Kinematics;

/// A place on the axis for reading: angles in degrees.
pub(super) fn place(found: &Kinematics, at: f64) -> String {
    angle_or(at, found.axis.unit)
}

/// An input coordinate for reading.
pub(super) fn input(found: &Kinematics, at: f64) -> String {
    let unit = match found.input {
        crate::dynamics::model::Coordinate::Turning => "rad",
        crate::dynamics::model::Coordinate::Sliding => "m",
    };
    angle_or(at, unit)
}

/// A value with its unit, an angle in degrees.
pub(super) fn angle_or(value: f64, unit: &str) -> String {
    match unit {
        // Nowhere determined, or infinite.
        _ if !value.is_finite() => "–".to_owned(),
        "rad" => format!("{} deg", significant(value.to_degrees(), 8)),
        "1" => significant(value, 8),
        // A prefix does not go with a reciprocal.
        unit if unit.starts_with('1') => format!("{} {unit}", significant(value, 8)),
        _ => with_unit(value, unit, 8),
    }
}

#[cfg(test)]
mod tests;
