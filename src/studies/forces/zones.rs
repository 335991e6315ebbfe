//! Where friction locks: intervals of the course between roots of what decides.
//!
//! The course is scanned at places of its own, whatever positions are asked for: in equal
//! steps, at singular positions of the linkage, and on both sides of places where the output
//! turns back. Between two places that differ the change is closed in by bisection, and
//! whatever lies between is told apart; between two that agree the least distance from a
//! change is looked for.

use super::ends;
use super::row::{Row, Solver, Trouble};
use super::scan::{scan, singular_places};
use super::{Course, PositionSource};
use crate::kinematics::linkage::kinetostatics::{BAD_CONDITION, ForceFailure};
use crate::math::optimise::golden;
use crate::math::order::Total;
use crate::math::roots::{BISECTIONS, bisect};
use crate::studies::endless::{places_towards_end, unbounded};

/// Ratio, in parts of the greatest, at which the output stands still.
const STANDSTILL: f64 = 1e-9;
/// Where zones are looked for beside a reversal of the output or a singular position, in
/// steps of the scan.
const ASIDE: f64 = 1e-5;
/// Most changes between two places of the scan.
const MOST_CHANGES: usize = 16;
/// Steps of the search for the least distance from a change, each a golden section.
const SEARCH: u32 = 30;
/// A zone of this part of the course is none.
const NO_ZONE: f64 = 1e-9;

/// An interval of the course in which something is wrong; a dead-centre position that is
/// passed at once is an interval of no width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// Kind of zone.
    pub kind: ZoneKind,
    /// Start of the zone: input coordinate or time, the lesser end.
    pub from: f64,
    /// End of the zone.
    pub to: f64,
    /// Whether forces grow without bound towards its beginning from below, and towards its
    /// end from above.
    pub unbounded: [bool; 2],
}

/// Kind of a zone: what is wrong in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZoneKind {
    /// The load drives, but friction takes more than it gives: the output
    /// cannot drive the input.
    SelfLocking,
    /// No driving force moves the linkage: no reactions agree with their friction.
    Locked,
    /// The driver cannot balance the links: a dead-centre position.
    Dead,
    /// The linkage cannot be assembled.
    OutOfReach,
    /// Anything else that left no forces.
    Failed,
}

impl ZoneKind {
    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::SelfLocking => "self_locking",
            Self::Locked => "locked",
            Self::Dead => "dead_position",
            Self::OutOfReach => "out_of_reach",
            Self::Failed => "failed",
        }
    }

    /// Meaning in a few words.
    pub fn words(self) -> &'static str {
        match self {
            Self::SelfLocking => "self-locking: the load cannot drive against friction",
            Self::Locked => "locked: no driving force overcomes friction",
            Self::Dead => "dead-centre position",
            Self::OutOfReach => "cannot be assembled",
            Self::Failed => "no forces",
        }
    }
}

/// Kind of the zone that a position belongs to.
fn state(row: &Row) -> Option<ZoneKind> {
    match &row.forces {
        Err(Trouble::OutOfReach(_)) => Some(ZoneKind::OutOfReach),
        Err(Trouble::Failure(ForceFailure::SelfLocking { .. })) => Some(ZoneKind::Locked),
        Err(Trouble::Failure(ForceFailure::DeadPosition { .. }) | Trouble::EndOfReach) => {
            Some(ZoneKind::Dead)
        }
        Err(Trouble::Failure(_)) => Some(ZoneKind::Failed),
        Ok(forces) if forces.solved.condition.is_some_and(|c| c > BAD_CONDITION) => {
            Some(ZoneKind::Dead)
        }
        Ok(forces) => {
            let found = forces.transmission?;
            let direction = if row.motion.speed < 0.0 { -1.0 } else { 1.0 };
            let loss = forces.balance.loss;
            let locks = found.load_drives(direction) && loss > 0.0 && loss >= found.load_power;
            locks.then_some(ZoneKind::SelfLocking)
        }
    }
}

/// A place of the course and what is wrong there.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mark {
    place: f64,
    state: Option<ZoneKind>,
    /// Kinematic ratio of the output.
    ratio: Option<f64>,
    /// Distance from a change of the state, dimensionless: 0 where it changes.
    ease: f64,
}

/// All zones of a course, ascending.
pub(super) fn find<S: PositionSource>(solver: &mut Solver<'_, S>, course: &Course) -> Vec<Zone> {
    let mut scanner = Scanner { solver, course };
    let Some(marks) = scanner.marks() else {
        return zone_of_position(solver, course).into_iter().collect();
    };
    let mut zones: Vec<Zone> = Vec::new();
    let mut open = marks[0].state.map(|kind| (kind, marks[0].place));
    let mut close = |open: &mut Option<(ZoneKind, f64)>, to: f64| {
        if let Some((kind, from)) = open.take() {
            zones.push(Zone {
                kind,
                from,
                to,
                unbounded: [false; 2],
            });
        }
    };
    for pair in marks.windows(2) {
        for change in scanner.changes(pair[0], pair[1]) {
            close(&mut open, change.before);
            open = change.state.map(|kind| (kind, change.after));
        }
    }
    let (first, last) = (marks[0].place, marks[marks.len() - 1].place);
    close(&mut open, last);
    let narrow = NO_ZONE * (last - first);
    zones.retain(|zone| zone.kind == ZoneKind::Dead || zone.to - zone.from > narrow);
    let ends = scanner.limits(&mut zones, [first, last]);
    for index in 0..zones.len() {
        let (free, kind) = (free_sides(&zones, index, ends), zones[index].kind);
        if kind != ZoneKind::SelfLocking {
            let ends = [zones[index].from, zones[index].to];
            zones[index].unbounded = [0, 1].map(|side| scanner.grows(ends[side], free[side]));
        }
    }
    zones
}

/// The zone of a single position at a dead-centre position that ends the reach.
fn zone_of_position<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
) -> Option<Zone> {
    let at = course.instant(0).motion.coordinate;
    let end = solver.limits().into_iter().find(|end| end.is_at(at))?;
    let place = course.place_of(0, &end);
    let grows = unbounded(&ends::sizes(&ends::rows_towards_end(
        solver, course, place,
    )?));
    Some(Zone {
        kind: ZoneKind::Dead,
        from: place,
        to: place,
        unbounded: [end.other < end.at, end.at < end.other].map(|side| side && grows),
    })
}

/// How far there are forces below and above a zone: to the next that has none. Where
/// friction only locks the load, there are forces.
pub(super) fn free_sides(zones: &[Zone], index: usize, [first, last]: [f64; 2]) -> [f64; 2] {
    let blocked = |zone: &&Zone| zone.kind != ZoneKind::SelfLocking;
    let below = zones[..index].iter().rev().find(blocked);
    let above = zones[index + 1..].iter().find(blocked);
    [
        below.map_or(first, |zone| zone.to),
        above.map_or(last, |zone| zone.from),
    ]
}

/// A change of the state between two places next to each other.
struct Change {
    before: f64,
    after: f64,
    state: Option<ZoneKind>,
}

struct Scanner<'s, 'k, S> {
    solver: &'s mut Solver<'k, S>,
    course: &'s Course,
}

impl<S: PositionSource> Scanner<'_, '_, S> {
    fn row(&mut self, place: f64) -> Row {
        self.solver.row(&self.course.instant_at(place), false)
    }

    fn mark_at(&mut self, place: f64) -> Mark {
        let row = self.row(place);
        Mark {
            place,
            state: state(&row),
            ratio: ratio(&row),
            ease: ease(&row),
        }
    }

    /// Adds the dead-centre positions at the end of the reach to which the course comes, where there is
    /// no zone yet. How far the zones are looked at.
    fn limits(&self, zones: &mut Vec<Zone>, [first, last]: [f64; 2]) -> [f64; 2] {
        for end in self.solver.limits() {
            for [from, to] in ends::dwells_at_end(self.course, &end) {
                // (The dead-centre position may lie just beyond the course.)
                let [low, high] = [from, to].map(|place| place.clamp(first, last));
                if zones.iter().all(|zone| zone.to < low || high < zone.from) {
                    zones.push(Zone {
                        kind: ZoneKind::Dead,
                        from,
                        to,
                        unbounded: [false; 2],
                    });
                }
            }
        }
        zones.sort_by_cached_key(|zone| Total(zone.from));
        let [low, high] = [zones.first(), zones.last()];
        [
            low.map_or(first, |zone| first.min(zone.from)),
            high.map_or(last, |zone| last.max(zone.to)),
        ]
    }

    /// Places with their states, ascending; `None` for a course without length.
    fn marks(&mut self) -> Option<Vec<Mark>> {
        let places = scan(self.course)?;
        let step = (places[places.len() - 1] - places[0]) / (places.len() - 1) as f64;
        let ends = [places[0], places[places.len() - 1]];
        let mut marks: Vec<Mark> = places.iter().map(|&place| self.mark_at(place)).collect();
        let special = singular_places(self.solver, self.course, &places);
        let mut aside: Vec<f64> = special.clone();
        let greatest = marks.iter().filter_map(|mark| mark.ratio);
        let greatest = greatest.fold(0.0, |most: f64, ratio| most.max(ratio.abs()));
        for reversal in special.into_iter().chain(self.reversals(&marks, greatest)) {
            for side in [-ASIDE, ASIDE] {
                let near = reversal + side * step;
                let near = match self.course.is_closed() {
                    true => wrap_into_course(near, ends),
                    false => near,
                };
                if (ends[0]..=ends[1]).contains(&near) {
                    aside.push(near);
                }
            }
        }
        marks.extend(aside.into_iter().map(|place| self.mark_at(place)));
        marks.sort_by_cached_key(|mark| Total(mark.place));
        let nearest = self.marks_nearest_to_change(&marks);
        marks.extend(nearest);
        marks.sort_by_cached_key(|mark| Total(mark.place));
        Some(marks)
    }

    /// Places where the output turns back.
    fn reversals(&mut self, marks: &[Mark], greatest: f64) -> Vec<f64> {
        let mut reversals = Vec::new();
        let rest = |ratio: f64| ratio.abs() <= STANDSTILL * greatest;
        for pair in marks.windows(2) {
            let (Some(a), Some(b)) = (pair[0].ratio, pair[1].ratio) else {
                continue;
            };
            if rest(a) {
                reversals.push(pair[0].place);
            } else if a * b < 0.0 && !rest(b) {
                let ends = [pair[0].place, pair[1].place];
                reversals.push(self.reversal(ends, a));
            }
        }
        if let Some(last) = marks.last().filter(|mark| mark.ratio.is_some_and(rest)) {
            reversals.push(last.place);
        }
        reversals
    }

    /// Place where the sign of the ratio changes.
    fn reversal(&mut self, ends: [f64; 2], sign: f64) -> f64 {
        let [_, reversal] = bisect(ends, BISECTIONS, |place| {
            ratio(&self.row(place)).is_some_and(|ratio| ratio * sign > 0.0)
        });
        reversal
    }

    /// Places between free ones that are the nearest to a change, where they are beyond it.
    fn marks_nearest_to_change(&mut self, marks: &[Mark]) -> Vec<Mark> {
        let mut found = Vec::new();
        for three in marks.windows(3) {
            let [before, here, after] = [three[0], three[1], three[2]];
            let lowest = here.ease <= before.ease && here.ease <= after.ease;
            let level = here.ease == before.ease && here.ease == after.ease;
            let free = three.iter().all(|mark| mark.state.is_none());
            if free && lowest && !level {
                found.extend(self.mark_of_least_ease(before.place, after.place));
            }
        }
        found
    }

    /// The place of least ease, once it is not free.
    fn mark_of_least_ease(&mut self, low: f64, high: f64) -> Option<Mark> {
        let mut found = None;
        let mut lack = |place: f64| {
            // Once there is one, the search may end.
            if found.is_some() {
                return f64::NEG_INFINITY;
            }
            let mark = self.mark_at(place);
            found = mark.state.is_some().then_some(mark);
            -mark.ease
        };
        golden(&mut lack, [low, high], SEARCH);
        found
    }

    /// All changes between two places.
    fn changes(&mut self, mut low: Mark, high: Mark) -> Vec<Change> {
        let mut changes = Vec::new();
        while low.state != high.state && changes.len() < MOST_CHANGES {
            let [before, after] = self.bisect(low, high);
            changes.push(Change {
                before: before.place,
                after: after.place,
                state: after.state,
            });
            low = after;
        }
        changes
    }

    /// Both sides of the place where the state of the first place ends.
    fn bisect(&mut self, low: Mark, high: Mark) -> [Mark; 2] {
        let mut marks = [low, high];
        bisect([low.place, high.place], BISECTIONS, |place| {
            let mark = self.mark_at(place);
            let same = mark.state == low.state;
            marks[usize::from(!same)] = mark;
            same
        });
        marks
    }

    /// Whether forces grow without bound from a free place towards an end.
    fn grows(&mut self, end: f64, free: f64) -> bool {
        free != end && {
            let rows = rows_towards(self.solver, self.course, [end, free], false);
            unbounded(&ends::sizes(&rows))
        }
    }
}

/// Rows ever nearer to an end from a free place. At a dead-centre position that ends the reach they go
/// there by the input coordinate: a motion over time may stop short of it.
pub(super) fn rows_towards<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    [end, free]: [f64; 2],
    full: bool,
) -> [Row; 4] {
    let dead = ends::rows_towards_end(solver, course, end);
    let along = |place| solver.row(&course.instant_at(place), full);
    dead.unwrap_or_else(|| places_towards_end(end, free).map(along))
}

/// How far a free position is from one that locks: what is left of the power of a load that
/// drives, in parts of all that flows.
fn ease(row: &Row) -> f64 {
    let Ok(forces) = &row.forces else { return 0.0 };
    let balance = &forces.balance;
    let flow = balance.drive.abs() + balance.forces.abs() + balance.loss;
    let through = match flow > 0.0 {
        true => 1.0 - balance.loss / flow,
        false => 1.0,
    };
    let Some(found) = forces.transmission else {
        return through;
    };
    let direction = if row.motion.speed < 0.0 { -1.0 } else { 1.0 };
    let sum = found.load_power.abs() + balance.loss;
    if found.load_drives(direction) && sum > 0.0 {
        through.min((found.load_power - balance.loss) / sum)
    } else {
        through
    }
}

/// Kinematic ratio of the output at a row.
fn ratio(row: &Row) -> Option<f64> {
    let forces = row.forces.as_ref().ok()?;
    forces.transmission.map(|found| found.ratio)
}

/// A place beyond an end of a closed course comes in at the other.
fn wrap_into_course(place: f64, [first, last]: [f64; 2]) -> f64 {
    if place < first {
        place + (last - first)
    } else if place > last {
        place - (last - first)
    } else {
        place
    }
}
