//! Fourier integrals of polynomials and sines on an interval, in closed form.
//!
//! On −1 ≤ y ≤ 1 the integral of yʲ·e^{−iκy} follows from that of the power before it or behind
//! it by integration by parts:
//!
//! iκ·I_j = j·I_{j−1} − E_j,  E_j = e^{−iκ} − (−1)ʲ·e^{iκ}
//!
//! Upwards this is stable for j ≤ κ, downwards for the others, from far beyond them, where the
//! start is forgotten. A sine is two exponentials. Nothing is sampled.

use nalgebra::Complex;
use std::f64::consts::TAU;

type C = Complex<f64>;

/// Powers beyond those wanted from which the downward recurrence begins.
const BEYOND: usize = 60;

/// Σ c_j·yʲ + Σ a·sin(w·y + p) on −1 ≤ y ≤ 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Terms {
    /// c_j, lowest power first.
    pub(crate) polynomial: Vec<f64>,
    /// Amplitude, frequency and phase of each sine.
    pub(crate) sines: Vec<[f64; 3]>,
}

/// A function on an interval of a longer axis: y = (x − middle)/half.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TermsOnInterval {
    pub(crate) middle: f64,
    pub(crate) half: f64,
    pub(crate) terms: Terms,
}

impl Terms {
    /// A constant.
    pub(crate) fn constant(value: f64) -> Self {
        Self::of_polynomial(vec![value])
    }

    /// A polynomial in y.
    pub(crate) fn of_polynomial(polynomial: Vec<f64>) -> Self {
        Self {
            polynomial,
            sines: Vec::new(),
        }
    }

    /// Σ a_j·xʲ with x = middle + half·y.
    pub(crate) fn of_powers(powers: &[f64], [middle, half]: [f64; 2]) -> Self {
        // Taylor's shift by Horner's scheme.
        let mut shifted = powers.to_vec();
        for from in 0..shifted.len() {
            for j in (from..shifted.len().saturating_sub(1)).rev() {
                shifted[j] += middle * shifted[j + 1];
            }
        }
        let mut scale = 1.0;
        for own in &mut shifted {
            *own *= scale;
            scale *= half;
        }
        Self::of_polynomial(shifted)
    }

    /// With a·sin(w·x + p) added, x = middle + half·y.
    pub(crate) fn plus_sine(mut self, [a, w, p]: [f64; 3], [middle, half]: [f64; 2]) -> Self {
        self.sines.push([a, w * half, p + w * middle]);
        self
    }

    /// base + height·f.
    pub(crate) fn scaled(mut self, base: f64, height: f64) -> Self {
        for own in &mut self.polynomial {
            *own *= height;
        }
        for sine in &mut self.sines {
            sine[0] *= height;
        }
        match self.polynomial.first_mut() {
            Some(first) => *first += base,
            None => self.polynomial.push(base),
        }
        self
    }

    /// The value at y.
    #[cfg(test)]
    pub(crate) fn at(&self, y: f64) -> f64 {
        let powers = self.polynomial.iter().rev().fold(0.0, |sum, c| sum * y + c);
        let sines = self.sines.iter().map(|[a, w, p]| a * (w * y + p).sin());
        powers + sines.sum::<f64>()
    }

    /// ∫f·e^{−iκy} dy from −1 to 1.
    pub(crate) fn transform(&self, kappa: f64) -> C {
        let powers = integrals_of_powers(self.polynomial.len(), kappa);
        let sum: C = self
            .polynomial
            .iter()
            .zip(powers)
            .map(|(c, own)| own * *c)
            .sum();
        let sine = |&[a, w, p]: &[f64; 3]| {
            let turned = C::from_polar(1.0, p);
            let ahead = turned * sinc(w - kappa);
            let behind = turned.conj() * sinc(w + kappa);
            (ahead - behind) * C::new(0.0, -a)
        };
        sum + self.sines.iter().map(sine).sum::<C>()
    }
}

/// ∫yʲ·e^{−iκy} dy from −1 to 1, for j below `count`.
fn integrals_of_powers(count: usize, kappa: f64) -> Vec<C> {
    if kappa == 0.0 {
        let whole = |j: usize| {
            if j.is_multiple_of(2) {
                2.0 / (j + 1) as f64
            } else {
                0.0
            }
        };
        return (0..count).map(|j| C::from(whole(j))).collect();
    }
    let (sin, cos) = kappa.sin_cos();
    let ends = |j: usize| match j % 2 {
        0 => C::new(0.0, -2.0 * sin),
        _ => C::from(2.0 * cos),
    };
    let ik = C::new(0.0, kappa);
    let mut all = vec![C::default(); count];
    let upwards = count.min(kappa.abs() as usize + 1);
    if count > 0 {
        all[0] = C::from(2.0 * sinc(kappa));
    }
    for j in 1..upwards {
        all[j] = (all[j - 1] * j as f64 - ends(j)) / ik;
    }
    let mut above = C::default();
    for j in (upwards.max(1)..count + BEYOND).rev() {
        // From I_{j+1} to I_j.
        above = (ik * above + ends(j + 1)) / (j + 1) as f64;
        if j < count {
            all[j] = above;
        }
    }
    all
}

/// sin x/x.
fn sinc(x: f64) -> f64 {
    match x.abs() < 1e-4 {
        true => 1.0 - x * x / 6.0,
        false => x.sin() / x,
    }
}

/// The coefficient of e^{i·2πk·x/period} of a function that is given on intervals which make up
/// one period: (1/period)·∫f·e^{−i·2πk·x/period} dx.
pub(crate) fn coefficient(pieces: &[TermsOnInterval], period: f64, order: f64) -> C {
    let wave = TAU * order / period;
    let piece = |own: &TermsOnInterval| {
        let turned = C::from_polar(own.half / period, -wave * own.middle);
        own.terms.transform(wave * own.half) * turned
    };
    pieces.iter().map(piece).sum()
}

#[cfg(test)]
mod tests {
    use super::{C, Terms, TermsOnInterval, coefficient, integrals_of_powers};
    use crate::math::quadrature::integrate;
    use std::f64::consts::{PI, TAU};

    /// ∫f·e^{−iκy} dy by adaptive quadrature.
    fn by_quadrature(f: &dyn Fn(f64) -> f64, kappa: f64) -> C {
        let part = |of: &dyn Fn(f64) -> f64| {
            let count = 40;
            let piece = |i: i32| {
                let at = |i: i32| -1.0 + 2.0 * f64::from(i) / f64::from(count);
                integrate(&|y| f(y) * of(kappa * y), at(i), at(i + 1), 1e-17).value
            };
            (0..count).map(piece).sum::<f64>()
        };
        C::new(part(&f64::cos), -part(&f64::sin))
    }

    #[test]
    fn powers_are_integrated_to_rounding_for_slow_and_fast_waves() {
        for kappa in [0.0, 1e-9, 0.3, 1.0, 5.9, 6.1, 14.7, 60.3] {
            for (j, own) in integrals_of_powers(16, kappa).into_iter().enumerate() {
                let expected = by_quadrature(&|y: f64| y.powi(j as i32), kappa);
                assert!(
                    (own - expected).norm() < 2e-15,
                    "{kappa} {j} {own} {expected}"
                );
            }
        }
    }

    #[test]
    fn sines_and_shifted_polynomials_are_integrated_to_rounding() {
        let place = [0.7, 0.4];
        let powers = [0.3, -1.2, 0.0, 2.5, -0.8];
        let terms = Terms::of_powers(&powers, place).plus_sine([1.3, 5.0, 0.4], place);
        let terms = terms.scaled(0.2, -1.5);
        let f = |y: f64| {
            let x = place[0] + place[1] * y;
            let sum = powers.iter().rev().fold(0.0, |sum, c| sum * x + c);
            0.2 - 1.5 * (sum + 1.3 * (5.0 * x + 0.4).sin())
        };
        for y in [-1.0, -0.2, 0.9] {
            approx::assert_abs_diff_eq!(terms.at(y), f(y), epsilon = 1e-14);
        }
        // At 2 the sine and the wave have one frequency.
        for kappa in [0.0, 0.5, 2.0, 2.0 + 1e-7, 17.0] {
            let error = (terms.transform(kappa) - by_quadrature(&f, kappa)).norm();
            assert!(error < 5e-15, "{kappa} {error:e}");
        }
    }

    #[test]
    fn a_saw_tooth_has_its_known_coefficients() {
        let piece = |middle: f64, half: f64| TermsOnInterval {
            middle,
            half,
            terms: Terms::of_powers(&[0.0, 1.0], [middle, half]),
        };
        let pieces = [
            piece(0.5, 0.5),
            piece(1.0 + 0.5 * (TAU - 1.0), 0.5 * (TAU - 1.0)),
        ];
        for k in 1..40 {
            let own = coefficient(&pieces, TAU, f64::from(k));
            // x on (0, 2π): i/k.
            assert!(
                (own - C::new(0.0, 1.0 / f64::from(k))).norm() < 1e-15,
                "{k} {own}"
            );
        }
        approx::assert_relative_eq!(coefficient(&pieces, TAU, 0.0).re, PI, max_relative = 1e-15);
    }
}
