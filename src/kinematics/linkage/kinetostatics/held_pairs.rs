//! Pairs that friction holds: the mobility A·G·Aᵀ of all of them by Cholesky's factor, which
//! grows pair by pair and leaves out what the others hold already.

/// A held pair that moves with the mobility of others to so many parts of its own is held by them.
pub(super) const DEPENDENT: f64 = 1e-10;
/// Parts of its terms below which a mobility is rounding: the motion of the pair is given.
pub(super) const GIVEN: f64 = 1e-12;

/// Memory for the joint friction of several inputs. n equations, p pairs, m inputs, h held pairs.
#[derive(Clone, Debug, Default)]
pub(super) struct SeveralForces {
    /// B: rows of the inertia per unit of each input's acceleration (m × n).
    pub(super) inertia: Vec<f64>,
    /// A (p × m).
    pub(super) rates: Vec<f64>,
    /// G (m × m).
    pub(super) mobility: Vec<f64>,
    /// F without friction, at the accelerations a₀ (n).
    pub(super) bare: Vec<f64>,
    /// The pairs that have multipliers.
    pub(super) held: Vec<usize>,
    /// Cholesky's factor of A·G·Aᵀ of the held pairs, row after row.
    pub(super) factor: Vec<f64>,
    /// −∂F/∂λ (h × n).
    pub(super) holding: Vec<f64>,
    /// T (m).
    pub(super) force: Vec<f64>,
    /// Room for a row.
    pub(super) row: Vec<f64>,
    /// Room for as many numbers as pairs are held.
    pub(super) small: Vec<f64>,
}

impl SeveralForces {
    /// A·G·Aᵀ of two pairs.
    pub(super) fn compliance_between(&self, one: usize, other: usize, inputs: usize) -> f64 {
        let [one, other] = [one, other].map(|pair| &self.rates[pair * inputs..(pair + 1) * inputs]);
        let rows = self.mobility.chunks_exact(inputs);
        one.iter()
            .zip(rows)
            .map(|(a, row)| a * dot(row, other))
            .sum()
    }

    /// Adds a pair to the held ones; false where it is held by them or its motion is given.
    pub(super) fn extend_factor(&mut self, pair: usize, inputs: usize) -> bool {
        let first = self.factor.len();
        for index in 0..self.held.len() {
            let start = index * (index + 1) / 2;
            let mut sum = self.compliance_between(self.held[index], pair, inputs);
            for k in 0..index {
                sum -= self.factor[start + k] * self.factor[first + k];
            }
            self.factor.push(sum / self.factor[start + index]);
        }
        let whole = self.compliance_between(pair, pair, inputs);
        let rest = self.factor[first..]
            .iter()
            .fold(whole, |sum, x| sum - x * x);
        let rates = &self.rates[pair * inputs..(pair + 1) * inputs];
        let rows = self.mobility.chunks_exact(inputs);
        let parts = rates.iter().zip(rows).map(|(a, row)| {
            let sum: f64 = row.iter().zip(rates).map(|(g, b)| (g * b).abs()).sum();
            a.abs() * sum
        });
        if !(rest > DEPENDENT * whole && whole > GIVEN * parts.sum::<f64>()) {
            self.factor.truncate(first);
            return false;
        }
        self.factor.push(rest.sqrt());
        self.held.push(pair);
        true
    }

    /// A·G·Aᵀ of two pairs with what the held pairs leave of it.
    pub(super) fn remaining(&self, one: usize, other: usize, inputs: usize) -> f64 {
        let forward = |pair: usize| {
            let mut found: Vec<f64> = Vec::with_capacity(self.held.len());
            for (index, &held) in self.held.iter().enumerate() {
                let row = &self.factor[index * (index + 1) / 2..];
                let known: f64 = found.iter().zip(row).map(|(x, f)| x * f).sum();
                found.push((self.compliance_between(held, pair, inputs) - known) / row[index]);
            }
            found
        };
        self.compliance_between(one, other, inputs) - dot(&forward(one), &forward(other))
    }

    /// (A·G·Aᵀ)⁻¹ of the held pairs on numbers, in place.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let at = |row: usize, column: usize| self.factor[row * (row + 1) / 2 + column];
        for i in 0..x.len() {
            let sum = (0..i).fold(x[i], |sum, k| sum - at(i, k) * x[k]);
            x[i] = sum / at(i, i);
        }
        for i in (0..x.len()).rev() {
            let sum = (i + 1..x.len()).fold(x[i], |sum, k| sum - at(k, i) * x[k]);
            x[i] = sum / at(i, i);
        }
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
