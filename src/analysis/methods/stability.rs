//! How large a step a method bears: theory.
//!
//! An explicit Runge–Kutta method multiplies a motion e^(λt) by its stability
//! polynomial R(hλ) at every step of length h. While |R| ≤ 1 for every
//! eigenvalue λ of the system, errors do not grow; beyond, they grow at every
//! step, however small they were.
//!
//! Sources: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
//! 2nd ed. 1996, section IV.2 (regions of stability; 2√2 and 2.785 of the
//! classical method). The polynomial of dop853 is worked out from its tableau,
//! R(z) = 1 + z·bᵀ(I − zA)⁻¹·1.

use crate::integrate::Method;
use crate::system::System;

/// Growth a step that counts as none: rounding.
const SLACK: f64 = 1e-9;

/// An undamped eigenvalue has a real part of rounding only: this share of its size.
const ROUNDING: f64 = 1e-9;

/// Most coordinates for which all eigenvalues are found (a second's work).
const MOST_COORDINATES: usize = 150;

const RK4: [f64; 5] = [1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0];

const DOPRI5: [f64; 7] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 600.0,
];

const DOP853: [f64; 13] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40320.0,
    2.6916922001690937e-06,
    2.3413451082097831e-07,
    1.494736485459155e-08,
    3.613324578128244e-10,
];

/// Coefficients of the stability polynomial, the constant first; `None` for
/// methods that are not explicit Runge–Kutta methods, or not known here.
fn polynomial(method: Method) -> Option<&'static [f64]> {
    match method {
        Method::Rk4 => Some(&RK4),
        Method::Dopri5 => Some(&DOPRI5),
        Method::Dop853 => Some(&DOP853),
        _ => None,
    }
}

/// What theory says of a method's stability, in words, where there is no limit.
pub(super) fn remark(method: Method) -> Option<&'static str> {
    match method.name() {
        "tr_bdf2" | "esdirk34" | "rodas5p" | "radau" => Some("L-stable: no limit on the step"),
        "bdf" => Some(
            "no limit for damped motions; orders above 2 lose stability near the imaginary axis",
        ),
        "exact" => Some("takes no steps: no limit"),
        _ => None,
    }
}

/// Greatest |hλ| that a method bears in the direction of an eigenvalue
/// (real and imaginary part): the end of the ray from 0 along which |R| ≤ 1.
/// `None`: no such limit, or an eigenvalue that grows by itself.
pub fn stability_limit(method: Method, eigenvalue: [f64; 2]) -> Option<f64> {
    const STEP: f64 = 1e-2;
    const FARTHEST: usize = 4000;
    let coefficients = polynomial(method)?;
    let size = eigenvalue[0].hypot(eigenvalue[1]);
    let [re, im] = eigenvalue.map(|part| part / size);
    let re = if re.abs() < ROUNDING { 0.0 } else { re };
    if !(size > 0.0 && size.is_finite() && re <= 0.0) {
        return None;
    }
    let grows = |r: f64| growth(coefficients, r * re, r * im) > 1.0 + SLACK;
    let first = (1..FARTHEST).find(|&k| grows(STEP * k as f64))?;
    let (mut low, mut high) = (STEP * (first - 1) as f64, STEP * first as f64);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if grows(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(low)
}

/// |R(x + iy)|.
fn growth(coefficients: &[f64], x: f64, y: f64) -> f64 {
    let value = coefficients
        .iter()
        .rev()
        .fold([0.0, 0.0], |[a, b], c| [a * x - b * y + c, a * y + b * x]);
    value[0].hypot(value[1])
}

/// The eigenvalues of a system that matter for steps.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spectrum {
    /// All of them, where they were found.
    values: Option<Vec<[f64; 2]>>,
    /// The greatest size |λ| (1/s).
    pub(super) fastest: f64,
}

/// What bounds the step of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    /// The eigenvalue that bounds it (1/s).
    pub(super) eigenvalue: [f64; 2],
    /// Greatest |hλ| for that eigenvalue.
    pub(super) limit: f64,
}

impl Bound {
    /// |λ| (1/s).
    pub(super) fn rate(&self) -> f64 {
        self.eigenvalue[0].hypot(self.eigenvalue[1])
    }

    /// The greatest stable step (s).
    pub(super) fn step(&self) -> f64 {
        self.limit / self.rate()
    }
}

impl Spectrum {
    /// The eigenvalues of a system with all its pairs engaged.
    pub(super) fn of(system: &System, coordinates: usize) -> Self {
        let values = match coordinates {
            0..=MOST_COORDINATES => system.eigenvalues(),
            _ => None,
        };
        let fastest = match &values {
            Some(values) => values.iter().fold(0.0, |a: f64, v| a.max(v[0].hypot(v[1]))),
            None => by_iteration(system),
        };
        Self { values, fastest }
    }

    /// What bounds the step of a method; `None`: nothing does, or it is not known.
    pub(super) fn bound(&self, method: Method) -> Option<Bound> {
        let bounds = self.values.iter().flatten().filter_map(|&eigenvalue| {
            let limit = stability_limit(method, eigenvalue)?;
            Some(Bound { eigenvalue, limit })
        });
        bounds.min_by(|a, b| a.step().total_cmp(&b.step()))
    }
}

/// The greatest |λ| of a system too large for a full decomposition, at its start.
fn by_iteration(system: &System) -> f64 {
    match system.initial_state() {
        Ok(start) => crate::integrate::fastest_rate(system, 0.0, &start.y, &start.modes),
        Err(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::{polynomial, stability_limit};
    use crate::integrate::Method;

    #[test]
    fn limits_are_those_of_the_literature() {
        let limit = |method, re: f64, im: f64| stability_limit(method, [re, im]).unwrap();
        approx::assert_abs_diff_eq!(limit(Method::Rk4, 0.0, 1e4), 8f64.sqrt(), epsilon = 1e-6);
        approx::assert_abs_diff_eq!(limit(Method::Rk4, -3e5, 0.0), 2.785_294, epsilon = 1e-5);
        approx::assert_abs_diff_eq!(limit(Method::Dopri5, -1.0, 0.0), 3.306_6, epsilon = 1e-4);
        approx::assert_abs_diff_eq!(limit(Method::Dop853, -1.0, 0.0), 6.393_6, epsilon = 1e-3);
        // Rounding in the real part of an undamped eigenvalue does not matter.
        approx::assert_abs_diff_eq!(limit(Method::Rk4, 1e-12, 1.0), 8f64.sqrt(), epsilon = 1e-6);
    }

    #[test]
    fn growing_motions_and_implicit_methods_have_no_limit() {
        assert_eq!(stability_limit(Method::Rk4, [1.0, 1.0]), None);
        assert_eq!(stability_limit(Method::Rk4, [0.0, 0.0]), None);
        assert_eq!(stability_limit(Method::Esdirk34, [-1.0, 0.0]), None);
    }

    #[test]
    fn polynomials_begin_as_the_exponential_to_their_order() {
        for (method, order) in [(Method::Rk4, 4), (Method::Dopri5, 5), (Method::Dop853, 8)] {
            let mut factorial = 1.0;
            for (k, coefficient) in polynomial(method).unwrap().iter().enumerate() {
                if k > 0 {
                    factorial *= k as f64;
                }
                let agrees = (coefficient * factorial - 1.0).abs() < 1e-12;
                assert_eq!(agrees, k <= order, "{method}, power {k}");
            }
        }
    }
}
