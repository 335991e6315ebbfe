//! The dynamic model: plain data between the scene's objects and the system that is integrated.
//!
//! Objects lower to this; the system is built from this; neither knows the
//! other. Nodes stand in an order in which every driver comes before what it
//! drives. SI units; for sliding coordinates read m for rad, kg for kg·m²,
//! N for N·m, N/m for N·m/rad.
//!
//! **Coordinates.** The state holds, for every mass of a chain, its deviation
//! from the law u = φ − U(φ_driver) and u̇, not φ itself. Link deformations are
//! then differences of small numbers, tolerances act on what the engineer asks
//! for, and an angle that grows with every turn costs no digits. A motor's
//! rotor keeps its absolute angle.

mod condition;
mod contact;
mod dry_friction;
mod loads;
mod part;
mod pressing;
mod span;
mod stop;

pub use crate::dynamics::stated::SceneStatements;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use serde::Serialize;
use std::sync::Arc;

pub use super::laws::contact::{ContactForm, ContactLaw, Loss};
pub(crate) use condition::NAMES as CONDITION_NAMES;
pub use condition::{Condition, UNTIL};
pub use contact::ContactElement;
pub use dry_friction::DryFriction;
pub use loads::{LinearLoad, LinearPiece, Load, LoadLaw, LoadVariable, WrittenLoad};
pub use part::{DRIVEN_END, MODE, OUTPUT, ObjectPart, PartInput, STOP, SUM, owner_of};
pub use pressing::ContactPartner;
pub use span::{Span, SpanAxis, SpanFigure};
pub use stop::{Stop, StopPart};

/// Index of a node in [`Model::nodes`].
pub type NodeIndex = usize;

/// A complete dynamic model.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Drivers before driven.
    pub nodes: Vec<Node>,
    /// Elastic-dissipative links.
    pub links: Vec<Link>,
    /// Loads on nodes.
    pub loads: Vec<Load>,
    /// Linkages of one input.
    pub linkages: Vec<LinkageBody>,
    /// Linkages of several inputs.
    pub multi_linkages: Vec<MultiLinkageBody>,
    /// Piecewise axes: which piece of a law, table or window is in force is a
    /// discrete state that changes at located events.
    pub tracks: Vec<Track>,
    /// Elastic objects that are reduced to vibration modes.
    pub reduced: Vec<ModalReduction>,
    /// One-sided stops against the ground.
    pub stops: Vec<StopPart>,
    /// The scene's objects and their outputs, in the order of their ids; then the inner
    /// parts of objects ([`ObjectPart::is_inner`]).
    pub objects: Vec<ObjectPart>,
    /// State at t = 0.
    pub start: Start,
    /// Time that is to be simulated (s), where it is known: how far motions lead.
    pub horizon: Option<f64>,
    /// Warnings to the user before the run.
    pub warnings: Vec<String>,
    /// Motions and loads as the scene states them, for the check of a run.
    pub stated: SceneStatements,
    /// Conditions whose first times are figures of the run.
    pub conditions: Vec<Condition>,
}

impl Model {
    /// The two nodes that a node is the difference of: those between which a dry friction acts.
    pub fn rubbing_nodes(&self, node: NodeIndex) -> Option<[NodeIndex; 2]> {
        let rubs = |load: &&Load| load.node == node && load.law.dry_friction().is_some();
        self.loads.iter().find(rubs)?;
        match &self.nodes[node].motion {
            NodeMotion::Constrained { drivers, .. } => match drivers[..] {
                [own, other] if self.part_of(node).is_none() => Some([own, other]),
                _ => None,
            },
            NodeMotion::Prescribed { .. }
            | NodeMotion::Rotor { .. }
            | NodeMotion::Mass { .. }
            | NodeMotion::Rigid { .. } => None,
        }
    }

    /// The object part that a node is of.
    fn part_of(&self, node: NodeIndex) -> Option<&ObjectPart> {
        let own = |part: &&ObjectPart| part.nodes.contains(&node) || part.combination == Some(node);
        self.objects.iter().find(own)
    }

    /// The node of the object that has a load: where this acts, or of what rubs on another.
    pub fn owner_of_load(&self, load: &Load) -> NodeIndex {
        self.rubbing_nodes(load.node)
            .map_or(load.node, |[own, _]| own)
    }

    /// True of a node whose inertia changes as it moves: an input of a planar linkage.
    pub fn has_variable_inertia(&self, node: NodeIndex) -> bool {
        let several = self.multi_linkages.iter();
        self.linkages.iter().any(|body| body.node == node)
            || several
                .flat_map(|body| &body.inputs)
                .any(|&own| own == node)
    }

    /// The stop that an object part is.
    pub fn stop(&self, part: usize) -> Option<Stop> {
        let own = self.stops.iter().find(|stop| stop.part == part)?;
        self.loads[own.load].law.stop().copied()
    }

    /// Reduction of an object to modes, if it is reduced to modes.
    pub fn reduction_of(&self, object: usize) -> Option<&ModalReduction> {
        self.reduced.iter().find(|reduced| reduced.object == object)
    }

    /// The pair in link 1 of an elastic object.
    pub fn elastic_pair(&self, object: &ObjectPart) -> Option<Pair> {
        match self.links[self.pair_link(object)?].base {
            LinkBase::Law { pair } => Some(pair),
            LinkBase::Mass(_) => None,
        }
    }

    /// The link that holds the pair of an object: its contact element, or link 1.
    pub fn pair_link(&self, object: &ObjectPart) -> Option<usize> {
        let contact = object.contact.map(|contact| contact.link);
        contact.or(object.links.first().copied())
    }

    /// The pair between an object, elastic or rigid, and its driver.
    pub fn pair(&self, object: &ObjectPart) -> Option<Pair> {
        self.elastic_pair(object).or(object.rigid_pair)
    }
}

/// Turning or sliding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Coordinate {
    /// Displacement is an angle (rad).
    #[default]
    Turning,
    /// Displacement is a length (m).
    Sliding,
}

impl Coordinate {
    /// Of something that slides, or turns.
    pub const fn sliding(slides: bool) -> Self {
        match slides {
            true => Self::Sliding,
            false => Self::Turning,
        }
    }

    /// SI units of a displacement, and of the force or moment along it.
    pub const fn units(self) -> [&'static str; 2] {
        match self {
            Self::Turning => ["rad", "N m"],
            Self::Sliding => ["m", "N"],
        }
    }

    /// SI unit of a displacement.
    pub const fn unit(self) -> &'static str {
        self.units()[0]
    }

    /// A displacement for reading, and its unit: degrees or metres.
    pub const fn displacement_for_reading(self, displacement: f64) -> (f64, &'static str) {
        match self {
            Self::Turning => (displacement.to_degrees(), "deg"),
            Self::Sliding => (displacement, "m"),
        }
    }
}

/// A point of the mechanism with one displacement φ.
#[derive(Clone, Debug)]
pub struct Node {
    /// Constant inertia J ≥ 0 at this node; > 0 for free ones.
    pub inertia: f64,
    /// Motion: what determines it.
    pub motion: NodeMotion,
}

/// Motion of a node: prescribed, free or following others.
#[derive(Clone, Debug)]
pub enum NodeMotion {
    /// φ(t) given. `track` (over time) selects the piece of the motion.
    Prescribed {
        /// The motion.
        motion: DriveMotion,
        /// Piece selector, when the motion has breaks.
        track: Option<usize>,
    },
    /// A motor's rotor: φ and φ̇ are state.
    Rotor {
        /// φ at t = 0, for every start but an explicit one of the rotor.
        angle: f64,
        /// φ̇ at t = 0.
        speed: f64,
    },
    /// A mass of a chain: u = φ − U(φ_driver) and u̇ are state. All masses of a
    /// chain share the same `law`.
    Mass {
        /// The law whose motion the mass follows.
        law: Law,
    },
    /// A rigid object: φ = U(φ_driver), no state of its own.
    Rigid {
        /// The constraint.
        law: Law,
    },
    /// φ = G(φ₁, …, φₖ) of several drivers, no state of its own.
    Constrained {
        /// The drivers.
        drivers: Vec<NodeIndex>,
        /// G.
        constraint: Constraint,
    },
}

impl NodeMotion {
    /// True when the node's motion is state of the system.
    pub fn is_free(&self) -> bool {
        matches!(self, Self::Rotor { .. } | Self::Mass { .. })
    }

    /// The law that the node follows, if it follows one.
    pub fn law(&self) -> Option<&Law> {
        match self {
            Self::Mass { law } | Self::Rigid { law } => Some(law),
            Self::Prescribed { .. } | Self::Rotor { .. } | Self::Constrained { .. } => None,
        }
    }
}

/// U(φ_driver), the motion the driver asks for.
#[derive(Clone, Debug)]
pub struct Law {
    /// The driving node.
    pub driver: NodeIndex,
    /// U.
    pub position: Position,
    /// Factor on U (lever ratio or arm).
    pub lever: f64,
    /// Piece selector over the driver's displacement, when U has breaks.
    pub track: Option<usize>,
}

/// An elastic-dissipative link.
#[derive(Clone, Debug)]
pub struct Link {
    /// The mass the link pulls back to its law: force −F.
    pub mass: NodeIndex,
    /// Base of the link: what its other end is attached to.
    pub base: LinkBase,
    /// c > 0.
    pub stiffness: f64,
    /// b ≥ 0.
    pub damping: f64,
}

/// The other end of a link.
#[derive(Clone, Debug)]
pub enum LinkBase {
    /// Link 1: the law U(φ_driver) of the mass itself; deformation x = u₁; the
    /// driver's node receives F·U′. The driving pair sits here.
    Law {
        /// The kinematic pair.
        pair: Pair,
    },
    /// Links 2 … n: the preceding mass of the same chain; bilateral.
    Mass(NodeIndex),
}

/// The kinematic pair of link 1; bilateral by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Closure: how the pair is kept together.
    pub closure: Closure,
    /// Gap η ≥ 0 (form closure).
    pub gap: f64,
    /// +1: force closure lifts off towards x > 0; −1: towards x < 0.
    pub opens: f64,
    /// Form of the contact force.
    pub form: ContactForm,
}

impl Default for Pair {
    fn default() -> Self {
        Self {
            closure: Closure::Bilateral,
            gap: 0.0,
            opens: 1.0,
            form: ContactForm::default(),
        }
    }
}

/// Closure of a kinematic pair: how it is kept together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Closure {
    /// Always engaged.
    #[default]
    Bilateral,
    /// Held shut by a closing force; the link never pulls.
    Force,
    /// Two flanks with a gap between them.
    Form,
}

/// A rigid planar linkage on a node whose displacement is its input coordinate
/// q. The node carries the linkage's inertia J(q) and its forces
/// −½·J′·q̇² − V′ + Q − D·q̇, and nothing of its own; its outputs are rigid nodes
/// without inertia that follow it.
#[derive(Clone, Debug)]
pub struct LinkageBody {
    /// Input: a rigid node.
    pub node: NodeIndex,
    /// The linkage.
    pub linkage: Arc<Linkage>,
    /// The nodes of its outputs, in their order.
    pub outputs: Vec<NodeIndex>,
    /// Friction of the pairs, when it acts on the motion; `None`: it moves freely.
    pub friction: Option<Arc<Kinetostatics>>,
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
}

/// A rigid planar linkage on several nodes whose displacements are its inputs q₁, …, qₘ: it
/// couples them by its mass matrix M(q) and loads them with its forces, and the nodes carry
/// nothing of their own. Its outputs are constrained nodes that follow all of them.
#[derive(Clone, Debug)]
pub struct MultiLinkageBody {
    /// The node that is the first input once more: the displacement of the object.
    pub node: NodeIndex,
    /// Inputs, in their order: rigid nodes behind what drives them, or rotors without inertia
    /// where they are free.
    pub inputs: Vec<NodeIndex>,
    /// The linkage.
    pub linkage: Arc<MultiLinkage>,
    /// The nodes of its outputs, in their order.
    pub outputs: Vec<NodeIndex>,
    /// Friction of the pairs, when it acts on the motion; `None`: it moves freely.
    pub friction: Option<Arc<Kinetostatics>>,
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
}

/// An elastic object reduced to vibration modes. Held at its driven end, its part has one
/// node, a massless output; modes and the inertia at the driven end are parts of their own.
/// Behind a contact element its part is a chain of masses, and the output one of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct ModalReduction {
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
    /// The masses of the modes, each an oscillator on the object's law, or those of the
    /// chain, with the share of their deviation that the output gets.
    pub modes: Vec<(NodeIndex, f64)>,
    /// The output of a chain.
    pub output: Option<NodeIndex>,
    /// What the modes that are left out give way by under the acceleration φ̈ of the
    /// driven end: the output deviates by −`under_acceleration`·φ̈ besides (s²).
    pub under_acceleration: f64,
    /// Deflection of the modes that are left out under constant loads.
    pub offset: f64,
}

/// An axis with break points; its current segment is discrete state.
#[derive(Clone, Debug)]
pub struct Track {
    /// Source of the values along the axis.
    pub source: TrackSource,
    /// The break points.
    pub breaks: Breaks,
    /// True of a law of motion that repeats for ever: it has a past before t = 0.
    pub repeats: bool,
    /// True when leaving segment `home` ends the run: the position function
    /// cannot be assembled beyond it (a dead-centre position).
    pub stops: bool,
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
}

/// Source of a track: what runs along its axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackSource {
    /// Time.
    Time,
    /// A node's displacement.
    Node(NodeIndex),
}

/// State at t = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Start {
    /// The quiet start: static equilibrium with the inertia loads of the law,
    /// and the speeds of that deflection.
    #[default]
    Kinetostatic,
    /// Static equilibrium of the whole graph; masses move with their laws.
    Static,
    /// Exactly on the law, links unloaded.
    OnLaw,
    /// Explicit absolute displacements and speeds of every mass, per object
    /// (index into [`Model::objects`]); objects left out start on their law.
    Explicit(Vec<ExplicitStart>),
    /// The coordinates u and u̇ of the system, as [`crate::dynamics::system::System`] has them: a
    /// state that a study has found.
    State(Vec<f64>),
}

/// Explicit start of one object.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplicitStart {
    /// Index into [`Model::objects`].
    pub object: usize,
    /// Absolute displacement of each mass.
    pub displacement: Vec<f64>,
    /// Absolute speed of each mass.
    pub speed: Vec<f64>,
}
