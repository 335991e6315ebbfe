//! Forces on what a drive prescribes and trees hang on.
//!
//! The force that such an object needs is that of all that is prescribed, A(t), and for
//! each tree a lever G(t), the slopes of the position functions on the way, times the
//! force F of the tree's first link. A and G follow from the drives and change slowly; F
//! is a sum of modes. In short stretches their greatest magnitudes bound the whole,
//! |A| + Σ|G|·|F|, which most often tells that nothing there can be greater than what
//! has been met. Where it could, the whole system is observed, as densely as the modes
//! ask for that matter.

use crate::exact::Parts;
use crate::model::{Law, Model, NodeIndex, NodeMotion};
use crate::breaks::Breaks;
use crate::position::Position;
use crate::record::Tally;
use crate::system::{ObjectState, System};

/// The law of an object over the motion of another one.
#[derive(Clone, Debug)]
struct Lever {
    /// Index of the driving object.
    driver: usize,
    position: Position,
    lever: f64,
    breaks: Breaks,
}

impl Lever {
    fn new(model: &Model, law: &Law) -> Option<Self> {
        Some(Self {
            driver: holder(model, law.driver)?,
            position: law.position.clone(),
            lever: law.lever,
            breaks: law.position.breaks(),
        })
    }

    /// |U′| where the driver stands.
    fn slope(&self, states: &[ObjectState]) -> f64 {
        let driver = &states[self.driver];
        let segment = self.breaks.locate(driver.displacement, driver.speed);
        let jet = self.position.jet(segment, driver.displacement);
        (self.lever * jet.first).abs()
    }
}

fn holder(model: &Model, node: NodeIndex) -> Option<usize> {
    let holds = |part: &crate::model::ObjectPart| part.nodes.contains(&node);
    model.objects.iter().position(holds)
}

/// The way from a tree to its drive, the tree's own law first.
#[derive(Clone, Debug)]
pub(super) struct Way(Vec<Lever>);

impl Way {
    /// That of every tree. Objects are counted as in the whole model.
    pub(super) fn of_all(system: &System, parts: &Parts) -> Vec<Self> {
        let model = system.model();
        let way = |object: usize| {
            let mut way = Vec::new();
            let mut object = Some(object);
            while let Some(lever) = object.and_then(|object| {
                let node = model.objects[object].nodes[0];
                match &model.nodes[node].motion {
                    NodeMotion::Mass { law } | NodeMotion::Rigid { law } => Lever::new(model, law),
                    NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => None,
                }
            }) {
                object = Some(lever.driver);
                way.push(lever);
            }
            Self(way)
        };
        parts.trees.iter().map(|part| way(part.objects[0])).collect()
    }

    /// Calls `see` with every object on the way and the slope between it and the tree.
    pub(super) fn slopes(&self, states: &[ObjectState], mut see: impl FnMut(usize, f64)) {
        let mut slope = 1.0;
        for lever in &self.0 {
            slope *= lever.slope(states);
            see(lever.driver, slope);
        }
    }

    fn passes(&self, object: usize) -> bool {
        self.0.iter().any(|lever| lever.driver == object)
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
