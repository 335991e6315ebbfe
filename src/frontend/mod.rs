//! From texts and code to models: units' faults at their place, declarations that read,
//! check and describe, objects with their ports, scenes, lowering.

pub mod build;
mod builder_macros;
pub mod diagnostics;
pub mod graph;
pub mod lower;
pub mod object;
pub mod read;
pub mod scene;
