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

mod chains;
mod differential;
mod drive;
mod linkage;
mod load;
mod other;
mod pair;
mod position;
#[cfg(test)]
mod tests;

pub use chains::{CamFollower, Crank, Rocker, Shaft, Slider};
pub use differential::Differential;
pub use drive::{Drive, Force, Torque};
pub use linkage::{Assembly, Joint, Link, Linkage, LinkageForce, LinkageInput, Output};
pub use load::Load;
pub use other::{AnyObject, OwnObject};
pub use pair::{CamContact, Contact, DiscCam, Geometry, LineContact, Pair, PointContact, Stop};
pub use position::{Law, Position, Station};

use crate::frontend::read::Node;

/// Declares a builder: a tree with a method for each of its properties, named as in a
/// scene's text unless another name is given.
macro_rules! builder {
    (
        $(#[$about:meta])* $name:ident {
            $($(#[$doc:meta])* $method:ident $(= $property:literal)?;)*
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq)]
        #[must_use]
        pub struct $name($crate::frontend::read::Node);

        impl $name {
            /// The properties that have a method.
            #[cfg(test)]
            pub(in crate::frontend::build) const PROPERTIES: &[&str] =
                &[$($crate::frontend::build::builder!(@ $method $($property)?)),*];

            $(
                $(#[$doc])*
                pub fn $method(self, value: impl Into<$crate::frontend::read::Node>) -> Self {
                    self.set($crate::frontend::build::builder!(@ $method $($property)?), value)
                }
            )*

            /// Sets any property by its name in a scene's text, or by its address
            /// within this value: `pair.gap`.
            pub fn set(mut self, property: &str, value: impl Into<$crate::frontend::read::Node>) -> Self {
                *$crate::frontend::build::at(&mut self.0, property) = value.into();
                self
            }
        }

        impl From<$name> for $crate::frontend::read::Node {
            fn from(made: $name) -> Self {
                made.0
            }
        }
    };
    (@ $method:ident) => { stringify!($method) };
    (@ $method:ident $property:literal) => { $property };
}
pub(crate) use builder;

/// The value at an address within a tree, objects on the way made where they are
/// missing.
pub(crate) fn at<'n>(node: &'n mut Node, address: &str) -> &'n mut Node {
    address
        .split('.')
        .fold(node, |node, name| node.property(name))
}

/// An object of a kind.
fn of_kind(kind: &str) -> Node {
    let mut node = Node::object();
    node.put("kind", kind);
    node
}

/// An object with one property.
fn only(property: &str, value: impl Into<Node>) -> Node {
    let mut node = Node::object();
    node.put(property, value);
    node
}
