//! The fixed points of the cycle map: guessed by the work of a cycle at constant
//! speed, settled by following cycles and by Newton's method.

use super::{CycleEnd, Machine, Regime};
use crate::dynamics::steady::refusal::Refusal;
use crate::math::roots::bracketed;
use crate::units::shown;

/// Cycles followed at most.
const MOST_CYCLES: u32 = 200;
/// Change of T over a cycle that counts as none.
const CLOSED: f64 = 2e-13;
/// Places at which a cycle at constant speed is looked at.
const SCAN: f64 = 256.0;

impl Machine<'_> {
    /// ∮ M(φ, ω) dφ at a constant speed, roughly.
    fn work_at(&self, speed: f64) -> f64 {
        let mut sum = 0.0;
        for (piece, [from, to]) in self.pieces() {
            let count = (SCAN * (to - from) / self.cycle).ceil().max(4.0) as usize;
            let step = (to - from) / count as f64;
            let moments =
                (0..count).map(|i| (self.at)(piece, from + (i as f64 + 0.5) * step, speed).moment);
            sum += step * moments.sum::<f64>();
        }
        sum
    }

    /// Speeds at which the forces of a cycle at constant speed balance and do
    /// less work above: guesses of steady motions that attract, descending.
    fn guesses(&self) -> Vec<f64> {
        let speeds: Vec<f64> = (0..=240)
            .map(|i| 10f64.powf(-3.0 + i as f64 / 30.0))
            .collect();
        let works: Vec<f64> = speeds.iter().map(|&speed| self.work_at(speed)).collect();
        let mut found = Vec::new();
        for i in (1..speeds.len()).rev() {
            if works[i - 1] > 0.0 && works[i] <= 0.0 {
                let ends = [speeds[i - 1], speeds[i]];
                found.push(bracketed(&mut |speed| self.work_at(speed), ends, 0.0).at);
            }
        }
        found
    }

    /// The mean of J over the cycle, roughly.
    fn mean_inertia(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for (piece, [from, to]) in self.pieces() {
            for i in 0..32 {
                let position = from + (to - from) * (f64::from(i) + 0.5) / 32.0;
                sum += (self.at)(piece, position, 0.0).inertia;
                count += 1.0;
            }
        }
        sum / count
    }

    /// The fixed point that a guess of the mean speed leads to.
    fn fixed_point(&self, guess: f64) -> Result<(f64, CycleEnd, u32), Refusal> {
        let mut energy = 0.5 * self.mean_inertia() * guess * guess;
        let mut end = self.cycle(energy);
        let mut cycles = 1;
        // A cycle that begins too slowly proves nothing.
        for _ in 0..4 {
            if end.is_err() {
                energy *= 2.0;
                end = self.cycle(energy);
                cycles += 1;
            }
        }
        let mut end = end?;
        while cycles < MOST_CYCLES {
            let miss = end.energy - energy;
            if miss.abs() <= CLOSED * energy {
                return Ok((energy, end, cycles));
            }
            let newton = energy - miss / (end.multiplier - 1.0);
            // (A multiplier of 1 makes it infinite.)
            let near = newton > 0.2 * energy && newton < 5.0 * energy;
            let mut next = if near && cycles > 2 {
                newton
            } else {
                end.energy
            };
            let mut after = self.cycle(next);
            cycles += 1;
            if after.is_err() && next != end.energy {
                next = end.energy;
                after = self.cycle(next);
                cycles += 1;
            }
            let after = after?;
            let settled = (after.energy - next).abs() >= miss.abs() && miss.abs() < 1e-11 * energy;
            if settled {
                return Ok((energy, end, cycles));
            }
            (energy, end) = (next, after);
        }
        Err(Refusal::NoCycle {
            why: format!(
                "after {MOST_CYCLES} cycles from a mean of {} rad/s the energy still \
                 changes by {} of itself in a cycle",
                shown(guess, 7),
                shown((end.energy / energy - 1.0).abs(), 2)
            ),
        })
    }

    /// The steady motion that attracts; of several the fastest.
    ///
    /// # Errors
    /// The machine stalls, or no speed is held.
    pub fn regime(&self) -> Result<Regime, Refusal> {
        let guesses = self.guesses();
        let mut found: Vec<(f64, CycleEnd, u32)> = Vec::new();
        let mut refusal = None;
        for guess in guesses {
            match self.fixed_point(guess) {
                Ok(one) => {
                    let known = |other: &(f64, CycleEnd, u32)| (other.0 / one.0 - 1.0).abs() < 1e-6;
                    if !found.iter().any(known) {
                        found.push(one);
                    }
                }
                Err(other) => refusal = refusal.or(Some(other)),
            }
        }
        let mean = |end: &CycleEnd| self.cycle / end.period;
        let best = found
            .iter()
            .position(|one| one.1.multiplier < 1.0)
            .unwrap_or(0);
        let Some(&(energy, end, cycles)) = found.get(best) else {
            return Err(refusal.unwrap_or_else(|| Refusal::NoCycle {
                why: "at no constant speed from 0.001 to 100 000 rad/s do the forces balance over \
                      a cycle and brake above it"
                    .to_owned(),
            }));
        };
        found.remove(best);
        Ok(Regime {
            energy,
            speed: self.speed(0, 0.0, energy),
            period: end.period,
            mean_speed: mean(&end),
            multiplier: end.multiplier,
            attracts: end.multiplier < 1.0,
            cycles,
            miss: (end.energy / energy - 1.0).abs(),
            others: found.iter().map(|one| mean(&one.1)).collect(),
        })
    }
}
