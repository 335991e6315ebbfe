//! A step from its stages: the new state, its error, the continuous output.

use super::newton::Stages;
use super::{Attempt, Radau, allowed_error};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::integrate::run::Run;
use crate::math::linear::{Entry, Lanes};

impl<const S: usize, const L: usize> Radau<S, L> {
    /// One step of a length: the new state and its derivative.
    pub(super) fn attempt_step<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) -> Attempt {
        let tolerance = allowed_error(run.tolerance());
        if !self.stages.solve(run, length, tolerance) {
            return Attempt::NotConverged;
        }
        let count = self.y.len() / 2;
        for k in 0..count {
            self.y[k] = self.stages.displacements[k][S - 1];
            self.y[count + k] = self.stages.speeds[k][S - 1];
        }
        let end = run.from.time + length;
        run.evaluator.derivatives(end, &self.y, &mut self.dy);
        if self.dy.iter().any(|entry| !entry.is_finite()) {
            return Attempt::Error(f64::NAN);
        }
        Attempt::Error(self.stages.error(&run.from.dy, length))
    }

    /// Puts the continuous output of the step into `output`.
    pub(super) fn interpolate<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) {
        let count = self.y.len() / 2;
        let first = self.stages.is_first();
        let mut bends = true;
        for k in 0..count {
            let start = [run.from.y[k], run.from.y[count + k], run.from.dy[count + k]];
            // Where the step is long against a fast mode, the acceleration at its
            // start magnifies the error of the state by (ωh)², and is left out. Just
            // after a switch it is needed: speeds within the tolerance do not tell
            // in which direction a guard that is zero sets out.
            let allowed = if first {
                f64::INFINITY
            } else {
                1.0 / self.stages.sizes[k]
            };
            bends &= self.signal(k, start, &self.stages.speeds[k].clone(), length, allowed);
        }
        if run.from.signals.len() == count {
            return;
        }
        for stage in 0..S {
            let time = run.from.time + self.stages.tableau.nodes[stage] * length;
            let [y, dy] = self.stages.at(stage);
            run.evaluator.signals(time, y, dy, &mut self.signals);
            for (rates, signal) in self.rates.iter_mut().zip(&self.signals[count..]) {
                rates[stage] = signal[1];
            }
        }
        let allowed = if bends { f64::INFINITY } else { 0.0 };
        for k in count..run.from.signals.len() {
            let rates = self.rates[k - count];
            self.signal(k, run.from.signals[k], &rates, length, allowed);
        }
    }

    /// The polynomial of a signal, less its value at the start, from rate and
    /// acceleration there and its rates at the stages. True when the acceleration was made use of: its
    /// part is at most what is `allowed`.
    fn signal(
        &mut self,
        index: usize,
        [_, rate, acceleration]: [f64; 3],
        rates: &[f64; S],
        length: f64,
        allowed: f64,
    ) -> bool {
        let output = &self.stages.tableau.output;
        let differences = rates.map(|other| length * (other - rate));
        let slope: f64 = output
            .slope
            .iter()
            .zip(&differences)
            .map(|(a, b)| a * b)
            .sum();
        let mut bend = length * length * acceleration - slope;
        let bends = (bend * output.greatest_bend).abs() <= allowed;
        if !bends {
            bend = 0.0;
        }
        let degree = S + 2;
        let row = &mut self.output[index * (degree + 1)..(index + 1) * (degree + 1)];
        for (k, out) in row.iter_mut().enumerate() {
            let curved: f64 = output.rates[k]
                .iter()
                .zip(&differences)
                .map(|(a, b)| a * b)
                .sum();
            let straight = length * rate * k as f64 / degree as f64;
            *out = straight + curved + bend * output.bend[k];
        }
        bends
    }
}

impl<const S: usize, const L: usize> Stages<S, L> {
    /// The error of the step in units of what is allowed: how far the polynomials
    /// through the rates at the stages miss the rates at the start, filtered with
    /// (I − h·λ₀·J)⁻¹ so that stiff modes do not magnify it; of order S.
    fn error(&mut self, start: &[f64], length: f64) -> f64 {
        let count = self.unknowns.len();
        let weight = self.tableau.eigenvalues[0][0] * length;
        let kappa = 1.0 / weight;
        let at_start = &self.tableau.at_start;
        let missing = |rate: f64, series: &[f64; S]| -> f64 {
            let terms = series.iter().zip(at_start);
            weight * (rate - terms.map(|(r, w)| r * w).sum::<f64>())
        };
        let (of_u, of_v) = self.y.split_at_mut(count);
        for k in 0..count {
            of_u[k] = missing(start[k], &self.speeds[k]);
            of_v[k] = missing(start[count + k], &self.accelerations[k]);
        }
        // The real system is the first of those eliminated side by side.
        let products = self.jacobian.damping_times(of_u);
        let rows = of_u.iter().zip(of_v.iter()).zip(products);
        for (unknown, ((u, v), product)) in self.unknowns.iter_mut().zip(rows) {
            *unknown = Lanes::ZERO;
            unknown.re[0] = kappa * (v + kappa * u - product);
        }
        self.matrix.solve(&mut self.unknowns);
        let mut sum = 0.0;
        for k in 0..count {
            let error = self.unknowns[k].re[0];
            let rate = kappa * (error - of_u[k]);
            sum += (error * self.sizes[k]).powi(2) + (rate * self.sizes[count + k]).powi(2);
        }
        (sum / (2 * count) as f64).sqrt()
    }

    /// State and derivative at a stage.
    fn at(&mut self, stage: usize) -> [&[f64]; 2] {
        self.take_stage_state(stage);
        let count = self.unknowns.len();
        self.dy[..count].copy_from_slice(&self.y[count..]);
        for (a, series) in self.dy[count..].iter_mut().zip(&self.accelerations) {
            *a = series[stage];
        }
        [&self.y, &self.dy]
    }
}
