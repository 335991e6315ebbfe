//! A linkage over its input as polynomials, for the right-hand side.
//!
//! The reduced inertia J, the force W = Q − V′ and the damping D are smooth
//! functions of the input coordinate, and so are the outputs on which something
//! hangs: the equations of motion ask for nothing else. They are interpolated once,
//! piece by piece, at Chebyshev's points to rounding; where that does not succeed (a
//! kink of a force, the neighbourhood of a dead-centre position) the linkage is solved as
//! anywhere else. The derivatives are those of the polynomials, so that energy is
//! kept as well as with the functions themselves.
//!
//! The fits are kept in powers, four functions side by side, as the right-hand side evaluates
//! them.

mod build;

use crate::kinematics::linkage::{Linkage, Reach};
use crate::math::jet::Jet;
use build::{Builder, forces_repeat, period_of_outputs};
use std::cell::Cell;

/// Coefficients of a polynomial, four of them together.
const POINTS: usize = 4 * FOURS;
const FOURS: usize = 4;
/// The finest pieces are the whole over two to this power.
const DEEPEST: u32 = 10;
/// No piece: the linkage is solved.
const NONE: u16 = u16::MAX;

/// The pieces.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    start: f64,
    span: f64,
    /// Whether everything repeats after `span`.
    periodic: bool,
    /// Piece in each of the finest intervals.
    index: Vec<u16>,
    pieces: Vec<Piece>,
    /// Of every piece, one after the other: J, J′, W and D; then U, U′, U″, U‴ of
    /// each output that is asked for.
    fours: Vec<Four>,
    /// Of every output: its place among those asked for, and what it gains in a
    /// period.
    outputs: Vec<Option<(usize, f64)>>,
    /// Number of `fours` of a piece.
    width: usize,
}

/// Place within a piece: x = (place − centre)·scale.
#[derive(Clone, Copy, Debug)]
struct Piece {
    centre: f64,
    scale: f64,
}

/// Four polynomials side by side, lowest power first, four powers together: those
/// of the first polynomial, of the second, …
#[derive(Clone, Copy, Debug)]
struct Four([[f64; 16]; FOURS]);

/// J, J′, W, D.
pub(super) type Lanes = [f64; 4];

/// A place on a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    piece: usize,
    x: f64,
    /// Periods left out.
    turns: f64,
}

impl Table {
    /// The table of a linkage with some of its outputs; `None` when its input goes
    /// on for ever without repeating, or a force does not repeat with it.
    pub(super) fn new(linkage: &Linkage, outputs: &[usize]) -> Option<Self> {
        let range = linkage.range();
        let (start, span, periodic) = match (&range.period, &range.reach) {
            (Some(period), Reach::Everywhere) => (range.start, period.length, true),
            (None, Reach::Interval { lower, upper }) => (lower.at, upper.at - lower.at, false),
            _ => return None,
        };
        if !span.is_finite() || (periodic && !forces_repeat(linkage, start, span)) {
            return None;
        }
        let mut places = vec![None; linkage.spec().outputs.len()];
        for (place, &output) in outputs.iter().enumerate() {
            let gain = match periodic {
                true => period_of_outputs(linkage, output, [start, start + span])?,
                false => 0.0,
            };
            places[output] = Some((place, gain));
        }
        let mut table = Self {
            start,
            span,
            periodic,
            index: vec![NONE; 1 << DEEPEST],
            pieces: Vec::new(),
            fours: Vec::new(),
            outputs: places,
            width: 1 + outputs.len(),
        };
        Builder::new(linkage, outputs, &mut table).build();
        (!table.pieces.is_empty()).then_some(table)
    }

    /// The place on a piece that belongs to an input; `None` where there is none.
    /// The cursor says which piece was found last, and is moved.
    #[inline(always)]
    pub(super) fn place_of_input(&self, q: f64, cursor: &Cell<Cursor>) -> Option<Place> {
        let mut found = cursor.get();
        let mut x = (q - found.centre) * self.pieces.get(found.piece)?.scale;
        if !(x.abs() <= 1.0) {
            found = self.search(q)?;
            cursor.set(found);
            x = (q - found.centre) * self.pieces[found.piece].scale;
        }
        Some(Place {
            piece: found.piece,
            x,
            turns: found.turns,
        })
    }

    fn search(&self, q: f64) -> Option<Cursor> {
        let turns = match self.periodic {
            true => ((q - self.start) / self.span).floor(),
            false => 0.0,
        };
        let begin = self.start + turns * self.span;
        let slot = (q - begin) / self.span * self.index.len() as f64;
        if !(slot >= 0.0) {
            return None;
        }
        let piece = usize::from(*self.index.get(slot as usize)?);
        let centre = begin + self.pieces.get(piece)?.centre;
        Some(Cursor {
            piece,
            centre,
            turns,
        })
    }

    /// J, J′, W and D.
    #[inline]
    pub(super) fn values(&self, place: Place) -> Lanes {
        self.fours[place.piece * self.width].values(place.x)
    }

    /// Derivatives of the values by the input.
    pub(super) fn slopes(&self, place: Place) -> Lanes {
        let slopes = self.fours[place.piece * self.width].slopes(place.x);
        slopes.map(|slope| slope * self.pieces[place.piece].scale)
    }

    /// Whether an output is known.
    #[inline]
    pub(super) fn knows(&self, output: usize) -> bool {
        matches!(self.outputs.get(output), Some(Some(_)))
    }

    /// An output; `None` unless it is known.
    #[inline]
    pub(super) fn output(&self, output: usize, place: Place) -> Option<Jet> {
        let (index, gain) = (*self.outputs.get(output)?)?;
        let four = &self.fours[place.piece * self.width + 1 + index];
        let [value, first, second, third] = four.values(place.x);
        Some(Jet {
            value: value + gain * place.turns,
            first,
            second,
            third,
        })
    }
}

/// The piece that was found last; none at first.
#[derive(Clone, Copy, Debug)]
pub(in crate::dynamics::system) struct Cursor {
    piece: usize,
    /// The input at its centre, all turns counted.
    centre: f64,
    turns: f64,
}

impl Default for Cursor {
    fn default() -> Self {
        Self {
            piece: 0,
            centre: f64::NAN,
            turns: 0.0,
        }
    }
}

impl Four {
    fn new(polynomials: [&[f64; POINTS]; 4]) -> Self {
        Self(std::array::from_fn(|four| {
            std::array::from_fn(|place| polynomials[place % 4][4 * four + place / 4])
        }))
    }

    /// Values of all (G. Estrin's scheme): whatever does not wait for anything else
    /// the processor takes side by side.
    #[inline]
    fn values(&self, x: f64) -> Lanes {
        let square = x * x;
        let fourth = square * square;
        let eighth = fourth * fourth;
        let [a, b, c, d] = &self.0;
        let mut sums = [0.0; 16];
        for i in 0..16 {
            sums[i] = (a[i] + fourth * b[i]) + eighth * (c[i] + fourth * d[i]);
        }
        std::array::from_fn(|lane| {
            let low = sums[lane] + x * sums[4 + lane];
            low + square * (sums[8 + lane] + x * sums[12 + lane])
        })
    }

    /// Derivatives of the values by x.
    fn slopes(&self, x: f64) -> Lanes {
        let (mut value, mut first) = ([0.0; 4], [0.0; 4]);
        for c in self.0.as_flattened().rchunks_exact(4) {
            for lane in 0..4 {
                first[lane] = first[lane] * x + value[lane];
                value[lane] = value[lane] * x + c[lane];
            }
        }
        first
    }
}

#[cfg(test)]
#[path = "table_tests.rs"]
mod tests;
