//! ∫|f| of what is observed at the places of a stretch alone.

use super::peaks::PLACES;
use super::subdivision::integral_of_magnitude;

/// Binomial coefficients of the sixth row.
const SIXTH: [f64; 7] = [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0];

/// ∫|f| over [0, 1] of the polynomial through the values at [`PLACES`].
pub(super) fn area(values: &[f64; 7]) -> f64 {
    // Newton's divided differences, then powers, then Bernstein's form.
    let mut divided = *values;
    for order in 1..7 {
        for k in (order..7).rev() {
            divided[k] = (divided[k] - divided[k - 1]) / (PLACES[k] - PLACES[k - order]);
        }
    }
    let mut powers = [0.0; 7];
    for (place, &coefficient) in PLACES.iter().zip(&divided).rev() {
        for k in (1..7).rev() {
            powers[k] = powers[k - 1] - place * powers[k];
        }
        powers[0] = coefficient - place * powers[0];
    }
    let mut bernstein = [0.0; 7];
    for (i, target) in bernstein.iter_mut().enumerate() {
        let mut ways = 1.0;
        for k in 0..=i {
            *target += ways / SIXTH[k] * powers[k];
            ways *= (i - k) as f64 / (k + 1) as f64;
        }
    }
    integral_of_magnitude(&bernstein, 1.0)
}

#[cfg(test)]
mod tests {
    use super::{PLACES, area};

    #[test]
    fn magnitudes_are_integrated_through_zeros() {
        let of = |f: fn(f64) -> f64| area(&PLACES.map(f));
        approx::assert_relative_eq!(of(|x| x - 0.25), 0.3125, max_relative = 1e-12);
        approx::assert_relative_eq!(of(|x| x.powi(6)), 1.0 / 7.0, max_relative = 1e-12);
        // (x − ½)³ on both sides: 2·(½)⁴/4.
        approx::assert_relative_eq!(of(|x| (x - 0.5).powi(3)), 1.0 / 32.0, max_relative = 1e-11);
        assert_eq!(of(|_| -2.0), 2.0);
    }
}
