//! Contact elements.

use super::contact_geometry::{self, Follows, Touching};
use super::measures::Measures;
use super::spec::{ContactSpec, OnCamSpec};
use crate::dynamics::model::ContactLaw;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::hertzian::ContactPressure;
use serde_json::json;

/// Names of the laws.
#[derive(Clone, Copy, PartialEq)]
enum Name {
    Elastic,
    KelvinVoigt,
    HuntCrossley,
    Hertz,
    Restitution,
}

const LAWS: [(&str, Name); 5] = [
    ("elastic", Name::Elastic),
    ("kelvin_voigt", Name::KelvinVoigt),
    ("hunt_crossley", Name::HuntCrossley),
    ("hertz", Name::Hertz),
    ("restitution", Name::Restitution),
];

/// Reads a contact element.
pub(super) fn read(slot: Slot<'_>, own: Measures) -> Option<ContactSpec> {
    slot.record(|fields| {
        let unsaid = match fields.has("restitution") {
            true => "restitution",
            false => "elastic",
        };
        let law = fields.or(
            "law",
            "N over the indentation p and its rate: `elastic` k·p; `kelvin_voigt` k·p + damping·ṗ; \
             `hunt_crossley` k·p·(1 + dissipation·ṗ); `hertz` K·p^(3/2)·(1 + dissipation·ṗ); \
             `restitution` rigid, with impacts, which is the default where that is given.",
            json!(unsaid),
            |slot| slot.choice(&LAWS),
        );
        let from = fields.maybe(
            "from",
            "Geometry from which the stiffness follows, in its place.",
            |slot| contact_geometry::read(slot, own),
        );
        let stiffness = fields.maybe(
            "stiffness",
            "Stiffness k of the contact; of `hertz` K, a bare number in N/m^(3/2) or N m/rad^(3/2); \
             none of `restitution`",
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
        let restitution = fields.maybe(
            "restitution",
            "Coefficient of restitution e of a rigid contact: the speed after an impact over \
             that before it",
            |slot| slot.number(Bounds::between(0.0, 1.0)),
        );
        let stiffness = stiffness_of(fields, law?, from?, stiffness?);
        let law = of_name(fields, law?, [damping?, dissipation?, restitution?]);
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

/// A stiffness, and what follows from the same geometry.
#[derive(Clone, Copy, Default)]
struct Stiffness {
    value: f64,
    on_cam: Option<OnCamSpec>,
    pressure: Option<ContactPressure>,
}

/// The stiffness as given, or from the geometry of a contact that has such a law.
fn stiffness_of(
    fields: &mut Fields<'_>,
    law: Name,
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
    if law == Name::Restitution {
        let mut sound = true;
        for (name, is_given) in [("stiffness", stiffness.is_some()), ("from", from.is_some())] {
            if is_given {
                sound = false;
                let message = format!("`{name}` has no meaning for a rigid contact");
                let fault = fields.refuse(name, "contradiction", message);
                let hint = format!("remove `{name}`, or `restitution`");
                fault.hints.push(hint);
            }
        }
        return sound.then_some(Stiffness::default());
    }
    let Some(from) = from else {
        if stiffness.is_none() {
            let hint = "give it, or the geometry that it follows from, `from`";
            fields.lack("stiffness", Some(hint.to_owned()));
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
            (Touching::Line, open)
        }
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
    Some(found)
}

/// The law with its loss; each takes only one sort.
fn of_name(
    fields: &mut Fields<'_>,
    law: Name,
    [damping, dissipation, restitution]: [Option<f64>; 3],
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
        (
            "restitution",
            restitution,
            law == Name::Restitution,
            "restitution",
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
        Name::Restitution if restitution.is_none() => Some("restitution"),
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
        Name::Restitution => ContactLaw::Restitution {
            coefficient: restitution.unwrap_or(0.0),
        },
    })
}
