//! Velocities and accelerations of larger groups, by the matrix of their closing equations.

use super::columns::Columns;
use super::plan::{Group, MultiPlan};
use super::tied::TiedBodies;
use super::twist::{Twist, dot};
use crate::math::linear::dense;
use crate::math::number::Number;

impl<N: Number> Columns<N> {
    /// Velocities of a larger group's bodies by each input; false in a singular position.
    pub(super) fn find_group(&mut self, plan: &MultiPlan, index: usize, group: &Group) -> bool {
        let n = 3 * group.bases.len();
        let mut matrix = std::mem::take(&mut self.matrices);
        let mut exchanged = std::mem::take(&mut self.exchanged);
        let own = &mut matrix[group.matrix..group.matrix + n * n];
        let mut parts = self.rows[index].as_mut_slice();
        for tie in &group.ties {
            let (first, rest) = parts.split_at_mut(tie.rows());
            tie.write_equations(&self.poses, plan.plan.size, first);
            parts = rest;
        }
        self.closing(index, group, own);
        let rows = &mut exchanged[group.exchanged..group.exchanged + n];
        let pivots = dense::factorise(own, rows);
        let regular = pivots.is_regular();
        self.determinants[index] = pivots.determinant;
        (self.matrices, self.exchanged) = (matrix, exchanged);
        if !regular {
            return false;
        }
        for &input in &group.active {
            let inner = group.inner.as_ref().filter(|inner| inner.input == input);
            let own = inner.map(|_| self.screws[input]);
            let known = |columns: &Self, body: usize| match group.body_of(body) {
                None => Some(columns.column(plan, body, input)),
                Some(_) => own.filter(|_| group.is_driven(body)),
            };
            self.balance(plan, (index, group), &known, |_, _| [N::from(0.0); 3]);
            let found = self.solve_group(group);
            self.store_velocities(plan, group, input, found, own);
        }
        true
    }

    /// The matrix of the closing equations.
    fn closing(&self, index: usize, group: &Group, matrix: &mut [N]) {
        let n = 3 * group.bases.len();
        matrix.fill(N::from(0.0));
        let mut top = 0;
        for tie in &group.ties {
            for (link, &body) in tie.bodies().iter().enumerate() {
                let Some(body) = group.body_of(body) else {
                    continue;
                };
                for row in top..top + tie.rows() {
                    let (place, parts) = (row * n + 3 * body, &self.rows[index][row][link]);
                    for k in 0..3 {
                        matrix[place + k] += parts[k];
                    }
                }
            }
            top += tie.rows();
        }
    }

    /// Sets the right sides, some bodies' motion being `known`, and what else stands in the
    /// equations of a joint (`drift`).
    #[inline]
    fn balance(
        &mut self,
        plan: &MultiPlan,
        (index, group): (usize, &Group),
        known: &dyn Fn(&Self, usize) -> Option<Twist<N>>,
        drift: impl Fn(&Self, &TiedBodies) -> [N; 3],
    ) {
        let scale = plan.plan.size.recip();
        let mut top = 0;
        for tie in &group.ties {
            let mut sums = drift(self, tie);
            for (link, &body) in tie.bodies().iter().enumerate() {
                let Some([turning, x, y]) = known(self, body) else {
                    continue;
                };
                let given = [turning, x.scale(scale), y.scale(scale)];
                for row in 0..tie.rows() {
                    sums[row] += dot(&self.rows[index][top + row][link], &given);
                }
            }
            for row in 0..tie.rows() {
                self.right[top + row] = -sums[row];
            }
            top += tie.rows();
        }
    }

    /// Solves for the velocities of a larger group's bodies; they are left in the right side.
    fn solve_group(&mut self, group: &Group) -> usize {
        let n = 3 * group.bases.len();
        let factors = &self.matrices[group.matrix..group.matrix + n * n];
        let exchanged = &self.exchanged[group.exchanged..group.exchanged + n];
        dense::solve(factors, exchanged, &mut self.right[..n], 1);
        n
    }

    /// Notes what was solved for as velocities by an input.
    fn store_velocities(
        &mut self,
        plan: &MultiPlan,
        group: &Group,
        input: usize,
        n: usize,
        own: Option<Twist<N>>,
    ) {
        let size = plan.plan.size;
        for (number, &body) in group.bases.iter().enumerate() {
            let part = &self.right[..n][3 * number..3 * number + 3];
            let twist = [part[0], part[1].scale(size), part[2].scale(size)];
            self.columns[body * plan.inputs + input] = twist;
        }
        self.set_columns(plan, group, input, &[], own);
    }

    /// Accelerations of a larger group's bodies while those of the inputs are zero; `inner`: what
    /// the rate of the input inside it makes.
    pub(super) fn accelerate_group(
        &mut self,
        plan: &MultiPlan,
        index: usize,
        group: &Group,
        inner: Option<Twist<N>>,
    ) {
        let size = plan.plan.size;
        let known = |columns: &Self, body: usize| match group.body_of(body) {
            None => Some(columns.acceleration[body]),
            Some(_) => inner.filter(|_| group.is_driven(body)),
        };
        self.balance(plan, (index, group), &known, |columns, tie| {
            tie.drift(&columns.poses, &columns.velocity, size)
        });
        let n = self.solve_group(group);
        for (number, &body) in group.bases.iter().enumerate() {
            let part = &self.right[..n][3 * number..3 * number + 3];
            self.acceleration[body] = [part[0], part[1].scale(size), part[2].scale(size)];
        }
    }
}
