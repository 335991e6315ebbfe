//! What may end a walk from outside.

use crate::dynamics::integrate::{Limits, Stop};
use crate::exact::Halt;

/// Clock: what may end a walk from outside, looked at from time to time.
#[derive(Debug)]
pub(crate) struct Clock<'l> {
    pub(super) limits: &'l Limits<'l>,
}

impl<'l> Clock<'l> {
    pub(crate) fn new(limits: &'l Limits<'l>) -> Self {
        Self { limits }
    }

    /// Why a walk must not go on.
    pub(super) fn reason_to_stop(&self) -> Option<Stop> {
        self.limits.budget.spent().map(Stop::from)
    }

    /// True as long as nothing ends it.
    pub(crate) fn is_running(&self) -> bool {
        self.reason_to_stop().is_none()
    }

    /// Stop that a halt of a tree stands for.
    pub(super) fn stop_of_halt(&self, halt: Halt) -> Stop {
        match halt {
            Halt::Switches => Stop::TooManySwitches {
                bound: self.limits.switches,
            },
            Halt::Steps => Stop::TooManySteps {
                bound: self.limits.steps,
            },
            Halt::Cancelled => self.reason_to_stop().unwrap_or(Stop::Interrupted),
        }
    }
}
