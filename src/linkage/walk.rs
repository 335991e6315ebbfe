//! Walking along the input from the start, both ways, until the linkage repeats
//! or comes to an end, so that nothing is jumped over.
//!
//! Of every dyad the discriminant under its root is followed with its derivative.
//! A step is taken only when the cubic through both ends agrees with the middle;
//! a step over a minimum looks at the minimum: above zero it is passed, at zero
//! (to rounding) it is a change point, below zero there is a dead position
//! before it, which is then located to rounding. Towards an end the steps
//! become shorter in proportion to what is left.

use super::change::Change;
use super::course::{Course, hermite, nearest_turn};
use super::dyad::Margin;
use super::plan::{Plan, Step};
use super::range::Cause;
use super::solve::{Anchor, Guess, Stuck, around, solve};
use super::state::State;
use std::f64::consts::TAU;

/// Steps of a turn, or of the size of the linkage.
const STEPS: f64 = 200.0;
/// Most turns until it repeats.
const MOST_TURNS: usize = 64;
/// How far a sliding input is followed, in sizes of the linkage.
const FARTHEST: f64 = 100.0;
/// Most places of one way.
const MOST_PLACES: usize = 100_000;
/// An end is reached when this is left, of a radian or of the size.
const LEFT: f64 = 1e-9;
/// Most that a link may turn in a step (rad).
const MOST_TURNING: f64 = 0.5;

/// What a way came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// After so many turns everything repeats.
    Repeats(usize),
    /// It ends; groups are counted after the driver.
    Ends(f64, Cause),
}

/// What to do about a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    Accept,
    /// Try to go to this input instead.
    Shorten(f64),
    /// Something was learnt: look at the same step again.
    Again,
    /// Dead position of a group.
    End(f64, usize),
}

/// A place on the way.
#[derive(Clone, Debug)]
struct Place {
    at: f64,
    margins: Vec<Margin>,
    angles: Vec<f64>,
}

/// Walks one way.
pub(super) struct Walker<'a> {
    plan: &'a Plan,
    course: &'a mut Course,
    probe: State,
    anchor: Anchor,
    place: Place,
    before: Option<Place>,
    /// +1 upwards, −1 downwards.
    way: f64,
    /// 1 rad, or the size of the linkage.
    unit: f64,
}

/// The input is an angle.
fn turns(plan: &Plan) -> bool {
    plan.driver.sliding.is_none()
}

impl<'a> Walker<'a> {
    /// At the start, where `state` was solved for.
    pub(super) fn new(plan: &'a Plan, course: &'a mut Course, state: &State, up: bool) -> Self {
        let start = course.start;
        Self {
            anchor: Anchor::new(start, state),
            place: Place::of(start, state),
            before: None,
            probe: state.clone(),
            way: if up { 1.0 } else { -1.0 },
            unit: if turns(plan) { 1.0 } else { plan.size },
            plan,
            course,
        }
    }

    /// Goes on until it repeats, ends, or comes to `limit`.
    pub(super) fn walk(mut self, limit: Option<f64>) -> Way {
        let (start, up) = (self.course.start, self.way > 0.0);
        let first = self.anchor.clone();
        let farthest = start
            + self.way
                * if turns(self.plan) {
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
        for _ in 0..MOST_PLACES {
            let whole = start + self.way * TAU * turn as f64;
            let mut to = self.place.at + self.way * step;
            if turns(self.plan) && (to - whole) * self.way > -1e-3 * self.base() {
                to = whole;
            }
            if (to - edge) * self.way >= 0.0 {
                to = edge;
            }
            match self.settle(to) {
                Ok(reached) => {
                    step = (2.0 * (reached - self.place_before()).abs()).min(self.base());
                    if reached == edge {
                        return Way::Ends(edge, cause);
                    }
                    if turns(self.plan) && reached == whole {
                        if up && limit.is_none() && self.repeats(&first) {
                            return Way::Repeats(turn);
                        }
                        turn += 1;
                    }
                }
                Err((end, group)) => {
                    return Way::Ends(end, Cause::DeadPosition { group });
                }
            }
        }
        Way::Ends(self.place.at, Cause::Unexplored)
    }

    /// The greatest step here.
    fn base(&self) -> f64 {
        if turns(self.plan) {
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
    /// dead position that is here.
    fn settle(&mut self, to: f64) -> Result<f64, (f64, usize)> {
        let mut to = to;
        loop {
            match self.examine(to) {
                Verdict::Accept => {
                    self.accept(to);
                    return Ok(to);
                }
                Verdict::Shorten(nearer) => to = nearer,
                Verdict::Again => {}
                Verdict::End(end, group) => return Err((end, group)),
            }
        }
    }

    /// Solves at an input on the way.
    fn try_at<const N: usize>(&mut self, input: f64, groups: usize) -> Result<(), Stuck> {
        let guess = Guess::Near(&self.anchor);
        let at = (input, input);
        solve::<N>(self.plan, self.course, guess, &mut self.probe, at, groups)
    }

    /// Margin of a dyad at an input, whatever its sign; `None` where an earlier
    /// group cannot be assembled.
    fn margin(&mut self, input: f64, group: usize) -> Option<Margin> {
        match self.try_at::<2>(input, group + 1) {
            Err(Stuck(other)) if other < group => None,
            _ => Some(self.probe.margins[group]),
        }
    }

    fn is_dyad(&self, group: usize) -> bool {
        matches!(self.plan.steps[group], Step::Dyad(_))
    }

    fn examine(&mut self, to: f64) -> Verdict {
        let groups = self.plan.steps.len();
        let (from, gap) = (self.place.at, to - self.place.at);
        let middle = from + 0.5 * gap;
        let tiny = gap.abs() <= LEFT * self.unit;
        let halved = self.try_at::<2>(middle, groups);
        let at_middle = self.probe.margins.clone();
        if let Err(Stuck(group)) = halved {
            return if tiny {
                self.end_of(group)
            } else {
                Verdict::Shorten(middle)
            };
        }
        let reached = self.try_at::<2>(to, groups);
        let at_end = self.probe.margins.clone();
        let known = match reached {
            Ok(()) => groups,
            Err(Stuck(group)) if self.is_dyad(group) => group + 1,
            Err(Stuck(group)) if tiny => return self.end_of(group),
            Err(_) => return Verdict::Shorten(middle),
        };
        if reached.is_ok() && !tiny && !self.followed(to) {
            return Verdict::Shorten(middle);
        }
        for group in 0..known {
            if self.is_dyad(group) {
                let margins = [self.place.margins[group], at_middle[group], at_end[group]];
                let verdict = self.examine_dyad(group, to, margins);
                if verdict != Verdict::Accept {
                    return verdict;
                }
            }
        }
        Verdict::Accept
    }

    /// No link has turned or gone too far, and none has jumped.
    fn followed(&self, to: f64) -> bool {
        let links = &self.probe.links;
        let turned = |(link, motion): (usize, &super::state::Motion)| {
            let from = self.place.angles[link];
            (nearest_turn(motion.angle(), from) - from).abs() <= MOST_TURNING
        };
        let same_side = |group: usize| {
            self.is_dyad(group)
                || self.probe.margins[group].value * self.place.margins[group].value > 0.0
        };
        let iterated = |step: &Step| matches!(step, Step::Newton(_));
        let near = self
            .plan
            .steps
            .iter()
            .filter(|step| iterated(step))
            .all(|step| {
                step.bodies().iter().all(|body| {
                    let [x, y, angle] = self.anchor.near(body.base, to);
                    let motion = &links[body.base];
                    let off = (motion.at[0][0] - x).hypot(motion.at[1][0] - y) / self.plan.size;
                    let turned = nearest_turn(motion.angle(), angle) - angle;
                    off.max(turned.abs()) <= 0.01
                })
            });
        near && links.iter().enumerate().all(turned) && (0..self.plan.steps.len()).all(same_side)
    }

    fn examine_dyad(&mut self, group: usize, to: f64, margins: [Margin; 3]) -> Verdict {
        let (from, gap) = (self.place.at, to - self.place.at);
        let [a, m, b] = margins;
        let size = a.value.abs().max(b.value.abs()).max(m.value.abs());
        let cubic = hermite(0.5, gap, [a.value, a.slope, b.value, b.slope]);
        let smooth = (cubic - m.value).abs() <= 0.02 * size + tolerance(&m);
        if !smooth && gap.abs() > 1e-5 * self.unit {
            return Verdict::Shorten(from + 0.5 * gap);
        }
        let inside = |change: &Change| (from < change.at) == (change.at < to);
        if self.course.branches[group].changes.iter().any(inside) {
            return Verdict::Accept;
        }
        if a.slope * self.way < 0.0 && b.slope * self.way > 0.0 {
            return self.examine_minimum(group, to);
        }
        if b.value > tolerance(&b) {
            return Verdict::Accept;
        }
        if b.value < -tolerance(&b) {
            return self.dead(group, to);
        }
        // Just on a dead position or a change point: nothing can be said here.
        if gap.abs() <= LEFT * self.unit {
            return Verdict::End(to, group);
        }
        Verdict::Shorten(from + 0.73 * gap)
    }

    /// A minimum of the discriminant lies within the step.
    fn examine_minimum(&mut self, group: usize, to: f64) -> Verdict {
        let way = self.way;
        let lowest = self.bisect(group, to, |margin| margin.slope * way < 0.0);
        let Some(margin) = self.margin(lowest, group) else {
            return Verdict::Shorten(self.place.at + 0.5 * (to - self.place.at));
        };
        let tolerance = tolerance(&margin);
        if margin.value > tolerance {
            return Verdict::Accept;
        }
        if margin.value < -tolerance {
            return self.dead(group, lowest);
        }
        match self.change(group, lowest) {
            Some(change) => {
                self.course.branches[group].changes.push(change);
                Verdict::Again
            }
            None => self.approach(lowest, group),
        }
    }

    /// The discriminant goes through zero before `to`.
    fn dead(&mut self, group: usize, to: f64) -> Verdict {
        let end = self.bisect(group, to, |margin| margin.value > 0.0);
        self.approach(end, group)
    }

    /// Goes a part of the way to an end, which is reached when little is left.
    fn approach(&self, end: f64, group: usize) -> Verdict {
        let left = end - self.place.at;
        if left.abs() <= LEFT * self.unit {
            Verdict::End(end, group)
        } else {
            Verdict::Shorten(self.place.at + 0.75 * left)
        }
    }

    /// The input between here and `to` at which `before` ceases to hold.
    fn bisect(&mut self, group: usize, to: f64, before: impl Fn(&Margin) -> bool) -> f64 {
        let (mut near, mut far) = (self.place.at, to);
        for _ in 0..200 {
            let middle = near + 0.5 * (far - near);
            if middle == near || middle == far {
                break;
            }
            match self.margin(middle, group) {
                Some(margin) if before(&margin) => near = middle,
                _ => far = middle,
            }
        }
        near
    }

    /// The change point of a dyad at an input, when it can be passed smoothly.
    fn change(&mut self, group: usize, at: f64) -> Option<Change> {
        let (sign, _) = self.course.branch(group, self.place.at);
        let Step::Dyad(dyad) = &self.plan.steps[group] else {
            return None;
        };
        let (way, size) = (self.way, self.plan.size);
        Change::fit(at, way, 0.6 * self.unit, |input, side| {
            self.try_at::<1>(input, group).ok()?;
            let around = around::<1>(dyad, &self.probe);
            let found = dyad.directions(&around, sign * side, size);
            let [one, other] = found.of.map(|direction| direction.value());
            Some([one[0], one[1], other[0], other[1]])
        })
    }

    /// Where a group cannot be followed further by ever shorter steps.
    fn end_of(&self, group: usize) -> Verdict {
        let here = self.place.margins[group].value;
        let mut end = self.place.at;
        if let Some(before) = &self.before
            && !self.is_dyad(group)
        {
            // The square of the determinant goes to zero in proportion.
            let square = (here * here, before.margins[group].value.powi(2));
            let left = square.0 / (square.1 - square.0) * (self.place.at - before.at);
            if left.is_finite() && left * self.way >= 0.0 && left.abs() <= 1e-6 * self.unit {
                end += left;
            }
        }
        Verdict::End(end, group)
    }

    /// Goes to a place that was examined.
    fn accept(&mut self, to: f64) {
        let groups = self.plan.steps.len();
        // It could be solved a moment ago, to a lower order.
        let _ = self.try_at::<4>(to, groups);
        self.anchor = Anchor::new(to, &self.probe);
        let place = Place::of(to, &self.probe);
        self.before = Some(std::mem::replace(&mut self.place, place));
        self.course.table.push(to, &self.probe, self.way > 0.0);
    }

    /// Everything is as it was at first.
    fn repeats(&self, first: &Anchor) -> bool {
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

/// A discriminant of this size is zero.
pub(super) fn tolerance(margin: &Margin) -> f64 {
    1e-12 + 200.0 * margin.noise
}
