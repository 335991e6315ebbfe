//! Least and greatest values over what is free, between the positions too.

use super::columns::Column;
use super::row::{Row, Solver};
use super::scan::table_places;
use super::zones::{Zone, ZoneKind, free_sides, rows_towards};
use super::{Course, PositionSource};
use crate::math::optimise::golden;
use crate::studies::endless::unbounded;

/// Steps of golden section: the place to about 10⁻⁸ of a step of the course.
const STEPS: u32 = 38;

/// A value and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value, in the column's unit; infinite where it grows without bound towards a
    /// position without forces.
    pub value: f64,
    /// The course's parameter there: input coordinate or time.
    pub at: f64,
}

/// Least and greatest value of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    /// The quantity's name.
    pub name: String,
    /// Unit of the value.
    pub unit: String,
    /// The least value.
    pub least: Extreme,
    /// The greatest value.
    pub greatest: Extreme,
}

/// Positions below which a course is looked at between them as well.
const FEW: usize = 360;

/// Extremes of all figures of a course over what is free, and the derivatives of the driving
/// force that have none.
pub(super) fn find<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
    zones: &[Zone],
    all: &[Column],
) -> (Vec<Extremes>, Vec<(String, f64)>) {
    let samples = samples(solver, course, rows);
    let edges = edges_of_zones(solver, course, zones);
    let mut seeker = Seeker {
        solver,
        course,
        samples: &samples,
        blocked: zones
            .iter()
            .filter(|zone| zone.kind != ZoneKind::SelfLocking)
            .map(|zone| [zone.from, zone.to])
            .collect(),
        edges: &edges,
    };
    let figures = all.iter().filter(|column| column.figure);
    let extremes = figures.filter_map(|column| {
        Some(Extremes {
            name: column.name.clone(),
            unit: column.unit.clone(),
            least: seeker.extreme(column, -1.0)?,
            greatest: seeker.extreme(column, 1.0)?,
        })
    });
    let extremes = extremes.collect();
    let changes = all.iter().filter(|column| column.name.contains("_by."));
    let endless = changes.filter_map(|column| {
        let ends = [1.0, -1.0].map(|sign| seeker.unbounded_position(column, sign));
        let at = ends.into_iter().flatten().next()?;
        Some((column.name.clone(), at))
    });
    (extremes, endless.collect())
}

/// A row and its place on the course.
type Sample = (f64, Row);

/// The rows, and where these are few, rows between them; ascending.
fn samples<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
) -> Vec<Sample> {
    let own = rows.iter().enumerate();
    let mut samples: Vec<Sample> = own
        .map(|(index, row)| (course.parameter(index), row.clone()))
        .collect();
    if let (true, Some([from, to])) = (rows.len() < FEW, course.ends()) {
        let open = usize::from(course.is_closed());
        let places = (0..=FEW - open).map(|k| from + (to - from) * k as f64 / FEW as f64);
        for place in places {
            if samples.iter().all(|(known, _)| *known != place) {
                samples.push((place, solver.row(&course.instant_at(place), false)));
            }
        }
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    // A table of forces may be narrower than the distance of two positions.
    let mut places: Vec<f64> = samples.iter().map(|(place, _)| *place).collect();
    places.extend(course.ends().map(|[_, end]| end));
    for place in table_places(solver, course, &places) {
        if !places.contains(&place) {
            samples.push((place, solver.row(&course.instant_at(place), false)));
        }
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    samples
}

/// A position towards which forces grow without bound, with rows ever nearer to it.
struct Edge {
    at: f64,
    rows: [Row; 4],
}

fn edges_of_zones<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    zones: &[Zone],
) -> Vec<Edge> {
    let Some(ends) = course.ends() else {
        return Vec::new();
    };
    let mut edges = Vec::new();
    for index in 0..zones.len() {
        let free = free_sides(zones, index, ends);
        let zone = &zones[index];
        for (side, at) in [zone.from, zone.to].into_iter().enumerate() {
            if zone.unbounded[side] {
                let rows = rows_towards(solver, course, [at, free[side]], true);
                edges.push(Edge { at, rows });
            }
        }
    }
    edges
}

struct Seeker<'s, 'k, S> {
    solver: &'s mut Solver<'k, S>,
    course: &'s Course,
    samples: &'s [Sample],
    /// Zones without forces.
    blocked: Vec<[f64; 2]>,
    edges: &'s [Edge],
}

impl<S: PositionSource> Seeker<'_, '_, S> {
    /// The first position towards which `sign` times a quantity grows without bound.
    fn unbounded_position(&self, column: &Column, sign: f64) -> Option<f64> {
        let grows = |edge: &&Edge| {
            let values = edge.rows.each_ref().map(|row| column.value(row));
            let known = values.iter().all(Option::is_some);
            known && unbounded(&values.map(|value| sign * value.unwrap_or(f64::NAN)))
        };
        self.edges.iter().find(grows).map(|edge| edge.at)
    }

    /// The greatest value of `sign` times a quantity.
    fn extreme(&mut self, column: &Column, sign: f64) -> Option<Extreme> {
        if let Some(at) = self.unbounded_position(column, sign) {
            let value = sign * f64::INFINITY;
            return Some(Extreme { value, at });
        }
        let values = self.samples.iter().enumerate();
        let values = values.filter_map(|(index, (_, row))| Some((index, column.value(row)?)));
        // Of equal values the first.
        let (index, value) = values
            .rev()
            .max_by(|(_, a), (_, b)| (sign * a).total_cmp(&(sign * b)))?;
        let at = self.samples[index].0;
        let here = Extreme { value, at };
        let bracket = self.free_interval_about(index);
        let (solver, course) = (&mut *self.solver, self.course);
        let mut worth = |place: f64| {
            let row = solver.row(&course.instant_at(place), false);
            let value = column.value(&row);
            value.map_or(f64::NEG_INFINITY, |value| sign * value)
        };
        let found = golden(&mut worth, bracket, STEPS);
        Some(if found.value > sign * here.value {
            Extreme {
                value: sign * found.value,
                at: found.at,
            }
        } else {
            here
        })
    }

    /// From the sample before to the one after, as far as there are forces.
    fn free_interval_about(&self, index: usize) -> [f64; 2] {
        let at = |index: usize| self.samples[index].0;
        let (here, last) = (at(index), self.samples.len() - 1);
        let period = match self.course {
            Course::Even { .. } => self.course.period().map_or(0.0, f64::abs),
            Course::Instants { .. } => 0.0,
        };
        // Before the first position of a closed course lies its last.
        let before = match index.checked_sub(1) {
            Some(before) => at(before),
            None if period > 0.0 => at(last) - period,
            None => here,
        };
        let after = match index == last {
            false => at(index + 1),
            true if period > 0.0 => at(0) + period,
            true => here,
        };
        let [mut low, mut high] = [before, after];
        for [from, to] in &self.blocked {
            for shift in [-period, 0.0, period] {
                if to + shift <= here {
                    low = low.max(to + shift);
                }
                if from + shift >= here {
                    high = high.min(from + shift);
                }
            }
        }
        [low, high]
    }
}
