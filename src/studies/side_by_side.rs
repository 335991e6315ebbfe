//! Independent work on several threads.

use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// Number of threads where none is given: one for every processor core.
pub(crate) fn threads(asked: Option<usize>) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.unwrap_or_else(cores).max(1)
}

/// Works through the numbers below `count` on several threads, of which the calling one is the
/// first. Each takes the next number when it is done with one, so that none waits at the end
/// for longer than one takes. `worker` makes what a thread needs; `take` works on a number, and
/// is false where its thread is to end. A thread that cannot be started leaves its numbers to
/// the others.
pub(crate) fn side_by_side<W>(
    count: usize,
    threads: usize,
    worker: impl Fn() -> W + Sync,
    take: impl Fn(&mut W, usize) -> bool + Sync,
) {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut own = worker();
        loop {
            let number = next.fetch_add(1, Relaxed);
            if number >= count || !take(&mut own, number) {
                return;
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(count) {
            let started = std::thread::Builder::new().spawn_scoped(scope, work);
            if started.is_err() {
                break;
            }
        }
        work();
    });
}

#[cfg(test)]
mod tests {
    use super::side_by_side;
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    #[test]
    fn every_number_is_worked_on_once() {
        for (count, threads) in [(0, 3), (1, 3), (100, 1), (100, 4)] {
            let (workers, seen) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
            let worker = || workers.fetch_add(1, Relaxed);
            side_by_side(count, threads, worker, |_, number| {
                seen.lock().unwrap().push(number);
                true
            });
            let mut seen = seen.into_inner().unwrap();
            seen.sort_unstable();
            assert_eq!(seen, (0..count).collect::<Vec<_>>());
            assert!(workers.into_inner() <= threads);
        }
    }

    #[test]
    fn a_thread_ends_when_it_is_told_to() {
        let seen = AtomicUsize::new(0);
        side_by_side(
            100,
            1,
            || (),
            |(), number| {
                seen.fetch_add(1, Relaxed);
                number < 4
            },
        );
        assert_eq!(seen.into_inner(), 5);
    }
}
