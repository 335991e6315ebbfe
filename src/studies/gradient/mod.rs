//! Derivatives of the results of a run by numbers of the scene.
//!
//! The equations of motion between two events are differentiated along with the motion, and the
//! instants of the events move with the numbers (`crate::exact::sensitivity`). The derivative of
//! a greatest value is that of the signal where it is greatest (Danskin 1967); of the mean of |δ|
//! it is the mean of sign(δ)·δ_p.
//!
//! # Verdicts
//!
//! Every derivative has a [`DerivativeVerdict`]. One that cannot be trusted has no value. A result whose
//! condition number κ = |p·f_p/f| leaves less than six digits of sixteen is not determined, as
//! `dam run --spread` says of the result itself.
//!
//! # Checks
//!
//! - The values of the results agree with those of the run, which are found in another way.
//! - Derivatives agree with differences of runs along a random direction of the parameters
//!   (`check`). Parameters that hardly matter in that direction are checked by themselves.
//!
//! # Limits
//!
//! The whole scene must be one that is propagated exactly: masses and links behind prescribed
//! motions, under loads that are constant, linear in the motion or tables over time. Derivatives of
//! the numbers of the equations by those of the scene are differences of order 8 (`stencil`), good
//! to some 10⁻¹³ of their sizes. A derivative with an elasticity below 10⁻¹⁰ is mostly their rounding.
//! All else is refused with the reason.

mod check;
mod derive;
mod document;
mod figures;
mod lowered;
mod question;
mod stencil;
#[cfg(test)]
mod tests;

pub(crate) use derive::Subject;
pub(crate) use document::{sides, unit_of};
pub use figures::{DEFAULT_FIGURES, names};
pub use lowered::Place;
pub(crate) use question::gradient;
pub use stencil::Side;
pub(in crate::studies) use stencil::central as central_differences;

use serde::Serialize;

/// Derivatives of results by parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// The parameters, in the order of the question.
    pub parameters: Vec<Parameter>,
    /// The results, in the order of the question.
    pub figures: Vec<FigureGradient>,
    /// Number of events of the motion.
    pub events: usize,
    /// How far the derivatives agree with differences of runs; `None`: not checked.
    pub check: Option<CheckSummary>,
}

/// A number of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Address: `rocker.inertia`.
    pub path: String,
    /// Its value in the SI unit.
    pub value: f64,
    /// SI unit; empty of pure numbers, and where it is not known.
    pub unit: String,
}

/// A result with its derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureGradient {
    /// Address: `rocker.delta_max`.
    pub figure: String,
    /// Its value in the SI unit; `None`: it has none in this run.
    pub value: Option<f64>,
    /// SI unit; empty of pure numbers.
    pub unit: String,
    /// By every parameter, in their order.
    pub by: Vec<Derivative>,
}

/// The derivative of a result by a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivative {
    /// What it is worth.
    pub verdict: DerivativeVerdict,
    /// The derivative in SI units; `None` where the verdict leaves none.
    pub derivative: Option<f64>,
    /// (p/f)·df/dp; `None` where the result is zero.
    pub elasticity: Option<f64>,
    /// Greatest difference from the differences of runs, relative; `None`: not checked.
    pub agrees_to: Option<f64>,
    /// The nearest value of the parameter at which the sequence of events changes, to first
    /// order; `None`: none within the size of the parameter.
    pub sequence_changes_at: Option<f64>,
}

/// What a derivative is worth.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "verdict")]
pub enum DerivativeVerdict {
    /// It holds on both sides.
    Exact,
    /// The derivatives on the two sides differ; `None`: there is nothing on that side.
    OneSided {
        /// With the parameter decreasing.
        below: Option<f64>,
        /// With the parameter increasing.
        above: Option<f64>,
    },
    /// There is none here.
    NotDifferentiable {
        /// Reason.
        why: String,
    },
    /// The data do not determine it.
    NotDetermined {
        /// Reason.
        why: String,
    },
    /// The result has no derivative at all: it counts or answers.
    NotApplicable {
        /// Reason.
        why: String,
    },
}

impl DerivativeVerdict {
    /// The name as it is written: `exact`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::OneSided { .. } => "one-sided",
            Self::NotDifferentiable { .. } => "not differentiable here",
            Self::NotDetermined { .. } => "not determined",
            Self::NotApplicable { .. } => "not applicable",
        }
    }

    /// The reason; empty where none is needed.
    pub fn why(&self) -> &str {
        match self {
            Self::Exact | Self::OneSided { .. } => "",
            Self::NotDifferentiable { why }
            | Self::NotDetermined { why }
            | Self::NotApplicable { why } => why,
        }
    }
}

/// How far derivatives agree with differences of runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CheckSummary {
    /// Runs that were made.
    pub runs: usize,
    /// Derivatives that were compared.
    pub compared: usize,
    /// Greatest relative difference.
    pub worst: f64,
    /// Derivatives that differ by more than differences can resolve.
    pub failed: usize,
    /// Why nothing was compared; empty otherwise.
    pub why_not: String,
}

impl Gradient {
    /// True when every derivative that was asked for has a verdict that stands, and the check by
    /// differences holds.
    pub fn is_answered(&self) -> bool {
        let mut all = self.figures.iter().flat_map(|figure| &figure.by);
        let undetermined =
            all.any(|one| matches!(one.verdict, DerivativeVerdict::NotDetermined { .. }));
        !undetermined && self.check.as_ref().is_none_or(|check| check.failed == 0)
    }
}
