//! A spring without loss.

use super::{ContactForceLaw, ContactForm};

pub(super) const ELASTIC: ContactForceLaw = ContactForceLaw {
    key: "elastic",
    name: "elastic",
    doc: "k·p",
    pair_loss: None,
    parameters: &[],
    form: |_| (ContactForm::default(), 0.0),
};
