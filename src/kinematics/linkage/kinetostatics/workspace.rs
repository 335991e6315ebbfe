//! Memory for one position, kept from position to position.

use super::friction::{Law, Term};
use super::held_pairs::SeveralForces;
use super::positions::{LinkPosition, PointPosition};
use crate::math::linear::Factors;

/// Place of a pair, and how it slides.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PairPlace {
    /// The pin, or the block's reference point (m).
    pub(super) point: [f64; 2],
    /// Direction of the guide.
    pub(super) tangent: [f64; 2],
    /// Relative coordinate; filled in for torsion springs only.
    pub(super) coordinate: f64,
    /// First three derivatives of its coordinate by the input coordinate.
    pub(super) rates: [f64; 3],
    /// Sign of the sliding just after the position: −1, 0 or 1.
    pub(super) sense: f64,
}

/// Memory of [`super::Kinetostatics`]: what was found at the last position.
#[derive(Clone, Debug, Default)]
pub struct ForceWorkspace {
    pub(super) links: Vec<LinkPosition>,
    /// Centres of mass.
    pub(super) centres: Vec<PointPosition>,
    pub(super) pairs: Vec<PairPlace>,
    /// P, in rows.
    pub(super) applied: Vec<f64>,
    /// Generalised force of each link's weight.
    pub(super) weights: Vec<f64>,
    /// Generalised force of each of the spec's forces.
    pub(super) forces: Vec<f64>,
    /// Forces of what hangs on the outputs, along each (N·m or N).
    pub(super) output_loads: Vec<f64>,
    /// The same along the input coordinate.
    pub(super) output_forces: Vec<f64>,
    /// Inertia that moves with each output (kg·m² or kg).
    pub(super) output_inertias: Vec<f64>,
    /// Rows of that inertia per unit of the input's acceleration, and at constant
    /// speed of the input per its square; empty without any.
    pub(super) carried: [Vec<f64>; 2],
    /// Rows of a unit of the driver's force.
    pub(super) drive_rows: Vec<f64>,
    /// W.
    pub(super) factors: Factors,
    /// F₀ and K side by side, row after row: 1 + `columns` wide.
    pub(super) right: Vec<f64>,
    pub(super) terms: Vec<Term>,
    /// Number of τ.
    pub(super) columns: usize,
    /// F.
    pub(super) unknowns: Vec<f64>,
    /// τ.
    pub(super) friction: Vec<f64>,
    /// τ of the iteration's next step.
    pub(super) next: Vec<f64>,
    /// Greatest of F₀, the unknowns without friction.
    pub(super) bare: f64,
    /// Matrix of Newton's method.
    pub(super) small: Factors,
    /// Driver's forces, or accelerations, of the other solutions found.
    pub(super) others: Vec<f64>,
    pub(super) scratch: [Vec<f64>; 2],
    /// What belongs to several inputs that move freely.
    pub(super) several: SeveralForces,
    /// Input at the last position.
    pub(super) speed: f64,
    /// Sign of its motion just after that position, also from rest.
    pub(super) direction: f64,
    pub(super) acceleration: f64,
    /// The driver's force (N·m or N); of several inputs the power of all drivers (W), their
    /// force along the time.
    pub(super) drive: f64,
    /// The force of every driver (N·m or N).
    pub(super) drives: Vec<f64>,
    /// Of several inputs: Σ |rate| times the length that a unit of each stands for (m/s).
    pub(super) pace: f64,
}

impl ForceWorkspace {
    /// Memory for `links` links, `pairs` pairs, `forces` forces, `outputs` outputs and
    /// `idle` unknowns that are zero.
    pub(super) fn with_room([links, pairs, forces, outputs, idle]: [usize; 5]) -> Self {
        let size = 3 * links + idle;
        let most = 2 * pairs;
        Self {
            links: vec![LinkPosition::GROUND; links],
            centres: vec![PointPosition::default(); links],
            pairs: vec![PairPlace::default(); pairs],
            applied: vec![0.0; size],
            weights: vec![0.0; links],
            forces: vec![0.0; forces],
            output_loads: vec![0.0; outputs],
            output_forces: vec![0.0; outputs],
            output_inertias: vec![0.0; outputs],
            carried: [Vec::with_capacity(size), Vec::with_capacity(size)],
            drive_rows: vec![0.0; size],
            factors: Factors::with_room(size),
            right: Vec::with_capacity(size * (1 + most)),
            terms: Vec::with_capacity(pairs),
            unknowns: vec![0.0; size],
            // As many as there are inputs.
            drives: Vec::with_capacity(size.saturating_sub(most)),
            friction: Vec::with_capacity(most),
            next: Vec::with_capacity(most),
            bare: 0.0,
            small: Factors::with_room(most),
            scratch: [
                Vec::with_capacity(size.max(most * most)),
                Vec::with_capacity(size),
            ],
            ..Self::default()
        }
    }

    /// Width of the right sides.
    #[inline]
    pub(super) fn width(&self) -> usize {
        1 + self.columns
    }

    /// Column `column` of K in row `row`.
    #[inline]
    pub(super) fn k(&self, row: usize, column: usize) -> f64 {
        self.right[row * (1 + self.columns) + 1 + column]
    }

    /// Adds the friction of a pair.
    pub(super) fn add_term(&mut self, pair: usize, law: Law) {
        let term = Term {
            unknown: 2 * pair,
            column: self.columns,
            law,
            pressed: None,
        };
        self.columns += term.width();
        self.terms.push(term);
    }

    /// F = F₀ − K·τ with `tau` in place of τ; the greatest change of F.
    pub(super) fn react(&mut self) -> f64 {
        let width = self.width();
        let mut change = 0.0f64;
        for (unknown, row) in self.unknowns.iter_mut().zip(self.right.chunks_exact(width)) {
            let mut sum = row[0];
            for (k, tau) in row[1..].iter().zip(&self.friction) {
                sum -= k * tau;
            }
            let difference = (sum - *unknown).abs();
            // A number that is not one must not be lost in `max`.
            if !(difference <= change) {
                change = difference;
            }
            *unknown = sum;
        }
        change
    }

    /// `next` = friction that belongs to the reactions F.
    #[inline]
    pub(super) fn update_friction(&mut self) {
        for term in &self.terms {
            term.friction(&self.unknowns, &mut self.next);
        }
    }

    /// Greatest magnitude among the unknowns.
    pub(super) fn greatest_magnitude(&self) -> f64 {
        self.unknowns
            .iter()
            .fold(0.0, |most: f64, value| most.max(value.abs()))
    }
}
