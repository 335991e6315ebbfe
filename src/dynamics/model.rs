//! The dynamic model: plain data between the scene's objects and the system that is integrated.
//!
//! Objects lower to this; the system is built from this; neither knows the
//! other. Nodes stand in an order in which every driver comes before what it
//! drives. SI units; for sliding coordinates read m for rad, kg for kg·m²,
//! N for N·m, N/m for N·m/rad.
//!
//! **Coordinates.** The state holds, for every mass of a chain, its deviation
//! from the law u = φ − U(φ_driver) and u̇, not φ itself: link deformations are
//! then differences of small numbers, tolerances act on what the engineer asks
//! for, and an angle that grows with every turn costs no digits. A motor's
//! rotor keeps its absolute angle.

use crate::dynamics::load::LoadFunction;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use serde::Serialize;
use std::sync::Arc;

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
    /// Linkages.
    pub linkages: Vec<LinkageBody>,
    /// Piecewise axes: which piece of a law, table or window is in force is a
    /// discrete state that changes at located events.
    pub tracks: Vec<Track>,
    /// Elastic objects that are reduced to vibration modes.
    pub reduced: Vec<Reduced>,
    /// One-sided stops against the ground.
    pub stops: Vec<StopPart>,
    /// The scene's objects and their outputs, in the order of their ids; then the inner
    /// parts of objects ([`ObjectPart::is_inner`]).
    pub objects: Vec<ObjectPart>,
    /// State at t = 0.
    pub start: Start,
    /// What the user should know before the run.
    pub warnings: Vec<String>,
}

impl Model {
    /// The stop that an object part is.
    pub fn stop(&self, part: usize) -> Option<Stop> {
        let own = self.stops.iter().find(|stop| stop.part == part)?;
        match self.loads[own.load].law {
            LoadLaw::Stop(stop) => Some(stop),
            _ => None,
        }
    }

    /// What an object is reduced to, if it is reduced to modes.
    pub fn reduced(&self, object: usize) -> Option<&Reduced> {
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

/// A point of the mechanism with one displacement φ.
#[derive(Clone, Debug)]
pub struct Node {
    /// Constant inertia J ≥ 0 at this node; > 0 for free ones.
    pub inertia: f64,
    /// What determines its motion.
    pub motion: NodeMotion,
}

/// What determines a node's motion.
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
    /// What the other end is attached to.
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
    /// How the pair is kept together.
    pub closure: Closure,
    /// Gap η ≥ 0 (form closure).
    pub gap: f64,
    /// +1: force closure lifts off towards x > 0; −1: towards x < 0.
    pub opens: f64,
    /// Law of the contact force.
    pub law: DampingLaw,
}

impl Default for Pair {
    fn default() -> Self {
        Self {
            closure: Closure::Bilateral,
            gap: 0.0,
            opens: 1.0,
            law: DampingLaw::KelvinVoigt,
        }
    }
}

/// How a kinematic pair is kept together.
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

/// Law of the contact force over penetration p and its rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum DampingLaw {
    /// N = c·p + b·ṗ, cut off at zero.
    #[default]
    KelvinVoigt,
    /// N = c·p·max(0, 1 + κ·ṗ).
    HuntCrossley {
        /// κ (seconds per unit of p); `None`: b₁/(c₁·p*), p* the static penetration.
        kappa: Option<f64>,
    },
    /// N = K·q^{3/2}·max(0, 1 + χ·ṗ), K the link's stiffness (N/m^{3/2}, N·m/rad^{3/2}):
    /// contact in a point, by Hertz. Of a contact element alone.
    Hertz {
        /// χ ≥ 0 (seconds per unit of p).
        dissipation: f64,
        /// Compliance ≥ 0 of the undamped link behind the contact, in series with it:
        /// p = q + compliance·N. With dissipation it is 0.
        compliance: f64,
    },
}

/// A contact between an object and what its law asks for: an element of its own, whose
/// data do not depend on the number of masses. It stands in the link that holds the pair:
///
/// * before a rigid body that link is the contact alone;
/// * before an undamped link 1, with a law without loss, it is contact and link 1 in series;
/// * else it ends at a massless point, from which link 1 leads on to mass 1. The forces on
///   that point are in balance, which determines its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactElement {
    /// Its law.
    pub law: ContactLaw,
    /// k_c (N/m or N·m/rad), or K of a contact in a point.
    pub stiffness: f64,
    /// The link that holds the pair.
    pub link: usize,
    /// The massless point between contact and link 1.
    pub point: Option<NodeIndex>,
}

/// Law of a contact element over indentation p and its rate, N ≥ 0 where the pair can open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactLaw {
    /// N = k_c·p.
    Elastic,
    /// N = k_c·p + b_c·ṗ.
    KelvinVoigt {
        /// b_c ≥ 0 (N·s/m or N·m·s/rad).
        damping: f64,
    },
    /// N = k_c·p·(1 + χ·ṗ).
    HuntCrossley {
        /// χ ≥ 0 (s/m or s/rad).
        dissipation: f64,
    },
    /// N = K·p^{3/2}·(1 + χ·ṗ).
    Hertz {
        /// χ ≥ 0 (s/m or s/rad).
        dissipation: f64,
    },
}

impl ContactLaw {
    /// The law of the pair in the link that such a contact is, with the damping of that link;
    /// `compliance`: of an undamped link in series with it, in a contact by Hertz.
    pub fn of_link(self, compliance: f64) -> (DampingLaw, f64) {
        match self {
            Self::KelvinVoigt { damping } => (DampingLaw::KelvinVoigt, damping),
            Self::HuntCrossley { dissipation } if dissipation > 0.0 => {
                let kappa = Some(dissipation);
                (DampingLaw::HuntCrossley { kappa }, 0.0)
            }
            Self::Hertz { dissipation } => {
                let law = DampingLaw::Hertz {
                    dissipation,
                    compliance,
                };
                (law, 0.0)
            }
            Self::Elastic | Self::HuntCrossley { .. } => (DampingLaw::KelvinVoigt, 0.0),
        }
    }

    /// True when it takes no energy.
    pub fn is_lossless(self) -> bool {
        match self {
            Self::Elastic => true,
            Self::KelvinVoigt { damping: loss }
            | Self::HuntCrossley { dissipation: loss }
            | Self::Hertz { dissipation: loss } => loss == 0.0,
        }
    }

    /// True when the force is linear in p and ṗ.
    pub fn is_linear(self) -> bool {
        match self {
            Self::Elastic | Self::KelvinVoigt { .. } => true,
            Self::HuntCrossley { dissipation } => dissipation == 0.0,
            Self::Hertz { .. } => false,
        }
    }
}

/// A load on a node. Positive forces act towards positive displacement.
#[derive(Clone, Debug)]
pub struct Load {
    /// Where it acts.
    pub node: NodeIndex,
    /// `object.loads.name`, for messages and equations.
    pub name: String,
    /// Its law.
    pub law: LoadLaw,
}

/// Force law of a load.
#[derive(Clone, Debug)]
pub enum LoadLaw {
    /// W.
    Constant(f64),
    /// Piecewise-linear in time or in a driver's displacement; the track
    /// selects the piece. Piece i is `value[i] + slope[i]·(x − start[i])`.
    Pieces {
        /// Which piece.
        track: usize,
        /// One entry a piece of the track's breaks.
        pieces: Vec<LinearPiece>,
    },
    /// −preload − rate·φ.
    Spring {
        /// Rate.
        rate: f64,
        /// Force at φ = 0, towards negative displacement.
        preload: f64,
    },
    /// −b·φ̇.
    Viscous(f64),
    /// −force·tanh(φ̇/width).
    Friction {
        /// Sliding friction.
        force: f64,
        /// Regularisation width (speed).
        width: f64,
    },
    /// T₀·(1 − ω/ω₀).
    LinearMotor {
        /// T₀.
        stall_torque: f64,
        /// ω₀.
        no_load_speed: f64,
    },
    /// Kloss: 2·T_b/(s/s_b + s_b/s), written without poles as 2·T_b·s·s_b/(s² + s_b²).
    Kloss {
        /// T_b.
        breakdown_torque: f64,
        /// s_b.
        breakdown_slip: f64,
        /// ω_s.
        synchronous_speed: f64,
    },
    /// Torque over speed, linear between the points, constant outside.
    SpeedTable(Vec<(f64, f64)>),
    /// A one-sided stop against the ground.
    Stop(Stop),
    /// `factor` times anything else over displacement and speed of the node.
    Custom {
        /// The force.
        function: Arc<dyn LoadFunction>,
        /// Factor on it.
        factor: f64,
    },
}

/// A one-sided stop of a node against the ground: a contact that presses where the node
/// passes a displacement, and never pulls. Its indentation is p = side·(φ − at), and it
/// pushes with −side·N. It is engaged while p > 0 and N > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// Displacement at which it is touched (rad or m).
    pub at: f64,
    /// −1: it holds the node from going below `at`; +1: from going above.
    pub side: f64,
    /// k (N/m or N·m/rad), or K of a contact in a point.
    pub stiffness: f64,
    /// Law of its contact.
    pub law: ContactLaw,
}

impl Stop {
    /// It as a pair of the deformation x = φ − at, with the damping of its link.
    pub fn pair(&self) -> (Pair, f64) {
        let (law, damping) = self.law.of_link(0.0);
        let pair = Pair {
            closure: Closure::Force,
            gap: 0.0,
            opens: -self.side,
            law,
        };
        (pair, damping)
    }
}

/// A stop of an object, which stands in the model as an inner part of it, `valve.seat`:
/// its displacement is that of the object's last mass, its contact force that of the stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StopPart {
    /// The object that it stops, index into [`Model::objects`].
    pub object: usize,
    /// The stop itself, index into [`Model::objects`].
    pub part: usize,
    /// Its load, a [`LoadLaw::Stop`], index into [`Model::loads`].
    pub load: usize,
}

/// A straight piece of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearPiece {
    /// Argument (of the first period) at which the force is `value`.
    pub start: f64,
    /// Force there.
    pub value: f64,
    /// Change of force per unit of the argument.
    pub slope: f64,
}

/// A rigid planar linkage on a node whose displacement is its input coordinate
/// q. The node carries the linkage's inertia J(q) and its forces
/// −½·J′·q̇² − V′ + Q − D·q̇, and nothing of its own; its outputs are rigid nodes
/// without inertia that follow it.
#[derive(Clone, Debug)]
pub struct LinkageBody {
    /// Its input: a rigid node.
    pub node: NodeIndex,
    /// The linkage.
    pub linkage: Arc<Linkage>,
    /// The nodes of its outputs, in their order.
    pub outputs: Vec<NodeIndex>,
    /// Its pairs' friction, when it acts on the motion; `None`: it moves freely.
    pub friction: Option<Arc<Kinetostatics>>,
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
}

/// An elastic object reduced to vibration modes. Its part has one node, a massless
/// output; modes and the inertia at the driven end are parts of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Reduced {
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
    /// The masses of the modes, each an oscillator on the object's law, with the share of
    /// their deviation that the output gets.
    pub modes: Vec<(NodeIndex, f64)>,
    /// What the modes that are left out give way by under the acceleration φ̈ of the
    /// driven end: the output deviates by −`under_acceleration`·φ̈ besides (s²).
    pub under_acceleration: f64,
    /// What they give way by under constant loads.
    pub offset: f64,
}

/// An axis with break points; its current segment is discrete state.
#[derive(Clone, Debug)]
pub struct Track {
    /// What runs along the axis.
    pub source: TrackSource,
    /// The break points.
    pub breaks: Breaks,
    /// True when leaving segment `home` ends the run: the position function
    /// cannot be assembled beyond it (a dead position).
    pub stops: bool,
    /// The object concerned, index into [`Model::objects`].
    pub object: usize,
}

/// What runs along a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrackSource {
    /// Time.
    Time,
    /// A node's displacement.
    Node(NodeIndex),
}

/// The owner of a figure and the figure's name, from an address such as
/// `rocker.pair.gap` or `press.ram.peak_speed`: the longest id that `known`
/// knows; the first part when it knows none.
pub fn owner_of(address: &str, known: impl Fn(&str) -> bool) -> (&str, &str) {
    let mut ends = address.match_indices('.').map(|(at, _)| at);
    let Some(first) = ends.next() else {
        return (address, "");
    };
    let end = match ends.next() {
        Some(second) if known(&address[..second]) => second,
        _ => first,
    };
    (&address[..end], &address[end + 1..])
}

/// What became of one of the scene's objects, or of an output of one.
#[derive(Clone, Debug, Default)]
pub struct ObjectPart {
    /// Id in the scene; of an output `object.output`.
    pub id: String,
    /// Kind in the scene; [`OUTPUT`] of an output, [`DRIVEN_END`] of the inertia of an
    /// elastic object that moves with its law, [`MODE`] of one of its vibration modes,
    /// [`STOP`] of a stop.
    pub kind: &'static str,
    /// Turning or sliding.
    pub coordinate: Coordinate,
    /// Its nodes, first mass first; one for a drive or a rigid object.
    pub nodes: Vec<NodeIndex>,
    /// The node on which several inputs are combined, which its law follows.
    pub combination: Option<NodeIndex>,
    /// Of an elastic object the node of the inertia that moves with its law, if it has
    /// one: it stands in the model as a part of its own, of the kind [`DRIVEN_END`].
    pub driven_end: Option<NodeIndex>,
    /// What drives it, in the order of its inputs; nothing drives a drive.
    pub inputs: Vec<PartInput>,
    /// Its links, link 1 first; empty for a drive or a rigid object. A contact element
    /// that ends at a massless point is not among them.
    pub links: Vec<usize>,
    /// The contact element of its pair.
    pub contact: Option<ContactElement>,
    /// The pair of a rigid object (an elastic object's is in its link 1).
    pub rigid_pair: Option<Pair>,
}

/// An input of an object part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartInput {
    /// Name of the port; empty of an output, which its own object drives.
    pub port: String,
    /// The driving object or output, index into [`Model::objects`].
    pub driver: usize,
}

impl PartInput {
    /// The inputs of an object behind one driver, or of a drive (`None`).
    pub fn only(driver: Option<usize>) -> Vec<Self> {
        let port = String::new();
        driver
            .map(|driver| Self { port, driver })
            .into_iter()
            .collect()
    }
}

impl ObjectPart {
    /// True of a drive, prescribed or with a motor: nothing drives it.
    pub fn is_drive(&self) -> bool {
        self.inputs.is_empty()
    }

    /// What drives an object with one input, index into [`Model::objects`]; `None` for
    /// a drive, and where there are several.
    pub fn driver(&self) -> Option<usize> {
        match self.inputs[..] {
            [ref only] => Some(only.driver),
            _ => None,
        }
    }

    /// True of a part of an object that nothing can hang on and that no scene names.
    pub fn is_inner(&self) -> bool {
        self.kind == DRIVEN_END || self.kind == MODE || self.kind == STOP
    }

    /// True when one of the inputs hangs on that object part.
    pub fn is_driven_by(&self, other: usize) -> bool {
        self.inputs.iter().any(|input| input.driver == other)
    }
}

/// The kind of an object part that is an output of another one.
pub const OUTPUT: &str = "output";

/// The kind of an object part that is the share of an elastic object's inertia at its
/// driven end, which follows the law: `object.driven_end`.
pub const DRIVEN_END: &str = "driven_end";

/// The kind of an object part that is a vibration mode of an elastic object:
/// `object.mode_1`, `object.residual`.
pub const MODE: &str = "mode";

/// The kind of an object part that is a stop of an object: `valve.seat`.
pub const STOP: &str = "stop";

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
