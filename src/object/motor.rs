//! The motor of a drive.

use super::load::points;
use super::spec::{MotorSpec, TorqueSpec};
use crate::read::{Bounds, Fields, Slot};
use crate::units::quantities as q;
use serde_json::json;

pub(super) fn read(slot: Slot<'_>) -> Option<MotorSpec> {
    slot.record(|fields| {
        let inertia = fields.need("inertia", "Rotor inertia", |slot| {
            slot.quantity(q::INERTIA, Bounds::POSITIVE)
        });
        let angle = fields.or("angle", "Angle at t = 0", json!(0.0), |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
        });
        let speed = fields.or("speed", "Speed at t = 0", json!(0.0), |slot| {
            slot.quantity(q::ANGULAR_SPEED, Bounds::ANY)
        });
        let torque = fields.need("torque", "Driving torque over speed.", |slot| {
            slot.record(torque)
        });
        Some(MotorSpec {
            inertia: inertia?,
            angle: angle?,
            speed: speed?,
            torque: torque?,
            loads: Vec::new(),
        })
    })
}

fn torque(fields: &mut Fields<'_>) -> Option<TorqueSpec> {
    let mut law = fields.one_of("the torque");
    law.case("constant", "Constant torque", |slot| {
        slot.quantity(q::MOMENT, Bounds::ANY)
            .map(TorqueSpec::Constant)
    });
    law.case("linear", "T₀·(1 − ω/ω₀).", linear);
    law.case(
        "kloss",
        "Asynchronous motor: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.",
        kloss,
    );
    law.case(
        "table",
        "List of [speed, torque]: linear between the points, constant outside.",
        |slot| points(slot, q::ANGULAR_SPEED.into(), q::MOMENT.into(), 2).map(TorqueSpec::Table),
    );
    law.finish()
}

fn speed(slot: Slot<'_>) -> Option<f64> {
    slot.quantity(q::ANGULAR_SPEED, Bounds::NOT_ZERO)
}

fn linear(slot: Slot<'_>) -> Option<TorqueSpec> {
    slot.record(|fields| {
        let stall = fields.need("stall_torque", "Torque at rest, T₀", |slot| {
            slot.quantity(q::MOMENT, Bounds::NOT_ZERO)
        });
        let no_load = fields.need("no_load_speed", "Speed without load, ω₀", speed);
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
        let synchronous = fields.need("synchronous_speed", "Synchronous speed ω_s", speed);
        Some(TorqueSpec::Kloss {
            breakdown_torque: torque?,
            breakdown_slip: slip?,
            synchronous_speed: synchronous?,
        })
    })
}
