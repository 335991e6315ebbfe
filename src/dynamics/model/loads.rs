//! Loads on nodes.

use super::{DryFriction, NodeIndex, Stop, Track, TrackSource};
use crate::dynamics::load::LoadFunction;
use crate::math::expression::Expression;
use std::sync::Arc;

/// A load on a node. Positive forces act towards positive displacement.
#[derive(Clone, Debug)]
pub struct Load {
    /// Node that it acts on.
    pub node: NodeIndex,
    /// `object.loads.name`, for messages and equations.
    pub name: String,
    /// Law of the force.
    pub law: LoadLaw,
}

impl Load {
    /// The force at a time, where `motion` gives φ and φ̇ of a node; `None` of a stop, which has
    /// modes, and where a motion is not known.
    pub fn force(
        &self,
        time: f64,
        motion: impl Fn(NodeIndex) -> Option<(f64, f64)>,
        tracks: &[Track],
    ) -> Option<f64> {
        self.law.force(self.node, time, motion, tracks)
    }
}

/// Force law of a load.
#[derive(Clone, Debug)]
pub enum LoadLaw {
    /// W₀ − k·φ − b·φ̇.
    Linear(LinearLoad),
    /// Piecewise-linear in time or in a driver's displacement; the track
    /// selects the piece. Piece i is `value[i] + slope[i]·(x − start[i])`.
    Pieces {
        /// Index of the track whose piece counts.
        track: usize,
        /// Pieces, one for each of the track's.
        pieces: Vec<LinearPiece>,
    },
    /// A one-sided stop against the ground.
    Stop(Stop),
    /// An expression over time and motions.
    Written(WrittenLoad),
    /// Dry friction that sticks: its direction, or that it holds, is a mode.
    Dry {
        /// Its numbers where it is engaged.
        friction: DryFriction,
        /// u: factor on its forces, 0 where it is below; `None`: always 1.
        engagement: Option<WrittenLoad>,
    },
    /// `factor` times a function of displacement and speed of the node.
    Function {
        /// The force.
        function: Arc<dyn LoadFunction>,
        /// Factor on it.
        factor: f64,
    },
}

/// W₀ − k·φ − b·φ̇: what is constant, a spring, a damper, or all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearLoad {
    /// W₀.
    pub force: f64,
    /// k.
    pub rate: f64,
    /// b.
    pub damping: f64,
}

impl LoadLaw {
    /// True of a one-sided stop against the ground.
    pub fn is_stop(&self) -> bool {
        self.stop().is_some()
    }

    /// The one-sided stop that it is.
    pub fn stop(&self) -> Option<&Stop> {
        match self {
            Self::Stop(stop) => Some(stop),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Written(_)
            | Self::Dry { .. }
            | Self::Function { .. } => None,
        }
    }

    /// The expression that it is, or that it is engaged by.
    pub fn expression_load(&self) -> Option<&WrittenLoad> {
        match self {
            Self::Written(written) => Some(written),
            Self::Dry { engagement, .. } => engagement.as_ref(),
            Self::Linear(_) | Self::Pieces { .. } | Self::Stop(_) | Self::Function { .. } => None,
        }
    }

    /// The same, to be changed.
    pub(crate) fn written_mut(&mut self) -> Option<&mut WrittenLoad> {
        match self {
            Self::Written(written) => Some(written),
            Self::Dry { engagement, .. } => engagement.as_mut(),
            Self::Linear(_) | Self::Pieces { .. } | Self::Stop(_) | Self::Function { .. } => None,
        }
    }

    /// The track whose piece counts, by its index, and the pieces, of a force by pieces.
    pub fn pieces(&self) -> Option<(usize, &[LinearPiece])> {
        match self {
            Self::Pieces { track, pieces } => Some((*track, pieces)),
            Self::Linear(_)
            | Self::Stop(_)
            | Self::Written(_)
            | Self::Dry { .. }
            | Self::Function { .. } => None,
        }
    }

    /// The numbers of a spring to the ground; `None` of other laws.
    pub fn as_spring(&self) -> Option<&LinearLoad> {
        match self {
            Self::Linear(own) if own.rate != 0.0 => Some(own),
            _ => None,
        }
    }

    /// The same spring with a constant force more; of other laws nothing changes.
    #[must_use]
    pub fn spring_with(&self, force: f64) -> Self {
        match self.as_spring() {
            Some(own) => Self::Linear(LinearLoad {
                force: own.force + force,
                ..*own
            }),
            None => self.clone(),
        }
    }

    /// The track whose piece counts, of a force by pieces.
    pub fn track<'t>(&self, tracks: &'t [Track]) -> Option<&'t Track> {
        tracks.get(self.pieces()?.0)
    }

    /// True where it follows from the motion of its own node, whatever else it reads: not of a
    /// table, nor of an expression, which names all that it reads.
    pub fn needs_own_motion(&self) -> bool {
        match self {
            Self::Linear(_) | Self::Stop(_) | Self::Dry { .. } | Self::Function { .. } => true,
            Self::Pieces { .. } | Self::Written(_) => false,
        }
    }

    /// True where it is zero at all times.
    pub fn is_zero(&self) -> bool {
        match self {
            Self::Linear(own) => *own == LinearLoad::default(),
            Self::Pieces { pieces, .. } => {
                let acts = |piece: &LinearPiece| piece.value != 0.0 || piece.slope != 0.0;
                !pieces.iter().any(acts)
            }
            Self::Stop(_) => false,
            Self::Dry { friction, .. } => friction.static_limit == 0.0,
            Self::Written(written) => written.factor == 0.0,
            Self::Function { function, factor } => factor * function.magnitude() == 0.0,
        }
    }

    /// True where its numbers are what they may be.
    pub(crate) fn is_possible(&self) -> bool {
        let finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        match self {
            Self::Linear(own) => finite(&[own.force, own.rate, own.damping]),
            Self::Pieces { pieces, .. } => {
                let finite_piece =
                    |piece: &LinearPiece| finite(&[piece.start, piece.value, piece.slope]);
                !pieces.is_empty() && pieces.iter().all(finite_piece)
            }
            Self::Stop(stop) => {
                let side = stop.side.abs() == 1.0;
                let gives = stop.stiffness > 0.0 || stop.law.is_rigid();
                side && gives && finite(&[stop.at, stop.stiffness])
            }
            Self::Written(written) => finite(&[written.factor]),
            Self::Dry {
                friction,
                engagement,
            } => {
                let by = engagement.as_ref().map_or(1.0, |own| own.factor);
                friction.is_possible() && by.is_finite()
            }
            Self::Function { function, factor } => {
                let corners = function.corners();
                let ascending = corners.windows(2).all(|pair| pair[0].0 < pair[1].0);
                let stated = function.declared().is_none_or(|own| own.is_possible());
                ascending && stated && finite(&[*factor, function.magnitude()])
            }
        }
    }

    /// Its greatest magnitude while its node moves by `displacement` at up to `speed`, both as
    /// magnitudes; 0 of a stop, which presses no more than it is pressed, and of an expression,
    /// which is tried over all motions that it reads.
    pub(crate) fn greatest_magnitude(&self, displacement: f64, speed: f64) -> f64 {
        match self {
            // (A motor pulls most at rest.)
            Self::Linear(own) => match own.running_speed() {
                Some(_) => own.force.abs(),
                None => own.force.abs() + own.answer(displacement, speed),
            },
            Self::Pieces { pieces, .. } => {
                let values = pieces.iter().map(|piece| piece.value.abs());
                values.fold(0.0, f64::max)
            }
            Self::Dry { friction, .. } => friction.static_limit,
            Self::Stop(_) | Self::Written(_) => 0.0,
            Self::Function { function, factor } => (factor * function.magnitude()).abs(),
        }
    }

    /// The part of this magnitude with which it answers to the motion of its node: that of
    /// springs and dampers.
    pub(crate) fn answer(&self, displacement: f64, speed: f64) -> f64 {
        match self {
            Self::Linear(own) if own.running_speed().is_none() => own.answer(displacement, speed),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Stop(_)
            | Self::Written(_)
            | Self::Dry { .. }
            | Self::Function { .. } => 0.0,
        }
    }

    /// The same with tracks and nodes by other numbers, its own node being `own`; `None`: one
    /// that counts has none.
    pub(crate) fn renumbered(
        mut self,
        tracks: &[Option<usize>],
        nodes: &[Option<NodeIndex>],
        own: NodeIndex,
    ) -> Option<Self> {
        match &mut self {
            Self::Pieces { track, .. } => *track = tracks[*track]?,
            Self::Written(written)
            | Self::Dry {
                engagement: Some(written),
                ..
            } => {
                for (index, variable) in written.variables.iter_mut().enumerate() {
                    let read = written.expression.program().reads(index);
                    if let LoadVariable::Displacement(node) | LoadVariable::Speed(node) = variable {
                        // (What does not count may be anywhere.)
                        *node = if read { nodes[*node]? } else { own };
                    }
                }
            }
            Self::Linear(_) | Self::Stop(_) | Self::Dry { .. } | Self::Function { .. } => {}
        }
        Some(self)
    }

    /// True where it looks at the time.
    pub fn needs_time(&self, tracks: &[Track]) -> bool {
        match self {
            Self::Written(written)
            | Self::Dry {
                engagement: Some(written),
                ..
            } => written.needs_time(),
            Self::Pieces { track, .. } => {
                let track = tracks.get(*track);
                track.is_some_and(|track| track.source == TrackSource::Time)
            }
            Self::Linear(_) | Self::Stop(_) | Self::Dry { .. } | Self::Function { .. } => false,
        }
    }

    /// The nodes whose motion an expression reads; of other laws none: a table has its track.
    pub fn read_nodes(&self) -> Vec<NodeIndex> {
        match self {
            Self::Written(written)
            | Self::Dry {
                engagement: Some(written),
                ..
            } => written.nodes().collect(),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Stop(_)
            | Self::Dry { .. }
            | Self::Function { .. } => Vec::new(),
        }
    }

    /// The force on a node at a time; `None` of a stop, and where a motion is not known.
    fn force(
        &self,
        node: NodeIndex,
        time: f64,
        motion: impl Fn(NodeIndex) -> Option<(f64, f64)>,
        tracks: &[Track],
    ) -> Option<f64> {
        let (displacement, speed) = motion(node)?;
        match self {
            Self::Linear(own) => Some(own.force - own.rate * displacement - own.damping * speed),
            Self::Function { function, factor } => {
                Some(factor * function.force(displacement, speed).value)
            }
            Self::Written(written) => {
                let known = written.nodes().all(|node| motion(node).is_some());
                // What the expression does not read may be anything.
                let read = |node| motion(node).unwrap_or((0.0, 0.0));
                known.then(|| written.force(time, read))
            }
            Self::Pieces { track, pieces } => {
                let track = tracks.get(*track)?;
                let (x, sense) = match track.source {
                    TrackSource::Time => (time, 1.0),
                    TrackSource::Node(node) => motion(node)?,
                };
                let (index, shift) = track.breaks.piece(track.breaks.segment_at(x, sense));
                let piece = pieces.get(index.min(pieces.len().checked_sub(1)?))?;
                Some(piece.value + piece.slope * (x - shift - piece.start))
            }
            Self::Dry {
                friction,
                engagement,
            } => {
                let engaged = match engagement {
                    None => 1.0,
                    Some(written) => engaged_part(written, time, motion)?,
                };
                Some(engaged * friction.opposing(speed))
            }
            Self::Stop(_) => None,
        }
    }

    /// The dry friction that it is.
    pub fn dry_friction(&self) -> Option<&DryFriction> {
        match self {
            Self::Dry { friction, .. } => Some(friction),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Stop(_)
            | Self::Written(_)
            | Self::Function { .. } => None,
        }
    }

    /// A constant force.
    pub fn constant(force: f64) -> Self {
        Self::Linear(LinearLoad {
            force,
            ..LinearLoad::default()
        })
    }

    /// −preload − rate·φ.
    pub fn spring(rate: f64, preload: f64) -> Self {
        Self::Linear(LinearLoad {
            force: -preload,
            rate,
            ..LinearLoad::default()
        })
    }

    /// −damping·φ̇.
    pub fn viscous(damping: f64) -> Self {
        Self::Linear(LinearLoad {
            damping,
            ..LinearLoad::default()
        })
    }

    /// A function of displacement and speed.
    pub fn of(function: Arc<dyn LoadFunction>) -> Self {
        Self::Function {
            function,
            factor: 1.0,
        }
    }

    /// The force, where it is constant.
    pub fn as_constant(&self) -> Option<f64> {
        match self {
            Self::Linear(own) if own.rate == 0.0 && own.damping == 0.0 => Some(own.force),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Stop(_)
            | Self::Written(_)
            | Self::Dry { .. }
            | Self::Function { .. } => None,
        }
    }

    /// The function of the node's motion that it is.
    pub fn function(&self) -> Option<&dyn LoadFunction> {
        match self {
            Self::Function { function, .. } => Some(function.as_ref()),
            Self::Linear(_)
            | Self::Pieces { .. }
            | Self::Stop(_)
            | Self::Written(_)
            | Self::Dry { .. } => None,
        }
    }

    /// True for what a body at rest does not feel as it stands: viscous, friction and motor
    /// torques. (The damping of a stop counts as part of the stop.)
    pub fn needs_speed(&self) -> bool {
        match self {
            Self::Linear(own) => own.damping != 0.0,
            Self::Pieces { .. } | Self::Stop(_) => false,
            Self::Dry { .. } => true,
            Self::Written(written) => written.needs_speed(),
            Self::Function { function, .. } => function.needs_speed(),
        }
    }

    /// The speed that a motor with this torque runs at without load; `None`: it is no
    /// torque of a motor.
    pub fn running_speed(&self) -> Option<f64> {
        match self {
            Self::Linear(own) => own.running_speed(),
            Self::Function { function, .. } => function.running_speed(),
            Self::Pieces { .. } | Self::Stop(_) | Self::Written(_) | Self::Dry { .. } => None,
        }
    }

    /// Multiplies the force; a stop is moved.
    pub fn scale(&mut self, by: f64) {
        match self {
            Self::Linear(own) => {
                for part in [&mut own.force, &mut own.rate, &mut own.damping] {
                    *part *= by;
                }
            }
            Self::Pieces { pieces, .. } => {
                for piece in pieces {
                    piece.value *= by;
                    piece.slope *= by;
                }
            }
            Self::Stop(stop) => stop.at *= by,
            Self::Dry { friction, .. } => *friction = friction.scaled(by),
            Self::Written(written) => written.factor *= by,
            Self::Function { factor, .. } => *factor *= by,
        }
    }
}

/// The part of itself that a friction is engaged by at a time; `None`: a motion is not known.
fn engaged_part(
    written: &WrittenLoad,
    time: f64,
    motion: impl Fn(NodeIndex) -> Option<(f64, f64)>,
) -> Option<f64> {
    let known = written.nodes().all(|node| motion(node).is_some());
    let read = |node| motion(node).unwrap_or((0.0, 0.0));
    known.then(|| written.force(time, read).max(0.0))
}

impl LinearLoad {
    /// The magnitude of spring and damper over a displacement and a speed.
    fn answer(&self, displacement: f64, speed: f64) -> f64 {
        self.rate.abs() * displacement + self.damping.abs() * speed
    }

    /// The speed at which a torque that falls with the speed vanishes.
    pub fn running_speed(&self) -> Option<f64> {
        let falls = self.force != 0.0 && self.damping != 0.0 && self.rate == 0.0;
        falls.then(|| (self.force / self.damping).abs())
    }
}

/// A force written as an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenLoad {
    /// The expression.
    pub expression: Arc<Expression>,
    /// Factor on its value, which is then in N or N·m.
    pub factor: f64,
    /// What its variables are, in their order.
    pub variables: Vec<LoadVariable>,
}

/// A variable of a load by an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadVariable {
    /// t (s).
    Time,
    /// φ of a node (rad or m).
    Displacement(NodeIndex),
    /// φ̇ of a node (rad/s or m/s).
    Speed(NodeIndex),
}

impl WrittenLoad {
    /// The nodes whose motion it looks at.
    pub fn nodes(&self) -> impl Iterator<Item = NodeIndex> + '_ {
        let read = |index: usize| self.expression.program().reads(index);
        let nodes = self.variables.iter().enumerate();
        nodes.filter_map(move |(index, variable)| match *variable {
            LoadVariable::Displacement(node) | LoadVariable::Speed(node) if read(index) => {
                Some(node)
            }
            _ => None,
        })
    }

    /// The node whose motion a variable is; `None`: it is the time.
    pub fn node_of(&self, variable: usize) -> Option<NodeIndex> {
        match *self.variables.get(variable)? {
            LoadVariable::Displacement(node) | LoadVariable::Speed(node) => Some(node),
            LoadVariable::Time => None,
        }
    }

    /// True where it looks at the time.
    pub fn needs_time(&self) -> bool {
        let mut variables = self.variables.iter().enumerate();
        variables.any(|(index, variable)| {
            *variable == LoadVariable::Time && self.expression.program().reads(index)
        })
    }

    /// True where it looks at a speed.
    pub fn needs_speed(&self) -> bool {
        let mut variables = self.variables.iter().enumerate();
        variables.any(|(index, variable)| {
            matches!(variable, LoadVariable::Speed(_)) && self.expression.program().reads(index)
        })
    }

    /// The force at a time, where `motion` gives φ and φ̇ of a node.
    pub fn force(&self, time: f64, motion: impl Fn(NodeIndex) -> (f64, f64)) -> f64 {
        let values: Vec<f64> = (self.variables.iter())
            .map(|variable| match *variable {
                LoadVariable::Time => time,
                LoadVariable::Displacement(node) => motion(node).0,
                LoadVariable::Speed(node) => motion(node).1,
            })
            .collect();
        self.factor * self.expression.at(&values)
    }
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
