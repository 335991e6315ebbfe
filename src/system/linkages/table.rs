//! A linkage over its input as polynomials, for the right-hand side.
//!
//! The reduced inertia J, the force W = Q − V′ and the damping D are smooth
//! functions of the input coordinate, and the equations of motion ask for nothing
//! else unless something hangs on an output. They are interpolated once, piece by
//! piece, at Chebyshev's points to rounding; where that does not succeed (a kink
//! of a force, the neighbourhood of a dead position) the linkage is solved as
//! anywhere else. The derivatives are those of the polynomials, so that energy is
//! kept as well as with the functions themselves.

use crate::linkage::spec::{ForceLaw, LinkageSpec};
use crate::linkage::{Linkage, Reach, Reduced, Workspace};
use std::cell::Cell;
use std::f64::consts::PI;

/// Points of an interpolation, one more than the degree.
const POINTS: usize = 4 * FOURS;
const FOURS: usize = 4;
/// Coefficients at the end that must have died away …
const TAIL: usize = 3;
/// … to this share of the function.
const NEGLIGIBLE: f64 = 2e-14;
/// Share of the greatest value that counts where a function is small.
const SMALL: f64 = 1e-2;
/// The finest pieces are the whole over two to this power.
const DEEPEST: u32 = 10;
/// Most positions that are solved for the whole.
const MOST_POSITIONS: usize = 30_000;
/// Where what should have died away is more than this share, halves will not do
/// either: halving divides it by 2^13 at most.
const HOPELESS: f64 = 1e-8;
/// Pieces at first.
const FIRST: u32 = 3;
/// No piece: the linkage is solved.
const NONE: u16 = u16::MAX;

type Coefficients = [f64; POINTS];

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
}

/// Polynomials in x = (place − centre)·scale for J, J′, W and D side by side,
/// lowest power first, four powers together: the lanes of the first, of the
/// second, …
#[derive(Clone, Debug)]
pub(super) struct Piece {
    centre: f64,
    scale: f64,
    fours: [[f64; 16]; FOURS],
}

/// J, J′, W, D.
pub(super) type Lanes = [f64; 4];

impl Table {
    /// The table of a linkage; `None` when its input goes on for ever without
    /// repeating, or a force does not repeat with it.
    pub(super) fn new(linkage: &Linkage) -> Option<Self> {
        let range = linkage.range();
        let (start, span, periodic) = match (&range.period, &range.reach) {
            (Some(period), Reach::Everywhere) => (range.start, period.length, true),
            (None, Reach::Interval { lower, upper }) => (lower.at, upper.at - lower.at, false),
            _ => return None,
        };
        if !span.is_finite() || (periodic && !repeats(linkage, start, span)) {
            return None;
        }
        let mut table = Self {
            start,
            span,
            periodic,
            index: vec![NONE; 1 << DEEPEST],
            pieces: Vec::new(),
        };
        Builder::new(linkage, &mut table).build();
        (!table.pieces.is_empty()).then_some(table)
    }

    /// The piece at an input and the place on it; `None` where there is none. The
    /// cursor says which piece was found last, and is moved.
    #[inline]
    pub(super) fn locate(&self, q: f64, cursor: &Cell<Cursor>) -> Option<(&Piece, f64)> {
        let last = cursor.get();
        let piece = self.pieces.get(last.piece)?;
        let x = (q - last.centre) * piece.scale;
        if x.abs() <= 1.0 {
            return Some((piece, x));
        }
        let found = self.search(q)?;
        cursor.set(found);
        let piece = &self.pieces[found.piece];
        Some((piece, (q - found.centre) * piece.scale))
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
        Some(Cursor { piece, centre })
    }
}

/// The piece that was found last; none at first.
#[derive(Clone, Copy, Debug)]
pub(in crate::system) struct Cursor {
    piece: usize,
    /// The input at its centre, all turns counted.
    centre: f64,
}

impl Default for Cursor {
    fn default() -> Self {
        Self {
            piece: 0,
            centre: f64::NAN,
        }
    }
}

impl Piece {
    /// Values of all polynomials (G. Estrin's scheme): whatever does not wait for
    /// anything else the processor takes side by side.
    #[inline]
    pub(super) fn values(&self, x: f64) -> Lanes {
        let square = x * x;
        let fourth = square * square;
        let eighth = fourth * fourth;
        let [a, b, c, d] = &self.fours;
        let mut sums = [0.0; 16];
        for i in 0..16 {
            sums[i] = (a[i] + fourth * b[i]) + eighth * (c[i] + fourth * d[i]);
        }
        std::array::from_fn(|lane| {
            let low = sums[lane] + x * sums[4 + lane];
            low + square * (sums[8 + lane] + x * sums[12 + lane])
        })
    }

    /// Their derivatives by the input.
    pub(super) fn slopes(&self, x: f64) -> Lanes {
        let (mut value, mut first) = ([0.0; 4], [0.0; 4]);
        for c in self.fours.as_flattened().rchunks_exact(4) {
            for lane in 0..4 {
                first[lane] = first[lane] * x + value[lane];
                value[lane] = value[lane] * x + c[lane];
            }
        }
        first.map(|first| first * self.scale)
    }
}

/// Whether all forces are the same after one period: no spring winds up, and
/// none is a table over the input.
fn repeats(linkage: &Linkage, start: f64, span: f64) -> bool {
    let mut workspace = linkage.workspace();
    let mut coordinates = |q: f64| -> Option<Vec<f64>> {
        linkage.solve(q, 0, &mut workspace).ok()?;
        let pairs = 0..linkage.spec().pairs.len();
        Some(pairs.map(|pair| workspace.pair(pair).value).collect())
    };
    let (Some(before), Some(after)) = (coordinates(start), coordinates(start + span)) else {
        return false;
    };
    let spec: &LinkageSpec = linkage.spec();
    spec.forces.iter().all(|force| match force.law {
        ForceLaw::Torsion { pair, rate, .. } => {
            rate == 0.0 || (after[pair] - before[pair]).abs() < 1e-9
        }
        ForceLaw::Table { .. } => false,
        ForceLaw::Strut { .. } | ForceLaw::Force { .. } | ForceLaw::Couple { .. } => true,
    })
}

struct Builder<'a> {
    linkage: &'a Linkage,
    workspace: Workspace,
    table: &'a mut Table,
    /// Chebyshev's points, T_k there, and the coefficients of T_k.
    points: [f64; POINTS],
    values: [Coefficients; POINTS],
    powers: [Coefficients; POINTS],
    /// Greatest |J|, |W| and |D| met.
    sizes: [f64; 3],
    positions: usize,
}

impl<'a> Builder<'a> {
    fn new(linkage: &'a Linkage, table: &'a mut Table) -> Self {
        let angle = |j: usize| PI * (j as f64 + 0.5) / POINTS as f64;
        Self {
            linkage,
            workspace: linkage.workspace(),
            table,
            points: std::array::from_fn(|j| angle(j).cos()),
            values: std::array::from_fn(|k| std::array::from_fn(|j| (k as f64 * angle(j)).cos())),
            powers: powers(),
            sizes: [0.0; 3],
            positions: 0,
        }
    }

    fn build(&mut self) {
        // All sizes first, so that every piece is judged by the same.
        let whole: Vec<_> = (0..1 << FIRST)
            .map(|piece| self.sample(FIRST, piece))
            .collect();
        for (piece, sampled) in (0..).zip(whole) {
            self.fit(FIRST, piece, sampled);
        }
    }

    /// Interpolates piece number `piece` of 2^`depth`, or divides it.
    fn fit(&mut self, depth: u32, piece: u32, sampled: Option<[Coefficients; 3]>) {
        let left_over = match sampled.map(|sampled| self.interpolated(depth, piece, &sampled)) {
            Some(Ok(found)) => {
                let number = self.table.pieces.len() as u16;
                let finest = 1usize << (DEEPEST - depth);
                let from = piece as usize * finest;
                self.table.index[from..from + finest].fill(number);
                self.table.pieces.push(found);
                return;
            }
            Some(Err(left_over)) => left_over,
            None => 0.0,
        };
        let wanted = if left_over > HOPELESS { 2 } else { 1 };
        let levels = wanted.min(DEEPEST - depth);
        for part in 0..(1 << levels) {
            if levels > 0 && self.positions < MOST_POSITIONS {
                let (depth, piece) = (depth + levels, (piece << levels) + part);
                let sampled = self.sample(depth, piece);
                self.fit(depth, piece, sampled);
            }
        }
    }

    /// Centre (from the table's start) and half width of a piece.
    fn place(&self, depth: u32, piece: u32) -> (f64, f64) {
        let half = 0.5 * self.table.span / f64::from(1u32 << depth);
        (half * f64::from(2 * piece + 1), half)
    }

    /// J, W and D at the points of a piece.
    fn sample(&mut self, depth: u32, piece: u32) -> Option<[Coefficients; 3]> {
        let (centre, half) = self.place(depth, piece);
        let mut sampled = [[0.0; POINTS]; 3];
        self.positions += POINTS;
        for (j, x) in self.points.iter().enumerate() {
            let q = self.table.start + centre + half * x;
            // J′ is that of the polynomial.
            self.linkage.solve(q, 1, &mut self.workspace).ok()?;
            let reduced: Reduced = self.linkage.reduced(&self.workspace);
            let values = [
                reduced.inertia[0],
                reduced.force[0] - reduced.potential[1],
                reduced.damping[0],
            ];
            for (k, value) in values.into_iter().enumerate() {
                value.is_finite().then_some(())?;
                sampled[k][j] = value;
                self.sizes[k] = self.sizes[k].max(value.abs());
            }
        }
        Some(sampled)
    }

    /// The polynomials of a piece, or the greatest share of a function that has
    /// not died away.
    fn interpolated(
        &self,
        depth: u32,
        piece: u32,
        sampled: &[Coefficients; 3],
    ) -> Result<Piece, f64> {
        let (centre, half) = self.place(depth, piece);
        let mut found = [[0.0; POINTS]; 3];
        let mut left_over = 0.0f64;
        for (k, values) in sampled.iter().enumerate() {
            let own = values
                .iter()
                .fold(0.0f64, |size, value| size.max(value.abs()));
            // The inertia divides: it counts by itself.
            let size = if k == 0 {
                own
            } else {
                own.max(SMALL * self.sizes[k])
            };
            if size > 0.0 {
                let coefficients = self.chebyshev(values);
                for c in &coefficients[POINTS - TAIL..] {
                    let share = c.abs() / size;
                    // Not a number counts as too much.
                    left_over = left_over.max(if share.is_nan() { 1.0 } else { share });
                }
                found[k] = self.in_powers(&coefficients);
            }
        }
        if !(left_over <= NEGLIGIBLE) {
            return Err(left_over);
        }
        let [inertia, force, damping] = found;
        let slope = |power: usize| match inertia.get(power + 1) {
            Some(next) => (power + 1) as f64 * next / half,
            None => 0.0,
        };
        Ok(Piece {
            centre,
            scale: 1.0 / half,
            fours: std::array::from_fn(|four| {
                std::array::from_fn(|place| {
                    let power = 4 * four + place / 4;
                    [inertia[power], slope(power), force[power], damping[power]][place % 4]
                })
            }),
        })
    }

    /// Coefficients of T_k.
    fn chebyshev(&self, values: &Coefficients) -> Coefficients {
        std::array::from_fn(|k| {
            let sum: f64 = (self.values[k].iter().zip(values))
                .map(|(t, f)| t * f)
                .sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / POINTS as f64
        })
    }

    /// From coefficients of T_k to those of powers.
    fn in_powers(&self, chebyshev: &Coefficients) -> Coefficients {
        let mut out = [0.0; POINTS];
        for (c, powers) in chebyshev.iter().zip(&self.powers) {
            for (out, t) in out.iter_mut().zip(powers) {
                *out += c * t;
            }
        }
        out
    }
}

/// Coefficients of T_k: T_{k+1} = 2x·T_k − T_{k−1}.
fn powers() -> [Coefficients; POINTS] {
    let mut all = [[0.0; POINTS]; POINTS];
    all[0][0] = 1.0;
    all[1][1] = 1.0;
    for k in 1..POINTS - 1 {
        all[k + 1] = all[k - 1].map(|t| -t);
        for power in 1..POINTS {
            all[k + 1][power] += 2.0 * all[k][power - 1];
        }
    }
    all
}

#[cfg(test)]
#[path = "table_tests.rs"]
mod tests;
