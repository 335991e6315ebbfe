//! report.
pub mod csv;
