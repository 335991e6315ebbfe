//! Looking at one step of a walk: does anything happen on it?

use super::change::Change;
use super::continuation::{LEFT, StepVerdict, Walker};
use super::course::hermite;
use super::dyad::Margin;
use super::plan::Step;
use super::rounding::directions;
use super::solve::{Guess, Stuck};
use super::state::Motion;
use super::vector::nearest_turn;
use crate::math::roots::bisect;

/// Most that a link may turn in a step (rad).
const MOST_TURNING: f64 = 0.5;

impl Walker<'_> {
    /// What to do about a step from the present place to `to`.
    pub(super) fn examine(&mut self, to: f64) -> StepVerdict {
        let groups = self.plan.steps.len();
        let (from, gap) = (self.place.at, to - self.place.at);
        let middle = from + 0.5 * gap;
        let tiny = gap.abs() <= LEFT * self.unit;
        let halved = self.try_at::<2>(middle, groups);
        let at_middle = self.probe.margins.clone();
        let reached = self.try_at::<2>(to, groups);
        let at_end = self.probe.margins.clone();
        let followed = reached.is_err() || tiny || self.is_continuous(to);
        let known = [
            halved.map_or_else(|Stuck(group)| group, |()| groups),
            reached.map_or_else(|Stuck(group)| group + 1, |()| groups),
        ];
        for group in 0..known[0].min(known[1]) {
            if self.is_dyad(group) {
                let margins = [self.place.margins[group], at_middle[group], at_end[group]];
                let verdict = self.examine_dyad(group, to, margins);
                if verdict != StepVerdict::Accept {
                    return verdict;
                }
            }
        }
        // Beyond a change point not known yet later groups may fail, and links
        // seem to have jumped: these are looked at last.
        match halved.and(reached) {
            Err(Stuck(group)) if tiny && self.is_dyad(group) => self.dead(group, to),
            Err(Stuck(group)) if tiny => self.end_of(group),
            Ok(()) if followed => StepVerdict::Accept,
            _ => StepVerdict::Shorten(middle),
        }
    }

    /// No link has turned or gone too far, and none has jumped.
    fn is_continuous(&self, to: f64) -> bool {
        let links = &self.probe.links;
        let turned = |(link, motion): (usize, &Motion)| {
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
                    let [x, y, angle] = self.anchor.pose_near(body.base, to);
                    let motion = &links[body.base];
                    let off = (motion.at[0][0] - x).hypot(motion.at[1][0] - y) / self.plan.size;
                    let turned = nearest_turn(motion.angle(), angle) - angle;
                    off.max(turned.abs()) <= 0.01
                })
            });
        near && links.iter().enumerate().all(turned) && (0..self.plan.steps.len()).all(same_side)
    }

    fn examine_dyad(&mut self, group: usize, to: f64, margins: [Margin; 3]) -> StepVerdict {
        let (from, gap) = (self.place.at, to - self.place.at);
        let [a, m, b] = margins;
        let size = a.value.abs().max(b.value.abs()).max(m.value.abs());
        let cubic = hermite(0.5, gap, [a.value, a.slope, b.value, b.slope]);
        let smooth = (cubic - m.value).abs() <= 0.02 * size + tolerance(&m);
        if !smooth && gap.abs() > 1e-5 * self.unit {
            return StepVerdict::Shorten(from + 0.5 * gap);
        }
        let inside = |change: &Change| (from < change.at) == (change.at < to);
        if self.course.branches[group].changes.iter().any(inside) {
            return StepVerdict::Accept;
        }
        if a.slope * self.way < 0.0 && b.slope * self.way > 0.0 {
            return self.examine_minimum(group, to);
        }
        if b.value > tolerance(&b) {
            return StepVerdict::Accept;
        }
        if b.value < -tolerance(&b) {
            return self.dead(group, to);
        }
        // Just on a dead-centre position or a change point: nothing can be said here.
        if gap.abs() <= LEFT * self.unit {
            let end = self.just_beyond(group, to, &b);
            return self.end(end, group);
        }
        StepVerdict::Shorten(from + 0.73 * gap)
    }

    /// The dead-centre position next to `to`, where the discriminant is zero but for
    /// rounding.
    fn just_beyond(&mut self, group: usize, to: f64, margin: &Margin) -> f64 {
        let left = -margin.value / margin.slope;
        if left.abs() <= 1e-6 * self.unit {
            let beyond = to + 2.0 * left;
            if self
                .margin(beyond, group)
                .is_some_and(|margin| margin.value < 0.0)
            {
                return self.bisect(group, beyond, |margin| margin.value > 0.0);
            }
        }
        to
    }

    /// A minimum of the discriminant lies within the step.
    fn examine_minimum(&mut self, group: usize, to: f64) -> StepVerdict {
        let way = self.way;
        let lowest = self.bisect(group, to, |margin| margin.slope * way < 0.0);
        let Some(margin) = self.margin(lowest, group) else {
            return StepVerdict::Shorten(self.place.at + 0.5 * (to - self.place.at));
        };
        let tolerance = tolerance(&margin);
        if margin.value > tolerance {
            return StepVerdict::Accept;
        }
        if margin.value < -tolerance {
            return self.dead(group, lowest);
        }
        match self.change(group, lowest) {
            Some(change) => {
                self.course.branches[group].changes.push(change);
                StepVerdict::Again
            }
            None => self.step_towards_end(lowest, group),
        }
    }

    /// The discriminant goes through zero before `to`.
    fn dead(&mut self, group: usize, to: f64) -> StepVerdict {
        let end = self.bisect(group, to, |margin| margin.value > 0.0);
        self.step_towards_end(end, group)
    }

    /// Goes a part of the way to an end, which is reached when little is left.
    fn step_towards_end(&mut self, end: f64, group: usize) -> StepVerdict {
        let left = end - self.place.at;
        if left.abs() > LEFT * self.unit {
            return StepVerdict::Shorten(self.place.at + 0.75 * left);
        }
        self.end(end, group)
    }

    /// The end of a group, unless another comes to its end before.
    fn end(&mut self, end: f64, group: usize) -> StepVerdict {
        // On the little that is left a later group may come to its end first.
        let mut first = group;
        let [near, _] = bisect([self.place.at, end], 60, |input| {
            let tried = self.try_at::<2>(input, self.plan.steps.len());
            tried.map_err(|Stuck(other)| first = other).is_ok()
        });
        if (end - near).abs() > 1e-13 * self.unit.max(end.abs()) {
            StepVerdict::End(near, first)
        } else {
            StepVerdict::End(end, group)
        }
    }

    /// The input between here and `to` at which `before` ceases to hold.
    fn bisect(&mut self, group: usize, to: f64, before: impl Fn(&Margin) -> bool) -> f64 {
        let [near, _] = bisect([self.place.at, to], 200, |input| {
            self.margin(input, group)
                .is_some_and(|margin| before(&margin))
        });
        near
    }

    /// The change point of a dyad at an input, when it can be passed smoothly.
    fn change(&mut self, group: usize, at: f64) -> Option<Change> {
        let (sign, _) = self.course.branch(group, self.place.at);
        let (way, widest) = (self.way, 0.6 * self.unit);
        let (plan, course) = (self.plan, &*self.course);
        let (probe, guess) = (&mut self.probe, Guess::Near(&self.anchor));
        Change::fit_directions(at, (way, sign), widest, |input, sign| {
            directions(plan, course, guess, probe, (group, sign), input)
        })
    }

    /// Where a group cannot be followed further by ever shorter steps.
    fn end_of(&self, group: usize) -> StepVerdict {
        let here = self.place.margins[group].value;
        let mut end = self.place.at;
        if let Some(before) = &self.before {
            // The square of the determinant goes to zero in proportion.
            let square = (here * here, before.margins[group].value.powi(2));
            let left = square.0 / (square.1 - square.0) * (self.place.at - before.at);
            if left.is_finite() && left * self.way >= 0.0 && left.abs() <= 1e-6 * self.unit {
                end += left;
            }
        }
        StepVerdict::End(end, group)
    }
}

/// A discriminant of this size is zero.
pub(super) fn tolerance(margin: &Margin) -> f64 {
    1e-12 + 200.0 * margin.noise
}
