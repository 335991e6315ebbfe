//! What the vibration modes that a reduction leaves out may add to the motion of the output:
//! a bound.
//!
//! Mode k of a uniform object behind a prescribed law U, with the share g in the output, is
//! off from what a reduction takes for it (g·Ü/ω² under slow forces) by e, with
//! ë + τ·ω²·ė + ω²·e = (g/ω²)·(U⁗ + τ·ω²·U‴). By Duhamel's integral over the changes of U‴,
//!
//! ```text
//! e(t) = (g/ω²)·[ τ·U‴(t) + ∫ w(t − s) dU‴(s) ],   |w(t)| ≤ (1/ω + τ)·exp(−ρt),
//! ρ = min(τω²/2, 1/τ)/2
//! ```
//!
//! (w″ + τω²w′ + ω²w = 0, w(0) = −τ, w′(0) = 1), to which a jump of Ü at the start adds at
//! most (g/ω²) times the jump, and a force that is not balanced there φ(1)²/ω² times the
//! force, both fading with (1 + 1/(ωτ))·exp(−ρt). The sums over all modes left out converge;
//! that of (g/ω²)·τ·U‴ keeps its signs.

use super::continuum::Continuum;
use super::spec::Uniform;
use std::f64::consts::{PI, TAU};

/// Modes that are summed one by one, before the rest is bounded by an integral.
const TERMS: usize = 8;
/// Terms of a lever follow their power this closely from the ninth on.
const POWER: f64 = 1.01;

/// What the modes that are left out may do, summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LeftOut {
    /// Σ |g|/ω² (s²).
    lag: f64,
    /// Σ |g|/ω³ (s³).
    kick: f64,
    /// |Σ g/ω²| (s²).
    delay_of_all: f64,
    /// Σ φ(1)²/ω²: how far the output gives way to a force, without the modes kept.
    compliance: f64,
    /// τ = b/c (s).
    delay: f64,
    /// The lowest ω (1/s).
    slowest: f64,
    /// ρ (1/s): how fast what has happened is forgotten, at least.
    pub(crate) fading: f64,
}

/// What moves the modes: the motion U of the driven end, and the forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Excitation {
    /// ∫ exp(−ρ(t − s)) |dU‴(s)|, with a jump from 0 at the start.
    pub(crate) jerk_changes: f64,
    /// |U‴|.
    pub(crate) jerk: f64,
    /// Jump of the acceleration at the start.
    pub(crate) acceleration: f64,
    /// Force at the output that is not balanced at the start.
    pub(crate) force: f64,
}

impl LeftOut {
    /// All modes above the lowest `kept`; `None`: the object has no modes.
    pub(crate) fn of(body: &Uniform, kept: usize) -> Option<Self> {
        let continuum = Continuum::of(&body.split)?;
        let unit = (body.stiffness / body.inertia).sqrt();
        let rest = continuum.reduce(kept);
        let delay = body.damping_capacity / (TAU * unit);
        let first = unit * continuum.frequency(kept + 1);
        let fading = match delay > 0.0 {
            true => (0.5 * delay * first * first).min(1.0 / delay) / 2.0,
            false => 0.0,
        };
        Some(Self {
            lag: continuum.shares_above(kept, 2) / unit.powi(2),
            kick: continuum.shares_above(kept, 3) / unit.powi(3),
            delay_of_all: rest.under_acceleration.abs() / unit.powi(2),
            compliance: rest.under_force / body.stiffness,
            delay,
            slowest: first,
            fading,
        })
    }

    /// The share of what a start leaves that may be there still after a time.
    pub(crate) fn remaining_start_share(&self, time: f64) -> f64 {
        let least = 1.0 + 1.0 / (self.slowest * self.delay);
        let left = least * (-self.fading * time).exp();
        // (Undamped it stays, and the share is no number.)
        if left < 1.0 { left } else { 1.0 }
    }

    /// How far the displacement of the output may be off.
    pub(crate) fn deviation(&self, by: &Excitation) -> f64 {
        (self.kick + self.delay * self.lag) * by.jerk_changes
            + self.delay * self.delay_of_all * by.jerk
            + self.lag * by.acceleration
            + self.compliance * by.force
    }
}

impl Continuum {
    /// Σ |g|/z^`power` over the modes above the lowest `kept`, from above.
    fn shares_above(self, kept: usize, power: i32) -> f64 {
        let term = |k| {
            let mode = self.mode(k);
            (
                mode.share.abs() / mode.frequency.powi(power),
                mode.frequency,
            )
        };
        let terms: Vec<(f64, f64)> = (kept + 1..=kept + TERMS).map(term).collect();
        let &[.., (last, frequency)] = &terms[..] else {
            return f64::INFINITY;
        };
        // g goes by 1/z, that of a lever by z^(-5/4); the frequencies are evenly spaced.
        let (decay, spacing, slack) = match self {
            Self::Rod => (1.0, PI, 1.0),
            Self::Lever => (1.25, 2.0 * PI / 3f64.sqrt(), POWER),
        };
        let (order, place) = (decay + f64::from(power), frequency / spacing);
        // A convex function: each value is below the mean over its interval.
        let rest = (place / (place + 0.5)).powf(order - 1.0) * place / (order - 1.0);
        terms.iter().rev().map(|term| term.0).sum::<f64>() + slack * last * rest
    }

    /// Frequency of mode k, from 1.
    fn frequency(self, k: usize) -> f64 {
        self.mode(k).frequency
    }
}

#[cfg(test)]
mod tests {
    use super::{Continuum, Excitation, LeftOut, Uniform};
    use crate::dynamics::builder::spec::InertiaSplit;

    #[test]
    fn sums_of_shares_are_bounded_closely_from_above() {
        for continuum in [Continuum::Rod, Continuum::Lever] {
            for power in [2, 3] {
                for kept in [0, 1, 5] {
                    let modes = continuum.reduce(400).oscillators;
                    let term = |mode: &super::super::continuum::Oscillator| {
                        mode.share.abs() / mode.frequency.powi(power)
                    };
                    let sum: f64 = modes.iter().skip(kept).rev().map(term).sum();
                    let bound = continuum.shares_above(kept, power);
                    assert!(
                        bound >= sum,
                        "{continuum:?} {power} {kept}: {bound} < {sum}"
                    );
                    assert!(
                        bound < 1.01 * sum,
                        "{continuum:?} {power} {kept}: {bound} {sum}"
                    );
                }
            }
        }
    }

    /// w and w − h of the formulas, in units of ω, over all dampings.
    #[test]
    fn memory_of_a_mode_fades_as_fast_as_is_said() {
        for exponent in -30..=30 {
            let half = 10f64.powf(0.1 * f64::from(exponent)) * 1.0001;
            let (delay, fading) = (2.0 * half, half.min(0.5 / half) / 2.0);
            // Classical Runge–Kutta with steps small beside both time constants.
            let step = 0.02 / (1.0 + 2.0 * half);
            let slope = |y: [f64; 2]| [y[1], -y[0] - delay * y[1]];
            let (mut w, mut h) = ([-delay, 1.0], [0.0, 1.0]);
            for i in 0..20_000 {
                let memory = (1.0 + delay) * (-fading * step * f64::from(i)).exp() + 1e-9;
                assert!(w[0].abs() <= memory, "{half} {i}: {} {memory}", w[0]);
                assert!((w[0] - h[0]).abs() <= memory, "{half} {i}");
                for y in [&mut w, &mut h] {
                    let add = |y: [f64; 2], k: [f64; 2], f: f64| [y[0] + f * k[0], y[1] + f * k[1]];
                    let a = slope(*y);
                    let b = slope(add(*y, a, step / 2.0));
                    let c = slope(add(*y, b, step / 2.0));
                    let d = slope(add(*y, c, step));
                    for i in 0..2 {
                        y[i] += step / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
                    }
                }
            }
        }
    }

    #[test]
    fn a_rod_in_units_of_its_own_has_the_sums_of_its_series() {
        // Σ 2/z³ and Σ 2/z⁴ over z = (k − ½)π, k ≥ 1: 14·ζ(3)/π³ and 1/3.
        let body = |inertia, stiffness| Uniform {
            inertia,
            stiffness,
            damping_capacity: 0.0,
            split: InertiaSplit::Equal,
        };
        let only = |acceleration, changes, force| Excitation {
            jerk_changes: changes,
            jerk: 0.0,
            acceleration,
            force,
        };
        let all = LeftOut::of(&body(1.0, 1.0), 0).unwrap();
        let lag = 14.0 * 1.202056903159594 / std::f64::consts::PI.powi(3);
        approx::assert_relative_eq!(
            all.deviation(&only(1.0, 0.0, 0.0)),
            lag,
            max_relative = 1e-4
        );
        let kick = all.deviation(&only(0.0, 1.0, 0.0));
        approx::assert_relative_eq!(kick, 1.0 / 3.0, max_relative = 1e-4);
        approx::assert_relative_eq!(
            all.deviation(&only(0.0, 0.0, 1.0)),
            1.0,
            max_relative = 1e-9
        );
        // ω₀ = 2.
        let stiff = LeftOut::of(&body(1.0, 4.0), 0).unwrap();
        let kick = stiff.deviation(&only(0.0, 1.0, 0.0));
        approx::assert_relative_eq!(kick, 1.0 / 24.0, max_relative = 1e-4);
    }
}
