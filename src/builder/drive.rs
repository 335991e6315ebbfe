//! Drives: prescribed motions and motors.

use super::{Lowering, reach};
use crate::model::{Coordinate, Load, LoadLaw, Node, NodeMotion, TrackSource};
use crate::motion::DriveMotion;
use crate::object::spec::{DriveMotionSpec, DriveSpec, MotorSpec, TorqueSpec};

impl<'a> Lowering<'a> {
    /// Lowers a drive to its node.
    pub(super) fn drive(&mut self, id: &'a str, spec: &DriveSpec) {
        match spec {
            DriveSpec::Prescribed(motion) => self.prescribed(id, motion),
            DriveSpec::Motor(motor) => self.motor(id, motor),
        }
    }

    fn prescribed(&mut self, id: &'a str, spec: &DriveMotionSpec) {
        let motion = match DriveMotion::new(spec) {
            Ok(motion) => motion,
            Err(faults) => return self.faults.absorb(&format!("{id}.motion"), faults),
        };
        let track = self.track(TrackSource::Time, motion.breaks(), self.indices[id]);
        self.courses
            .insert(id.to_owned(), Box::new(reach::Course::prescribed(&motion)));
        self.add_output(
            id,
            Node {
                inertia: 0.0,
                motion: NodeMotion::Prescribed { motion, track },
            },
        );
    }

    fn motor(&mut self, id: &'a str, spec: &MotorSpec) {
        let (angle, speed) = (spec.angle, spec.speed);
        self.faults
            .not_negative(&format!("{id}.motor.inertia"), spec.inertia);
        self.faults.finite(&format!("{id}.motor.angle"), angle);
        self.faults.finite(&format!("{id}.motor.speed"), speed);
        self.courses
            .insert(id.to_owned(), Box::new(reach::Course::motor(angle)));
        let node = self.add_output(
            id,
            Node {
                inertia: spec.inertia,
                motion: NodeMotion::Rotor { angle, speed },
            },
        );
        if let Some(law) = self.torque(id, &spec.torque) {
            self.model.loads.push(Load {
                node,
                name: format!("{id}.motor.{}", self.torque_word(id)),
                law,
            });
        }
        // The rotor has no driver: positions of its loads are its own.
        for load in &spec.loads {
            self.load(id, load, &[node], node);
        }
    }

    /// What drives a motor is called.
    fn torque_word(&self, id: &str) -> &'static str {
        match self.model.objects[self.indices[id]].coordinate {
            Coordinate::Turning => "torque",
            Coordinate::Sliding => "force",
        }
    }

    fn torque(&mut self, id: &str, spec: &TorqueSpec) -> Option<LoadLaw> {
        let word = self.torque_word(id);
        let faults = &mut self.faults;
        match *spec {
            TorqueSpec::Constant(torque) => {
                faults.finite(&format!("{id}.motor.{word}.constant"), torque);
                Some(LoadLaw::Constant(torque))
            }
            TorqueSpec::Linear {
                stall_torque,
                no_load_speed,
            } => {
                let path = format!("{id}.motor.{word}.linear");
                faults.finite(&format!("{path}.stall_{word}"), stall_torque);
                faults.not_zero(&format!("{path}.no_load_speed"), no_load_speed);
                Some(LoadLaw::LinearMotor {
                    stall_torque,
                    no_load_speed,
                })
            }
            TorqueSpec::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => {
                let path = format!("{id}.motor.{word}.kloss");
                faults.finite(&format!("{path}.breakdown_torque"), breakdown_torque);
                faults.positive(&format!("{path}.breakdown_slip"), breakdown_slip);
                faults.not_zero(&format!("{path}.synchronous_speed"), synchronous_speed);
                Some(LoadLaw::Kloss {
                    breakdown_torque,
                    breakdown_slip,
                    synchronous_speed,
                })
            }
            TorqueSpec::Table(ref points) => {
                faults.points(&format!("{id}.motor.{word}.table"), points, 1);
                Some(LoadLaw::SpeedTable(points.clone()))
            }
        }
    }

    /// Adds the only node of an object.
    pub(super) fn add_output(&mut self, id: &str, node: Node) -> usize {
        self.model.nodes.push(node);
        let index = self.model.nodes.len() - 1;
        self.model.objects[self.indices[id]].nodes.push(index);
        self.outputs.insert(id.to_owned(), index);
        index
    }
}
