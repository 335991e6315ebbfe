//! Stiffness of a contact from the geometry of its bodies.
//!
//! Once read, it is a number like any other; `kinematics::hertzian` has the formulas.

use super::measures::Measures;
use super::spec::OnCamSpec;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::hertzian::{
    ApproachReference, ContactPressure, Material, contact_modulus, line_approach, line_pressure,
    point_pressure, point_stiffness,
};
use crate::units::quantities as q;
use serde_json::json;

/// What kind of contact a stiffness is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ContactType {
    /// k of a contact along a line, the secant at a load.
    Line,
    /// K of a contact in a point.
    Point,
}

/// A stiffness that follows from geometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Follows {
    /// From what is given beside it, with the pressure there.
    Here(ContactType, f64, ContactPressure),
    /// From the object's own cam.
    OnCam(OnCamSpec),
}

/// Reads `from`: the stiffness along or about the object's own coordinate.
pub(super) fn read(slot: Slot<'_>, own: Measures) -> Option<Follows> {
    slot.record(|fields| {
        let mut shape = fields.one_of("the shape of its contact");
        shape.case(
            "line",
            "Contact along a line (roller, flat face): k is the secant N/p at a stated load.",
            |slot| {
                let (stiffness, pressure) = slot.record(|fields| read_line(fields, own))?;
                Some(Follows::Here(ContactType::Line, stiffness, pressure))
            },
        );
        shape.case(
            "point",
            "Contact in a point, by Hertz: K; the law is `hertz`.",
            |slot| {
                let (stiffness, pressure) = slot.record(|fields| read_point(fields, own))?;
                Some(Follows::Here(ContactType::Point, stiffness, pressure))
            },
        );
        shape.case(
            "cam",
            "Contact along a line with the object's own `cam`, of its `material`: radii, width and moduli are \
             those, k is the secant N/p at a stated load.",
            |slot| Some(Follows::OnCam(slot.record(read_on_cam)?)),
        );
        shape.finish()
    })
}

fn read_on_cam(fields: &mut Fields<'_>) -> Option<OnCamSpec> {
    let load = fields.need(
        "load",
        "Contact force along the normal at which k is the secant N/p",
        |slot| slot.quantity(q::FORCE, Bounds::POSITIVE),
    );
    let doc =
        "Angle of the cam at which they touch; absent: where its profile is most sharply convex";
    let angle = fields.maybe("at", doc, |slot| slot.quantity(q::ANGLE, Bounds::ANY));
    let doc = "Depth below a flat face from which its approach is counted";
    let depth = read_positive_length(fields, "depth", doc);
    let doc = "Depth below the cam's surface from which its approach is counted, where that is flat or hollow";
    let cam_depth = read_positive_length(fields, "cam_depth", doc);
    Some(OnCamSpec {
        load: load?,
        angle: angle?,
        depths: [depth?, cam_depth?],
    })
}

fn read_length(fields: &mut Fields<'_>, name: &'static str, doc: &str) -> Option<Option<f64>> {
    fields.maybe(name, doc, |slot| slot.quantity(q::LENGTH, Bounds::NOT_ZERO))
}

fn read_positive_length(
    fields: &mut Fields<'_>,
    name: &'static str,
    doc: &str,
) -> Option<Option<f64>> {
    fields.maybe(name, doc, |slot| slot.quantity(q::LENGTH, Bounds::POSITIVE))
}

/// The arm on which the contact acts: 1 of what slides.
fn read_arm(fields: &mut Fields<'_>, own: Measures) -> Option<f64> {
    let doc = "Arm on which the contact acts, of an object that turns";
    match own.0 {
        Some(Coordinate::Sliding) => Some(1.0),
        Some(Coordinate::Turning) => fields.need("arm", doc, |slot| {
            slot.quantity(q::LENGTH, Bounds::POSITIVE)
        }),
        None => Some(read_positive_length(fields, "arm", doc)?.unwrap_or(1.0)),
    }
}

/// What both bodies are made of, the object's own first.
pub(super) fn materials(fields: &mut Fields<'_>) -> Option<[Material; 2]> {
    let ratio = |slot: Slot<'_>| slot.quantity(q::NUMBER, Bounds::between(0.0, 0.5));
    let modulus = fields.need("modulus", "Young's modulus of the object", |slot| {
        slot.quantity(q::MODULUS, Bounds::POSITIVE)
    });
    let poisson = fields.or(
        "poisson_ratio",
        "Poisson's ratio of the object.",
        json!(0.3),
        ratio,
    );
    let doc = "Young's modulus of the counter-body; absent: that of the object";
    let other = fields.maybe("counter_modulus", doc, |slot| {
        slot.quantity(q::MODULUS, Bounds::POSITIVE)
    });
    let doc = "Poisson's ratio of the counter-body; absent: that of the object";
    let other_poisson = fields.maybe("counter_poisson_ratio", doc, ratio);
    let (modulus, poisson_ratio) = (modulus?, poisson?);
    let own = Material {
        modulus,
        poisson_ratio,
    };
    let counter = Material {
        modulus: other?.unwrap_or(modulus),
        poisson_ratio: other_poisson?.unwrap_or(poisson_ratio),
    };
    Some([own, counter])
}

fn curvature(radius: Option<f64>) -> f64 {
    radius.map_or(0.0, f64::recip)
}

fn read_point(fields: &mut Fields<'_>, own: Measures) -> Option<(f64, ContactPressure)> {
    let doc = "Radius of the object: positive convex, negative hollow; absent: flat";
    let radius = read_length(fields, "radius", doc);
    let doc = "Radius of the object across its motion; absent: `radius`, a ball";
    let crown = read_length(fields, "crown_radius", doc);
    let doc = "Radius of the counter-body: positive convex, negative hollow; absent: flat";
    let counter = read_length(fields, "counter_radius", doc);
    let doc = "Radius of the counter-body across the motion; absent: flat";
    let counter_crown = read_length(fields, "counter_crown_radius", doc);
    let (materials, arm) = (materials(fields), read_arm(fields, own));
    let (radius, crown, counter, counter_crown) = (radius?, crown?, counter?, counter_crown?);
    let along = curvature(radius) + curvature(counter);
    let across = curvature(crown.or(radius)) + curvature(counter_crown);
    let (modulus, curvatures) = (contact_modulus(materials?), [along, across]);
    let found = point_stiffness(modulus, curvatures).zip(point_pressure(modulus, curvatures));
    let Some((stiffness, pressure)) = found else {
        let message = "these bodies touch in more than a point: in one plane their curvatures add up to nothing, or to a hollow";
        let fault = fields.refuse("", "contradiction", message);
        let hint = "give radii that bulge towards each other in both planes, or a `line`";
        fault.hints.push(hint.to_owned());
        return None;
    };
    // N·arm over p = arm·φ.
    let arm = arm?;
    Some((stiffness * arm.powf(2.5), pressure.on_arm(arm)))
}

fn read_line(fields: &mut Fields<'_>, own: Measures) -> Option<(f64, ContactPressure)> {
    let doc = "Radius of the object: positive convex, negative hollow; absent: flat";
    let radius = read_length(fields, "radius", doc);
    let doc = "Depth below the object's surface from which its approach is counted, where that is flat or hollow";
    let depth = read_positive_length(fields, "depth", doc);
    let doc = "Radius of the counter-body: positive convex, negative hollow; absent: flat";
    let counter = read_length(fields, "counter_radius", doc);
    let doc = "Depth below the counter-body's surface from which its approach is counted, where that is flat or hollow";
    let counter_depth = read_positive_length(fields, "counter_depth", doc);
    let width = fields.need("width", "Length of the line of contact", |slot| {
        slot.quantity(q::LENGTH, Bounds::POSITIVE)
    });
    let load = fields.need(
        "load",
        "Contact force at which k is the secant N/p",
        |slot| slot.quantity(q::FORCE, Bounds::POSITIVE),
    );
    let (materials, arm) = (materials(fields), read_arm(fields, own));
    let own = backing(fields, radius?, depth?, ["radius", "depth"]);
    let other = backing(
        fields,
        counter?,
        counter_depth?,
        ["counter_radius", "counter_depth"],
    );
    let ([first, second], width, load, arm) = (materials?, width?, load?, arm?);
    let bodies = [(first, own?), (second, other?)];
    let Some(approach) = line_approach(load / width, bodies) else {
        let message = "these bodies have no small contact along a line: their surfaces fit into each other, or the load presses them flat";
        let fault = fields.refuse("", "contradiction", message);
        let hint = "give radii that bulge towards each other, and a load that the bodies can bear";
        fault.hints.push(hint.to_owned());
        return None;
    };
    let curvature = bodies.iter().map(|body| body.1.curvature()).sum();
    let modulus = contact_modulus([first, second]);
    let factor = line_pressure(1.0 / width, modulus, curvature)?;
    let pressure = ContactPressure::Line(factor).on_arm(arm);
    Some((load / approach * arm * arm, pressure))
}

/// What the approach of one body is counted from.
fn backing(
    fields: &mut Fields<'_>,
    radius: Option<f64>,
    depth: Option<f64>,
    [radius_name, depth_name]: [&'static str; 2],
) -> Option<ApproachReference> {
    match (radius, depth) {
        (Some(radius), None) if radius > 0.0 => Some(ApproachReference::Cylinder(radius)),
        (Some(radius), Some(_)) if radius > 0.0 => {
            let message = format!("`{depth_name}` has no meaning for a convex body");
            let fault = fields.refuse(depth_name, "contradiction", message);
            let hint = "remove it: the approach of a cylinder is counted from its axis";
            fault.hints.push(hint.to_owned());
            None
        }
        (_, Some(depth)) => Some(ApproachReference::Depth {
            curvature: curvature(radius),
            depth,
        }),
        (_, None) => {
            let hint = format!(
                "the approach of a flat or hollow body is counted from a depth; or give a `{radius_name}` greater than 0"
            );
            fields.note_missing(depth_name, Some(hint));
            None
        }
    }
}
