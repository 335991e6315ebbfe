//! Numbers of a scene from records of its motion.
//!
//! The residuals are differences of the signals of a run from those of a record, over a stated
//! standard deviation. Their squares are made least between bounds ([`fit()`]), from several starts:
//! contacts that open make several least values. The derivatives are differences of runs of order
//! 4. Standard errors and correlations follow from s²(JᵀJ)⁻¹ ([`Certainty`]). Runs of equal signs
//! tell whether what is left is random ([`RunsTest`]).

mod certainty;
mod document;
mod fit;
mod grid;
mod study;
#[cfg(test)]
mod tests;

pub use certainty::{CORRELATED, Certainty, RANDOM, RunsTest, UNDETERMINED};
pub use fit::{Bounds, Ending, Fit, Residuals, fit};
pub use grid::Grid;
pub use study::{Estimate, FittedSignal, Identification, StartResult, Unknown, identify, starts};
