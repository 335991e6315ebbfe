//! Extremes and integrals of a polynomial in Bernstein form, by halving.
//!
//! The coefficients enclose the polynomial: its maximum is never above the
//! greatest of them, and where all have one sign the polynomial has it too.
//! Halving the interval tightens this enclosure quadratically, so that a few
//! dozen halvings around the place in question give the result to rounding,
//! and nothing is overlooked on the way.

use crate::math::polynomial::{MAX_DEGREE, divide, evaluate};
use crate::math::roots::bracketed;

/// Halvings after which a piece is taken as it is: the enclosure is then as
/// tight as the square of 2⁻²⁷, below rounding.
const DEEPEST: u32 = 27;

/// Share of its greatest coefficient to which a polynomial is taken to be zero where it
/// changes its sign: the area that is lost is less than rounding.
const ZERO: f64 = 1e-12;

/// A polynomial on a piece of its interval.
#[derive(Clone, Copy)]
struct Piece {
    coefficients: [f64; MAX_DEGREE + 1],
    degree: usize,
    depth: u32,
    /// Start of the part in the interval.
    from: f64,
}

impl Piece {
    fn new(coefficients: &[f64], factor: f64) -> Self {
        let mut own = [0.0; MAX_DEGREE + 1];
        for (target, source) in own.iter_mut().zip(coefficients) {
            *target = factor * source;
        }
        Self {
            coefficients: own,
            degree: coefficients.len() - 1,
            depth: 0,
            from: 0.0,
        }
    }

    fn values(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }

    fn greatest(&self) -> f64 {
        self.values().iter().copied().fold(f64::MIN, f64::max)
    }

    fn magnitude(&self) -> f64 {
        self.values().iter().fold(0.0, |most, c| c.abs().max(most))
    }

    fn mean(&self) -> f64 {
        mean_of_coefficients(self.values())
    }

    fn has_one_sign(&self) -> bool {
        of_one_sign(self.values())
    }

    /// The only zero over [0, 1] of a piece whose coefficients change their sign once.
    fn only_zero(&self) -> Option<f64> {
        let all = self.values();
        let (first, last) = (all[0], all[self.degree]);
        let changes = all
            .windows(2)
            .filter(|two| (two[0] < 0.0) != (two[1] < 0.0));
        let tolerance = ZERO * self.magnitude();
        // (An end that is nearly zero may be one itself, beside another within.)
        if first.abs().min(last.abs()) <= tolerance || changes.count() != 1 {
            return None;
        }
        let found = bracketed(&mut |s| evaluate(all, s).0, [0.0, 1.0], tolerance);
        Some(found.at)
    }

    /// Length of a piece halved so often from the whole interval.
    fn width(&self) -> f64 {
        0.5f64.powi(self.depth as i32)
    }

    /// The parts left and right of s (de Casteljau).
    fn split(&self, s: f64) -> (Self, Self) {
        let (mut left, mut right) = (*self, *self);
        left.depth += 1;
        right.depth += 1;
        right.from += s * self.width();
        let all = ..=self.degree;
        divide(&mut left.coefficients[all], &mut right.coefficients[all], s);
        (left, right)
    }

    /// The part over [0, `end`].
    fn part_until(self, end: f64) -> Self {
        if end >= 1.0 {
            return self;
        }
        let (left, _) = self.split(end);
        Self {
            depth: 0,
            from: 0.0,
            ..left
        }
    }
}

/// The mean over [0, 1] of a polynomial in Bernstein form.
fn mean_of_coefficients(coefficients: &[f64]) -> f64 {
    coefficients.iter().sum::<f64>() / coefficients.len() as f64
}

/// Whether a polynomial's coefficients, and so its values over [0, 1], have one sign.
fn of_one_sign(coefficients: &[f64]) -> bool {
    coefficients.iter().all(|&c| c >= 0.0) || coefficients.iter().all(|&c| c <= 0.0)
}

/// Greatest value on [0, `end`] and its place, if it is greater than `floor`: what
/// cannot beat `floor` costs one look at the coefficients.
pub(crate) fn maximum(coefficients: &[f64], end: f64, floor: f64) -> Option<(f64, f64)> {
    extreme(coefficients, 1.0, end, floor)
}

/// Least value on [0, `end`] and its place, if it is less than `ceiling`.
pub(crate) fn minimum(coefficients: &[f64], end: f64, ceiling: f64) -> Option<(f64, f64)> {
    let found = extreme(coefficients, -1.0, end, -ceiling);
    found.map(|(value, place)| (-value, place))
}

fn extreme(coefficients: &[f64], factor: f64, end: f64, floor: f64) -> Option<(f64, f64)> {
    // (Without a copy: most often that is all.)
    let greatest = coefficients.iter().map(|c| factor * c);
    if greatest.fold(f64::MIN, f64::max) <= floor {
        return None;
    }
    let whole = Piece::new(coefficients, factor).part_until(end);
    let rounding = 4.0 * f64::EPSILON * whole.magnitude();
    let (mut best, mut place) = (floor, None);
    let mut pieces = vec![whole];
    while let Some(piece) = pieces.pop() {
        let (first, last) = (piece.coefficients[0], piece.coefficients[piece.degree]);
        for (value, at) in [(first, 0.0), (last, 1.0)] {
            if value > best {
                best = value;
                place = Some(end.min(1.0) * (piece.from + at * piece.width()));
            }
        }
        if piece.greatest() > best + rounding && piece.depth < DEEPEST {
            let (left, right) = piece.split(0.5);
            // The better half first: it raises `best` and spares the other.
            if left.greatest() > right.greatest() {
                pieces.extend([right, left]);
            } else {
                pieces.extend([left, right]);
            }
        }
    }
    place.map(|place| (best, place))
}

/// ∫|p| ds over [0, `end`], every zero crossing enclosed to rounding.
pub(crate) fn integral_of_magnitude(coefficients: &[f64], end: f64) -> f64 {
    // (Without a copy: most often that is all.)
    if end >= 1.0 && of_one_sign(coefficients) {
        return mean_of_coefficients(coefficients).abs() * end;
    }
    let whole = Piece::new(coefficients, 1.0).part_until(end);
    if whole.has_one_sign() {
        return whole.mean().abs() * end;
    }
    let mut sum = 0.0;
    let mut pieces = vec![whole];
    while let Some(piece) = pieces.pop() {
        if piece.has_one_sign() || piece.depth >= DEEPEST {
            sum += piece.mean().abs() * piece.width();
        } else if let Some(zero) = piece.only_zero() {
            let (left, right) = piece.split(zero);
            let area = zero * left.mean().abs() + (1.0 - zero) * right.mean().abs();
            sum += area * piece.width();
        } else {
            let (left, right) = piece.split(0.5);
            pieces.extend([right, left]);
        }
    }
    sum * end
}

#[cfg(test)]
mod tests {
    use super::{integral_of_magnitude, maximum, minimum};
    use approx::assert_abs_diff_eq;

    /// Bernstein coefficients of Σ a_k s^k on [0, 1].
    fn bernstein(powers: &[f64]) -> Vec<f64> {
        let n = powers.len() - 1;
        let choose =
            |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
        (0..=n)
            .map(|i| {
                (0..=i)
                    .map(|k| powers[k] * choose(i, k) / choose(n, k))
                    .sum()
            })
            .collect()
    }

    #[test]
    fn an_interior_extreme_is_found_to_rounding() {
        // s³ − s: minimum −2/(3√3) at 1/√3, maximum 0 at both ends.
        let p = bernstein(&[0.0, -1.0, 0.0, 1.0]);
        let least = -2.0 / (3.0 * 3f64.sqrt());
        let (found, place) = minimum(&p, 1.0, f64::MAX).unwrap();
        assert_abs_diff_eq!(found, least, epsilon = 1e-15);
        assert_abs_diff_eq!(place, 1.0 / 3f64.sqrt(), epsilon = 1e-7);
        assert_eq!(maximum(&p, 1.0, f64::MIN), Some((0.0, 0.0)));
    }

    #[test]
    fn a_cut_step_ends_where_it_is_cut() {
        let p = bernstein(&[0.0, -1.0, 0.0, 1.0]);
        let (found, place) = minimum(&p, 0.25, f64::MAX).unwrap();
        assert_abs_diff_eq!(found, 0.25f64.powi(3) - 0.25, epsilon = 1e-16);
        assert_eq!(place, 0.25);
        let area = 0.25f64.powi(2) / 2.0 - 0.25f64.powi(4) / 4.0;
        assert_abs_diff_eq!(integral_of_magnitude(&p, 0.25), area, epsilon = 1e-16);
    }

    #[test]
    fn what_cannot_beat_the_best_so_far_is_not_told() {
        let p = bernstein(&[0.0, -1.0, 0.0, 1.0]);
        assert_eq!(maximum(&p, 1.0, 0.5), None);
        assert_eq!(minimum(&p, 1.0, -0.5), None);
    }

    #[test]
    fn two_narrow_peaks_in_one_step_are_told_apart() {
        // −(s − 0.3)²·(s − 0.7)² + 0.01·s: the peak near 0.7 is the higher one.
        let quartic = [
            -0.0441,
            2.0 * 0.21 * 1.0 + 0.01,
            -(1.0 + 2.0 * 0.21),
            2.0,
            -1.0,
        ];
        let p = bernstein(&quartic);
        let value = |s: f64| quartic.iter().rev().fold(0.0, |sum, a| sum * s + a);
        let scan = (0..=2_000_000)
            .map(|i| value(f64::from(i) / 2e6))
            .fold(f64::MIN, f64::max);
        let (found, place) = maximum(&p, 1.0, f64::MIN).unwrap();
        assert_abs_diff_eq!(found, scan, epsilon = 1e-13);
        assert_abs_diff_eq!(value(place), scan, epsilon = 1e-13);
    }

    #[test]
    fn the_mean_magnitude_sees_every_crossing() {
        // (s − 0.1)(s − 0.5)(s − 0.8): pieces integrated by hand.
        let a = [-0.04, 0.53, -1.4, 1.0];
        let primitive = |s: f64| {
            a[0] * s + a[1] * s * s / 2.0 + a[2] * s.powi(3) / 3.0 + a[3] * s.powi(4) / 4.0
        };
        let knots = [0.0, 0.1, 0.5, 0.8, 1.0];
        let exact: f64 = knots
            .windows(2)
            .map(|w| (primitive(w[1]) - primitive(w[0])).abs())
            .sum();
        assert_abs_diff_eq!(
            integral_of_magnitude(&bernstein(&a), 1.0),
            exact,
            epsilon = 1e-16
        );
        assert_eq!(integral_of_magnitude(&[0.0; 6], 1.0), 0.0);
    }

    #[test]
    fn a_constant_costs_no_subdivision_and_a_double_zero_ends() {
        assert_eq!(maximum(&[2.0; 8], 1.0, f64::MIN), Some((2.0, 0.0)));
        // (s − 0.5)²: touches zero without crossing.
        let p = bernstein(&[0.25, -1.0, 1.0]);
        let (found, _) = minimum(&p, 1.0, f64::MAX).unwrap();
        assert_abs_diff_eq!(found, 0.0, epsilon = 1e-15);
        assert_abs_diff_eq!(integral_of_magnitude(&p, 1.0), 1.0 / 12.0, epsilon = 1e-15);
    }
}
