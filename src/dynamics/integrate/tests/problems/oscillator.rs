//! The oscillator with one mass.

use super::{Forced, plain_system, sine};
use crate::dynamics::integrate::{Dynamics, EventFunction, Modes};
use std::f64::consts::TAU;

/// u″ = −ω²u − 2ζω·u′ + amplitude·sin(Ωt), one mass, no switches.
pub(crate) struct Oscillator {
    pub(crate) omega: f64,
    pub(crate) damping: f64,
    pub(crate) amplitude: f64,
    pub(crate) driving: f64,
    pub(crate) scales: [f64; 2],
}

impl Oscillator {
    /// Undamped and free: u = cos ωt from [1, 0].
    pub(crate) fn free(omega: f64) -> Self {
        Self {
            omega,
            damping: 0.0,
            amplitude: 0.0,
            driving: 0.0,
            scales: [1.0, omega],
        }
    }

    /// Time of one free oscillation.
    pub(crate) fn period(&self) -> f64 {
        TAU / self.omega
    }

    /// Closed form of [u, u′] from [1, 0], below critical damping.
    pub(crate) fn exact(&self, t: f64) -> [f64; 2] {
        let (steady, at_start) = (self.steady(t), self.steady(0.0));
        let decay = self.damping * self.omega;
        let omega = (self.omega * self.omega - decay * decay).sqrt();
        let a = 1.0 - at_start[0];
        let b = (decay * a - at_start[1]) / omega;
        let (s, c) = (omega * t).sin_cos();
        let free = (-decay * t).exp();
        let speed = (b * omega - decay * a) * c - (a * omega + decay * b) * s;
        [free * (a * c + b * s) + steady[0], free * speed + steady[1]]
    }

    /// The steady answer to the drive.
    fn steady(&self, t: f64) -> [f64; 2] {
        let (w, v) = (self.omega, self.driving);
        let (p, q) = (w * w - v * v, 2.0 * self.damping * w * v);
        let gain = self.amplitude / (p * p + q * q);
        let (s, c) = (v * t).sin_cos();
        [gain * (p * s - q * c), gain * v * (p * c + q * s)]
    }
}

impl Dynamics for Oscillator {
    plain_system!();

    fn coordinates(&self) -> usize {
        1
    }

    fn derivatives(&self, t: f64, y: &[f64], _: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -self.omega * (self.omega * y[0] + 2.0 * self.damping * y[1])
            + self.amplitude * (self.driving * t).sin();
    }

    fn tangent(&self, _: f64, _: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = -self.omega * (self.omega * d[0] + 2.0 * self.damping * d[1]);
    }

    fn derivative_by_time(&self, t: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out[0] = 0.0;
        out[1] = self.amplitude * self.driving * (self.driving * t).cos();
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

impl Forced for Oscillator {
    fn forced(&self, order: usize, span: [f64; 2], _: &[f64], _: usize, out: &mut [f64]) {
        out[0] += sine(self.amplitude, self.driving, span, order);
    }
}
