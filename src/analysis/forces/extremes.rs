//! Least and greatest values, between the positions too.

use super::columns::{Column, columns};
use super::row::{Row, Solver};
use super::{Course, PositionSource};

/// Part of the distance that golden section keeps.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Steps of golden section: the place to about 10⁻⁸ of a step of the course.
const STEPS: usize = 38;

/// A value and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The value, in the column's unit.
    pub value: f64,
    /// The course's parameter there: input coordinate or time.
    pub at: f64,
}

/// Least and greatest value of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremes {
    /// The quantity's name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The least value.
    pub least: Extreme,
    /// The greatest value.
    pub greatest: Extreme,
}

/// Extremes of all figures of a course.
pub(super) fn find<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
) -> Vec<Extremes> {
    let all = columns(solver.kinetostatics().spec(), solver.output());
    let figures = all.iter().filter(|column| column.figure);
    figures
        .filter_map(|column| {
            Some(Extremes {
                name: column.name.clone(),
                unit: column.unit.clone(),
                least: extreme(solver, course, rows, column, -1.0)?,
                greatest: extreme(solver, course, rows, column, 1.0)?,
            })
        })
        .collect()
}

/// The greatest value of `sign` times a quantity.
fn extreme<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
    column: &Column,
    sign: f64,
) -> Option<Extreme> {
    let values = rows.iter().enumerate();
    let values = values.filter_map(|(index, row)| Some((index, column.value(row)?)));
    // Of equal values the first.
    let (index, value) = values
        .rev()
        .max_by(|(_, a), (_, b)| (sign * a).total_cmp(&(sign * b)))?;
    let here = Extreme {
        value,
        at: course.parameter(index),
    };
    let before = neighbour(course, index, -1)?;
    let after = neighbour(course, index, 1)?;
    let mut at = |parameter: f64| {
        let row = solver.row(&course.between(parameter), false);
        column
            .value(&row)
            .map_or(f64::NEG_INFINITY, |value| sign * value)
    };
    let found = golden([before, after], &mut at);
    let value = sign * at(found);
    Some(if sign * value > sign * here.value {
        Extreme { value, at: found }
    } else {
        here
    })
}

/// Parameter of the next position in a direction; the position itself at an end.
fn neighbour(course: &Course, index: usize, direction: i64) -> Option<f64> {
    let last = course.len().checked_sub(1)?;
    match (direction, index) {
        (-1, 0) => Some(match (course, course.period()) {
            // Before the first position of a closed course lies its last.
            (Course::Even { .. }, Some(period)) => course.parameter(last) - period,
            _ => course.parameter(0),
        }),
        (1, index) if index == last => Some(match (course, course.period()) {
            (Course::Even { .. }, Some(period)) => course.parameter(0) + period,
            _ => course.parameter(last),
        }),
        (direction, index) => Some(course.parameter((index as i64 + direction) as usize)),
    }
}

/// Place of the greatest value in an interval, if it rises and falls once.
fn golden([mut low, mut high]: [f64; 2], f: &mut impl FnMut(f64) -> f64) -> f64 {
    let mut x = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut y = [f(x[0]), f(x[1])];
    for _ in 0..STEPS {
        if y[0] >= y[1] {
            high = x[1];
            x = [high - GOLDEN * (high - low), x[0]];
            y = [f(x[0]), y[0]];
        } else {
            low = x[0];
            x = [x[1], low + GOLDEN * (high - low)];
            y = [y[1], f(x[1])];
        }
    }
    if y[0] >= y[1] { x[0] } else { x[1] }
}
