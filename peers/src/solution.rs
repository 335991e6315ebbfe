//! What a solver hands over, and how it is timed.

use std::time::{Duration, Instant};

/// The answer of a solver.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solution {
    /// δ at the sample times (rad).
    pub(crate) samples: Vec<f64>,
    /// Switches located; `None`: the solver locates none.
    pub(crate) switches: Option<usize>,
    /// Accepted steps (phases, for the exact method).
    pub(crate) steps: u64,
    /// max|δ|, where it was asked for instead of samples (rad).
    pub(crate) delta_max: f64,
}

/// Wall time of repeated runs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    /// Fastest run (s).
    pub(crate) least: f64,
    /// Median run (s).
    pub(crate) median: f64,
    /// Number of runs.
    pub(crate) runs: usize,
}

impl Timing {
    /// Of measured times.
    pub(crate) fn of(mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        Self {
            least: times[0],
            median: times[times.len() / 2],
            runs: times.len(),
        }
    }

    /// Repeats a run for `budget`, three times at least.
    pub(crate) fn measure<R>(budget: Duration, mut run: impl FnMut() -> R) -> Self {
        const MOST: usize = 20_000;
        let begin = Instant::now();
        let mut times = Vec::new();
        while times.len() < 3 || (begin.elapsed() < budget && times.len() < MOST) {
            let start = Instant::now();
            std::hint::black_box(run());
            times.push(start.elapsed().as_secs_f64());
        }
        Self::of(times)
    }
}
