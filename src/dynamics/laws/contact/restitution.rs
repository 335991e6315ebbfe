//! A rigid contact: what comes together at a speed goes apart at e times that speed, at once; what presses without
//! coming apart is held.

use super::super::parameter::{Domain, Measure, Parameter};
use super::{ContactForceLaw, ContactForm};

pub(super) const RESTITUTION: ContactForceLaw = ContactForceLaw {
    key: "restitution",
    name: "rigid",
    doc: "rigid, with impacts, which is the default where that is given",
    pair_loss: None,
    parameters: &[&Parameter {
        key: "restitution",
        doc: "Coefficient of restitution e of a rigid contact: the speed after an impact over \
              that before it",
        letter: ("e", ""),
        meaning: "coefficient of restitution",
        measure: Measure::Number,
        domain: Domain::Between(0.0, 1.0),
        usual: None,
    }],
    form: |own| {
        let restitution = own[0];
        (ContactForm::Rigid { restitution }, 0.0)
    },
};
