//! A damper to the ground.

use super::{Domain, ForceLaw, Measure, Parameter};
use crate::dynamics::model::LoadLaw;

pub(super) const VISCOUS: ForceLaw = ForceLaw {
    key: "viscous",
    doc: "Viscous: W = −b·φ̇, b",
    parameters: &[Parameter {
        key: "",
        doc: "",
        letter: ("b", ""),
        meaning: "viscous damping",
        measure: Measure::Damping,
        domain: Domain::NotNegative,
        usual: None,
    }],
    formula: "-(viscous*phi_dot)",
    words: "viscous {viscous}",
    law: |values| LoadLaw::viscous(values[0]),
};
