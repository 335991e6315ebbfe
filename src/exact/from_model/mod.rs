//! From a model to the trees that can be propagated exactly.
//!
//! Every chain of masses behind a motion that its drive prescribes, with all
//! that hangs on it through constant ratios, is one tree. In the deviation q
//! from where the rigid mechanism would be, an elastic object behind an elastic
//! one with the ratio r has u = q − r·q_driver; a rigid object behind an
//! elastic one adds r²J, r·W, r²c and r²b to the mass that carries it.
//!
//! What is not linear in q between switches, or not known beforehand as a
//! function of time, is refused with the object and the reason.

mod builder;
mod cycle;
mod fit;
mod hidden;
mod law;
mod load;
mod prescribed;
mod rest;
mod rhythm;
#[cfg(test)]
mod tests;

pub(crate) use fit::{fit_course, formulas_end};
pub(crate) use hidden::Target;
pub(crate) use prescribed::{PrescribedMotion, place_inside};
pub use rest::Rest;
pub(crate) use rhythm::Rhythm;

use super::{ExactTree, Law, Modes, PairState, Refusal, SpanSource, TreeProblem};
use crate::dynamics::model::{Model, NodeMotion};
use crate::dynamics::system::System;
use std::sync::Arc;

/// The parts of a system that can be propagated exactly, and why others cannot.
#[derive(Debug)]
pub struct Parts {
    /// Trees of masses, one part each.
    pub trees: Vec<Part>,
    /// Objects that stand against it, with the reason.
    pub refusals: Vec<Refusal>,
    /// The prescribed motions, by node of the model.
    pub(crate) courses: Vec<Option<PrescribedMotion>>,
    /// Prescribed motions of rigid objects that are made of spans.
    pub(crate) spans: Vec<Arc<dyn SpanSource>>,
    /// Holder of each object of the model.
    holders: Vec<Holder>,
}

/// Who moves an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Holder {
    /// Its motion is prescribed.
    Drive,
    /// A tree, by its number.
    Tree(usize),
    /// Nothing that is known here.
    Other,
}

/// A tree of masses behind one prescribed law.
#[derive(Debug)]
pub struct Part {
    /// The tree; displacements and speeds at t = 0 still zero.
    problem: TreeProblem,
    /// For each mass its coordinate of the system, and the mass and ratio that
    /// its deviation u is measured from.
    pub(crate) masses: Vec<MassPlace>,
    /// For each of the tree's objects its index in the model.
    pub objects: Vec<usize>,
    /// For each mass whose link holds a pair that can open its component of
    /// the modes.
    pub(crate) pairs: Vec<(usize, usize)>,
    /// Modes of combinations of engaged pairs, once they have been tried.
    modes: Arc<Modes>,
}

/// Place of a mass in the system's state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MassPlace {
    /// Coordinate u of the mass.
    pub(crate) coordinate: usize,
    /// u = q − ratio·q of another mass.
    pub(crate) base: Option<(usize, f64)>,
}

/// The laws of the trees of a system, for systems that differ from it in inertias,
/// stiffnesses, dampings and loads alone: a law in spans is fitted once.
#[derive(Debug, Default)]
pub struct KeptLaws(Vec<(usize, Law)>);

impl KeptLaws {
    /// The law of the tree that begins with an object, made where it is not known.
    fn law(&mut self, object: usize, make: impl FnOnce() -> Law) -> Law {
        if let Some((_, law)) = self.0.iter().find(|(of, _)| *of == object) {
            return law.clone();
        }
        let law = make();
        self.0.push((object, law.clone()));
        law
    }
}

impl Parts {
    /// Takes a system apart.
    pub fn of(system: &System) -> Self {
        builder::build(system, &mut KeptLaws::default())
    }

    /// The parts of a system, with the laws of a system before that moves by the same
    /// ones.
    pub fn with_laws(system: &System, laws: &mut KeptLaws) -> Self {
        builder::build(system, laws)
    }

    /// Gives up trees whose modes cannot be separated, with the reason: what is
    /// left can be run.
    #[must_use]
    pub fn with_sound_trees(mut self, system: &System) -> Self {
        let still = vec![0.0; 2 * crate::dynamics::integrate::Dynamics::coordinates(system)];
        let mut sound = Vec::new();
        for (number, mut part) in std::mem::take(&mut self.trees).into_iter().enumerate() {
            let now = match part.try_modes(&still) {
                Ok(()) => Holder::Tree(sound.len()),
                Err(refusal) => {
                    let id = &system.model().objects[part.objects[0]].id;
                    self.refusals.push(Refusal::new(id, refusal.reason));
                    Holder::Other
                }
            };
            let own = self.holders.iter_mut();
            // Numbers only fall: a tree that has been seen is not met again.
            own.filter(|holder| **holder == Holder::Tree(number))
                .for_each(|holder| *holder = now);
            if now != Holder::Other {
                sound.push(part);
            }
        }
        self.trees = sound;
        self
    }

    /// The tree, by its number, that moves an object of the model.
    pub(crate) fn tree_of(&self, object: usize) -> Option<usize> {
        match self.holders[object] {
            Holder::Tree(number) => Some(number),
            Holder::Drive | Holder::Other => None,
        }
    }

    /// Time (s) after which all prescribed motions, those that the trees follow among
    /// them, have gone through all that they ever go through, where that is known: they
    /// repeat themselves from the start on, at most so slowly.
    pub(crate) fn period(&self, system: &System) -> Option<f64> {
        let mut longest = 0.0f64;
        for node in &system.model().nodes {
            let law = match &node.motion {
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => law,
                NodeMotion::Constrained { .. } => return None,
                NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => continue,
            };
            if let Some(course) = &self.courses[law.driver] {
                let course = course.through_position(&law.position, law.lever);
                longest = longest.max(course.period()?);
            }
        }
        Some(longest)
    }

    /// The prescribed motion that a chain follows, led through its own position function.
    pub(crate) fn motion_behind(&self, system: &System, object: usize) -> Option<PrescribedMotion> {
        let model = system.model();
        let NodeMotion::Mass { law } = &model.nodes[model.objects[object].nodes[0]].motion else {
            return None;
        };
        let before = self.courses[law.driver].as_ref()?;
        Some(before.through_position(&law.position, law.lever))
    }

    /// True when nothing that no tree holds looks at what a tree moves.
    pub fn are_independent(&self, system: &System) -> bool {
        rest::objects_outside_trees(system.model(), self).is_some()
    }

    /// The first object that no tree holds under a load by an expression.
    pub fn expression_outside(&self, model: &Model) -> Option<usize> {
        rest::expression_outside_trees(model, self)
    }

    /// True when every coordinate of the system is in a tree, and there is one.
    pub fn is_whole(&self) -> bool {
        self.refusals.is_empty() && !self.trees.is_empty()
    }
}

impl Part {
    /// The tree with the state y = [u, u̇] of the system at t = 0.
    pub fn tree(&self, y: &[f64]) -> ExactTree {
        let mut problem = self.problem.clone();
        let n = y.len() / 2;
        // Drivers stand before what they drive.
        for (mass, place) in self.masses.iter().enumerate() {
            let (mut q, mut v) = (y[place.coordinate], y[n + place.coordinate]);
            if let Some((base, ratio)) = place.base {
                q += ratio * problem.displacement[base];
                v += ratio * problem.speed[base];
            }
            problem.displacement[mass] = q;
            problem.speed[mass] = v;
        }
        ExactTree::new(problem).with_modes(&self.modes)
    }

    /// Tries the modes of the combinations of engaged pairs that a run may meet, and
    /// keeps them for the trees to come.
    ///
    /// # Errors
    /// The modes of a combination cannot be separated.
    pub(crate) fn try_modes(&mut self, still: &[f64]) -> Result<(), Refusal> {
        self.modes = Arc::new(self.tree(still).try_modes()?);
        Ok(())
    }

    /// The state of the tree, q and q̇ of every mass, that belongs to a state y =
    /// [u, u̇] of the system.
    pub fn own_state(&self, y: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let tree = self.tree(y);
        let problem = tree.problem();
        (problem.displacement.clone(), problem.speed.clone())
    }

    /// The coordinate of the system of every mass.
    pub fn coordinates(&self) -> impl Iterator<Item = usize> + '_ {
        self.masses.iter().map(|place| place.coordinate)
    }

    /// The tree with given q and q̇ at t = 0.
    pub fn tree_at(&self, displacement: &[f64], speed: &[f64]) -> ExactTree {
        let mut problem = self.problem.clone();
        problem.displacement.copy_from_slice(displacement);
        problem.speed.copy_from_slice(speed);
        ExactTree::new(problem)
    }

    /// Writes q and q̇ of the tree into a state y = [u, u̇] of the system.
    pub fn put_state(&self, displacement: &[f64], speed: &[f64], y: &mut [f64]) {
        let n = y.len() / 2;
        for (mass, place) in self.masses.iter().enumerate() {
            let (mut u, mut v) = (displacement[mass], speed[mass]);
            if let Some((base, ratio)) = place.base {
                u -= ratio * displacement[base];
                v -= ratio * speed[base];
            }
            (y[place.coordinate], y[n + place.coordinate]) = (u, v);
        }
    }

    /// The tree's description; displacements and speeds are zero.
    pub fn problem(&self) -> &TreeProblem {
        &self.problem
    }

    /// Mode of a pair in the system (0 open, −1 on the lower flank, +1 on the
    /// upper) for its state in the tree.
    pub(crate) fn mode(&self, mass: usize, state: PairState) -> i64 {
        match state {
            PairState::Engaged(flank) => {
                let (flanks, _) = self.problem.masses[mass].pair.flanks();
                if flanks[usize::from(flank)].sign > 0.0 {
                    -1
                } else {
                    1
                }
            }
            PairState::Free | PairState::Pressed(_) => 0,
        }
    }
}
