//! The published test lever as a chain of n masses.

use super::{Forced, plain_system, sine};
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard, Modes};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The rocker of n masses with force closure: coordinates u = φ_m − U, position
/// function U = (π/2)·sin 2πνt. Component 0 of the modes: −1 engaged, 0 open.
pub(crate) struct Rocker {
    inertia: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    moment: f64,
    omega: f64,
    scales: Vec<f64>,
}

impl Rocker {
    /// Inertia J split by cubes, c_m = n·c, b_m = ψ·c_m/(2π·√(c/J)).
    pub(crate) fn new(masses: usize, j: f64, c: f64, moment: f64, psi: f64, nu: f64) -> Self {
        let n = masses as f64;
        let cube = |m: usize| (m as f64 / n).powi(3);
        let omega = TAU * nu;
        let load = moment + j * FRAC_PI_2 * omega * omega;
        let mut scales = vec![load / c; masses];
        scales.extend(vec![load / (c * j).sqrt(); masses]);
        Self {
            inertia: (1..=masses).map(|m| j * (cube(m) - cube(m - 1))).collect(),
            stiffness: vec![n * c; masses],
            damping: vec![psi * n * c / (TAU * (c / j).sqrt()); masses],
            moment,
            omega,
            scales,
        }
    }

    /// The published test lever: J = 0.1, c = 10⁷, M = 600, ν = 10 Hz.
    pub(crate) fn published(masses: usize, psi: f64) -> Self {
        Self::new(masses, 0.1, 1e7, 600.0, psi, 10.0)
    }

    /// Start `static`: every link carries the moment, all speeds relative to
    /// the law are zero.
    pub(crate) fn static_start(&self) -> (Vec<f64>, Modes) {
        let mut y = Vec::new();
        let mut u = 0.0;
        for c in &self.stiffness {
            u -= self.moment / c;
            y.push(u);
        }
        y.resize(2 * y.len(), 0.0);
        (y, Modes(vec![-1]))
    }

    /// φ_n and its rate at a state.
    pub(crate) fn last(&self, t: f64, y: &[f64]) -> [f64; 2] {
        let n = self.inertia.len();
        let angle = self.omega * t;
        [
            y[n - 1] + FRAC_PI_2 * angle.sin(),
            y[2 * n - 1] + FRAC_PI_2 * self.omega * angle.cos(),
        ]
    }

    /// The linear part, for states as for directions.
    fn forces(&self, engaged: bool, y: &[f64], load: f64, bias: f64, out: &mut [f64]) {
        let n = self.inertia.len();
        let (u, v) = y.split_at(n);
        let link = |m: usize| match m {
            0 => self.stiffness[0] * u[0] + self.damping[0] * v[0],
            _ => self.stiffness[m] * (u[m] - u[m - 1]) + self.damping[m] * (v[m] - v[m - 1]),
        };
        let mut before = if engaged { link(0) } else { 0.0 };
        for m in 0..n {
            let after = if m + 1 < n { link(m + 1) } else { load };
            out[m] = v[m];
            out[n + m] = (after - before) / self.inertia[m] + bias;
            before = after;
        }
    }
}

impl Dynamics for Rocker {
    plain_system!();

    fn coordinates(&self) -> usize {
        self.inertia.len()
    }

    fn derivatives(&self, t: f64, y: &[f64], modes: &Modes, (): &mut (), dy: &mut [f64]) {
        let bias = FRAC_PI_2 * self.omega * self.omega * (self.omega * t).sin();
        self.forces(modes.0[0] != 0, y, -self.moment, bias, dy);
    }

    fn tangent(&self, _: f64, _: &[f64], m: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        self.forces(m.0[0] != 0, d, 0.0, 0.0, out);
    }

    fn derivative_by_time(&self, t: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        let n = self.inertia.len();
        out[..n].fill(0.0);
        out[n..].fill(FRAC_PI_2 * self.omega.powi(3) * (self.omega * t).cos());
    }

    fn event_functions(&self, modes: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
        let touching = Guard {
            displacement: -1.0,
            ..Guard::default()
        };
        let pressing = Guard {
            displacement: -self.stiffness[0],
            speed: -self.damping[0],
            ..Guard::default()
        };
        let engaged = modes.0[0] != 0;
        out.push(EventFunction {
            guards: [touching, pressing],
            rising: !engaged,
            component: 0,
            target: if engaged { 0 } else { -1 },
        });
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

impl Forced for Rocker {
    fn forced(&self, order: usize, span: [f64; 2], _: &[f64], _: usize, out: &mut [f64]) {
        let amplitude = FRAC_PI_2 * self.omega * self.omega;
        for out in out {
            *out += sine(amplitude, self.omega, span, order);
        }
    }
}
