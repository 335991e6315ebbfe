//! Polynomials on an interval as sums of Chebyshev's polynomials.

use std::f64::consts::PI;

/// Coefficients of a polynomial: degree 19 and below.
pub(crate) const COUNT: usize = 20;

/// A polynomial Σ c_k·T_k(x) of x in [−1, 1].
pub(crate) type Series = [f64; COUNT];

/// The places in (−1, 1), descending, at whose values a polynomial is fitted:
/// no end is among them.
pub(crate) fn nodes() -> [f64; COUNT] {
    std::array::from_fn(|k| (PI * (k as f64 + 0.5) / COUNT as f64).cos())
}

/// cos of multiples of π/(2·[`COUNT`]), by number.
fn cosines() -> &'static [f64; 4 * COUNT] {
    static TABLE: std::sync::OnceLock<[f64; 4 * COUNT]> = std::sync::OnceLock::new();
    TABLE.get_or_init(|| std::array::from_fn(|i| (PI * i as f64 / (2 * COUNT) as f64).cos()))
}

/// The polynomial through values at the [`nodes`].
pub(crate) fn fit(values: &[f64; COUNT]) -> Series {
    let cosines = cosines();
    std::array::from_fn(|k| {
        let product = |(j, value): (usize, &f64)| value * cosines[k * (2 * j + 1) % (4 * COUNT)];
        let sum: f64 = values.iter().enumerate().map(product).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / COUNT as f64
    })
}

/// The value at x (Clenshaw).
#[inline]
pub(crate) fn value(series: &Series, x: f64) -> f64 {
    let (mut one, mut two) = (0.0, 0.0);
    for &c in series[1..].iter().rev() {
        (one, two) = (c + 2.0 * x * one - two, one);
    }
    series[0] + x * one - two
}

/// The derivative with respect to x.
pub(crate) fn derivative(series: &Series) -> Series {
    let mut out = [0.0; COUNT];
    let (mut above, mut next) = (0.0, 0.0);
    for k in (0..COUNT - 1).rev() {
        (above, next) = (next, above + 2.0 * (k + 1) as f64 * series[k + 1]);
        out[k] = next;
    }
    out[0] *= 0.5;
    out
}

/// ∫ over [−1, x] as a polynomial of x; its highest term is left out, which is
/// rounding for a series that has converged.
pub(crate) fn integral(series: &Series) -> Series {
    let term = |k: usize| series.get(k).copied().unwrap_or(0.0);
    let mut out = [0.0; COUNT];
    for (k, out) in out.iter_mut().enumerate().skip(1) {
        let below = if k == 1 { 2.0 * term(0) } else { term(k - 1) };
        *out = (below - term(k + 1)) / (2 * k) as f64;
    }
    out[0] = -value(&out, -1.0);
    out
}

/// ∫ over [−1, 1], no term left out.
pub(crate) fn whole(series: &Series) -> f64 {
    let even = (0..COUNT).step_by(2);
    even.map(|k| 2.0 * series[k] / (1.0 - (k * k) as f64)).sum()
}

#[cfg(test)]
mod tests {
    use super::{derivative, fit, integral, nodes, value, whole};

    #[test]
    fn a_smooth_function_its_slope_and_its_integral_come_out_to_rounding() {
        let series = fit(&nodes().map(|x| (0.7 * x + 0.2).sin()));
        let (slope, area) = (derivative(&series), integral(&series));
        for x in [-1.0, -0.83, 0.0, 0.41, 1.0] {
            let angle = 0.7 * x + 0.2;
            approx::assert_abs_diff_eq!(value(&series, x), angle.sin(), epsilon = 1e-15);
            approx::assert_abs_diff_eq!(value(&slope, x), 0.7 * angle.cos(), epsilon = 1e-13);
            let exact = ((-0.5f64).cos() - angle.cos()) / 0.7;
            approx::assert_abs_diff_eq!(value(&area, x), exact, epsilon = 1e-15);
        }
        let exact = ((-0.5f64).cos() - 0.9f64.cos()) / 0.7;
        approx::assert_abs_diff_eq!(whole(&series), exact, epsilon = 1e-15);
    }
}
