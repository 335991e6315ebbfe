//! The uniform elastic object that is free at both ends, as it stands behind a contact
//! element: its modes, written as a chain.
//!
//! Under a force N at the driven end (s = 0) and W at the output (s = 1) the free object of
//! the [`continuum`](super::continuum) moves as a rigid body, J·q̈₀ = N + W, and in its
//! modes, q̈_k + τ·ω_k²·q̇_k + ω_k²·q_k = φ_k(0)·N + φ_k(1)·W. Of the modes that are left out
//! stays what they give way by under slow forces, the residual flexibilities G₀₀, G₀₁, G₁₁
//! between the two ends. The shape in which W bends the object, without the modes that are
//! kept, is one more oscillator (as in Rubin's method), so that whatever loads the output or hangs on
//! it finds G₁₁ and G₀₁. What then remains of G₀₀ is massless, in series with the contact
//! (as in MacNeal's).
//!
//! Seen from the contact that is 1/(1 + τs) times ρ + Σ φ_k(0)²/(z + ω_k²) with
//! z = s²/(1 + τs) and positive summands, to which there is one chain of as many masses as
//! there are poles, on a first link of the compliance ρ (Stieltjes' continued fraction):
//!
//! ```text
//! contact ── 1/ρ ── m₁ ── c₂ ── m₂ ── … ── mₙ        u(1) = Σ gⱼ·uⱼ, Σ gⱼ = 1, Σ mⱼ = J
//! ```
//!
//! Lanczos' steps lead from the modes to it: the rows of the orthogonal matrix that they make
//! are the masses' parts in the modes. That in the rigid-body mode is √(m/J), and the masses'
//! shares g in the output follow from φ_k(1). Here J = c = 1.

use super::continuum::{Continuum, lever_shape};
use crate::math::roots::root;
use std::f64::consts::{PI, SQRT_2};

/// A vibration of the free object, ∫φ² dJ = 1, J = c = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FreeMode {
    /// ω²/(c/J).
    square: f64,
    /// φ(0) at the driven end.
    driven: f64,
    /// φ(1) at the output.
    output: f64,
}

/// The free object as a chain, J = c = 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FreeBody {
    /// m₁, m₂, …
    pub(super) inertias: Vec<f64>,
    /// 1/ρ, c₂, …
    pub(super) stiffnesses: Vec<f64>,
    /// g₁, g₂, …
    pub(super) shares: Vec<f64>,
}

/// What the modes that are left out give way by.
struct Residual {
    /// G₀₀, G₀₁, G₁₁.
    driven: f64,
    across: f64,
    output: f64,
    /// ∫ of the square of the shape that W bends, over the inertia.
    inertia: f64,
}

impl Residual {
    /// All vibrations left out.
    fn of(continuum: Continuum) -> Self {
        match continuum {
            // The shape s²/2 − 1/6.
            Continuum::Rod => Self {
                driven: 1.0 / 3.0,
                across: -1.0 / 6.0,
                output: 1.0 / 3.0,
                inertia: 1.0 / 45.0,
            },
            // The shape s⁴/4 − 3/28.
            Continuum::Lever => Self {
                driven: 9.0 / 14.0,
                across: -3.0 / 28.0,
                output: 1.0 / 7.0,
                inertia: 3.0 / 176.0 - 9.0 / 784.0,
            },
        }
    }

    /// With some of the modes kept.
    fn with_kept_modes(mut self, modes: &[FreeMode]) -> Self {
        // The smallest terms first.
        let sum = |of: fn(&FreeMode) -> f64| modes.iter().rev().map(of).sum::<f64>();
        self.driven -= sum(|mode| mode.driven * mode.driven / mode.square);
        self.across -= sum(|mode| mode.driven * mode.output / mode.square);
        self.output -= sum(|mode| mode.output * mode.output / mode.square);
        self.inertia -= sum(|mode| (mode.output / mode.square).powi(2));
        self
    }

    /// The shape that W bends as an oscillator, and what is left of G₀₀.
    fn oscillator(&self) -> (FreeMode, f64) {
        let root = self.inertia.sqrt();
        let oscillator = FreeMode {
            square: self.output / self.inertia,
            driven: self.across / root,
            output: self.output / root,
        };
        let rest = self.driven - self.across * self.across / self.output;
        (oscillator, rest)
    }
}

impl Continuum {
    /// Vibration k of the free object, from 1.
    fn free_mode(self, k: usize) -> FreeMode {
        let sign = if k % 2 == 1 { -1.0 } else { 1.0 };
        match self {
            Self::Rod => FreeMode {
                square: (k as f64 * PI).powi(2),
                driven: SQRT_2,
                output: sign * SQRT_2,
            },
            Self::Lever => {
                let z = free_lever_frequency(k);
                // φ(0) = 1 is ∫φ² dJ = ¾·φ(1)², as with the driven end held.
                let [tip, _] = lever_shape(z, [1.0, 0.0]);
                let norm = 0.75f64.sqrt();
                FreeMode {
                    square: z * z,
                    driven: 1.0 / (norm * tip.abs()),
                    output: sign / norm,
                }
            }
        }
    }

    /// The free object with its lowest `count` vibrations.
    pub(super) fn with_free_modes(self, count: usize) -> FreeBody {
        let mut modes: Vec<FreeMode> = (1..=count).map(|k| self.free_mode(k)).collect();
        let (oscillator, rest) = Residual::of(self).with_kept_modes(&modes).oscillator();
        modes.push(oscillator);
        chain(&modes, rest)
    }
}

/// Zero k of φ′(1) with φ′(0) = 0: of the Bessel function of order ¾ at √3·z/2, near
/// McMahon's series.
fn free_lever_frequency(k: usize) -> f64 {
    let b = (k as f64 + 0.125) * PI;
    // μ = 4·(¾)² = 9/4.
    let near = b - 1.25 / (8.0 * b);
    let z = |a: f64| 2.0 * a / 3f64.sqrt();
    let slope = |z| lever_shape(z, [1.0, 0.0])[1];
    root(&slope, z(near - 0.7), z(near + 0.7))
}

/// The chain of a rigid body with these vibrations, on a link of the compliance `rest`.
fn chain(modes: &[FreeMode], rest: f64) -> FreeBody {
    let rigid = FreeMode {
        square: 0.0,
        driven: 1.0,
        output: 1.0,
    };
    let all: Vec<FreeMode> = std::iter::once(rigid)
        .chain(modes.iter().copied())
        .collect();
    let rows = lanczos(&all);
    let root = |row: &[f64]| row[0].abs();
    let mut body = FreeBody {
        inertias: rows.iter().map(|row| row[0] * row[0]).collect(),
        stiffnesses: vec![1.0 / rest],
        shares: Vec::new(),
    };
    for pair in rows.windows(2) {
        let coupling: f64 = (all.iter().zip(&pair[0]).zip(&pair[1]))
            .map(|((mode, one), other)| mode.square * one * other)
            .sum();
        let stiffness = coupling.abs() * root(&pair[0]) * root(&pair[1]);
        body.stiffnesses.push(stiffness);
    }
    let share = |row: &Vec<f64>| {
        let output: f64 = all
            .iter()
            .zip(row)
            .map(|(mode, part)| mode.output * part)
            .sum();
        row[0] * output
    };
    body.shares = rows.iter().map(share).collect();
    body
}

/// For each mass of the chain, the first one first, its part in each mode: orthogonal rows.
fn lanczos(modes: &[FreeMode]) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(modes.len());
    let mut next: Vec<f64> = modes.iter().map(|mode| mode.driven).collect();
    while rows.len() < modes.len() {
        // Twice, and against all: what rounding leaves would grow from row to row.
        for _ in 0..2 {
            for row in &rows {
                let part = dot(row, &next);
                next.iter_mut().zip(row).for_each(|(n, r)| *n -= part * r);
            }
        }
        let length = dot(&next, &next).sqrt();
        next.iter_mut().for_each(|n| *n /= length);
        let ahead = modes.iter().zip(&next).map(|(mode, n)| mode.square * n);
        let ahead = ahead.collect();
        rows.push(std::mem::replace(&mut next, ahead));
    }
    rows
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
#[path = "free_body_tests.rs"]
mod tests;
