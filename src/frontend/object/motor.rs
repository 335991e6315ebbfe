//! The motor of a drive: turning, or linear.

use super::Context;
use super::load::declared;
use super::measures::Measures;
use super::spec::{LoadLawSpec, MotorSpec, WrittenSpec};
use super::written;
use crate::dynamics::builder::written as builder;
use crate::dynamics::laws::{self, ForceLaw};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot, read_points};
use serde_json::json;

pub(super) fn read(slot: Slot<'_>, own: Measures, context: &Context<'_>) -> Option<MotorSpec> {
    slot.record(|fields| {
        let doc = "Inertia of the rotor, or mass of a linear motor; 0 when what follows it rigidly has inertia enough";
        own.name_inertia(fields);
        let inertia = fields.need("inertia", doc, |slot| {
            slot.quantity(own.inertia(), Bounds::NOT_NEGATIVE)
        });
        let start = read_start(fields, own);
        let speed = fields.or("speed", "Speed at t = 0", json!(0.0), |slot| {
            slot.quantity(own.speed(), Bounds::ANY)
        });
        let mut torque = fields.one_of("what it is driven by");
        if own.0 != Some(Coordinate::Sliding) {
            torque.case("torque", "Driving torque over speed.", |slot| {
                slot.record(|fields| read_law(fields, Measures(Some(Coordinate::Turning)), context))
            });
        }
        if own.0 != Some(Coordinate::Turning) {
            torque.case("force", "Driving force over speed.", |slot| {
                slot.record(|fields| read_law(fields, Measures(Some(Coordinate::Sliding)), context))
            });
        }
        let torque = torque.finish();
        Some(MotorSpec {
            inertia: inertia?,
            angle: start?,
            speed: speed?,
            torque: torque?,
            loads: Vec::new(),
        })
    })
}

/// Reads where a drive is at t = 0: `angle`, or `displacement` where it slides.
pub(super) fn read_start(fields: &mut Fields<'_>, own: Measures) -> Option<f64> {
    let read = |fields: &mut Fields<'_>, name, doc| {
        fields.or(name, doc, json!(0.0), |slot| {
            slot.quantity(own.displacement(), Bounds::ANY)
        })
    };
    match own.0 {
        Some(Coordinate::Sliding) => read(fields, "displacement", "Displacement at t = 0"),
        Some(Coordinate::Turning) => read(fields, "angle", "Angle at t = 0"),
        None => {
            read(fields, "angle", "Angle at t = 0 of a drive that turns");
            read(
                fields,
                "displacement",
                "Displacement at t = 0 of a drive that slides",
            )
        }
    }
}

fn read_law(fields: &mut Fields<'_>, own: Measures, context: &Context<'_>) -> Option<LoadLawSpec> {
    let turns = own.0 == Some(Coordinate::Turning);
    let fields_have_over = fields.has("over");
    let mut law = fields.one_of(if turns { "the torque" } else { "the force" });
    let doc = if turns {
        "Constant torque"
    } else {
        "Constant force"
    };
    law.case("constant", doc, |slot| {
        slot.quantity(own.force(), Bounds::ANY)
            .map(LoadLawSpec::Constant)
    });
    let declarations: &[&'static ForceLaw] = match turns {
        true => &laws::OF_TORQUES,
        false => &laws::OF_FORCES,
    };
    for &one in declarations {
        law.case(one.key, one.doc, |slot| {
            declared(slot, one, own).map(LoadLawSpec::Declared)
        });
    }
    let doc = match turns {
        true => "List of [speed, torque]: linear between the points, constant outside.",
        false => "List of [speed, force]: linear between the points, constant outside.",
    };
    law.case("table", doc, |slot| {
        read_points(slot, own.speed(), own.force(), 2).map(LoadLawSpec::SpeedTable)
    });
    let names = written::names_with_other_object(builder::OWN.to_vec(), fields_have_over);
    law.case(
        "expression",
        "Expression over t, phi and phi_dot of the drive, in s, rad or m: \"30*(1 - phi_dot/150)\".",
        |slot| {
            let expression = written::read_expression(slot, &names)?;
            Some(LoadLawSpec::Written(WrittenSpec {
                expression,
                factor: 1.0,
                over: None,
            }))
        },
    );
    let law = law.finish();
    let factor = written::read_unit(fields, own.force());
    let over = written::read_over(fields, context);
    if written::require_expression(fields, &["expression"]) {
        return None;
    }
    Some(written::in_unit(law?, factor?).over_another(over?))
}
