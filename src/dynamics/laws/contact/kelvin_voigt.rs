//! Spring and damper side by side, by Kelvin and Voigt.

use super::super::parameter::{Domain, Measure, Parameter};
use super::{ContactForceLaw, ContactForm, Loss};

pub(super) const KELVIN_VOIGT: ContactForceLaw = ContactForceLaw {
    key: "kelvin_voigt",
    name: "Kelvin–Voigt",
    doc: "k·p + damping·ṗ",
    pair_loss: Some(Loss::Damper),
    parameters: &[&Parameter {
        key: "damping",
        doc: "Damping of {laws}",
        letter: ("b", ""),
        meaning: "damping",
        measure: Measure::Damping,
        domain: Domain::NotNegative,
        usual: None,
    }],
    form: |own| (ContactForm::default(), own[0]),
};
