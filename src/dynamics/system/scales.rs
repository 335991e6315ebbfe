//! Scales of the state: what size of error matters in each entry.
//!
//! The scale δ* of an object's deviation is the deflection under its loads and
//! the inertia load of its law, (ΣW + J·max|U″φ̇² + U′φ̈|)/c, at least its gap. Its
//! speed's scale is δ*·√(c/J). Of a body on a rigid contact they are the way and the speed of
//! its law. J is the sum of its masses, c the stiffness of
//! its links in series. Followers load it with what they carry, times U′.
//!
//! The greatest accelerations are those of the mechanism on its laws, sampled
//! along the drive's motion; a motor is taken at its no-load speed.

use super::constraints::ConstraintValues;
use super::frozen::{Chain, Frozen, FrozenLaw, Step};
use super::given::Motion;
use super::loads::FrozenLoad;
use super::multi::MultiWork;
use super::passes::{Extent, Work};
use crate::kinematics::motion::DriveMotion;
use std::f64::consts::PI;

/// Samples along a drive's motion, and its turns after the last break.
const SAMPLES: usize = 1024;
const TURNS: f64 = 8.0;

/// Time over which the speed of a motion by an expression is looked at (s), and at how many
/// places, spread by the golden ratio.
const WRITTEN_TIME: f64 = 10.0;
const WRITTEN_LOOKS: u32 = 64;
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Share of a limited reach at each end that is not sampled.
pub(super) const EDGE: f64 = 0.05;

/// δ* of an object that nothing loads (rad or m).
pub(super) const FLOOR: f64 = 1e-6;

/// Scale of a rotor's angle (rad).
const ROTOR_ANGLE: f64 = 1.0;

/// Greatest motions of one node over the samples.
#[derive(Clone, Copy, Debug, Default)]
struct Range {
    displacement: f64,
    speed: f64,
    acceleration: f64,
}

/// Scales of all 2n entries: > 0 and finite.
pub(super) fn scales(frozen: &Frozen, sampled: &MotionRanges) -> Vec<f64> {
    let n = frozen.coordinates;
    let mut scales = vec![1.0; 2 * n];
    let carried = carried_loads(frozen, sampled);
    for step in &frozen.steps {
        match step {
            Step::Prescribed(_) | Step::Rigid(_) | Step::Constrained(_) => {}
            Step::Chain(index) if frozen.chains[*index].contact.restitution().is_some() => {
                let chain = &frozen.chains[*index];
                let range = &sampled.ranges[chain.first_node];
                let gap = 2.0 * chain.contact.half_gap;
                let coordinate = chain.first_coordinate;
                scales[coordinate] = positive(range.displacement.max(gap), FLOOR);
                scales[n + coordinate] = positive(range.speed, FLOOR);
            }
            Step::Rotor(rotor) => {
                let speed = nominal_speed(frozen, rotor.node, rotor.speed);
                scales[rotor.coordinate] = frozen.input_length(rotor.node).unwrap_or(ROTOR_ANGLE);
                scales[n + rotor.coordinate] = positive(speed, 1.0);
            }
            Step::Chain(index) => {
                let chain = &frozen.chains[*index];
                let (displacement, speed) = chain_scales(frozen, chain, carried[chain.first_node]);
                for coordinate in chain.coordinates() {
                    scales[coordinate] = displacement;
                    scales[n + coordinate] = speed;
                }
            }
        }
    }
    scales
}

/// Lower bound of δ* of a chain: the deflection under its constant loads, or its gap.
/// Costs nothing, where δ* takes a thousand samples of the laws.
pub(super) fn least_deflection(frozen: &Frozen, chain: &Chain) -> f64 {
    let loads = &frozen.constant_force[chain.nodes()];
    let force: f64 = loads.iter().map(|force| force.abs()).sum();
    let (_, stiffness) = inertia_and_stiffness(frozen, chain);
    (force / stiffness).max(2.0 * chain.contact.half_gap)
}

/// δ* and its speed, from the force that link 1 carries.
fn chain_scales(frozen: &Frozen, chain: &Chain, force: f64) -> (f64, f64) {
    let (inertia, stiffness) = inertia_and_stiffness(frozen, chain);
    let gap = 2.0 * chain.contact.half_gap;
    let displacement = positive((force / stiffness).max(gap), FLOOR);
    let frequency = positive((stiffness / inertia).sqrt(), 1.0);
    (displacement, positive(displacement * frequency, FLOOR))
}

/// J and the series stiffness c of a chain.
pub(super) fn inertia_and_stiffness(frozen: &Frozen, chain: &Chain) -> (f64, f64) {
    let inertia: f64 = frozen.inertia[chain.nodes()].iter().sum();
    let flexibility = frozen.stiffness[chain.coordinates()]
        .iter()
        .map(|c| 1.0 / c);
    (inertia, 1.0 / flexibility.sum::<f64>())
}

fn positive(value: f64, otherwise: f64) -> f64 {
    if value > 0.0 && value.is_finite() {
        value
    } else {
        otherwise
    }
}

/// Force magnitudes that each node carries on to its driver: its loads, its
/// inertia load and what its followers carry.
fn carried_loads(frozen: &Frozen, sampled: &MotionRanges) -> Vec<f64> {
    let MotionRanges {
        ranges,
        slopes,
        gradients,
        linkages,
        given_time: _,
    } = sampled;
    let mut carried: Vec<f64> = frozen
        .constant_force
        .iter()
        .map(|force| force.abs())
        .collect();
    let mut answering = vec![0.0; carried.len()];
    for load in &frozen.loads {
        let force = match &load.written {
            Some(written) if load.dry.is_none() => written.magnitude(|node| {
                let range = &ranges[node];
                [range.displacement, range.speed]
            }),
            _ => magnitude(load, &ranges[load.node]),
        };
        let force = if force.is_finite() { force } else { 0.0 };
        // What only answers to the motion cannot deflect a chain by more than its law moves.
        let answer = answer(load, force, &ranges[load.node]).clamp(0.0, force);
        carried[load.node] += force - answer;
        answering[load.node] += answer;
    }
    for (node, range) in ranges.iter().enumerate() {
        carried[node] += frozen.inertia[node] * range.acceleration;
    }
    for (linkage, force) in frozen.linkages.iter().zip(linkages) {
        carried[linkage.node] += force;
    }
    for step in frozen.steps.iter().rev() {
        match step {
            Step::Prescribed(_) | Step::Rotor(_) => {}
            Step::Rigid(index) => {
                let rigid = frozen.rigids[*index];
                let (driver, slope) = (frozen.laws[rigid.law].driver, slopes[rigid.law]);
                carried[driver] += slope * carried[rigid.node];
                answering[driver] += slope * answering[rigid.node];
            }
            Step::Chain(index) => {
                let chain = &frozen.chains[*index];
                let loads: f64 = carried[chain.nodes()].iter().sum();
                let answers: f64 = answering[chain.nodes()].iter().sum();
                let (_, stiffness) = inertia_and_stiffness(frozen, chain);
                let way = ranges[chain.first_node].displacement;
                let total = loads + answers.min(stiffness * way);
                carried[chain.first_node] = total;
                carried[frozen.laws[chain.law].driver] += slopes[chain.law] * total;
            }
            Step::Constrained(index) => {
                let constrained = &frozen.constraints[*index];
                let (force, answer) = (carried[constrained.node], answering[constrained.node]);
                for (&driver, slope) in constrained.drivers.iter().zip(&gradients[*index]) {
                    carried[driver] += slope * force;
                    answering[driver] += slope * answer;
                }
            }
        }
    }
    carried
}

/// The part of a load's magnitude, `all`, with which it answers to a node's motion: that of
/// springs and dampers.
fn answer(load: &FrozenLoad, all: f64, range: &Range) -> f64 {
    if let Some(written) = load.written.as_ref().filter(|_| load.dry.is_none()) {
        // What it is beyond its force at rest comes of the motion.
        return all - written.magnitude(|_| [0.0; 2]);
    }
    load.law.answer(range.displacement, range.speed)
}

/// Greatest magnitude of a load over a node's motion.
fn magnitude(load: &FrozenLoad, range: &Range) -> f64 {
    load.law.greatest_magnitude(range.displacement, range.speed)
}

/// The speed that a motor runs at: its no-load or synchronous speed, the
/// fastest of its table, or the given one; with a constant torque alone, the
/// speed that its own rotor reaches in one turn from rest.
fn nominal_speed(frozen: &Frozen, node: usize, given: f64) -> f64 {
    let loads = frozen.loads.iter().filter(|load| load.node == node);
    let of_motor = |load: &FrozenLoad| load.law.running_speed().unwrap_or(0.0);
    let speed = loads.map(of_motor).fold(given.abs(), f64::max);
    if speed > 0.0 {
        return speed;
    }
    // What an expression drives it with within a turn, at rest.
    let own = |load: &&FrozenLoad| load.node == node && load.dry.is_none();
    let written = frozen.loads.iter().filter(own);
    let written = written.filter_map(|load| load.written.as_ref());
    let written: f64 = written.map(|own| own.magnitude(|_| [PI, 0.0])).sum();
    let force = frozen.constant_force[node].abs() + written;
    (4.0 * PI * force / carried_inertia(frozen, node)).sqrt()
}

/// Inertia of a rotor with that of all that follows it rigidly at t = 0 when it
/// drives a linkage; else its own.
fn carried_inertia(frozen: &Frozen, node: usize) -> f64 {
    let own = frozen.inertia[node];
    if frozen.linkages.is_empty() {
        return own;
    }
    let (mut modes, mut work) = (frozen.no_modes(), Work::new(frozen));
    let state = frozen.law_state();
    frozen.locate_tracks(&state, &mut modes);
    frozen.motion(0.0, &state, &modes, Extent::Full, &mut work);
    frozen.reduce_rigid(Extent::Full, &mut work);
    if work.mass[node] > 0.0 {
        work.mass[node]
    } else {
        own
    }
}

/// Greatest values over samples of the motion of the drives.
#[derive(Debug)]
pub(crate) struct MotionRanges {
    /// |φ|, |φ̇|, |φ̈| of every node on its law.
    ranges: Vec<Range>,
    /// |U′| of every law.
    slopes: Vec<f64>,
    /// |∂G/∂φᵢ| of every constraint.
    gradients: Vec<Vec<f64>>,
    /// Force magnitudes that each linkage takes at its input.
    linkages: Vec<f64>,
    /// The least time (s) in which what follows prescribed drives rigidly turns by a radian of
    /// its usual motion.
    pub(super) given_time: f64,
}

/// The least time in which a sampled motion turns by a radian of its fastest change (s);
/// infinite where none is accelerated.
pub(super) fn quickest(sampled: &MotionRanges) -> f64 {
    let moving = sampled
        .ranges
        .iter()
        .filter(|range| range.acceleration > 0.0);
    let times = moving.map(|range| range.speed / range.acceleration);
    times
        .filter(|&time| time > 0.0)
        .fold(f64::INFINITY, f64::min)
}

/// Samples the laws along the motion of the drives.
pub(super) fn sample(frozen: &Frozen) -> MotionRanges {
    let mut ranges = vec![Range::default(); frozen.inertia.len()];
    let mut slopes = vec![0.0; frozen.laws.len()];
    let mut constraints: Vec<ConstraintValues<f64>> = (frozen.constraints.iter())
        .map(ConstraintValues::new)
        .collect();
    let mut gradients: Vec<Vec<f64>> = (frozen.constraints.iter())
        .map(|one| vec![0.0; one.drivers.len()])
        .collect();
    let mut linkages = vec![0.0f64; frozen.linkages.len()];
    let memory = frozen.linkage_memory();
    let mut multi: Vec<MultiWork<f64>> = frozen.multi.iter().map(MultiWork::new).collect();
    let mut motion = vec![[0.0; 3]; frozen.inertia.len()];
    let mut given: Vec<(usize, Motion)> = (frozen.rigid_given.iter())
        .map(|&node| (node, Motion::default()))
        .collect();
    for sample in 0..=SAMPLES {
        let share = sample as f64 / SAMPLES as f64;
        for step in &frozen.steps {
            match step {
                Step::Prescribed(drive) => {
                    motion[drive.node] = drive_sample(drive, share, frozen.horizon);
                }
                Step::Rotor(rotor) => {
                    let speed = nominal_speed(frozen, rotor.node, rotor.speed);
                    let way = (TURNS * 2.0 * PI).min(speed * frozen.horizon);
                    let angle = rotor.angle + way * share;
                    motion[rotor.node] = [angle, speed, 0.0];
                }
                Step::Rigid(index) => {
                    let rigid = frozen.rigids[*index];
                    let (at, slope) = law_sample(frozen, &frozen.laws[rigid.law], &motion);
                    motion[rigid.node] = at;
                    slopes[rigid.law] = slope.max(slopes[rigid.law]);
                }
                Step::Chain(index) => {
                    let chain = &frozen.chains[*index];
                    let (at, slope) = law_sample(frozen, &frozen.laws[chain.law], &motion);
                    motion[chain.nodes()].fill(at);
                    slopes[chain.law] = slope.max(slopes[chain.law]);
                }
                Step::Constrained(index) => {
                    let (own, values) = (&frozen.constraints[*index], &mut constraints[*index]);
                    motion[own.node] = match own.multi {
                        None => values.sample(own, &motion),
                        Some(place) => frozen.sample_multi(place, values, &mut multi, &motion),
                    };
                    for (slope, first) in gradients[*index].iter_mut().zip(&values.first) {
                        *slope = slope.max(first.abs());
                    }
                }
            }
        }
        for (index, solved) in memory.iter().enumerate() {
            let force = solved
                .borrow_mut()
                .magnitude(motion[frozen.linkages[index].node]);
            linkages[index] = linkages[index].max(force);
        }
        for (node, seen) in &mut given {
            seen.include(&motion[*node]);
        }
        for (range, at) in ranges.iter_mut().zip(&motion) {
            // NaN, outside the reach of a law, is passed over by `max`.
            range.displacement = range.displacement.max(at[0].abs());
            range.speed = range.speed.max(at[1].abs());
            range.acceleration = range.acceleration.max(at[2].abs());
        }
    }
    MotionRanges {
        ranges,
        slopes,
        gradients,
        linkages,
        given_time: (given.into_iter())
            .map(|(_, seen)| seen.time())
            .fold(f64::INFINITY, f64::min),
    }
}

/// A drive's motion up to a horizon (s): half of the samples up to its last break, half over
/// [`TURNS`] turns after it.
fn drive_sample(drive: &super::frozen::PrescribedNode, share: f64, horizon: f64) -> [f64; 3] {
    let breaks = drive.motion.breaks();
    let last = breaks.points.last().map_or(0.0, |last| last.max(0.0));
    let last = last.min(horizon);
    let at = |time: f64| {
        let jet = drive.motion.jet(breaks.segment_at(time, 1.0), time);
        [jet.value, jet.first, jet.second]
    };
    if last > 0.0 && share < 0.5 {
        return at(2.0 * share * last);
    }
    let share = if last > 0.0 { 2.0 * share - 1.0 } else { share };
    let speed = match drive.motion {
        // It may be at rest anywhere, and what it does far away is not known.
        DriveMotion::Written(_) => (0..WRITTEN_LOOKS)
            .map(|look| last + WRITTEN_TIME * (f64::from(look) * GOLDEN).fract())
            .map(|time| at(time)[1].abs())
            .filter(|speed| speed.is_finite())
            .fold(0.0, f64::max),
        DriveMotion::Constant { .. }
        | DriveMotion::Accelerated { .. }
        | DriveMotion::RunUp { .. }
        | DriveMotion::Plan(_)
        | DriveMotion::LawRunUp(_)
        | DriveMotion::Table(_) => at(last)[1].abs(),
    };
    let span = match (&drive.motion, speed > 0.0) {
        (DriveMotion::Written(_), false) => WRITTEN_TIME,
        (_, true) => TURNS * 2.0 * PI / speed,
        (_, false) => 0.0,
    };
    at(last + share * span.min(horizon - last))
}

/// φ, φ̇ and φ̈ that a law asks for, and |U′|; NaN and 0 beyond its reach, and
/// near the ends of it, where U″ grows beyond all bounds.
fn law_sample(frozen: &Frozen, law: &FrozenLaw, motion: &[[f64; 3]]) -> ([f64; 3], f64) {
    let [displacement, speed, acceleration] = motion[law.driver];
    let inside = match law.position.reach_from(displacement) {
        Ok(None) => displacement.is_finite(),
        Ok(Some((low, high))) => {
            let margin = EDGE * (high - low);
            low + margin <= displacement && displacement <= high - margin
        }
        Err(_) => false,
    };
    if !inside {
        return ([f64::NAN; 3], 0.0);
    }
    // Laws without break points look at no modes.
    let mut modes = Vec::new();
    if let Some(component) = law.component {
        modes.resize(frozen.contacts() + frozen.tracks.len(), 0);
        let track = &frozen.tracks[component - frozen.contacts()];
        modes[component] = track.breaks.segment_at(displacement, speed);
    }
    let jet = law.jet(&modes, displacement);
    let at = [
        jet.value,
        jet.first * speed,
        jet.second * speed * speed + jet.first * acceleration,
    ];
    (
        at,
        if jet.first.is_finite() {
            jet.first.abs()
        } else {
            0.0
        },
    )
}
