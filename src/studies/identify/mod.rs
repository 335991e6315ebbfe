//! Numbers of a scene from records of its motion.
//!
//! The residuals are differences of the signals of a run from those of a record, over a stated
//! standard deviation. Their squares are made least between bounds (`fit`), from several starts:
//! contacts that open make several least values. The derivatives are differences of runs of order
//! 4. Standard errors and correlations follow from s²(JᵀJ)⁻¹ ([`Certainty`]), and hold if the sum of
//! squares rises as linear residuals have it. Runs of equal signs show whether the residuals are
//! random ([`RunsTest`]). A fit that does not explain the records determines nothing ([`Misfit`]).

mod certainty;
mod differences;
mod document;
mod fit;
mod grid;
mod misfit;
mod quality;
mod result;
mod runs_test;
mod study;
#[cfg(test)]
mod tests;

pub use certainty::{CORRELATED, Certainty, UNDETERMINED};
pub use differences::{Precision, Residuals};
pub use fit::{Ending, Fit, fit};
pub use grid::Grid;
pub use misfit::{ChiSquared, Misfit};
pub use result::{Change, Estimate, FittedSignal, Identification, Standing, StartResult};
pub use runs_test::{RANDOM, RunsTest};
pub use study::{IdentificationTask, identify};
