//! The model laid out for the right-hand side.
//!
//! Nodes get an internal order in which drivers come before driven and the
//! masses of a chain stand side by side; free coordinates follow the same
//! order, so that a chain is one contiguous range of nodes, of coordinates and
//! of links.

use super::constraints::ConstrainedNode;
use super::dry_friction::DryContact;
use super::friction::{Group, Several};
use super::linkages::{FrozenLinkage, OutputPlace};
use super::loads::FrozenLoad;
use super::multi::{Direct, FrozenMulti, Root};
use super::pairs::Contact;
use super::stops::FrozenStop;
use super::trains::Train;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use crate::math::jet::Jet;

/// Numbers and order of evaluation of a model. n: coordinates, k: nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Frozen {
    /// Number n of free coordinates.
    pub(super) coordinates: usize,
    /// Internal index of each of the model's nodes (k).
    pub(super) internal: Vec<usize>,
    /// Free coordinate of each internal node (k).
    pub(super) coordinate: Vec<Option<usize>>,
    /// Steps of the forward pass, drivers before driven.
    pub(super) steps: Vec<Step>,
    /// Nodes that follow prescribed drives by laws alone.
    pub(super) rigid_given: Vec<usize>,
    /// Chains that are systems of their own behind a prescribed drive.
    pub(super) branches: Vec<Branch>,
    /// The steps that the right-hand side needs besides the branches.
    pub(super) coupled: Vec<Step>,
    /// All of `coupled`, if it consists of rigid trains.
    pub(super) trains: Vec<Train>,
    /// Laws, one for each chain and each rigid node.
    pub(super) laws: Vec<FrozenLaw>,
    /// Chains.
    pub(super) chains: Vec<Chain>,
    /// Rigid nodes, drivers before driven.
    pub(super) rigids: Vec<Rigid>,
    /// Rigid nodes that the right-hand side needs.
    pub(super) needed_rigids: Vec<Rigid>,
    /// Nodes with several drivers, drivers before driven.
    pub(super) constraints: Vec<ConstrainedNode>,
    /// Constraints that inertia is on, indices into `constraints`.
    pub(super) heavy: Vec<usize>,
    /// Linkages of one input, drivers before driven.
    pub(super) linkages: Vec<FrozenLinkage>,
    /// Linkages of several inputs, drivers before driven.
    pub(super) multi: Vec<FrozenMulti>,
    /// The free coordinates that their inertia forces act on, and all rotors beside them.
    pub(super) roots: Vec<Root>,
    /// Such a linkage and its rotors, if the system consists of nothing else.
    pub(super) direct: Option<Direct>,
    /// How far motions are looked at to find their greatest values (s).
    pub(super) horizon: f64,
    /// Constant inertia of each node (k, kg·m² or kg).
    pub(super) inertia: Vec<f64>,
    /// Sum of the constant loads on each node (k, N·m or N).
    pub(super) constant_force: Vec<f64>,
    /// All other loads.
    pub(super) loads: Vec<FrozenLoad>,
    /// c of the link below each mass (n; 0 for rotors).
    pub(super) stiffness: Vec<f64>,
    /// b of the link below each mass (n; 0 for rotors).
    pub(super) damping: Vec<f64>,
    /// 1/J of each free node (n).
    pub(super) inverse_inertia: Vec<f64>,
    /// Chain of each pair that can open: the first components of the modes.
    pub(super) pairs: Vec<usize>,
    /// The stops: the components of the modes after the pairs.
    pub(super) stops: Vec<FrozenStop>,
    /// The tracks: the components of the modes after pairs and stops.
    pub(super) tracks: Vec<FrozenTrack>,
    /// Groups of what moves together where joints have friction.
    pub(super) groups: Vec<Group>,
    /// A linkage of several inputs whose joints have friction.
    pub(super) several: Option<Several>,
    /// Dry friction that sticks.
    pub(super) dry: Vec<DryContact>,
    /// Number of directions: the components of the modes after the tracks.
    pub(super) directions: usize,
    /// Number of guards of loads by expressions: the components after the directions.
    pub(super) guards: usize,
    /// Internal nodes whose displacement is a signal beyond the coordinates.
    pub(super) extra: Vec<usize>,
    /// True where contacts are rigid.
    pub(super) impacts: bool,
}

/// One step of the forward pass.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// A node with given motion.
    Prescribed(PrescribedNode),
    /// A motor's rotor.
    Rotor(Rotor),
    /// A rigid object, index into [`Frozen::rigids`].
    Rigid(usize),
    /// A chain, index into [`Frozen::chains`].
    Chain(usize),
    /// A node with several drivers, index into [`Frozen::constraints`].
    Constrained(usize),
}

/// A node with given motion.
#[derive(Clone, Debug)]
pub(super) struct PrescribedNode {
    /// Internal index of the node.
    pub(super) node: usize,
    /// φ(t).
    pub(super) motion: DriveMotion,
    /// Component of the modes that selects the piece.
    pub(super) component: Option<usize>,
}

/// A motor's rotor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rotor {
    /// Internal index of the node.
    pub(super) node: usize,
    /// Index of the coordinate.
    pub(super) coordinate: usize,
    /// φ at t = 0.
    pub(super) angle: f64,
    /// φ̇ at t = 0.
    pub(super) speed: f64,
}

/// A rigid object.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid {
    /// Internal index of the node.
    pub(super) node: usize,
    /// Index of the law.
    pub(super) law: usize,
}

/// A chain of masses behind a law.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chain {
    /// Index of the law.
    pub(super) law: usize,
    /// Node of mass 1; the others follow.
    pub(super) first_node: usize,
    /// Coordinate of mass 1; the others follow.
    pub(super) first_coordinate: usize,
    /// Number of its coordinates: its masses, and the massless point before them.
    pub(super) masses: usize,
    /// True when it begins with a massless point between a contact element and link 1.
    pub(super) point: bool,
    /// Stiffness of the contact element of its pair, alone or in series with link 1.
    pub(super) indented: Option<f64>,
    /// The pair of link 1.
    pub(super) contact: Contact,
    /// Component of the modes of a pair that can open.
    pub(super) component: Option<usize>,
    /// True when loads, followers or tracks look at a mass's own motion, not
    /// only at its deviation.
    pub(super) watched: bool,
    /// True when a rigid object hangs on a mass and adds to its inertia.
    pub(super) carries: bool,
}

impl Chain {
    /// Number of massless points before its masses: 0 or 1.
    #[inline(always)]
    pub(super) fn points(&self) -> usize {
        usize::from(self.point)
    }

    /// Indentation of its contact element at a deformation x of the pair under a force
    /// N ≥ 0; 0 while it is clear of its flanks, and where there is no such element.
    pub(super) fn indentation(&self, x: f64, force: f64) -> f64 {
        let Some(stiffness) = self.indented else {
            return 0.0;
        };
        let flanks = self.contact.sides().iter();
        let depth = flanks.map(|&side| self.contact.penetration(side, x, 0.0).0);
        let depth = depth.fold(0.0, f64::max);
        match self.contact.power() {
            Some(power) => power.indentation(depth),
            // In series with link 1 only its own share.
            None if self.contact.stiffness() < stiffness => force / stiffness,
            None => depth,
        }
    }

    /// Indices of the chain's coordinates.
    pub(super) fn coordinates(&self) -> std::ops::Range<usize> {
        self.first_coordinate..self.first_coordinate + self.masses
    }

    /// Indices of the chain's nodes.
    pub(super) fn nodes(&self) -> std::ops::Range<usize> {
        self.first_node..self.first_node + self.masses
    }
}

/// A chain that nothing but its links and constant loads acts on, behind a
/// prescribed drive: all that its right-hand side needs, side by side.
#[derive(Clone, Debug)]
pub(super) struct Branch {
    /// The drive.
    pub(super) drive: PrescribedNode,
    /// The law over the drive's displacement.
    pub(super) law: FrozenLaw,
    /// The chain.
    pub(super) chain: Chain,
    /// c of its links.
    pub(super) stiffness: Box<[f64]>,
    /// b of its links.
    pub(super) damping: Box<[f64]>,
    /// 1/J of its masses.
    pub(super) inverse_inertia: Box<[f64]>,
    /// Constant loads on its masses.
    pub(super) constant_force: Box<[f64]>,
}

/// U(φ_driver), frozen.
#[derive(Clone, Debug)]
pub(super) struct FrozenLaw {
    /// Driving node.
    pub(super) driver: usize,
    /// U.
    pub(super) position: Position,
    /// Factor on U.
    pub(super) lever: f64,
    /// Component of the modes that selects the piece.
    pub(super) component: Option<usize>,
    /// The output of a linkage that it is, which is then read off the linkage.
    pub(super) output: Option<OutputPlace>,
}

impl FrozenLaw {
    /// True when U′ is not a constant.
    pub(super) fn has_variable_ratio(&self) -> bool {
        self.position.constant_ratio().is_none()
    }

    /// lever·U and its derivatives at the driver's displacement.
    #[inline(always)]
    pub(super) fn jet(&self, modes: &[i64], displacement: f64) -> Jet {
        let segment = segment(modes, self.component);
        self.position.jet(segment, displacement).scaled(self.lever)
    }

    /// True when the law exists at the driver's displacement.
    pub(super) fn is_defined_at(&self, displacement: f64) -> bool {
        displacement.is_finite() && self.position.reach_from(displacement).is_ok()
    }
}

/// An axis with break points.
#[derive(Clone, Debug)]
pub(super) struct FrozenTrack {
    /// Node whose displacement runs along it; `None`: time.
    pub(super) node: Option<usize>,
    /// Signal that is that displacement; `None` for time.
    pub(super) signal: Option<usize>,
    /// The break points.
    pub(super) breaks: Breaks,
    /// True of a law of motion that repeats: it has a past before t = 0.
    pub(super) repeats: bool,
    /// True when leaving the present segment ends the run.
    pub(super) stops: bool,
    /// Index of the object concerned.
    pub(super) object: usize,
}

/// The segment that a component of the modes selects; 0 without one.
#[inline(always)]
pub(super) fn segment(modes: &[i64], component: Option<usize>) -> i64 {
    component.map_or(0, |component| modes[component])
}

impl Frozen {
    /// Mode of a chain's pair; [`super::pairs::OPEN`] for a bilateral pair,
    /// which does not look at it.
    #[inline(always)]
    pub(super) fn pair_mode(&self, chain: &Chain, modes: &[i64]) -> i64 {
        segment(modes, chain.component)
    }

    /// True of the coordinate of a motor's rotor.
    pub(super) fn is_rotor(&self, coordinate: usize) -> bool {
        // (Only rotors have no link, but for bodies on a rigid contact.)
        self.stiffness[coordinate] == 0.0
            && (self.steps.iter())
                .any(|step| matches!(step, Step::Rotor(rotor) if rotor.coordinate == coordinate))
    }

    /// True when the motion of a node hangs on a free coordinate.
    pub(super) fn moves_freely(&self, node: usize) -> bool {
        let mut roots = self.root_nodes(node).into_iter();
        roots.any(|root| self.coordinate[root].is_some())
    }

    /// Number of pairs that can open, and of stops: the components of the modes before
    /// the tracks.
    pub(super) fn contacts(&self) -> usize {
        self.pairs.len() + self.stops.len()
    }

    /// Component of the modes of a track.
    pub(super) fn track_component(&self, track: usize) -> usize {
        self.contacts() + track
    }
}
