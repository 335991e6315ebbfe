//! Stretches in which steps must be short, as given functions of time change there briefly.

use super::Run;
use crate::dynamics::integrate::Dynamics;
use crate::math::narrow::Narrow;

/// Shortest step that is still shortened, in roundings of the time.
const SHORT: f64 = 4096.0 * f64::EPSILON;

/// What is known of them up to an instant.
#[derive(Debug)]
pub(super) struct NarrowSearch {
    stretches: Vec<Narrow>,
    until: f64,
    /// Longest step of the present leg (s).
    longest: f64,
}

impl Default for NarrowSearch {
    fn default() -> Self {
        Self {
            stretches: Vec::new(),
            until: f64::NEG_INFINITY,
            longest: f64::INFINITY,
        }
    }
}

impl<D: Dynamics> Run<'_, D> {
    /// Ends the leg, which goes from where the run stands to its target, where the next such
    /// stretch begins or ends.
    pub(in crate::dynamics::integrate) fn narrow_down(&mut self) {
        let (time, target) = (self.from.time, self.target);
        if target > self.narrow.until {
            let modes = self.evaluator.modes.borrow();
            self.narrow.stretches = self
                .evaluator
                .dynamics
                .narrow_stretches(time, target, &modes);
            self.narrow.until = target;
        }
        self.narrow.longest = f64::INFINITY;
        let ahead = self.narrow.stretches.iter().find(|one| one.to > time);
        match ahead {
            Some(one) if one.from > time => self.target = target.min(one.from),
            Some(one) => {
                self.target = target.min(one.to);
                self.narrow.longest = one.longest;
            }
            None => {}
        }
    }

    /// The length (s) of a shorter step, where this one passes over a brief change of a law that
    /// the motion meets.
    pub(super) fn passes_over(&self) -> Option<f64> {
        if !self.can_repeat_step() {
            return None;
        }
        let step = self.output.step(1.0);
        let modes = self.evaluator.modes.borrow();
        let tolerance = self.settings.tolerance;
        let dynamics = self.evaluator.dynamics;
        let share = dynamics.passed_over(&step, &modes, tolerance)?;
        let may_shorten = step.length > SHORT * step.time(1.0).abs();
        may_shorten.then_some(share * step.length)
    }

    /// Longest step that such a stretch allows (s).
    pub(in crate::dynamics::integrate) fn narrow_step(&self) -> f64 {
        self.narrow.longest
    }
}
