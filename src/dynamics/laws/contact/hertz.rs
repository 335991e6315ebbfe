//! Contact in a point, by Hertz, with the loss of Hunt and Crossley.

use super::super::parameter::Parameter;
use super::hunt_crossley::DISSIPATION;
use super::{ContactForceLaw, ContactForm};

/// χ, 0 where it is left out.
const MAY_DISSIPATE: Parameter = Parameter {
    usual: Some(0.0),
    ..DISSIPATION
};

pub(super) const HERTZ: ContactForceLaw = ContactForceLaw {
    key: "hertz",
    name: "Hertz",
    doc: "K·p^(3/2)·(1 + dissipation·ṗ)",
    pair_loss: None,
    parameters: &[&MAY_DISSIPATE],
    form: |own| {
        let form = ContactForm::Power {
            exponent: 1.5,
            factor: own[0],
            compliance: 0.0,
        };
        (form, 0.0)
    },
};
