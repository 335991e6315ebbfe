//! Places of a course at which zones are looked for: its own, whatever positions are asked for.

use super::row::Solver;
use super::{Course, PositionSource};
use crate::math::roots::{BISECTIONS, bisect};

/// Intervals of a course, at least.
const INTERVALS: usize = 360;

/// Places from the lesser end of a course to the greater, both included; `None` where it has
/// no length.
pub(super) fn scan(course: &Course) -> Option<Vec<f64>> {
    let [from, to] = course.ends()?;
    let even = |from: f64, to: f64, count: usize| {
        (0..count).map(move |k| from + (to - from) * k as f64 / count as f64)
    };
    let mut places: Vec<f64> = match course {
        Course::Even { .. } => even(from, to, INTERVALS).collect(),
        Course::Instants { times, .. } => {
            let parts = INTERVALS.div_ceil(times.len().saturating_sub(1).max(1));
            times
                .windows(2)
                .flat_map(|pair| even(pair[0], pair[1], parts))
                .collect()
        }
    };
    places.push(to);
    Some(places)
}

/// Places of a course at which the linkage passes a singular position that is known
/// beforehand.
pub(super) fn singular_places<S: PositionSource>(
    solver: &Solver<'_, S>,
    course: &Course,
    places: &[f64],
) -> Vec<f64> {
    let (singular, period) = solver.singular();
    places_of_coordinates(course, places, (&singular, period))
}

/// Places of a course at which the input passes a point of a table of forces, and those beside
/// which a load on an output jumps.
pub(super) fn table_places<S: PositionSource>(
    solver: &Solver<'_, S>,
    course: &Course,
    places: &[f64],
) -> Vec<f64> {
    let forces = solver.kinetostatics().spec().forces.iter();
    let tables = forces.filter_map(|force| force.law.breaks());
    let mut found: Vec<f64> = tables
        .flat_map(|table| places_of_coordinates(course, places, (&table.points, table.period)))
        .collect();
    if let Course::Even { speed, .. } = course {
        let pairs = places.windows(2).map(|pair| [pair[0], pair[1]]);
        found.extend(pairs.flat_map(|pair| solver.load_places(pair, *speed)));
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// Places of a course at which the input passes coordinates, which come again after a period.
fn places_of_coordinates(
    course: &Course,
    places: &[f64],
    (coordinates, period): (&[f64], Option<f64>),
) -> Vec<f64> {
    let mut found = Vec::new();
    for pair in places.windows(2) {
        let q = [pair[0], pair[1]].map(|place| course.instant_at(place).motion.coordinate);
        for &at in coordinates {
            let at = match period {
                Some(period) => at + period * ((0.5 * (q[0] + q[1]) - at) / period).round(),
                None => at,
            };
            if (q[0] - at) * (q[1] - at) <= 0.0 && q[0] != q[1] {
                found.push(place_of(course, [pair[0], pair[1]], at));
            }
        }
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// The place at which the input passes a coordinate, between two places.
fn place_of(course: &Course, [low, high]: [f64; 2], at: f64) -> f64 {
    if matches!(course, Course::Even { .. }) {
        return at.clamp(low, high);
    }
    let off = |place: f64| course.instant_at(place).motion.coordinate - at;
    let sign = off(high);
    let [_, place] = bisect([low, high], BISECTIONS, |place| !(off(place) * sign > 0.0));
    place
}
