//! The tolerance of results: what tolerances of dimensions make of them.
//!
//! Three answers stand beside each other, each more expensive than the one before.
//!
//! - The stack of first order ([`FirstOrder`]): worst case Σ|f_i|·t_i, standard deviation
//!   √Σ(f_i·σ_i)², and the share of each dimension. Derivatives are exact where `dam gradient`
//!   has them, else differences of runs (`slopes`).
//! - Runs with one dimension at its limits: the mean shift ½Σf_ii·σ_i² of second order, and where
//!   first order does not tell the effect of a dimension ([`NotLinear`]). Further runs search the
//!   worst case with all dimensions in the middle or at their limits (`extremes`).
//! - Samples ([`SamplePlan`]): distribution ([`Spread`]), share that meets the limits ([`Yield`]),
//!   and Sobol indices ([`Indices`]).
//!
//! All is about the middle of the tolerance zones, which is the mean of the samples.
//!
//! # Limits
//!
//! Samples of a scrambled Sobol sequence are spread more evenly than independent ones. The
//! intervals are those of independent samples, and so rather too wide. Dimensions are
//! independent, or they deviate by the same ([`Dimension`] with several addresses).

mod answer;
mod extremes;
mod grade;
mod indices;
mod sampling;
mod slopes;
mod stack;
mod statistics;
mod study;
mod task;
#[cfg(test)]
mod tests;
mod zone;

pub use answer::{Effect, Failure, FigureTolerance, LimitYield, SlopeSource, Tolerances};
pub use grade::Class;
pub use indices::{Estimate, Indices, LEVEL};
pub use sampling::{MOST_DIMENSIONS, MOST_SAMPLES, SamplePlan};
pub use stack::{AtLimits, FirstOrder, NotLinear};
pub use statistics::{QUANTILES, Spread, Yield};
pub use study::tolerances;
pub use task::{Dimension, Evaluate, Figure, Outcome, ToleranceTask};
pub use zone::{Distribution, SIGMAS, WrittenLimits, WrittenTolerance, Zone};

/// Samples if none are named.
pub const USUAL_SAMPLES: usize = 4096;
