//! What may end a quick run from outside.

use crate::exact::Halt;
use crate::integrate::{Limits, Stop};

/// Watches over the limits of a run from outside.
pub(super) struct Clock<'l> {
    limits: &'l Limits<'l>,
}

impl<'l> Clock<'l> {
    pub(super) fn new(limits: &'l Limits<'l>) -> Self {
        Self { limits }
    }

    /// Why the run must not go on.
    pub(super) fn stop(&self) -> Option<Stop> {
        self.limits.budget.spent().map(Stop::from)
    }

    /// What a halt stands for.
    pub(super) fn why(&self, halt: Halt) -> Stop {
        match halt {
            Halt::Switches => Stop::TooManySwitches {
                bound: self.limits.switches,
            },
            Halt::Steps => Stop::TooManySteps {
                bound: self.limits.steps,
            },
            Halt::Told => self.stop().unwrap_or(Stop::Interrupted),
        }
    }
}
