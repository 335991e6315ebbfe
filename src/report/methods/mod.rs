//! Findings of studies of methods, and their points as rows.

pub mod charts;
mod rows;
mod study;
mod sweep;

pub use rows::{methods_rows, sweep_rows};
pub use study::findings;
pub use sweep::sweep_findings;

use super::findings::Cell;
use crate::studies::methods::Verdict;

/// Height of the charts on a page (pixels).
const HEIGHT: f64 = 560.0;

/// What a page says of its marks and times.
const TIMING: &str = "Filled marks: converged, the error is within the tolerance (of a fixed \
                      step, within the accuracy required). Open marks: inaccurate or not judged. \
                      Crosses: failed. Marks with an arrow: the reference. Its error is at most \
                      its distance from the nearest other method. Pointing at a mark shows its \
                      cause. Times are wall-clock times from the system ready to all samples of δ \
                      and all event times. They are medians of repeated runs with a single \
                      thread. They vary from run to run and from machine to machine.";

/// A verdict as good or bad news, with what is to be added.
fn verdict(verdict: Verdict, note: impl Into<String>) -> Cell {
    Cell::with_note(verdict.words(), note).with_outcome(match verdict {
        Verdict::Converged => Some(true),
        Verdict::NotJudged => None,
        _ => Some(false),
    })
}
