//! The uniform elastic object as a continuum, and its vibration modes.
//!
//! s from 0, the driven end, to 1, the output; J the inertia, c the stiffness at the
//! output, τ = b/c the damping time; W the force at the output:
//!
//! ```text
//! rod, shaft   J·u_tt = c·(u_ss + τ·u_sst)          c·(u_s + τ·u_st) = W at s = 1
//! lever        3·J·s²·u_tt = c·(u_ss + τ·u_sst)     u = U at s = 0
//! ```
//!
//! Held at the driven end its mode k with φ_k (∫φ_k² dJ = 1) moves by
//! q̈ + τ·ω²·q̇ + ω²·q = −Γ·Ü + φ_k(1)·W, Γ = ∫φ_k dJ. With p = q/Γ that is an oscillator of
//! the inertia Γ² on a spring Γ²·ω² to the law U, of which the output gets the share
//! g = φ_k(1)·Γ and on which the share g of W acts. All shares add up to 1, all Γ² to J.
//!
//! Of modes that are left out, what they do under slow forces stays: the output gives
//! way by ρ_W·W − ρ_J·Ü, their inertia moves with the driven end. As a coordinate of its
//! own (Rubin) the same is one more oscillator: the shape in which a force at the output
//! bends the object, without the modes that are kept. Here J = c = 1.

use super::spec::InertiaSplit;
use crate::math::roots::root;
use std::f64::consts::{PI, SQRT_2};

/// A uniform elastic object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Continuum {
    /// Inertia evenly along the length: shafts, sliders.
    Rod,
    /// Inertia that turns with the square of the distance: levers.
    Lever,
}

/// A vibration as an oscillator on the law, J = c = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Oscillator {
    /// Inertia of the mode, a share of J.
    pub(super) inertia: f64,
    /// ω/√(c/J).
    pub(super) frequency: f64,
    /// Share g that the mode has in the output.
    pub(super) share: f64,
}

/// Reduction of a continuum, J = c = 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reduction {
    /// The vibrations, lowest first.
    pub(super) oscillators: Vec<Oscillator>,
    /// ρ_W.
    pub(super) under_force: f64,
    /// ρ_J.
    pub(super) under_acceleration: f64,
    /// ∫ of the square of the residual shape, u(1) = ρ_W, over the inertia.
    residual_inertia: f64,
    /// Inertia that moves with the driven end.
    pub(super) driven_end: f64,
}

impl Continuum {
    /// The continuum with a split of its inertia; `None`: shares of one's own.
    pub(super) fn of(split: &InertiaSplit) -> Option<Self> {
        match split {
            InertiaSplit::Equal => Some(Self::Rod),
            InertiaSplit::Cubes => Some(Self::Lever),
            InertiaSplit::Shares(_) => None,
        }
    }

    /// ∫s dJ, β of the quasi-static deviation −β·J·Ü/c; and ∫s² dJ.
    fn moments(self) -> [f64; 2] {
        match self {
            Self::Rod => [0.5, 1.0 / 3.0],
            Self::Lever => [0.75, 0.6],
        }
    }

    /// The lowest `count` modes with what the others do under slow forces.
    pub(super) fn reduce(self, count: usize) -> Reduction {
        let oscillators: Vec<Oscillator> = (1..=count).map(|k| self.mode(k)).collect();
        let [first, second] = self.moments();
        // φ_k(1)²: 2 of a rod, 4/3 of a lever, the same for all modes.
        let tip = match self {
            Self::Rod => 2.0,
            Self::Lever => 4.0 / 3.0,
        };
        // The smallest terms first.
        let sum = |of: &dyn Fn(&Oscillator) -> f64| oscillators.iter().rev().map(of).sum::<f64>();
        Reduction {
            under_force: 1.0 - sum(&|mode| tip / mode.frequency.powi(2)),
            under_acceleration: first - sum(&|mode| mode.share / mode.frequency.powi(2)),
            residual_inertia: second - sum(&|mode| tip / mode.frequency.powi(4)),
            driven_end: 1.0 - sum(&|mode| mode.inertia),
            oscillators,
        }
    }

    /// Mode k, from 1.
    pub(super) fn mode(self, k: usize) -> Oscillator {
        let sign = if k % 2 == 1 { 1.0 } else { -1.0 };
        match self {
            Self::Rod => {
                let z = (k as f64 - 0.5) * PI;
                Oscillator {
                    inertia: 2.0 / (z * z),
                    frequency: z,
                    share: sign * SQRT_2 * SQRT_2 / z,
                }
            }
            Self::Lever => {
                let z = lever_frequency(k);
                // φ′(0) = 1 is ∫φ² dJ = ¾·φ(1)² (a Bessel function of order ¼), and
                // Γ = φ′(0)/z², as φ″ = −3z²s²φ and φ′(1) = 0.
                let [tip, _] = lever_shape(z, [0.0, 1.0]);
                let factor = 1.0 / (z * z * 0.75f64.sqrt() * tip.abs());
                Oscillator {
                    inertia: factor * factor,
                    frequency: z,
                    share: sign * factor / 0.75f64.sqrt(),
                }
            }
        }
    }
}

/// Zero k of φ′(1): of the Bessel function of order −¾ at √3·z/2, near McMahon's series.
fn lever_frequency(k: usize) -> f64 {
    let b = (k as f64 - 0.625) * PI;
    // μ = 4·(¾)² = 9/4.
    let near = b - 1.25 / (8.0 * b);
    let z = |a: f64| 2.0 * a / 3f64.sqrt();
    let slope = |z| lever_shape(z, [0.0, 1.0])[1];
    root(&slope, z(near - 0.7), z(near + 0.7))
}

/// φ(1) and φ′(1) of φ″ = −3z²s²φ from φ(0) and φ′(0): by power series about places so
/// near to each other that their terms do not cancel.
pub(super) fn lever_shape(z: f64, [mut value, mut slope]: [f64; 2]) -> [f64; 2] {
    const TERMS: usize = 26;
    let square = 3.0 * z * z;
    let steps = square.sqrt().ceil().max(1.0);
    let h = 1.0 / steps;
    for step in 0..steps as usize {
        let s = step as f64 * h;
        let mut c = [0.0; TERMS];
        (c[0], c[1]) = (value, slope);
        for j in 0..TERMS - 2 {
            let before = |back: usize| if j >= back { c[j - back] } else { 0.0 };
            let pull = s * s * c[j] + 2.0 * s * before(1) + before(2);
            c[j + 2] = -square * pull / ((j + 1) * (j + 2)) as f64;
        }
        value = c.iter().rev().fold(0.0, |sum, c| sum * h + c);
        let terms = c.iter().enumerate().skip(1).rev();
        slope = terms.fold(0.0, |sum, (j, c)| sum * h + j as f64 * c);
    }
    [value, slope]
}

impl Reduction {
    /// The residual flexibility as one more oscillator: statically right under forces at
    /// the output and under accelerations of the driven end. Nothing is left out then but
    /// vibrations.
    pub(super) fn with_residual(mut self) -> Self {
        // The residual coordinate r has the inertia m, the stiffness 1/ρ_W, and moves by
        // m·r̈ + r/ρ_W = W − (ρ_J/ρ_W)·Ü.
        let m = self.residual_inertia / (self.under_force * self.under_force);
        let gamma = self.under_acceleration / self.under_force;
        let inertia = gamma * gamma / m;
        self.oscillators.push(Oscillator {
            inertia,
            frequency: 1.0 / (self.under_force * m).sqrt(),
            share: gamma / m,
        });
        self.driven_end -= inertia;
        (self.under_force, self.under_acceleration) = (0.0, 0.0);
        self
    }
}

#[cfg(test)]
#[path = "continuum_tests.rs"]
mod tests;
