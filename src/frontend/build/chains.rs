//! Objects with one driver that are chains of masses, or rigid.

use super::elastic;

/// Declares the builder of a kind of chains, with the properties that it has beside
/// those of all.
macro_rules! chain {
    ($(#[$about:meta])* $name:ident, $kind:literal, { $($own:tt)* }) => {
        elastic! {
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
                Self(super::of_kind($kind)).set("input", driver)
            }

            /// Copies an object of the catalogue, `rocker/steel-lever-205mm`; properties
            /// given here replace its own.
            pub fn copy_of(self, catalogued: &str) -> Self {
                self.set("from", catalogued)
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
