//! Numbers of a scene from records of its motion.
//!
//! The residuals are differences of the signals of a run from those of a record, over a stated
//! standard deviation. Their squares are made least between bounds (`fit`), from several starts:
//! contacts that open make several least values. The derivatives are differences of runs of order
//! 4. Standard errors and correlations follow from s²(JᵀJ)⁻¹ ([`Certainty`]). Runs of equal signs
//! show whether the residuals are random ([`RunsTest`]).

mod certainty;
mod differences;
mod document;
mod fit;
mod grid;
mod result;
mod runs_test;
mod study;
#[cfg(test)]
mod tests;

pub use certainty::{CORRELATED, Certainty, UNDETERMINED};
pub use differences::{Precision, Residuals};
pub use fit::{Ending, Fit, fit};
pub use grid::Grid;
pub use result::{Change, Estimate, FittedSignal, Identification, StartResult};
pub use runs_test::{RANDOM, RunsTest};
pub use study::{IdentificationTask, identify};
