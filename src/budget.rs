//! How long a computation may go on: until a deadline, or until it is interrupted.
//!
//! One [`Budget`] is made where a question is asked, and passed by reference to all
//! that may take long. Results do not depend on it, except by being incomplete.

mod clock;

pub(crate) use clock::Instant;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A deadline and a flag that is raised from outside; by default neither.
#[derive(Clone, Copy, Debug, Default)]
pub struct Budget<'a> {
    deadline: Option<Deadline>,
    interrupt: Option<&'a AtomicBool>,
    listener: Option<&'a dyn Listener>,
}

/// Who has an ear for what comes from outside on the thread that computes itself, and raises the
/// flag then.
pub trait Listener: Sync + std::fmt::Debug {
    /// A computation looks whether it may go on: it may do so often, and on several threads.
    fn listen(&self);
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
        listener: None,
    };

    /// Ends once `flag` is raised.
    pub fn interrupted_by(flag: &'a AtomicBool) -> Self {
        Self {
            interrupt: Some(flag),
            ..Self::FREE
        }
    }

    /// This budget; it also ends once `flag` is raised.
    #[must_use]
    pub fn or_interrupted_by(self, flag: &'a AtomicBool) -> Self {
        Self {
            interrupt: Some(flag),
            ..self
        }
    }

    /// This budget; `listener` is told whenever somebody asks whether it was interrupted.
    #[must_use]
    pub fn with_listener(self, listener: &'a dyn Listener) -> Self {
        Self {
            listener: Some(listener),
            ..self
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
            listener: None,
            ..self
        }
    }

    /// True once the flag is raised.
    pub fn is_interrupted(&self) -> bool {
        if let Some(listener) = self.listener {
            listener.listen();
        }
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
    use super::{Budget, Listener, Spent};
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
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

    #[derive(Debug, Default)]
    struct Third {
        times: AtomicUsize,
        flag: AtomicBool,
    }

    impl Listener for Third {
        fn listen(&self) {
            let times = self.times.fetch_add(1, Ordering::Relaxed) + 1;
            self.flag.store(times == 3, Ordering::Relaxed);
        }
    }

    #[test]
    fn who_listens_is_told_at_each_look_and_may_end_it() {
        let third = Third::default();
        let budget = Budget::interrupted_by(&third.flag).with_listener(&third);
        let alone = budget.uninterrupted();
        assert_eq!((budget.spent(), budget.is_interrupted()), (None, false));
        assert_eq!((alone.spent(), alone.is_interrupted()), (None, false));
        assert_eq!(budget.spent(), Some(Spent::Interrupted));
        assert_eq!(third.times.load(Ordering::Relaxed), 3);
    }
}
