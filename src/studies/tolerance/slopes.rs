//! Derivatives of results by differences, where they are not carried exactly.

use super::zone::Zone;
use crate::studies::gradient::central_differences;

/// Places on either side of the middle, as shares of half the zone.
pub(super) const PLACES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Relative error beyond which the results do not follow a smooth curve.
const SMOOTH: f64 = 1e-4;

/// A derivative by differences.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slope {
    /// The derivative.
    pub(super) value: f64,
    /// Its estimated error.
    pub(super) error: f64,
}

/// The derivative at the middle of a zone from results at [`PLACES`] above and below. Where they
/// follow a smooth curve it is of order 8. Elsewhere it is one central difference over a quarter
/// of the zone. `None`: there are no results on one of the sides.
pub(super) fn slope(zone: &Zone, above: &[Option<f64>], below: &[Option<f64>]) -> Option<Slope> {
    let step = PLACES[0] * zone.half();
    let rows = |values: &[Option<f64>]| -> Vec<Vec<f64>> {
        let known = values.iter().map_while(|value| *value);
        known.map(|value| vec![value]).collect()
    };
    let (above, below) = (rows(above), rows(below));
    let known = above.len().min(below.len());
    let of = |count: usize| central_differences(1, step, &above[..count], &below[..count])[0];
    if known == PLACES.len() {
        let (value, coarser) = (of(known), of(known - 1));
        let error = (value - coarser).abs();
        let rounding = 8.0 * f64::EPSILON * above[0][0].abs() / step;
        if error <= SMOOTH * value.abs() + rounding {
            let error = error.max(rounding);
            // What rounding alone gives is none.
            let value = if value.abs() <= rounding { 0.0 } else { value };
            return Some(Slope { value, error });
        }
    }
    let value = match known {
        0 => return None,
        _ => of(1),
    };
    // The central difference over twice the distance has four times the error.
    let error = match known {
        1 => f64::INFINITY,
        _ => (value - 0.5 * (above[1][0] - below[1][0]) / (2.0 * step)).abs(),
    };
    Some(Slope { value, error })
}

#[cfg(test)]
mod tests {
    use super::super::zone::{Distribution, Zone};
    use super::{PLACES, slope};

    fn slope_of(f: impl Fn(f64) -> Option<f64>, half: f64) -> Option<super::Slope> {
        let zone = Zone {
            lower: -half,
            upper: half,
            distribution: Distribution::Normal,
        };
        let side = |sign: f64| PLACES.map(|place| f(sign * place * half));
        slope(&zone, &side(1.0), &side(-1.0))
    }

    #[test]
    fn smooth_results_have_derivatives_of_high_order() {
        let found = slope_of(|x| Some((1.0 + x).sin()), 0.1).unwrap();
        let off = (found.value - 1f64.cos()).abs();
        assert!(off < 1e-12 && off <= 10.0 * found.error, "{found:?}");
        assert!(found.error < 1e-9);
    }

    #[test]
    fn results_with_a_kink_have_one_central_difference() {
        // A kink beyond the first place.
        let found = slope_of(|x| Some(x + 5.0 * (x - 0.06).max(0.0)), 0.1).unwrap();
        assert!((found.value - 1.0).abs() < 1e-13, "{found:?}");
        // A kink in the middle: the mean of both sides, and no error of it is seen.
        let found = slope_of(|x| Some(x.abs() + x), 0.1).unwrap();
        assert!((found.value - 1.0).abs() < 1e-13, "{found:?}");
    }

    #[test]
    fn results_that_are_missing_are_done_without() {
        let found = slope_of(|x| (x < 0.06).then_some(2.0 * x), 0.1).unwrap();
        assert!((found.value - 2.0).abs() < 1e-13);
        assert!(
            slope_of(|x| (x < 0.03).then_some(x), 0.1)
                .unwrap()
                .error
                .is_infinite()
        );
        assert_eq!(slope_of(|x| (x < 0.0).then_some(x), 0.1), None);
    }
}
