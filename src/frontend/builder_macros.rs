//! What builders are declared by: a builder makes the tree that a scene's text would be read into.

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
            pub(in crate::frontend) const PROPERTIES: &[&str] =
                &[$($crate::frontend::builder_macros::builder!(@ $method $($property)?)),*];

            $(
                $(#[$doc])*
                pub fn $method(self, value: impl Into<$crate::frontend::read::Node>) -> Self {
                    self.set($crate::frontend::builder_macros::builder!(@ $method $($property)?), value)
                }
            )*

            /// Sets any property by its name in a scene's text, or by its address
            /// within this value: `pair.gap`.
            pub fn set(mut self, property: &str, value: impl Into<$crate::frontend::read::Node>) -> Self {
                *$crate::frontend::builder_macros::at(&mut self.0, property) = value.into();
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
        $crate::frontend::builder_macros::builder! {
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
                self.0.property("stops").set_property(name, stop);
                self
            }

            /// Adds a load, positive towards positive displacement.
            pub fn load(mut self, name: &str, load: impl Into<$crate::frontend::read::Node>) -> Self {
                self.0.property("loads").set_property(name, load);
                self
            }
        }
    };
}
pub(crate) use elastic;

/// Declares the builder of a kind of chains, with the properties that it has beside
/// those of all.
macro_rules! chain_builder {
    ($(#[$about:meta])* $name:ident of $kind:ident { $($own:tt)* }) => {
        $crate::frontend::builder_macros::elastic! {
            $(#[$about])*
            $name {
                /// Position function U(φ): where the driver asks the object to be.
                position;
                /// Factor on the position function.
                lever_ratio;
                $($own)*
            }
        }

        impl $name {
            /// An object driven by another, or by an output of one: `shaft`, `press.ram`.
            pub fn on(driver: &str) -> Self {
                Self($crate::frontend::builder_macros::of_kind($kind.name)).set("input", driver)
            }

            /// Copies an object of the catalogue, `rocker/steel-lever-205mm`; properties
            /// given here replace its own.
            pub fn copy_of(self, catalogued: &str) -> Self {
                self.set("from", catalogued)
            }
        }
    };
}
pub(crate) use chain_builder;

/// The value at an address within a tree, objects on the way made where they are
/// missing.
pub(crate) fn at<'n>(node: &'n mut Node, address: &str) -> &'n mut Node {
    address
        .split('.')
        .fold(node, |node, name| node.property(name))
}

/// An object of a kind.
pub(crate) fn of_kind(kind: &str) -> Node {
    let mut node = Node::object();
    node.set_property("kind", kind);
    node
}

/// An object with one property.
pub(crate) fn one_property(property: &str, value: impl Into<Node>) -> Node {
    let mut node = Node::object();
    node.set_property(property, value);
    node
}
