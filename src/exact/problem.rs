//! The plain problem that is propagated: a tree of masses behind one prescribed law.
//!
//! Masses stand parents first. Mass i has the displacement φ_i = q_i + R_i(t),
//! R_i = ratio_i·L(t) + offset_i, where L is the prescribed law: q_i is the
//! deviation from where the rigid mechanism would be. Its link to its parent
//! (or to the law) has the deformation x = q_i − lever·q_parent. In these
//! coordinates
//!
//! J q̈ + B q̇ + K q = W − J·ratio·L̈ − (viscous)·ratio·L̇ − (springs)·R
//!
//! with constant matrices as long as no pair opens or closes: link forces do
//! not see the law, loads to the ground do.

use super::law::{LAW_DEGREE, Law, shift};
use std::fmt;
use std::sync::Arc;

/// A tree of masses behind a prescribed law.
#[derive(Clone, Debug)]
pub struct TreeProblem {
    /// The masses, parents before children; at least one.
    pub masses: Vec<TreeMass>,
    /// The law they follow.
    pub law: Law,
    /// Deviations q at t = 0 (rad).
    pub displacement: Vec<f64>,
    /// q̇ at t = 0 (rad/s).
    pub speed: Vec<f64>,
    /// The objects the masses belong to, for figures.
    pub objects: Vec<TreeObject>,
}

/// An object of the scene: a chain of masses within the tree.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeObject {
    /// First mass, whose link holds the driving pair.
    pub first: usize,
    /// Masses whose motions, by their shares, sum to that of the output: the last mass, or
    /// several of one ratio, with shares that sum to 1.
    pub output: Vec<(usize, f64)>,
    /// The mass that drives it and U′ between them (every rigid object on the
    /// way included); `None`: the law.
    pub driver: Option<(usize, f64)>,
}

/// A mass, the link that joins it to its parent, and what acts on it.
#[derive(Clone, Debug)]
pub struct TreeMass {
    /// J > 0 (kg·m²); inertias of rigid objects that it carries are included.
    pub inertia: f64,
    /// R_i = ratio·L + offset.
    pub ratio: f64,
    /// See `ratio`.
    pub offset: f64,
    /// The mass its link is attached to; `None`: the law itself.
    pub parent: Option<usize>,
    /// Deformation of the link x = q − lever·q_parent.
    pub lever: f64,
    /// c > 0 of the link; 0 of a rigid pair.
    pub stiffness: f64,
    /// b ≥ 0 of the link.
    pub damping: f64,
    /// The pair in the link.
    pub pair: TreePair,
    /// e of a rigid pair, which has an impact where a flank is touched at a speed, and is
    /// held there while it presses; its link has neither stiffness nor damping. Only of the
    /// single mass of a tree, with constant loads and without a damper to the ground.
    pub restitution: Option<f64>,
    /// Stiffness of springs to the ground, ≥ 0.
    pub ground_stiffness: f64,
    /// Viscous damping to the ground, ≥ 0.
    pub ground_damping: f64,
    /// Loads over time, added; positive towards positive displacement.
    pub loads: Vec<TimeLoad>,
}

impl TreeMass {
    /// A free-standing mass with its link and nothing else.
    pub fn new(inertia: f64, parent: Option<usize>, stiffness: f64, damping: f64) -> Self {
        Self {
            inertia,
            ratio: 1.0,
            offset: 0.0,
            parent,
            lever: 1.0,
            stiffness,
            damping,
            pair: TreePair::Bilateral,
            restitution: None,
            ground_stiffness: 0.0,
            ground_damping: 0.0,
            loads: Vec::new(),
        }
    }
}

/// The pair in a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TreePair {
    /// Always engaged.
    Bilateral,
    /// One flank at x = 0; lifts off towards `opens`·x > 0 (±1).
    Force {
        /// +1 or −1.
        opens: f64,
    },
    /// Two flanks at x = ∓gap/2.
    Form {
        /// η ≥ 0.
        gap: f64,
    },
}

/// A flank: the clearance to it is X = sign·x + offset, negative when pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flank {
    /// +1 or −1.
    pub sign: f64,
    /// Half the gap.
    pub offset: f64,
}

impl TreePair {
    /// The flanks; engaged on flank f the link pulls the mass back with the
    /// force c·(x + sign·offset) + b·ẋ. A bilateral link has none.
    pub fn flanks(&self) -> ([Flank; 2], usize) {
        let flank = |sign, offset| Flank { sign, offset };
        match *self {
            Self::Bilateral => ([flank(1.0, 0.0); 2], 0),
            Self::Force { opens } => ([flank(opens, 0.0); 2], 1),
            Self::Form { gap } => ([flank(1.0, gap / 2.0), flank(-1.0, gap / 2.0)], 2),
        }
    }
}

/// A load over time.
#[derive(Clone, Debug)]
pub enum TimeLoad {
    /// W.
    Constant(f64),
    /// (t, W), t ascending, at least one; W(t) is linear between the points
    /// and constant outside.
    Table(Vec<(f64, f64)>),
    /// Polynomial pieces made when they are reached.
    Pieces(Arc<dyn ForceSource>),
}

/// A load in polynomial pieces.
pub trait ForceSource: fmt::Debug + Send + Sync {
    /// The piece in force just after `time`.
    fn piece(&self, time: f64) -> ForcePiece;
}

/// W on an interval, as a polynomial in τ = t − start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcePiece {
    /// Time at which τ = 0 (s).
    pub start: f64,
    /// End (s), +∞ for ever.
    pub end: f64,
    /// Coefficients of W in powers of τ.
    pub coefficients: [f64; LAW_DEGREE + 1],
}

impl TimeLoad {
    /// Adds W to a polynomial of at least [`LAW_DEGREE`] + 1 coefficients in
    /// the time from `time` + `low` on; returns how long it holds (s). `held`
    /// keeps the piece in force, which is made anew only where it ends.
    pub(crate) fn add(
        &self,
        time: f64,
        low: f64,
        held: &mut Option<ForcePiece>,
        force: &mut [f64],
    ) -> f64 {
        match self {
            Self::Constant(value) => {
                force[0] += value;
                f64::INFINITY
            }
            Self::Table(points) => {
                let next = points.iter().position(|point| point.0 > time);
                match next {
                    Some(0) => {
                        force[0] += points[0].1;
                        points[0].0
                    }
                    Some(k) => {
                        let (a, b) = (points[k - 1], points[k]);
                        let slope = (b.1 - a.1) / (b.0 - a.0);
                        force[0] += a.1 + slope * ((time - a.0) + low);
                        force[1] += slope;
                        b.0
                    }
                    None => {
                        force[0] += points.last().map_or(0.0, |p| p.1);
                        f64::INFINITY
                    }
                }
            }
            Self::Pieces(source) => {
                let holds = |piece: &ForcePiece| piece.start <= time && time < piece.end;
                let mut piece = held.filter(holds).unwrap_or_else(|| source.piece(time));
                *held = Some(piece);
                shift(&mut piece.coefficients, (time - piece.start) + low);
                for (force, c) in force.iter_mut().zip(piece.coefficients) {
                    *force += c;
                }
                piece.end
            }
        }
    }
}

/// State of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PairState {
    /// Clear of every flank.
    Free,
    /// Behind flank f (X < 0) with the force cut off at zero.
    Pressed(u8),
    /// Engaged on flank f; of a rigid pair: held there.
    Engaged(u8),
}

impl PairState {
    /// True when a force is transmitted.
    pub fn engaged(self) -> bool {
        matches!(self, Self::Engaged(_))
    }
}

/// Why a scene or a run cannot be propagated exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The object concerned; empty when it is the run as a whole.
    pub object: String,
    /// Why.
    pub reason: String,
}

impl Refusal {
    pub(crate) fn new(object: impl Into<String>, reason: impl Into<String>) -> Self {
        Self {
            object: object.into(),
            reason: reason.into(),
        }
    }
}
