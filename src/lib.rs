//! `dam`: dynamic analysis of machine mechanisms.

pub mod analysis;
pub mod breaks;
pub mod cam;
pub mod diagnostics;
pub mod energy;
pub mod exact;
pub mod fault;
pub mod graph;
pub mod integrate;
pub mod jet;
pub mod linkage;
pub mod lower;
pub mod model;
pub mod motion;
pub mod number;
pub mod object;
pub mod polynomial;
pub mod position;
pub mod read;
pub mod record;
pub mod report;
pub mod scene;
pub(crate) mod segment;
pub mod steady;
pub mod system;
pub mod units;
