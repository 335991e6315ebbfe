//! Scenes in code: a builder for everything that a scene's text can hold.
//!
//! ```
//! use dam::prelude::*;
//!
//! let rocker = Rocker::on("shaft")
//!     .position(Position::sine("90 deg"))
//!     .inertia(0.1)
//!     .stiffness("1e7 N m/rad")
//!     .pair(Pair::form("0.1 mrad"))
//!     .load("spring", Load::spring("2 N m/deg").preload(50));
//! let scene = Scene::new("A rocker")
//!     .add("shaft", Drive::speed("600 rpm"))
//!     .add("rocker", rocker)
//!     .duration(0.2);
//! assert!(scene.check()?.is_empty());
//! # Ok::<(), Error>(())
//! ```
//!
//! Numbers are in SI units; texts carry a unit, as in `"0.1 mm"`. A builder makes the
//! tree that a text would be read into, and the same reader reads it: defaults, checks
//! and faults are those of scenes in JSON, and nothing is said twice. A fault names its
//! property, `rocker.pair.gap`. Whatever has no method of its own is set by its name
//! (`.set("pair.gap", 1e-4)`), and what no text can state is given as a value:
//! [`Position::own`], [`OwnObject`].
//!
//! Values of such a tree have no place in a text: their faults show the address of the property
//! alone. A test compares the methods of the builders with the JSON Schema.

mod coupling;
mod differential;
mod drive;
mod linkage;
mod load;
mod other;
mod pair;
mod position;
#[cfg(test)]
mod tests;

pub use coupling::Coupling;
pub use differential::Differential;
pub use drive::{Drive, Force, Torque};
pub use linkage::{Assembly, Joint, Link, Linkage, LinkageForce, LinkageInput, Output};
pub use load::Load;
pub use other::{AnyObject, OwnObject};
pub use pair::{CamContact, Contact, DiscCam, Geometry, LineContact, Pair, PointContact, Stop};
pub use position::{Law, Position, Station};

use crate::frontend::builder_macros::{at, builder, elastic, of_kind, one_property};

/// Builders that the file of their kind declares.
pub mod kinds {
    pub use crate::frontend::object::builders::*;
}

pub use kinds::*;
