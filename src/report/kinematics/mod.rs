//! The kinematics of a linkage as findings, document and picture.

mod document;
mod drawing;
mod endless;
mod findings;
mod multi_input;
mod plots;

pub use document::document;
pub use drawing::{drawing, picture};
pub use findings::{findings, rows};

use crate::dynamics::model::Coordinate;
use crate::report::course::CourseAxis;
use crate::report::findings::Value;
use crate::report::sentence::Sentence;
use crate::studies::kinematics::Kinematics;

/// Axis along which the positions follow each other.
fn axis(found: &Kinematics) -> CourseAxis {
    CourseAxis {
        name: found.axis.name,
        si: found.axis.unit,
    }
}

/// A place on the axis for reading: angles in degrees.
fn place_text(found: &Kinematics, at: f64) -> String {
    Value::angle_or(at, found.axis.unit, 6).words()
}

/// An input coordinate in a sentence.
fn input_sentence(found: &Kinematics, at: f64) -> Sentence {
    Sentence::default().angle_or(at, found.input.unit(), 6)
}

/// An input coordinate for reading.
fn input(found: &Kinematics, at: f64) -> String {
    coordinate(found.input, at)
}

/// A value of a coordinate for reading.
fn coordinate(own: Coordinate, at: f64) -> String {
    Value::angle_or(at, own.unit(), 6).words()
}
