//! The oscillator with one mass.

use super::plain_system;
use crate::integrate::{Dynamics, Modes, Watch};
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

    /// Closed form from rest at u = 0, driven off resonance, without damping.
    pub(crate) fn driven_exact(&self, t: f64) -> [f64; 2] {
        let (w, v) = (self.omega, self.driving);
        let gain = self.amplitude / (w * w - v * v);
        [
            gain * ((v * t).sin() - v / w * (w * t).sin()),
            gain * v * ((v * t).cos() - (w * t).cos()),
        ]
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

    fn watches(&self, _: &Modes, out: &mut Vec<Watch>) {
        out.clear();
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}
