//! Kinematics of linkages: positions, transfer functions, speeds and
//! accelerations of every link, point and sliding pair, over a turn, a range of
//! the input coordinate or time.

mod ask;
mod columns;
mod equilibria;
mod extremes;
mod figures;
mod study;
mod subject;
mod summary;
mod values;

pub use ask::{Asked, MOST_POSITIONS, Over, POSITIONS, Question, whole_travel};
pub use columns::Quantity;
pub use equilibria::Equilibrium;
pub(in crate::studies) use figures::ENDS;
pub use study::{even_motion, kinematics};
pub use subject::{Subject, linkage_of, reaches};

use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::Linkage;

/// Findings of a study of kinematics.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The object's id.
    pub object: String,
    /// The linkage.
    pub linkage: Linkage,
    /// Whether the input turns or slides.
    pub input: Coordinate,
    /// Axis that leads from row to row.
    pub axis: Axis,
    /// Time of each row (s); where the speed of the input is not known, the
    /// input coordinate itself.
    pub times: Vec<f64>,
    /// True when the last row is one period after the first.
    pub closed: bool,
    /// Motion of the input, in words.
    pub motion: String,
    /// All quantities, a value a row.
    pub columns: Vec<Column>,
    /// Frames of all links, a row each: x, y, cos, sin.
    pub frames: Vec<Vec<[f64; 4]>>,
    /// Least and greatest value of every column, located between the rows.
    pub extremes: Vec<Extremes>,
    /// Forward and return strokes of the outputs over a period.
    pub strokes: Vec<Stroke>,
    /// Equilibria: where it rests by itself, with its input free and nothing on its
    /// outputs.
    pub equilibria: Vec<Equilibrium>,
    /// Transmission angles.
    pub transmission: Vec<Transmission>,
    /// Limits of the input's travel, and their reasons.
    pub limits: Vec<Limit>,
    /// Place and reason where the rows end before what was asked.
    pub stopped: Option<Stopped>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

/// Axis: the quantity that leads from row to row.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// `input coordinate` or `time`.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// A value a row.
    pub values: Vec<f64>,
}

/// Column: one quantity over the rows.
#[derive(Clone, Debug)]
pub struct Column {
    /// Owner of the quantity: `input`, `links.rod`, `links.rod.P`, `pairs.guide`, or an
    /// output by its name: `ram`.
    pub owner: String,
    /// Quantity of the column.
    pub quantity: Quantity,
    /// SI unit.
    pub unit: String,
    /// A value a row; not a number where it is infinite or not determined.
    pub values: Vec<f64>,
    /// Greatest estimated error of the values that are determined: what the rounding of
    /// the linkage's numbers leaves open, much near singular positions.
    pub error: f64,
    /// Rows at which the error is so great that the value is not determined.
    pub undetermined: usize,
}

impl Column {
    /// `links.rod.P.speed_x`.
    pub fn name(&self) -> String {
        format!("{}.{}", self.owner, self.quantity.name())
    }
}

/// Least and greatest value of a column and where they are on the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// (place on the axis, value).
    pub least: (f64, f64),
    /// (place on the axis, value).
    pub greatest: (f64, f64),
}

/// Stroke of an output: how it goes to and fro in a period of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// The output, or the sliding pair.
    pub owner: String,
    /// SI unit of its displacement.
    pub unit: &'static str,
    /// Least and greatest displacement with the input coordinate there.
    pub ends: [(f64, f64); 2],
    /// Change of the input while the displacement grows and while it falls.
    pub rise_and_return: [f64; 2],
    /// The longer of the two over the shorter: the time ratio at constant
    /// speed of the input.
    pub time_ratio: f64,
}

/// The transmission angle of a dyad: the acute angle between the link that
/// pushes and the direction in which the pushed joint cannot give way; 90° is
/// best, 0 a dead position of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// The group: `rod and rocker`.
    pub owner: String,
    /// (place on the axis, least value in rad).
    pub least: (f64, f64),
    /// (place on the axis, greatest value in rad).
    pub greatest: (f64, f64),
}

/// An end of the input's travel.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Input coordinate there.
    pub at: f64,
    /// Cause in words.
    pub cause: String,
}

/// Why the rows end early.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// Place on the axis, located to rounding.
    pub at: f64,
    /// Input coordinate there.
    pub input: f64,
    /// Cause in words.
    pub cause: String,
}
