//! The stages of a step, and Newton's simplified iteration for them.

use super::tableau::{Tableau, times};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::integrate::jacobian::Jacobian;
use crate::dynamics::integrate::run::Run;
use crate::math::linear::{Entry, Lanes, SparseLu};

/// Most iterations of a step.
const ITERATIONS: u32 = 9;
/// What is left of Newton's error, relative to the error allowed for the step.
const LEFT: f64 = 0.003;

/// A contraction above this will not do.
const SLOWEST: f64 = 0.9;

/// Accelerations, speeds and displacements at the stages, and what is needed to
/// solve for them.
#[derive(Debug)]
pub(super) struct Stages<const S: usize, const L: usize> {
    pub(super) tableau: &'static Tableau<S, L>,
    pub(super) jacobian: Jacobian,
    pub(super) matrix: SparseLu<Lanes<L>>,
    /// Of every coordinate at the stages (n).
    pub(super) displacements: Vec<[f64; S]>,
    pub(super) speeds: Vec<[f64; S]>,
    pub(super) accelerations: Vec<[f64; S]>,
    residuals: Vec<[f64; S]>,
    /// Right-hand sides and solutions of the linear systems (n).
    pub(super) unknowns: Vec<Lanes<L>>,
    /// A state and its derivative (2n).
    pub(super) y: Vec<f64>,
    pub(super) dy: Vec<f64>,
    /// Sizes that errors are measured by (2n).
    pub(super) sizes: Vec<f64>,
    /// Length of the last step, whose accelerations the next continues (s).
    before: Option<f64>,
    first: bool,
}

impl<const S: usize, const L: usize> Stages<S, L> {
    pub(super) fn new<D: Dynamics>(dynamics: &D, tableau: &'static Tableau<S, L>) -> Self {
        let jacobian = Jacobian::new(dynamics);
        let count = dynamics.coordinates();
        let series = || vec![[0.0; S]; count];
        Self {
            tableau,
            matrix: SparseLu::new(&jacobian.pattern),
            jacobian,
            displacements: series(),
            speeds: series(),
            accelerations: series(),
            residuals: series(),
            unknowns: vec![Lanes::ZERO; count],
            y: vec![0.0; 2 * count],
            dy: vec![0.0; 2 * count],
            sizes: vec![1.0; 2 * count],
            before: None,
            first: true,
        }
    }

    /// The next step does not continue the last.
    pub(super) fn forget_stages(&mut self) {
        self.before = None;
        self.first = true;
    }

    /// True for a step that does not continue the last.
    pub(super) fn is_first(&self) -> bool {
        self.first
    }

    /// The stages are those of an accepted step of a length.
    pub(super) fn keep_stages(&mut self, length: f64) {
        self.before = Some(length);
        self.first = false;
    }

    /// Solves for the stages of a step of a length. False where that fails.
    pub(super) fn solve<D: Dynamics>(
        &mut self,
        run: &Run<'_, D>,
        length: f64,
        tolerance: f64,
    ) -> bool {
        self.predict(run, length);
        let middle = S / 2;
        let time = run.from.time + self.tableau.nodes[middle] * length;
        self.take_stage_state(middle);
        self.jacobian.evaluate(run.evaluator, time, &self.y);
        if !self.factorise(length) {
            return false;
        }
        let dynamics = run.evaluator.dynamics;
        for (index, (size, y)) in self.sizes.iter_mut().zip(&run.from.y).enumerate() {
            *size = 1.0 / (tolerance * dynamics.error_size(index, *y));
        }
        self.iterate_stages(run, length)
    }

    /// First approximation: the accelerations of the last step continued, or that
    /// at the start.
    fn predict<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) {
        let count = self.accelerations.len();
        match self.before.take() {
            Some(before) => {
                let weights = self.continuation(length / before);
                for series in &mut self.accelerations {
                    *series = times(&weights, series);
                }
            }
            None => {
                for (series, &start) in self.accelerations.iter_mut().zip(&run.from.dy[count..]) {
                    *series = [start; S];
                }
            }
        }
        self.integrate(&run.from.y, length);
    }

    /// Weights of the polynomial through the stages at the nodes of a next step
    /// `ratio` times as long.
    fn continuation(&self, ratio: f64) -> super::tableau::Matrix<S> {
        let (nodes, weights) = (&self.tableau.nodes, &self.tableau.weights);
        let mut out = [[0.0; S]; S];
        for i in 0..S {
            let x = 1.0 + ratio * nodes[i];
            let product: f64 = nodes.iter().map(|node| x - node).product();
            for j in 0..S {
                out[j][i] = product * weights[j] / (x - nodes[j]);
            }
        }
        out
    }

    /// Speeds and displacements from the accelerations and the state at the start.
    fn integrate(&mut self, from: &[f64], length: f64) {
        let count = self.accelerations.len();
        let (u, v) = from.split_at(count);
        let tableau = self.tableau;
        for k in 0..count {
            let once = times(&tableau.once, &self.accelerations[k]);
            let twice = times(&tableau.twice, &self.accelerations[k]);
            for i in 0..S {
                self.speeds[k][i] = v[k] + length * once[i];
                self.displacements[k][i] =
                    u[k] + length * (tableau.nodes[i] * v[k] + length * twice[i]);
            }
        }
    }

    /// The state at a stage.
    pub(super) fn take_stage_state(&mut self, stage: usize) {
        let (u, v) = self.y.split_at_mut(self.displacements.len());
        for (u, series) in u.iter_mut().zip(&self.displacements) {
            *u = series[stage];
        }
        for (v, series) in v.iter_mut().zip(&self.speeds) {
            *v = series[stage];
        }
    }

    /// κ = 1/(h·λ) of every eigenvalue.
    fn kappa(&self, length: f64) -> Lanes<L> {
        let eigenvalues = self.tableau.eigenvalues;
        Lanes::of(|l| eigenvalues[l].map(|part| length * part)).reciprocal()
    }

    fn factorise(&mut self, length: f64) -> bool {
        let real = |value: f64| Lanes {
            re: [value; L],
            im: [0.0; L],
        };
        let entries = self.jacobian.shifted(self.kappa(length), real);
        self.matrix.factorise(entries)
    }

    fn iterate_stages<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) -> bool {
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            self.defects(run, length);
            let change = self.improve(length);
            if !change.is_finite() {
                return false;
            }
            if iteration > 0 {
                let contraction = change / before;
                if contraction >= SLOWEST && change > LEFT {
                    return false;
                }
                let contraction = contraction.min(SLOWEST);
                let rest = change * contraction / (1.0 - contraction);
                if rest <= LEFT {
                    return true;
                }
                // Too slow to come to an end in time.
                let left = (ITERATIONS - 1 - iteration) as i32;
                if rest * contraction.powi(left) > LEFT {
                    return false;
                }
            } else if change <= LEFT {
                // How fast it converges is not known before the second.
                return true;
            }
            before = change;
        }
        false
    }

    /// What is missing in the equations of motion at the stages.
    fn defects<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) {
        let count = self.accelerations.len();
        for stage in 0..S {
            self.take_stage_state(stage);
            let time = run.from.time + self.tableau.nodes[stage] * length;
            run.evaluator.derivatives(time, &self.y, &mut self.dy);
            let found = self.dy[count..].iter().zip(&self.accelerations);
            for (residual, (found, series)) in self.residuals.iter_mut().zip(found) {
                residual[stage] = found - series[stage];
            }
        }
    }

    /// One step of the iteration; returns its size in units of the error allowed.
    fn improve(&mut self, length: f64) -> f64 {
        let (tableau, count) = (self.tableau, self.accelerations.len());
        let kappa = self.kappa(length);
        let square = kappa.times(kappa);
        for (unknown, residual) in self.unknowns.iter_mut().zip(&self.residuals) {
            let parts = times(&tableau.inverse, residual);
            *unknown = lanes(&parts).times(square);
        }
        self.matrix.solve(&mut self.unknowns);
        let mut sum = 0.0;
        for k in 0..count {
            let parts = real_parts(&self.unknowns[k]);
            let change = times(&tableau.eigenvectors, &parts);
            let once = times(&tableau.once_eigenvectors, &parts);
            let twice = times(&tableau.twice_eigenvectors, &parts);
            let (of_u, of_v) = (
                self.sizes[k] * length * length,
                self.sizes[count + k] * length,
            );
            for i in 0..S {
                self.accelerations[k][i] += change[i];
                self.speeds[k][i] += length * once[i];
                self.displacements[k][i] += length * length * twice[i];
                sum += (of_u * twice[i]).powi(2) + (of_v * once[i]).powi(2);
            }
        }
        (sum / (2 * S * count) as f64).sqrt()
    }
}

/// A vector over the stages in terms of the eigenvectors, as complex numbers: of
/// a pair of eigenvalues the one above the real axis.
#[inline(always)]
fn lanes<const S: usize, const L: usize>(parts: &[f64; S]) -> Lanes<L> {
    Lanes::of(|l| match l {
        0 => [parts[0], 0.0],
        _ => [parts[2 * l - 1], -parts[2 * l]],
    })
}

#[inline(always)]
fn real_parts<const S: usize, const L: usize>(lanes: &Lanes<L>) -> [f64; S] {
    let mut out = [0.0; S];
    out[0] = lanes.re[0];
    for l in 1..L {
        out[2 * l - 1] = lanes.re[l];
        out[2 * l] = -lanes.im[l];
    }
    out
}
