//! The best values of several variables under conditions: the lightest spring that keeps a
//! follower on its cam, the counterweight with the least frame force.
//!
//! All variables are scaled to their ranges. From every start sequential quadratic programming
//! goes on with exact slopes where results have them ([`super::gradient`]), and with central
//! differences of a prepared scene where they have none. Where slopes jump, since a greatest value
//! is reached at several places, the least of the greatest of the tangents is followed
//! (`math::optimise::constrained`).
//!
//! What holds an optimum is found by itself, from the slopes at the end: the multipliers of
//! Karush, Kuhn and Tucker. A place at which a slope is left over is no optimum, whatever the
//! method says. Along a flat direction the optimum is a stretch.
//!
//! A place at which the scene has no values is one with a cause, and never a value.

mod conflict;
mod document;
mod evaluate;
mod result;
mod scaled;
mod search;
mod start;
mod variable;

pub(crate) use evaluate::{AskedFigure, OptimizationTask};
pub use result::{
    FinerCheck, FlatStretch, HeldBound, HeldCondition, LeastViolation, Optimization, Optimum,
    SlopeSources, StartEnd, StartResult,
};
pub(crate) use search::optimize;
pub use variable::Variable;

/// Starts if their number is not given.
pub const STARTS: usize = 8;
/// Most starts.
pub const MOST_STARTS: usize = 1000;
/// Most variables.
pub const MOST_VARIABLES: usize = 20;
