//! Drives: prescribed motions and motors.

use super::spec::{DriveMotionSpec, DriveSpec, MotorSpec, TorqueSpec};
use super::{ModelBuilder, Place};
use crate::dynamics::model::{Coordinate, Load, LoadLaw, NodeIndex};
use crate::dynamics::stated::{StatedDrive, StatedLoad};
use crate::kinematics::motion::DriveMotion;

impl ModelBuilder {
    /// Lowers a drive to its node.
    pub fn drive(&mut self, at: &Place, spec: &DriveSpec) {
        match spec {
            DriveSpec::Prescribed(motion) => self.prescribe(at, motion),
            DriveSpec::Motor(motor) => self.motor(at, motor),
        }
    }

    fn prescribe(&mut self, at: &Place, spec: &DriveMotionSpec) {
        match DriveMotion::new(spec) {
            Ok(motion) => {
                let node = self.prescribed(at, motion);
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
        if let Some(law) = self.torque(&name, word, &spec.torque, node) {
            self.model.loads.push(Load { node, name, law });
            self.state_load(StatedLoad::from(&spec.torque), node);
            if let TorqueSpec::Written(written) = &spec.torque {
                let name = at.path(&format!("motor.{word}"));
                self.wait_for(&name, written.over.as_ref());
            }
        }
        // The rotor has no driver: positions of its loads are its own.
        for load in &spec.loads {
            self.load(at, load, &[node], node);
        }
    }

    fn torque(
        &mut self,
        path: &str,
        word: &str,
        spec: &TorqueSpec,
        node: NodeIndex,
    ) -> Option<LoadLaw> {
        let faults = &mut self.faults;
        match *spec {
            TorqueSpec::Constant(torque) => {
                faults.finite(&format!("{path}.constant"), torque);
                Some(LoadLaw::Constant(torque))
            }
            TorqueSpec::Linear {
                stall_torque,
                no_load_speed,
            } => {
                let path = format!("{path}.linear");
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
                let path = format!("{path}.kloss");
                faults.finite(&format!("{path}.breakdown_torque"), breakdown_torque);
                faults.positive(&format!("{path}.breakdown_slip"), breakdown_slip);
                faults.not_zero(&format!("{path}.synchronous_speed"), synchronous_speed);
                Some(LoadLaw::Kloss {
                    breakdown_torque,
                    breakdown_slip,
                    synchronous_speed,
                })
            }
            TorqueSpec::Written(ref written) => self.written(path, written, node, node),
            TorqueSpec::Table(ref points) => {
                faults.points(&format!("{path}.table"), points, 1);
                Some(LoadLaw::SpeedTable(points.clone()))
            }
        }
    }
}

impl From<&TorqueSpec> for StatedLoad {
    fn from(spec: &TorqueSpec) -> Self {
        match spec {
            TorqueSpec::Constant(torque) => Self::Constant(*torque),
            TorqueSpec::Linear {
                stall_torque,
                no_load_speed,
            } => Self::Motor {
                stall: *stall_torque,
                no_load: *no_load_speed,
            },
            TorqueSpec::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => Self::Kloss {
                breakdown: *breakdown_torque,
                slip: *breakdown_slip,
                synchronous: *synchronous_speed,
            },
            TorqueSpec::Table(points) => Self::OverSpeed(points.clone()),
            TorqueSpec::Written(written) => Self::Written {
                expression: written.expression.clone(),
                factor: written.factor,
            },
        }
    }
}
