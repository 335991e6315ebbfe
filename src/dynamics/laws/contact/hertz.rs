//! Contact in a point, by Hertz, with the loss of Hunt and Crossley.

use super::super::parameter::Parameter;
use super::hunt_crossley::DISSIPATION;
use super::{ContactForceLaw, ContactForm, Stiffness};

/// χ, 0 where it is left out.
const MAY_DISSIPATE: Parameter = Parameter {
    usual: Some(0.0),
    ..DISSIPATION
};

pub(super) const HERTZ: ContactForceLaw = ContactForceLaw {
    key: "hertz",
    name: "Hertz",
    doc: "K·p^(3/2)·(1 + dissipation·ṗ)",
    stiffness: Stiffness::OfPower,
    linear: false,
    parameters: &[&MAY_DISSIPATE],
    form: |own| (ContactForm::power(1.5, own[0]), 0.0),
};
