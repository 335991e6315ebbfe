//! How far and how fast the objects go as long as each follows its law.

use crate::dynamics::model::{Coordinate, Model, NodeMotion};
use crate::dynamics::record::drive_cycle;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::{Constraint, ConstraintJet};
use crate::kinematics::motion::DriveMotion;
use crate::math::jet::Jet;
use std::f64::consts::TAU;

/// Instants looked at in a whole run, and as many in its first cycle.
const INSTANTS: usize = 180;

/// No displacement at all.
pub(super) const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Way of a node over a run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NodePath {
    /// Least and greatest displacement (rad or m).
    pub(super) displacement: [f64; 2],
    /// Greatest |φ̇|.
    pub(super) fastest: f64,
    /// Mean square of φ̇.
    pub(super) mean_square_speed: f64,
    /// Mean square of φ̈.
    pub(super) mean_square_acceleration: f64,
}

/// Stretch of time over which a way is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stretch {
    /// The run.
    Run,
    /// As long as it takes to go through every law, though the run be shorter: what
    /// stands in a dwell meanwhile is no less a part of the machine.
    Whole,
}

/// Assumption about the motion of a motor's rotor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rotors {
    /// Nobody knows before the run.
    Unknown,
    /// Evenly through many turns: what follows has its share of that motion.
    Even,
}

/// Turns of a rotor that is taken to turn evenly: many, so that what is geared down
/// goes through its law, and no whole number, so that every place of it is met.
const TURNS: f64 = 37.3;

/// The ways of the objects' last nodes, which is what others follow; `None` for other
/// nodes, where the motion is not known, and where nothing is a number.
pub(super) fn node_paths(
    model: &Model,
    duration: f64,
    stretch: Stretch,
    rotors: Rotors,
) -> Vec<Option<NodePath>> {
    let duration = match stretch {
        Stretch::Run => duration,
        Stretch::Whole => drive_durations(model).fold(duration, f64::max),
    };
    let instants = sampling_instants(model, duration);
    let mut followed = vec![false; model.nodes.len()];
    for &node in model.objects.iter().filter_map(|part| part.nodes.last()) {
        followed[node] = true;
    }
    let mut motions: Vec<Option<Vec<Jet>>> = Vec::with_capacity(model.nodes.len());
    for (node, followed) in model.nodes.iter().zip(followed) {
        let motion = match &node.motion {
            _ if !followed => None,
            NodeMotion::Rotor { .. } => (rotors == Rotors::Even).then(|| {
                let speed = TURNS * TAU / duration;
                let at = |&time: &f64| Jet {
                    value: speed * time,
                    first: speed,
                    ..Jet::default()
                };
                instants.iter().map(at).collect()
            }),
            NodeMotion::Prescribed { motion, .. } => {
                let breaks = motion.breaks();
                let at = |&time: &f64| motion.jet(breaks.segment_at(time, 1.0), time);
                Some(instants.iter().map(at).collect())
            }
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let driver = motions.get(law.driver).and_then(Option::as_ref);
                let breaks = law.position.breaks();
                driver.map(|driver| {
                    let follow = |jet: &Jet| {
                        let law_jet = law.position.jet(segment_of_jet(&breaks, jet), jet.value);
                        driven_motion(law_jet, jet, law.lever)
                    };
                    driver.iter().map(follow).collect()
                })
            }
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => {
                let each = drivers.iter().map(|&driver| motions[driver].as_deref());
                each.collect::<Option<Vec<&[Jet]>>>()
                    .map(|each| constrained_motion(constraint, &each))
            }
        };
        motions.push(motion);
    }
    let way = |motion: Option<Vec<Jet>>| motion.and_then(|motion| NodePath::of(&motion));
    motions.into_iter().map(way).collect()
}

fn segment_of_jet(breaks: &Breaks, jet: &Jet) -> i64 {
    breaks.segment_at(jet.value, jet.first)
}

/// The motion λ·U(φ) of what follows φ, without the third derivative.
fn driven_motion(law: Jet, driver: &Jet, lever: f64) -> Jet {
    Jet {
        value: lever * law.value,
        first: lever * law.first * driver.first,
        second: lever * (law.second * driver.first * driver.first + law.first * driver.second),
        third: 0.0,
    }
}

/// The motion G(φ₁, …, φₖ) behind several drivers, without the third derivative.
fn constrained_motion(constraint: &Constraint, drivers: &[&[Jet]]) -> Vec<Jet> {
    let mut law = ConstraintJet::new(drivers.len());
    let instants = drivers.first().map_or(0, |first| first.len());
    let at = |instant: usize| {
        let now: Vec<Jet> = drivers.iter().map(|driver| driver[instant]).collect();
        let places: Vec<f64> = now.iter().map(|jet| jet.value).collect();
        constraint.jet(&places, &mut law);
        let terms = now.iter().zip(&law.first);
        let [first, mut second] = terms.fold([0.0; 2], |[v, a], (jet, slope)| {
            [v + slope * jet.first, a + slope * jet.second]
        });
        for (row, one) in law.second.chunks(now.len()).zip(&now) {
            for (bend, other) in row.iter().zip(&now) {
                second += bend * one.first * other.first;
            }
        }
        Jet {
            value: law.value,
            first,
            second,
            third: 0.0,
        }
    };
    (0..instants).map(at).collect()
}

fn sampling_instants(model: &Model, duration: f64) -> Vec<f64> {
    let even = |end: f64| (0..=INSTANTS).map(move |index| end * index as f64 / INSTANTS as f64);
    match drive_cycle(model) {
        Ok(cycle) if cycle < duration => even(cycle).chain(even(duration)).collect(),
        _ => even(duration).collect(),
    }
}

/// How long each prescribed drive takes for all that it does (s): many turns where it
/// turns on and on.
fn drive_durations(model: &Model) -> impl Iterator<Item = f64> {
    let drives = model.objects.iter().filter(|part| part.is_drive());
    drives.filter_map(|part| {
        let NodeMotion::Prescribed { motion, .. } = &model.nodes[part.nodes[0]].motion else {
            return None;
        };
        let breaks = motion.breaks();
        let last = breaks.points.last().copied().unwrap_or(0.0);
        let end = breaks.period.unwrap_or(last);
        let goes_on = matches!(
            motion,
            DriveMotion::Constant { .. } | DriveMotion::RunUp { .. } | DriveMotion::LawRunUp(_)
        );
        let turns = match goes_on && part.coordinate == Coordinate::Turning {
            true => TURNS * TAU / motion.jet(breaks.segment_at(end, 1.0), end).first.abs(),
            false => 0.0,
        };
        Some(end + turns).filter(|time| time.is_finite())
    })
}

impl NodePath {
    fn of(motion: &[Jet]) -> Option<Self> {
        let numbers = |jet: &&Jet| {
            [jet.value, jet.first, jet.second]
                .iter()
                .all(|v| v.is_finite())
        };
        let mut way = Self {
            displacement: NOWHERE,
            fastest: 0.0,
            mean_square_speed: 0.0,
            mean_square_acceleration: 0.0,
        };
        let mut count = 0.0;
        for jet in motion.iter().filter(numbers) {
            widen_range(&mut way.displacement, jet.value);
            way.fastest = way.fastest.max(jet.first.abs());
            way.mean_square_speed += jet.first * jet.first;
            way.mean_square_acceleration += jet.second * jet.second;
            count += 1.0;
        }
        way.mean_square_speed /= count;
        way.mean_square_acceleration /= count;
        (count > 0.0).then_some(way)
    }
}

/// Widens a range so that it holds a value; what is no number is not taken.
pub(super) fn widen_range(range: &mut [f64; 2], value: f64) {
    *range = [range[0].min(value), range[1].max(value)];
}
