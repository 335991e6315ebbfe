//! Cam followers: turning or sliding, held to the cam by a closing force.
//!
//! ```text
//! cam ──U(φ), contact──○─/\/\─○ ◄── closing load
//! ```
//!
//! Parameters: `motion` (`turning` or `sliding`), inertia (kg·m² or kg), stiffness
//! (N·m/rad or N/m) and the rest of a chain. The pair is force-closed unless said
//! otherwise: the follower lifts off where the closing load is too weak. `cam` holds
//! the geometry of cam and follower, for `dam cam`. Equation: the chain's. Limits: a
//! flank rigid in shape; the contact's softness is part of link 1.

use super::chain::{self, Rules};
use super::geometry::Beam;
use super::spec::InertiaSplit;
use super::{Context, Kind, Object};
use crate::dynamics::model::{Closure, Coordinate};
use crate::frontend::builder_macros::chain_builder;
use crate::frontend::read::{Fields, Node};

const MOTIONS: [(&str, Coordinate); 2] = [
    ("turning", Coordinate::Turning),
    ("sliding", Coordinate::Sliding),
];

fn rules(coordinate: Option<Coordinate>) -> Rules {
    let (split, beam) = match coordinate {
        Some(Coordinate::Turning) => (InertiaSplit::Cubes, Beam::Lever),
        _ => (InertiaSplit::Equal, Beam::Rod),
    };
    Rules {
        coordinate,
        split,
        beam,
        closure: Closure::Force,
        cam: true,
        ..Rules::of(Coordinate::Sliding)
    }
}

fn motion(node: &Node) -> Option<Coordinate> {
    let name = node.get("motion")?.text()?;
    MOTIONS
        .iter()
        .find(|motion| motion.0 == name)
        .map(|motion| motion.1)
}

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Box<dyn Object>> {
    let coordinate = fields.need("motion", "Whether the follower turns or slides.", |slot| {
        slot.choice(&MOTIONS)
    });
    chain::object(KIND.name, fields, context, &rules(coordinate))
}

pub(super) const KIND: Kind = Kind {
    coordinate: motion,
    read,
    ..chain::turning(
        "cam_follower",
        "The follower of a cam, turning or sliding, held to it by a closing force.",
    )
};

chain_builder!(
    /// A cam follower, turning or sliding, held on its cam by a closing force.
    CamFollower of KIND {
        /// `"turning"` or `"sliding"`.
        motion;
        /// Arm (m) on which an angle given by the position function becomes a length.
        lever_arm;
        /// The disc cam that moves it, for the study of cams.
        cam;
    }
);
