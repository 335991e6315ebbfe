//! Questions asked of a system: one file or folder a question.
//!
//! The results of all studies have addresses (`lookup`), so that scenes can expect them.

#[cfg(test)]
mod audit_tests;
pub mod axis;
pub mod cam;
pub mod check;
mod choice;
pub mod clock;
pub mod compare;
pub mod condition;
pub mod cycle;
pub mod defined;
mod demand;
mod document;
mod endless;
pub mod exact;
pub mod expectations;
pub mod find;
pub mod forces;
pub mod gradient;
pub mod identify;
pub mod judgement;
pub mod kinematics;
pub mod law;
pub mod limit;
pub mod linear;
pub mod list;
pub mod lookup;
pub mod map;
mod method;
pub mod methods;
#[cfg(feature = "live")]
pub(crate) mod offer;
pub mod optimize;
pub mod order;
pub mod orders;
pub mod plausible;
pub mod prepared;
pub mod reduce;
pub mod requirements;
pub mod rigid;
pub mod run;
mod settings;
pub(crate) mod side_by_side;
mod spans;
pub mod spread;
pub mod steady;
pub mod studied;
#[cfg(test)]
pub(crate) mod testing;
pub mod tolerance;
mod warning;

pub use settings::{Control, RunSettings, ToleranceOfAccuracy};
pub use warning::Warning;
