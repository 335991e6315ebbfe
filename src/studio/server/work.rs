//! Work beside the server: the newest question wins, the one before is ended.
//!
//! A superseded computation may go on for a moment, so that something is seen while a number
//! moves, and is then ended by its budget. Time and memory of runs are limited.

use crate::studio::server::limits::{GRACE, MEMORY};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A place for the newest question, and what is being worked on.
#[derive(Debug)]
pub(super) struct Desk<Q> {
    state: Mutex<State<Q>>,
    bell: Condvar,
}

#[derive(Debug)]
struct State<Q> {
    next: Option<Q>,
    running: Option<Running>,
    closed: bool,
}

#[derive(Debug)]
struct Running {
    since: Instant,
    stop: Arc<AtomicBool>,
    /// Something newer came.
    superseded: bool,
    /// It goes on for a while then.
    patient: bool,
}

/// What of the processor a desk gets where there is not enough for all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rank {
    /// As much as everything else.
    Beside,
    /// What the others leave: the browser, and the answers that it waits for.
    Behind,
}

impl Rank {
    /// Takes it, for this thread and those that it starts.
    fn install(self) {
        if self == Self::Behind {
            lower_priority();
        }
    }
}

/// Of Linux alone: elsewhere this would be of the whole program.
#[cfg(target_os = "linux")]
fn lower_priority() {
    // Without it all is as right, and slower.
    let _ = rustix::process::nice(19);
}

#[cfg(not(target_os = "linux"))]
fn lower_priority() {}

impl<Q: Send + 'static> Desk<Q> {
    /// A desk with a thread that works on what is laid there. Work is given the flag that ends
    /// it; what it panics with is told, and the next question is taken.
    ///
    /// # Errors
    /// There is no thread to be had.
    pub(super) fn new(
        name: &str,
        rank: Rank,
        mut work: impl FnMut(Q, &AtomicBool) + Send + 'static,
        mut failed: impl FnMut() + Send + 'static,
    ) -> Result<Arc<Self>, String> {
        let desk = Arc::new(Self {
            state: Mutex::new(State {
                next: None,
                running: None,
                closed: false,
            }),
            bell: Condvar::new(),
        });
        let own = desk.clone();
        let run = move || {
            rank.install();
            while let Some((question, stop)) = own.wait() {
                let done = catch_unwind(AssertUnwindSafe(|| work(question, &stop)));
                if done.is_err() {
                    failed();
                }
            }
        };
        std::thread::Builder::new()
            .name(name.to_owned())
            .spawn(run)
            .map_err(|error| format!("cannot start a thread: {}", error.kind()))?;
        Ok(desk)
    }

    fn lock(&self) -> MutexGuard<'_, State<Q>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait(&self) -> Option<(Q, Arc<AtomicBool>)> {
        let mut state = self.lock();
        state.running = None;
        loop {
            if state.closed {
                return None;
            }
            if let Some(question) = state.next.take() {
                let stop = Arc::new(AtomicBool::new(false));
                state.running = Some(Running {
                    since: Instant::now(),
                    stop: stop.clone(),
                    superseded: false,
                    patient: true,
                });
                return Some((question, stop));
            }
            state = self
                .bell
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Lays down a question in place of one that waits. What is being worked on is ended when
    /// it has gone on for a while.
    pub(super) fn submit(&self, question: Q) {
        let mut state = self.lock();
        state.next = Some(question);
        if let Some(running) = &mut state.running {
            running.superseded = true;
            if !running.patient || running.since.elapsed() > GRACE {
                running.stop.store(true, Ordering::Relaxed);
            }
        }
        drop(state);
        self.bell.notify_one();
    }

    /// Ends what is superseded and has had its time, and everything where memory runs out.
    /// True: memory ran out.
    pub(super) fn end_overdue(&self, memory: u64) -> bool {
        let state = self.lock();
        let Some(running) = &state.running else {
            return false;
        };
        let old = running.superseded && running.since.elapsed() > GRACE;
        let large = memory > MEMORY;
        if old || large {
            running.stop.store(true, Ordering::Relaxed);
        }
        large
    }

    /// What is worked on from now on ends as soon as something newer comes.
    pub(super) fn interrupt_for_newer(&self) {
        if let Some(running) = &mut self.lock().running {
            running.patient = false;
        }
    }

    /// Whether something newer waits.
    #[cfg(test)]
    pub(super) fn has_next(&self) -> bool {
        self.lock().next.is_some()
    }

    /// Waits for something newer for a while; true: it came. For the desk's own work.
    pub(super) fn rest(&self, time: Duration) -> bool {
        let idle = |state: &mut State<Q>| state.next.is_none() && !state.closed;
        let waited = self.bell.wait_timeout_while(self.lock(), time, idle);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        state.next.is_some() || state.closed
    }

    /// Ends the thread.
    pub(super) fn close(&self) {
        let mut state = self.lock();
        state.closed = true;
        if let Some(running) = &state.running {
            running.stop.store(true, Ordering::Relaxed);
        }
        drop(state);
        self.bell.notify_one();
    }
}

/// How often work is looked at.
pub(super) const LOOK: Duration = Duration::from_millis(50);

/// Memory that the program has at present (bytes); zero where the system does not tell.
pub(super) fn memory() -> u64 {
    let told = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
    let pages = told
        .split(' ')
        .nth(1)
        .and_then(|pages| pages.parse::<u64>().ok());
    pages.unwrap_or(0) * 4096
}

#[cfg(test)]
mod tests {
    use super::{Desk, Rank};
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::mpsc::channel;
    use std::time::{Duration, Instant};

    #[test]
    fn the_newest_question_wins_and_a_panic_ends_nothing() {
        let (tell, told) = channel();
        let failed = tell.clone();
        let work = move |question: u32, stop: &AtomicBool| {
            assert!(question != 13, "a bad number");
            while question == 1 && !stop.load(Ordering::Relaxed) {
                std::thread::yield_now();
            }
            tell.send(question).unwrap();
        };
        let desk = Desk::new("test", Rank::Beside, work, move || failed.send(0).unwrap()).unwrap();
        let next = || told.recv_timeout(Duration::from_secs(20)).unwrap();
        desk.submit(1);
        let begun = Instant::now();
        while desk.has_next() {
            assert!(begun.elapsed() < Duration::from_secs(20));
        }
        desk.submit(2);
        desk.submit(3);
        while desk.has_next() {
            assert!(!desk.end_overdue(0));
            assert!(begun.elapsed() < Duration::from_secs(20));
        }
        assert_eq!((next(), next()), (1, 3));
        desk.submit(13);
        assert_eq!(next(), 0);
        desk.submit(4);
        assert_eq!(next(), 4);
        desk.close();
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_a_desk_behind_starts_leaves_the_processor_to_others() {
        let own = || rustix::process::getpriority_process(None).unwrap();
        let of = |rank| {
            let (tell, told) = channel();
            let work = move |(), _: &AtomicBool| {
                let started = std::thread::spawn(own).join().unwrap();
                tell.send(started).unwrap();
            };
            let desk = Desk::new("test", rank, work, || {}).unwrap();
            desk.submit(());
            let found = told.recv_timeout(Duration::from_secs(20)).unwrap();
            desk.close();
            found
        };
        let here = own();
        assert_eq!(of(Rank::Beside), here);
        assert_eq!(of(Rank::Behind), 19);
        assert_eq!(own(), here);
    }
}
