//! Where given functions of time change so briefly that steps must be short.

use super::frozen::{Frozen, Step, segment};
use super::written::{Input, Written};
use crate::math::expression::{Interval, Moving, VARIABLES};
use crate::math::narrow::{Narrow, narrow};

impl Frozen {
    /// Such stretches of the motions of drives and of the loads by expressions of time.
    pub(super) fn narrow(&self, from: f64, to: f64, modes: &[i64]) -> Vec<Narrow> {
        let motions = self.steps.iter().filter_map(|step| match step {
            Step::Prescribed(drive) => {
                let piece = segment(modes, drive.component);
                Some(drive.motion.narrow(piece, from, to))
            }
            Step::Rotor(_) | Step::Rigid(_) | Step::Chain(_) | Step::Constrained(_) => None,
        });
        let loads = self.written().filter(|written| written.needs_time());
        let loads = loads.map(|written| written.narrow(from, to, modes));
        merged(motions.chain(loads).flatten().collect())
    }
}

impl Written {
    /// The stretches in which the force changes briefly with time, all else at rest.
    fn narrow(&self, from: f64, to: f64, modes: &[i64]) -> Vec<Narrow> {
        let mode = |guard: u16| modes[self.component + usize::from(guard)];
        let value = &self.expression.program().value;
        let bounds = |a: f64, b: f64| {
            let still = |value| Moving {
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
        narrow(from, to, bounds, force)
    }
}

/// Stretches of several functions as stretches that do not overlap, with the shortest steps
/// of all of them.
fn merged(mut all: Vec<Narrow>) -> Vec<Narrow> {
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
