//! How far the motion moves when loads and gaps change by next to nothing.

use super::{HORIZON, trace};
use crate::dynamics::record::Figures;
use crate::dynamics::system::System;
use crate::studies::methods::attempt::{Attempt, Effort, Problem};
use crate::studies::methods::light::Trace;
use crate::studies::spread::{CHANGE, DETERMINED, is_result, with_scaled_loads};

/// Differences are told relative to at least this share of max|δ|.
const LEAST: f64 = 1e-3;

/// The reference's run with loads and gaps changed by one part in 10¹⁰.
pub(super) struct PerturbedRun {
    attempt: Option<Attempt>,
}

impl PerturbedRun {
    pub(super) fn of(problem: &Problem<'_>, guess: &Attempt, effort: &Effort<'_>) -> Self {
        let model = with_scaled_loads(problem.system.model().clone(), 1.0 + CHANGE);
        let attempt = System::new(model).ok().and_then(|system| {
            let initial = system.initial_state().ok()?;
            let changed = Problem {
                system: &system,
                initial: &initial,
                ..*problem
            };
            let once = Effort {
                repeats: 1,
                limit: effort.limit * 2,
                ..*effort
            };
            let attempt = Attempt::new(&changed, guess.method, guess.setting, &once);
            attempt.has_ended_well().then_some(attempt)
        });
        Self { attempt }
    }

    /// Last sample that is determined, and how far the motion moves up to it,
    /// relative to max|δ| so far (at least a thousandth of that of the whole run).
    pub(super) fn determined_until(&self, reference: &Trace, last: usize) -> (usize, f64) {
        let Some(changed) = &self.attempt else {
            return (last, 0.0);
        };
        let changed = trace(changed);
        let mut sizes: Vec<f64> = reference.greatest.iter().map(|g| LEAST * g).collect();
        let mut moved = 0.0f64;
        for k in 0..=last {
            let tracks = reference.samples.iter().zip(&changed.samples);
            let mut here = 0.0f64;
            for ((a, b), size) in tracks.zip(&mut sizes) {
                let [a, b] = [a, b].map(|samples| samples.get(k).copied().unwrap_or(f64::NAN));
                *size = size.max(a.abs());
                if *size > 0.0 {
                    let difference = (a - b).abs() / *size;
                    here = here.max(if difference.is_nan() {
                        f64::INFINITY
                    } else {
                        difference
                    });
                }
            }
            if here > HORIZON {
                return (k.saturating_sub(1), moved);
            }
            moved = moved.max(here);
        }
        (last, moved)
    }

    /// Figures that move by more than [`DETERMINED`] of their scale; all of
    /// them when the motion is not determined to its end.
    pub(super) fn figures(&self, reference: Option<&Figures>, throughout: bool) -> Vec<String> {
        let Some(reference) = reference else {
            return Vec::new();
        };
        let Some(moved) = self.attempt.as_ref().and_then(|a| a.figures.as_ref()) else {
            return Vec::new();
        };
        let changed = moved.addresses();
        let values = reference.addresses().into_iter();
        values
            .filter(|(figure, _)| is_result(figure))
            .filter_map(|(figure, value)| {
                let other = changed.get(&figure).copied().flatten()?;
                let far =
                    (other - value?).abs() > DETERMINED * reference.common_scale(moved, &figure);
                (far || !throughout).then_some(figure)
            })
            .collect()
    }
}
