//! Sums of several inputs.

use super::builder;
use crate::frontend::read::{Node, OWN, Own};
use crate::kinematics::constraint::ConstraintFunction;
use std::sync::Arc;

builder! {
    /// A differential: its displacement is a weighted sum of those of several inputs, a
    /// planetary gear or a summing lever.
    Differential {
        /// Remarks for people.
        description;
        /// `"turning"` (default) or `"sliding"`.
        coordinate;
        /// Output where every input is at zero.
        offset;
        /// Number of masses; 0: rigid. Default 1.
        masses;
        /// Total inertia J (kg·m² or kg).
        inertia;
        /// Stiffness c seen at the last mass (N·m/rad or N/m).
        stiffness;
        /// Specific damping capacity ψ: share of the elastic energy that is lost in one
        /// cycle.
        damping_capacity;
        /// Damping b seen at the last mass (N·m·s/rad or N·s/m), in place of ψ.
        damping;
        /// Split of the inertia: `"cubes"`, `"equal"`, or a list of shares.
        split;
        /// Place of the inertia of each cell: `"ends"` (default) or `"balanced"`.
        lumping;
        /// Number of vibration modes, in place of `masses`.
        modes;
        /// `"static"`: it gives way as under slow forces, without vibrations; in place of
        /// `masses`.
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
        /// Gap of a form-closed pair, in place of `pair`.
        backlash;
    }
}

impl Differential {
    /// A sum without inputs as yet.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(super::of_kind("differential"))
    }

    /// Adds an input: its name, what drives it, and the factor with which it enters the
    /// sum.
    pub fn input(self, name: &str, driver: &str, ratio: impl Into<Node>) -> Self {
        let input = super::only("object", driver);
        self.with(name, input, "ratio", ratio)
    }

    /// Adds an input of a [planetary gear](Self::teeth): `sun`, `ring` or `carrier`; or
    /// of a [constraint of your own](Self::combined_by).
    pub fn member(mut self, name: &str, driver: &str) -> Self {
        let input = super::only("object", driver);
        self.0.property("inputs").put(name, input);
        self
    }

    /// Adds an input of a [summing lever](Self::lever) at a place (m) along it.
    pub fn arm(self, name: &str, driver: &str, place: impl Into<Node>) -> Self {
        let input = super::only("object", driver);
        self.with(name, input, "at", place)
    }

    /// A constraint of your own, φ = G(φ₁, …, φₖ), over inputs that have been added by
    /// [`Self::member`]; its drivers are in the order of their names.
    pub fn combined_by(self, constraint: impl ConstraintFunction + 'static) -> Self {
        let constraint: Arc<dyn ConstraintFunction> = Arc::new(constraint);
        self.set(OWN, Own::new(constraint))
    }

    /// A planetary gear by the tooth numbers of its sun and ring gears.
    pub fn teeth(self, sun: u32, ring: u32) -> Self {
        self.set("planetary.teeth.sun", sun)
            .set("planetary.teeth.ring", ring)
    }

    /// A planetary gear by its basic ratio φ_sun/φ_ring with the carrier held.
    pub fn basic_ratio(self, ratio: impl Into<Node>) -> Self {
        self.set("planetary.basic_ratio", ratio)
    }

    /// A lever whose output is at this place (m) along it.
    pub fn lever(self, output: impl Into<Node>) -> Self {
        self.set("lever.output", output)
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

    fn with(mut self, name: &str, mut input: Node, key: &str, value: impl Into<Node>) -> Self {
        input.put(key, value);
        self.0.property("inputs").put(name, input);
        self
    }
}
