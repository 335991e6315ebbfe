//! Rodas5P: the own method for stiff systems.
//!
//! A Rosenbrock method: eight linear systems a step, all with one matrix (see
//! [`crate::math::linear`]), and no iteration that might fail.
//!
//! The analytic Jacobian is taken by coloured columns, eight at a time. The system is halved to
//! accelerations and eliminated sparsely, in an order without fill on trees
//! ([`super::jacobian`]): the work of a step grows with the number of masses.

mod tableau;

use super::Dynamics;
use super::jacobian::Jacobian;
use super::pace::{CAUTION, step_towards};
use super::run::{Run, Verdict};
use crate::math::linear::SparseLu;
use tableau::{COUPLINGS, GAMMA, OUTPUT, STAGES, STATES, TIME_RATES, TIMES};

/// Local error allowed per step, relative to the tolerance asked for.
const SAFETY: f64 = 1.0;
/// Order of the method by which its first step is estimated.
const ORDER: i32 = 5;
/// The error falls with the step to the power of 5: order 4 of the embedded method.
const EXPONENT: f64 = 0.2;
/// Bounds on the change of the step from one to the next.
const SHORTEST: f64 = 0.2;
const LONGEST: f64 = 6.0;

/// Takes the run as far towards its target as one leg goes: to the target or
/// to a switch.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    let known = run.rosenbrock.take();
    let mut stepper = known.unwrap_or_else(|| Box::new(Stepper::new(run.evaluator.dynamics)));
    stepper.follow_leg(run);
    run.rosenbrock = Some(stepper);
}

/// The method with its working memory; nothing is allocated between steps.
#[derive(Debug)]
pub(super) struct Stepper {
    jacobian: Jacobian,
    /// ∂f/∂t of the accelerations.
    time: Vec<f64>,
    matrix: SparseLu<f64>,
    /// k_i, one after the other (2n each).
    stages: Vec<f64>,
    /// The state of a stage, in the end the new one.
    y: Vec<f64>,
    /// The derivative there.
    dy: Vec<f64>,
    /// State in the middle of the step.
    middle: Vec<f64>,
    /// Right-hand side of a linear system (2n).
    right: Vec<f64>,
    /// Right-hand side of the reduced system (n).
    reduced: Vec<f64>,
    /// Length and error of the last accepted step, for the step control.
    last: Option<(f64, f64)>,
}

impl Stepper {
    fn new<D: Dynamics>(dynamics: &D) -> Self {
        let jacobian = Jacobian::new(dynamics);
        let count = dynamics.coordinates();
        let state = || vec![0.0; 2 * count];
        Self {
            matrix: SparseLu::new(&jacobian.pattern),
            jacobian,
            time: vec![0.0; count],
            stages: vec![0.0; STAGES * 2 * count],
            y: state(),
            dy: state(),
            middle: state(),
            right: state(),
            reduced: vec![0.0; count],
            last: None,
        }
    }

    fn follow_leg<D: Dynamics>(&mut self, run: &mut Run<'_, D>) {
        let mut wanted = run.first_length(ORDER);
        let longest = run.longest_step();
        self.last = None;
        loop {
            let (time, target) = (run.from.time, run.target);
            self.jacobian.evaluate(run.evaluator, time, &run.from.y);
            if !run.evaluator.dynamics.is_autonomous() {
                run.evaluator
                    .derivative_by_time(time, &run.from.y, &mut self.dy);
                self.time.copy_from_slice(&self.dy[self.dy.len() / 2..]);
            }
            let floor = 4.0 * f64::EPSILON * time.abs().max(target.abs());
            let (length, error) = loop {
                let length = step_towards(target - time, wanted.min(longest));
                if length <= floor {
                    run.end_at_floor(length);
                    return;
                }
                let error = self.attempt_step(run, length);
                if error <= 1.0 {
                    break (length, error);
                }
                run.rejected += 1;
                self.last = None;
                let factor = CAUTION * error.powf(-EXPONENT);
                // Not a number, or a step out of all proportion: well back.
                wanted = length * if factor > SHORTEST { factor } else { SHORTEST };
            };
            wanted = length * self.step_factor(length, error);
            let lands = length >= target - time;
            let time = if lands { target } else { time + length };
            self.interpolate(&run.from.y);
            let verdict = run.accept_step(time, &self.y, &self.dy, Some(&self.middle));
            if lands || verdict != Verdict::Continue {
                return;
            }
        }
    }

    /// Factor on the step after one of a certain error was accepted; the
    /// predictive control of K. Gustafsson (1994): where the error has grown
    /// from the last step to this one, it will go on to grow.
    fn step_factor(&mut self, length: f64, error: f64) -> f64 {
        let error = error.max(1e-8);
        let mut factor = CAUTION * error.powf(-EXPONENT);
        if let Some((before, then)) = self.last {
            let trend = (length / before) * (then / error).powf(EXPONENT);
            factor = factor.min(factor * trend);
        }
        self.last = Some((length, error));
        factor.clamp(SHORTEST, LONGEST)
    }

    /// One step of a length: the new state and its derivative; returns the
    /// error in units of what is allowed, not a number where it came to that.
    fn attempt_step<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) -> f64 {
        let kappa = 1.0 / (GAMMA * length);
        if !self.factorise(kappa) {
            return f64::NAN;
        }
        let width = self.y.len();
        let (start, evaluator) = (run.from.time, run.evaluator);
        for stage in 0..STAGES {
            if stage > 0 {
                self.y.copy_from_slice(&run.from.y);
                self.add_stages(STATES[stage]);
                let time = start + TIMES[stage] * length;
                evaluator.derivatives(time, &self.y, &mut self.dy);
                self.right.copy_from_slice(&self.dy);
            } else {
                self.right.copy_from_slice(&run.from.dy);
            }
            for (earlier, &coupling) in COUPLINGS[stage].iter().enumerate() {
                let known = &self.stages[earlier * width..(earlier + 1) * width];
                add(&mut self.right, coupling / length, known);
            }
            if TIME_RATES[stage] != 0.0 {
                let weight = TIME_RATES[stage] * length;
                add(&mut self.right[width / 2..], weight, &self.time);
            }
            self.solve(stage, kappa);
        }
        // y₁ is the state of the last stage and its k.
        let last = &self.stages[(STAGES - 1) * width..];
        add(&mut self.y, 1.0, last);
        evaluator.derivatives(start + length, &self.y, &mut self.dy);
        if self.dy.iter().any(|entry| !entry.is_finite()) {
            return f64::NAN;
        }
        self.error(run, SAFETY * run.tolerance())
    }

    /// Adds Σ weight·k to the state.
    fn add_stages(&mut self, weights: &[f64]) {
        let width = self.y.len();
        for (known, &weight) in self.stages.chunks_exact(width).zip(weights) {
            add(&mut self.y, weight, known);
        }
    }

    fn factorise(&mut self, kappa: f64) -> bool {
        let entries = self.jacobian.shifted(kappa, |entry| entry);
        self.matrix.factorise(entries)
    }

    /// k of a stage from the right-hand side of its system.
    fn solve(&mut self, stage: usize, kappa: f64) {
        let count = self.reduced.len();
        let (of_u, of_v) = self.right.split_at(count);
        let products = self.jacobian.damping_times(of_u);
        let rows = of_u.iter().zip(of_v).zip(products);
        for (reduced, ((u, v), product)) in self.reduced.iter_mut().zip(rows) {
            *reduced = v + kappa * u - product;
        }
        self.matrix.solve(&mut self.reduced);
        let out = &mut self.stages[stage * 2 * count..(stage + 1) * 2 * count];
        let (displacements, speeds) = out.split_at_mut(count);
        displacements.copy_from_slice(&self.reduced);
        for ((speed, &displacement), &known) in speeds.iter_mut().zip(&self.reduced).zip(of_u) {
            *speed = kappa * displacement - known;
        }
    }

    /// The error of the embedded method, k_8, as a root mean square in units of
    /// what is allowed.
    fn error<D: Dynamics>(&self, run: &Run<'_, D>, tolerance: f64) -> f64 {
        let width = self.y.len();
        let errors = &self.stages[(STAGES - 1) * width..];
        let dynamics = run.evaluator.dynamics;
        let squares = (0..width).map(|i| {
            let size = dynamics.error_size(i, self.y[i].abs().max(run.from.y[i].abs()));
            (errors[i] / (tolerance * size)).powi(2)
        });
        (squares.sum::<f64>() / width as f64).sqrt()
    }

    /// The continuous output in the middle of the step.
    fn interpolate(&mut self, from: &[f64]) {
        let width = self.y.len();
        for (i, middle) in self.middle.iter_mut().enumerate() {
            let sum = |weights: &[f64; STAGES]| -> f64 {
                let stages = weights.iter().enumerate();
                stages.map(|(j, w)| w * self.stages[j * width + i]).sum()
            };
            let bend = sum(&OUTPUT[0]) + 0.5 * (sum(&OUTPUT[1]) + 0.5 * sum(&OUTPUT[2]));
            *middle = 0.5 * from[i] + 0.5 * (self.y[i] + 0.5 * bend);
        }
    }
}

/// `sum` += `weight`·`other`.
fn add(sum: &mut [f64], weight: f64, other: &[f64]) {
    for (sum, other) in sum.iter_mut().zip(other) {
        *sum += weight * other;
    }
}
