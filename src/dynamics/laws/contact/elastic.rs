//! A spring without loss.

use super::{ContactForceLaw, ContactForm, Stiffness};

pub(super) const ELASTIC: ContactForceLaw = ContactForceLaw {
    key: "elastic",
    name: "elastic",
    doc: "k·p",
    stiffness: Stiffness::Proportional,
    linear: true,
    parameters: &[],
    form: |_| (ContactForm::default(), 0.0),
};
