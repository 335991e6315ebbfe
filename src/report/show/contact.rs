//! Contact elements in words.

use super::units;
use crate::dynamics::model::{ContactLaw, Coordinate, ObjectPart};
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
    summary_of(contact.law, contact.stiffness, object.coordinate)
}

/// Law and numbers of a contact.
pub(super) fn summary_of(law: ContactLaw, stiffness: f64, coordinate: Coordinate) -> String {
    let unit = units(coordinate);
    let number = |value: f64| significant(value, 6);
    let of_point = stiffness;
    let stiffness = format!("k = {} {}", number(stiffness), unit.stiffness);
    let dissipation = |chi: f64| match chi {
        0.0 => String::new(),
        chi => format!(", χ = {} s/{}", number(chi), unit.displacement),
    };
    match law {
        ContactLaw::Restitution { coefficient } => {
            format!("contact, rigid, e = {}", number(coefficient))
        }
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
            number(of_point),
            unit.force,
            unit.displacement,
            dissipation(chi)
        ),
    }
}
