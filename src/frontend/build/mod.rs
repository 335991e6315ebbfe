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

mod chains;
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

pub use chains::{CamFollower, Crank, Rocker, Shaft, Slider};
pub use coupling::Coupling;
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

/// Declares the builder of an object that may be elastic: the properties of its body and its
/// pair, loads and stops, and what it has beside these.
macro_rules! elastic {
    ($(#[$about:meta])* $name:ident { $($own:tt)* }) => {
        $crate::frontend::build::builder! {
            $(#[$about])*
            $name {
                /// Remarks for people.
                description;
                /// Number of masses; 0: rigid; `"auto"`: as the accuracy of the run needs.
                /// Default 1.
                masses;
                /// Total inertia J (kg·m², or kg of what slides).
                inertia;
                /// Stiffness c seen at the last mass (N·m/rad or N/m).
                stiffness;
                /// Specific damping capacity ψ: share of the elastic energy that is lost in
                /// one cycle.
                damping_capacity;
                /// Damping b seen at the last mass (N·m·s/rad or N·s/m), in place of ψ.
                damping;
                /// Split of the inertia: `"cubes"` (a uniform lever), `"equal"`, or a
                /// list of shares.
                split;
                /// Place of the inertia of each cell: `"ends"` (default) or `"balanced"`.
                lumping;
                /// Number of vibration modes, in place of `masses`.
                modes;
                /// `"static"`: it gives way as under slow forces, without vibrations; in place
                /// of `masses`.
                flexibility;
                /// Inertia of each mass, in place of `inertia`.
                inertias;
                /// Stiffness of each link, in place of `stiffness`.
                stiffnesses;
                /// Damping of each link.
                dampings;
                /// Dimensions and material, in place of inertia and stiffness.
                geometry;
                /// The driving pair.
                pair;
                $($own)*
            }
        }

        impl $name {
            /// Adds a one-sided stop of the last mass against the ground.
            pub fn stop(mut self, name: &str, stop: impl Into<$crate::frontend::read::Node>) -> Self {
                self.0.property("stops").put(name, stop);
                self
            }

            /// Adds a load, positive towards positive displacement.
            pub fn load(mut self, name: &str, load: impl Into<$crate::frontend::read::Node>) -> Self {
                self.0.property("loads").put(name, load);
                self
            }
        }
    };
}
pub(crate) use elastic;

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
