//! Extremes of functions of a law.

use super::{Law, Peak};
use crate::jet::Jet;

/// Intervals a piece is searched in: a polynomial of the highest degree allowed
/// has far fewer turning points.
const INTERVALS: usize = 64;

/// Differences that count as rounding when two extremes are compared.
const SAME: f64 = 1e-13;

impl Law {
    /// The greatest value of a function of the law, and the first τ where it
    /// is reached; with `ends`, both one-sided values at 0 and 1 count.
    pub(super) fn peak_of(&self, value: impl Fn(&Jet) -> f64, ends: bool) -> Peak {
        let mut best = Peak {
            value: f64::NEG_INFINITY,
            at: 0.0,
        };
        for (piece, from, to) in self.pieces() {
            let at = |tau: f64| value(&self.jet(piece, tau));
            let tau = |i: usize| from + (to - from) * i as f64 / INTERVALS as f64;
            let samples: Vec<f64> = (0..=INTERVALS).map(|i| at(tau(i))).collect();
            for i in 0..=INTERVALS {
                let outer = tau(i) == 0.0 || tau(i) == 1.0;
                if ends || !outer {
                    best.raise(samples[i], tau(i));
                }
                let inner = i > 0 && i < INTERVALS;
                if inner && samples[i] >= samples[i - 1] && samples[i] >= samples[i + 1] {
                    let (value, place) = golden(&at, tau(i - 1), tau(i + 1));
                    best.raise(value, place);
                }
            }
            // Steep ends: the greatest value may lie within the outer intervals.
            for (a, b) in [(0, 1), (INTERVALS - 1, INTERVALS)] {
                let (value, place) = golden(&at, tau(a), tau(b));
                best.raise(value, place);
            }
        }
        best
    }

    /// As [`Self::peak_of`], the place sharpened where the `slope` of the
    /// value along τ changes its sign.
    pub(super) fn sharp_peak(
        &self,
        value: impl Fn(&Jet) -> f64,
        slope: impl Fn(&Jet) -> f64,
    ) -> Peak {
        let rough = self.peak_of(&value, true);
        let reach = 1e-4;
        for (piece, from, to) in self.pieces() {
            let (low, high) = ((rough.at - reach).max(from), (rough.at + reach).min(to));
            if low >= high || !(low..=high).contains(&rough.at) {
                continue;
            }
            let at = |tau: f64| slope(&self.jet(piece, tau));
            if at(low) > 0.0 && at(high) < 0.0 {
                let place = bisect(&at, low, high);
                return Peak {
                    value: value(&self.jet(piece, place)),
                    at: place,
                };
            }
        }
        rough
    }
}

impl Peak {
    /// Takes the greater one; of equal ones the first stays.
    fn raise(&mut self, value: f64, at: f64) {
        let floor = SAME * self.value.abs().max(SAME);
        if !self.value.is_finite() || value > self.value + floor {
            *self = Self { value, at };
        }
    }
}

/// The place where a function falls through zero.
fn bisect(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Greatest value and its place between `low` and `high` (golden section).
fn golden(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> (f64, f64) {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..60 {
        if fa >= fb {
            high = b;
            (b, fb) = (a, fa);
            a = high - ratio * (high - low);
            fa = f(a);
        } else {
            low = a;
            (a, fa) = (b, fb);
            b = low + ratio * (high - low);
            fb = f(b);
        }
    }
    if fa >= fb { (fa, a) } else { (fb, b) }
}
