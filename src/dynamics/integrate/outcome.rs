//! Settings of a run, its end, and who listens to it.

use super::{EventFunction, Impact, Modes, PhysicalStop};
use crate::budget::{Budget, Spent};
use crate::math::polynomial::Step;
use serde::Serialize;
use std::fmt;
use std::time::Duration;

/// Methods of integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Classical Runge–Kutta of order 4 with fixed step (ode_solvers).
    Rk4,
    /// Dormand–Prince 5(4) (ode_solvers).
    Dopri5,
    /// Dormand–Prince 8(5,3) (ode_solvers).
    Dop853,
    /// Taylor series of an order that follows the tolerance.
    Taylor,
    /// Rodas5P, a Rosenbrock method of order 5(4), L-stable.
    Rodas5p,
    /// Radau IIA of order 5, 9 or 13, which follows the tolerance; L-stable.
    Radau,
    /// Backward differentiation formulas of variable order (diffsol).
    Bdf,
    /// TR-BDF2, L-stable, order 2 (diffsol).
    TrBdf2,
    /// ESDIRK 3(4), L-stable (diffsol).
    Esdirk34,
    /// Exact propagation between switches ([`crate::exact`]); no method of
    /// integration: [`super::integrate`] refuses it.
    Exact,
}

impl Method {
    /// All methods of integration, in the order they are presented; `exact`
    /// is not among them.
    pub const ALL: [Self; 9] = [
        Self::Rk4,
        Self::Dopri5,
        Self::Dop853,
        Self::Taylor,
        Self::Rodas5p,
        Self::Radau,
        Self::Bdf,
        Self::TrBdf2,
        Self::Esdirk34,
    ];

    /// True when this build has the method: those of diffsol need the feature
    /// of that name.
    pub fn is_available(self) -> bool {
        cfg!(feature = "diffsol") || !matches!(self, Self::Bdf | Self::TrBdf2 | Self::Esdirk34)
    }

    /// Methods of [`Method::ALL`] that this build has, in the same order.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|method| method.is_available())
    }

    /// Name in scenes and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rk4 => "rk4",
            Self::Dopri5 => "dopri5",
            Self::Dop853 => "dop853",
            Self::Taylor => "taylor",
            Self::Rodas5p => "rodas5p",
            Self::Radau => "radau",
            Self::Bdf => "bdf",
            Self::TrBdf2 => "tr_bdf2",
            Self::Esdirk34 => "esdirk34",
            Self::Exact => "exact",
        }
    }

    /// What it is, in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Rk4 => "classical Runge–Kutta method of order 4 with a fixed step",
            Self::Dopri5 => "Runge–Kutta method of Dormand and Prince, order 5(4)",
            Self::Dop853 => "Runge–Kutta method of Dormand and Prince, order 8(5,3)",
            Self::Taylor => "Taylor series of an order that follows the tolerance",
            Self::Rodas5p => "Rosenbrock method of order 5(4), L-stable",
            Self::Radau => "implicit Runge–Kutta method Radau IIA of order 5, 9 or 13, L-stable",
            Self::Bdf => "backward differentiation formulas of variable order",
            Self::TrBdf2 => {
                "trapezoidal rule with a backward differentiation formula, order 2, L-stable"
            }
            Self::Esdirk34 => "diagonally implicit Runge–Kutta method of order 3(4), L-stable",
            Self::Exact => "closed-form motion between events",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Method and tolerances of an integration.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The method.
    pub method: Method,
    /// Error wanted, relative to the scales of the state.
    pub tolerance: f64,
    /// Fixed step of `rk4` (s); greatest step of the others when given.
    pub step: Option<f64>,
}

/// Bounds on a run.
#[derive(Clone, Debug)]
pub struct Limits<'a> {
    /// Most switches of pairs.
    pub switches: u64,
    /// Most steps.
    pub steps: u64,
    /// Until when, and whether interrupted.
    pub budget: Budget<'a>,
}

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// Evaluations of the right-hand side (a Jacobian column counts as one).
    pub evaluations: u64,
    /// Switches of pairs.
    pub switches: u64,
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// The end time was reached.
    Complete,
    /// The mechanism cannot go on.
    Physical(PhysicalStop),
    /// A state entry was no longer a finite number.
    NotFinite {
        /// Name of the entry.
        what: String,
    },
    /// The step that the tolerance needs is below what the clock resolves.
    StepFloor {
        /// The step (s).
        step: f64,
    },
    /// More switches than allowed.
    TooManySwitches {
        /// The bound.
        bound: u64,
    },
    /// More steps than allowed.
    TooManySteps {
        /// The bound.
        bound: u64,
    },
    /// The wall-clock limit was reached.
    WallClock {
        /// The limit.
        limit: Duration,
    },
    /// Interrupted from outside.
    Interrupted,
    /// The method gave up for a reason of its own.
    Method {
        /// The method.
        method: Method,
        /// Reason that the method gives.
        reason: String,
    },
}

impl Stop {
    /// True when the run was ended from outside, be it by a flag or by the clock.
    pub fn is_from_outside(&self) -> bool {
        matches!(self, Self::Interrupted | Self::WallClock { .. })
    }
}

impl From<Spent> for Stop {
    fn from(spent: Spent) -> Self {
        match spent {
            Spent::Interrupted => Self::Interrupted,
            Spent::Time { limit } => Self::WallClock { limit },
        }
    }
}

/// Outcome of a run: how it ended, and its counts.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Time reached (s).
    pub time: f64,
    /// Why it ended.
    pub stop: Stop,
    /// Counts.
    pub statistics: Statistics,
}

/// A switch that took place.
#[derive(Clone, Debug)]
pub struct SwitchEvent<'a> {
    /// Time of the switch (s).
    pub time: f64,
    /// State then; continuous through the switch but for the speeds in an impact, after which
    /// it is.
    pub y: &'a [f64],
    /// Event function that fired; `None` for a break in time.
    pub watch: Option<&'a EventFunction>,
    /// Modes before.
    pub before: &'a Modes,
    /// Modes after.
    pub after: &'a Modes,
    /// The impact that it is, and the state before it.
    pub impact: Option<(&'a Impact, &'a [f64])>,
}

/// Listens to a run; cannot change it.
pub trait Sink {
    /// The state at the start, modes settled.
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes);

    /// An accepted step, cut off where a switch was found; modes are those in
    /// force over the step.
    fn step(&mut self, step: &Step<'_>, modes: &Modes);

    /// A switch of a pair, or a change of formula, after the step that led to it.
    fn switch(&mut self, event: &SwitchEvent<'_>);

    /// A motion that is known in closed form, not told in steps, has been followed up to
    /// an instant, with so many switches of pairs. Default: nobody cares.
    fn passes(&mut self, _time: f64, _switches: u64) {}

    /// False when in steps that end at or before the time `until` it looks at
    /// nothing but their ends: what lies between may then be told less accurately
    /// than the ends. Default: true.
    fn reads_within_steps(&self, _until: f64) -> bool {
        true
    }
}
