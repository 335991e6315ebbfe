//! Velocities and accelerations of larger groups, by the matrix of their closing equations.

use super::columns::Columns;
use super::plan::{Group, MultiPlan, Screw};
use super::twist::{Twist, plus};
use crate::math::linear::dense;
use crate::math::number::Number;

impl<N: Number> Columns<N> {
    /// Velocities of a larger group's bodies by each input; false in a singular position.
    pub(super) fn find_group(&mut self, plan: &MultiPlan, index: usize, group: &Group) -> bool {
        let n = 3 * group.bases.len();
        let mut matrix = std::mem::take(&mut self.matrices);
        let mut exchanged = std::mem::take(&mut self.exchanged);
        let own = &mut matrix[group.matrix..group.matrix + n * n];
        let parts = &mut self.couplings[index];
        for (parts, coupling) in parts.iter_mut().zip(&group.couplings) {
            *parts = coupling.parts(&self.poses, plan.plan.size);
        }
        self.closing(plan, index, group, own);
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
            self.right[..n].fill(N::from(0.0));
            let known = |columns: &Self, body: usize| match group.body_of(body) {
                None => Some(columns.column(plan, body, input)),
                Some(_) => own.filter(|_| group.is_driven(body)),
            };
            for (number, screw) in group.screws.iter().enumerate() {
                let mut given = [N::from(0.0); 3];
                for (side, sign) in [(0, -1.0), (1, 1.0)] {
                    if let Some(part) = known(self, screw.sides[side]) {
                        given = plus(given, part.map(|part| part.scale(sign)));
                    }
                }
                self.balance(number, screw, plan.plan.size.recip(), given);
            }
            for number in 0..group.couplings.len() {
                self.balance_coupling(plan, (index, number), group, &known, N::from(0.0));
            }
            let found = self.solve_group(group);
            self.spread(plan, group, input, found, own);
        }
        true
    }

    /// The matrix of the closing equations: two rows a pair, then one a coupling.
    fn closing(&self, plan: &MultiPlan, index: usize, group: &Group, matrix: &mut [N]) {
        let n = 3 * group.bases.len();
        matrix.fill(N::from(0.0));
        for (number, screw) in group.screws.iter().enumerate() {
            for (side, sign) in [(0, -1.0), (1, 1.0)] {
                let Some(body) = group.body_of(screw.sides[side]) else {
                    continue;
                };
                let parts = self.equations(screw, plan.plan.size.recip());
                for (unknown, entry) in parts.into_iter().enumerate() {
                    for (row, part) in entry.into_iter().enumerate() {
                        matrix[(2 * number + row) * n + 3 * body + unknown] += part.scale(sign);
                    }
                }
            }
        }
        for (number, parts) in self.couplings[index].iter().enumerate() {
            let top = (2 * group.screws.len() + number) * n;
            for &(body, parts) in parts {
                let Some(body) = group.body_of(body) else {
                    continue;
                };
                for (unknown, part) in parts.into_iter().enumerate() {
                    matrix[top + 3 * body + unknown] += part;
                }
            }
        }
    }

    /// The two equations of a pair of a larger group: what each part of a relative
    /// velocity (ω, v over the size) contributes to them.
    #[inline]
    fn equations(&self, screw: &Screw, scale: f64) -> [[N; 2]; 3] {
        let pose = &self.poses[screw.owner];
        let [x, y] = pose.place(screw.point).map(|part| part.scale(scale));
        let (zero, one) = (N::from(0.0), N::from(1.0));
        match screw.slides {
            // No turning, and no velocity across the guide.
            true => {
                let [u, v] = pose.turn(screw.along);
                [[one, u * x + v * y], [zero, -v], [zero, u]]
            }
            false => [[-y, x], [one, zero], [zero, one]],
        }
    }

    /// Sets the right sides of a pair's equations, the relative velocity known in part.
    #[inline]
    fn balance(&mut self, number: usize, screw: &Screw, scale: f64, given: Twist<N>) {
        let parts = self.equations(screw, scale);
        let given = [given[0], given[1].scale(scale), given[2].scale(scale)];
        for row in 0..2 {
            let sum =
                parts[0][row] * given[0] + parts[1][row] * given[1] + parts[2][row] * given[2];
            self.right[2 * number + row] = -sum;
        }
    }

    /// Sets the right side of a coupling's equation, some bodies' motion being `known`, and
    /// what else stands in it (`drift`).
    #[inline]
    fn balance_coupling(
        &mut self,
        plan: &MultiPlan,
        (index, number): (usize, usize),
        group: &Group,
        known: &dyn Fn(&Self, usize) -> Option<Twist<N>>,
        drift: N,
    ) {
        let scale = plan.plan.size.recip();
        let mut sum = drift;
        for &(body, [turning, x, y]) in &self.couplings[index][number] {
            if let Some(given) = known(self, body) {
                sum += turning * given[0];
                sum += (x * given[1] + y * given[2]).scale(scale);
            }
        }
        self.right[2 * group.screws.len() + number] = -sum;
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
    fn spread(
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
        for (number, screw) in group.screws.iter().enumerate() {
            let at = self.screw_of(screw);
            let mut given = self.change(screw, &at).map(|part| -part);
            for (side, sign) in [(0, -1.0), (1, 1.0)] {
                if let Some(part) = known(self, screw.sides[side]) {
                    given = plus(given, part.map(|part| part.scale(sign)));
                }
            }
            self.balance(number, screw, size.recip(), given);
        }
        for (number, coupling) in group.couplings.iter().enumerate() {
            let drift = coupling.drift(&self.poses, &self.velocity, size);
            self.balance_coupling(plan, (index, number), group, &known, drift);
        }
        let n = self.solve_group(group);
        for (number, &body) in group.bases.iter().enumerate() {
            let part = &self.right[..n][3 * number..3 * number + 3];
            self.acceleration[body] = [part[0], part[1].scale(size), part[2].scale(size)];
        }
    }
}
