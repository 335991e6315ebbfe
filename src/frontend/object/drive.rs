//! Drives: where motion comes from.

use super::law::read_run_law;
use super::load::{On, read_all};
use super::measures::Measures;
use super::motor;
use super::plan;
use super::spec::{DriveMotionSpec, DriveSpec};
use super::written;
use super::{Context, Inputs, Kind, ModelBuilder, Object, Place, Ports};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Node, Slot, read_points};
use crate::units::quantities as q;
use serde_json::json;

/// A drive: prescribed motion, or a motor.
///
/// ```text
/// (~)── φ(t)      prescribed: speed, held, acceleration, run-up, plan, table
/// (M)── φ̈ = ΣM/J  motor: rotor inertia and torque over speed
/// ```
///
/// Parameters: `motion` or `motor`; `loads` on a motor's rotor; `coordinate`,
/// whether it turns (positive counter-clockwise) or slides. Limits: a prescribed motion is not held up by
/// any load.
#[derive(Debug)]
pub struct Drive {
    coordinate: Coordinate,
    spec: DriveSpec,
}

pub(super) const KIND: Kind = Kind {
    name: "drive",
    doc: "A drive: prescribed motion, or a motor.",
    inputs: Inputs::None,
    outputs: Kind::no_outputs,
    coordinate: |node| match node.get("coordinate").map(Node::text) {
        None => Some(Coordinate::Turning),
        Some(name) => COORDINATES
            .iter()
            .find(|known| Some(known.0) == name)
            .map(|known| known.1),
    },
    read: |fields, context| {
        let (coordinate, spec) = read(fields, context)?;
        Some(Box::new(Drive { coordinate, spec }))
    },
};

/// Turning and sliding, as a text names them.
pub(super) const COORDINATES: [(&str, Coordinate); 2] = [
    ("turning", Coordinate::Turning),
    ("sliding", Coordinate::Sliding),
];

impl Object for Drive {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        Ports::source(self.coordinate)
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        into.add_drive(at, &self.spec);
    }

    fn masses(&self) -> usize {
        usize::from(matches!(self.spec, DriveSpec::Motor(_)))
    }
}

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<(Coordinate, DriveSpec)> {
    let doc = "Whether the drive turns or slides (a cylinder, a linear motor).";
    let coordinate = fields.or("coordinate", doc, json!("turning"), |slot| {
        slot.choice(&COORDINATES)
    });
    let own = Measures(coordinate);
    let mut source = fields.one_of("what drives it");
    source.case("motion", "Prescribed motion.", |slot| {
        read_motion(slot, own).map(DriveSpec::Prescribed)
    });
    source.case("motor", "A motor.", |slot| {
        motor::read(slot, own, context).map(DriveSpec::Motor)
    });
    let source = source.finish();
    let loads = read_all(fields, On::Rotor(own), context);
    let spec = match (source?, loads?) {
        (DriveSpec::Motor(mut motor), loads) => {
            motor.loads = loads;
            DriveSpec::Motor(motor)
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
            prescribed
        }
    };
    Some((coordinate?, spec))
}

fn read_motion(slot: Slot<'_>, own: Measures) -> Option<DriveMotionSpec> {
    slot.record(|fields| {
        let mut motion = fields.one_of("the motion");
        motion.case("speed", "Constant speed", |slot| {
            let speed = slot.quantity(own.speed(), Bounds::NOT_ZERO)?;
            Some(DriveMotionSpec::Constant { speed, angle: 0.0 })
        });
        motion.case("fixed", "Held at this displacement.", |slot| {
            let angle = slot.quantity(own.displacement(), Bounds::ANY)?;
            Some(DriveMotionSpec::Constant { speed: 0.0, angle })
        });
        motion.case("acceleration", "Constant acceleration", |slot| {
            let acceleration = slot.quantity(own.acceleration(), Bounds::NOT_ZERO)?;
            Some(DriveMotionSpec::Accelerated {
                acceleration,
                speed: 0.0,
                angle: 0.0,
            })
        });
        motion.case("run_up", "Smooth run-up from rest to a speed.", |slot| {
            slot.record(|fields| read_run_up(fields, own))
        });
        motion.case(
            "plan",
            "Plan of motion over time: moves by laws of motion and dwells.",
            |slot| plan::of_drive(slot, own).map(DriveMotionSpec::Plan),
        );
        motion.case(
            "table",
            "List of [time, displacement], at least three: a smooth spline through the points.",
            |slot| {
                let points = read_points(slot, q::TIME, own.displacement(), 3)?;
                Some(DriveMotionSpec::Table { points })
            },
        );
        motion.case(
            "expression",
            "Displacement as an expression of t in s: \"0.1*sin(2*pi*t)\"; speed, acceleration and jerk follow from it.",
            |slot| {
                let expression = written::read_expression(slot, &[("t", 0)])?;
                Some(DriveMotionSpec::Written {
                    expression,
                    factor: 1.0,
                })
            },
        );
        let motion = motion.finish();
        let unit = written::read_unit(fields, own.displacement());
        if written::require_expression(fields, &["expression"]) {
            return None;
        }
        let start = read_start(fields, own);
        let doc = "Speed at t = 0, with `acceleration`; default 0";
        let start_speed = fields.maybe("start_speed", doc, |slot| {
            slot.quantity(own.speed(), Bounds::ANY)
        });
        let (mut motion, start, start_speed) = (motion?, start?, start_speed?);
        if let DriveMotionSpec::Written { factor, .. } = &mut motion {
            *factor = unit?.unwrap_or(1.0);
        }
        apply_start(fields, motion, start, start_speed)
    })
}

/// The property that says where the drive is at t = 0.
fn start_name(own: Measures) -> &'static str {
    match own.0 {
        Some(Coordinate::Sliding) => "displacement",
        _ => "angle",
    }
}

/// Displacement at t = 0, beside `speed` or `acceleration`: its property and value.
fn read_start(fields: &mut Fields<'_>, own: Measures) -> Option<(&'static str, Option<f64>)> {
    let name = start_name(own);
    if fields.describing() {
        let doc = "Displacement at t = 0 of a drive that slides, with `speed` or `acceleration`; default 0";
        fields.maybe("displacement", doc, |slot| {
            slot.quantity(q::LENGTH, Bounds::ANY)
        });
    }
    let doc = "Angle at t = 0, with `speed` or `acceleration`; default 0";
    let value = fields.maybe(name, doc, |slot| {
        slot.quantity(own.displacement(), Bounds::ANY)
    })?;
    Some((name, value))
}

/// Puts the start into the motions that it belongs to.
fn apply_start(
    fields: &mut Fields<'_>,
    mut motion: DriveMotionSpec,
    (name, start): (&'static str, Option<f64>),
    start_speed: Option<f64>,
) -> Option<DriveMotionSpec> {
    let (mut has_start, mut has_speed) = (false, false);
    match &mut motion {
        // Held where it is, or turning from there.
        DriveMotionSpec::Constant { speed: 0.0, .. } => {}
        DriveMotionSpec::Constant { angle, .. } => {
            *angle = start.unwrap_or(0.0);
            has_start = true;
        }
        DriveMotionSpec::Accelerated { speed, angle, .. } => {
            *angle = start.unwrap_or(0.0);
            *speed = start_speed.unwrap_or(0.0);
            (has_start, has_speed) = (true, true);
        }
        _ => {}
    }
    if has_start {
        fields.fill_in(name, json!(start.unwrap_or(0.0)));
    } else if start.is_some() {
        let message = format!("`{name}` goes with `speed` or `acceleration` only");
        fields.refuse(name, "contradiction", message);
        return None;
    }
    if has_speed {
        fields.fill_in("start_speed", json!(start_speed.unwrap_or(0.0)));
    } else if start_speed.is_some() {
        let message = "`start_speed` goes with `acceleration` only";
        fields.refuse("start_speed", "contradiction", message);
        return None;
    }
    Some(motion)
}

fn read_run_up(fields: &mut Fields<'_>, own: Measures) -> Option<DriveMotionSpec> {
    let speed = fields.need("speed", "Final speed", |slot| {
        slot.quantity(own.speed(), Bounds::NOT_ZERO)
    });
    let time = fields.need("time", "Duration of the run-up", |slot| {
        slot.quantity(q::TIME, Bounds::POSITIVE)
    });
    let angle = motor::read_start(fields, own);
    let doc = "Law of the run-up; default: speed 3τ² − 2τ³ of the final one.";
    let law = fields.maybe("law", doc, read_run_law);
    Some(DriveMotionSpec::RunUp {
        speed: speed?,
        time: time?,
        angle: angle?,
        law: law?,
    })
}
