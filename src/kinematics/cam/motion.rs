//! The follower's motion over one turn of the cam, piece by piece.

use crate::fault::{Fault, Faults};
use crate::kinematics::position::Position;
use crate::math::jet::Jet;
use crate::math::number::Number;
use crate::math::roots::root;
use std::f64::consts::TAU;

/// Intervals that a piece is searched in: 64, fewer where there are very many
/// pieces (a measured table, whose cubics need few).
const INTERVALS: usize = 64;
const FEWEST: usize = 8;
const TOGETHER: usize = 32_768;

/// Most lobes of a sine: more are no cam.
const MOST_LOBES: f64 = 100.0;

/// Most pieces of a turn.
const MOST_PIECES: usize = 10_000;

/// Shares of stroke and slope that count as rounding where the turn closes.
const CLOSED: f64 = 1e-9;

/// A stretch of the cam's turn on which one smooth formula holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Start of the segment (rad).
    pub from: f64,
    /// End of the segment (rad).
    pub to: f64,
    /// Segment of the position function ([`crate::kinematics::breaks::Breaks`]).
    segment: i64,
    /// Intervals it is searched in.
    pub intervals: usize,
}

/// Outward motion of a follower: s(φ) = ±(U − U at the innermost place) ≥ 0.
#[derive(Clone, Debug)]
pub struct FollowerMotion {
    position: Position,
    outward: f64,
    pieces: Vec<Piece>,
    closed: bool,
    /// Least outward displacement ±U.
    innermost: f64,
    stroke: f64,
}

impl FollowerMotion {
    /// The motion over one turn from φ = 0, or over `range`; `outward` = ±1
    /// turns displacements into outward ones.
    ///
    /// # Errors
    /// The law does not come back after a turn, is not a number somewhere, or
    /// stands still; paths relative to the object.
    pub fn new(
        position: &Position,
        outward: f64,
        range: Option<(f64, f64)>,
    ) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        let lobes = position.lobes();
        if lobes > MOST_LOBES {
            let message = format!("{lobes} oscillations in a turn are more than a cam can have");
            let hint = format!("give a harmonic of at most {MOST_LOBES}");
            faults.add("position.sine.harmonic", message, &hint);
        }
        let (from, to) = range.unwrap_or((0.0, TAU));
        if !(from.is_finite() && to.is_finite() && from < to && to - from <= TAU * (1.0 + CLOSED)) {
            let message = format!("the profile cannot reach from {from} to {to} rad");
            let hint = "give a range of more than nothing and at most a turn";
            faults.add("cam.range", message, hint);
        }
        faults.check()?;
        let Some(pieces) = pieces(position, from, to, lobes) else {
            let message = format!("more than {MOST_PIECES} pieces of the law in a turn are no cam");
            return Err(vec![Fault::new(
                "position",
                message,
                "give a law with a longer period",
            )]);
        };
        let mut motion = Self {
            position: position.clone(),
            outward,
            pieces,
            closed: range.is_none(),
            innermost: 0.0,
            stroke: 0.0,
        };
        motion.check(&mut faults);
        faults.check()?;
        let least = motion.least_displacement();
        motion.innermost = least[0];
        motion.stroke = least[1] - least[0];
        if motion.stroke <= 0.0 {
            let message = "the follower stands still: there is no cam to be made";
            faults.add(
                "position",
                message,
                "give a position function with a stroke",
            );
        }
        faults.check()?;
        Ok(motion)
    }

    /// Every number finite, and the end of a whole turn where it began.
    fn check(&self, faults: &mut Faults) {
        for piece in &self.pieces {
            for step in 0..=piece.intervals {
                let phi = piece.search_place(step);
                if !self.raw(piece, phi).is_finite() {
                    let message = format!("the position function has no value at φ = {phi} rad");
                    let hint = "give the cam a `range` in which it has";
                    return faults.add("position", message, hint);
                }
            }
        }
        let (Some(first), Some(last)) = (self.pieces.first(), self.pieces.last()) else {
            return;
        };
        if !self.closed {
            return;
        }
        let (begin, end) = (self.raw(first, first.from), self.raw(last, last.to));
        let [low, high] = self.least_displacement();
        if (end.value - begin.value).abs() > CLOSED * (high - low) {
            let message = format!(
                "after a turn of the cam the follower is at {} and not at {}, where it began",
                end.value, begin.value
            );
            let hint = "give the cam a `range`, or a law that repeats with every turn";
            faults.add("position", message, hint);
        }
    }

    /// Least and greatest outward displacement, from roots of U′.
    fn least_displacement(&self) -> [f64; 2] {
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        let mut take = |value: f64| found = [found[0].min(value), found[1].max(value)];
        for piece in &self.pieces {
            let mut before = self.raw(piece, piece.from);
            take(before.value);
            for step in 1..=piece.intervals {
                let (from, to) = (piece.search_place(step - 1), piece.search_place(step));
                let after = self.raw(piece, to);
                take(after.value);
                if before.first * after.first < 0.0 {
                    let slope = |phi: f64| self.raw(piece, phi).first;
                    take(self.raw(piece, root(&slope, from, to)).value);
                }
                before = after;
            }
        }
        found
    }

    fn raw(&self, piece: &Piece, phi: f64) -> Jet {
        self.position.jet(piece.segment, phi).scaled(self.outward)
    }

    /// s, s′ and s″ at φ in a piece, carrying on the derivative of φ.
    pub fn lift<N: Number>(&self, piece: &Piece, phi: N) -> [N; 3] {
        let mut jet = self.raw(piece, phi.value());
        jet.value -= self.innermost;
        jet.lift(phi)
    }

    /// s and its first three derivatives at φ in a piece.
    pub fn jet(&self, piece: &Piece, phi: f64) -> Jet {
        let mut jet = self.raw(piece, phi);
        jet.value -= self.innermost;
        jet
    }

    /// The pieces, ascending and without gaps.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The piece that holds φ (reduced to the turn of a closed cam).
    pub fn piece_at(&self, phi: f64) -> (&Piece, f64) {
        let (from, to) = self.range();
        let phi = match self.closed {
            true => from + (phi - from).rem_euclid(to - from),
            false => phi.clamp(from, to),
        };
        let after = self.pieces.partition_point(|piece| piece.from <= phi);
        (&self.pieces[after.saturating_sub(1)], phi)
    }

    /// First and last φ.
    pub fn range(&self) -> (f64, f64) {
        (self.pieces[0].from, self.pieces[self.pieces.len() - 1].to)
    }

    /// Whether the profile closes after a turn.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// From the innermost to the outermost place.
    pub fn stroke(&self) -> f64 {
        self.stroke
    }

    /// Displacement U at the innermost place.
    pub fn innermost(&self) -> f64 {
        self.outward * self.innermost
    }

    /// Greatest |s′| and |s″| at the points of the search: sizes.
    pub fn sizes(&self) -> [f64; 2] {
        let mut sizes = [0.0f64; 2];
        for piece in &self.pieces {
            for step in 0..=piece.intervals {
                let jet = self.raw(piece, piece.search_place(step));
                sizes = [
                    sizes[0].max(jet.first.abs()),
                    sizes[1].max(jet.second.abs()),
                ];
            }
        }
        sizes
    }

    /// Pairs of neighbouring pieces with the joint between them, that of the
    /// closed turn included.
    pub fn joints(&self) -> impl Iterator<Item = (&Piece, &Piece)> + '_ {
        let inner = self.pieces.windows(2).map(|pair| (&pair[0], &pair[1]));
        let last = self.closed.then(|| {
            let last = &self.pieces[self.pieces.len() - 1];
            (last, &self.pieces[0])
        });
        inner.chain(last)
    }
}

impl Piece {
    /// The place of a point of the search, 0 … `intervals`.
    pub fn search_place(&self, step: usize) -> f64 {
        if step == 0 {
            self.from
        } else if step >= self.intervals {
            self.to
        } else {
            self.from + (self.to - self.from) * step as f64 / self.intervals as f64
        }
    }
}

/// The pieces between `from` and `to`, at every place where a derivative jumps.
/// `None`: too many.
fn pieces(position: &Position, from: f64, to: f64, lobes: f64) -> Option<Vec<Piece>> {
    let breaks = position.breaks();
    let mut edges = vec![from];
    let span = to - from;
    if !breaks.is_empty() {
        let (mut segment, mut steps) = (breaks.segment_at(from, 1.0), 0);
        loop {
            let edge = breaks.edges(segment).1;
            if edge.is_nan() || edge >= to - 1e-12 * span {
                break;
            }
            if edge > edges[edges.len() - 1] + 1e-12 * span {
                edges.push(edge);
            }
            segment += 1;
            steps += 1;
            if steps > MOST_PIECES {
                return None;
            }
        }
    }
    edges.push(to);
    let least = intervals_per_piece(edges.len() - 1);
    let search = |span: f64| {
        let smooth = (4.0 * least as f64 * lobes * span / TAU).ceil();
        (smooth as usize).max(least)
    };
    let pieces = edges
        .windows(2)
        .map(|pair| Piece {
            from: pair[0],
            to: pair[1],
            segment: breaks.segment_at(0.5 * (pair[0] + pair[1]), 1.0),
            intervals: search(pair[1] - pair[0]),
        })
        .collect();
    Some(pieces)
}

/// Intervals that each of so many pieces is searched in at least.
pub(crate) fn intervals_per_piece(pieces: usize) -> usize {
    (TOGETHER / pieces.max(1)).clamp(FEWEST, INTERVALS)
}
