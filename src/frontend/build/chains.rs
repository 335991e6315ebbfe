//! Objects with one driver that are chains of masses, or rigid.

use super::builder;
use crate::frontend::read::Node;

/// Declares the builder of a kind of chains, with the properties that it has beside
/// those of all.
macro_rules! chain {
    ($(#[$about:meta])* $name:ident, $kind:literal, { $($own:tt)* }) => {
        builder! {
            $(#[$about])*
            $name {
                /// Remarks for people.
                description;
                /// Position function U(φ): where the driver asks the object to be.
                position;
                /// Factor on the position function.
                lever_ratio;
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
            /// An object driven by another, or by an output of one: `shaft`, `press.ram`.
            pub fn on(driver: &str) -> Self {
                Self(super::of_kind($kind)).set("input", driver)
            }

            /// Copies an object of the catalogue, `rocker/steel-lever-205mm`; properties
            /// given here replace its own.
            pub fn copy_of(self, catalogued: &str) -> Self {
                self.set("from", catalogued)
            }

            /// Adds a one-sided stop of the last mass against the ground.
            pub fn stop(mut self, name: &str, stop: impl Into<Node>) -> Self {
                self.0.property("stops").put(name, stop);
                self
            }

            /// Adds a load, positive towards positive displacement.
            pub fn load(mut self, name: &str, load: impl Into<Node>) -> Self {
                self.0.property("loads").put(name, load);
                self
            }
        }
    };
}

chain!(
    /// A shaft: gear ratio, torsional masses, backlash.
    Shaft, "shaft", {
        /// Gap of a form-closed pair (rad), in place of `pair`.
        backlash;
    }
);

chain!(
    /// A crank: a lever that turns fully.
    Crank, "crank", {}
);

chain!(
    /// A rocker: a lever that swings about a fixed axis.
    Rocker, "rocker", {
        /// The disc cam that moves it, for the study of cams.
        cam;
    }
);

chain!(
    /// A slider: masses that slide.
    Slider, "slider", {
        /// Arm (m) on which an angle given by the position function becomes a length.
        lever_arm;
    }
);

chain!(
    /// A cam follower, turning or sliding, held on its cam by a closing force.
    CamFollower, "cam_follower", {
        /// `"turning"` or `"sliding"`.
        motion;
        /// Arm (m) on which an angle given by the position function becomes a length.
        lever_arm;
        /// The disc cam that moves it, for the study of cams.
        cam;
    }
);
