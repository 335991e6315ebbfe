//! Creep: regularised friction below its limit lets go on slowly what dry friction would
//! hold at rest.
//!
//! The samples of a run show it. The speed stays within the width of the regularisation for
//! much longer than a body takes to pass standstill, the friction bears a force, and no law
//! imposes the motion.

mod law;
mod own;

use crate::dynamics::model::Model;
use crate::dynamics::record::{CreepFigures, Quantity, Record};
use law::{Friction, Motion, State, frictions};
use own::Columns;
use std::ops::Range;

/// The width of a regularisation counts so many times: there the force is 0.995 of its limit.
const WIDTHS: f64 = 3.0;

/// Friction that bears less than this share of its limit decides nothing.
const LEAST_SHARE: f64 = 1e-3;

/// A stretch of the run is a creep from this share of it on, over so many samples.
const LEAST_TIME: f64 = 0.01;
const LEAST_SAMPLES: usize = 3;

/// A creep takes so many times as long as a body that passes standstill at the rate at
/// which the stretch is entered or left.
const PASSING: f64 = 10.0;

/// Two objects that slip by less than this share of their common speed are held together.
const HELD: f64 = 0.01;

/// True when an object may creep: then the samples of a run are looked at.
pub(in crate::studies) fn may_creep(model: &Model, object: usize) -> bool {
    !frictions(model, object).is_empty()
}

/// The longest creep of an object; `None`: it has none.
pub(in crate::studies) fn creep(
    model: &Model,
    record: &Record,
    object: usize,
) -> Option<CreepFigures> {
    let frictions = frictions(model, object);
    if frictions.is_empty() {
        return None;
    }
    let columns = Columns { model, record };
    let node = *model.objects[object].nodes.last()?;
    let own_speed = columns.of(node, Quantity::Speed)?;
    let found = frictions.into_iter().filter_map(|friction| {
        let motion = Motion::new(&columns, node, &friction)?;
        let is_creep = |stretch: &Range<usize>| {
            let nodes = std::iter::once(node).chain(friction.other_node());
            nodes.into_iter().any(|node| columns.is_own(node, stretch))
                && (friction.other_node().is_none()
                    || HELD * mean(&own_speed[stretch.clone()])
                        <= mean(&motion.speed[stretch.clone()]))
        };
        longest_creep(&friction, &motion, is_creep)
    });
    found.max_by(|a, b| (a.until - a.from).total_cmp(&(b.until - b.from)))
}

/// The longest creep under one friction, of the stretches that may be one.
fn longest_creep(
    friction: &Friction<'_>,
    motion: &Motion<'_>,
    may_be: impl Fn(&Range<usize>) -> bool,
) -> Option<CreepFigures> {
    let count = motion.speed.len().min(motion.times.len());
    let mut states: Vec<Option<State>> = (0..count).map(|k| friction.state(motion, k)).collect();
    for (state, speed) in states.iter_mut().zip(motion.speed.iter()) {
        *state = state.filter(|state| speed.abs() <= WIDTHS * state.width);
    }
    let mut best: Option<CreepFigures> = None;
    let mut from = None;
    for k in 0..=count {
        // A standstill bears nothing, and goes on what goes on around it.
        let within = k < count && (states[k].is_some() || motion.speed[k] == 0.0);
        match (within, from) {
            (true, None) => from = Some(k),
            (false, Some(first)) => {
                let found = creep_over_stretch(&states, motion, &(first..k))
                    .filter(|_| may_be(&(first..k)));
                best = [best, found].into_iter().flatten().max_by(|a, b| {
                    let [a, b] = [a, b].map(|own| own.until - own.from);
                    a.total_cmp(&b)
                });
                from = None;
            }
            (true, Some(_)) | (false, None) => {}
        }
    }
    best
}

/// The creep over a stretch of samples within the width, if it is one.
fn creep_over_stretch(
    states: &[Option<State>],
    motion: &Motion<'_>,
    range: &Range<usize>,
) -> Option<CreepFigures> {
    let (first, last) = (range.start, range.end - 1);
    let (from, until) = (motion.times[first], motion.times[last]);
    let whole = motion.times.last()? - motion.times.first()?;
    if range.len() < LEAST_SAMPLES || until - from < LEAST_TIME * whole {
        return None;
    }
    let share = |state: &State| state.force.abs() / state.limit;
    let late = (first + range.len() / 2)..range.end;
    let late = late.filter_map(|k| Some((motion.speed[k], states[k]?)));
    let (speed, state) = late.max_by(|a, b| share(&a.1).total_cmp(&share(&b.1)))?;
    if share(&state) < LEAST_SHARE {
        return None;
    }
    let edges = [
        (first > 0).then(|| [first - 1, first]),
        (range.end < motion.times.len().min(motion.speed.len())).then_some([last, range.end]),
    ];
    let passing = edges.into_iter().flatten().map(|[before, after]| {
        let change = (motion.speed[after] - motion.speed[before]).abs();
        let rate = change / (motion.times[after] - motion.times[before]);
        2.0 * WIDTHS * state.width / rate
    });
    let passing = passing.fold(0.0, f64::max);
    (until - from >= PASSING * passing).then(|| CreepFigures {
        speed,
        force: state.force.abs(),
        limit: state.limit,
        from,
        until,
    })
}

/// The mean magnitude of speeds.
fn mean(speeds: &[f64]) -> f64 {
    speeds.iter().map(|speed| speed.abs()).sum::<f64>() / speeds.len() as f64
}

#[cfg(test)]
#[path = "creep_tests.rs"]
mod tests;
