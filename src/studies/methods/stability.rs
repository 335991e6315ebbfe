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

use crate::dynamics::integrate::{Method, series_degree};
use crate::dynamics::system::System;
use crate::math::roots::bisect;

/// Growth a step that counts as none: rounding.
const SLACK: f64 = 1e-9;

/// The same of power series. Some degrees grow on the imaginary axis at any step,
/// by as little as the step is short: what takes a million steps to grow
/// threefold is no instability.
pub(super) const SERIES_SLACK: f64 = 1e-6;

/// An undamped eigenvalue has a real part of rounding only: this share of its size.
const UNDAMPED: f64 = 1e-9;

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

/// Degree of a method of power series at a tolerance.
pub(super) fn degree(method: Method, tolerance: f64) -> Option<usize> {
    (method == Method::Taylor).then(|| series_degree(tolerance))
}

/// Remark on a method's stability by theory, in words, where there is no limit.
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
    let coefficients = polynomial(method)?;
    let slack = SLACK;
    limit_with_slack(slack, eigenvalue, |x, y| amplification(coefficients, x, y))
}

/// The same for power series of the displacements to a degree d: their rates are
/// then known to the degree d − 1. A mode is multiplied by the exponential
/// series of its two equations, cut off behind that power in either row, which
/// is no polynomial in hλ alone. (On the real axis it is: the exponential cut
/// off behind the power d − 1, since the slow partner of a fast rate counts for
/// nothing beside it.)
pub fn series_limit(degree: usize, eigenvalue: [f64; 2]) -> Option<f64> {
    limit_with_slack(SERIES_SLACK, eigenvalue, |x, y| series_growth(degree, x, y))
}

/// Spectral radius of a step of a power series for a mode with hλ = x ± iy, in
/// displacement and h times its rate: u″ = −ω²u + 2x·u′ with ω² = x² + y², or
/// u″ = x·u′ where y = 0.
fn series_growth(degree: usize, x: f64, y: f64) -> f64 {
    let spring = if y == 0.0 { 0.0 } else { -(x * x + y * y) };
    let damper = if y == 0.0 { x } else { 2.0 * x };
    // Columns of the power of the equations' matrix over its factorial.
    let mut term = [[1.0, 0.0], [0.0, 1.0]];
    let mut step = term;
    for power in 1..=degree {
        for column in &mut term {
            let [u, v] = *column;
            *column = [v, spring * u + damper * v].map(|x| x / power as f64);
        }
        for (sum, [u, v]) in step.iter_mut().zip(term) {
            sum[0] += u;
            if power < degree {
                sum[1] += v;
            }
        }
    }
    let trace = step[0][0] + step[1][1];
    let determinant = step[0][0] * step[1][1] - step[1][0] * step[0][1];
    let square = 0.25 * trace * trace - determinant;
    if square > 0.0 {
        0.5 * trace.abs() + square.sqrt()
    } else {
        determinant.sqrt()
    }
}

fn limit_with_slack(
    slack: f64,
    eigenvalue: [f64; 2],
    growth: impl Fn(f64, f64) -> f64,
) -> Option<f64> {
    const STEP: f64 = 1e-2;
    const FARTHEST: usize = 4000;
    let size = eigenvalue[0].hypot(eigenvalue[1]);
    let [re, im] = eigenvalue.map(|part| part / size);
    let re = if re.abs() < UNDAMPED { 0.0 } else { re };
    if !(size > 0.0 && size.is_finite() && re <= 0.0) {
        return None;
    }
    let grows = |r: f64| growth(r * re, r * im) > 1.0 + slack;
    let first = (1..FARTHEST).find(|&k| grows(STEP * k as f64))?;
    let ends = [first - 1, first].map(|k| STEP * k as f64);
    let [limit, _] = bisect(ends, 40, |r| !grows(r));
    Some(limit)
}

/// |R(x + iy)|.
fn amplification(coefficients: &[f64], x: f64, y: f64) -> f64 {
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

/// Bound of a method's step.
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

    /// Bound of a method's step; `None`: nothing bounds it, or it is not known, or
    /// depends on the tolerance.
    pub(super) fn bound(&self, method: Method) -> Option<Bound> {
        self.least_bound(|eigenvalue| stability_limit(method, eigenvalue))
    }

    /// Bound of a method's step at a tolerance, which the degree of series follows.
    pub(super) fn bound_at(&self, method: Method, tolerance: f64) -> Option<Bound> {
        match degree(method, tolerance) {
            Some(degree) => self.least_bound(|eigenvalue| series_limit(degree, eigenvalue)),
            None => self.bound(method),
        }
    }

    /// The bound by the eigenvalue that bears the least step.
    fn least_bound(&self, limit: impl Fn([f64; 2]) -> Option<f64>) -> Option<Bound> {
        let bounds = self.values.iter().flatten().filter_map(|&eigenvalue| {
            let limit = limit(eigenvalue)?;
            Some(Bound { eigenvalue, limit })
        });
        bounds.min_by(|a, b| a.step().total_cmp(&b.step()))
    }
}

/// The greatest |λ| of a system too large for a full decomposition, at its start.
fn by_iteration(system: &System) -> f64 {
    match system.initial_state() {
        Ok(start) => crate::dynamics::integrate::fastest_rate(system, 0.0, &start.y, &start.modes),
        Err(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::{polynomial, series_limit, stability_limit};
    use crate::dynamics::integrate::Method;

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
    fn series_bear_steps_that_grow_with_their_degree() {
        // Rates to the fourth power are those of the classical Runge–Kutta method.
        let own = series_limit(5, [-1.0, 0.0]).unwrap();
        let classical = stability_limit(Method::Rk4, [-1.0, 0.0]).unwrap();
        approx::assert_abs_diff_eq!(own, classical, epsilon = 1e-4);
        // To the second power: u + hv − h²u/2, v − hu. Its determinant is
        // 1 + h²/2, so that it grows at every step worth the name.
        let own = series_limit(2, [0.0, 1.0]).unwrap();
        approx::assert_abs_diff_eq!(own * own / 4.0, 1e-6, epsilon = 1e-9);
        // Szegő (1924): on the real axis the limits grow by 1/e a degree.
        let real = |degree| series_limit(degree, [-1.0, 0.0]).unwrap();
        for degree in [10, 14, 20] {
            let slope = 0.5 * (real(degree + 2) - real(degree));
            approx::assert_abs_diff_eq!(slope, (-1f64).exp(), epsilon = 0.03);
        }
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
