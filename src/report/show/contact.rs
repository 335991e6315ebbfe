//! Contact elements in words.

use super::units;
use crate::dynamics::model::{ContactForm, ContactLaw, Coordinate, ObjectPart};
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

/// Law and numbers of a contact; of numbers with a default, those that differ from it.
pub(super) fn summary_of(law: ContactLaw, stiffness: f64, coordinate: Coordinate) -> String {
    let mut words = format!("contact, {}", law.declaration().name);
    let mut add = |letter: &str, value: f64, unit: &str| {
        let number = format!(", {letter} = {} {unit}", significant(value, 6));
        words.push_str(number.trim_end());
    };
    if !law.is_rigid() {
        add("k", stiffness, &unit_of_stiffness(law.form(), coordinate));
    }
    for (own, value) in law
        .parameters()
        .filter(|(own, value)| own.usual != Some(*value))
    {
        add(own.letter.0, value, units(coordinate).of(own.measure));
    }
    words
}

/// Unit of the stiffness of a force of a form: N/m, or N/m^(3/2).
pub(super) fn unit_of_stiffness(form: ContactForm, coordinate: Coordinate) -> String {
    let unit = units(coordinate);
    match form.exponent() {
        1.0 => unit.stiffness.to_owned(),
        1.5 => format!("{}/{}^(3/2)", unit.force, unit.displacement),
        n => format!(
            "{}/{}^({})",
            unit.force,
            unit.displacement,
            significant(n, 6)
        ),
    }
}
