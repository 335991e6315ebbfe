//! Rockers: turning levers that swing.
//!
//! ```text
//! driver ──U(φ), pair──○─/\/\─○ tip      (○ the fragments of the lever)
//! ```
//!
//! Parameters: inertia about the axis (kg·m²), stiffness at the tip (N·m/rad), `cam`,
//! the geometry of a disc cam that moves it, for `dam cam`, and the rest of a chain.
//! Equation: the chain's. Limits: small deflections about the law of motion.

use super::Kind;
use super::chain::{self, Rules};
use super::geometry::Beam;
use super::spec::InertiaSplit;
use crate::dynamics::model::Coordinate;
use crate::frontend::builder_macros::chain_builder;

fn rules() -> Rules {
    Rules {
        split: InertiaSplit::Cubes,
        beam: Beam::Lever,
        cam: true,
        ..Rules::of(Coordinate::Turning)
    }
}

pub(super) const KIND: Kind = Kind {
    read: |fields, context| chain::object(KIND.name, fields, context, &rules()),
    ..chain::turning(
        "rocker",
        "A rocker: a lever that swings about a fixed axis.",
    )
};

chain_builder!(
    /// A rocker: a lever that swings about a fixed axis.
    Rocker of KIND {
        /// The disc cam that moves it, for the study of cams.
        cam;
    }
);
