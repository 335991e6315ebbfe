//! The smallest scene that gives the figures asked for within their accuracy.
//!
//! Where each figure leads as the elastic objects are refined is found first
//! ([`crate::studies::order`]): that is the truth which every simpler scene is judged by, as a
//! whole. Then the levels of the elastic objects are lowered one by one, and everything else
//! that can be left out is tried: alone first, then what changes least first, on top of what
//! is left out already. A pair that never opens is made bilateral, which allows lower levels
//! again.
//!
//! A removal (`removal`) is a change of the scene's tree by addresses (`scene::edit`), so that
//! every simpler scene is read, checked and run like any other. The remaining scene is written
//! out with descriptions (`description`).

mod cost;
mod description;
mod findings;
mod removal;
mod search;
mod variant;

pub use cost::{Cost, Times};
pub use findings::{Change, ModelTried, Reduction, Refusal, Role, Step};
pub use removal::{Part, Removal};
pub use search::reduce;
