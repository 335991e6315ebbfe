//! Contact elements in words.

use super::units;
use crate::dynamics::model::{ContactLaw, ObjectPart};
use crate::report::quantity::significant;

/// Name of what the first link of an object joins.
pub(super) fn first_link(object: &ObjectPart) -> &'static str {
    match object.contact {
        Some(_) => "law U and mass 1, contact included",
        None => "law U and mass 1",
    }
}

/// Law and numbers of the contact element of an object; empty without one.
pub(super) fn summary(object: &ObjectPart) -> String {
    let Some(contact) = object.contact else {
        return String::new();
    };
    let unit = units(object.coordinate);
    let number = |value: f64| significant(value, 6);
    let stiffness = format!("k = {} {}", number(contact.stiffness), unit.stiffness);
    let dissipation = |chi: f64| match chi {
        0.0 => String::new(),
        chi => format!(", χ = {} s/{}", number(chi), unit.displacement),
    };
    match contact.law {
        ContactLaw::Elastic => format!("contact, elastic, {stiffness}"),
        ContactLaw::KelvinVoigt { damping } => format!(
            "contact, Kelvin–Voigt, {stiffness}, b = {} {}",
            number(damping),
            unit.damping
        ),
        ContactLaw::HuntCrossley { dissipation: chi } => {
            format!("contact, Hunt–Crossley, {stiffness}{}", dissipation(chi))
        }
        ContactLaw::Hertz { dissipation: chi } => format!(
            "contact, Hertz, k = {} {}/{}^(3/2){}",
            number(contact.stiffness),
            unit.force,
            unit.displacement,
            dissipation(chi)
        ),
    }
}
