//! How a step of a power series multiplies small deviations: the stability of
//! the method, measured on the system itself.

use super::{Scratch, System};
use crate::dynamics::integrate::{Dynamics, Modes};
use nalgebra::DMatrix;

/// Deviations are made of this share of the scales of the state.
const DEVIATION: f64 = 1e-3;

impl System {
    /// The greatest factor by which a step of length `length` (s), taken with a
    /// power series of a degree, multiplies a deviation: the spectral radius of
    /// the step, all pairs engaged, on the law at t = 0. `None`: there are no
    /// series, no coordinates, or no finite numbers.
    pub(crate) fn growth_in_step(&self, degree: usize, length: f64) -> Option<f64> {
        let n = self.coordinates();
        if n == 0 || !self.expands() {
            return None;
        }
        let (state, modes) = self.engaged_start();
        let mut leap = Leap {
            system: self,
            modes,
            length,
            scratch: self.scratch(),
            rates: vec![0.0; 2 * n],
            series: vec![0.0; self.signals() * (degree + 1)],
        };
        let mut ends = [vec![0.0; 2 * n], vec![0.0; 2 * n]];
        let mut factors = DMatrix::zeros(2 * n, 2 * n);
        for j in 0..2 * n {
            for (end, side) in ends.iter_mut().zip([1.0, -1.0]) {
                end.copy_from_slice(&state);
                end[j] += side * DEVIATION * self.scales()[j];
                leap.advance_state(degree, end);
            }
            for i in 0..2 * n {
                let moved = (ends[0][i] - ends[1][i]) / self.scales()[i];
                factors[(i, j)] = moved / (2.0 * DEVIATION);
            }
        }
        if factors.iter().any(|factor| !factor.is_finite()) {
            return None;
        }
        let values = super::frequencies::eigenvalues(factors)?;
        let sizes = values.iter().map(|[re, im]| re.hypot(*im));
        sizes.reduce(f64::max)
    }
}

/// A step of a power series.
struct Leap<'s> {
    system: &'s System,
    modes: Modes,
    length: f64,
    scratch: Scratch,
    rates: Vec<f64>,
    series: Vec<f64>,
}

impl Leap<'_> {
    /// Moves a state on.
    fn advance_state(&mut self, degree: usize, y: &mut [f64]) {
        let (n, modes, scratch) = (y.len() / 2, &self.modes, &mut self.scratch);
        self.system
            .derivatives(0.0, y, modes, scratch, &mut self.rates);
        let (span, out) = ([0.0, self.length], &mut self.series);
        self.system
            .expand(span, y, &self.rates, modes, degree, scratch, out);
        for (k, row) in self.series.chunks_exact(degree + 1).take(n).enumerate() {
            y[k] = row.iter().sum();
            let slopes = row.iter().enumerate().map(|(order, c)| order as f64 * c);
            y[n + k] = slopes.sum::<f64>() / self.length;
        }
    }
}
