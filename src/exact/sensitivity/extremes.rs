//! Greatest values with their derivatives, and the places that may be greatest.
//!
//! The derivative of a greatest value is that of the signal where it is met. Where the slope of the
//! signal vanishes, a change of the place adds nothing. At an event or at an end of the run the
//! place moves along: the number that stands there has its total derivative already.

use super::expansion::{ORDER, Signal, TERMS, value_and_slope};
use crate::math::number::Number;
use crate::math::polynomial::{Coefficients, sign_changes};

/// Share of the greatest value within which others count as reached too.
const TIE: f64 = 1e-9;

/// Most places that are kept of those that share the greatest value.
const MOST_TIES: usize = 64;

/// The greatest value of a signal, at all places where it is reached.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Greatest<N> {
    /// Time (s) and value, in the order of time.
    pub(crate) places: Vec<(f64, N)>,
    best: f64,
}

impl<N: Number> Default for Greatest<N> {
    fn default() -> Self {
        Self {
            places: Vec::new(),
            best: f64::NEG_INFINITY,
        }
    }
}

impl<N: Number> Greatest<N> {
    /// The greatest value; `None`: nothing was offered.
    pub(crate) fn value(&self) -> Option<f64> {
        (!self.places.is_empty()).then_some(self.best)
    }

    /// What a value must reach to count.
    pub(super) fn limit(&self) -> f64 {
        self.best - TIE * self.best.abs()
    }

    /// Takes a value in.
    pub(super) fn offer(&mut self, time: f64, value: N) {
        let size = value.value();
        if size < self.limit() {
            return;
        }
        self.best = self.best.max(size);
        let limit = self.limit();
        self.places.retain(|(_, value)| value.value() >= limit);
        self.places.push((time, value));
        if self.places.len() > MOST_TIES {
            // The one that is farthest below the greatest.
            let values = self.places.iter().map(|place| place.1.value());
            let least = values.fold(f64::INFINITY, f64::min);
            let at = self
                .places
                .iter()
                .position(|place| place.1.value() == least);
            self.places.remove(at.unwrap_or(0));
        }
    }
}

/// A stretch of a signal: from the instant of its expansion on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<N> {
    /// Instant of the expansion.
    pub(super) from: f64,
    /// Length.
    pub(super) length: N,
    /// True: an event or the start of the run is at its start.
    pub(super) begins: bool,
    /// True: an event or the end of the run is at its end.
    pub(super) ends: bool,
}

/// Changes of sign of polynomials, with room that is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct ExtremeSearch {
    found: Vec<f64>,
}

impl ExtremeSearch {
    /// The places within 0 … length at which a signal changes its sign.
    pub(super) fn sign_changes<N: Number>(&mut self, signal: &Signal<N>, length: f64) -> &[f64] {
        self.search(&bernstein(signal, length), length)
    }

    /// The places within 0 … length at which a signal has an extreme.
    pub(super) fn extremes<N: Number>(&mut self, signal: &Signal<N>, length: f64) -> &[f64] {
        // Differences of the coefficients are those of the slope, but for a factor.
        let mut row = bernstein(signal, length);
        for order in 0..ORDER {
            row[order] = row[order + 1] - row[order];
        }
        row[ORDER] = row[ORDER - 1];
        self.search(&row[..ORDER], length);
        for at in &mut self.found {
            *at = polished(signal, *at, length);
        }
        &self.found
    }

    fn search(&mut self, row: &[f64], length: f64) -> &[f64] {
        self.found.clear();
        sign_changes(row, &mut self.found);
        self.found.iter_mut().for_each(|share| *share *= length);
        &self.found
    }

    /// Offers the values of ±signal over a stretch that may be greatest.
    pub(super) fn offer<N: Number>(
        &mut self,
        (sign, signal): (f64, &Signal<N>),
        stretch: Stretch<N>,
        to: &mut Greatest<N>,
    ) {
        let length = stretch.length.value();
        if upper_bound(sign, signal, length) < to.limit() {
            return;
        }
        if stretch.begins {
            to.offer(stretch.from, signal[0].scale(sign));
        }
        if stretch.ends {
            let [value, _] = value_and_slope(signal, stretch.length);
            to.offer(stretch.from + length, value.scale(sign));
        }
        for &at in self.extremes(signal, length) {
            let [value, _] = value_and_slope(signal, N::from(at));
            to.offer(stretch.from + at, value.scale(sign));
        }
    }
}

/// An extreme by Newton's method on the series itself, which is rounded less than its form over
/// the whole step.
fn polished<N: Number>(signal: &Signal<N>, mut at: f64, length: f64) -> f64 {
    for _ in 0..2 {
        let (mut slope, mut bend) = (0.0, 0.0);
        for (order, term) in signal.iter().enumerate().skip(1).rev() {
            bend = bend * at + slope;
            slope = slope * at + order as f64 * term.value();
        }
        let step = slope / bend;
        if step.abs() < 1e-3 * length {
            at = (at - step).clamp(0.0, length);
        }
    }
    at
}

/// Nothing of ±signal is above it.
fn upper_bound<N: Number>(sign: f64, signal: &Signal<N>, length: f64) -> f64 {
    let mut rest = 0.0;
    for term in signal[1..].iter().rev() {
        rest = (rest + term.value().abs()) * length;
    }
    sign * signal[0].value() + rest
}

/// Bernstein coefficients of a signal over 0 … length.
fn bernstein<N: Number>(signal: &Signal<N>, length: f64) -> Coefficients {
    // Powers times (i over k)/(n over k), summed up in a triangle of differences.
    let mut row = [0.0; TERMS];
    let (mut power, mut binomial) = (1.0, 1.0);
    for (k, term) in signal.iter().enumerate() {
        row[k] = term.value() * power / binomial;
        power *= length;
        binomial *= (ORDER - k) as f64 / (k + 1) as f64;
    }
    for level in 1..TERMS {
        for k in (level..TERMS).rev() {
            row[k] += row[k - 1];
        }
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polynomial::evaluate;

    fn wave() -> Signal<f64> {
        // sin(3·t + 0.2)
        let mut signal = [0.0; TERMS];
        let mut power = 1.0;
        for (k, term) in signal.iter_mut().enumerate() {
            let angle: f64 = 0.2 + k as f64 * std::f64::consts::FRAC_PI_2;
            *term = power * angle.sin();
            power *= 3.0 / (k + 1) as f64;
        }
        signal
    }

    #[test]
    fn the_bernstein_form_has_the_same_values() {
        let signal = wave();
        let row = bernstein(&signal, 0.6);
        for share in [0.0, 0.3, 0.9, 1.0] {
            let expected = f64::sin(0.2 + 3.0 * 0.6 * share);
            approx::assert_abs_diff_eq!(evaluate(&row, share).0, expected, epsilon = 1e-13);
        }
    }

    #[test]
    fn extremes_and_changes_of_sign_are_those_of_the_sine() {
        let (signal, mut places) = (wave(), ExtremeSearch::default());
        let top = (std::f64::consts::FRAC_PI_2 - 0.2) / 3.0;
        let found = places.extremes(&signal, 0.7).to_vec();
        assert_eq!(found.len(), 1);
        approx::assert_abs_diff_eq!(found[0], top, epsilon = 1e-9);
        let zero = (std::f64::consts::PI - 0.2) / 3.0;
        let found = places.sign_changes(&signal, 1.1).to_vec();
        assert_eq!(found.len(), 1);
        approx::assert_abs_diff_eq!(found[0], zero, epsilon = 1e-10);
    }

    #[test]
    fn ties_are_kept_and_lesser_values_dropped() {
        let mut greatest = Greatest::default();
        for (time, value) in [(0.0, 1.0), (1.0, 3.0), (2.0, 3.0 - 1e-12), (3.0, 2.0)] {
            greatest.offer(time, value);
        }
        assert_eq!(greatest.places, [(1.0, 3.0), (2.0, 3.0 - 1e-12)]);
        assert_eq!(greatest.value(), Some(3.0));
    }
}
