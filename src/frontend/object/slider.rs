//! Sliders: objects that move along a straight guide.
//!
//! ```text
//! driver ──U(φ), pair──▢─/\/\─▢ ⇄
//! ```
//!
//! Parameters: mass (kg, as `inertia`), stiffness (N/m) and the rest of a chain;
//! `lever_arm` (m) where the position function gives an angle. Equation: the chain's.
//! Positive as the position function counts. Limits: tension and compression along the
//! guide only.

use super::Kind;
use super::chain::{self, Rules};
use crate::dynamics::model::Coordinate;
use crate::frontend::builder_macros::chain_builder;

pub(super) const KIND: Kind = Kind {
    coordinate: |_| Some(Coordinate::Sliding),
    read: |fields, context| {
        chain::object(KIND.name, fields, context, &Rules::of(Coordinate::Sliding))
    },
    ..chain::turning("slider", "A slide in a straight guide.")
};

chain_builder!(
    /// A slider: masses that slide.
    Slider of KIND {
        /// Arm (m) on which an angle given by the position function becomes a length.
        lever_arm;
    }
);
