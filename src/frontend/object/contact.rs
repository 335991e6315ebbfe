//! Contact elements.

use super::contact_geometry::{self, ContactType, Follows};
use super::load::read_number;
use super::measures::Measures;
use super::spec::{ContactSpec, OnCamSpec};
use crate::dynamics::laws::contact::{self as kinds, CONTACT_LAWS, ContactForceLaw};
use crate::dynamics::model::ContactLaw;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::hertzian::ContactPressure;
use serde_json::json;

/// Reads a contact element.
pub(super) fn read(slot: Slot<'_>, own: Measures) -> Option<ContactSpec> {
    slot.record(|fields| {
        let law = read_law(fields);
        let from = fields.maybe(
            "from",
            "Geometry from which the stiffness follows, in its place.",
            |slot| contact_geometry::read(slot, own),
        );
        let of_power = law.is_some_and(ContactForceLaw::has_power_stiffness);
        let stiffness = fields.maybe("stiffness", &doc_of_stiffness(), |slot| match of_power {
            // (Units have whole exponents.)
            true => slot.number(Bounds::POSITIVE),
            false => slot.quantity(own.stiffness(), Bounds::POSITIVE),
        });
        let mut numbers = Vec::new();
        for (parameter, doc) in kinds::properties() {
            let read = |slot: Slot<'_>| read_number(slot, parameter, own);
            numbers.push((parameter.key, fields.maybe(parameter.key, &doc, read)));
        }
        let stiffness = read_stiffness_of(fields, law?, from?, stiffness?);
        let numbers = numbers
            .into_iter()
            .map(|(key, value)| Some((key, value?)))
            .collect::<Option<Vec<_>>>();
        let law = with_numbers(fields, law?, &numbers?);
        let Stiffness {
            value: stiffness,
            on_cam,
            pressure,
        } = stiffness?;
        Some(ContactSpec {
            stiffness,
            law: law?,
            on_cam,
            pressure,
        })
    })
}

/// Reads which law it is: without a name a rigid one, where its number is given.
fn read_law(fields: &mut Fields<'_>) -> Option<&'static ContactForceLaw> {
    let meant = CONTACT_LAWS
        .iter()
        .find(|law| law.is_rigid() && law.parameters.iter().all(|own| fields.has(own.key)));
    let meant = meant.unwrap_or(&CONTACT_LAWS[0]).key;
    let choices = CONTACT_LAWS.map(|law| (law.key, law));
    fields.or("law", &kinds::doc_of_laws(), json!(meant), |slot| {
        slot.choice(&choices)
    })
}

fn doc_of_stiffness() -> String {
    format!(
        "Stiffness k of the contact; of {} K, a bare number in N/m^(3/2) or N m/rad^(3/2) where \
         the exponent is 3/2; none of {}",
        kinds::keys(ContactForceLaw::has_power_stiffness, "`", "and"),
        kinds::keys(ContactForceLaw::is_rigid, "`", "and")
    )
}

/// A stiffness, and what follows from the same geometry.
#[derive(Clone, Copy, Default)]
struct Stiffness {
    value: f64,
    on_cam: Option<OnCamSpec>,
    pressure: Option<ContactPressure>,
}

/// The stiffness as given, or from the geometry of a contact that has such a law.
fn read_stiffness_of(
    fields: &mut Fields<'_>,
    law: &ContactForceLaw,
    from: Option<Follows>,
    stiffness: Option<f64>,
) -> Option<Stiffness> {
    if fields.clash(
        "stiffness",
        "from",
        "the stiffness follows from the geometry",
    ) {
        return None;
    }
    if law.is_rigid() {
        let mut sound = true;
        for (name, is_given) in [("stiffness", stiffness.is_some()), ("from", from.is_some())] {
            if is_given {
                sound = false;
                let message = format!("`{name}` has no meaning for a rigid contact");
                let fault = fields.refuse(name, "contradiction", message);
                let hint = format!("remove `{name}`, or `{}`", law.key);
                fault.hints.push(hint);
            }
        }
        return sound.then_some(Stiffness::default());
    }
    let Some(from) = from else {
        if stiffness.is_none() {
            let hint = "give it, or the geometry that it follows from, `from`";
            fields.note_missing("stiffness", Some(hint.to_owned()));
        }
        let given = |value: f64| Stiffness {
            value,
            ..Stiffness::default()
        };
        return stiffness.map(given);
    };
    let (touching, found) = match from {
        Follows::Here(touching, value, pressure) => {
            let here = Stiffness {
                value,
                on_cam: None,
                pressure: Some(pressure),
            };
            (touching, here)
        }
        Follows::OnCam(on_cam) => {
            let open = Stiffness {
                value: f64::NAN,
                on_cam: Some(on_cam),
                pressure: None,
            };
            (ContactType::Line, open)
        }
    };
    let laws = |quote| kinds::keys(ContactForceLaw::is_of_point, quote, "or");
    let (fits, message, hint) = match touching {
        ContactType::Point => (
            law.is_of_point(),
            format!("a contact in a point has the law {}", laws("`")),
            format!("set `law` to {}, or give a `line`", laws("\"")),
        ),
        ContactType::Line => (
            !law.has_power_stiffness(),
            format!("the law `{}` is that of a contact in a point", law.key),
            "give a `point`, or another `law`".to_owned(),
        ),
    };
    if !fits {
        let fault = fields.refuse("from", "contradiction", message);
        fault.hints.push(hint);
        return None;
    }
    Some(found)
}

/// The law with its numbers; each takes only its own.
fn with_numbers(
    fields: &mut Fields<'_>,
    law: &'static ContactForceLaw,
    numbers: &[(&'static str, Option<f64>)],
) -> Option<ContactLaw> {
    let mut sound = true;
    let has = |law: &ContactForceLaw, key| law.parameters.iter().any(|own| own.key == key);
    let strange = |(key, value): &&(&'static str, Option<f64>)| value.is_some() && !has(law, *key);
    for &(key, _) in numbers.iter().filter(strange) {
        sound = false;
        let message = format!("`{key}` has no meaning for the contact law `{}`", law.key);
        let fault = fields.refuse(key, "contradiction", message);
        if let Some(other) = CONTACT_LAWS.iter().find(|law| has(law, key)) {
            let hint = format!("set `law` to \"{}\", or remove `{key}`", other.key);
            fault.hints.push(hint);
        }
    }
    let mut values = Vec::new();
    for own in law.parameters {
        let given = numbers.iter().find(|(key, _)| *key == own.key);
        let Some(value) = given.and_then(|(_, value)| *value).or(own.usual) else {
            fields.note_missing(own.key, Some(format!("the law `{}` needs it", law.key)));
            return None;
        };
        values.push(value);
    }
    sound.then(|| ContactLaw::new(law, values))
}
