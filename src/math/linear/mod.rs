//! Linear systems: dense ones of a few unknowns in memory that is kept, and sparse
//! ones of fixed pattern. What is greater, and eigenvalues, nalgebra has.

pub(crate) mod dense;
mod entry;
mod factors;
mod sparse;

pub(crate) use entry::{Entry, Lanes};
pub(crate) use factors::Factors;
pub(crate) use sparse::{Rows, SparseLu};
