//! How a run comes to its end: by a limit, a fault, a method that gives up.

use super::run::{Run, Verdict};
use super::{Dynamics, Stop};

impl<D: Dynamics> Run<'_, D> {
    pub(super) fn not_finite(&self, index: usize) -> Stop {
        Stop::NotFinite {
            what: self.evaluator.dynamics.state_name(index),
        }
    }

    /// An entry of the state or of its derivative is no number; the mechanism itself
    /// may be the reason.
    pub(super) fn end_not_finite(&mut self, index: usize) -> Verdict {
        match self.evaluator.take_obstacle() {
            Some(obstacle) => self.end(Stop::Physical(obstacle)),
            None => self.give_up_step(self.not_finite(index)),
        }
    }

    /// The run is over.
    pub(super) fn end(&mut self, stop: Stop) -> Verdict {
        self.stop = Some(stop);
        Verdict::Stop
    }

    /// A method cannot shorten its step any further at step length `step`; if
    /// the right-hand side gave no numbers, that is the reason.
    pub(super) fn end_at_floor(&mut self, step: f64) -> Verdict {
        self.end_with_reason(Stop::StepFloor { step })
    }

    /// A method gives up with `stop`; if the right-hand side gave no numbers,
    /// that is the reason.
    pub(super) fn end_with_reason(&mut self, stop: Stop) -> Verdict {
        if self.passes_edge() {
            return Verdict::Restart;
        }
        if let Some(pole) = self.pole_ahead() {
            return self.end(Stop::Physical(pole));
        }
        if let Some(obstacle) = self.evaluator.take_obstacle() {
            return self.end(Stop::Physical(obstacle));
        }
        match self.evaluator.take_not_finite() {
            Some(index) => self.give_up_step(self.not_finite(index)),
            None => self.give_up_step(stop),
        }
    }

    pub(super) fn check_limits(&mut self) -> Verdict {
        let limits = self.limits;
        if self.stop.is_some() {
            return Verdict::Stop;
        }
        if self.from.time >= self.target {
            return Verdict::Continue; // whatever comes after is checked then
        }
        let stop = if self.switches > limits.switches {
            let bound = limits.switches;
            Stop::TooManySwitches { bound }
        } else if self.steps >= limits.steps {
            let bound = limits.steps;
            Stop::TooManySteps { bound }
        } else if let Some(spent) = limits.budget.spent() {
            spent.into()
        } else {
            return Verdict::Continue;
        };
        self.end(stop)
    }
}
