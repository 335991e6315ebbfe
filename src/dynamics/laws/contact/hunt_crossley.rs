//! A force with a loss that grows with the indentation, by Hunt and Crossley.

use super::super::parameter::{Domain, Measure, Parameter};
use super::{ContactForceLaw, ContactForm, Loss};

/// χ.
pub(super) const DISSIPATION: Parameter = Parameter {
    key: "dissipation",
    doc: "χ of {laws}, seconds per unit of indentation",
    letter: ("χ", ""),
    meaning: "dissipation",
    measure: Measure::TimePerDisplacement,
    domain: Domain::NotNegative,
    usual: None,
};

pub(super) const HUNT_CROSSLEY: ContactForceLaw = ContactForceLaw {
    key: "hunt_crossley",
    name: "Hunt–Crossley",
    doc: "k·p·(1 + dissipation·ṗ)",
    pair_loss: Some(Loss::FactorOfDamper),
    parameters: &[&DISSIPATION],
    form: |own| match own[0] {
        0.0 => (ContactForm::default(), 0.0),
        chi => (ContactForm::Proportional(Loss::Factor(chi)), 0.0),
    },
};
