//! Where given functions of time change so briefly that steps must be short.

use super::frozen::{Frozen, Step, segment};
use super::written::{Along, FrozenExpression, Input};
use crate::math::expression::{Interval, Program, RateBounds, Scalar, Stretch, VARIABLES};
use crate::math::narrow::{Narrow, narrow_stretches, narrow_within};
use crate::math::polynomial;

/// What a force may do to a speed unseen, in units of the tolerance.
const SLIGHT: f64 = 0.1;
/// A step begins so near before a stretch that it is within it.
const NEAR: f64 = 0.02;

impl Frozen {
    /// Such stretches of the motions of drives and of the loads by expressions of time.
    pub(super) fn narrow_stretches(&self, from: f64, to: f64, modes: &[i64]) -> Vec<Narrow> {
        let motions = self.steps.iter().filter_map(|step| match step {
            Step::Prescribed(drive) => {
                let piece = segment(modes, drive.component);
                Some(drive.motion.narrow_stretches(piece, from, to))
            }
            Step::Rotor(_) | Step::Rigid(_) | Step::Chain(_) | Step::Constrained(_) => None,
        });
        let loads = self
            .expression_loads()
            .filter(|written| written.needs_time());
        let loads = loads.map(|written| written.narrow_stretches(from, to, modes));
        merge_stretches(motions.chain(loads).flatten().collect())
    }
}

/// True of an expression that may change within a small part of the range of its variables.
pub(super) fn may_hide(program: &Program) -> bool {
    program.value.ops().iter().any(|op| op.may_be_steep())
}

impl Frozen {
    /// The share of a step within which it is to end, where the motion passes over a brief
    /// change of a load by an expression of displacements or speeds: the places of the method
    /// do not see it.
    pub(super) fn passed_over(
        &self,
        step: &polynomial::Step<'_>,
        modes: &[i64],
        tolerance: f64,
    ) -> Option<f64> {
        let found = self.loads.iter().filter_map(|load| {
            let written = load.written.as_ref().filter(|written| written.hides)?;
            let inertia = self.inertia[load.node];
            let inertia = match inertia > 0.0 {
                true => inertia,
                false => self.least_inertia(),
            };
            written.passed_over(step, modes, SLIGHT * tolerance * inertia)
        });
        found.reduce(f64::min)
    }

    fn least_inertia(&self) -> f64 {
        let own = self.inertia.iter().copied().filter(|own| *own > 0.0);
        own.reduce(f64::min).unwrap_or(0.0)
    }
}

impl FrozenExpression {
    /// `slight`: an impulse over a speed that does not count.
    fn passed_over(&self, step: &polynomial::Step<'_>, modes: &[i64], slight: f64) -> Option<f64> {
        let along = Along {
            written: self,
            step,
        };
        let moved = self.inputs.iter().filter_map(|input| match *input {
            Input::Displacement { signal, .. } | Input::Speed { signal, .. } => {
                Some((step.value(signal, 1.0).0 - step.value(signal, 0.0).0).abs())
            }
            Input::Unused | Input::Time => None,
        });
        let moved = moved.fold(0.0, f64::max);
        let mode = |guard: u16| modes[self.component + usize::from(guard)];
        let code = &self.expression.program().value;
        let bounds = |from: f64, to: f64| {
            let mut variables = [RateBounds::number(0.0); VARIABLES];
            along.over(from, to, &mut variables);
            let RateBounds { value, rate } = code.evaluate(&variables, &mode);
            // By the value, or by how fast it changes: the closer of the two.
            let change = rate.low.abs().max(rate.high.abs()) * (to - from);
            match change < value.high - value.low {
                true => [-0.5 * change, 0.5 * change],
                false => [value.low, value.high],
            }
        };
        let value = |place: f64| {
            let mut variables = [0.0; VARIABLES];
            along.at(place, &mut variables);
            code.evaluate(&variables, &mode)
        };
        let noise = slight * moved / (step.length * step.length * self.factor.abs());
        let (from, longest) = narrow_within(bounds, value, noise)?;
        Some(if from > NEAR { from } else { longest })
    }

    /// The stretches in which the force changes briefly with time, all else at rest.
    fn narrow_stretches(&self, from: f64, to: f64, modes: &[i64]) -> Vec<Narrow> {
        let mode = |guard: u16| modes[self.component + usize::from(guard)];
        let value = &self.expression.program().value;
        let bounds = |a: f64, b: f64| {
            let still = |value| RateBounds {
                value,
                rate: Interval::of(0.0),
            };
            let mut values = [still(Interval::of(0.0)); VARIABLES];
            for (value, input) in values.iter_mut().zip(&self.inputs) {
                if *input == Input::Time {
                    *value = still(Interval::between(a, b));
                }
            }
            let force = value.evaluate(&values, &mode).value;
            [force.low, force.high]
        };
        let force = |time: f64| {
            let mut values = [0.0; VARIABLES];
            for (value, input) in values.iter_mut().zip(&self.inputs) {
                if *input == Input::Time {
                    *value = time;
                }
            }
            value.evaluate(&values, &mode)
        };
        narrow_stretches(from, to, bounds, force)
    }
}

/// Stretches of several functions as stretches that do not overlap, with the shortest steps
/// of all of them.
fn merge_stretches(mut all: Vec<Narrow>) -> Vec<Narrow> {
    all.sort_by(|a, b| a.from.total_cmp(&b.from));
    let mut found: Vec<Narrow> = Vec::with_capacity(all.len());
    for next in all {
        match found.last_mut().filter(|last| next.from < last.to) {
            Some(last) => {
                last.to = last.to.max(next.to);
                last.longest = last.longest.min(next.longest);
            }
            None => found.push(next),
        }
    }
    found
}
