//! Joint friction of linkages in the equations of motion.
//!
//! All that follows a free coordinate (or a prescribed drive) rigidly is one
//! *group* with one acceleration. The friction T of a linkage of the group depends
//! on that acceleration, which depends on T in turn: `passes` solves that after all
//! forces are known and before the accelerations follow from them.
//!
//! Directions are modes. Of every free group: in which direction its root moves, or
//! that friction holds it at rest. Of a linkage whose input does not keep a constant
//! ratio to the root, or whose motion is given: its own direction. And for every
//! linkage a track of the places at which pairs change theirs. `standstill` decides
//! what happens where a group stops, and when it breaks loose again. `sides` where
//! corners of blocks begin to press on the other side, and where the reaction of a pin
//! passes close by zero, so that friction is smooth in between. `unsolved` where there
//! is no motion, or more than one.
//!
//! All that follows a free coordinate rigidly has the acceleration q̈ = a₀ + s·T. The friction
//! T also depends on the forces and inertias on the outputs. The free-body equations are solved
//! with T as the unknown of the driver, so that they hold for any s, down to a prescribed
//! motion, s = 0. Several linkages of one group are iterated until they agree. Derivatives
//! follow from the same factorised matrix; those by position and speed from differences.
//!
//! A resting group is observed within every step (a `Probe`, located by bisection) until a
//! start is possible. The friction of a start exceeds that of sliding by 1e-10, so that nothing
//! chatters.
//!
//! Limits: if no acceleration agrees with its friction (`self_locking`), or several do
//! (`several_solutions`), the run stops with that reason. Linkages that move as one are
//! searched for other accelerations each by itself and all together.

mod force;
mod hold;
mod multi_input;
mod passes;
mod sides;
mod standstill;
mod stick_slip;
mod stops;
mod unsolved;

pub(super) use multi_input::{Several, SeveralWork};
pub(crate) use stick_slip::StickSlip;

use super::dry_friction;
use super::frozen::{Frozen, FrozenTrack};
use crate::dynamics::integrate::{EventFunction, Guard};
use crate::dynamics::model::LinkageBody;
use crate::kinematics::linkage::Workspace;
use crate::kinematics::linkage::kinetostatics::{
    ForceFailure, ForceWorkspace, Kinetostatics, Reversals,
};
use crate::math::quantity::Quantity;
use std::sync::Arc;

/// A group: all that follows a root rigidly, as far as joints with friction are in it.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// The root, an internal node.
    pub(super) root: usize,
    /// Index of the root's coordinate; `None`: its motion is prescribed.
    pub(super) coordinate: Option<usize>,
    /// The chain that it is a mass of, with the mass's number.
    pub(super) mass: Option<(usize, usize)>,
    /// Component of the modes: the direction of a free root.
    pub(super) component: Option<usize>,
    /// Signal that is the root's displacement.
    pub(super) signal: usize,
    /// The linkages, drivers before driven.
    pub(super) members: Vec<Member>,
}

/// A linkage of a group.
#[derive(Clone, Debug)]
pub(super) struct Member {
    /// Index into [`Frozen::linkages`]; also its place among the memories.
    pub(super) linkage: usize,
    /// Internal index of the input node.
    pub(super) node: usize,
    /// Laws from the root to its input.
    pub(super) path: Vec<usize>,
    /// Source of the input's direction.
    pub(super) direction: Direction,
    /// Component of the modes that selects the piece of its course, if it has pieces.
    pub(super) segment: Option<usize>,
    /// Component of the modes that says on which sides its pairs press; `None` where
    /// its motion is given.
    pub(super) sides: Option<usize>,
    pub(super) reversals: Arc<Reversals>,
    pub(super) kinetostatics: Arc<Kinetostatics>,
    /// The nodes of its outputs.
    pub(super) outputs: Vec<usize>,
    /// Index of the object in the model.
    pub(super) object: usize,
}

/// Source of the direction of a linkage's input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Direction {
    /// The root's, times a sign.
    OfRoot(f64),
    /// A component of the modes, which follows the sign of a signal's rate.
    Own {
        /// The component.
        component: usize,
        /// Signal that is the input's displacement.
        signal: usize,
    },
}

/// Why a linkage has no friction force, or not just one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Obstacle {
    /// No solution.
    Failed(ForceFailure),
    /// Several.
    Several,
    /// One, which is not proved to be the only one.
    Unproved,
}

/// Memory of one linkage's friction.
#[derive(Clone, Debug)]
pub(super) struct FrictionMemory<N> {
    pub(super) forces: Option<ForceWorkspace>,
    /// For positions beside the present one.
    pub(super) beside: Option<Workspace>,
    pub(super) loads: Vec<f64>,
    pub(super) inertias: Vec<f64>,
    pub(super) by_loads: Vec<f64>,
    /// T: the force of friction on the input.
    pub(super) force: N,
    /// Why there is none.
    pub(super) failure: Option<Obstacle>,
}

impl Frozen {
    /// Memory for the friction of all linkages.
    pub(super) fn friction_memory<N: Quantity>(&self) -> Vec<FrictionMemory<N>> {
        let empty = |_| FrictionMemory {
            forces: None,
            beside: None,
            loads: Vec::new(),
            inertias: Vec::new(),
            by_loads: Vec::new(),
            force: N::from(0.0),
            failure: None,
        };
        let mut memory: Vec<FrictionMemory<N>> = match self.groups.is_empty() {
            true => Vec::new(),
            false => (0..self.linkages.len()).map(empty).collect(),
        };
        for member in self.groups.iter().flat_map(|group| &group.members) {
            let own = &mut memory[member.linkage];
            let outputs = member.outputs.len();
            own.forces = Some(member.kinetostatics.workspace());
            own.beside = Some(self.linkages[member.linkage].linkage.workspace());
            own.loads = vec![0.0; outputs];
            own.inertias = vec![0.0; outputs];
            own.by_loads = vec![0.0; outputs];
        }
        memory
    }

    /// Puts the friction of a linkage into the layout. Components are numbered
    /// afterwards.
    pub(super) fn place_friction(&mut self, linkage: usize, body: &LinkageBody) {
        let friction = body.friction.as_ref().filter(|k| k.has_friction());
        let Some(kinetostatics) = friction else {
            return;
        };
        let node = self.internal[body.node];
        let (root, path) = self.path_to(node);
        let ratio = self.constant_ratio(&path);
        let coordinate = self.coordinate[root];
        let reversals = Arc::new(Reversals::of(&body.linkage, kinetostatics));
        let own = self.signal(node);
        let segment = (!reversals.breaks.is_empty()).then(|| {
            self.tracks.push(FrozenTrack {
                node: Some(node),
                signal: Some(own),
                breaks: reversals.breaks.clone(),
                repeats: false,
                stops: false,
                object: body.object,
            });
            self.track_component(self.tracks.len() - 1)
        });
        let member = Member {
            linkage,
            node,
            path,
            direction: match ratio {
                Some(ratio) if coordinate.is_some() => Direction::OfRoot(ratio.signum()),
                _ => Direction::Own {
                    component: usize::MAX,
                    signal: own,
                },
            },
            segment,
            sides: None,
            reversals,
            kinetostatics: Arc::clone(kinetostatics),
            outputs: body.outputs.iter().map(|&o| self.internal[o]).collect(),
            object: body.object,
        };
        if let Some(group) = self.groups.iter_mut().find(|group| group.root == root) {
            group.members.push(member);
            return;
        }
        let signal = self.signal(root);
        let chains = self.chains.iter().enumerate();
        let mass = chains
            .filter(|(_, chain)| chain.nodes().contains(&root))
            .map(|(index, chain)| (index, root - chain.first_node))
            .next();
        self.groups.push(Group {
            root,
            coordinate,
            mass,
            component: None,
            signal,
            members: vec![member],
        });
    }

    /// Numbers the components of the directions, after those of all tracks.
    pub(super) fn number_directions(&mut self) {
        let first = self.contacts() + self.tracks.len();
        let mut next = first;
        let mut number = || {
            next += 1;
            next - 1
        };
        for group in &mut self.groups {
            group.component = group.coordinate.map(|_| number());
            for member in &mut group.members {
                member.sides = group.component.map(|_| number());
                if let Direction::Own { component, .. } = &mut member.direction {
                    *component = number();
                }
            }
        }
        self.number_pairs(next);
        let pairs = self.several.as_ref().map_or(0, Several::components);
        let next = dry_friction::number(self, next + pairs);
        self.directions = next - first;
    }

    /// Root that a node follows rigidly, and the laws on the way to it.
    fn path_to(&self, node: usize) -> (usize, Vec<usize>) {
        let (mut root, mut path) = (node, Vec::new());
        while let Some(rigid) = self.rigids.iter().find(|rigid| rigid.node == root) {
            path.push(rigid.law);
            root = self.laws[rigid.law].driver;
        }
        path.reverse();
        (root, path)
    }

    /// The ratio of speeds along laws, where it is constant and not zero.
    fn constant_ratio(&self, path: &[usize]) -> Option<f64> {
        let mut ratio = 1.0;
        for &law in path {
            let law = &self.laws[law];
            law.position.constant_ratio()?;
            ratio *= law.position.jet(0, 0.0).first * law.lever;
        }
        (ratio != 0.0).then_some(ratio)
    }

    /// The switches of directions to look for.
    pub(super) fn watch_directions(&self, modes: &[i64], out: &mut Vec<EventFunction>) {
        let mut turning = |signal: usize, component: usize, target: i64| {
            let guard = Guard {
                signal,
                offset: 0.0,
                displacement: 0.0,
                speed: modes[component] as f64,
            };
            out.push(EventFunction {
                guards: [guard, guard],
                rising: false,
                component,
                target,
            });
        };
        for group in &self.groups {
            let held = match group.component {
                Some(component) => {
                    let state = StickSlip::of(modes[component]);
                    if state.slides() {
                        turning(group.signal, component, StickSlip::Stuck.mode());
                    }
                    state == StickSlip::Stuck
                }
                None => false,
            };
            for member in group.members.iter().filter(|_| !held) {
                if let Direction::Own { component, signal } = member.direction
                    && StickSlip::of(modes[component]).slides()
                {
                    turning(signal, component, -modes[component]);
                }
            }
        }
        self.watch_pairs(modes, out);
        dry_friction::watch(self, modes, out);
    }
}
