//! A planar linkage drawn to scale: as a picture of one position, and moving.
//!
//! Every link is drawn once, in its own frame, and placed by a transform; the
//! script of a page only changes the transforms.

mod arrows;
mod guides;
pub(in crate::report) mod marks;
mod names;
mod parts;
mod section;
mod shape;
#[cfg(feature = "live")]
pub(in crate::report) mod sketch;
mod view;
mod wheels;

pub(in crate::report) use parts::Hold;
pub(in crate::report) use section::STYLE;
pub(in crate::report) use view::View;

use crate::kinematics::linkage::spec::LinkageSpec;

/// Most positions that a page carries.
pub(in crate::report) const MOST_FRAMES: usize = 721;

/// A link's frame in the frame of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Origin (m).
    pub at: [f64; 2],
    /// Cosine and sine of the angle.
    pub turn: [f64; 2],
}

impl Placement {
    /// The ground's own frame.
    pub const GROUND: Self = Self {
        at: [0.0, 0.0],
        turn: [1.0, 0.0],
    };

    /// A point of the link in the frame of the ground.
    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [c, s] = self.turn;
        [self.at[0] + c * x - s * y, self.at[1] + s * x + c * y]
    }
}

/// A linkage in a sequence of positions.
#[derive(Clone, Debug)]
pub struct Drawing<'a> {
    /// The linkage.
    pub spec: &'a LinkageSpec,
    /// Positions: one placement a link each.
    pub frames: Vec<Vec<Placement>>,
    /// Axis that leads from one position to the next.
    pub axis: Axis,
    /// Paths of points: coupler curves.
    pub paths: Vec<Path>,
    /// Arrows: speeds, accelerations, forces.
    pub arrows: Vec<ArrowSet>,
}

/// An input that has a slider of its own.
#[derive(Clone, Debug)]
pub struct GridAxis {
    /// Name of the input.
    pub name: String,
    /// The unit in which it is shown.
    pub unit: String,
    /// Values, in that unit.
    pub values: Vec<f64>,
}

/// Axis of a drawing: a quantity that leads from one position to the next.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// Name: `crank angle`, `time`.
    pub name: String,
    /// The unit in which it is shown.
    pub unit: String,
    /// Values at every position, in that unit.
    pub values: Vec<f64>,
    /// Time of every position (s), for playing at true relative speed.
    pub times: Vec<f64>,
    /// True when the first position follows the last.
    pub closed: bool,
}

/// The path of a point.
#[derive(Clone, Debug)]
pub struct Path {
    /// The point: `rod.P`.
    pub name: String,
    /// Places at every position (m).
    pub points: Vec<[f64; 2]>,
}

/// Arrows of one kind, all to the same scale.
#[derive(Clone, Debug)]
pub struct ArrowSet {
    /// Name of the quantity: `speed`.
    pub name: String,
    /// SI unit of their length.
    pub unit: String,
    /// True when they are shown from the beginning.
    pub shown: bool,
    /// The arrows.
    pub arrows: Vec<Arrow>,
}

/// Share of the mechanism's extent that the longest arrow of a set takes.
const LONGEST: f64 = 0.24;

impl ArrowSet {
    /// Greatest length of a vector over all positions (SI); 0 of none.
    fn greatest(&self) -> f64 {
        let vectors = self.arrows.iter().flat_map(|arrow| &arrow.vector);
        let lengths = vectors.map(|[x, y]| x.hypot(*y));
        lengths
            .filter(|length| length.is_finite())
            .fold(0.0, f64::max)
    }

    /// Metres for a unit of the quantity in a mechanism of this extent; 0 where all vectors
    /// are zero.
    fn metres(&self, extent: f64) -> f64 {
        match self.greatest() {
            length if length > 0.0 => LONGEST * extent / length,
            _ => 0.0,
        }
    }
}

/// An arrow over all positions.
#[derive(Clone, Debug)]
pub struct Arrow {
    /// Name of the point: `rod.P`.
    pub name: String,
    /// Starts of the arrow at every position (m).
    pub at: Vec<[f64; 2]>,
    /// The vector at every position (SI).
    pub vector: Vec<[f64; 2]>,
}

#[cfg(test)]
mod tests;
