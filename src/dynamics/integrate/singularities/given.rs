//! When a motion given over time reaches an edge: on its law, which may arrive
//! with hardly any speed, where no parabola says when.

use crate::dynamics::integrate::run::Run;
use crate::dynamics::integrate::{Dynamics, Singularity};
use crate::math::roots::bisect;

/// Share of the expected way that the first look takes, and growth of the next.
const FIRST: f64 = 1.0 / 16.0;
const GROWTH: f64 = 1.1;
/// Looks at most.
const MOST: usize = 2000;

/// Distance that is left to an edge at an instant, and its rate.
type Left = [f64; 2];

impl<D: Dynamics> Run<'_, D> {
    /// What is left to an edge, with its rate, at an instant, where the signal is
    /// a given function of time.
    pub(super) fn distance_on_law(
        &self,
        edge: &Singularity,
    ) -> Option<impl Fn(f64) -> [f64; 2] + use<'_, D>> {
        let (dynamics, edge) = (self.evaluator.dynamics, *edge);
        dynamics.given_signal(edge.signal, self.from.time)?;
        Some(move |time| {
            let given = dynamics.given_signal(edge.signal, time);
            let [value, rate] = given.unwrap_or([f64::NAN; 2]);
            [edge.side * (edge.place - value), -edge.side * rate]
        })
    }
}

/// The first instant after `from` at which nothing is left, looked for in steps
/// that fit `expected` (s), up to `end`; `None`: it was not found before more
/// than `far` is left again.
pub(super) fn arrival(
    left: impl Fn(f64) -> Left,
    [from, end]: [f64; 2],
    expected: f64,
    far: f64,
) -> Option<f64> {
    let (mut before, mut step) = (from, FIRST * expected);
    let mut last = left(from);
    if !(last[0] > 0.0 && step > 0.0 && step.is_finite()) {
        return None;
    }
    for _ in 0..MOST {
        let after = before + step;
        let now = left(after);
        if now[0] <= 0.0 {
            return Some(first_instant(before, after, |time| left(time)[0] <= 0.0));
        }
        if last[1] < 0.0 && now[1] > 0.0 {
            // It turns back in between: beyond the edge or before it?
            let turn = first_instant(before, after, |time| left(time)[1] >= 0.0);
            if left(turn)[0] <= 0.0 {
                return Some(first_instant(before, turn, |time| left(time)[0] <= 0.0));
            }
        }
        if !(now[0] <= far) {
            return None;
        }
        if after > end {
            return Some(after);
        }
        (before, last, step) = (after, now, GROWTH * step);
    }
    None
}

/// The first instant between two at which something holds that does so from there on.
fn first_instant(before: f64, after: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let [_, first] = bisect([before, after], 100, |time| !holds(time));
    first
}

#[cfg(test)]
mod tests {
    use super::arrival;

    #[test]
    fn an_arrival_with_hardly_any_speed_is_found_on_the_law() {
        // Left: (t − 1)² − over, from just before.
        for over in [1e-3f64, 1e-7, 1e-12] {
            let left = |t: f64| [(t - 1.0) * (t - 1.0) - over, 2.0 * (t - 1.0)];
            let found = arrival(left, [0.9, 10.0], 0.1, 0.1).expect("an arrival");
            approx::assert_abs_diff_eq!(found, 1.0 - over.sqrt(), epsilon = 1e-10);
        }
    }

    #[test]
    fn what_turns_back_or_comes_after_the_end_is_told() {
        let left = |t: f64| [(t - 1.0) * (t - 1.0) + 1e-9, 2.0 * (t - 1.0)];
        assert_eq!(arrival(left, [0.9, 10.0], 0.1, 0.02), None);
        let found = arrival(|t| [5.0 - t, -1.0], [0.0, 1.0], 0.5, 10.0);
        assert!(found.expect("an instant") > 1.0);
    }
}
