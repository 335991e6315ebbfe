//! Linear systems: dense ones of a few unknowns in memory that is kept, those with three
//! diagonals, and sparse ones of fixed pattern. What is greater, and eigenvalues, nalgebra
//! has.

mod banded;
pub(crate) mod dense;
mod entry;
mod factors;
mod sparse;

pub(crate) use banded::{cyclic, tridiagonal};
pub(crate) use entry::{Entry, Lanes};
pub(crate) use factors::Factors;
pub(crate) use sparse::{Rows, SparseLu};
