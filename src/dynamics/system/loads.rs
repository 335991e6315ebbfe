//! Loads whose force is not constant.

use super::written::FrozenExpression;
use crate::dynamics::model::{LinearPiece, LoadLaw, Track};
use crate::kinematics::breaks::Breaks;
use crate::math::quantity::Quantity;

/// A load, frozen.
#[derive(Clone, Debug)]
pub(super) struct FrozenLoad {
    /// Internal index of the node it acts on.
    pub(super) node: usize,
    /// Law of the force.
    pub(super) law: LoadLaw,
    /// Of [`LoadLaw::Pieces`]: what runs along the table.
    pub(super) argument: Option<Argument>,
    /// Of [`LoadLaw::Stop`]: index into [`Frozen::stops`](super::frozen::Frozen::stops).
    pub(super) stop: Option<usize>,
    /// Of [`LoadLaw::Dry`]: index into [`Frozen::dry`](super::frozen::Frozen::dry).
    pub(super) dry: Option<usize>,
    /// False for a function of which no power series is known.
    pub(super) has_series: bool,
    /// Of [`LoadLaw::Written`]: the expression. Of [`LoadLaw::Dry`] that by which it is engaged.
    pub(super) written: Option<FrozenExpression>,
}

/// Argument of a load's table: what it runs over.
#[derive(Clone, Debug)]
pub(super) struct Argument {
    /// Component of the modes that selects the piece.
    pub(super) component: usize,
    /// Internal index of the node whose displacement it is; `None`: time.
    pub(super) node: Option<usize>,
    /// The break points of the table.
    breaks: Breaks,
}

impl Argument {
    /// The argument of a table on a track.
    pub(super) fn new(track: &Track, component: usize, node: Option<usize>) -> Self {
        Self {
            component,
            node,
            breaks: track.breaks.clone(),
        }
    }
}

impl FrozenLoad {
    /// Force towards positive displacement. `argument` gives the place on a
    /// table's axis and its segment; it is asked for tables only.
    #[inline]
    pub(super) fn force<N: Quantity>(
        &self,
        displacement: N,
        speed: N,
        argument: impl Fn(&Argument) -> (N, i64),
    ) -> N {
        match &self.law {
            LoadLaw::Linear(own) => {
                N::from(own.force) - displacement.scale(own.rate) - speed.scale(own.damping)
            }
            // (The force of a stop and of dry friction depends on a mode, that of an expression
            // on other nodes.)
            LoadLaw::Stop(_) | LoadLaw::Written(_) | LoadLaw::Dry { .. } => N::from(0.0),
            LoadLaw::Pieces { pieces, .. } => match &self.argument {
                Some(axis) => {
                    let (x, segment) = argument(axis);
                    piece_force(pieces, &axis.breaks, x, segment)
                }
                None => N::from(0.0),
            },
            LoadLaw::Function { function, factor } if !function.needs_displacement() => {
                let place = displacement.value();
                let force = speed.apply(|speed| {
                    let force = function.force(place, speed);
                    (force.value, force.by_speed)
                });
                force.scale(*factor)
            }
            LoadLaw::Function { function, factor } => {
                let force = function.force(displacement.value(), speed.value());
                // Its derivatives are those of the force along the motion's.
                let moved = displacement - N::from(displacement.value());
                let faster = speed - N::from(speed.value());
                let change = moved.scale(force.by_displacement) + faster.scale(force.by_speed);
                (N::from(force.value) + change).scale(*factor)
            }
        }
    }

    /// Slope of the piece of a table that a segment selects; 0 for other laws.
    pub(super) fn slope(&self, segment: i64) -> f64 {
        match (&self.law, &self.argument) {
            (LoadLaw::Pieces { pieces, .. }, Some(axis)) => {
                let (index, _) = axis.breaks.piece(segment);
                pieces[index.min(pieces.len() - 1)].slope
            }
            _ => 0.0,
        }
    }
}

fn piece_force<N: Quantity>(pieces: &[LinearPiece], breaks: &Breaks, x: N, segment: i64) -> N {
    let (index, shift) = breaks.piece(segment);
    let piece = pieces[index.min(pieces.len() - 1)];
    N::from(piece.value) + (x - N::from(shift + piece.start)).scale(piece.slope)
}
