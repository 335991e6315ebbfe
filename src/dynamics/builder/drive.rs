//! Drives: prescribed motions and motors.

use super::spec::{DriveMotionSpec, DriveSpec, MotorSpec};
use super::{ModelBuilder, Place};
use crate::dynamics::model::Coordinate;
use crate::dynamics::stated::StatedDrive;
use crate::kinematics::motion::DriveMotion;

impl ModelBuilder {
    /// Lowers a drive to its node.
    pub fn add_drive(&mut self, at: &Place, spec: &DriveSpec) {
        match spec {
            DriveSpec::Prescribed(motion) => self.prescribe(at, motion),
            DriveSpec::Motor(motor) => self.motor(at, motor),
        }
    }

    fn prescribe(&mut self, at: &Place, spec: &DriveMotionSpec) {
        match DriveMotion::new(spec) {
            Ok(motion) => {
                let node = self.add_prescribed_node(at, motion);
                self.model
                    .stated
                    .drives
                    .insert(node, StatedDrive::new(spec));
            }
            Err(faults) => self.faults(at, "motion", faults),
        }
    }

    fn motor(&mut self, at: &Place, spec: &MotorSpec) {
        let (angle, speed) = (spec.angle, spec.speed);
        self.faults
            .not_negative(&at.path("motor.inertia"), spec.inertia);
        self.faults.finite(&at.path("motor.angle"), angle);
        self.faults.finite(&at.path("motor.speed"), speed);
        let node = self.rotor(at, spec.inertia, angle, speed);
        // What drives a motor is called.
        let word = match self.model.objects[at.object].coordinate {
            Coordinate::Turning => "torque",
            Coordinate::Sliding => "force",
        };
        let name = at.path(&format!("motor.{word}"));
        self.load_on(&name, &spec.torque, at.object, [node, node]);
        // The rotor has no driver: positions of its loads are its own.
        for load in &spec.loads {
            self.load(at, load, &[node], node);
        }
    }
}
