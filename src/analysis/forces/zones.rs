//! Where friction locks: intervals of the course, their ends bisected.

use super::row::{Row, Solver, Trouble};
use super::{Course, PositionSource};
use crate::linkage::kinetostatics::ForceFailure;
use crate::order::Total;

/// Bisections of an end.
const BISECTIONS: usize = 44;
/// Ratio, in parts of the greatest, at which the output stands still.
const STANDSTILL: f64 = 1e-9;
/// Where zones are looked for beside a reversal of the output, in steps of the
/// course.
const ASIDE: f64 = 1e-5;

/// An interval of the course in which something is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// What.
    pub kind: ZoneKind,
    /// Where it begins: input coordinate or time.
    pub from: f64,
    /// Where it ends; beyond the course's end where a closed course goes on
    /// from its beginning.
    pub to: f64,
}

/// What is wrong in a zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZoneKind {
    /// The load drives, but friction takes more than it gives: the output
    /// cannot drive the input.
    SelfLocking,
    /// No driving force moves the linkage: no reactions agree with their friction.
    Locked,
    /// The driver cannot balance the links: a dead position.
    Dead,
    /// The linkage cannot be assembled.
    OutOfReach,
    /// Anything else that left no forces.
    Failed,
}

impl ZoneKind {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::SelfLocking => "self_locking",
            Self::Locked => "locked",
            Self::Dead => "dead_position",
            Self::OutOfReach => "out_of_reach",
            Self::Failed => "failed",
        }
    }

    /// What it means, in a few words.
    pub fn words(self) -> &'static str {
        match self {
            Self::SelfLocking => "self-locking: the load cannot drive against friction",
            Self::Locked => "locked: no driving force overcomes friction",
            Self::Dead => "dead position",
            Self::OutOfReach => "cannot be assembled",
            Self::Failed => "no forces",
        }
    }
}

/// What is wrong at a position.
fn state(row: &Row) -> Option<ZoneKind> {
    match &row.forces {
        Err(Trouble::OutOfReach(_)) => Some(ZoneKind::OutOfReach),
        Err(Trouble::Failure(ForceFailure::SelfLocking { .. })) => Some(ZoneKind::Locked),
        Err(Trouble::Failure(ForceFailure::DeadPosition { .. })) => Some(ZoneKind::Dead),
        Err(Trouble::Failure(_)) => Some(ZoneKind::Failed),
        Ok(forces) => {
            let found = forces.transmission?;
            let direction = if row.motion.speed < 0.0 { -1.0 } else { 1.0 };
            let loss = forces.balance.loss;
            let locks = found.load_drives(direction) && loss > 0.0 && loss >= found.load_power;
            locks.then_some(ZoneKind::SelfLocking)
        }
    }
}

/// All zones of a course.
pub(super) fn find<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
) -> Vec<Zone> {
    let marks = marks(solver, course, rows);
    let mut zones: Vec<Zone> = Vec::new();
    let mut open: Option<(ZoneKind, f64)> = marks.first().and_then(|m| Some((m.1?, m.0)));
    for pair in marks.windows(2) {
        let [(p0, s0), (p1, s1)] = [pair[0], pair[1]];
        if s0 == s1 {
            continue;
        }
        let edge = bisect(solver, course, [p0, p1], s0);
        if let Some((kind, from)) = open.take() {
            zones.push(Zone {
                kind,
                from,
                to: edge[0],
            });
        }
        open = s1.map(|kind| (kind, edge[1]));
    }
    if let (Some((kind, from)), Some(last)) = (open, marks.last()) {
        zones.push(Zone {
            kind,
            from,
            to: last.0,
        });
    }
    join(zones, course, &marks)
}

/// Positions with their states: those of the course, its end, and, so that no
/// narrow zone is missed, places just before and after the output reverses.
fn marks<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
) -> Vec<(f64, Option<ZoneKind>)> {
    let mut places: Vec<(f64, &Row)> = rows
        .iter()
        .enumerate()
        .map(|(index, row)| (course.parameter(index), row))
        .collect();
    if let (Course::Even { .. }, Some(period), Some(first)) =
        (course, course.period(), rows.first())
    {
        places.push((course.parameter(0) + period, first));
    }
    let mut marks: Vec<_> = places
        .iter()
        .map(|(place, row)| (*place, state(row)))
        .collect();
    let greatest = rows
        .iter()
        .filter_map(ratio)
        .fold(0.0, |most: f64, i| most.max(i.abs()));
    for (index, pair) in places.windows(2).enumerate() {
        let [(low, before), (high, after)] = [pair[0], pair[1]];
        let (Some(a), Some(b)) = (ratio(before), ratio(after)) else {
            continue;
        };
        let rest = |i: f64| i.abs() <= STANDSTILL * greatest;
        let mut reversals = Vec::new();
        if rest(a) {
            reversals.push(low);
        } else if a * b < 0.0 && !rest(b) {
            reversals.push(reversal(solver, course, [low, high], a));
        }
        if rest(b) && index + 2 == places.len() {
            reversals.push(high);
        }
        let (first, last) = (places[0].0, places[places.len() - 1].0);
        let ends = [first.min(last), first.max(last)];
        for place in reversals {
            for side in [-ASIDE, ASIDE] {
                let near = place + side * (high - low);
                let near = if course.is_closed() {
                    around(near, ends)
                } else {
                    near
                };
                if (ends[0]..=ends[1]).contains(&near) {
                    marks.push((near, state(&solver.row(&course.between(near), false))));
                }
            }
        }
    }
    marks.sort_by_cached_key(|mark| Total(mark.0));
    marks
}

/// Kinematic ratio of the output at a row.
fn ratio(row: &Row) -> Option<f64> {
    let forces = row.forces.as_ref().ok()?;
    forces.transmission.map(|found| found.ratio)
}

/// A place beyond an end of a closed course comes in at the other.
fn around(place: f64, [first, last]: [f64; 2]) -> f64 {
    if place < first {
        place + (last - first)
    } else if place > last {
        place - (last - first)
    } else {
        place
    }
}

/// Where the sign of the ratio changes.
fn reversal<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    [mut low, mut high]: [f64; 2],
    sign: f64,
) -> f64 {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        let row = solver.row(&course.between(middle), false);
        if ratio(&row).is_some_and(|ratio| ratio * sign > 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Both sides of the place where a state ends.
fn bisect<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    [mut low, mut high]: [f64; 2],
    before: Option<ZoneKind>,
) -> [f64; 2] {
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if state(&solver.row(&course.between(middle), false)) == before {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, high]
}

/// On a closed course a zone at the end goes on at the beginning.
fn join(mut zones: Vec<Zone>, course: &Course, marks: &[(f64, Option<ZoneKind>)]) -> Vec<Zone> {
    let (Some(period), [first, .., last]) = (course.period(), marks) else {
        return zones;
    };
    let wraps = first.1.is_some() && first.1 == last.1;
    if wraps && zones.len() > 1 && zones.last().is_some_and(|zone| zone.to >= last.0) {
        let beginning = zones.remove(0);
        if let Some(end) = zones.last_mut() {
            end.to = beginning.to + period;
        }
    }
    zones
}
