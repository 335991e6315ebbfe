//! Figures of a scene at many values of its parameters.
//!
//! What does not depend on the parameters is done once ([`Prepared`]): reading, the levels of
//! elastic objects, addresses of figures. A point then decodes only what varies
//! (`scene::Variation`): plain numbers of chains are set in place, and the rigid motion, the
//! samples of the laws and the exact propagation of the laws are kept as long as the laws are
//! the same (`bench`). It is lowered, frozen, run for the figures that are asked for, and
//! judged ([`Verdict`]). A figure is found as a run finds it; where a tree is propagated
//! exactly, what the figures do not need is left out.
//!
//! A point depends on nothing but its values. Results are the same for any number of threads
//! and in any order. A point that cannot be run has no values, but a verdict and its cause.
//!
//! Maps ([`super::map`]) work their cells out by it.

mod bench;
mod ends;
mod figure;
mod judge;
mod levels;
mod point;
mod question;
mod rigid;
mod verdict;

pub(super) use bench::Bench;
pub(super) use figure::{check_figure, unit as figure_unit};
pub(crate) use levels::{finest_levels, shortfall};
pub(super) use point::evaluate;
pub use point::{MOST_STEPS, Point, PointFigure};
pub use question::PointQuestion;
pub use rigid::{RigidMotion, rigid_motion};
pub use verdict::{Family, NEAR_HARMONIC, RESONANCE, STEADY, THROWN_OFF, Verdict};

use super::Control;
use super::side_by_side::{side_by_side, threads as number_of_threads};
use crate::dynamics::audit::{SEED, draw};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Of so many points the equations of motion of one are checked.
const ONE_OF: u64 = 16;

/// A scene made ready for many values of its parameters.
#[derive(Debug)]
pub struct Prepared<'a> {
    /// What is asked at every point.
    pub question: PointQuestion<'a>,
    /// What threads worked with before, for those that come after them.
    benches: Mutex<Vec<Bench>>,
}

impl<'a> Prepared<'a> {
    /// Ready for a question whose parameters and figures are known to exist.
    pub(crate) fn new(question: PointQuestion<'a>) -> Self {
        Self {
            question,
            benches: Mutex::default(),
        }
    }

    /// The point at some values of the parameters, one for each, all finite; `None`: ended from
    /// outside. The equations of motion of one of 16 points are checked, chosen by its values.
    pub fn point(&self, values: &[f64], control: &Control<'_>) -> Option<Point> {
        HeldBench::new(self).point(values, control)
    }

    /// The points at rows of values, in their order, each as [`Self::point`] gives it; `None`:
    /// ended from outside. On `threads` threads (`None`: one for every processor core).
    /// `heard` receives the number of points that are done, from any thread.
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
            let point = match control.is_spent() {
                true => None,
                false => held.point(rows[number].as_ref(), control),
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

    fn benches(&self) -> MutexGuard<'_, Vec<Bench>> {
        self.benches.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a thread works with; others have it afterwards.
struct HeldBench<'p> {
    prepared: &'p Prepared<'p>,
    bench: Bench,
}

impl<'p> HeldBench<'p> {
    fn new(prepared: &'p Prepared<'p>) -> Self {
        let bench = prepared.benches().pop().unwrap_or_default();
        Self { prepared, bench }
    }

    fn point(&mut self, values: &[f64], control: &Control<'_>) -> Option<Point> {
        let checked = is_checked_point(values);
        evaluate(
            &self.prepared.question,
            &mut self.bench,
            (values, checked),
            control,
        )
    }
}

impl Drop for HeldBench<'_> {
    fn drop(&mut self) {
        // What a panic left behind is not used again.
        if !std::thread::panicking() {
            let bench = std::mem::take(&mut self.bench);
            self.prepared.benches().push(bench);
        }
    }
}

/// True of the points whose equations of motion are checked: one of so many, drawn by the
/// values.
fn is_checked_point(values: &[f64]) -> bool {
    let mixed = values
        .iter()
        .fold(SEED, |mixed, value| draw(mixed ^ value.to_bits()));
    mixed.is_multiple_of(ONE_OF)
}

/// The same of a cell of a map; the first of all is checked too.
pub(super) fn is_checked_cell(panel: usize, cell: usize) -> bool {
    cell == 0 || draw(SEED ^ ((panel as u64) << 32) ^ cell as u64).is_multiple_of(ONE_OF)
}
