//! Linkages of several inputs: a node for each input, one for the first once more, and one for
//! each output.

use super::spec::{DrivenMultiLinkage, InputDrive};
use super::{ModelBuilder, Place};
use crate::dynamics::model::{Law, MultiLinkageBody, Node, NodeIndex, NodeMotion};
use crate::kinematics::constraint::Constraint;
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiOutput};
use crate::kinematics::position::{Position, PositionSpec};
use std::sync::Arc;

impl ModelBuilder {
    /// Lowers a linkage of several inputs behind what its ports hang on: its structure is
    /// found here, and everything that is wrong with it.
    pub fn multi_linkage(&mut self, at: &Place, spec: &DrivenMultiLinkage) {
        let mut inputs = Vec::new();
        for (input, (drive, _)) in spec.linkage.inputs.iter().zip(&spec.inputs) {
            let node = match *drive {
                InputDrive::Free { speed } => self.free_input(at, &input.name, input.start, speed),
                InputDrive::Object { ratio, offset, .. } => {
                    self.driven_input(at, &input.name, ratio, offset)
                }
            };
            let Some(node) = node else { return };
            inputs.push(node);
        }
        let Some(linkage) = self.assembled(at, spec, &inputs) else {
            return;
        };
        for (index, (input, (_, loads))) in spec.linkage.inputs.iter().zip(&spec.inputs).enumerate()
        {
            for load in loads {
                let path = at.path(&format!("inputs.{}.loads.{}", input.name, load.name));
                self.load_at(path, at.object, load, &[inputs[index]], inputs[index]);
            }
        }
        let mut ratios = vec![0.0; inputs.len()];
        ratios[0] = 1.0;
        let first = Constraint::Linear {
            ratios,
            offset: 0.0,
        };
        let node = self.constrained(at.object, &inputs, first);
        let mut outputs = Vec::new();
        let named = spec.linkage.linkage.outputs.iter().zip(&spec.loads);
        for (index, (output, loads)) in named.enumerate() {
            let Some(part) = self.part_of_output(at, &output.name) else {
                continue;
            };
            let own = Constraint::Custom(Arc::new(MultiOutput::new(&linkage, index)));
            let carrier = self.constrained(part, &inputs, own);
            // No input is before the others: tables of positions go over the output's own.
            for load in loads {
                let path = at.path(&format!("outputs.{}.loads.{}", output.name, load.name));
                self.load_at(path, at.object, load, &[carrier], carrier);
            }
            outputs.push(carrier);
        }
        let friction = match spec.joint_friction {
            true => {
                let made = Kinetostatics::of_inputs(linkage.spec());
                let rubbing = self.kinetostatics_with_friction(at, &spec.linkage.linkage, made);
                let open = rubbing.as_ref();
                let open = open.and_then(|own| own.friction_of_inputs_left_open(&linkage));
                self.faults(at, "", open.into_iter().collect());
                rubbing
            }
            false => None,
        };
        self.model.multi_linkages.push(MultiLinkageBody {
            node,
            inputs,
            linkage: Arc::new(linkage),
            outputs,
            friction: friction.map(Arc::new),
            object: at.object,
        });
    }

    /// The linkage, put together where its inputs are said to be or at t = 0, and found to
    /// reach the latter.
    fn assembled(
        &mut self,
        at: &Place,
        spec: &DrivenMultiLinkage,
        inputs: &[NodeIndex],
    ) -> Option<MultiLinkage> {
        let starts: Vec<f64> = inputs.iter().map(|&node| self.start_of(node)).collect();
        let mut own = spec.linkage.clone();
        for ((input, (drive, _)), &start) in own.inputs.iter_mut().zip(&spec.inputs).zip(&starts) {
            if let InputDrive::Object { start: given, .. } = drive {
                input.start = given.unwrap_or(start);
            }
        }
        let linkage = match MultiLinkage::new(own) {
            Ok(linkage) => linkage,
            Err(faults) => {
                self.faults(at, "", faults);
                return None;
            }
        };
        let still = vec![0.0; starts.len()];
        if linkage.workspace::<f64>().solve(&starts, &still).is_err() {
            let message = "it cannot be assembled where its inputs are at t = 0, on the side of \
                           its singular positions on which it is put together";
            let hint = "start what drives it elsewhere, or give other `start` values to the inputs";
            self.fault(at, "inputs", message, hint);
            return None;
        }
        for remark in linkage.remarks() {
            self.warn(format!("`{}`: {remark}", at.id));
        }
        Some(linkage)
    }

    /// An input that nothing drives: a coordinate without inertia of its own.
    fn free_input(&mut self, at: &Place, name: &str, start: f64, speed: f64) -> Option<NodeIndex> {
        let part = self.part_of_output(at, name)?;
        let node = Node {
            inertia: 0.0,
            motion: NodeMotion::Rotor {
                angle: start,
                speed,
            },
        };
        Some(self.add_node(part, node, start))
    }

    /// An input that hangs on another object at a constant ratio.
    fn driven_input(
        &mut self,
        at: &Place,
        name: &str,
        ratio: f64,
        offset: f64,
    ) -> Option<NodeIndex> {
        let driver = at.input(name)?.node;
        let position = match Position::new(&PositionSpec::Ratio { ratio, offset }) {
            Ok(position) => position,
            Err(faults) => {
                self.faults(at, &format!("inputs.{name}"), faults);
                return None;
            }
        };
        let law = Law {
            driver,
            position,
            lever: 1.0,
            track: None,
        };
        self.output(at, name, law)
    }

    /// Index of the part that an output of an object is.
    fn part_of_output(&self, at: &Place, name: &str) -> Option<usize> {
        self.indices.get(&format!("{}.{name}", at.id)).copied()
    }

    /// A node that follows several.
    fn constrained(
        &mut self,
        part: usize,
        drivers: &[NodeIndex],
        constraint: Constraint,
    ) -> NodeIndex {
        let start = self.combined(drivers, &constraint);
        let motion = NodeMotion::Constrained {
            drivers: drivers.to_vec(),
            constraint,
        };
        let node = Node {
            inertia: 0.0,
            motion,
        };
        self.add_node(part, node, start)
    }
}
