//! The object graph and the dynamic model as pictures. Charts are drawn by [`crate::report::plot`].

pub mod graph;
#[cfg(feature = "live")]
pub(in crate::report) mod masses;
