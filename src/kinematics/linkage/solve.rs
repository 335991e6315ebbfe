//! Solving a linkage at one input, group by group.

use super::course::{Course, Table};
use super::dyad::{Dyad, DyadSurroundings};
use super::elements::{Frame, inverse};
use super::newton::{NewtonGroup, PreparedJoint};
use super::plan::{Plan, Step};
use super::state::{Motion, State};
use super::vector::nearest_turn;

/// Positions to start an iteration from.
#[derive(Clone, Copy, Debug)]
pub(super) enum Guess<'a> {
    /// The table of the course.
    Table(&'a Table),
    /// A position nearby, as power series.
    Near(&'a Anchor),
}

/// A position as power series.
#[derive(Clone, Debug)]
pub(super) struct Anchor {
    /// Input coordinate.
    pub(super) at: f64,
    /// x, y, θ of every link.
    pub(super) series: Vec<[[f64; 4]; 3]>,
}

impl Anchor {
    /// The present position, with the angles over whole turns next to those in `near`.
    pub(super) fn new(at: f64, state: &State, near: impl Fn(usize) -> f64) -> Self {
        let series = |(link, motion): (usize, &Motion)| {
            let [first, second, third] = motion.turning();
            let value = nearest_turn(motion.angle(), near(link));
            let angle = [value, first, second / 2.0, third / 6.0];
            [motion.at[0], motion.at[1], angle]
        };
        Self {
            at,
            series: state.links.iter().enumerate().map(series).collect(),
        }
    }

    /// x, y, θ of a link at an input.
    pub(super) fn pose_near(&self, link: usize, input: f64) -> [f64; 3] {
        let t = input - self.at;
        self.series[link].map(|[a, b, c, d]| a + t * (b + t * (c + t * d)))
    }
}

/// The group, counted after the driver, that cannot be assembled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stuck(pub(super) usize);

/// Places the links of the driver and of the first `groups` groups after it.
///
/// `input` is the input itself, `reduced` the same within the first period.
pub(super) fn solve<const N: usize>(
    plan: &Plan,
    course: &Course,
    guess: Guess<'_>,
    state: &mut State,
    (input, reduced): (f64, f64),
    groups: usize,
) -> Result<(), Stuck> {
    place_driven_link::<N>(plan, state, input);
    state.reduced = reduced;
    for (index, step) in plan.steps[..groups].iter().enumerate() {
        match step {
            Step::Dyad(dyad) => place_dyad::<N>(plan, course, dyad, state, reduced, index)?,
            Step::Newton(group) => {
                place_by_iteration::<N>(plan, group, guess, state, reduced, index)?
            }
        }
    }
    if groups == plan.steps.len() {
        plan.attach::<N>(state);
    }
    Ok(())
}

/// Places the driven link, or the two links of the driver against each other.
#[inline]
pub(super) fn place_driven_link<const N: usize>(plan: &Plan, state: &mut State, input: f64) {
    let driver = &plan.driver;
    let relative = driver.relative_frame::<N>(input);
    match (driver.on.link, driver.link.link) {
        (None, Some(driven)) => state.links[driven].set(&relative),
        (Some(driven), None) => state.links[driven].set(&inverse(&relative)),
        _ => state.relative.set(&relative),
    }
}

/// Surroundings of a dyad, as far as they are known.
#[inline(always)]
pub(super) fn surroundings_of_dyad<const N: usize>(
    dyad: &Dyad,
    state: &State,
) -> DyadSurroundings<N> {
    DyadSurroundings {
        known: [
            state.frame(dyad.known[0].link),
            state.frame(dyad.known[1].link),
        ],
        relative: state.relative_frame(),
    }
}

#[inline]
fn place_dyad<const N: usize>(
    plan: &Plan,
    course: &Course,
    dyad: &Dyad,
    state: &mut State,
    reduced: f64,
    index: usize,
) -> Result<(), Stuck> {
    let around = surroundings_of_dyad::<N>(dyad, state);
    let (sign, near) = course.branch(index, reduced);
    let mut found = dyad.directions(&around, sign, plan.size);
    state.margins[index] = found.margin;
    match near {
        Some((change, distance)) => found.of = change.directions(distance),
        None if found.margin.value > 0.0 => {}
        None => return Err(Stuck(index)),
    }
    let frames: [Frame<N>; 2] = dyad.frames_of_bodies(&around, found.of);
    state.place_body(&dyad.bodies[0], &frames[0]);
    state.place_body(&dyad.bodies[1], &frames[1]);
    Ok(())
}

fn place_by_iteration<const N: usize>(
    plan: &Plan,
    group: &NewtonGroup,
    guess: Guess<'_>,
    state: &mut State,
    reduced: f64,
    index: usize,
) -> Result<(), Stuck> {
    let mut scratch = std::mem::take(&mut state.scratch);
    let place = match guess {
        Guess::Table(table) => table.index_before(reduced),
        Guess::Near(_) => 0,
    };
    for (body, unknowns) in group
        .bodies
        .iter()
        .zip(scratch.unknowns.chunks_exact_mut(3))
    {
        let values = match guess {
            Guess::Table(table) => table.pose_near(place, body.base, reduced),
            Guess::Near(anchor) => anchor.pose_near(body.base, reduced),
        };
        for (unknown, value) in unknowns.iter_mut().zip(values) {
            unknown[0] = value;
        }
    }
    for link in group.ties.iter().flat_map(PreparedJoint::known_links) {
        state.near[link] = match guess {
            Guess::Table(table) => table.pose_near(place, link, reduced)[2],
            Guess::Near(anchor) => anchor.pose_near(link, reduced)[2],
        };
    }
    let found = group.place_by_newton::<N>(state, &mut scratch, plan.size);
    if let Ok(margin) = found {
        state.margins[index] = margin;
        for (index, body) in group.bodies.iter().enumerate() {
            state.place_body(body, &NewtonGroup::frame::<N>(&scratch, index));
        }
    }
    state.scratch = scratch;
    found.map(|_| ()).map_err(|_| Stuck(index))
}
