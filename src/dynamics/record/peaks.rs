//! Greatest values between samples, of quantities that are no polynomials.
//!
//! Speeds, accelerations and forces of the absolute motion are seen at both
//! ends and at the Gauss–Legendre points of every step. A parabola through
//! neighbours tells how much higher the quantity may rise between them; only
//! where that could beat the greatest value so far is it looked for closely.

use crate::dynamics::segment::Peak;
use crate::math::optimise::{refine_maximum_among, vertex};
use crate::math::quadrature::FIVE;

/// Places within a step, as fractions of it: its ends and the five
/// Gauss–Legendre points.
pub(crate) const PLACES: [f64; 7] = [
    0.0, FIVE[0].0, FIVE[1].0, FIVE[2].0, FIVE[3].0, FIVE[4].0, 1.0,
];

/// Weights of Gauss–Legendre quadrature over [0, 1] at [`PLACES`]; the ends
/// have none. Exact up to degree 9.
pub(crate) const WEIGHTS: [f64; 7] = [
    0.0, FIVE[0].1, FIVE[1].1, FIVE[2].1, FIVE[3].1, FIVE[4].1, 0.0,
];

/// Within a step shorter than this share of the time, speeds are little more than the
/// rounding of displacements over its length: its ends alone count.
const SPLINTER: f64 = 65_536.0 * f64::EPSILON;

impl Peak {
    /// Takes a step into account: `values` at `places` (ascending), `time`
    /// gives the time at a place and `look` the value there.
    pub(crate) fn add_step(
        &mut self,
        places: &[f64; 7],
        values: &[f64; 7],
        time: impl Fn(f64) -> f64,
        mut look: impl FnMut(f64) -> f64,
    ) {
        if self.excludes([time(places[0]), time(places[6])]) {
            return;
        }
        let [from, to] = [time(places[0]), time(places[6])];
        if (to - from).abs() <= SPLINTER * to.abs() {
            self.include(from, values[0]);
            self.include(to, values[6]);
            return;
        }
        let most = values.iter().copied().fold(f64::MIN, f64::max);
        let least = values.iter().copied().fold(f64::MAX, f64::min);
        // No parabola through three neighbours rises by more than their range.
        if most + 2.0 * (most - least) <= self.value {
            return;
        }
        for (&place, &value) in places.iter().zip(values) {
            self.include(time(place), value);
        }
        for top in 0..7 {
            let rising = top == 0 || values[top] >= values[top - 1];
            let falling = top == 6 || values[top] >= values[top + 1];
            if !(rising && falling) {
                continue;
            }
            let first = top.clamp(1, 5) - 1;
            let three = std::array::from_fn(|i| (places[first + i], values[first + i]));
            let Some((near, hoped)) = vertex(&three) else {
                continue;
            };
            // The parabola's gain is doubled: it is only an estimate.
            let gain = hoped - values[top];
            if gain > 1e-15 * hoped.abs() && values[top] + 2.0 * gain > self.value {
                let points = std::array::from_fn(|i| (places[i], values[i]));
                let (place, value) = refine_maximum_among(&points, top, near, &mut look);
                self.include(time(place), value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PLACES, WEIGHTS};
    use crate::dynamics::segment::Peak;
    use approx::assert_abs_diff_eq;

    fn peak_of(f: impl Fn(f64) -> f64 + Copy) -> (Peak, usize) {
        let (mut peak, mut looks) = (Peak::NONE, 0);
        peak.add_step(
            &PLACES,
            &PLACES.map(f),
            |s| 10.0 + s,
            |s| {
                looks += 1;
                f(s)
            },
        );
        (peak, looks)
    }

    #[test]
    fn quadrature_is_exact_to_degree_nine() {
        for degree in 0..=9 {
            let sum: f64 = PLACES
                .iter()
                .zip(WEIGHTS)
                .map(|(s, w)| w * s.powi(degree))
                .sum();
            assert_abs_diff_eq!(sum, 1.0 / f64::from(degree + 1), epsilon = 1e-15);
        }
    }

    #[test]
    fn a_smooth_top_is_found_to_rounding_wherever_it_lies() {
        for top in [0.003, 0.04, 0.17, 0.37, 0.5, 0.69, 0.9, 0.97, 0.999] {
            let (peak, looks) = peak_of(|s: f64| 3.0 * (1.3 * (s - top)).cos() + 1.0);
            assert_abs_diff_eq!(peak.value, 4.0, epsilon = 1e-14);
            assert_abs_diff_eq!(peak.time, 10.0 + top, epsilon = 1e-6);
            assert!(looks <= 12, "{looks} looks at {top}");
        }
    }

    #[test]
    fn rounding_within_a_splinter_of_a_step_is_no_peak() {
        let mut peak = Peak::NONE;
        let values = [1.0, 1.3, 0.7, 1.2, 1.1, 0.9, 1.01];
        peak.add_step(
            &PLACES,
            &values,
            |s| 3.0 + 2e-15 * s,
            |_| panic!("no look needed"),
        );
        assert_eq!(peak.value, 1.01);
    }

    #[test]
    fn a_monotone_step_needs_no_closer_look() {
        let (peak, looks) = peak_of(|s| s * s + s);
        assert_eq!((peak.value, peak.time, looks), (2.0, 11.0, 0));
    }

    #[test]
    fn a_top_that_cannot_beat_the_best_is_left_alone() {
        let mut peak = Peak::NONE;
        peak.include(0.0, 5.0);
        let f = |s: f64| 1.0 - (s - 0.4).powi(2);
        peak.add_step(&PLACES, &PLACES.map(f), |s| s, |_| panic!("no look needed"));
        assert_eq!(peak.value, 5.0);
    }

    #[test]
    fn only_times_within_the_bounds_count() {
        let mut peak = Peak::within([0.0, 0.45]);
        let f = |s: f64| 1.0 - (s - 0.5).powi(2);
        peak.add_step(&PLACES, &PLACES.map(f), |s| s, f);
        assert_eq!(peak.value, f(PLACES[2]));
        peak.include(0.45, f(0.45));
        assert_eq!(peak.value, f(0.45));
    }

    #[test]
    fn the_higher_of_two_tops_wins_though_its_samples_are_lower() {
        // Tops near 0.5 (sampled exactly) and near 0.88 (between samples, a little higher).
        let f = |s: f64| {
            (-(s - 0.5f64).powi(2) * 60.0).exp() + 1.01 * (-(s - 0.87f64).powi(2) * 60.0).exp()
        };
        let (peak, _) = peak_of(f);
        let scan = (0..=1_000_000)
            .map(|i| f(f64::from(i) * 1e-6))
            .fold(0.0, f64::max);
        assert_abs_diff_eq!(peak.value, scan, epsilon = 1e-11);
    }
}
