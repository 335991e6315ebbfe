//! The periodic motion of an elastic scene behind prescribed drives: shooting.

use super::answer::DriveFigures;
use super::cycle::Rhythms;
use super::map::{Map, SystemMap, TreeMap};
use super::multipliers::{self, Multiplier, Stability};
use super::over_period::{OverPeriod, RETURN};
use super::shooting::{self, CLOSED, FixedPoint, relative_distance, shoot_near};
use crate::dynamics::integrate::{Dynamics, Method};
use crate::dynamics::model::{Coordinate, Model};
use crate::dynamics::record::drive_cycle;
use crate::dynamics::system::System;
use crate::exact::Parts;
use crate::fault::Fault;
use crate::frontend::scene::SteadySpec;
use crate::studies::check::{Check, worst};
use crate::studies::judgement::{Judgement, RunEnd};
use crate::studies::method::choose_general;
use crate::studies::{Control, RunSettings};
use serde::Serialize;
use std::f64::consts::TAU;

/// The periodic motion of an elastic scene.
#[derive(Clone, Debug, Serialize)]
pub struct PeriodicAnswer {
    /// The angle of the drive after which the machine repeats, by its ratios (rad).
    pub cycle: f64,
    /// Time for that angle (s).
    pub turn: f64,
    /// Figures of how the drive turns, where a motor drives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drive: Option<DriveFigures>,
    /// The parts that move independently of each other.
    pub parts: Vec<PartMotion>,
    /// State y = [u, u̇] of the whole system at t = 0 of the periodic motion.
    pub state: Vec<f64>,
    /// Names of the entries of `state`.
    pub state_names: Vec<String>,
    /// What happens over a period of the whole.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over_period: Option<OverPeriod>,
    /// Why that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over_period_missing: Option<String>,
}

impl PeriodicAnswer {
    /// The checks of the answer, with their bounds.
    pub fn checks(&self) -> Vec<Check> {
        let returns = self.parts.iter().map(|part| part.miss);
        let mut checks = vec![Check {
            name: "return of the state after a period",
            value: worst(returns),
            bound: CLOSED,
        }];
        match &self.over_period {
            Some(found) => checks.extend(found.checks.iter().cloned()),
            // What cannot be integrated is confirmed by nothing.
            None => checks.push(Check {
                name: "return of the state by integration",
                value: f64::NAN,
                bound: RETURN,
            }),
        }
        checks
    }

    /// The first part on whose motion the scene does not settle from its own start: another
    /// motion may be its steady one.
    pub fn unsettled(&self) -> Option<&PartMotion> {
        self.parts.iter().find(|part| !part.long_run.settles)
    }

    /// The verdict: small disturbances leave the motion, or a pair opens over the period. A
    /// motion on which the scene does not settle is not certified.
    pub fn judgement(&self) -> Judgement {
        let any = |stability| self.parts.iter().any(|part| part.stability == stability);
        Judgement::judge_result(RunEnd::Complete, &self.checks(), || {
            let pairs = self.over_period.as_ref().map(|found| found.pairs);
            match pairs.unwrap_or(Judgement::NotJudged) {
                _ if any(Stability::Repels) => Judgement::NotInWorkingOrder,
                Judgement::InWorkingOrder
                    if any(Stability::Undecided) || self.unsettled().is_some() =>
                {
                    Judgement::NotJudged
                }
                pairs => pairs,
            }
        })
    }

    /// True when all checks are passed.
    pub fn is_trusted(&self) -> bool {
        self.checks().iter().all(Check::passed)
    }

    /// With what happens over a period, integrated from the state found.
    pub(super) fn with_period_results(
        self,
        system: &System,
        method: Method,
        control: &Control<'_>,
        period: f64,
    ) -> Self {
        let greatest = self.parts.iter().flat_map(|part| part.multipliers.first());
        let greatest = greatest.map(|one| one.modulus).fold(1.0, f64::max);
        match OverPeriod::of(system, method, *control, &self.state, (period, greatest)) {
            Ok(found) => Self {
                over_period: Some(found),
                ..self
            },
            Err(why) => Self {
                over_period_missing: Some(why),
                ..self
            },
        }
    }
}

/// The periodic motion of one part.
#[derive(Clone, Debug, Serialize)]
pub struct PartMotion {
    /// Objects of the part.
    pub objects: Vec<String>,
    /// Cycles of the drive in a period.
    pub periods: usize,
    /// The period (s).
    pub period: f64,
    /// |y(T) − y(0)| relative to the sizes of the state's entries.
    pub miss: f64,
    /// Floquet multipliers, the greatest modulus first.
    pub multipliers: Vec<Multiplier>,
    /// Stability: what becomes of small disturbances.
    pub stability: Stability,
    /// Periods followed in finding it.
    pub iterations: u32,
    /// Way in which the derivative of the motion was found.
    pub how: String,
    /// Second way, by which the errors of the multipliers are estimated.
    pub checked_by: String,
    /// Unit of the deviations.
    pub unit: String,
    /// Deviations from the law over the period: name and (t, value).
    pub orbit: Vec<Orbit>,
    /// Whether a long run from the scene's own start settles on it.
    pub long_run: LongRun,
}

/// The name of a coordinate and its (t, value) over a period.
pub type Orbit = (String, Vec<(f64, f64)>);

/// A run of many periods from the scene's start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LongRun {
    /// Cycles of the drive: turns where it repeats after one.
    pub turns: usize,
    /// Distance of its end from the periodic motion, relative to the sizes of
    /// the state's entries.
    pub distance: f64,
    /// True when it has settled on it.
    pub settles: bool,
    /// Why it could not be made.
    pub missing: Option<String>,
}

/// A long run has settled within this distance.
const SETTLED: f64 = 1e-6;
/// Turns of a long run, at least and at most.
const LONG: [usize; 2] = [50, 1000];

/// A long run from the scene's start, against the periodic motion.
fn long_run(
    map: &dyn Map,
    start: &[f64],
    fixed: &FixedPoint,
    turn: f64,
    periods: usize,
) -> LongRun {
    let slowest = multipliers::greatest(&fixed.monodromy);
    let needed = if slowest > 0.0 && slowest < 1.0 {
        (1e-13f64.ln() / slowest.ln()).ceil() * periods as f64
    } else {
        0.0
    };
    let turns = (needed.min(1e6) as usize)
        .clamp(LONG[0], LONG[1])
        .div_ceil(periods)
        * periods;
    let found = map.apply(start, turns as f64 * turn).and_then(|end| {
        // It may have settled on the same motion some turns later.
        let mut state = fixed.state.clone();
        let mut nearest = f64::INFINITY;
        for _ in 0..periods {
            nearest = nearest.min(relative_distance(&end, &state, map.scales()));
            state = map.apply(&state, turn)?;
        }
        Ok(nearest)
    });
    match found {
        Ok(distance) => LongRun {
            turns,
            distance,
            settles: distance <= SETTLED,
            missing: None,
        },
        Err(why) => LongRun {
            turns,
            distance: f64::NAN,
            settles: false,
            missing: Some(why),
        },
    }
}

/// Points of an orbit.
pub(super) const ORBIT: usize = 720;

/// Deviations over the period.
fn orbit(map: &dyn Map, state: &[f64], period: f64, about: &About) -> Result<Vec<Orbit>, String> {
    let found = map.orbit(state, period, ORBIT)?;
    let named = about.names.iter().zip(found.columns).enumerate();
    Ok(named
        .map(|(index, (name, values))| {
            let rest = found.times.iter().copied().zip(values);
            let points = std::iter::once((0.0, state[index])).chain(rest);
            (name.clone(), points.collect())
        })
        .collect())
}

/// What a part is called.
pub(super) struct About {
    objects: Vec<String>,
    /// Of its coordinates.
    names: Vec<String>,
    unit: String,
}

impl About {
    /// Of some of a system's objects and coordinates.
    pub(super) fn new(system: &System, objects: &[usize], coordinates: &[usize]) -> Self {
        let part = |&object: &usize| &system.model().objects[object];
        let any = |coordinate: Coordinate| {
            let mut parts = objects.iter().map(part);
            parts.any(|part| part.coordinate == coordinate)
        };
        let unit = match (any(Coordinate::Turning), any(Coordinate::Sliding)) {
            (true, true) => "",
            (false, true) => "m",
            _ => "rad",
        };
        let name = |&index: &usize| system.state_name(index).replace(": displacement", "");
        Self {
            objects: objects
                .iter()
                .map(|object| part(object).id.clone())
                .collect(),
            names: coordinates.iter().map(name).collect(),
            unit: unit.to_owned(),
        }
    }

    /// Of everything elastic, without the coordinate of a drive.
    pub(super) fn of_all(system: &System, drive: Option<usize>) -> Self {
        let elastic = |&object: &usize| system.first_coordinate(object).is_some();
        let objects: Vec<usize> = (0..system.model().objects.len()).filter(elastic).collect();
        let others = (0..system.coordinates()).filter(|&one| Some(one) != drive);
        Self::new(system, &objects, &others.collect::<Vec<_>>())
    }
}

/// No periodic motion was found.
pub(super) fn no_periodic_motion(why: &str) -> Vec<Fault> {
    let message = format!("no periodic motion was found: {why}");
    let hint = "allow more turns of the drive in a period with `periods`; a drive that stalls \
                needs a stronger motor, more inertia, a start at more speed, or less load";
    vec![Fault::new("steady", message, hint)]
}

/// The periodic motion of a part, of as few cycles as possible.
pub(super) fn periodic_motion_of_part(
    map: &dyn Map,
    start: &[f64],
    turn: f64,
    most: usize,
    about: &About,
) -> Result<(PartMotion, Vec<f64>), String> {
    part_near(map, start, None, turn, most, about)
}

/// The same, where a state is known that comes back after a cycle.
pub(super) fn part_near(
    map: &dyn Map,
    start: &[f64],
    known: Option<&[f64]>,
    turn: f64,
    most: usize,
    about: &About,
) -> Result<(PartMotion, Vec<f64>), String> {
    let mut reasons = Vec::new();
    let mut unstable = None;
    for periods in 1..=most {
        let period = turn * periods as f64;
        let known = known.filter(|_| periods == 1);
        match shoot_near(map, start, known, turn, periods) {
            Ok(fixed) => {
                let multipliers =
                    multipliers::of(&fixed.monodromy, &map.check(&fixed.state, period)?);
                let stability = Stability::of(&multipliers);
                let motion = PartMotion {
                    objects: about.objects.clone(),
                    unit: about.unit.clone(),
                    orbit: orbit(map, &fixed.state, period, about)?,
                    periods,
                    period: map.duration(&fixed.state, period)?,
                    miss: fixed.miss,
                    multipliers,
                    stability,
                    iterations: fixed.iterations,
                    how: map.derivative_method().to_owned(),
                    checked_by: map.derivative_check().to_owned(),
                    long_run: long_run(map, start, &fixed, turn, periods),
                };
                if stability != Stability::Repels {
                    return Ok((motion, fixed.state));
                }
                unstable = unstable.or(Some((motion, fixed.state)));
            }
            Err(why) => reasons.push(format!("period {periods}: {why}")),
        }
    }
    unstable.ok_or_else(|| reasons.join("; "))
}

/// What has no effect where the motions of all drives are prescribed.
fn refuse_unused(spec: &SteadySpec) -> Result<(), Vec<Fault>> {
    let given = [
        (spec.mean_speed.is_some(), "mean_speed"),
        (spec.fluctuation.is_some(), "fluctuation"),
        (spec.balance, "balance"),
    ];
    let fault = |(_, name): &(bool, &str)| {
        let message = format!("`{name}` has no effect: the motions of the drives are prescribed");
        let hint = "leave it out, or give the drive a `motor` in place of its motion";
        Fault::new(format!("steady.{name}"), message, hint)
    };
    let faults: Vec<Fault> = given
        .iter()
        .filter(|(given, _)| *given)
        .map(fault)
        .collect();
    match faults.is_empty() {
        true => Ok(()),
        false => Err(faults),
    }
}

/// The angle of the drive after which everything repeats, a multiple of `least` (rad), and the
/// time for it (s).
pub(super) fn whole_cycle(model: &Model, least: f64) -> Result<(f64, f64), Vec<Fault>> {
    let once = drive_cycle(model).map_err(|why| {
        let message = format!("the motion of the drives does not repeat: {why}");
        let hint = "a drive with a constant `speed`";
        vec![Fault::new("steady", message, hint)]
    })?;
    let cycle = Rhythms::of_all(model, TAU / once).whole_cycle(least)?;
    Ok((cycle, once * cycle / TAU))
}

/// A state y = [u, u̇] at t = 0 that comes back after the cycle of prescribed drives, and the time
/// of that cycle (s): where the motion is linear the only one, whatever the scene's start.
///
/// # Errors
/// The drives do not repeat, there is no start, or no such state was found.
pub(super) fn recurring_state(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<(Vec<f64>, f64), Vec<Fault>> {
    let (_, turn) = whole_cycle(system.model(), TAU)?;
    let mut state = system.initial_state()?.y;
    let parts = Parts::of(system);
    let of_map = |map: &dyn Map, start: &[f64]| {
        let found =
            shooting::fixed_point_near(map, start, turn).map_err(|why| no_periodic_motion(&why))?;
        found.ok_or_else(|| no_periodic_motion("Newton's method comes to none"))
    };
    if parts.is_whole() {
        for tree in &parts.trees {
            let (q, v) = tree.own_state(&state);
            let (masses, start) = (q.len(), [q, v].concat());
            let map = TreeMap::new(tree, &start, turn, *control)
                .map_err(|why| no_periodic_motion(&why))?;
            let found = of_map(&map, &start)?;
            tree.put_state(&found[..masses], &found[masses..], &mut state);
        }
    } else if !state.is_empty() {
        let method = choose_general(system, settings, "").method;
        state = of_map(&SystemMap::new(system, method, *control), &state)?;
    }
    Ok((state, turn))
}

/// The periodic motion of an elastic scene behind prescribed drives.
///
/// # Errors
/// The drives do not repeat, there is no start, or no periodic motion was found.
pub(super) fn answer(
    system: &System,
    settings: &RunSettings,
    spec: &SteadySpec,
    control: &Control<'_>,
) -> Result<PeriodicAnswer, Vec<Fault>> {
    let none = |why: String| no_periodic_motion(&why);
    refuse_unused(spec)?;
    let (cycle, turn) = whole_cycle(system.model(), spec.cycle)?;
    let initial = system.initial_state()?;
    let parts = Parts::of(system);
    let mut state = initial.y.clone();
    let mut motions = Vec::new();
    if parts.is_whole() {
        for tree in &parts.trees {
            let (q, v) = tree.own_state(&initial.y);
            let (masses, start) = (q.len(), [q, v].concat());
            let map = TreeMap::new(tree, &start, turn, *control).map_err(none)?;
            let coordinates: Vec<usize> = tree.coordinates().collect();
            let about = About::new(system, &tree.objects, &coordinates);
            let (motion, found) =
                periodic_motion_of_part(&map, &start, turn, spec.periods, &about).map_err(none)?;
            motions.push(motion);
            tree.put_state(&found[..masses], &found[masses..], &mut state);
        }
    } else {
        let choice = choose_general(system, settings, "");
        let map = SystemMap::new(system, choice.method, *control);
        let about = About::of_all(system, None);
        let (motion, found) =
            periodic_motion_of_part(&map, &initial.y, turn, spec.periods, &about).map_err(none)?;
        motions.push(motion);
        state = found;
    }
    let together = motions.iter().map(|part| part.periods).fold(1, lcm);
    let answer = PeriodicAnswer {
        cycle,
        turn,
        drive: None,
        parts: motions,
        state_names: state_names(system),
        state,
        over_period: None,
        over_period_missing: None,
    };
    let method = choose_general(system, settings, "").method;
    Ok(answer.with_period_results(system, method, control, turn * together as f64))
}

/// Least common multiple.
fn lcm(a: usize, b: usize) -> usize {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    a / x.max(1) * b
}

/// Names of the entries of a state.
pub(super) fn state_names(system: &System) -> Vec<String> {
    let entries = 0..2 * system.coordinates();
    entries.map(|index| system.state_name(index)).collect()
}

#[cfg(test)]
mod tests {
    use super::PeriodicAnswer;

    #[test]
    fn a_period_that_cannot_be_integrated_is_not_to_be_trusted() {
        let answer = PeriodicAnswer {
            cycle: 1.0,
            turn: 1.0,
            drive: None,
            parts: Vec::new(),
            state: Vec::new(),
            state_names: Vec::new(),
            over_period: None,
            over_period_missing: Some("it stopped".to_owned()),
        };
        assert!(!answer.is_trusted());
        let failures: Vec<_> = answer
            .checks()
            .iter()
            .filter_map(|one| one.failure())
            .collect();
        assert_eq!(failures.len(), 1, "{failures:?}");
        assert!(failures[0].contains("return of the state by integration"));
    }
}
