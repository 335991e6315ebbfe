//! How the pieces of a table are found.

use super::{DEEPEST, Four, POINTS, Piece, Table};
use crate::kinematics::linkage::spec::{ForceLaw, LinkageSpec};
use crate::kinematics::linkage::{Linkage, Workspace};
use crate::math::chebyshev::{Nodes, combined, in_powers};

/// Coefficients at the end that must have died away …
const TAIL: usize = 3;
/// … to this share of the function.
const NEGLIGIBLE: f64 = 2e-14;
/// What has not died away is rounding of the linkage itself where it is no more than this …
const NOISE: f64 = 1e-11;
/// … and where half a piece still has this part of it: what a smooth function leaves over is
/// divided by thousands.
const STAYS: f64 = 0.125;
/// Share of the greatest value that counts where a function is small.
const SMALL: f64 = 1e-2;
/// Most positions that are solved for the whole.
const MOST_POSITIONS: usize = 30_000;
/// Where what should have died away is more than this share, halves will not do
/// either: halving divides it by 2^13 at most.
const HOPELESS: f64 = 1e-8;
/// Pieces at first.
const FIRST: u32 = 3;

type Coefficients = [f64; POINTS];

/// Whether all forces are the same after one period: no spring winds up, and
/// none is a table over the input.
pub(super) fn forces_repeat(linkage: &Linkage, start: f64, span: f64) -> bool {
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
        ForceLaw::Table { .. } | ForceLaw::CoupleTable { .. } => false,
        ForceLaw::Strut { .. } | ForceLaw::Force { .. } | ForceLaw::Couple { .. } => true,
    })
}

/// Gain of an output in a period; `None` where that cannot be told.
pub(super) fn period_of_outputs(linkage: &Linkage, output: usize, ends: [f64; 2]) -> Option<f64> {
    let mut workspace = linkage.workspace();
    let mut value = |q: f64| -> Option<f64> {
        linkage.solve(q, 0, &mut workspace).ok()?;
        Some(linkage.output(output, &workspace).value)
    };
    let gain = value(ends[1])? - value(ends[0])?;
    gain.is_finite().then_some(gain)
}

/// Functions at the points of a piece: J, W, D, and U′ of the outputs; U in its
/// centre.
struct Sample {
    functions: Vec<Coefficients>,
    centre: Vec<f64>,
}

/// Finds the pieces.
pub(super) struct Builder<'a> {
    linkage: &'a Linkage,
    outputs: &'a [usize],
    workspace: Workspace,
    table: &'a mut Table,
    /// The points, and T_k in powers.
    nodes: Nodes<POINTS>,
    powers: [Coefficients; POINTS],
    /// Greatest of every function met.
    sizes: Vec<f64>,
    positions: usize,
}

impl<'a> Builder<'a> {
    pub(super) fn new(linkage: &'a Linkage, outputs: &'a [usize], table: &'a mut Table) -> Self {
        Self {
            linkage,
            outputs,
            workspace: linkage.workspace(),
            table,
            nodes: Nodes::new(),
            powers: in_powers([0.0, 1.0]),
            sizes: vec![0.0; 3 + outputs.len()],
            positions: 0,
        }
    }

    pub(super) fn build(&mut self) {
        // All sizes first, so that every piece is judged by the same.
        let whole: Vec<_> = (0..1 << FIRST)
            .map(|piece| self.sample(FIRST, piece))
            .collect();
        for (piece, sampled) in (0..).zip(whole) {
            self.fit_piece(FIRST, piece, sampled, f64::INFINITY);
        }
    }

    /// Interpolates piece number `piece` of 2^`depth`, or divides it; `before` is what the piece
    /// that it is a half of left over.
    fn fit_piece(&mut self, depth: u32, piece: u32, sampled: Option<Sample>, before: f64) {
        let (centre, half) = self.centre_and_half_width(depth, piece);
        let left_over = match sampled.map(|sampled| self.interpolated(half, &sampled, before)) {
            Some(Ok(found)) => {
                let number = self.table.pieces.len() as u16;
                let finest = 1usize << (DEEPEST - depth);
                let from = piece as usize * finest;
                self.table.index[from..from + finest].fill(number);
                let scale = 1.0 / half;
                self.table.pieces.push(Piece { centre, scale });
                self.table.fours.extend(found);
                return;
            }
            Some(Err(left_over)) => left_over,
            // Where it cannot be assembled, halves are tried as they are.
            None => f64::INFINITY,
        };
        let wanted = if left_over.is_finite() && left_over > HOPELESS {
            2
        } else {
            1
        };
        let levels = wanted.min(DEEPEST - depth);
        for part in 0..(1 << levels) {
            if levels > 0 && self.positions < MOST_POSITIONS {
                let (depth, piece) = (depth + levels, (piece << levels) + part);
                let sampled = self.sample(depth, piece);
                self.fit_piece(depth, piece, sampled, left_over);
            }
        }
    }

    /// Centre (from the table's start) and half width of a piece.
    fn centre_and_half_width(&self, depth: u32, piece: u32) -> (f64, f64) {
        let half = 0.5 * self.table.span / f64::from(1u32 << depth);
        (half * f64::from(2 * piece + 1), half)
    }

    /// All functions at the points of a piece.
    fn sample(&mut self, depth: u32, piece: u32) -> Option<Sample> {
        let (centre, half) = self.centre_and_half_width(depth, piece);
        let (linkage, workspace) = (self.linkage, &mut self.workspace);
        let mut functions = vec![[0.0; POINTS]; self.sizes.len()];
        self.positions += POINTS;
        for (j, x) in self.nodes.places.iter().enumerate() {
            let q = self.table.start + centre + half * x;
            // J′ is that of the polynomial.
            linkage.solve(q, 1, workspace).ok()?;
            let reduced = linkage.reduced_linkage(workspace);
            let values = [
                reduced.inertia[0],
                reduced.force[0] - reduced.potential[1],
                reduced.damping[0],
            ];
            let outputs = self.outputs.iter();
            let outputs = outputs.map(|&output| linkage.output(output, workspace).first);
            for (k, value) in values.into_iter().chain(outputs).enumerate() {
                value.is_finite().then_some(())?;
                functions[k][j] = value;
                self.sizes[k] = self.sizes[k].max(value.abs());
            }
        }
        let middle = self.table.start + centre;
        if !self.outputs.is_empty() {
            linkage.solve(middle, 0, workspace).ok()?;
        }
        let outputs = self.outputs.iter();
        let centre = outputs.map(|&output| linkage.output(output, workspace).value);
        Some(Sample {
            functions,
            centre: centre.collect(),
        })
    }

    /// The polynomials of a piece, or the greatest share of a function that has
    /// not died away.
    fn interpolated(&self, half: f64, sampled: &Sample, before: f64) -> Result<Vec<Four>, f64> {
        let mut found = vec![[0.0; POINTS]; self.sizes.len()];
        let mut left_over = 0.0f64;
        for (k, values) in sampled.functions.iter().enumerate() {
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
                let mut coefficients = self.nodes.polynomial_through(values);
                for c in &coefficients[POINTS - TAIL..] {
                    let share = c.abs() / size;
                    // Not a number counts as too much.
                    left_over = left_over.max(if share.is_nan() { 1.0 } else { share });
                }
                if k > 2 {
                    // Its integral must not have one power more.
                    coefficients[POINTS - 1] = 0.0;
                }
                found[k] = combined(&coefficients, &self.powers);
            }
        }
        let is_noise = before <= NOISE && (STAYS * before..=NOISE).contains(&left_over);
        if !(left_over <= NEGLIGIBLE || is_noise) {
            return Err(left_over);
        }
        let slope = differentiated(&found[0], half);
        let mut fours = vec![Four::new([&found[0], &slope, &found[1], &found[2]])];
        for (first, middle) in found[3..].iter().zip(&sampled.centre) {
            let second = differentiated(first, half);
            let third = differentiated(&second, half);
            let value = integrated(first, half, *middle);
            fours.push(Four::new([&value, first, &second, &third]));
        }
        Ok(fours)
    }
}

/// The derivative by the input of a polynomial in x, over a piece of a half width.
fn differentiated(polynomial: &Coefficients, half: f64) -> Coefficients {
    std::array::from_fn(|power| match polynomial.get(power + 1) {
        Some(next) => (power + 1) as f64 * next / half,
        None => 0.0,
    })
}

/// The integral of a polynomial of one power less, with its value at x = 0.
fn integrated(polynomial: &Coefficients, half: f64, middle: f64) -> Coefficients {
    std::array::from_fn(|power| match power {
        0 => middle,
        _ => half * polynomial[power - 1] / power as f64,
    })
}
