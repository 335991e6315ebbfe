//! Is a step smooth enough to be looked at whole?
//!
//! Of the accelerations and forces at the places of a step the part is taken that
//! a polynomial of degree four does not follow. Where it is small, quadrature by
//! five points, exact to degree nine, is better than twice as many digits say, and a
//! parabola through three places tells where a peak is.

use super::observed::at_places;
use super::tally::Tally;
use crate::dynamics::segment::Signal;
use crate::dynamics::system::ObjectState;

/// Those that show best whether a step is smooth.
const FOLLOWED: [Signal; 3] = [Signal::Acceleration, Signal::Reaction, Signal::ContactForce];

/// Fifth divided differences over the first and the last six of the places
/// within a step, in units of the greatest value of the Chebyshev polynomial that has
/// them: 2⁹ over a step of length 1.
const DIFFERENCES: [[f64; 7]; 2] = [differences(0), differences(1)];

const fn differences(first: usize) -> [f64; 7] {
    let places = super::peaks::PLACES;
    let mut weights = [0.0; 7];
    let mut i = first;
    while i < first + 6 {
        let mut product = 512.0;
        let mut j = first;
        while j < first + 6 {
            if j != i {
                product *= places[i] - places[j];
            }
            j += 1;
        }
        weights[i] = 1.0 / product;
        i += 1;
    }
    weights
}

/// A step twice as long is rougher by two to this power.
const ORDER: f64 = 5.0;
/// What a smooth length may gain on the length that was looked at.
const MOST_GAIN: f64 = 4.0;
/// Some margin, so that the next step is not found to be a little too rough.
const MARGIN: f64 = 0.9;
/// Roughness below this is rounding.
const LEAST: f64 = 1e-8;

/// Measures roughness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smoothness {
    /// The share of its greatest value by which a quantity may leave the polynomial.
    allowed: f64,
}

impl Smoothness {
    /// For a run with a tolerance. Coefficients that fall by a factor r from one
    /// degree to the next leave r⁵ to the fifth and r¹⁰ to quadrature, which is to
    /// stay below a hundredth of the tolerance.
    pub(super) fn new(tolerance: f64) -> Self {
        Self {
            allowed: (1e-2 * tolerance).sqrt().max(LEAST),
        }
    }

    /// The greatest roughness of any object, in units of what is allowed; `states`
    /// are those at all places.
    pub(super) fn of(&self, states: &[ObjectState], objects: &[Tally]) -> f64 {
        let mut greatest = 0.0f64;
        for (object, tally) in objects.iter().enumerate() {
            for (signal, peak) in FOLLOWED.iter().zip(tally.greatest()) {
                let values = at_places(states, objects.len(), object, *signal);
                let size = values
                    .iter()
                    .fold(peak, |most, value| value.abs().max(most));
                for weights in &DIFFERENCES {
                    let terms = weights.iter().zip(&values);
                    let rough = terms.map(|(w, v)| w * v).sum::<f64>().abs();
                    if rough > greatest * size {
                        greatest = rough / size;
                    }
                }
            }
        }
        greatest / self.allowed
    }
}

/// The length (s) that would have been smooth, from the roughness of a length.
pub(super) fn smooth_length(length: f64, roughness: f64) -> f64 {
    let gain = roughness.powf(-1.0 / ORDER);
    length
        * if gain > 1.0 {
            (MARGIN * gain).clamp(1.0, MOST_GAIN)
        } else {
            MARGIN * gain
        }
}

#[cfg(test)]
mod tests {
    use super::super::peaks::PLACES;
    use super::{DIFFERENCES, smooth_length};
    use approx::assert_abs_diff_eq;

    fn rough(f: impl Fn(f64) -> f64) -> [f64; 2] {
        DIFFERENCES.map(|w| PLACES.iter().zip(w).map(|(&s, w)| w * f(s)).sum())
    }

    #[test]
    fn polynomials_of_degree_four_are_smooth_and_the_fifth_counts_whole() {
        for degree in 0..=4 {
            for found in rough(|s| (s - 0.3).powi(degree)) {
                assert_abs_diff_eq!(found, 0.0, epsilon = 1e-14);
            }
        }
        // T₅ on [0, 1], between −1 and 1.
        let chebyshev = |s: f64| (5.0 * (2.0 * s - 1.0).clamp(-1.0, 1.0).acos()).cos();
        for found in rough(chebyshev) {
            assert_abs_diff_eq!(found, 1.0, epsilon = 1e-13);
        }
    }

    #[test]
    fn the_length_that_is_smooth_follows_from_one_that_is_not() {
        // Its fifth differences grow with the fifth power of the length, and a little
        // faster.
        let of = |length: f64| {
            let all = rough(|s: f64| (length * s).exp()).map(f64::abs);
            all[0].max(all[1])
        };
        let allowed = 1e-6;
        let smooth = smooth_length(2.0, of(2.0) / allowed);
        assert!(smooth < 2.0 && of(smooth) < allowed, "{smooth}");
        assert!(of(1.6 * smooth) > allowed, "{smooth}");
        // What is smooth may be longer, but not without bound.
        assert_abs_diff_eq!(smooth_length(2.0, 0.0), 8.0);
        assert_abs_diff_eq!(smooth_length(2.0, 0.99), 2.0);
    }
}
