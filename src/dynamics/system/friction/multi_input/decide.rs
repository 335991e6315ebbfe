//! Where pairs of a linkage of several inputs stop: which go on, turn back or rest.

use super::super::standstill::AT_REST;
use super::super::stick_slip::{ProbeAction, StickSlip};
use super::continuations::Ways;
use super::{JUST_STARTED, Several, SeveralWork};
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::system::System;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::kinematics::linkage::kinetostatics::Sliding;

/// Pairs at rest at once of which all ways are looked at.
const MOST_AT_REST: usize = 9;
/// Rounds in which the rates of pairs at rest are taken out of a state.
const ROUNDS: usize = 2;
/// What moves with a pair that has come to rest, and with nothing else, has come to rest with it
/// where its rate is so many times what is left of that. More, where a pair merely passes a
/// position in which it does not move.
const QUICKER: f64 = 1e3;
/// Rounding of the time at which a pair comes to rest.
const CLOCK: f64 = 1e-12;

impl System {
    /// Passes a switch of the linkage of several inputs.
    pub(in crate::dynamics::system::friction) fn pass_pair(
        &self,
        time: f64,
        y: &mut [f64],
        (component, target): (usize, i64),
        modes: &mut [i64],
    ) -> Result<(), PhysicalStop> {
        let Some(several) = &self.frozen.several else {
            return Ok(());
        };
        if ProbeAction::of(target) == ProbeAction::Stop {
            return Err(self.multi_input_unsolved(several, time, y, modes));
        }
        let pairs = several.pairs.iter();
        let stops = ProbeAction::of(target) == ProbeAction::Start(StickSlip::Stuck);
        let now = pairs.filter(|pair| stops && pair.component == component);
        let stopped: Vec<usize> = now.map(|pair| pair.pair).collect();
        self.decide_pairs(several, (time, y), &stopped, modes)
    }

    /// Directions of all pairs at t = 0: by their rates, and where they rest by what they do
    /// next.
    pub(in crate::dynamics::system::friction) fn settle_multi_input_pairs(
        &self,
        y: &mut [f64],
        modes: &mut [i64],
    ) {
        let Some(several) = &self.frozen.several else {
            return;
        };
        let mut work = Work::new(&self.frozen);
        let Some(own) = self.frozen.evaluate_pairs((0.0, y, modes), &mut work) else {
            return;
        };
        let mut stopped = Vec::new();
        for pair in &several.pairs {
            let [rate, size] = several.rate(pair.pair, own);
            let state = match rate {
                rate if rate.abs() <= AT_REST * size => StickSlip::Stuck,
                rate if rate > 0.0 => StickSlip::Forward,
                _ => StickSlip::Backward,
            };
            modes[pair.component] = state.mode();
            if state == StickSlip::Stuck {
                stopped.push(pair.pair);
            }
        }
        // An undetermined start ends the run at once, with its reason.
        let _ = self.decide_pairs(several, (0.0, y), &stopped, modes);
    }

    /// Decides what all pairs that stand do next, those that have just `stopped` among them.
    fn decide_pairs(
        &self,
        several: &Several,
        (time, y): (f64, &mut [f64]),
        stopped: &[usize],
        modes: &mut [i64],
    ) -> Result<(), PhysicalStop> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        let before = modes.to_vec();
        // What was held starts from rest, not from what rounding has left of its rate.
        for _ in 0..ROUNDS {
            frozen.stop_pairs(several, (time, y, modes), &mut work);
        }
        for pair in several
            .pairs
            .iter()
            .filter(|one| stopped.contains(&one.pair))
        {
            modes[pair.component] = StickSlip::Stuck.mode();
        }
        let Some(own) = frozen.evaluate_pairs((time, y, modes), &mut work) else {
            return Ok(());
        };
        for (place, pair) in several.stopped_along(time, stopped, own) {
            modes[several.pairs[place].component] = StickSlip::Stuck.mode();
            own.sliding[pair] = Sliding::Held;
        }
        let mut ways = Ways::new(several, own);
        let resting = ways.resting();
        // (Nothing has stopped where something is about to start.)
        let start = stopped.is_empty();
        if resting.len() > MOST_AT_REST {
            // Too many ways to look at: what rests stays so, if it can.
            return match ways.loosens(&resting, 0.0) {
                Some(margin) if margin <= 0.0 => {
                    several.record_full_stick(modes);
                    Ok(())
                }
                _ => Err(self.too_many_at_rest(several, time, resting.len())),
            };
        }
        let found = ways.consistent(&resting, start);
        let [way] = &found[..] else {
            return Err(self.ambiguous_continuation(several, time, found.len()));
        };
        let own = &*ways.own;
        for (pair, direction) in resting.iter().zip(&way.directions) {
            let mut pairs = several.pairs.iter();
            if let Some(one) = pairs.find(|one| one.pair == *pair) {
                let was_at_rest = time == 0.0 || !stopped.contains(pair);
                let apart = was_at_rest || before[one.component].abs() >= JUST_STARTED;
                modes[one.component] = match *direction {
                    0 => StickSlip::Stuck.mode(),
                    direction if apart => {
                        let [rate, _] = several.rate(*pair, own);
                        i64::from(direction) * one.started(rate)
                    }
                    direction => i64::from(direction),
                };
            }
        }
        several.record_full_stick(modes);
        for _ in 0..ROUNDS {
            frozen.stop_pairs(several, (time, y, modes), &mut work);
        }
        Ok(())
    }
}

impl Several {
    /// Writes down whether friction holds all of it.
    fn record_full_stick(&self, modes: &mut [i64]) {
        let all = self.states(modes).all(|state| state == StickSlip::Stuck);
        let state = if all {
            StickSlip::Stuck
        } else {
            StickSlip::Forward
        };
        modes[self.component] = state.mode();
    }

    /// Pairs that slide by the modes, but have come to rest with those that have `stopped`: their
    /// place among the pairs with friction, and their number.
    fn stopped_along(
        &self,
        time: f64,
        stopped: &[usize],
        own: &mut SeveralWork<f64>,
    ) -> Vec<(usize, usize)> {
        let mut ways = Ways::new(self, own);
        for pair in &self.pairs {
            if let Sliding::Slides(_) = ways.own.sliding[pair.pair] {
                ways.set(pair.pair, Sliding::Idle);
            }
        }
        if stopped.is_empty() || !ways.find() {
            return Vec::new();
        }
        // As lengths, so that pins and guides compare.
        let way = |pair: usize| {
            let unit = self.kinetostatics.pair_unit(pair);
            unit * self.rate(pair, ways.own)[0].abs()
        };
        // (Without friction: with what is held it may be anything.)
        let quickening = |pair: usize| {
            let rates = self.kinetostatics.pair_rates(pair, &ways.own.forces);
            let parts = rates.iter().zip(&ways.own.free);
            let sum: f64 = parts.map(|(rate, free)| (rate * free).abs()).sum();
            self.kinetostatics.pair_unit(pair) * sum
        };
        let left = stopped
            .iter()
            .fold(0.0, |most: f64, &pair| most.max(way(pair)));
        let along = self.pairs.iter().enumerate().filter(|(_, pair)| {
            let pair = pair.pair;
            let slides = matches!(ways.own.sliding[pair], Sliding::Slides(_));
            slides
                && ways.is_held_by_others(pair)
                && way(pair) <= QUICKER * left + CLOCK * time * quickening(pair)
        });
        along.map(|(place, pair)| (place, pair.pair)).collect()
    }
}

impl Frozen {
    /// Evaluates a state, friction as the modes say; the memory of it. `None` where the linkage
    /// has no forces there, whatever friction does.
    fn evaluate_pairs<'w>(
        &self,
        (time, state, modes): (f64, &[f64], &[i64]),
        work: &'w mut Work<f64>,
    ) -> Option<&'w mut SeveralWork<f64>> {
        let mut out = vec![0.0; self.coordinates];
        self.evaluate(time, state, modes, Extent::Full, work, &mut out);
        let linkage = self.several.as_ref()?.linkage;
        if !work.multi[linkage].assembled {
            return None;
        }
        let own = work.several.as_deref_mut()?;
        let finite = own.free.iter().all(|free| free.is_finite());
        finite.then_some(own)
    }

    /// Takes the rates of the pairs at rest out of a state, by impulses in these pairs.
    fn stop_pairs(
        &self,
        several: &Several,
        (time, state, modes): (f64, &mut [f64], &[i64]),
        work: &mut Work<f64>,
    ) {
        let Some(own) = self.evaluate_pairs((time, state, modes), work) else {
            return;
        };
        let mut ways = Ways::new(several, own);
        if ways.resting().is_empty() || !ways.find() {
            return;
        }
        let roots = self.roots.len();
        let impulses = several.stopping_impulses(ways.own);
        for (impulse, response) in impulses
            .iter()
            .zip(ways.own.response.chunks_exact(roots.max(1)))
        {
            for (root, response) in self.roots.iter().zip(response) {
                state[self.coordinates + root.coordinate] += impulse * response;
            }
        }
    }
}

impl Several {
    /// Impulses on the inputs that bring the held pairs to rest.
    fn stopping_impulses(&self, own: &SeveralWork<f64>) -> Vec<f64> {
        let rate = |pair: usize| self.rate(pair, own)[0];
        self.kinetostatics.stopping_impulses(rate, &own.forces)
    }
}
