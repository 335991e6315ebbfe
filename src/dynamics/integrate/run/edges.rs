//! Where laws of the scene end, or have no derivatives.
//!
//! At the edge of a piece of an expression, sqrt(0.2 − t) at 0.2 s, no step of a method of
//! high order is short enough. A short step of low order, whose error is below what is
//! allowed, leads over it. Where an expression grows without bound nothing does.

use super::{Run, Verdict};
use crate::dynamics::integrate::{Dynamics, PhysicalStop};

/// Least step over an edge, in units of what the clock resolves.
const LEAST: f64 = 1024.0;
/// A step that may be longer is so many times longer.
const LONGER: f64 = 4.0;
/// Share of the tolerance that such a step may be off by.
const SHARE: f64 = 0.01;
/// Most of them …
const MOST: u32 = 32;
/// … within so many units of what the clock resolves.
const CLOSE: f64 = 1e6;
/// A pole is looked for within so many of them ahead.
const AHEAD: f64 = 1e4;

impl<D: Dynamics> Run<'_, D> {
    /// What the clock resolves (s).
    fn resolution_of_time(&self) -> f64 {
        4.0 * f64::EPSILON * self.from.time.abs().max(self.target.abs())
    }

    /// Passes the edge of a piece by a short step; true when the run has got on.
    pub(in crate::dynamics::integrate) fn passes_edge(&mut self) -> bool {
        let (time, clock) = (self.from.time, self.resolution_of_time());
        if !self.evaluator.dynamics.has_edges() {
            return false;
        }
        if time - self.edges.1 > CLOSE * clock {
            self.edges = (0, time);
        }
        self.edges.0 += 1;
        if self.edges.0 > MOST {
            return false;
        }
        let Some((length, y, dy)) = self.short_step(LEAST * clock) else {
            return false;
        };
        let verdict = self.accept_step(time + length, &y, &dy, None);
        // (At a change at its very start the time is the same.)
        verdict == Verdict::Restart || verdict == Verdict::Continue && self.from.time > time
    }

    /// The longest step, of at least `least` (s), by the mean of the rates at its ends that
    /// is as exact as the tolerance asks for: its length, and state and rates at its end.
    fn short_step(&self, least: f64) -> Option<(f64, Vec<f64>, Vec<f64>)> {
        let (from, rest) = (&self.from, self.target - self.from.time);
        let allowed = SHARE * self.settings.tolerance;
        let mut found = None;
        let mut length = least;
        while length < rest {
            let ahead = from.y.iter().zip(&from.dy);
            let mut y: Vec<f64> = ahead.map(|(y, rate)| y + length * rate).collect();
            let mut dy = vec![0.0; y.len()];
            self.evaluator.derivatives(from.time + length, &y, &mut dy);
            let exact = (0..y.len()).all(|index| {
                let change = length * (dy[index] - from.dy[index]);
                y[index] += 0.5 * change;
                change.abs() <= allowed * self.evaluator.dynamics.error_size(index, y[index])
            });
            if !exact {
                break;
            }
            found = Some((length, y, dy));
            length *= LONGER;
        }
        found
    }

    /// The end of the run at a pole just ahead.
    pub(in crate::dynamics::integrate) fn pole_ahead(&self) -> Option<PhysicalStop> {
        let span = [self.from.time, AHEAD * self.resolution_of_time()];
        self.evaluator.pole_near(span, &self.from.y, &self.from.dy)
    }

    /// The end of the run at a pole on the step under way, up to a place of it.
    pub(in crate::dynamics::integrate) fn pole_on_step(&self, end: f64) -> Option<PhysicalStop> {
        let dynamics = self.evaluator.dynamics;
        if !dynamics.has_edges() {
            return None;
        }
        let modes = self.evaluator.modes.borrow();
        dynamics.pole_on(&self.output.step(1.0), &modes, end)
    }
}
