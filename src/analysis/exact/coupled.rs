//! Forces on what a drive prescribes and trees hang on.
//!
//! The force that such an object needs is that of all that is prescribed, A(t), and for
//! each tree a lever G(t), the slopes of the position functions on the way, times the
//! force F of the tree's first link. A and G follow from the drives and change slowly; F
//! is a sum of modes. In short stretches their greatest magnitudes bound the whole,
//! |A| + Σ|G|·|F|, which most often tells that nothing there can be greater than what
//! has been met. Where it could, the whole system is observed, as densely as the modes
//! ask for that matter.

use crate::breaks::Breaks;
use crate::constraint::{Constraint, ConstraintJet};
use crate::exact::Parts;
use crate::model::{Model, NodeIndex, NodeMotion};
use crate::position::Position;
use crate::record::Tally;
use crate::system::{ObjectState, System};

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

/// What ties a node to the one that it follows.
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
    let holds = |part: &crate::model::ObjectPart| part.nodes.contains(&node);
    model.objects.iter().position(holds)
}

/// The way from a tree to its drives, the tree's own law first.
#[derive(Clone, Debug, Default)]
pub(super) struct Way {
    steps: Vec<Step>,
    /// Nodes with several drivers, whose motion no object shows.
    sums: Vec<(NodeIndex, Constraint, Vec<NodeIndex>)>,
    /// The object of every node on the way.
    objects: Vec<(NodeIndex, usize)>,
}

impl Way {
    /// That of every tree. Objects are counted as in the whole model.
    pub(super) fn of_all(system: &System, parts: &Parts) -> Vec<Self> {
        let model = system.model();
        let way = |object: usize| {
            let mut way = Self::default();
            way.follow(model, model.objects[object].nodes[0], None);
            way
        };
        parts
            .trees
            .iter()
            .map(|part| way(part.objects[0]))
            .collect()
    }

    /// Adds what a node follows, up to the drives.
    fn follow(&mut self, model: &Model, node: NodeIndex, above: Option<usize>) {
        match &model.nodes[node].motion {
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let lever = Lever::Law {
                    position: law.position.clone(),
                    lever: law.lever,
                    breaks: law.position.breaks(),
                };
                self.step(model, law.driver, above, lever);
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
                    self.step(model, driver, above, lever);
                }
            }
            NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
        }
    }

    fn step(&mut self, model: &Model, node: NodeIndex, above: Option<usize>, lever: Lever) {
        let object = holder(model, node);
        self.objects.extend(object.map(|object| (node, object)));
        self.steps.push(Step {
            above,
            object,
            node,
            lever,
        });
        self.follow(model, node, Some(self.steps.len() - 1));
    }

    /// Calls `see` with every object on the way and a bound of the slope between it and
    /// the tree; where several ways lead to an object the magnitudes are added up.
    pub(super) fn slopes(&self, states: &[ObjectState], mut see: impl FnMut(usize, f64)) {
        let mut slopes: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let above = step.above.map_or(1.0, |above| slopes[above]);
            slopes.push(above * self.slope(step, states));
        }
        for (index, step) in self.steps.iter().enumerate() {
            let Some(object) = step.object else { continue };
            let same = |other: &&Step| other.object == Some(object);
            if self.steps[..index].iter().any(|other| same(&other)) {
                continue;
            }
            let all = self.steps.iter().zip(&slopes);
            see(
                object,
                all.filter(|(step, _)| same(step))
                    .map(|(_, slope)| slope)
                    .sum(),
            );
        }
    }

    /// |∂φ_above/∂φ| where the node of a step stands.
    fn slope(&self, step: &Step, states: &[ObjectState]) -> f64 {
        match &step.lever {
            Lever::Law {
                position,
                lever,
                breaks,
            } => {
                let [displacement, speed] = self.motion(step.node, states);
                let jet = position.jet(breaks.locate(displacement, speed), displacement);
                (lever * jet.first).abs()
            }
            Lever::Input {
                constraint,
                drivers,
                number,
            } => self.jet(constraint, drivers, states).0.first[*number].abs(),
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
        let speed = jet
            .first
            .iter()
            .zip(speeds)
            .map(|(slope, speed)| slope * speed);
        [jet.value, speed.sum()]
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

    fn passes(&self, object: usize) -> bool {
        self.steps.iter().any(|step| step.object == Some(object))
    }
}

/// An object that trees hang on: bounds over the present stretch, and what was met.
#[derive(Clone, Debug)]
pub(super) struct Coupled {
    /// Index in the whole model.
    pub(super) object: usize,
    /// Its forces.
    pub(super) tally: Tally,
    /// Range of |A| at the instants looked at.
    own: Range,
    /// For each tree the range of |G|.
    levers: Vec<Range>,
}

/// Least and greatest of what was seen of a smooth magnitude.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    most: f64,
}

impl Range {
    const NONE: Self = Self {
        least: f64::INFINITY,
        most: 0.0,
    };

    fn see(&mut self, value: f64) {
        self.least = self.least.min(value);
        self.most = self.most.max(value);
    }

    /// A parabola through three places rises by no more than their range beyond them;
    /// twice that is allowed for.
    fn bound(&self) -> f64 {
        self.most + 2.0 * (self.most - self.least).max(0.0)
    }
}

impl Coupled {
    /// Every object that some tree hangs on.
    pub(super) fn all(system: &System, ways: &[Way], window: Option<[f64; 2]>) -> Vec<Self> {
        let objects = 0..system.model().objects.len();
        let carries = |object: &usize| ways.iter().any(|way| way.passes(*object));
        let coupled = |object| Self {
            object,
            tally: Tally::new(system, object, window),
            own: Range::NONE,
            levers: vec![Range::NONE; ways.len()],
        };
        objects.filter(carries).map(coupled).collect()
    }

    /// Forgets the stretch before.
    pub(super) fn clear(&mut self) {
        self.own = Range::NONE;
        self.levers.fill(Range::NONE);
    }

    /// Takes an instant into the bounds, without the trees.
    pub(super) fn see(&mut self, state: &ObjectState) {
        self.own.see(state.reaction.abs());
    }

    /// Takes the slope between it and a tree into the bounds.
    pub(super) fn see_lever(&mut self, tree: usize, slope: f64) {
        self.levers[tree].see(slope);
    }

    /// True when with the greatest forces of the trees it may meet what it has not met
    /// before.
    pub(super) fn may_rise(&self, forces: &[f64]) -> bool {
        let levers = self.levers.iter().zip(forces);
        let coupled: f64 = levers
            .filter(|(_, force)| **force > 0.0)
            .map(|(lever, force)| lever.bound() * force)
            .sum();
        let (reaction, slack) = self.tally.forces();
        let most = self.own.bound() + coupled;
        !(most <= reaction * (1.0 + 1e-13) && most <= slack)
    }
}
