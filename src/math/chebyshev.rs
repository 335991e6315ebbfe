//! Polynomials on an interval as sums of Chebyshev's polynomials.
//!
//! A polynomial of degree N − 1 is its N coefficients c_k, Σ c_k·T_k(x) for x in
//! [−1, 1]; it is fitted through its values at the N zeros of T_N.

use std::f64::consts::PI;
use std::ops::{Mul, Sub};

/// The places at which functions are fitted, with T_k there.
#[derive(Clone, Debug)]
pub(crate) struct Nodes<const N: usize> {
    /// The places in (−1, 1), descending: no end is among them.
    pub(crate) places: [f64; N],
    /// T_k at the places, by k.
    values: [[f64; N]; N],
}

impl<const N: usize> Nodes<N> {
    /// The zeros of T_N.
    pub(crate) fn new() -> Self {
        // T_k at place j is the cosine of a multiple of π/2N, taken within one turn.
        let cosine = |multiple: usize| (PI * (multiple % (4 * N)) as f64 / (2 * N) as f64).cos();
        let values = std::array::from_fn(|k| std::array::from_fn(|j| cosine(k * (2 * j + 1))));
        Self {
            places: std::array::from_fn(|j| cosine(2 * j + 1)),
            values,
        }
    }

    /// The polynomial through values at the places.
    pub(crate) fn polynomial_through(&self, values: &[f64; N]) -> [f64; N] {
        std::array::from_fn(|k| {
            let products = self.values[k].iter().zip(values).map(|(t, f)| t * f);
            products.sum::<f64>() * if k == 0 { 1.0 } else { 2.0 } / N as f64
        })
    }
}

/// Argument of a polynomial: a number, or a power series.
pub(crate) trait Argument: Copy + Mul<Output = Self> + Sub<Output = Self> {
    /// A constant.
    fn constant(value: f64) -> Self;

    /// A multiple.
    fn scale(self, factor: f64) -> Self;

    /// The sum with a constant.
    fn shift(self, value: f64) -> Self;
}

impl Argument for f64 {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn shift(self, value: f64) -> Self {
        self + value
    }
}

/// The value at x (Clenshaw).
#[inline(always)]
pub(crate) fn value<X: Argument>(series: &[f64], x: X) -> X {
    let (mut one, mut two) = (X::constant(0.0), X::constant(0.0));
    for &c in series[1..].iter().rev() {
        (one, two) = ((x * one).scale(2.0).shift(c) - two, one);
    }
    (x * one).shift(series[0]) - two
}

/// The derivative with respect to x.
pub(crate) fn derivative<const N: usize>(series: &[f64; N]) -> [f64; N] {
    let mut out = [0.0; N];
    let (mut above, mut next) = (0.0, 0.0);
    for k in (0..N - 1).rev() {
        (above, next) = (next, above + 2.0 * (k + 1) as f64 * series[k + 1]);
        out[k] = next;
    }
    out[0] *= 0.5;
    out
}

/// ∫ over [−1, x] as a polynomial of x; its highest term is left out, which is
/// rounding for a series that has converged.
pub(crate) fn integral<const N: usize>(series: &[f64; N]) -> [f64; N] {
    let term = |k: usize| series.get(k).copied().unwrap_or(0.0);
    let mut out = [0.0; N];
    for (k, out) in out.iter_mut().enumerate().skip(1) {
        let below = if k == 1 { 2.0 * term(0) } else { term(k - 1) };
        *out = (below - term(k + 1)) / (2 * k) as f64;
    }
    out[0] = -value(&out, -1.0);
    out
}

/// ∫ over [−1, 1], no term left out.
pub(crate) fn definite_integral<const N: usize>(series: &[f64; N]) -> f64 {
    let even = (0..N).step_by(2);
    even.map(|k| 2.0 * series[k] / (1.0 - (k * k) as f64)).sum()
}

/// T_k(x), k below N, with x = `shift` + `scale`·s in powers of s: whole numbers where
/// these are.
pub(crate) fn in_powers<const N: usize>([shift, scale]: [f64; 2]) -> [[f64; N]; N] {
    let mut all = [[0.0; N]; N];
    all[0][0] = 1.0;
    all[1][..2].copy_from_slice(&[shift, scale]);
    // T_{k+1} = 2x·T_k − T_{k−1}.
    for k in 1..N - 1 {
        for power in 0..N {
            let up = match power.checked_sub(1) {
                Some(below) => 2.0 * scale * all[k][below],
                None => 0.0,
            };
            all[k + 1][power] = up + 2.0 * shift * all[k][power] - all[k - 1][power];
        }
    }
    all
}

/// A sum of polynomials that are given by rows, `coefficients` of each.
pub(crate) fn combined<const N: usize>(coefficients: &[f64], rows: &[[f64; N]]) -> [f64; N] {
    let mut out = [0.0; N];
    for (c, row) in coefficients.iter().zip(rows) {
        for (out, entry) in out.iter_mut().zip(row) {
            *out += c * entry;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{Nodes, combined, definite_integral, derivative, in_powers, integral, value};

    #[test]
    fn a_smooth_function_its_slope_and_its_integral_come_out_to_rounding() {
        let nodes = Nodes::<20>::new();
        let series = nodes.polynomial_through(&nodes.places.map(|x| (0.7 * x + 0.2).sin()));
        let (slope, area) = (derivative(&series), integral(&series));
        for x in [-1.0, -0.83, 0.0, 0.41, 1.0] {
            let angle = 0.7 * x + 0.2;
            approx::assert_abs_diff_eq!(value(&series, x), angle.sin(), epsilon = 1e-15);
            approx::assert_abs_diff_eq!(value(&slope, x), 0.7 * angle.cos(), epsilon = 1e-13);
            let exact = ((-0.5f64).cos() - angle.cos()) / 0.7;
            approx::assert_abs_diff_eq!(value(&area, x), exact, epsilon = 1e-15);
        }
        let exact = ((-0.5f64).cos() - 0.9f64.cos()) / 0.7;
        approx::assert_abs_diff_eq!(definite_integral(&series), exact, epsilon = 1e-15);
    }

    #[test]
    fn powers_of_the_argument_and_of_a_share_of_the_interval_agree() {
        let nodes = Nodes::<12>::new();
        let series = nodes.polynomial_through(&nodes.places.map(f64::exp));
        let (plain, shared) = (in_powers([0.0, 1.0]), in_powers([-1.0, 2.0]));
        let horner = |c: [f64; 12], x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
        for x in [-1.0, -0.4, 0.1, 0.9] {
            let found = horner(combined(&series, &plain), x);
            approx::assert_abs_diff_eq!(found, x.exp(), epsilon = 1e-12);
            let found = horner(combined(&series, &shared), 0.5 * (x + 1.0));
            approx::assert_abs_diff_eq!(found, x.exp(), epsilon = 1e-9);
        }
        // T₃ = 4x³ − 3x.
        assert_eq!(plain[3][..4], [0.0, -3.0, 0.0, 4.0]);
    }
}
