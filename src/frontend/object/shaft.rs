//! Shafts and gears: turning, in a constant ratio to the driver.
//!
//! ```text
//! driver ──ratio, backlash──○─/\/\─○─/\/\─○   torsional masses
//! ```
//!
//! Parameters: `position` (default: ratio 1), `backlash` (rad, ≥ 0: a form-closed pair
//! with that gap), inertia (kg·m²), stiffness (N·m/rad) and the rest of a chain.
//! Equation: the chain's, with U = ratio·φ. Positive in the driver's sense while the
//! ratio is positive. Limits: torsion only, no bending, no mesh stiffness that varies
//! with the angle.

use super::Kind;
use super::chain::{self, Rules};
use super::geometry::Beam;
use crate::dynamics::model::Coordinate;
use crate::frontend::builder_macros::chain_builder;

fn rules() -> Rules {
    Rules {
        beam: Beam::Shaft,
        positions: &["ratio"],
        geared: true,
        ..Rules::of(Coordinate::Turning)
    }
}

pub(super) const KIND: Kind = Kind {
    read: |fields, context| chain::object(KIND.name, fields, context, &rules()),
    ..chain::turning(
        "shaft",
        "A shaft: turns in a constant ratio to its driver, with torsional masses and backlash.",
    )
};

chain_builder!(
    /// A shaft: gear ratio, torsional masses, backlash.
    Shaft of KIND {
        /// Gap of a form-closed pair (rad), in place of `pair`.
        backlash;
    }
);
