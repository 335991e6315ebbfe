//! What may end a quick run from outside.

use crate::exact::Halt;
use crate::integrate::{Limits, Stop};
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Watches over the limits of a run from outside.
pub(super) struct Clock<'l> {
    limits: &'l Limits<'l>,
    begun: Option<Instant>,
}

impl<'l> Clock<'l> {
    pub(super) fn new(limits: &'l Limits<'l>) -> Self {
        let begun = limits.wall_clock.map(|_| Instant::now());
        Self { limits, begun }
    }

    /// Why the run must not go on.
    pub(super) fn stop(&self) -> Option<Stop> {
        let flag = self.limits.interrupt;
        if flag.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Some(Stop::Interrupted);
        }
        let (limit, begun) = self.limits.wall_clock.zip(self.begun)?;
        (begun.elapsed() > limit).then_some(Stop::WallClock { limit })
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
