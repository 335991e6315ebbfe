//! The first step of a leg. There are hundreds of switches in a run: what
//! begins anew after each must not waste evaluations on finding its step.

use super::{Dynamics, run::Run};
use std::collections::BTreeMap;

/// Share of the step that would just keep the tolerance.
pub(super) const CAUTION: f64 = 0.9;
/// Local error that the methods of other crates are allowed per step, relative to the tolerance
/// asked for.
pub(super) const SHARE_OF_OTHERS: f64 = 0.1;

/// Lengths of earlier steps (s), to choose the next.
#[derive(Debug, Default)]
pub(super) struct Pace {
    /// Last accepted step of the present leg that was not cut by its end.
    pub(super) last_length: Option<f64>,
    /// Last step of the last leg in the same modes of the pairs.
    usual_lengths: BTreeMap<Vec<i64>, f64>,
}

/// The next step of a leg whose target is a `rest` away: `wanted`, but the last
/// two steps before the target are made alike.
pub(super) fn step_towards(rest: f64, wanted: f64) -> f64 {
    match wanted {
        long if 1.001 * long >= rest => rest,
        long if 2.0 * long > rest => 0.5 * rest,
        step => step,
    }
}

impl<D: Dynamics> Run<'_, D> {
    /// First step of a leg (s): the usual one in the present modes of the
    /// pairs, if they have been in force before; otherwise estimated.
    pub(super) fn first_length(&mut self, order: i32) -> f64 {
        let known = self.pace.last_length.take();
        let known = known.or_else(|| self.pace.usual_lengths.get(&self.pair_modes()).copied());
        match known {
            Some(length) => self.bounded(length),
            None => self.estimated_length(order),
        }
    }

    /// First step of a leg (s) for a method that has to begin carefully.
    pub(super) fn estimated_length(&mut self, order: i32) -> f64 {
        let length = self.estimate_length(order);
        self.bounded(length)
    }

    /// Longest step (s): of the settings, and of what a method cannot see.
    pub(super) fn longest_step(&self) -> f64 {
        let modes = self.evaluator.modes.borrow();
        let own = self.evaluator.dynamics.longest_step(&modes);
        let own = own.min(self.narrow_step()).min(self.given_longest);
        self.settings.step.map_or(own, |step| step.min(own))
    }

    fn bounded(&self, length: f64) -> f64 {
        length
            .min(self.longest_step())
            .min(self.target - self.from.time)
    }

    /// The leg ends at a switch or a break: keeps what step was usual in it.
    pub(super) fn remember_length(&mut self) {
        if let Some(length) = self.pace.last_length.take() {
            self.pace.usual_lengths.insert(self.pair_modes(), length);
        }
    }

    fn pair_modes(&self) -> Vec<i64> {
        let modes = self.evaluator.modes.borrow();
        let pairs = modes.0.iter().enumerate();
        pairs
            .filter(|&(component, _)| self.evaluator.dynamics.is_pair(component))
            .map(|(_, &mode)| mode)
            .collect()
    }

    /// A first step from how fast the state and its derivative change, in
    /// units of the scales: with Ω = max(|ẏ|, √|ÿ|), a solution like sin Ωt
    /// keeps the tolerance for Ωh ≈ tolerance^(1/(order+1)).
    fn estimate_length(&mut self, order: i32) -> f64 {
        let span = self.target - self.from.time;
        let scales = self.evaluator.dynamics.scales();
        let unit = |index: usize| scales[index] + self.from.y[index].abs();
        let size = |dy: &dyn Fn(usize) -> f64| {
            let squares = (0..scales.len()).map(|i| (dy(i) / unit(i)).powi(2));
            (squares.sum::<f64>() / scales.len() as f64).sqrt()
        };
        let rate = size(&|i| self.from.dy[i]);
        let short = (1e-4 * span).min(1e-3 / rate);
        let moved = self.from.y.iter().zip(&self.from.dy);
        let moved: Vec<f64> = moved.map(|(y, dy)| y + short * dy).collect();
        let mut dy = vec![0.0; moved.len()];
        self.evaluator
            .derivatives(self.from.time + short, &moved, &mut dy);
        self.evaluator.take_not_finite();
        let change = size(&|i| (dy[i] - self.from.dy[i]) / short);
        let fastest = rate.max(change.sqrt());
        let wanted = self.settings.tolerance.powf(1.0 / f64::from(order + 1)) / fastest;
        // Nothing moves, or the trial point was no number: begin carefully.
        if wanted.is_finite() {
            wanted
        } else {
            1e-3 * span
        }
    }
}
