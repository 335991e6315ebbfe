//! The way from a tree to its drives: slopes of position functions.

use crate::dynamics::model::{Model, NodeIndex, NodeMotion};
use crate::dynamics::system::{ObjectState, System};
use crate::exact::Parts;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::{Constraint, ConstraintJet};
use crate::kinematics::position::Position;

/// A step of the way from a tree to its drives: from what follows to what it follows.
#[derive(Clone, Debug)]
struct Step {
    /// The step above it, whose node follows this one; `None`: the tree itself.
    above: Option<usize>,
    /// The object whose node it leads to; `None`: the sum of several inputs.
    object: Option<usize>,
    node: NodeIndex,
    lever: Lever,
}

/// Lever that ties a node to the one that it follows.
#[derive(Clone, Debug)]
enum Lever {
    /// A position function.
    Law {
        position: Position,
        lever: f64,
        breaks: Breaks,
    },
    /// A constraint, seen from one of its drivers.
    Input {
        constraint: Constraint,
        drivers: Vec<NodeIndex>,
        number: usize,
    },
}

fn holder(model: &Model, node: NodeIndex) -> Option<usize> {
    let mut objects = model.objects.iter();
    objects.position(|part| part.nodes.contains(&node))
}

/// The way from a tree to its drives, the tree's own law first.
#[derive(Clone, Debug, Default)]
pub(super) struct Drivetrain {
    steps: Vec<Step>,
    /// Nodes with several drivers, whose motion no object shows.
    sums: Vec<(NodeIndex, Constraint, Vec<NodeIndex>)>,
    /// The object of every node on the way.
    objects: Vec<(NodeIndex, usize)>,
}

impl Drivetrain {
    /// Ways of all trees. Objects are counted as in the whole model.
    pub(super) fn of_all(system: &System, parts: &Parts) -> Vec<Self> {
        let model = system.model();
        let way = |object: usize| {
            let mut way = Self::default();
            way.add_drivers(model, model.objects[object].nodes[0], None);
            way
        };
        let trees = parts.trees.iter();
        trees.map(|part| way(part.objects[0])).collect()
    }

    /// Adds what a node follows, up to the drives.
    fn add_drivers(&mut self, model: &Model, node: NodeIndex, above: Option<usize>) {
        match &model.nodes[node].motion {
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let lever = Lever::Law {
                    position: law.position.clone(),
                    lever: law.lever,
                    breaks: law.position.breaks(),
                };
                self.add_step(model, law.driver, above, lever);
            }
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => {
                self.sums.push((node, constraint.clone(), drivers.clone()));
                for (number, &driver) in drivers.iter().enumerate() {
                    let lever = Lever::Input {
                        constraint: constraint.clone(),
                        drivers: drivers.clone(),
                        number,
                    };
                    self.add_step(model, driver, above, lever);
                }
            }
            NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
        }
    }

    fn add_step(&mut self, model: &Model, node: NodeIndex, above: Option<usize>, lever: Lever) {
        let object = holder(model, node);
        self.objects.extend(object.map(|object| (node, object)));
        self.steps.push(Step {
            above,
            object,
            node,
            lever,
        });
        self.add_drivers(model, node, Some(self.steps.len() - 1));
    }

    /// Slopes between the tree and where each step of the way leads, into `slopes`.
    pub(super) fn take_slopes(&self, states: &[ObjectState], slopes: &mut Vec<f64>) {
        slopes.clear();
        for step in &self.steps {
            // (The step above comes before it.)
            let above = step.above.map_or(1.0, |above| slopes[above]);
            slopes.push(self.ratio_of_step(step, states) * above);
        }
    }

    /// Slope between an object and the tree, over all ways that lead to it, by the slopes
    /// of [`Self::take_slopes`]; 0 where it is on none.
    pub(super) fn slope(&self, object: usize, slopes: &[f64]) -> f64 {
        let steps = self.steps.iter().zip(slopes);
        let own = steps.filter(|(step, _)| step.object == Some(object));
        own.map(|(_, slope)| slope).sum()
    }

    /// ∂φ_above/∂φ where the node of a step stands.
    fn ratio_of_step(&self, step: &Step, states: &[ObjectState]) -> f64 {
        match &step.lever {
            Lever::Law {
                position,
                lever,
                breaks,
            } => {
                let [displacement, speed] = self.motion(step.node, states);
                let jet = position.jet(breaks.segment_at(displacement, speed), displacement);
                lever * jet.first
            }
            Lever::Input {
                constraint,
                drivers,
                number,
            } => self.jet(constraint, drivers, states).0.first[*number],
        }
    }

    /// Displacement and speed of a node on the way.
    fn motion(&self, node: NodeIndex, states: &[ObjectState]) -> [f64; 2] {
        if let Some((_, object)) = self.objects.iter().find(|(own, _)| *own == node) {
            return [states[*object].displacement, states[*object].speed];
        }
        let Some((_, constraint, drivers)) = self.sums.iter().find(|sum| sum.0 == node) else {
            return [0.0; 2];
        };
        let (jet, speeds) = self.jet(constraint, drivers, states);
        let speed = jet.first.iter().zip(speeds);
        [jet.value, speed.map(|(slope, speed)| slope * speed).sum()]
    }

    fn jet(
        &self,
        constraint: &Constraint,
        drivers: &[NodeIndex],
        states: &[ObjectState],
    ) -> (ConstraintJet, Vec<f64>) {
        let motions = drivers.iter().map(|&driver| self.motion(driver, states));
        let (places, speeds): (Vec<f64>, Vec<f64>) = motions.map(|[at, speed]| (at, speed)).unzip();
        let mut jet = ConstraintJet::new(drivers.len());
        constraint.jet(&places, &mut jet);
        (jet, speeds)
    }

    /// True when the tree hangs on an object.
    pub(super) fn depends_on(&self, object: usize) -> bool {
        self.steps.iter().any(|step| step.object == Some(object))
    }
}
