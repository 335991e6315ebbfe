//! The mechanism as if nothing gave way: strokes of the laws and the forces
//! that the pairs would have to carry.
//!
//! With every chain replaced by one rigid body of its inertia J, the pair of an
//! object must press its body along the law with
//!
//! P = J·a − W + Σ U′_j·P_j ,   a = U″φ̇² + U′φ̈ ,
//!
//! W its loads, j its followers. A force closure that opens towards positive
//! displacement can only give P ≥ 0, so that least P over a cycle is the margin
//! against lift-off of the rigid mechanism: zero on the line J* that is drawn
//! over maps. (For U = A·sin φ at constant speed Ω under a constant closing
//! moment M: P = M − J·A·Ω² at the peak, J* = M/(A·Ω²).)

use crate::model::{
    Closure, LoadLaw, Model, Node, NodeIndex, NodeMotion, ObjectPart, Pair, Track, TrackSource,
};
use crate::position::Position;
use crate::record::drive_cycle;

/// Instants looked at, over a cycle of the drive or the whole run.
const SAMPLES: usize = 128;

/// What the rigid mechanism would do.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidMotion {
    /// Half the stroke of each object's law, in the order of
    /// [`Model::objects`]; `None` for drives and for what grows with every turn.
    pub amplitude: Vec<Option<f64>>,
    /// Least force that a force-closed pair would have to carry (N m or N), over
    /// all of them: negative where the rigid mechanism lifts off. `None`
    /// without such a pair, behind a motor, with a linkage, beyond a dead
    /// position, or when a load hangs on the speed alone (motors).
    pub margin: Option<f64>,
}

/// Follows the rigid mechanism over one cycle of its drives, or over
/// `duration` (s) where there is no cycle; knows nothing behind motors.
pub fn rigid_motion(model: &Model, duration: f64) -> RigidMotion {
    let objects = &model.objects;
    let mut stroke = vec![[f64::INFINITY, f64::NEG_INFINITY]; objects.len()];
    let pairs: Vec<Option<Pair>> = objects.iter().map(|part| force_pair(model, part)).collect();
    let mut forces = vec![Vec::new(); objects.len()];
    let motor = |node: &Node| matches!(node.motion, NodeMotion::Rotor { .. });
    if model.nodes.iter().any(motor) {
        return RigidMotion {
            amplitude: vec![None; objects.len()],
            margin: None,
        };
    }
    let mut walk = Walk::new(model);
    let span = span(model, duration);
    for sample in 0..=SAMPLES {
        walk.go_to(span * sample as f64 / SAMPLES as f64);
        for (object, part) in objects.iter().enumerate() {
            let Some(&node) = part.nodes.first() else {
                continue;
            };
            let ([low, high], at) = (&mut stroke[object], walk.motion[node][0]);
            (*low, *high) = (low.min(at), high.max(at));
            if let Some(pair) = pairs[object] {
                forces[object].push(pair.opens * walk.force[node]);
            }
        }
    }
    let amplitude = |(object, part): (usize, &ObjectPart)| {
        let half = 0.5 * (stroke[object][1] - stroke[object][0]);
        let &node = part.nodes.first()?;
        (half.is_finite() && half > 0.0 && oscillates(model, node)).then_some(half)
    };
    let margins = forces.iter().filter(|forces| !forces.is_empty());
    // A margin that is no number must not vanish behind one that is.
    let margin = margins.map(|forces| least(forces));
    let margin = margin.reduce(|a, b| if a <= b || a.is_nan() { a } else { b });
    RigidMotion {
        amplitude: objects.iter().enumerate().map(amplitude).collect(),
        // What a linkage hands on to its driver is not followed here.
        margin: margin.filter(|margin| margin.is_finite() && model.linkages.is_empty()),
    }
}

/// How long the rigid mechanism is followed: a cycle, if all of it repeats.
fn span(model: &Model, duration: f64) -> f64 {
    let over_time = |track: &Track| track.source == TrackSource::Time;
    match drive_cycle(model) {
        Ok(cycle) if cycle <= duration && !model.tracks.iter().any(over_time) => cycle,
        _ => duration,
    }
}

/// The pair of an object when it is force-closed.
fn force_pair(model: &Model, part: &ObjectPart) -> Option<Pair> {
    model
        .pair(part)
        .filter(|pair| pair.closure == Closure::Force)
}

/// True when some law on the way from the drive is more than a plain ratio, so
/// that the displacement does not grow with every turn.
fn oscillates(model: &Model, node: NodeIndex) -> bool {
    match &model.nodes[node].motion {
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
            !matches!(law.position, Position::Ratio { .. }) || oscillates(model, law.driver)
        }
        NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => false,
    }
}

/// The rigid mechanism at an instant.
struct Walk<'m> {
    model: &'m Model,
    /// First mass of the object that each node belongs to.
    first: Vec<NodeIndex>,
    time: f64,
    /// φ, φ̇ and φ̈ of every node.
    motion: Vec<[f64; 3]>,
    /// U′ of every node's law.
    slope: Vec<f64>,
    /// P of every object, at its first node.
    force: Vec<f64>,
}

impl<'m> Walk<'m> {
    fn new(model: &'m Model) -> Self {
        let count = model.nodes.len();
        let mut first: Vec<NodeIndex> = (0..count).collect();
        for part in &model.objects {
            for &node in &part.nodes {
                first[node] = part.nodes[0];
            }
        }
        Self {
            model,
            first,
            time: 0.0,
            motion: vec![[0.0; 3]; count],
            slope: vec![0.0; count],
            force: vec![0.0; count],
        }
    }

    /// Moves everything to `time`.
    fn go_to(&mut self, time: f64) {
        self.time = time;
        for (node, at) in self.model.nodes.iter().enumerate() {
            self.motion[node] = match &at.motion {
                NodeMotion::Prescribed { motion, track } => {
                    let jet = motion.jet(self.segment(*track, time, 1.0), time);
                    [jet.value, jet.first, jet.second]
                }
                NodeMotion::Rotor { .. } => [f64::NAN; 3],
                // All masses of a chain follow the same law.
                _ if self.first[node] != node => self.motion[self.first[node]],
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    let [phi, speed, acceleration] = self.motion[law.driver];
                    let segment = self.segment(law.track, phi, speed);
                    let jet = law.position.jet(segment, phi).scaled(law.lever);
                    self.slope[node] = jet.first;
                    [
                        jet.value,
                        jet.first * speed,
                        jet.second * speed * speed + jet.first * acceleration,
                    ]
                }
            };
        }
        self.carry();
    }

    fn segment(&self, track: Option<usize>, x: f64, sense: f64) -> i64 {
        track.map_or(0, |track| self.model.tracks[track].breaks.locate(x, sense))
    }

    /// Gathers the forces from the last follower to the drives.
    fn carry(&mut self) {
        for (node, at) in self.model.nodes.iter().enumerate() {
            self.force[node] = at.inertia * self.motion[node][2];
        }
        for load in &self.model.loads {
            self.force[load.node] -= self.strength(&load.law, self.motion[load.node]);
        }
        // Drivers stand before what they drive, first masses before the others.
        for node in (0..self.model.nodes.len()).rev() {
            let force = self.force[node];
            match &self.model.nodes[node].motion {
                NodeMotion::Mass { .. } if self.first[node] != node => {
                    self.force[self.first[node]] += force;
                }
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    self.force[law.driver] += self.slope[node] * force;
                }
                NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
            }
        }
    }

    /// A load's force; not a number for motors.
    fn strength(&self, law: &LoadLaw, [displacement, speed, _]: [f64; 3]) -> f64 {
        match law {
            LoadLaw::Constant(force) => *force,
            LoadLaw::Pieces { track, pieces } => {
                let track = &self.model.tracks[*track];
                let (x, sense) = match track.source {
                    TrackSource::Time => (self.time, 1.0),
                    TrackSource::Node(node) => (self.motion[node][0], self.motion[node][1]),
                };
                let (index, shift) = track.breaks.piece(track.breaks.locate(x, sense));
                pieces.get(index).map_or(0.0, |piece| {
                    piece.value + piece.slope * (x - shift - piece.start)
                })
            }
            LoadLaw::Spring { rate, preload } => -preload - rate * displacement,
            LoadLaw::Viscous(damping) => -damping * speed,
            LoadLaw::Friction { force, width } => -force * (speed / width).tanh(),
            LoadLaw::LinearMotor { .. } | LoadLaw::Kloss { .. } | LoadLaw::SpeedTable(_) => {
                f64::NAN
            }
        }
    }
}

/// The least of samples, with the vertex of the parabola through the least one
/// and its neighbours; not a number when one of them is not.
fn least(samples: &[f64]) -> f64 {
    if samples.iter().any(|sample| sample.is_nan()) {
        return f64::NAN;
    }
    let by_value = |&a: &usize, &b: &usize| samples[a].total_cmp(&samples[b]);
    let Some(at) = (0..samples.len()).min_by(by_value) else {
        return f64::NAN;
    };
    if at == 0 || at + 1 == samples.len() {
        return samples[at];
    }
    let [before, here, after] = [samples[at - 1], samples[at], samples[at + 1]];
    let curvature = before - 2.0 * here + after;
    let slope = 0.5 * (after - before);
    // At a kink the neighbours fit no parabola: never below half a step's fall.
    if curvature > 0.0 && slope.abs() <= curvature {
        here - 0.5 * slope * slope / curvature
    } else {
        here
    }
}
