//! The peaks of a gain over the frequency.

use crate::math::optimise::{Peak, brent};
use serde::Serialize;

/// A peak of a gain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ResponsePeak {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Gain; null where it is unbounded, at an undamped mode.
    pub gain: Option<f64>,
    /// Phase (rad); null where the gain is unbounded.
    pub phase: Option<f64>,
    /// Number of the nearest mode, from 1.
    pub mode: Option<usize>,
}

/// Part of the interval around a peak to which it is found.
const LOCATED: f64 = 1e-9;

/// Places of the greatest values of a function between `places`, in ascending order.
pub(super) fn peaks(places: &[f64], gain: &mut dyn FnMut(f64) -> f64) -> Vec<f64> {
    let values: Vec<f64> = places.iter().map(|&place| gain(place)).collect();
    let mut found = Vec::new();
    for i in 1..places.len().saturating_sub(1) {
        if values[i] > values[i - 1] && values[i] >= values[i + 1] {
            let start = Peak {
                at: places[i],
                value: values[i],
            };
            let ends = [places[i - 1], places[i + 1]];
            found.push(brent(start, ends, LOCATED, gain).at);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::peaks;

    #[test]
    fn narrow_peaks_are_found_between_two_places() {
        let line = |x: f64, at: f64, width: f64| 1.0 / (1.0 + ((x - at) / width).powi(2));
        let mut gain = |x: f64| line(x, 3.0, 0.5) + line(x, 7.25, 1e-3);
        let mut places: Vec<f64> = (0..=20).map(|i| 0.5 * f64::from(i)).collect();
        places.push(7.25);
        places.sort_by(f64::total_cmp);
        let found = peaks(&places, &mut gain);
        assert_eq!(found.len(), 2);
        approx::assert_abs_diff_eq!(found[0], 3.0, epsilon = 1e-6);
        approx::assert_abs_diff_eq!(found[1], 7.25, epsilon = 1e-6);
    }
}
