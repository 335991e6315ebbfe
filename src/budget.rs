//! How long a computation may go on: until a deadline, or until it is interrupted.
//!
//! One [`Budget`] is made where a question is asked, and passed by reference to all
//! that may take long. Results do not depend on it, except by being incomplete.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A deadline and a flag that is raised from outside; by default neither.
#[derive(Clone, Copy, Debug, Default)]
pub struct Budget<'a> {
    deadline: Option<Deadline>,
    interrupt: Option<&'a AtomicBool>,
}

/// The instant at which a computation is to end.
#[derive(Clone, Copy, Debug)]
struct Deadline {
    at: Instant,
    /// Limit allowed when the budget was set; for messages.
    limit: Duration,
}

/// Why a computation must not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spent {
    /// The flag was raised.
    Interrupted,
    /// The wall-clock time is over.
    Time {
        /// Limit that was allowed.
        limit: Duration,
    },
}

impl<'a> Budget<'a> {
    /// No bound.
    pub const FREE: Budget<'static> = Budget {
        deadline: None,
        interrupt: None,
    };

    /// Ends once `flag` is raised.
    pub fn interrupted_by(flag: &'a AtomicBool) -> Self {
        Self {
            deadline: None,
            interrupt: Some(flag),
        }
    }

    /// This budget, cut to at most `limit` from now on.
    #[must_use]
    pub fn within(self, limit: Duration) -> Self {
        // A limit that no clock can show is none.
        let Some(at) = Instant::now().checked_add(limit) else {
            return self;
        };
        match self.deadline {
            Some(sooner) if sooner.at <= at => self,
            _ => Self {
                deadline: Some(Deadline { at, limit }),
                ..self
            },
        }
    }

    /// This budget's deadline without its interrupt flag.
    #[must_use]
    pub fn uninterrupted(self) -> Self {
        Self {
            interrupt: None,
            ..self
        }
    }

    /// True once the flag is raised.
    pub fn is_interrupted(&self) -> bool {
        self.interrupt
            .is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// Why not to go on; `None`: go on. Costs a look at the clock where there is a
    /// deadline, and next to nothing where there is none.
    pub fn spent(&self) -> Option<Spent> {
        if self.is_interrupted() {
            return Some(Spent::Interrupted);
        }
        let over = |deadline: &Deadline| Instant::now() >= deadline.at;
        let deadline = self.deadline.filter(over)?;
        Some(Spent::Time {
            limit: deadline.limit,
        })
    }

    /// True when there is no more to spend.
    pub fn is_spent(&self) -> bool {
        self.spent().is_some()
    }
}

impl std::fmt::Display for Spent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Interrupted => f.write_str("interrupted"),
            Self::Time { limit } => {
                write!(f, "the time limit of {} s is over", limit.as_secs_f64())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Budget, Spent};
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    #[test]
    fn the_flag_and_the_sooner_deadline_end_a_budget() {
        assert_eq!(Budget::FREE.spent(), None);
        let flag = AtomicBool::new(false);
        let hour = Duration::from_secs(3600);
        let budget = Budget::interrupted_by(&flag).within(hour);
        assert_eq!(budget.spent(), None);
        // Narrowed, and not widened again.
        let limit = Duration::ZERO;
        let narrow = budget.within(limit).within(hour);
        assert_eq!(narrow.spent(), Some(Spent::Time { limit }));
        assert_eq!(budget.within(Duration::MAX).spent(), None);
        flag.store(true, Ordering::Relaxed);
        assert_eq!(budget.spent(), Some(Spent::Interrupted));
        assert_eq!(budget.uninterrupted().spent(), None);
    }
}
