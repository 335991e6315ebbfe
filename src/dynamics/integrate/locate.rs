//! The earliest switch on a step: every guard is a polynomial, and none of its
//! roots is skipped (see [`crate::math::polynomial`]).

use super::run::GrazingContact;
use super::{EventFunction, Guard, continuous::End};
use crate::math::polynomial::{
    Coefficients, MAX_DEGREE, Step, evaluate, first_both_positive, first_positive,
};

/// A switch found on a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LocatedEvent {
    /// Place on the step, 0 ≤ s ≤ 1.
    pub(super) s: f64,
    /// Index of the event function.
    pub(super) watch: usize,
}

/// A step with its exact ends, and the guards that are zero at its start
/// because they have just caused a switch.
pub(super) struct Stretch<'a> {
    pub(super) step: Step<'a>,
    pub(super) from: &'a End,
    pub(super) to: &'a End,
    pub(super) zero_at_start: &'a [Guard],
    /// Contacts that just touch: they come apart beyond what numbers resolve.
    pub(super) touching: &'a [GrazingContact],
}

impl Stretch<'_> {
    /// The earliest switch; at the same instant the one of the lowest
    /// component, then the first in the list.
    pub(super) fn earliest(&self, event_functions: &[EventFunction]) -> Option<LocatedEvent> {
        let mut best: Option<LocatedEvent> = None;
        for (index, watch) in event_functions.iter().enumerate() {
            let Some(s) = self.fires(watch) else { continue };
            let sooner = best.is_none_or(|b| {
                s < b.s || (s == b.s && watch.component < event_functions[b.watch].component)
            });
            if sooner {
                best = Some(LocatedEvent { s, watch: index });
            }
        }
        best
    }

    /// Guards of a watch that are zero, up to rounding, where it fired.
    pub(super) fn causes(&self, watch: &EventFunction, s: f64) -> impl Iterator<Item = Guard> {
        let degree = self.step.degree;
        watch.guards.into_iter().filter(move |guard| {
            let coefficients = self.guard_coefficients(guard, 1.0);
            let size = largest(&coefficients[..=degree]);
            evaluate(&coefficients[..=degree], s).0.abs() <= 1e-12 * size
        })
    }

    fn fires(&self, watch: &EventFunction) -> Option<f64> {
        let degree = self.step.degree;
        let sign = if watch.rising { 1.0 } else { -1.0 };
        let mut first = self.guard_coefficients(&watch.guards[0], sign);
        let mut second = self.guard_coefficients(&watch.guards[1], sign);
        let touches =
            |own: &&GrazingContact| own.component == watch.component && own.rising == watch.rising;
        if let Some(touching) = self.touching.iter().find(touches) {
            touching.shift([&mut first, &mut second], degree);
        }
        let (first, second) = (&first[..=degree], &second[..=degree]);
        if watch.guards[0] == watch.guards[1] {
            return first_positive(first).or_else(|| crosses_at_end(first).then_some(1.0));
        }
        if watch.rising {
            let at_end = || {
                let ready = |c: &[f64]| c[degree] > 0.0 || crosses_at_end(c);
                (ready(first) && ready(second)).then_some(1.0)
            };
            return first_both_positive(first, second).or_else(at_end);
        }
        let one = |c: &[f64]| first_positive(c).or_else(|| crosses_at_end(c).then_some(1.0));
        match (one(first), one(second)) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// On a step so short that the rate of a signal drowns in the rounding of
    /// its values (a rest of a leg, 1e-10 of the time), a guard is as straight
    /// as numbers can tell: the line between its exact ends.
    fn straighten(&self, guard: &Guard, out: &mut [f64]) {
        let degree = out.len() - 1;
        let differences = self.step.differences(guard.signal);
        let size = self.step.bases[guard.signal].abs() + largest(differences);
        let rate = degree as f64 / self.step.length;
        let rounding = f64::EPSILON
            * (guard.offset.abs() + size * (guard.displacement.abs() + guard.speed.abs() * rate));
        let (from, to) = (out[0], out[degree]);
        let line = |i: usize| from + (to - from) * i as f64 / degree as f64;
        let bent = |(i, c): (usize, &f64)| (c - line(i)).abs() > ROUNDINGS * rounding;
        if !out.iter().enumerate().any(bent) {
            (1..degree).for_each(|i| out[i] = line(i));
        }
    }

    /// Coefficients of ±guard. Both ends are computed from the exact state, so
    /// that a sign seen at the end of one step is the sign at the start of the
    /// next; a guard known to be zero at the start is shifted to be so.
    fn guard_coefficients(&self, guard: &Guard, sign: f64) -> Coefficients {
        let degree = self.step.degree;
        let signal = self.step.differences(guard.signal);
        let offset = guard.offset + guard.displacement * self.step.bases[guard.signal];
        let rate = degree as f64 / self.step.length;
        let slope = |i: usize| (signal[i + 1] - signal[i]) * rate;
        let mut out = [0.0; MAX_DEGREE + 1];
        let share = 1.0 / degree as f64;
        for (i, (c, &value)) in out.iter_mut().zip(signal).enumerate() {
            let mut sum = offset + guard.displacement * value;
            if guard.speed != 0.0 {
                let before = if i > 0 { i as f64 * slope(i - 1) } else { 0.0 };
                let after = if i < degree {
                    (degree - i) as f64 * slope(i)
                } else {
                    0.0
                };
                sum += guard.speed * (before + after) * share;
            }
            *c = sign * sum;
        }
        let exact = |end: &End| {
            let [value, rate, _] = end.signals[guard.signal];
            sign * (guard.offset + guard.displacement * value + guard.speed * rate)
        };
        out[0] = exact(self.from);
        out[degree] = exact(self.to);
        self.straighten(guard, &mut out[..=degree]);
        if self.zero_at_start.iter().any(|z| proportional(z, guard)) {
            let residue = out[0];
            out[..=degree].iter_mut().for_each(|c| *c -= residue);
        }
        out
    }
}

/// Roundings of a signal's value that may add up in a coefficient of its rate.
const ROUNDINGS: f64 = 256.0;

/// True when a polynomial reaches zero exactly at its end, rising.
fn crosses_at_end(coefficients: &[f64]) -> bool {
    let degree = coefficients.len() - 1;
    coefficients[degree] == 0.0 && coefficients[degree - 1] < 0.0
}

fn largest(coefficients: &[f64]) -> f64 {
    coefficients.iter().fold(0.0, |a, c| a.max(c.abs()))
}

/// True when two guards vanish at the same places.
fn proportional(a: &Guard, b: &Guard) -> bool {
    let same = |p: f64, q: f64| (p - q).abs() <= 1e-12 * p.abs().max(q.abs());
    a.signal == b.signal
        && same(a.offset * b.displacement, b.offset * a.displacement)
        && same(a.offset * b.speed, b.offset * a.speed)
        && same(a.displacement * b.speed, b.displacement * a.speed)
}
