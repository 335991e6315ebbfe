//! Larger Assur groups: all equations of the group by Newton's method, and
//! their transfer functions by the same matrix.
//!
//! Two equations a pair, one a coupling, three unknowns a body (its origin over a typical
//! length, its angle). The power series of the unknowns follow one order after
//! the other from one factorisation: with the coefficients up to k − 1 known
//! and the k-th set to zero, the k-th coefficient of the equations is what the
//! matrix must balance.

mod tied;

use super::dyad::Margin;
use super::elements::{Body, Element, Frame, PairElement};
use super::state::Scratch;
use super::state::State;
use super::vector::Vector;
use crate::math::linear::dense::{factorise, solve};
use crate::math::series::Series;
pub(super) use tied::PreparedJoint;

/// Most iterations from a guess of the table; two or three are usual.
const MOST_ITERATIONS: usize = 40;

/// Side of a joint of the group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Side {
    /// On something already placed.
    Known(Element),
    /// On a body of the group.
    Own {
        /// Index of the body in the group.
        body: usize,
        /// The element in the frame of the body.
        part: PairElement,
    },
}

/// A group that no closed form is kept for.
#[derive(Clone, Debug)]
pub(super) struct NewtonGroup {
    /// Bodies of the group.
    pub(super) bodies: Vec<Body>,
    /// Its joints: pairs, then couplings; their equations are three a body.
    pub(super) ties: Vec<PreparedJoint>,
}

/// The iteration did not come to an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NotConverged;

impl NewtonGroup {
    /// Places the bodies, from the guess in `scratch.unknowns` (constant terms).
    ///
    /// # Errors
    /// The iteration does not converge: not assemblable, or too bad a guess.
    pub(super) fn place_by_newton<const N: usize>(
        &self,
        state: &State,
        scratch: &mut Scratch,
        size: f64,
    ) -> Result<Margin, NotConverged> {
        let n = 3 * self.bodies.len();
        let determinant = self.solve_unknowns(state, scratch, size)?;
        for k in 1..N {
            for unknown in &mut scratch.unknowns[..n] {
                unknown[k] = 0.0;
            }
            self.equations::<N>(state, scratch, size);
            for row in 0..n {
                scratch.right[row] = -scratch.equations[row][k];
            }
            solve(
                &scratch.matrix[..n * n],
                &scratch.pivots[..n],
                &mut scratch.right[..n],
                1,
            );
            for (row, unknown) in scratch.unknowns[..n].iter_mut().enumerate() {
                let unit = if row % 3 == 2 { 1.0 } else { size };
                unknown[k] = scratch.right[row] * unit;
            }
        }
        Ok(Margin {
            value: determinant,
            slope: 0.0,
            noise: f64::EPSILON,
        })
    }

    /// The values of the unknowns; returns the determinant of the matrix.
    fn solve_unknowns(
        &self,
        state: &State,
        scratch: &mut Scratch,
        size: f64,
    ) -> Result<f64, NotConverged> {
        let n = 3 * self.bodies.len();
        let mut before = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let determinant = self.correction(state, scratch, size);
            let change = scratch.right[..n]
                .iter()
                .fold(0.0f64, |most, x| most.max(x.abs()));
            if determinant == 0.0 || !change.is_finite() {
                return Err(NotConverged);
            }
            // Steps of more than half a radian or half the size mean nothing.
            let shortened = (0.5 / change).min(1.0);
            for row in 0..n {
                let unit = if row % 3 == 2 { 1.0 } else { size };
                scratch.unknowns[row][0] += shortened * scratch.right[row] * unit;
            }
            // Far away, where guides become parallel, rounding counts for more.
            let far = (0..n).filter(|row| row % 3 != 2);
            let far = far.fold(1.0, |most: f64, row| {
                most.max(scratch.unknowns[row][0].abs() / size)
            });
            if change < 1e-15 || (change < 1e-9 * far && change >= 0.5 * before) {
                // The factors belong to a position that differs by rounding.
                return Ok(determinant);
            }
            before = change;
        }
        Err(NotConverged)
    }

    /// Factorises the matrix at the present values and leaves the Newton
    /// correction in `scratch.right`; returns the determinant.
    pub(super) fn correction(&self, state: &State, scratch: &mut Scratch, size: f64) -> f64 {
        let n = 3 * self.bodies.len();
        self.equations::<1>(state, scratch, size);
        self.matrix(state, scratch, size);
        for row in 0..n {
            scratch.right[row] = -scratch.equations[row][0];
        }
        let pivots = factorise(&mut scratch.matrix[..n * n], &mut scratch.pivots[..n]);
        let determinant = pivots.determinant;
        if determinant != 0.0 {
            solve(
                &scratch.matrix[..n * n],
                &scratch.pivots[..n],
                &mut scratch.right[..n],
                1,
            );
        }
        determinant
    }

    /// Greatest closing error at the present values, over the size.
    pub(super) fn closing_error(&self, state: &State, scratch: &mut Scratch, size: f64) -> f64 {
        self.equations::<1>(state, scratch, size);
        let n = 3 * self.bodies.len();
        scratch.equations[..n]
            .iter()
            .fold(0.0, |most, row| most.max(row[0].abs()))
    }

    /// The frame of a body as the unknowns say.
    #[inline]
    pub(super) fn frame<const N: usize>(scratch: &Scratch, body: usize) -> Frame<N> {
        let at = |k: usize| Series::load(&scratch.unknowns[3 * body + k]);
        Frame {
            at: Vector::new(at(0), at(1)),
            direction: Vector::of_angle(at(2)),
        }
    }

    /// The closing errors as series, lengths over the size.
    pub(super) fn equations<const N: usize>(
        &self,
        state: &State,
        scratch: &mut Scratch,
        size: f64,
    ) {
        let mut equations = std::mem::take(&mut scratch.equations);
        let mut top = 0;
        for tie in &self.ties {
            tie.errors::<N>(state, scratch, size, |row, error| {
                error.store(&mut equations[top + row]);
            });
            top += tie.rows();
        }
        scratch.equations = equations;
    }

    /// The derivatives of the closing errors by the unknowns.
    pub(super) fn matrix(&self, state: &State, scratch: &mut Scratch, size: f64) {
        let n = 3 * self.bodies.len();
        let mut matrix = std::mem::take(&mut scratch.matrix);
        matrix[..n * n].fill(0.0);
        let mut top = 0;
        for tie in &self.ties {
            tie.derivatives(state, scratch, size, |row, body, entries| {
                let place = (top + row) * n + 3 * body;
                for k in 0..3 {
                    matrix[place + k] += entries[k];
                }
            });
            top += tie.rows();
        }
        scratch.matrix = matrix;
    }
}
