//! Drives: where motion comes from.

use super::law::run_law;
use super::load::{On, points, read_all};
use super::motor;
use super::plan;
use super::spec::{DriveMotionSpec, DriveSpec};
use super::{Description, Kind, Object, no_outputs};
use crate::model::Coordinate;
use crate::read::{Bounds, Fields, Slot};
use crate::units::quantities as q;
use serde_json::json;

/// A drive: prescribed motion, or a motor.
///
/// ```text
/// (~)── φ(t)      prescribed: speed, run-up, plan, table
/// (M)── φ̈ = ΣM/J  motor: rotor inertia and torque over speed
/// ```
///
/// Parameters: `motion` or `motor`; `loads` on a motor's rotor. Turning,
/// positive counter-clockwise. Limits: a prescribed motion is not held up by
/// any load.
#[derive(Debug)]
pub struct Drive {
    spec: DriveSpec,
}

pub(super) const KIND: Kind = Kind {
    name: "drive",
    doc: "A drive: prescribed motion, or a motor.",
    driven: false,
    outputs: no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read: |fields, _| {
        let spec = read(fields)?;
        Some(Box::new(Drive { spec }))
    },
};

impl Object for Drive {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn coordinate(&self) -> Coordinate {
        Coordinate::Turning
    }

    fn description(&self) -> Description<'_> {
        Description::Drive(&self.spec)
    }
}

fn read(fields: &mut Fields<'_>) -> Option<DriveSpec> {
    let mut source = fields.one_of("what drives it");
    source.case("motion", "Prescribed motion.", |slot| {
        motion(slot).map(DriveSpec::Prescribed)
    });
    source.case("motor", "A motor.", |slot| {
        motor::read(slot).map(DriveSpec::Motor)
    });
    let source = source.finish();
    let loads = read_all(fields, On::Rotor);
    match (source?, loads?) {
        (DriveSpec::Motor(mut motor), loads) => {
            motor.loads = loads;
            Some(DriveSpec::Motor(motor))
        }
        (prescribed, loads) => {
            if !loads.is_empty() {
                fields
                    .refuse(
                        "loads",
                        "contradiction",
                        "loads have no effect on a prescribed motion",
                    )
                    .hints
                    .push("remove `loads`, or use a `motor`".to_owned());
                return None;
            }
            Some(prescribed)
        }
    }
}

fn angle(fields: &mut Fields<'_>) -> Option<f64> {
    fields.or("angle", "Angle at t = 0", json!(0.0), |slot| {
        slot.quantity(q::ANGLE, Bounds::ANY)
    })
}

fn motion(slot: Slot<'_>) -> Option<DriveMotionSpec> {
    let turning = |slot: Slot<'_>| slot.quantity(q::ANGULAR_SPEED, Bounds::NOT_ZERO);
    slot.record(|fields| {
        let mut motion = fields.one_of("the motion");
        motion.case("speed", "Constant speed", |slot| {
            let speed = turning(slot)?;
            Some(DriveMotionSpec::Constant { speed, angle: 0.0 })
        });
        motion.case("run_up", "Smooth run-up from rest to a speed.", |slot| {
            slot.record(|fields| {
                let speed = fields.need("speed", "Final speed", turning);
                let time = fields.need("time", "Duration of the run-up", |slot| {
                    slot.quantity(q::TIME, Bounds::POSITIVE)
                });
                let angle = angle(fields);
                let doc = "Law of the run-up; default: speed 3τ² − 2τ³ of the final one.";
                let law = fields.maybe("law", doc, run_law);
                Some(DriveMotionSpec::RunUp {
                    speed: speed?,
                    time: time?,
                    angle: angle?,
                    law: law?,
                })
            })
        });
        motion.case(
            "plan",
            "Plan of motion over time: moves by laws of motion and dwells.",
            |slot| plan::of_drive(slot).map(DriveMotionSpec::Plan),
        );
        motion.case(
            "table",
            "List of [time, angle], at least three: a smooth spline through the points.",
            |slot| {
                let points = points(slot, q::TIME.into(), q::ANGLE.into(), 3)?;
                Some(DriveMotionSpec::Table { points })
            },
        );
        let motion = motion.finish();
        let start = fields.maybe("angle", "Angle at t = 0, with `speed`; default 0", |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
        });
        match (motion?, start?) {
            (DriveMotionSpec::Constant { speed, .. }, angle) => {
                let angle = angle.unwrap_or(0.0);
                fields.fill_in("angle", json!(angle));
                Some(DriveMotionSpec::Constant { speed, angle })
            }
            (other, None) => Some(other),
            (_, Some(_)) => {
                let message = "`angle` stands beside `speed` only";
                fields.refuse("angle", "contradiction", message);
                None
            }
        }
    })
}
