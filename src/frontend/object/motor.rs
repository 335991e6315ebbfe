//! The motor of a drive: turning, or linear.

use super::load::points;
use super::measures::Measures;
use super::spec::{MotorSpec, TorqueSpec, WrittenSpec};
use super::written;
use crate::dynamics::builder::written as builder;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::units::quantities as q;
use serde_json::json;

pub(super) fn read(slot: Slot<'_>, own: Measures) -> Option<MotorSpec> {
    slot.record(|fields| {
        let doc = "Inertia of the rotor, or mass of a linear motor; 0 when what follows it rigidly has inertia enough";
        let inertia = fields.need("inertia", doc, |slot| {
            slot.quantity(own.inertia(), Bounds::NOT_NEGATIVE)
        });
        let start = start(fields, own);
        let speed = fields.or("speed", "Speed at t = 0", json!(0.0), |slot| {
            slot.quantity(own.speed(), Bounds::ANY)
        });
        let mut torque = fields.one_of("what it is driven by");
        if own.0 != Some(Coordinate::Sliding) {
            torque.case("torque", "Driving torque over speed.", |slot| {
                slot.record(|fields| law(fields, TURNING))
            });
        }
        if own.0 != Some(Coordinate::Turning) {
            torque.case("force", "Driving force over speed.", |slot| {
                slot.record(|fields| law(fields, SLIDING))
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
pub(super) fn start(fields: &mut Fields<'_>, own: Measures) -> Option<f64> {
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

/// A characteristic over speed, of a torque or of a force.
#[derive(Clone, Copy)]
struct Kind {
    own: Measures,
    stall: &'static str,
}

const TURNING: Kind = Kind {
    own: Measures(Some(Coordinate::Turning)),
    stall: "stall_torque",
};

const SLIDING: Kind = Kind {
    own: Measures(Some(Coordinate::Sliding)),
    stall: "stall_force",
};

fn law(fields: &mut Fields<'_>, kind: Kind) -> Option<TorqueSpec> {
    let turns = kind.own.0 == Some(Coordinate::Turning);
    let fields_have_over = fields.has("over");
    let mut law = fields.one_of(if turns { "the torque" } else { "the force" });
    let doc = if turns {
        "Constant torque"
    } else {
        "Constant force"
    };
    law.case("constant", doc, |slot| {
        slot.quantity(kind.own.force(), Bounds::ANY)
            .map(TorqueSpec::Constant)
    });
    law.case("linear", "T₀·(1 − ω/ω₀).", |slot| {
        linear(slot, kind)
    });
    if turns {
        law.case(
            "kloss",
            "Asynchronous motor: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.",
            kloss,
        );
    }
    let doc = match turns {
        true => "List of [speed, torque]: linear between the points, constant outside.",
        false => "List of [speed, force]: linear between the points, constant outside.",
    };
    law.case("table", doc, |slot| {
        points(slot, kind.own.speed(), kind.own.force(), 2).map(TorqueSpec::Table)
    });
    let names = written::with_over(builder::OWN.to_vec(), fields_have_over);
    law.case(
        "expression",
        "Expression over t, phi and phi_dot of the drive, in s, rad or m: \"30*(1 - phi_dot/150)\".",
        |slot| {
            let expression = written::expression(slot, &names)?;
            Some(TorqueSpec::Written(WrittenSpec {
                expression,
                factor: 1.0,
                over: None,
            }))
        },
    );
    let law = law.finish();
    let factor = written::unit(fields, kind.own.force());
    let over = written::over(fields);
    if written::forbid_beside(fields, &["expression"]) {
        return None;
    }
    match (law?, factor?, over?) {
        (TorqueSpec::Written(mut spec), factor, over) => {
            spec.factor = factor.unwrap_or(1.0);
            spec.over = over;
            Some(TorqueSpec::Written(spec))
        }
        (law, _, _) => Some(law),
    }
}

fn linear(slot: Slot<'_>, kind: Kind) -> Option<TorqueSpec> {
    slot.record(|fields| {
        let doc = match kind.own.0 {
            Some(Coordinate::Sliding) => "Force at rest, F₀",
            _ => "Torque at rest, T₀",
        };
        let stall = fields.need(kind.stall, doc, |slot| {
            slot.quantity(kind.own.force(), Bounds::NOT_ZERO)
        });
        let no_load = fields.need("no_load_speed", "Speed without load, ω₀", |slot| {
            slot.quantity(kind.own.speed(), Bounds::NOT_ZERO)
        });
        Some(TorqueSpec::Linear {
            stall_torque: stall?,
            no_load_speed: no_load?,
        })
    })
}

fn kloss(slot: Slot<'_>) -> Option<TorqueSpec> {
    slot.record(|fields| {
        let torque = fields.need("breakdown_torque", "Greatest torque T_b", |slot| {
            slot.quantity(q::MOMENT, Bounds::NOT_ZERO)
        });
        let slip = fields.need(
            "breakdown_slip",
            "Slip s_b of the greatest torque",
            |slot| slot.number(Bounds::up_to(1.0)),
        );
        let synchronous = fields.need("synchronous_speed", "Synchronous speed ω_s", |slot| {
            slot.quantity(q::ANGULAR_SPEED, Bounds::NOT_ZERO)
        });
        Some(TorqueSpec::Kloss {
            breakdown_torque: torque?,
            breakdown_slip: slip?,
            synchronous_speed: synchronous?,
        })
    })
}
