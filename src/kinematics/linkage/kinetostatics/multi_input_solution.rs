//! What was found of the friction of a linkage of several inputs.

use super::Kinetostatics;
use super::held_pairs::{DEPENDENT, GIVEN, dot};
use super::workspace::ForceWorkspace;

impl Kinetostatics {
    /// T: the force of friction on every input (N·m or N).
    pub fn friction_on_inputs<'w>(&self, w: &'w ForceWorkspace) -> &'w [f64] {
        &w.several.force
    }

    /// Acceleration of a pair in the motion found, and the size of what it is the sum of.
    pub fn pair_acceleration(&self, pair: usize, w: &ForceWorkspace) -> [f64; 2] {
        let (inputs, several) = (self.drivers.len(), &w.several);
        let rates = &several.rates[pair * inputs..(pair + 1) * inputs];
        let mut found = [1.0, 1.0].map(|sign: f64| sign * w.pairs[pair].rates[1]);
        found[1] = found[1].abs();
        for (rate, mobility) in rates.iter().zip(several.mobility.chunks_exact(inputs)) {
            let part = rate * dot(mobility, &several.force);
            found[0] += part;
            found[1] += part.abs();
        }
        found
    }

    /// Force of each pair that has a multiplier, beyond what friction can hold at most, the
    /// `excess` in parts of that on top.
    pub fn holding_margins<'w>(
        &'w self,
        excess: f64,
        w: &'w ForceWorkspace,
    ) -> impl Iterator<Item = (usize, f64)> + 'w {
        let multipliers = &w.unknowns[self.equations_count()..];
        let held = w.several.held.iter().zip(multipliers);
        held.map(move |(&pair, multiplier)| {
            let reactions = [w.unknowns[2 * pair], w.unknowns[2 * pair + 1]];
            let limit =
                self.friction_factors[pair].map_or(0.0, |law| law.greatest_friction(reactions));
            (pair, multiplier.abs() - limit * (1.0 + excess))
        })
    }

    /// True of a pair whose motion is given, whatever forces act: the mobility along it is
    /// nothing but rounding.
    pub fn is_given(&self, pair: usize, mobility: &[f64], w: &ForceWorkspace) -> bool {
        let inputs = self.drivers.len();
        let rates = &w.several.rates[pair * inputs..(pair + 1) * inputs];
        let (mut sum, mut size) = (0.0f64, 0.0);
        for (i, one) in rates.iter().enumerate() {
            for (j, other) in rates.iter().enumerate() {
                let part = one * mobility[i * inputs + j] * other;
                sum += part;
                size += part.abs();
            }
        }
        sum <= GIVEN * size
    }

    /// Length that a unit of a pair's coordinate stands for (m).
    pub fn pair_unit(&self, pair: usize) -> f64 {
        self.units[pair]
    }

    /// Size of an input that changes the position as a whole: 1 rad, or the length scale (m).
    pub fn input_scale(&self, input: usize) -> f64 {
        self.length / self.unit_of(self.drivers[input])
    }

    /// Rates of a pair by every input.
    pub fn pair_rates<'w>(&self, pair: usize, w: &'w ForceWorkspace) -> &'w [f64] {
        let inputs = self.drivers.len();
        &w.several.rates[pair * inputs..(pair + 1) * inputs]
    }

    /// The pairs that have friction.
    pub fn pairs_with_friction(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.friction_factors.iter().enumerate();
        all.filter_map(|(pair, law)| law.map(|_| pair))
    }

    /// How a pair moves when another is pushed, with the held ones at rest: its mobility over
    /// the geometric mean of those that both have by themselves; 0 where that is rounding.
    pub fn relative_mobility(&self, pair: usize, pushed: usize, w: &ForceWorkspace) -> f64 {
        let (inputs, several) = (self.drivers.len(), &w.several);
        let [own, other] = [pair, pushed].map(|one| several.compliance_between(one, one, inputs));
        let share = several.remaining(pair, pushed, inputs) / (own * other).sqrt();
        match share.abs() > DEPENDENT {
            true => share,
            false => 0.0,
        }
    }

    /// Impulses on the inputs that take the rates of the held pairs away.
    pub fn stopping_impulses(&self, rate: impl Fn(usize) -> f64, w: &ForceWorkspace) -> Vec<f64> {
        let held = w.several.held.iter();
        let mut multipliers: Vec<f64> = held.map(|&pair| rate(pair)).collect();
        self.multipliers(&mut multipliers, w);
        let mut sum = vec![0.0; self.drivers.len()];
        for (multiplier, &pair) in multipliers.iter().zip(&w.several.held) {
            for (sum, rate) in sum.iter_mut().zip(self.pair_rates(pair, w)) {
                *sum += self.units[pair] * multiplier * rate;
            }
        }
        sum
    }

    /// Number of pairs that have multipliers: held pairs that others hold have none.
    pub fn held_pairs(&self, w: &ForceWorkspace) -> usize {
        w.several.held.len()
    }
}
