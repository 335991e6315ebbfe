//! How far a group is from a singular position, with derivatives by the inputs and in time.
//!
//! A group is in a singular position where the determinant D of its closing equations
//! vanishes: what it hangs on may stand still while it moves. Where the two assemblies of a
//! group meet there, D goes with the root of the distance in the inputs, and D² is smooth;
//! where its guides become parallel, D itself is. Its first derivatives follow from those of
//! the screws, by Jacobi's formula where there are many equations:
//! D′ = D·tr(A⁻¹A′), D″ = D·(tr²(A⁻¹A′) − tr((A⁻¹A′)²) + tr(A⁻¹A″)).

use super::columns::Columns;
use super::plan::{Group, MultiPlan};
use super::twist::{Twist, cross_product, dot, plus};
use crate::math::linear::dense;

/// D, its derivative along a motion of the inputs, and its second one in time while the
/// accelerations of the inputs are zero.
#[derive(Clone, Copy, Debug)]
struct Determinant {
    value: f64,
    rate: f64,
    bend: f64,
}

fn cross(p: &Twist<f64>, q: &Twist<f64>) -> Twist<f64> {
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

impl Columns<f64> {
    /// The margin of a group: D², or D where that is smooth, over its value at the start;
    /// its derivatives by the inputs into `first`; its rate and its second derivative in time
    /// while the accelerations of the inputs are zero. `start`: D at the start.
    pub(super) fn margin(
        &self,
        plan: &MultiPlan,
        index: usize,
        start: f64,
        memory: &mut [Vec<f64>; 2],
        first: &mut [f64],
    ) -> [f64; 3] {
        let group = &plan.groups[index];
        let motion = |body: usize| (self.velocity[body], self.acceleration[body]);
        let own = self.determinant(plan, index, &motion, memory);
        let [value, rate, bend] = [own.value, own.rate, own.bend].map(|part| part / start);
        for (input, first) in first.iter_mut().enumerate() {
            let along = |body: usize| (self.column(plan, body, input), [0.0; 3]);
            *first = match group.active.contains(&input) {
                true => self.determinant(plan, index, &along, memory).rate / start,
                false => 0.0,
            };
        }
        if group.is_linear() {
            return [value, rate, bend];
        }
        first.iter_mut().for_each(|first| *first *= 2.0 * value);
        [
            value * value,
            2.0 * value * rate,
            2.0 * (rate * rate + value * bend),
        ]
    }

    /// D of a group.
    pub(super) fn determinant_of(&self, plan: &MultiPlan, index: usize) -> f64 {
        let group = &plan.groups[index];
        match group.dyad {
            true => {
                let [[a, b, c], _] = &self.dyads[index];
                dot(a, &cross(b, c))
            }
            false => self.determinants[index],
        }
    }

    fn determinant(
        &self,
        plan: &MultiPlan,
        index: usize,
        motion: &dyn Fn(usize) -> (Twist<f64>, Twist<f64>),
        memory: &mut [Vec<f64>; 2],
    ) -> Determinant {
        let group = &plan.groups[index];
        match group.dyad {
            true => self.of_dyad(index, group, motion),
            false => self.of_group(plan, index, motion, memory),
        }
    }

    fn of_dyad(
        &self,
        index: usize,
        group: &Group,
        motion: &dyn Fn(usize) -> (Twist<f64>, Twist<f64>),
    ) -> Determinant {
        let [[a, b, c], _] = &self.dyads[index];
        let moved = |k: usize, screw: &Twist<f64>| {
            let (velocity, acceleration) = motion(group.screws[k].owner);
            let rate = cross_product(&velocity, screw);
            (
                rate,
                plus(
                    cross_product(&acceleration, screw),
                    cross_product(&velocity, &rate),
                ),
            )
        };
        let ((a1, a2), (b1, b2), (c1, c2)) = (moved(0, a), moved(1, b), moved(2, c));
        let triple = |p: &Twist<f64>, q: &Twist<f64>, r: &Twist<f64>| dot(p, &cross(q, r));
        Determinant {
            value: triple(a, b, c),
            rate: triple(&a1, b, c) + triple(a, &b1, c) + triple(a, b, &c1),
            bend: triple(&a2, b, c)
                + triple(a, &b2, c)
                + triple(a, b, &c2)
                + 2.0 * (triple(&a1, &b1, c) + triple(&a1, b, &c1) + triple(a, &b1, &c1)),
        }
    }

    fn of_group(
        &self,
        plan: &MultiPlan,
        index: usize,
        motion: &dyn Fn(usize) -> (Twist<f64>, Twist<f64>),
        memory: &mut [Vec<f64>; 2],
    ) -> Determinant {
        let group = &plan.groups[index];
        let n = 3 * group.bases.len();
        let [once, twice] = memory.each_mut().map(|own| &mut own[..n * n]);
        once.fill(0.0);
        twice.fill(0.0);
        let mut top = 0;
        for tie in &group.ties {
            tie.parts_moved(&self.poses, motion, plan.plan.size, |row, body, parts| {
                let Some(body) = group.body_of(body) else {
                    return;
                };
                for (unknown, [rate, bend]) in parts.into_iter().enumerate() {
                    let place = (top + row) * n + 3 * body + unknown;
                    once[place] += rate;
                    twice[place] += bend;
                }
            });
            top += tie.rows();
        }
        let factors = &self.matrices[group.matrix..group.matrix + n * n];
        let exchanged = &self.exchanged[group.exchanged..group.exchanged + n];
        dense::solve(factors, exchanged, once, n);
        dense::solve(factors, exchanged, twice, n);
        let trace = |matrix: &[f64]| (0..n).map(|k| matrix[k * n + k]).sum::<f64>();
        let mut squares = 0.0;
        for i in 0..n {
            for k in 0..n {
                squares += once[i * n + k] * once[k * n + i];
            }
        }
        let (value, first) = (self.determinants[index], trace(once));
        Determinant {
            value,
            rate: value * first,
            bend: value * (first * first - squares + trace(twice)),
        }
    }
}
