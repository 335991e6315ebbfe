//! Singularities: places that a signal cannot pass because the equations end there (a
//! dead-centre position of a linkage).
//!
//! With z the distance left to an edge, the equations hold √z: their right-hand
//! side grows without bound as z falls. Two kinds of approach occur. Driven by
//! something that cannot be turned back, z falls through zero like any smooth
//! function while forces grow beyond all bounds. Driven by a free mass, z
//! touches zero like a parabola, z ∝ (t* − t)²: what the mass drives takes up all
//! of its motion, √z falls evenly, and behind t* the mechanism would be on its
//! other branch. A method that knows nothing of it may step right over t*.
//!
//! So a run ends where z has fallen to a small share of the span, the last
//! instant at which everything is still a number, and the time of the edge is
//! extrapolated from there. On the way steps get shorter in proportion to z,
//! whatever the method makes of its error.
//!
//! The share is a millionth of the range of motion, more at loose tolerances. The end of a
//! given travel is an edge too, though nothing grows there: the run then stops with
//! `end_of_travel`, not `dead_position`.

mod approach;
mod given;

use super::continuous::End;
use super::evaluator::Evaluator;
use super::locate::Stretch;
use super::run::{Run, Verdict};
use super::{Dynamics, EventFunction, Guard, Method, Singularity, Stop};
use approach::Approach;

/// A run ends at this share of the span before the edge, or at
/// [`TOLERANCES`] times the tolerance if that is more, at most [`MOST`].
const LEAST: f64 = 1e-6;
const TOLERANCES: f64 = 10.0;
const MOST: f64 = 1e-3;

/// Share of the span within which an edge is near: legs end at every
/// [`RATIO`]-th part of the distance left, and errors count relative to it.
const NEAR_EDGE: f64 = 0.05;
const RATIO: f64 = 1.1;

/// No step may bring an edge that is near closer than this share of the
/// distance at its start.
const CLOSER: f64 = 0.5;

/// The most that the tolerance is sharpened near an edge.
const SHARPEST: f64 = 1e-4;

/// Least number of steps of a method of fixed step in a leg near an edge.
const FEWEST: f64 = 8.0;

/// The clock moves by steps of at least so many roundings.
const CLOCK: f64 = 64.0;

/// Attempts at a step before an edge, each at most nine tenths as long as the last:
/// from the longest step of all numbers to the shortest takes fewer.
const SHORTENED: u32 = 20_000;

/// Attempts at a step that fails before an edge, each shorter than the last.
const ATTEMPTS: u32 = 40;

/// Meeting of a step with the edges.
enum EdgeMeeting {
    /// The step keeps away from them.
    None,
    /// The step comes too near in one go: to be taken anew, at most this long (s).
    TooLong(f64),
    /// The step reaches an edge at this place of it.
    Reached(Singularity, f64),
}

/// The edges of a run, and how it goes about them.
#[derive(Debug, Default)]
pub(super) struct Singularities {
    /// The edges in the present modes.
    list: Vec<Singularity>,
    /// Longest next leg after one that failed or went too far (s).
    longest: Option<f64>,
    /// Failures since the last step.
    failures: u32,
    /// Count of how often the step under way has been shortened before an edge.
    shortened: u32,
    /// End of the run (s).
    pub(super) end: f64,
    /// True while the present leg was shortened on account of an edge.
    pub(super) near: bool,
    /// Factor on the tolerance of the present leg.
    pub(super) sharpness: f64,
}

impl<D: Dynamics> Run<'_, D> {
    /// Asks for the edges anew: the modes have changed.
    pub(super) fn find_singularities(&mut self) {
        let modes = self.evaluator.modes.borrow();
        self.evaluator
            .dynamics
            .singularities(&modes, &mut self.singularities.list);
    }

    /// The tolerance of the present leg.
    pub(super) fn tolerance(&self) -> f64 {
        let sharp = self.settings.tolerance * self.singularities.sharpness;
        sharp.max(super::FINEST_TOLERANCE.min(self.settings.tolerance))
    }

    /// Steps that a method of fixed step takes in the present leg at least.
    pub(super) fn fewest_steps(&self) -> f64 {
        if self.singularities.near { FEWEST } else { 1.0 }
    }

    /// Ends the coming leg before it gets much nearer to an edge.
    pub(super) fn end_leg_before_edge(&mut self) {
        let mut longest = self.singularities.longest.take().unwrap_or(f64::INFINITY);
        self.singularities.near = longest.is_finite();
        self.singularities.sharpness = 1.0;
        for edge in &self.singularities.list {
            let approach = Approach::of(edge, &self.from);
            let near = NEAR_EDGE * edge.span;
            let far = approach.distance >= near || approach.distance <= self.end_distance(edge);
            if far || !approach.is_approaching() {
                continue; // or so close that the first step will end the run
            }
            let share = (approach.distance / near).max(SHARPEST);
            self.singularities.sharpness = self.singularities.sharpness.min(share);
            let aim = (approach.distance / RATIO).max(0.9 * self.end_distance(edge));
            self.singularities.near = true;
            longest = longest.min(approach.time_or_less(aim));
        }
        // Shorter than that, the clock would not move.
        let least = CLOCK * f64::EPSILON * self.from.time.abs();
        self.target = self.target.min(self.from.time + longest.max(least));
    }

    /// Distance from an edge at which the run ends.
    fn end_distance(&self, edge: &Singularity) -> f64 {
        edge.span * (TOLERANCES * self.settings.tolerance).clamp(LEAST, MOST)
    }

    /// Looks at the edges on the step between `from` and `to`, before anything
    /// else does. Where one is reached, `to` is drawn in to that place, with the
    /// state in the `middle` of what is left.
    pub(super) fn locate_singularity(
        &mut self,
        middle: &mut [f64],
    ) -> Result<Option<Singularity>, Verdict> {
        if self.singularities.list.is_empty() {
            return Ok(None);
        }
        self.output.quintic(&self.from, &self.to);
        match self.first_meeting() {
            EdgeMeeting::None => Ok(None),
            EdgeMeeting::TooLong(longest) => Err(self.repeat_shorter_step(longest)),
            EdgeMeeting::Reached(edge, 0.0) => Err(self.end_at(&edge)),
            EdgeMeeting::Reached(edge, s) => {
                let step = self.output.step(1.0);
                step.state(0.5 * s, middle);
                let (time, mut y) = (step.time(s), self.to.y.clone());
                step.state(s, &mut y);
                move_end_to(&mut self.to, self.evaluator, time, &y);
                Ok(Some(edge))
            }
        }
    }

    /// The step is taken anew, at most `longest` long, unless that is no longer a step.
    fn repeat_shorter_step(&mut self, longest: f64) -> Verdict {
        self.singularities.longest = Some(longest);
        self.singularities.shortened += 1;
        self.rejected += 1;
        self.evaluator.take_not_finite();
        let moves = longest > CLOCK * f64::EPSILON * self.from.time.abs();
        if !moves || self.singularities.shortened > SHORTENED {
            return self.end_at_floor(longest);
        }
        match self.check_limits() {
            Verdict::Continue => Verdict::Restart,
            stop => stop,
        }
    }

    fn first_meeting(&self) -> EdgeMeeting {
        let length = self.to.time - self.from.time;
        let mut reached = EdgeMeeting::None;
        let mut first = 1.0;
        for edge in &self.singularities.list {
            let start = Approach::of(edge, &self.from);
            let close = self.end_distance(edge);
            let aim = (CLOSER * start.distance)
                .min(NEAR_EDGE * edge.span)
                .max(close);
            let below = self.falls_below(edge, aim);
            if aim > close {
                let limit = start.time_to(start.distance / RATIO);
                if let Some(s) = below.filter(|&s| s < 1.0) {
                    let time = limit.filter(|_| start.distance < NEAR_EDGE * edge.span);
                    return EdgeMeeting::TooLong(0.9 * (s * length).min(time.unwrap_or(length)));
                }
                let turned = Approach::of(edge, &self.to).rate >= 0.0 && start.touches();
                let touched = start.time_to(0.0).is_some_and(|time| time <= length);
                if let (true, true, Some(limit)) = (turned, touched, limit) {
                    return EdgeMeeting::TooLong(limit.min(0.5 * length));
                }
            } else if let Some(s) = below.filter(|&s| s <= first) {
                // An edge that comes after the end of the run is none.
                let within = |time: f64| self.from.time + time <= self.singularities.end;
                if start.distance > close || start.time_to(0.0).is_none_or(within) {
                    (reached, first) = (EdgeMeeting::Reached(*edge, s), s);
                }
            }
        }
        reached
    }

    /// Where on the step the distance to an edge is below `aim`, and falling.
    fn falls_below(&self, edge: &Singularity, aim: f64) -> Option<f64> {
        let guard = |offset, displacement, speed| Guard {
            signal: edge.signal,
            offset,
            displacement,
            speed,
        };
        let nearer = guard(aim - edge.side * edge.place, edge.side, 0.0);
        let watch = EventFunction {
            guards: [nearer, guard(0.0, 0.0, edge.side)],
            rising: true,
            component: edge.component,
            target: 0,
        };
        let stretch = Stretch {
            step: self.output.step(1.0),
            from: &self.from,
            to: &self.to,
            zero_at_start: &[],
            touching: &[],
        };
        stretch.earliest(&[watch]).map(|found| found.s)
    }

    /// The run stands close to an edge, which ends it.
    pub(super) fn end_at(&mut self, edge: &Singularity) -> Verdict {
        let approach = Approach::of(edge, &self.from);
        let even = -2.0 * approach.distance / approach.rate;
        let expected = approach.time_to(0.0).unwrap_or(even);
        let far = 2.0 * self.end_distance(edge).max(approach.distance);
        let span = [self.from.time, self.singularities.end];
        let given = self
            .distance_on_law(edge)
            .and_then(|left| given::arrival(left, span, expected, far));
        let time = given.unwrap_or(self.from.time + expected);
        if time > self.singularities.end {
            // It is not reached any more.
            self.singularities.list.retain(|other| other != edge);
            return Verdict::Restart;
        }
        self.from.time = time;
        let stop = self.evaluator.dynamics.stop_at(time, edge);
        self.end(Stop::Physical(stop))
    }

    /// A method cannot go on, for the reason `stop`. Before an edge, that is
    /// why: the rest of the way is taken in shorter legs.
    pub(super) fn give_up_step(&mut self, stop: Stop) -> Verdict {
        let mut next: Option<(f64, Singularity)> = None;
        for edge in &self.singularities.list {
            let approach = Approach::of(edge, &self.from);
            let time = approach.time_or_less(0.0);
            if approach.is_approaching() && next.is_none_or(|(soonest, _)| time < soonest) {
                next = Some((time, *edge));
            }
        }
        let Some((time, edge)) = next else {
            return self.end(stop);
        };
        let approach = Approach::of(&edge, &self.from);
        let fixed = match self.settings.method {
            Method::Rk4 => self.settings.step.unwrap_or(0.0),
            _ => 0.0,
        };
        let near = approach.distance < NEAR_EDGE * edge.span || time <= 2.0 * fixed;
        if !near {
            return self.end(stop);
        }
        let clock = 1024.0 * f64::EPSILON * self.from.time.abs();
        if approach.distance <= self.end_distance(&edge) || time <= clock {
            return self.end_at(&edge);
        }
        self.singularities.failures += 1;
        if self.singularities.failures > ATTEMPTS {
            return self.end(stop);
        }
        self.singularities.longest =
            Some(time * 0.5f64.powi(self.singularities.failures as i32 + 1));
        self.rejected += 1;
        Verdict::Restart
    }

    /// After a step: a leg that has led near an edge ends, to go on with care.
    pub(super) fn is_to_slow_down(&self) -> bool {
        let near = |edge: &Singularity| {
            let approach = Approach::of(edge, &self.from);
            approach.is_approaching() && approach.distance < NEAR_EDGE * edge.span
        };
        !self.singularities.near && self.singularities.list.iter().any(near)
    }

    /// A step has been taken.
    pub(super) fn forget_failures(&mut self) {
        (self.singularities.failures, self.singularities.shortened) = (0, 0);
    }
}

/// Moves an end to (`time`, `y`).
fn move_end_to<D: Dynamics>(end: &mut End, evaluator: &Evaluator<'_, D>, time: f64, y: &[f64]) {
    let mut dy = vec![0.0; y.len()];
    evaluator.derivatives(time, y, &mut dy);
    end.set(evaluator, time, y, &dy);
}

#[cfg(test)]
mod tests {
    use super::Approach;

    fn approach(distance: f64, rate: f64, acceleration: f64) -> Approach {
        Approach {
            distance,
            rate,
            acceleration,
        }
    }

    #[test]
    fn the_time_of_the_edge_is_exact_for_both_kinds_of_approach() {
        // z = (0.3 − t)·(2 + t) at t = 0 falls through zero at 0.3.
        let through = approach(0.6, -1.7, -2.0);
        assert!(!through.touches());
        approx::assert_relative_eq!(through.time_to(0.0).unwrap(), 0.3, max_relative = 1e-15);
        // √z = (0.3 − t)·(2 + 0.1·t) touches zero at 0.3: z = w², ż = 2wẇ, z̈ = 2ẇ² + 2wẅ.
        let (w, slope, bend) = (0.6, 0.03 - 2.0, -0.2);
        let touching = approach(w * w, 2.0 * w * slope, 2.0 * (slope * slope + w * bend));
        assert!(touching.touches());
        approx::assert_relative_eq!(touching.time_to(0.0).unwrap(), 0.3, max_relative = 1e-14);
        // On the way, at t = 0.16, √z = 0.14·2.016.
        let aim = (0.14 * 2.016f64).powi(2);
        approx::assert_relative_eq!(touching.time_to(aim).unwrap(), 0.16, max_relative = 1e-13);
    }

    #[test]
    fn what_turns_back_or_moves_away_has_no_time() {
        // √z = 0.1 + (1 − t)²/2 turns back at 0.1.
        let (w, slope, bend) = (0.6, -1.0, 1.0);
        let turning = approach(w * w, 2.0 * w * slope, 2.0 * (slope * slope + w * bend));
        assert_eq!(turning.time_to(0.0), None);
        assert!(turning.time_to(0.04).is_some());
        assert!(turning.time_or_less(0.0) > 0.0);
        assert_eq!(approach(0.1, 1.0, -5.0).time_to(0.0), None);
        assert_eq!(approach(0.1, -1.0, 0.0).time_to(0.2), None);
    }
}
