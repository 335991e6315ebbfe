//! The geometry of a disc cam and its follower: the property `cam`.

use super::Context;
use super::contact_geometry::materials;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::cam::{CamGeometry, CamMaterial, Contact, Guide, Surface};
use crate::kinematics::hertzian::contact_modulus;
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::FRAC_PI_2;

const SIGNS: [(&str, f64); 2] = [("outward", 1.0), ("inward", -1.0)];
/// Senses in which a cam turns or an angle in it is counted.
pub(super) const SENSES: [(&str, f64); 2] = [("counterclockwise", 1.0), ("clockwise", -1.0)];
const SWINGS: [(&str, f64); 2] = [("against", 1.0), ("with", -1.0)];
/// The sides of a cam that can be touched.
pub(super) const SURFACES: [(&str, Surface); 3] = [
    ("disc", Surface::Disc),
    ("hollow", Surface::Hollow),
    ("groove", Surface::Groove),
];

/// Reads `cam` of an object that turns or slides (not known: `None`).
pub(super) fn read(
    fields: &mut Fields<'_>,
    coordinate: Option<Coordinate>,
    context: &Context<'_>,
) -> Option<Option<CamGeometry>> {
    // An arm turns the angle of a cam lever into a length.
    let follower = match fields.has("lever_arm") {
        true => Some(Coordinate::Turning),
        false => coordinate,
    };
    let definition = match follower {
        Some(Coordinate::Turning) => "turning_cam",
        _ => "disc_cam",
    };
    let doc = "Geometry of the disc cam that realises the position function: for `dam cam`, and \
               with a `material` for the pressure of a run; not for the dynamics.";
    let found = fields.maybe("cam", doc, |slot| {
        slot.defined(definition, |slot| read_geometry(slot, follower))
    });
    if fields.has("cam") && context.driver == Some(Coordinate::Sliding) {
        let message = "a disc cam turns, but the driver of this object slides";
        let fault = fields.refuse("cam", "contradiction", message);
        fault
            .hints
            .push("leave out `cam`, or let something that turns drive it".to_owned());
        return None;
    }
    found
}

fn read_geometry(slot: Slot<'_>, follower: Option<Coordinate>) -> Option<CamGeometry> {
    slot.record(|fields| {
        let base_radius = fields.need(
            "base_radius",
            "Radius of the base circle: the smallest circle about the axis that the profile touches",
            |slot| slot.quantity(q::LENGTH, Bounds::POSITIVE),
        );
        let contact = fields.need("contact", "What of the follower touches the cam.", |slot| {
            read_contact(slot, follower)
        });
        let surface = fields.or(
            "surface",
            "Which side of the cam is touched.",
            json!("disc"),
            |slot| slot.choice(&SURFACES),
        );
        let outward = fields.or(
            "positive",
            "Where positive displacement takes the follower, seen from the cam's axis.",
            json!("outward"),
            |slot| slot.choice(&SIGNS),
        );
        let sense = fields.or(
            "sense",
            "Sense in which the cam turns as its angle grows.",
            json!("counterclockwise"),
            |slot| slot.choice(&SENSES),
        );
        let guide = read_guide(fields, follower, contact);
        let upright = match follower {
            Some(Coordinate::Turning) => 0.0,
            _ => FRAC_PI_2,
        };
        let direction = fields.maybe(
            "direction",
            "For drawings: direction of outward motion (default 90 deg), or from the cam's axis to that of a turning follower (default 0)",
            |slot| slot.quantity(q::ANGLE, Bounds::ANY),
        );
        fields.fill_in("direction", json!(direction.flatten().unwrap_or(upright)));
        let range = fields.maybe(
            "range",
            "First and last angle of the cam that an open profile covers; without it a whole turn",
            |slot| {
                let end = |slot: Slot<'_>| slot.quantity(q::ANGLE, Bounds::ANY);
                slot.pair(end, end)
            },
        );
        let material = read_material(fields, contact);
        Some(CamGeometry {
            base_radius: base_radius?,
            guide: guide?,
            contact: contact?,
            surface: surface?,
            outward: outward?,
            sense: sense?,
            direction: direction?.unwrap_or(upright),
            range: range?,
            material: material?,
        })
    })
}

/// What cam and follower are made of; an edge presses on no line that has a width.
fn read_material(fields: &mut Fields<'_>, contact: Option<Contact>) -> Option<Option<CamMaterial>> {
    let doc = "Material of follower and cam, the counter-body: for the Hertzian pressure between \
               them.";
    let found = fields.maybe("material", doc, |slot| {
        slot.record(|fields| {
            let doc = "Length of the line of contact: the lesser of the thicknesses";
            let thickness = fields.need("thickness", doc, |slot| {
                slot.quantity(q::LENGTH, Bounds::POSITIVE)
            });
            let bodies = materials(fields);
            let (thickness, bodies) = (thickness?, bodies?);
            Some(CamMaterial {
                thickness,
                contact_modulus: contact_modulus(bodies),
                moduli: bodies.map(|body| body.modulus),
                poisson_ratios: bodies.map(|body| body.poisson_ratio),
            })
        })
    });
    if contact == Some(Contact::KnifeEdge) && fields.has("material") {
        let message = "an edge has no radius, and so no finite pressure";
        fields.forbid(
            "material",
            message,
            "give the radius of a `roller`, however small",
        );
        return None;
    }
    found
}

fn read_contact(slot: Slot<'_>, follower: Option<Coordinate>) -> Option<Contact> {
    slot.object_or(
        |slot| {
            slot.record(|fields| {
                let mut kinds = fields.one_of("what touches the cam");
                kinds.case(
                    "roller",
                    "Radius of the roller, or of a round face",
                    |slot| {
                        let radius = slot.quantity(q::LENGTH, Bounds::POSITIVE)?;
                        Some(Contact::Roller { radius })
                    },
                );
                kinds.case("flat", "A flat face.", |slot| read_flat(slot, follower));
                kinds.finish()
            })
        },
        read_knife_edge,
    )
}

fn read_knife_edge(mut slot: Slot<'_>) -> Option<Contact> {
    if slot.describing() {
        return slot.choice(&[("knife_edge", Contact::KnifeEdge)]);
    }
    let text = slot.read_in_place(|slot| slot.text())?;
    if text == "knife_edge" {
        return Some(Contact::KnifeEdge);
    }
    let fault = slot.refuse("unknown-choice", format!("unknown contact `{text}`"));
    fault.hints.push(
        r#"it is "knife_edge", { "roller": "8 mm" } or { "flat": { "width": "30 mm" } }"#
            .to_owned(),
    );
    None
}

fn read_flat(slot: Slot<'_>, follower: Option<Coordinate>) -> Option<Contact> {
    slot.record(|fields| {
        let turning = follower == Some(Coordinate::Turning);
        let sliding = follower == Some(Coordinate::Sliding);
        let message = "the inclination is that of a face on a sliding follower";
        let hint = "a turning follower has `face_offset`";
        let wrong = turning && fields.forbid("inclination", message, hint);
        let message = "the offset of the face is that of a turning follower";
        let hint = "a sliding follower has `inclination`";
        let wrong = wrong || (sliding && fields.forbid("face_offset", message, hint));
        let mut inclination = Some(0.0);
        if !turning {
            inclination = fields.or(
                "inclination",
                "Angle between the face's normal and the direction of motion, positive against the sense in which the cam turns",
                json!(0.0),
                |slot| slot.quantity(q::ANGLE, Bounds::between(-1.5, 1.5)),
            );
        }
        let mut face_offset = Some(0.0);
        if !sliding {
            face_offset = fields.or(
                "face_offset",
                "Distance of the face from the follower's axis, positive when the face lies between that axis and the cam",
                json!(0.0),
                |slot| slot.quantity(q::LENGTH, Bounds::ANY),
            );
        }
        let width = fields.maybe("width", "Width of the face", |slot| {
            slot.quantity(q::LENGTH, Bounds::POSITIVE)
        });
        let contact = Contact::Flat {
            inclination: inclination?,
            face_offset: face_offset?,
            width: width?,
        };
        (!wrong).then_some(contact)
    })
}

/// The properties of both guides, those of the other one refused.
fn read_guide(
    fields: &mut Fields<'_>,
    follower: Option<Coordinate>,
    contact: Option<Contact>,
) -> Option<Guide> {
    let turning = follower == Some(Coordinate::Turning);
    let sliding = follower == Some(Coordinate::Sliding);
    let mut wrong = false;
    if sliding {
        for name in ["centre_distance", "arm", "swing"] {
            let message = format!("`{name}` belongs to a turning follower, and this one slides");
            wrong |= fields.forbid(name, &message, "a sliding follower has `offset`");
        }
    }
    if turning {
        let message = "`offset` belongs to a sliding follower, and this one turns";
        let hint = "a turning follower has `centre_distance`, `arm` and `swing`";
        wrong |= fields.forbid("offset", message, hint);
    }
    let found = match follower {
        Some(Coordinate::Turning) => read_swinging(fields, contact),
        Some(Coordinate::Sliding) => read_straight(fields),
        None => {
            // The schema shows both.
            let _ = (read_straight(fields), read_swinging(fields, contact));
            None
        }
    };
    found.filter(|_| !wrong)
}

fn read_straight(fields: &mut Fields<'_>) -> Option<Guide> {
    let offset = fields.or(
        "offset",
        "Distance of the follower's line from the cam's axis, positive to the side on which the cam's surface moves outwards",
        json!(0.0),
        |slot| slot.quantity(q::LENGTH, Bounds::ANY),
    );
    Some(Guide::Translating { offset: offset? })
}

fn read_swinging(fields: &mut Fields<'_>, contact: Option<Contact>) -> Option<Guide> {
    let centre_distance = fields.maybe(
        "centre_distance",
        "Distance between the axes of cam and follower",
        |slot| slot.quantity(q::LENGTH, Bounds::POSITIVE),
    );
    let arm = fields.maybe(
        "arm",
        "From the follower's axis to the centre of the roller, or to the edge",
        |slot| slot.quantity(q::LENGTH, Bounds::POSITIVE),
    );
    let against = fields.or(
        "swing",
        "Whether the follower moves outwards against the sense in which the cam turns, or with it.",
        json!("against"),
        |slot| slot.choice(&SWINGS),
    );
    if fields.describing() {
        return None;
    }
    if centre_distance == Some(None) {
        fields.note_missing("centre_distance", None);
    }
    let flat = matches!(contact, Some(Contact::Flat { .. }));
    if arm == Some(None) && contact.is_some() && !flat {
        fields.note_missing("arm", None);
    }
    let (centre_distance, arm) = (centre_distance?, arm?);
    Some(Guide::Turning {
        centre_distance: centre_distance?,
        arm: match flat {
            true => arm.unwrap_or(0.0),
            false => arm?,
        },
        against: against?,
    })
}
