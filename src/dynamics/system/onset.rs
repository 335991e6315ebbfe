//! The discrete state just after t = 0.
//!
//! A pair that only touches (p = 0, or no force) is engaged or open by what
//! happens next: by the sign of the first derivative of p and of the pressing
//! force that does not vanish. The motion just after t = 0 is developed into a
//! series in time under a supposition about every pair; suppositions that it
//! contradicts are changed until none is.

use super::System;
use super::frozen::Frozen;
use super::pairs::OPEN;
use super::passes::{Extent, Work};
use crate::math::bounded_series::{ORDER, Series};

impl System {
    /// Settles the modes of all pairs for the motion that leaves `state`;
    /// those given are the first supposition. `noise` is the size of the
    /// numbers whose rounding is in each state entry.
    pub(super) fn settle_pairs(&self, state: &[f64], noise: &[f64], modes: &mut [i64]) {
        let frozen = &self.frozen;
        if frozen.pairs.is_empty() {
            return;
        }
        let mut decided = true;
        for (pair, mode) in modes[..frozen.pairs.len()].iter_mut().enumerate() {
            match frozen.mode_of_state(pair, state, noise) {
                Some(now) => *mode = now,
                None => decided = false,
            }
        }
        if decided {
            return;
        }
        let mut tried: Vec<Vec<i64>> = Vec::new();
        // Each round changes one pair; a supposition that comes back means that
        // no motion is free of contradiction, and the first is kept.
        while !tried.iter().any(|before| before == modes) {
            tried.push(modes.to_vec());
            let motion = frozen.develop(state, noise, modes);
            let contradicted = (0..frozen.pairs.len())
                .map(|pair| (pair, frozen.mode_of_motion(pair, &motion)))
                .find(|&(pair, mode)| mode != modes[pair]);
            match contradicted {
                Some((pair, mode)) => modes[pair] = mode,
                None => return,
            }
        }
        modes.copy_from_slice(&tried[0]);
    }
}

impl Frozen {
    /// The motion that leaves a state, as series: [u, u̇]; no further than it
    /// takes to tell what every pair does.
    fn develop(&self, state: &[f64], noise: &[f64], modes: &[i64]) -> Vec<Series> {
        let n = self.coordinates;
        let mut state = state.to_vec();
        self.settle_points(&mut state, modes);
        let mut motion: Vec<Series> = vec![Series::constant(0.0, 0.0); 2 * n];
        for index in 0..n {
            motion[index].set(0, state[index], noise[index]);
            motion[index].set(1, state[n + index], noise[n + index]);
            motion[n + index] = motion[index].rate();
        }
        let mut work = Work::new(self);
        let mut accelerations = vec![Series::constant(0.0, 0.0); n];
        for power in 0..=ORDER - 2 {
            // One power beyond: no more is known of the motion.
            let time = Series::time(power + 1);
            self.evaluate(
                time,
                &motion,
                modes,
                Extent::Needed,
                &mut work,
                &mut accelerations,
            );
            let factor = 1.0 / ((power + 1) * (power + 2)) as f64;
            for index in 0..n {
                let acceleration = &accelerations[index];
                let value = factor * acceleration.coefficients[power];
                motion[index].set(power + 2, value, factor * acceleration.magnitude(power));
                motion[n + index] = motion[index].rate();
            }
            if self.tells(&motion, power + 1) {
                break;
            }
        }
        motion
    }

    /// True when a motion of which the powers up to `known` of displacements and
    /// rates are known decides every pair: what is not known yet comes after the
    /// first derivative that does not vanish.
    fn tells(&self, motion: &[Series], known: usize) -> bool {
        self.pairs.iter().all(|&chain| {
            let chain = &self.chains[chain];
            let (u, v) = self.deviations(chain, motion);
            let mut guards = chain.contact.sides().iter().flat_map(|&side| {
                let presses = chain.contact.presses(side, u[0], v[0]);
                presses.map(|guard| guard.leading())
            });
            guards.all(|power| power.is_some_and(|power| power <= known))
        })
    }

    /// The mode that a pair has by its state alone, without looking ahead;
    /// `None` when it just touches or just presses.
    fn mode_of_state(&self, pair: usize, state: &[f64], noise: &[f64]) -> Option<i64> {
        let chain = &self.chains[self.pairs[pair]];
        let (x, v) = (
            chain.first_coordinate,
            chain.first_coordinate + self.coordinates,
        );
        let (x, v) = (
            Series::constant(state[x], noise[x]),
            Series::constant(state[v], noise[v]),
        );
        let mut mode = OPEN;
        for &side in chain.contact.sides() {
            let presses = chain.contact.presses(side, x, v);
            let [depth, pressing] = presses.map(|guard| guard.sign());
            if depth > 0.0 && pressing > 0.0 {
                mode = side;
            } else if depth >= 0.0 && pressing >= 0.0 {
                return None;
            }
        }
        Some(mode)
    }

    /// The mode that a pair has in a motion.
    fn mode_of_motion(&self, pair: usize, motion: &[Series]) -> i64 {
        let chain = &self.chains[self.pairs[pair]];
        let (u, v) = self.deviations(chain, motion);
        let engaged = |&&side: &&i64| {
            let presses = chain.contact.presses(side, u[0], v[0]);
            presses.iter().all(|guard| guard.sign() > 0.0)
        };
        chain
            .contact
            .sides()
            .iter()
            .find(engaged)
            .copied()
            .unwrap_or(OPEN)
    }
}
