//! One point of a map.

use crate::studies::prepared::{Point, Verdict};

/// Cell: a point of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The figure; `None` when there is none: the run stopped, failed or never
    /// began, or the figure is null. Never a number that is not finite.
    pub value: Option<f64>,
    /// The verdict.
    pub verdict: Verdict,
    /// Cause of the verdict in words.
    pub cause: String,
    /// How far the figure moves when all loads and gaps change by one part in
    /// 10¹⁰, as a share of its scale; `None`: not asked, no value, or the figure is
    /// gone then.
    pub moved: Option<f64>,
    /// Whether the figure is known to the digits asked for ([`Question::digits`]):
    /// it moves by no more than one of the last; `None`: not asked, or no value.
    ///
    /// [`Question::digits`]: super::Question::digits
    pub determined: Option<bool>,
    /// Least force of the force-closed pairs of the rigid mechanism: see
    /// [`RigidMotion::margin`](super::RigidMotion::margin).
    pub rigid_margin: Option<f64>,
}

impl Cell {
    /// A point with a single figure.
    pub(super) fn of(point: Point) -> Self {
        let figure = point.figures.first().copied().unwrap_or_default();
        Self {
            value: figure.value,
            verdict: point.verdict,
            cause: point.cause,
            moved: figure.moved,
            determined: figure.determined,
            rigid_margin: point.rigid_margin,
        }
    }
}
