//! Harmonics of the law that meet a mode at its own frequency, or next to it.
//!
//! A mode λ answers e^{iΩs} with the divided difference (e^{iΩs} − e^{λs})/(iΩ − λ),
//! at resonance with s·e^{iΩs}. Taken apart into a lane of iΩ and one of λ it
//! loses as many digits as iΩ and λ have in common. Here such a harmonic is a
//! polynomial instead, to rounding, over phases of a tenth of its period. The
//! mode's answer to a polynomial is a power series in which nothing cancels and
//! to which it makes no difference whether λ is near iΩ or equal to it. What the
//! motion grows by goes from phase to phase into the mode's own amplitude, so
//! that all bounds, figures and integrals hold as they are. Elsewhere, harmonics
//! stay what they are and phases are as long as they can be.

use super::law::{Forcing, LAW_DEGREE};
use super::pencil::C;

/// A mode nearer than this share of Ω to iΩ is near: farther away, at most three
/// digits of a harmonic's answer cancel.
const NEAR_RESONANCE: f64 = 1e-3;

/// Radians of a harmonic over which its polynomials hold to rounding.
const RADIANS: f64 = 0.6;

/// Coefficients of a harmonic's polynomial.
const TERMS: usize = LAW_DEGREE + 3;

/// True when a mode is too near to a harmonic for its answer to be a lane.
pub(super) fn is_near_resonance(lambda: C, omega: f64) -> bool {
    (C::new(0.0, omega) - lambda).norm() < NEAR_RESONANCE * omega
}

/// The harmonics of a law that are polynomials in a basis.
#[derive(Clone, Debug)]
pub(crate) struct Resonance {
    /// Numbers and frequencies of the harmonics.
    harmonics: Vec<(usize, f64)>,
    /// Length over which they hold (s).
    length: f64,
    /// cos x and sin x in powers of x.
    cosine: [f64; TERMS],
    sine: [f64; TERMS],
}

impl Resonance {
    /// `None` when there are no such harmonics.
    pub(super) fn new(harmonics: Vec<(usize, f64)>) -> Option<Self> {
        let fastest = harmonics.iter().fold(0.0f64, |most, h| most.max(h.1));
        (fastest > 0.0).then(|| Self {
            length: RADIANS / fastest,
            harmonics,
            cosine: twice_integrated([1.0, 0.0], |x| -x.cos(), |x| x.sin()),
            sine: twice_integrated([0.0, 1.0], |x| -x.sin(), |x| -x.cos()),
        })
    }

    /// Turns the harmonics of a forcing into polynomials.
    #[inline(never)]
    pub(super) fn make_polynomials(&self, forcing: &mut Forcing) {
        for &(j, omega) in &self.harmonics {
            let z = std::mem::take(&mut forcing.harmonics[j]);
            let mut power = 1.0;
            for (k, law) in forcing.law.iter_mut().enumerate() {
                *law += power * (z.re * self.cosine[k] - z.im * self.sine[k]);
                power *= omega;
            }
        }
        forcing.degree = TERMS - 1;
        forcing.reach = self.length;
    }
}

/// The function with given value and slope at 0 and the second derivative `f`,
/// whose own derivative is `g` (f″ = −f): Taylor's polynomial of f about the
/// middle of [0, RADIANS], integrated twice.
fn twice_integrated(
    [value, slope]: [f64; 2],
    f: impl Fn(f64) -> f64,
    g: impl Fn(f64) -> f64,
) -> [f64; TERMS] {
    let middle = 0.5 * RADIANS;
    let mut second = [0.0; LAW_DEGREE + 1];
    let mut factorial = 1.0;
    for (k, c) in second.iter_mut().enumerate() {
        factorial *= k.max(1) as f64;
        let derivative = if k % 2 == 0 { f(middle) } else { g(middle) };
        let sign = if (k / 2) % 2 == 0 { 1.0 } else { -1.0 };
        *c = sign * derivative / factorial;
    }
    super::law::shift(&mut second, -middle);
    let mut out = [0.0; TERMS];
    (out[0], out[1]) = (value, slope);
    for (k, c) in second.iter().enumerate() {
        out[k + 2] = c / ((k + 1) * (k + 2)) as f64;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_cosine_and_sine_to_rounding() {
        let resonance = Resonance::new(vec![(0, 7.0)]).expect("a harmonic");
        approx::assert_relative_eq!(resonance.length * 7.0, RADIANS, max_relative = 1e-15);
        // Value and second derivative.
        let at = |c: &[f64; TERMS], x: f64| {
            let mut sum = [0.0; 2];
            for k in (0..TERMS).rev() {
                sum[0] = sum[0] * x + c[k];
                if k >= 2 {
                    sum[1] = sum[1] * x + (k * (k - 1)) as f64 * c[k];
                }
            }
            sum
        };
        for i in 0..=40 {
            let x = RADIANS * f64::from(i) / 40.0;
            let ([c, ddc], [s, dds]) = (at(&resonance.cosine, x), at(&resonance.sine, x));
            for (own, exact) in [(c, x.cos()), (ddc, -x.cos()), (s, x.sin()), (dds, -x.sin())] {
                approx::assert_abs_diff_eq!(own, exact, epsilon = 2.5e-16);
            }
        }
    }
}
