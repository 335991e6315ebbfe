//! Gear trains that turn for ever though nothing in them repeats within what is explored.

use super::course::Course;
use super::plan::Plan;
use super::solve::{Guess, solve};
use super::state::State;

/// Places at which the margins are looked at.
const PLACES: usize = 600;
/// Change of a margin, over itself, that is rounding.
const CONSTANT: f64 = 1e-9;

/// True where the margins of all groups stay as they are from end to end of the course: they are
/// analytic in the input, so that they do so everywhere, and no dead-centre position can come. All angles
/// then go on evenly.
pub(super) fn assembles_everywhere(plan: &Plan, course: &Course, state: &State) -> bool {
    let rows = course.table.inputs.len();
    let mut probe = state.clone();
    let mut places =
        (0..PLACES).map(|place| course.table.inputs[place * (rows - 1) / (PLACES - 1)]);
    places.all(|at| {
        let guess = Guess::Table(&course.table);
        let groups = plan.steps.len();
        let solved = solve::<1>(plan, course, guess, &mut probe, (at, at), groups).is_ok();
        let mut margins = probe.margins.iter().zip(&state.margins);
        solved
            && margins.all(|(here, start)| {
                (here.value - start.value).abs() <= CONSTANT * start.value.abs()
            })
    })
}
