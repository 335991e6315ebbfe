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

use crate::dynamics::model::{
    Closure, Load, Model, Node, NodeIndex, NodeMotion, ObjectPart, Pair, Track, TrackSource,
};
use crate::dynamics::record::drive_cycle;
use crate::dynamics::trajectory::{instant, transfer};
use crate::math::jet::Jet;
use crate::math::optimise::vertex;

/// Instants looked at, over a cycle of the drive or the whole run.
const SAMPLES: usize = 128;

/// Motion that the rigid mechanism would have.
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
    Path::new(model, duration).rigid_motion(model)
}

/// The motion of the rigid mechanism: what follows from its laws alone.
#[derive(Debug)]
pub(super) struct Path {
    /// φ, φ̇, φ̈ and U′ at every place over the instants; none behind motors. All
    /// masses of a chain stand on the place of the first.
    motions: Vec<Motion>,
    /// Place of every node.
    places: Vec<usize>,
    /// The first node of every place.
    heads: Vec<NodeIndex>,
    /// The instants (s).
    times: Vec<f64>,
    /// See [`RigidMotion::amplitude`].
    amplitude: Vec<Option<f64>>,
}

/// The motion at one place, a number an instant.
#[derive(Debug)]
struct Motion {
    /// φ.
    displacement: Vec<f64>,
    /// φ̇.
    speed: Vec<f64>,
    /// φ̈.
    acceleration: Vec<f64>,
    /// U′ of the law.
    slope: Vec<f64>,
}

impl Path {
    /// Follows the laws of a model.
    pub(super) fn new(model: &Model, duration: f64) -> Self {
        let (places, heads) = places(model);
        let mut path = Self {
            motions: Vec::with_capacity(heads.len()),
            places,
            heads,
            times: Vec::new(),
            amplitude: vec![None; model.objects.len()],
        };
        // What a motor turns is not known beforehand; sums of several inputs are left to
        // the run.
        let unknown = |node: &Node| {
            matches!(
                node.motion,
                NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. }
            )
        };
        if model.nodes.iter().any(unknown) {
            return path;
        }
        let span = span(model, duration);
        let times = (0..=SAMPLES).map(|sample| span * sample as f64 / SAMPLES as f64);
        path.times = times.collect();
        // Drivers stand before what they drive.
        for place in 0..path.heads.len() {
            let motion = path.motion_of_node(model, path.heads[place]);
            path.motions.push(motion);
        }
        for (object, part) in model.objects.iter().enumerate() {
            path.amplitude[object] = path.amplitude(model, part);
        }
        path
    }

    /// Numbers that it holds.
    pub(super) fn count_of_numbers(&self) -> usize {
        4 * self.motions.len() * self.times.len()
    }

    /// The motion of a node whose driver has been followed.
    fn motion_of_node(&self, model: &Model, node: NodeIndex) -> Motion {
        let at = |(place, &time): (usize, &f64)| match &model.nodes[node].motion {
            NodeMotion::Prescribed { motion, .. } => {
                let jet = instant(motion, time);
                [jet.value, jet.first, jet.second, 0.0]
            }
            NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => [f64::NAN; 4],
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let driver = &self.motions[self.places[law.driver]];
                let driver = Jet {
                    value: driver.displacement[place],
                    first: driver.speed[place],
                    second: driver.acceleration[place],
                    ..Jet::default()
                };
                let slope = transfer(model, law, driver.value, driver.first);
                let jet = slope.composed_with(driver);
                [jet.value, jet.first, jet.second, slope.first]
            }
        };
        let all: Vec<[f64; 4]> = self.times.iter().enumerate().map(at).collect();
        let column = |index: usize| all.iter().map(|row| row[index]).collect();
        Motion {
            displacement: column(0),
            speed: column(1),
            acceleration: column(2),
            slope: column(3),
        }
    }

    /// Half the stroke of an object.
    fn amplitude(&self, model: &Model, part: &ObjectPart) -> Option<f64> {
        let &node = part.nodes.first()?;
        let displacements = self.motions[self.places[node]].displacement.iter();
        let (low, high) = displacements.fold((f64::INFINITY, f64::NEG_INFINITY), |ends, &at| {
            (ends.0.min(at), ends.1.max(at))
        });
        let half = 0.5 * (high - low);
        (half.is_finite() && half > 0.0 && oscillates(model, node)).then_some(half)
    }

    /// The rigid mechanism of a model with these laws: the one that the path was
    /// made of, or with other inertias and loads.
    pub(super) fn rigid_motion(&self, model: &Model) -> RigidMotion {
        let mut margin: Option<f64> = None;
        let pairs = model.objects.iter();
        let mut pairs = pairs
            .filter_map(|part| Some((force_pair(model, part)?, *part.nodes.first()?)))
            .peekable();
        // What a linkage hands on to its driver is not followed here.
        if pairs.peek().is_some() && !self.times.is_empty() && model.linkages.is_empty() {
            let mut forces = self.forces_at_places(model);
            let count = self.times.len();
            for (pair, node) in pairs {
                let place = self.places[node];
                let own = &mut forces[place * count..][..count];
                own.iter_mut().for_each(|force| *force *= pair.opens);
                // A margin that is no number must not vanish behind one that is.
                let own = least(own);
                margin = match margin {
                    Some(other) if other <= own || other.is_nan() => Some(other),
                    _ => Some(own),
                };
            }
        }
        RigidMotion {
            amplitude: self.amplitude.clone(),
            margin: margin.filter(|margin| margin.is_finite()),
        }
    }

    /// The forces P at every place over the instants, gathered from the last
    /// follower to the drives.
    fn forces_at_places(&self, model: &Model) -> Vec<f64> {
        let count = self.times.len();
        let mut forces = vec![0.0; self.heads.len() * count];
        for (node, &place) in model.nodes.iter().zip(&self.places) {
            let own = forces[place * count..][..count].iter_mut();
            for (force, acceleration) in own.zip(&self.motions[place].acceleration) {
                *force += node.inertia * acceleration;
            }
        }
        for load in &model.loads {
            let place = self.places[load.node];
            let own = &mut forces[place * count..][..count];
            match load.law.as_constant() {
                Some(load) => own.iter_mut().for_each(|force| *force -= load),
                None => {
                    for (instant, force) in own.iter_mut().enumerate() {
                        *force -= self.strength(model, load, instant);
                    }
                }
            }
        }
        // Drivers stand before what they drive.
        for (place, &node) in self.heads.iter().enumerate().rev() {
            if let NodeMotion::Mass { law } | NodeMotion::Rigid { law } = &model.nodes[node].motion
            {
                let (before, own) = forces.split_at_mut(place * count);
                let driver = before[self.places[law.driver] * count..].iter_mut();
                let carried = own.iter().zip(&self.motions[place].slope);
                for (force, (own, slope)) in driver.zip(carried).take(count) {
                    *force += slope * own;
                }
            }
        }
        forces
    }

    /// A load's force at an instant.
    fn strength(&self, model: &Model, load: &Load, instant: usize) -> f64 {
        let at = |node: NodeIndex| {
            let motion = &self.motions[self.places[node]];
            (motion.displacement[instant], motion.speed[instant])
        };
        let at = |node| Some(at(node));
        // What a stop takes off a pair keeps no pair shut.
        let force = load.force(self.times[instant], at, &model.tracks);
        force.unwrap_or(0.0)
    }
}

/// Places of the nodes, and the first node of every place: all masses
/// of a chain follow the same law and share one.
fn places(model: &Model) -> (Vec<usize>, Vec<NodeIndex>) {
    let mut first: Vec<NodeIndex> = (0..model.nodes.len()).collect();
    for part in &model.objects {
        for &node in &part.nodes {
            first[node] = part.nodes[0];
        }
    }
    let (mut places, mut heads) = (Vec::with_capacity(first.len()), Vec::new());
    // First masses stand before the others.
    for (node, &first) in first.iter().enumerate() {
        if first == node {
            heads.push(node);
        }
        places.push(match first == node {
            true => heads.len() - 1,
            false => places[first],
        });
    }
    (places, heads)
}

/// Time for which the rigid mechanism is followed (s): a cycle, if all of it repeats.
fn span(model: &Model, duration: f64) -> f64 {
    let over_time = |track: &Track| track.source == TrackSource::Time;
    let of_time = |load: &Load| load.law.needs_time(&model.tracks);
    let timed = model.tracks.iter().any(over_time) || model.loads.iter().any(of_time);
    match drive_cycle(model) {
        Ok(cycle) if cycle <= duration && !timed => cycle,
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
            law.position.constant_ratio().is_none() || oscillates(model, law.driver)
        }
        NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => false,
        NodeMotion::Constrained { drivers, .. } => {
            drivers.iter().any(|&driver| oscillates(model, driver))
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
    // At a kink the neighbours fit no parabola; it falls by an eighth of their rise at most.
    let summit = vertex(&[(-1.0, -before), (0.0, -here), (1.0, -after)]);
    summit.map_or(here, |(_, value)| -value)
}
