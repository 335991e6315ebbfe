//! Signals that are given functions of time: what a step's polynomial makes of them.
//!
//! The control of the error sees coordinates alone. A drive behind which nothing moves for a
//! while lets steps grow, and a long step's polynomial tells another motion of the drive than
//! it has: guards would find switches that are none, and pass over others.

use super::Run;
use crate::dynamics::integrate::{Dynamics, EventFunction};

/// Places of a step that are looked at: beside the ones that polynomials are made through.
const PLACES: [f64; 2] = [0.35, 0.8];

/// What a signal may be off, as a share of its change over the step: enough to see each switch.
const SEEN: f64 = 1e-3;

/// What counts as rounding of a signal, as a share of it.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The order of the polynomials that this is about, at least.
const ORDER: f64 = 6.0;
/// Bounds of what a step is shortened by.
const SHORTEST: f64 = 0.2;
const LONGEST: f64 = 0.8;

/// Steps after which a longer one is tried, and how many times as long it may be.
const TRIED: u32 = 16;
const LONGER: f64 = 4.0;

/// Shortest step that is still shortened, in roundings of the time.
const SHORT: f64 = 4096.0 * f64::EPSILON;

impl<D: Dynamics> Run<'_, D> {
    /// Steps are no longer than that (s), until longer ones are tried.
    pub(super) fn shorten(&mut self, length: f64) {
        self.given_longest = length;
        self.given_steps = 0;
    }

    /// True when steps have been short for a while and longer ones are to be tried: a motion
    /// may be steep for a moment alone. The step that was taken is behind the run.
    pub(super) fn is_to_lengthen(&mut self) -> bool {
        if self.given_longest.is_infinite() {
            return false;
        }
        self.given_steps += 1;
        if self.given_steps < TRIED {
            return false;
        }
        let length = self.from.time - self.to.time;
        let binds = LONGER * length > self.given_longest;
        self.shorten(LONGER * self.given_longest);
        binds
    }

    /// The length (s) of a shorter step, where the polynomial of this one misses a given signal.
    pub(super) fn misses_given_signal(&self) -> Option<f64> {
        let greatest = PLACES
            .into_iter()
            .flat_map(|s| self.missed_stretches(s))
            .map(|(off, moved)| off / (SEEN * moved))
            .fold(0.0, f64::max);
        let step = self.output.step(1.0);
        let factor = (0.9 * greatest.powf(-1.0 / ORDER)).clamp(SHORTEST, LONGEST);
        let may_shorten = step.length > SHORT * step.time(1.0).abs();
        (greatest > 1.0 && may_shorten).then_some(factor * step.length)
    }

    /// True when a switch at a place of the step is one of given signals, which its polynomial
    /// does not know there to the tolerance.
    pub(super) fn is_misplaced(&self, watch: &EventFunction, s: f64) -> bool {
        let tolerance = self.settings.tolerance;
        let count = self.evaluator.dynamics.coordinates();
        let watched = |signal: usize| watch.guards.iter().any(|guard| guard.signal == signal);
        let missed = (count..self.from.signals.len())
            .filter(|signal| watched(*signal))
            .filter_map(|signal| self.missed_by(signal, s));
        missed
            .into_iter()
            .any(|(off, moved)| off > tolerance * moved)
    }

    fn missed_stretches(&self, s: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let count = self.evaluator.dynamics.coordinates();
        (count..self.from.signals.len()).filter_map(move |signal| self.missed_by(signal, s))
    }

    /// What the polynomial of a given signal is off at a place, beyond rounding, and the range
    /// of the signal over the step.
    fn missed_by(&self, signal: usize, s: f64) -> Option<(f64, f64)> {
        let step = self.output.step(1.0);
        let [exact, _] = self.evaluator.dynamics.given_signal(signal, step.time(s))?;
        let row = step.differences(signal);
        let [low, high] = row
            .iter()
            .fold([0.0f64; 2], |[low, high], c| [low.min(*c), high.max(*c)]);
        let off = (step.value(signal, s).0 - exact).abs() - ROUNDING * exact.abs();
        (off > 0.0).then_some((off, high - low))
    }
}
