//! Floquet multipliers with their errors, and the stability that follows.

use crate::math::order::Total;
use nalgebra::{Complex, DMatrix};
use serde::Serialize;

/// Stability of a periodic motion: what becomes of small disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stability {
    /// All die away.
    Attracts,
    /// None grows, but some stay: nothing damps them.
    Neutral,
    /// Some grow.
    Repels,
    /// A multiplier is so near to 1 in modulus that its error does not tell.
    Undecided,
}

/// Moduli of multipliers this near to 1 are 1, where their errors are no greater.
const UNIT: f64 = 1e-8;

/// Errors up to this are those of a derivative by differences: a modulus that is 1 within such
/// an error counts as 1.
const FINE: f64 = 1e-6;

impl Stability {
    /// The stability that multipliers tell.
    pub(super) fn of(multipliers: &[Multiplier]) -> Self {
        let ends = |sense: f64| {
            let all = multipliers.iter();
            let ends = all.map(|one| one.modulus + sense * one.error);
            // An error that is not known must not be lost.
            ends.fold(0.0, |most, end| {
                if end > most || end.is_nan() {
                    end
                } else {
                    most
                }
            })
        };
        match (ends(-1.0), ends(1.0)) {
            (_, most) if most < 1.0 - UNIT => Self::Attracts,
            (least, _) if least > 1.0 + UNIT => Self::Repels,
            (least, most) if (1.0 - most).abs().max((1.0 - least).abs()) <= 2.0 * FINE => {
                Self::Neutral
            }
            _ => Self::Undecided,
        }
    }
}

/// A Floquet multiplier: what becomes of a small disturbance in a period.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Multiplier {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
    /// Modulus.
    pub modulus: f64,
    /// Estimated error: its distance from the multiplier that a second derivative of the motion
    /// gives.
    pub error: f64,
}

/// Greatest modulus of an eigenvalue.
pub(super) fn greatest(monodromy: &DMatrix<f64>) -> f64 {
    let all = monodromy.complex_eigenvalues();
    all.iter().map(|one| one.norm()).fold(0.0, f64::max)
}

/// Eigenvalues, the greatest modulus first. Their errors are estimated by the same derivative
/// found another way.
pub(super) fn of(monodromy: &DMatrix<f64>, again: &DMatrix<f64>) -> Vec<Multiplier> {
    let mut others: Vec<Complex<f64>> = again.complex_eigenvalues().iter().copied().collect();
    let mut found: Vec<Complex<f64>> = monodromy.complex_eigenvalues().iter().copied().collect();
    found.sort_by_cached_key(|one| [one.norm(), one.im].map(|x| Total(-x)));
    let multiplier = |value: Complex<f64>| {
        let apart = |other: &Complex<f64>| (value - other).norm();
        let places = 0..others.len();
        let nearest = places.min_by(|&a, &b| apart(&others[a]).total_cmp(&apart(&others[b])));
        let error = nearest.map_or(f64::NAN, |place| apart(&others.swap_remove(place)));
        Multiplier {
            re: value.re,
            im: value.im,
            modulus: value.norm(),
            error,
        }
    };
    found.into_iter().map(multiplier).collect()
}

#[cfg(test)]
mod tests {
    use super::{Multiplier, Stability, of};
    use nalgebra::DMatrix;

    #[test]
    fn errors_are_distances_of_pairs() {
        let one = DMatrix::from_row_slice(3, 3, &[0.0, -0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.9]);
        let mut other = one.clone();
        other[(2, 2)] = 0.9 + 1e-7;
        let found = of(&one, &other);
        let errors: Vec<f64> = found.iter().map(|one| one.error).collect();
        approx::assert_abs_diff_eq!(errors[0], 1e-7, epsilon = 1e-15);
        // A pair of conjugates, each with its own.
        assert!(errors[1] < 1e-14 && errors[2] < 1e-14, "{errors:?}");
        assert_eq!((found[1].im, found[2].im), (0.5, -0.5));
    }

    #[test]
    fn stability_is_decided_as_far_as_errors_allow() {
        let of = |modulus: f64, error: f64| {
            Stability::of(&[Multiplier {
                re: modulus,
                im: 0.0,
                modulus,
                error,
            }])
        };
        assert_eq!(of(0.9, 0.05), Stability::Attracts);
        assert_eq!(of(0.9, 0.2), Stability::Undecided);
        assert_eq!(of(1.1, 0.2), Stability::Undecided);
        assert_eq!(of(1.1, 0.05), Stability::Repels);
        assert_eq!(of(1.0 + 1e-7, 5e-7), Stability::Neutral);
        // However near to 1: an error of 1e-3 leaves open whether disturbances grow.
        assert_eq!(of(1.0, 1e-3), Stability::Undecided);
        assert_eq!(of(1.0, f64::NAN), Stability::Undecided);
        assert_eq!(of(1.0 - 1e-9, 1e-12), Stability::Neutral);
        assert_eq!(of(1.1, f64::NAN), Stability::Undecided);
        assert_eq!(of(0.5, f64::NAN), Stability::Undecided);
    }
}
