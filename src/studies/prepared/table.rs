//! Tables of points, worked out side by side.

use super::{HeldBench, Point, Prepared, is_sample};
use crate::studies::Control;
use crate::studies::side_by_side::{side_by_side, threads as number_of_threads};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

impl Prepared<'_> {
    /// The points at rows of values, in their order, each as [`Self::point`] gives it; `None`:
    /// ended from outside. On `threads` threads (`None`: one for every processor core).
    /// `heard` is told the number of points that are done, from any thread.
    pub fn table(
        &self,
        rows: &[impl AsRef<[f64]> + Sync],
        threads: Option<usize>,
        control: &Control<'_>,
        heard: &(dyn Fn(usize) + Sync),
    ) -> Option<Vec<Point>> {
        let found: Vec<Mutex<Option<Point>>> = rows.iter().map(|_| Mutex::default()).collect();
        let done = AtomicUsize::new(0);
        let take = |held: &mut HeldBench<'_>, number: usize| {
            let values = rows[number].as_ref();
            let point = match control.is_spent() {
                true => None,
                false => self.point_with(&mut held.bench, values, is_sample(values), control),
            };
            let goes_on = point.is_some();
            *found[number].lock().unwrap_or_else(PoisonError::into_inner) = point;
            heard(done.fetch_add(1, Relaxed) + 1);
            goes_on
        };
        let threads = number_of_threads(threads);
        side_by_side(rows.len(), threads, || HeldBench::new(self), take);
        let found = found.into_iter();
        found
            .map(|point| point.into_inner().unwrap_or_else(PoisonError::into_inner))
            .collect()
    }
}
