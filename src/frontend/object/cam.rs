//! The position function of a cam.

use super::law::read_law;
use super::measures::{Measures, read_quantity};

use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::motion::LawSpec;
use crate::kinematics::position::{CamSpec, PositionSpec};
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::TAU;

/// Rounding allowed in the sum of the four angles.
const SLACK: f64 = 1e-9;

pub(super) fn read(slot: Slot<'_>, output: Measures) -> Option<PositionSpec> {
    slot.record(|fields| {
        let lift = fields.need("lift", "Full stroke", |slot| {
            slot.quantity(output.displacement(), Bounds::NOT_ZERO)
        });
        let moving = |slot: Slot<'_>| slot.quantity(q::ANGLE, Bounds::up_to(TAU));
        let resting = |slot: Slot<'_>| slot.quantity(q::ANGLE, Bounds::between(0.0, TAU));
        let rise = fields.need("rise", "Angle of the rise", moving);
        let dwell = fields.or("dwell", "Angle of the upper dwell", json!(0.0), resting);
        let back = fields.need("return", "Angle of the return", moving);
        let rest = fields.maybe(
            "rest",
            "Angle of the rest; if given, the four angles must make a full turn",
            resting,
        );
        let laws = fields.need(
            "law",
            "Law of motion of both, or an object with one for the rise and one for the return.",
            read_rise_and_return_laws,
        );
        let phase = read_phase(fields);
        let (rise_law, return_law) = laws?;
        let spec = CamSpec {
            lift: lift?,
            rise: rise?,
            dwell: dwell?,
            return_angle: back?,
            rise_law,
            return_law,
            phase: phase?,
        };
        read_whole_turn(fields, spec, rest?).map(PositionSpec::Cam)
    })
}

fn read_rise_and_return_laws(slot: Slot<'_>) -> Option<(LawSpec, LawSpec)> {
    let apart = |slot: Slot<'_>| {
        slot.record(|fields| {
            let rise = fields.need("rise", "Law of the rise.", read_law);
            let back = fields.need("return", "Law of the return, run backwards.", read_law);
            Some((rise?, back?))
        })
    };
    let same = |slot: Slot<'_>| {
        let law = read_law(slot)?;
        Some((law.clone(), law))
    };
    if slot.describing() {
        return slot.object_or(apart, same);
    }
    let names = |name| slot.node().is_some_and(|node| node.member(name).is_some());
    if names("rise") || names("return") {
        apart(slot)
    } else {
        same(slot)
    }
}

/// The angles must fit into one turn, and fill it when `rest` is given.
fn read_whole_turn(fields: &mut Fields<'_>, spec: CamSpec, rest: Option<f64>) -> Option<CamSpec> {
    let degrees = |angle: f64| (angle.to_degrees() * 1e6).round() / 1e6;
    let used = spec.rise + spec.dwell + spec.return_angle;
    if used > TAU + SLACK {
        let message = format!(
            "rise, dwell and return take {} deg, more than a turn",
            degrees(used)
        );
        fields.refuse("rise", "out-of-range", message);
        return None;
    }
    let left = (TAU - used).max(0.0);
    if let Some(rest) = rest
        && (rest - left).abs() > SLACK
    {
        let message = format!(
            "`rest` is {} deg, but {} deg are left of the turn",
            degrees(rest),
            degrees(left)
        );
        let fault = fields.refuse("rest", "contradiction", message);
        fault
            .hints
            .push("leave out `rest`: it is what is left of the turn".to_owned());
        return None;
    }
    fields.fill_in("rest", json!(rest.unwrap_or(left)));
    Some(spec)
}

pub(super) fn read_phase(fields: &mut Fields<'_>) -> Option<f64> {
    fields.or(
        "phase",
        "Added to the driver's angle",
        json!(0.0),
        read_quantity(q::ANGLE),
    )
}
