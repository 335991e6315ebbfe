//! The equations that the general solvers are given: a chain of masses behind
//! a sine, with a contact at its first link, written by hand.
//!
//! Unknowns are the deviations q of the masses from the law and their rates,
//! each in units of its own size (M/c and M/√(cJ)), so that one absolute
//! tolerance suits all of them: [x₁, w₁, x₂, w₂, …]. A solver that is given
//! the angles themselves instead needs far smaller tolerances for the same
//! error of q, which is a difference of them.

use std::f64::consts::{FRAC_PI_2, TAU};

/// A rocker as a chain of masses, driven at 10 Hz, starting on the law.
#[derive(Clone, Debug)]
pub(crate) struct Chain {
    /// Number of masses.
    pub(crate) masses: usize,
    /// Inertia of each (kg·m²): a bar divided evenly, by cubes.
    pub(crate) inertia: Vec<f64>,
    /// Stiffness of each link (N·m/rad).
    pub(crate) stiffness: Vec<f64>,
    /// Damping of each link (N·m·s/rad), ψ√(cJ)/2π of its own mass.
    pub(crate) damping: Vec<f64>,
    /// Closing moment M on the last mass (N·m).
    pub(crate) load: f64,
    /// Time to be simulated (s).
    pub(crate) duration: f64,
    /// Unit of the deviations (rad).
    pub(crate) length: f64,
    /// Unit of their rates (rad/s).
    pub(crate) speed: f64,
    inverse_inertia: Vec<f64>,
}

/// Amplitude of the law (rad).
pub(crate) const AMPLITUDE: f64 = FRAC_PI_2;

/// Angular frequency of the law (rad/s).
pub(crate) const FREQUENCY: f64 = TAU * 10.0;

impl Chain {
    /// A rocker of total inertia `inertia` (kg·m²) and stiffness `stiffness`
    /// (N·m/rad) with damping capacity ψ.
    pub(crate) fn new(
        masses: usize,
        [inertia, stiffness]: [f64; 2],
        load: f64,
        psi: f64,
        duration: f64,
    ) -> Self {
        let count = masses as f64;
        let cube = |m: usize| (m as f64 / count).powi(3);
        let inertias: Vec<f64> = (0..masses)
            .map(|m| inertia * (cube(m + 1) - cube(m)))
            .collect();
        let link = count * stiffness;
        let damper = |mass: &f64| psi * (link * mass).sqrt() / TAU;
        Self {
            masses,
            stiffness: vec![link; masses],
            damping: inertias.iter().map(damper).collect(),
            inverse_inertia: inertias.iter().map(|mass| 1.0 / mass).collect(),
            inertia: inertias,
            load,
            duration,
            length: load / stiffness,
            speed: load / (stiffness * inertia).sqrt(),
        }
    }

    /// The state just after t = 0. The load on the last mass reaches the first
    /// one through the damper of the link between them faster than the law
    /// parts (both as t²) with one or two masses, and later with more.
    pub(crate) fn starts_engaged(&self) -> bool {
        self.masses <= 2
    }

    /// Number of unknowns.
    pub(crate) fn unknowns(&self) -> usize {
        2 * self.masses
    }

    /// First step for methods that must be told one (s).
    pub(crate) fn first_step(&self) -> f64 {
        if self.masses == 1 { 1e-6 } else { 1e-9 }
    }

    /// δ, the deviation of the last mass (rad).
    #[inline]
    pub(crate) fn delta(&self, y: &[f64]) -> f64 {
        y[2 * self.masses - 2] * self.length
    }

    /// dδ/dt (rad/s).
    #[inline]
    pub(crate) fn delta_speed(&self, y: &[f64]) -> f64 {
        y[2 * self.masses - 1] * self.speed
    }

    /// Negative exactly while the contact holds, in units of the load:
    /// c₁q₁ + b₁·max(q̇₁, 0). Continuous through both kinds of switch.
    #[inline]
    pub(crate) fn contact(&self, y: &[f64]) -> f64 {
        let pressed = self.stiffness[0] * y[0] * self.length;
        (pressed + self.damping[0] * y[1].max(0.0) * self.speed) / self.load
    }

    /// True where the contact holds, for solvers that locate no switches.
    #[inline]
    pub(crate) fn holds(&self, y: &[f64]) -> bool {
        y[0] < 0.0 && self.contact(y) < 0.0
    }

    /// The right-hand side.
    #[inline]
    pub(crate) fn derivatives(&self, engaged: bool, time: f64, y: &[f64], dy: &mut [f64]) {
        let law = AMPLITUDE * FREQUENCY * FREQUENCY * (FREQUENCY * time).sin();
        self.linear(engaged, y, self.load, law, dy);
    }

    /// The Jacobian times a vector.
    #[inline]
    pub(crate) fn tangent(&self, engaged: bool, direction: &[f64], out: &mut [f64]) {
        self.linear(engaged, direction, 0.0, 0.0, out);
    }

    #[inline]
    fn linear(&self, engaged: bool, y: &[f64], load: f64, law: f64, dy: &mut [f64]) {
        let (length, speed) = (self.length, self.speed);
        let mut below = if engaged {
            -(self.stiffness[0] * y[0] * length + self.damping[0] * y[1] * speed)
        } else {
            0.0
        };
        for m in 0..self.masses {
            let (x, w) = (y[2 * m], y[2 * m + 1]);
            let above = if m + 1 < self.masses {
                self.stiffness[m + 1] * (x - y[2 * m + 2]) * length
                    + self.damping[m + 1] * (w - y[2 * m + 3]) * speed
            } else {
                load
            };
            dy[2 * m] = w * (speed / length);
            dy[2 * m + 1] = ((below - above) * self.inverse_inertia[m] + law) / speed;
            below = above;
        }
    }
}
