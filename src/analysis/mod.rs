//! Questions asked of a system: one file a question.

pub mod compare;
mod document;
pub mod exact;
pub mod expectations;
mod kinematic;
pub mod law;
mod method;
pub mod run;
mod settings;
pub mod spread;
#[cfg(test)]
pub(crate) mod testing;
mod warning;

pub use settings::{Control, RunSettings};
pub use warning::Warning;
