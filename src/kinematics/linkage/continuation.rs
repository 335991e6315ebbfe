//! Walking along the input from the start, both ways, until the linkage repeats
//! or comes to an end, so that nothing is jumped over.
//!
//! Of every dyad the discriminant under its root is followed with its derivative.
//! A step is taken only when the cubic through both ends agrees with the middle.
//! A step over a minimum looks at the minimum: above zero it is passed, at zero
//! (to rounding) it is a change point, below zero there is a dead-centre position
//! before it, which is then located to rounding. Towards an end the steps
//! become shorter in proportion to what is left.

use super::course::Course;
use super::dyad::Margin;
use super::plan::{Plan, Step};
use super::range::Cause;
use super::solve::{Anchor, Guess, Stuck, solve};
use super::state::State;
use super::vector::nearest_turn;
use std::f64::consts::TAU;

/// Steps of a turn, or of the size of the linkage.
const STEPS: f64 = 200.0;
/// Most turns until it repeats.
const MOST_TURNS: usize = 64;
/// How far a sliding input is followed, in sizes of the linkage.
const FARTHEST: f64 = 100.0;
/// Most places of one way …
const MOST_PLACES: usize = 100_000;
/// … times links, so that a table fits into the memory.
const MOST_ROWS: usize = 10_000_000;
/// Most lengths that one step is tried with.
const MOST_TRIALS: usize = 1000;
/// An end is reached when this is left, of a radian or of the size.
pub(super) const LEFT: f64 = 1e-9;

/// End of a way along the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WayEnd {
    /// After so many turns everything repeats.
    Repeats(usize),
    /// Nothing limits it and nothing repeats.
    Everywhere,
    /// The way ends; groups are counted after the driver.
    Ends(f64, Cause),
}

/// Order about a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StepVerdict {
    Accept,
    /// Try to go to this input instead.
    Shorten(f64),
    /// Something was learnt: look at the same step again.
    Again,
    /// Dead-centre position of a group.
    End(f64, usize),
}

/// A place on the way.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) at: f64,
    pub(super) margins: Vec<Margin>,
    pub(super) angles: Vec<f64>,
}

/// Walks one way.
pub(super) struct Walker<'a> {
    pub(super) plan: &'a Plan,
    pub(super) course: &'a mut Course,
    pub(super) probe: State,
    pub(super) anchor: Anchor,
    pub(super) place: Place,
    pub(super) before: Option<Place>,
    /// +1 upwards, −1 downwards.
    pub(super) way: f64,
    /// 1 rad, or the size of the linkage.
    pub(super) unit: f64,
}

/// The input is an angle.
fn input_is_angle(plan: &Plan) -> bool {
    plan.driver.sliding.is_none()
}

impl<'a> Walker<'a> {
    /// At the start, where `state` was solved for.
    pub(super) fn new(plan: &'a Plan, course: &'a mut Course, state: &State, up: bool) -> Self {
        let start = course.start;
        Self {
            anchor: Anchor::new(start, state, |link| state.near[link]),
            place: Place::of(start, state),
            before: None,
            probe: state.clone(),
            way: if up { 1.0 } else { -1.0 },
            unit: if input_is_angle(plan) { 1.0 } else { plan.size },
            plan,
            course,
        }
    }

    /// Goes on until it repeats, ends, or comes to `limit`.
    pub(super) fn continue_until_end(mut self, limit: Option<f64>) -> WayEnd {
        let (start, up) = (self.course.start, self.way > 0.0);
        let first = self.anchor.clone();
        let farthest = start
            + self.way
                * if input_is_angle(self.plan) {
                    TAU * MOST_TURNS as f64
                } else {
                    FARTHEST * self.unit
                };
        let (edge, cause) = match limit {
            Some(limit) if (limit - farthest) * self.way < 0.0 => (limit, Cause::Travel),
            _ => (farthest, Cause::Unexplored),
        };
        let mut step = self.base();
        let mut turn = 1;
        for _ in 0..MOST_PLACES.min(MOST_ROWS / self.plan.links.max(1)) {
            let whole = start + self.way * TAU * turn as f64;
            let mut to = self.place.at + self.way * step;
            if input_is_angle(self.plan) && (to - whole) * self.way > -1e-3 * self.base() {
                to = whole;
            }
            if (to - edge) * self.way >= 0.0 {
                to = edge;
            }
            match self.take_step(to) {
                Ok(reached) => {
                    step = (2.0 * (reached - self.place_before()).abs()).min(self.base());
                    if reached == edge {
                        return WayEnd::Ends(edge, cause);
                    }
                    if input_is_angle(self.plan) && reached == whole {
                        if up && limit.is_none() && self.is_back_at_start(&first) {
                            return WayEnd::Repeats(turn);
                        }
                        turn += 1;
                    }
                }
                Err((end, cause)) => return WayEnd::Ends(end, cause),
            }
        }
        WayEnd::Ends(self.place.at, Cause::Unexplored)
    }

    /// The greatest step here.
    fn base(&self) -> f64 {
        if input_is_angle(self.plan) {
            TAU / STEPS
        } else {
            (self.unit / STEPS).max(0.02 * (self.place.at - self.course.start).abs())
        }
    }

    fn place_before(&self) -> f64 {
        self.before
            .as_ref()
            .map_or(self.course.start, |place| place.at)
    }

    /// Takes a step towards `to`, as far as it may; the place reached, or the
    /// dead-centre position that is here.
    fn take_step(&mut self, to: f64) -> Result<f64, (f64, Cause)> {
        let mut to = to;
        for _ in 0..MOST_TRIALS {
            match self.examine(to) {
                StepVerdict::Accept => {
                    self.go_to_place(to);
                    return Ok(to);
                }
                StepVerdict::Shorten(nearer) => to = nearer,
                StepVerdict::Again => {}
                StepVerdict::End(end, group) => return Err((end, Cause::DeadPosition { group })),
            }
        }
        Err((self.place.at, Cause::Unexplored))
    }

    /// Solves at an input on the way.
    pub(super) fn try_at<const N: usize>(
        &mut self,
        input: f64,
        groups: usize,
    ) -> Result<(), Stuck> {
        let guess = Guess::Near(&self.anchor);
        let at = (input, input);
        solve::<N>(self.plan, self.course, guess, &mut self.probe, at, groups)
    }

    /// Margin of a dyad at an input, whatever its sign; `None` where an earlier
    /// group cannot be assembled.
    pub(super) fn margin(&mut self, input: f64, group: usize) -> Option<Margin> {
        match self.try_at::<2>(input, group + 1) {
            Err(Stuck(other)) if other < group => None,
            _ => Some(self.probe.margins[group]),
        }
    }

    pub(super) fn is_dyad(&self, group: usize) -> bool {
        matches!(self.plan.steps[group], Step::Dyad(_))
    }

    /// Goes to a place that was examined.
    fn go_to_place(&mut self, to: f64) {
        let groups = self.plan.steps.len();
        // It could be solved a moment ago, to a lower order.
        let _ = self.try_at::<4>(to, groups);
        let place = Place::of(to, &self.probe);
        self.before = Some(std::mem::replace(&mut self.place, place));
        let table = if self.way > 0.0 {
            &mut self.course.table
        } else {
            &mut self.course.below
        };
        table.push(to, &self.probe);
        self.anchor = Anchor::new(to, &self.probe, |link| table.last_angle(link));
    }

    /// Everything is as it was at first.
    fn is_back_at_start(&self, first: &Anchor) -> bool {
        let size = self.plan.size;
        self.probe
            .links
            .iter()
            .zip(&first.series)
            .all(|(now, then)| {
                let off = (now.at[0][0] - then[0][0]).hypot(now.at[1][0] - then[1][0]);
                let turned = nearest_turn(now.angle(), then[2][0]) - then[2][0];
                off <= 1e-7 * size && turned.abs() <= 1e-7
            })
    }
}

impl Place {
    fn of(at: f64, state: &State) -> Self {
        Self {
            at,
            margins: state.margins.clone(),
            angles: state.links.iter().map(|motion| motion.angle()).collect(),
        }
    }
}
