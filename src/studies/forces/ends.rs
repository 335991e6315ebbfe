//! Positions at dead-centre positions that end the reach: they have no forces.

use super::row::{Row, Solver, Trouble};
use super::{Course, Instant, PositionSource};
use crate::studies::endless::{DeadEnd, places_towards_end, unbounded};

/// Takes the forces off the positions of a course at a dead-centre position that ends the reach,
/// towards which they grow without bound: how great they are there tells how near it is.
pub(super) fn remove_unbounded_forces<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &mut [Row],
) {
    for end in solver.limits() {
        let there = rows.iter_mut().enumerate();
        for (index, row) in there.filter(|(_, row)| end.is_at(row.motion.coordinate)) {
            if row.forces.is_ok()
                && unbounded(&sizes(&rows_towards(solver, &course.instant(index), &end)))
            {
                row.forces = Err(Trouble::EndOfReach);
            }
        }
    }
}

/// Stays of a course at a dead-centre position that ends the reach: the parameters of the first and the
/// last of positions that follow one another.
pub(super) fn dwells_at_end(course: &Course, end: &DeadEnd) -> Vec<[f64; 2]> {
    let there: Vec<usize> = (0..course.rows())
        .filter(|&index| end.is_at(course.instant(index).motion.coordinate))
        .collect();
    let stays = there.chunk_by(|one, next| one + 1 == *next);
    let place = |index: usize| course.place_of(index, end);
    let stays = stays.filter_map(|stay| Some([place(*stay.first()?), place(*stay.last()?)]));
    stays.map(|[a, b]| [a.min(b), a.max(b)]).collect()
}

/// Rows ever nearer to the dead-centre position at the end of the reach at which a place of the course
/// lies, in the motion and under the loads that belong to the place.
pub(super) fn rows_towards_end<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    place: f64,
) -> Option<[Row; 4]> {
    let instant = course.instant_at(place);
    let mut ends = solver.limits().into_iter();
    let end = ends.find(|end| end.is_at(instant.motion.coordinate))?;
    Some(rows_towards(solver, &instant, &end))
}

fn rows_towards<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    instant: &Instant,
    end: &DeadEnd,
) -> [Row; 4] {
    places_towards_end(end.at, end.other).map(|coordinate| {
        let mut near = instant.clone();
        near.motion.coordinate = coordinate;
        solver.row(&near, true)
    })
}

/// The greatest force of a pair in each row.
pub(super) fn sizes(rows: &[Row; 4]) -> [f64; 4] {
    let size = |row: &Row| row.greatest_force().unwrap_or(f64::NAN);
    rows.each_ref().map(size)
}
