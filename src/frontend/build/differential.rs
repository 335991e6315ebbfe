//! Sums of several inputs.

use super::elastic;
use crate::frontend::read::{Node, OWN, Own};
use crate::kinematics::constraint::ConstraintFunction;
use std::sync::Arc;

elastic! {
    /// A differential: its displacement is a weighted sum of those of several inputs, a
    /// planetary gear or a summing lever.
    Differential {
        /// `"turning"` (default) or `"sliding"`.
        coordinate;
        /// Output where every input is at zero.
        offset;
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
        let input = super::one_property("object", driver);
        self.with_input_property(name, input, "ratio", ratio)
    }

    /// Adds an input of a [planetary gear](Self::teeth): `sun`, `ring` or `carrier`; or
    /// of a [constraint of your own](Self::combined_by).
    pub fn member(mut self, name: &str, driver: &str) -> Self {
        let input = super::one_property("object", driver);
        self.0.property("inputs").set_property(name, input);
        self
    }

    /// Adds an input of a [summing lever](Self::lever) at a place (m) along it.
    pub fn arm(self, name: &str, driver: &str, place: impl Into<Node>) -> Self {
        let input = super::one_property("object", driver);
        self.with_input_property(name, input, "at", place)
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

    fn with_input_property(
        mut self,
        name: &str,
        mut input: Node,
        key: &str,
        value: impl Into<Node>,
    ) -> Self {
        input.set_property(key, value);
        self.0.property("inputs").set_property(name, input);
        self
    }
}
