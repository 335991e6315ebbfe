//! Kinematics of linkages: positions, transfer functions, speeds and
//! accelerations of every link, point and sliding pair, over a turn, a range of
//! the input coordinate or time.
//!
//! One loop makes the rows (`rows`) over a `Course`, of one input or of several (`multi_input`),
//! and finds extremes, errors and warnings.

mod columns;
mod described;
mod equilibria;
mod extremes;
mod figures;
mod multi_input;
mod request;
mod rows;
mod study;
mod subject;
mod summary;
mod values;

pub use columns::Quantity;
pub use described::{DescribedFigure, described_results, ends};
pub use equilibria::Equilibrium;
pub use figures::NamedFigure;
pub(in crate::studies) use figures::end;
pub use multi_input::{AskedSeveral, multi_input_kinematics};
pub use request::{
    InputCourse, InputOver, KinematicsRequest, MOST_POSITIONS, Over, POSITIONS, Question,
    whole_travel,
};
pub use study::{even_motion, kinematics};
pub use subject::{Subject, assembly_modes, limited_inputs, linkage_of, several_of};

use crate::dynamics::model::{Coordinate, Model};
use crate::kinematics::linkage::multi::{MultiLinkage, SingularCurve};
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::kinematics::linkage::{Linkage, Structure};
use crate::studies::check::Check;
use crate::studies::judgement::{Judgement, RunEnd};
use serde::Serialize;

/// Positions, speeds and accelerations of the linkage that a question names, of one input or
/// of several.
///
/// # Errors
/// What cannot be answered, in words.
pub fn kinematics_of(model: &Model, question: &Question) -> Result<Kinematics, String> {
    Ok(match several_of(model, question.object.as_deref()) {
        Some(body) => multi_input_kinematics(&AskedSeveral::new(model, body, question)?),
        None => kinematics(&KinematicsRequest::new(model, question)?),
    })
}

/// A linkage of one input or of several.
#[derive(Clone, Debug)]
pub enum AnyLinkage {
    /// One input.
    One(Linkage),
    /// Several inputs.
    Several(MultiLinkage),
}

impl AnyLinkage {
    /// Links, pairs, forces and outputs.
    pub fn spec(&self) -> &LinkageSpec {
        match self {
            Self::One(linkage) => linkage.spec(),
            Self::Several(linkage) => &linkage.spec().linkage,
        }
    }

    /// Mobility and groups.
    pub fn structure(&self) -> &Structure {
        match self {
            Self::One(linkage) => linkage.structure(),
            Self::Several(linkage) => linkage.structure(),
        }
    }
}

/// Findings of a study of kinematics.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The object's id.
    pub object: String,
    /// The linkage.
    pub linkage: AnyLinkage,
    /// Whether the input turns or slides; of several the one along the axis.
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
    pub stopped: Option<RowsEnd>,
    /// Of several inputs: the singular positions over two of them.
    pub plane: Option<Plane>,
    /// Of several inputs: the positions of all links over their ranges.
    pub grid: Option<Grid>,
    /// Warnings to the user.
    pub warnings: Vec<String>,
}

impl Kinematics {
    /// The checks of the quantities: they are known at every position.
    pub fn checks(&self) -> Vec<Check> {
        // Towards the position that stops it they grow without bound.
        let counted = |name, count: usize| Check {
            name,
            value: if self.stopped.is_some() { 0 } else { count } as f64,
            bound: 0.0,
        };
        let columns = self.columns.iter();
        let undetermined = columns.clone().filter(|column| column.undetermined > 0);
        vec![
            counted(
                "count of quantities that are not determined somewhere",
                undetermined.count(),
            ),
            counted(
                "count of quantities beyond all numbers",
                columns.filter(|column| column.is_lost()).count(),
            ),
        ]
    }

    /// The verdict: it goes through all positions, and its quantities are known there.
    pub fn judgement(&self) -> Judgement {
        let ending = match self.stopped {
            Some(_) => RunEnd::OfMechanism,
            None => RunEnd::Complete,
        };
        Judgement::judge_result(ending, &self.checks(), || Judgement::InWorkingOrder)
    }
}

/// Singular positions over two inputs, the others held: where the determinant of a group
/// vanishes, speeds and forces grow without bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// The two inputs: to the right and upwards.
    pub inputs: [PlaneInput; 2],
    /// The curves.
    pub curves: Vec<SingularCurve>,
    /// The way of the study through the plane.
    pub path: Vec<[f64; 2]>,
}

/// An input of a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneInput {
    /// Name of the input.
    pub name: String,
    /// Whether it turns or slides.
    pub coordinate: Coordinate,
    /// The range looked at (rad or m).
    pub range: [f64; 2],
}

/// Positions of all links on a grid over the inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The inputs that vary: name, whether it turns or slides, values.
    pub axes: Vec<(String, Coordinate, Vec<f64>)>,
    /// Frames of all links as in [`Kinematics::frames`], the first axis fastest; not numbers
    /// where the linkage cannot be assembled.
    pub frames: Vec<Vec<[f64; 4]>>,
    /// Index into the frames of the position nearest to that of the study's beginning, of those
    /// in which the linkage can be assembled.
    pub start: usize,
}

/// Axis: the quantity that leads from row to row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// `input coordinate`, `time`, or of several inputs that move together `path`, from 0 to
    /// 1.
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
    /// Of a transfer function of a linkage of several inputs: the input.
    pub by: Option<String>,
    /// SI unit.
    pub unit: String,
    /// A value a row; not a number where it is infinite or not determined.
    pub values: Vec<f64>,
    /// Greatest estimated error of the values that are determined: what the rounding of
    /// the linkage's numbers leaves open, much near singular positions.
    pub error: f64,
    /// Rows at which the error is so great that the value is not determined.
    pub undetermined: usize,
    /// Dead-centre positions at the ends of the rows towards which it grows without bound.
    pub unbounded: Vec<f64>,
}

impl Column {
    /// `links.rod.P.speed_x`; of several inputs `links.rod.first_transfer.left`.
    pub fn name(&self) -> String {
        columns::name(&self.owner, self.quantity, self.by.as_deref())
    }

    /// True where it grows beyond what can be written as a number.
    fn is_lost(&self) -> bool {
        let missing = self.values.iter().filter(|value| !value.is_finite());
        !self.quantity.passes_infinity() && missing.count() > self.undetermined
    }
}

/// Least and greatest value of a column and where they are on the axis; infinite where it grows
/// without bound towards a dead-centre position at the end of the reach.
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
/// best, 0 a dead-centre position of the output.
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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Input coordinate there.
    pub at: f64,
    /// Cause in words.
    #[serde(rename = "because")]
    pub cause: String,
}

/// Why the rows end early.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RowsEnd {
    /// Place on the axis, located to rounding.
    pub at: f64,
    /// Input coordinate there.
    pub input: f64,
    /// Cause in words.
    #[serde(rename = "because")]
    pub cause: String,
}
