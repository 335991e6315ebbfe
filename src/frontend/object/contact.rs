//! Contact elements.

use super::contact_geometry::{self, Touching};
use super::measures::Measures;
use super::spec::ContactSpec;
use crate::dynamics::model::ContactLaw;
use crate::frontend::read::{Bounds, Fields, Slot};
use serde_json::json;

/// Names of the laws.
#[derive(Clone, Copy, PartialEq)]
enum Name {
    Elastic,
    KelvinVoigt,
    HuntCrossley,
    Hertz,
}

const LAWS: [(&str, Name); 4] = [
    ("elastic", Name::Elastic),
    ("kelvin_voigt", Name::KelvinVoigt),
    ("hunt_crossley", Name::HuntCrossley),
    ("hertz", Name::Hertz),
];

/// Reads a contact element.
pub(super) fn read(slot: Slot<'_>, own: Measures) -> Option<ContactSpec> {
    slot.record(|fields| {
        let law = fields.or(
            "law",
            "N over the indentation p and its rate: `elastic` k·p; `kelvin_voigt` k·p + damping·ṗ; \
             `hunt_crossley` k·p·(1 + dissipation·ṗ); `hertz` K·p^(3/2)·(1 + dissipation·ṗ).",
            json!("elastic"),
            |slot| slot.choice(&LAWS),
        );
        let from = fields.maybe(
            "from",
            "Geometry from which the stiffness follows, in its place.",
            |slot| contact_geometry::read(slot, own),
        );
        let stiffness = fields.maybe(
            "stiffness",
            "Stiffness k of the contact; of `hertz` K, a bare number in N/m^(3/2) or N m/rad^(3/2)",
            |slot| match law {
                // (Units have whole exponents.)
                Some(Name::Hertz) => slot.number(Bounds::POSITIVE),
                _ => slot.quantity(own.stiffness(), Bounds::POSITIVE),
            },
        );
        let damping = fields.maybe("damping", "Damping of `kelvin_voigt`", |slot| {
            slot.quantity(own.damping(), Bounds::NOT_NEGATIVE)
        });
        let dissipation = fields.maybe(
            "dissipation",
            "χ of `hunt_crossley` and `hertz`, seconds per unit of indentation",
            |slot| slot.quantity(own.time_per_displacement(), Bounds::NOT_NEGATIVE),
        );
        let stiffness = stiffness_of(fields, law?, from?, stiffness?);
        let law = of_name(fields, law?, damping?, dissipation?);
        Some(ContactSpec {
            stiffness: stiffness?,
            law: law?,
        })
    })
}

/// The stiffness as given, or from the geometry of a contact that has such a law.
fn stiffness_of(
    fields: &mut Fields<'_>,
    law: Name,
    from: Option<(Touching, f64)>,
    given: Option<f64>,
) -> Option<f64> {
    if fields.clash(
        "stiffness",
        "from",
        "the stiffness follows from the geometry",
    ) {
        return None;
    }
    let Some((touching, stiffness)) = from else {
        if given.is_none() {
            let hint = "give it, or the geometry that it follows from, `from`";
            fields.lack("stiffness", Some(hint.to_owned()));
        }
        return given;
    };
    let (fits, message, hint) = match touching {
        Touching::Point => (
            law == Name::Hertz,
            "a contact in a point has the law `hertz`",
            "set `law` to \"hertz\", or give a `line`",
        ),
        Touching::Line => (
            law != Name::Hertz,
            "the law `hertz` is that of a contact in a point",
            "give a `point`, or another `law`",
        ),
    };
    if !fits {
        let fault = fields.refuse("from", "contradiction", message);
        fault.hints.push(hint.to_owned());
        return None;
    }
    Some(stiffness)
}

/// The law with its loss; each takes only one sort.
fn of_name(
    fields: &mut Fields<'_>,
    law: Name,
    damping: Option<f64>,
    dissipation: Option<f64>,
) -> Option<ContactLaw> {
    let named = LAWS.iter().find(|(_, name)| *name == law);
    let named = named.map_or("", |(name, _)| name);
    let mut sound = true;
    let wanted = [
        ("damping", damping, law == Name::KelvinVoigt, "kelvin_voigt"),
        (
            "dissipation",
            dissipation,
            matches!(law, Name::HuntCrossley | Name::Hertz),
            "hunt_crossley",
        ),
    ];
    for (name, value, taken, other) in wanted {
        if value.is_some() && !taken {
            sound = false;
            let message = format!("`{name}` has no meaning for the contact law `{named}`");
            let fault = fields.refuse(name, "contradiction", message);
            let hint = format!("set `law` to \"{other}\", or remove `{name}`");
            fault.hints.push(hint);
        }
    }
    let needed = match law {
        Name::KelvinVoigt if damping.is_none() => Some("damping"),
        Name::HuntCrossley if dissipation.is_none() => Some("dissipation"),
        _ => None,
    };
    if let Some(needed) = needed {
        fields.lack(needed, Some(format!("the law `{named}` needs it")));
        return None;
    }
    sound.then(|| match law {
        Name::Elastic => ContactLaw::Elastic,
        Name::KelvinVoigt => ContactLaw::KelvinVoigt {
            damping: damping.unwrap_or(0.0),
        },
        Name::HuntCrossley => ContactLaw::HuntCrossley {
            dissipation: dissipation.unwrap_or(0.0),
        },
        Name::Hertz => ContactLaw::Hertz {
            dissipation: dissipation.unwrap_or(0.0),
        },
    })
}
