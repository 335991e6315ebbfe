//! ∫ sᵐe^{λs} ds in closed form.

use crate::exact::pencil::C;
use crate::exact::phase::POLY;

/// Sets `out`\[m\] to ∫₀¹ uᵐe^{zu} du for Re z ≤ 0.
///
/// The recurrence zJ_m = e^z − mJ_{m−1} loses nothing upwards while m < |z|,
/// and nothing downwards from there; it is started above with
/// J_m = e^z·Σ (−z)ᵏ/((m+1)…(m+k+1)).
pub(super) fn moments(z: C, out: &mut [C]) {
    let last = out.len() - 1;
    let power = z.exp();
    let size = z.norm();
    // Upwards from 0 to here, downwards from the last to above.
    let turn = if size > 0.5 {
        let turn = last.min(size as usize);
        out[0] = (power - 1.0) / z;
        for m in 1..=turn {
            out[m] = (power - out[m - 1] * m as f64) / z;
        }
        if turn == last {
            return;
        }
        turn + 1
    } else {
        0
    };
    let mut term = C::from(1.0 / (last + 1) as f64);
    let mut sum = term;
    for k in 2..400 {
        term *= -z / (last + k) as f64;
        sum += term;
        if term.norm_sqr() <= 1e-36 * sum.norm_sqr() {
            break;
        }
    }
    out[last] = power * sum;
    for m in (turn + 1..=last).rev() {
        out[m - 1] = (power - z * out[m]) / m as f64;
    }
}

/// ∫₀ʰ e^{μs} ds.
pub(super) fn integral_of_exponential(mu: C, h: f64) -> C {
    let mut out = [C::default()];
    moments(mu * h, &mut out);
    out[0] * h
}

/// ∫₀ʰ p(s)·e^{λs} ds, `at` being the moments for λh.
pub(super) fn polynomial_moment(p: &[f64], at: &[C; POLY], h: f64) -> C {
    let mut power = h;
    let mut sum = C::default();
    for (c, moment) in p.iter().zip(at) {
        sum += moment * (c * power);
        power *= h;
    }
    sum
}

/// ∫₀ʰ p(s)·r(s) ds.
pub(super) fn product(p: &[f64], r: &[f64], h: f64) -> f64 {
    let mut sum = 0.0;
    let mut power = h;
    for (i, a) in p.iter().enumerate() {
        let mut own = 0.0;
        for (j, b) in r.iter().enumerate().rev() {
            own = own * h + b / (i + j + 1) as f64;
        }
        sum += a * own * power;
        power *= h;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gauss and Legendre's rule with five points on many parts.
    fn quadrature(f: impl Fn(f64) -> C) -> C {
        let nodes = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let parts = 400;
        let mut sum = C::default();
        for k in 0..parts {
            for (x, w) in nodes {
                for side in if x == 0.0 { vec![1.0] } else { vec![1.0, -1.0] } {
                    let u = (k as f64 + 0.5 + 0.5 * side * x) / parts as f64;
                    sum += f(u) * (0.5 * w / parts as f64);
                }
            }
        }
        sum
    }

    #[test]
    fn moments_agree_with_quadrature_everywhere() {
        for size in [
            0.0, 1e-9, 0.01, 0.4, 0.7, 3.0, 12.0, 30.9, 31.1, 40.0, 300.0,
        ] {
            for turn in [1.58, 2.0, 2.6, 3.1, -1.8] {
                let z = C::from_polar(size, turn);
                let mut out = [C::default(); POLY];
                moments(z, &mut out);
                let mut first = [C::default()];
                moments(z, &mut first);
                assert!((first[0] - out[0]).norm() < 1e-14);
                for m in [0, 1, 2, 7, 31] {
                    let expected = quadrature(|u| (z * u).exp() * u.powi(m as i32));
                    let off = (out[m] - expected).norm();
                    assert!(off < 3e-14, "{z} {m}: {} {expected}", out[m]);
                }
            }
        }
    }

    #[test]
    fn products_of_polynomials_are_integrated() {
        let (p, r, h) = ([1.0, -2.0, 0.5], [0.3, 4.0, 0.0, -1.0], 0.7);
        let value = |c: &[f64], s: f64| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let expected = quadrature(|u| C::from(value(&p, u * h) * value(&r, u * h) * h));
        approx::assert_relative_eq!(product(&p, &r, h), expected.re, max_relative = 1e-13);
        let mut at = [C::default(); POLY];
        let lambda = C::new(-2.0, 9.0);
        moments(lambda * h, &mut at);
        let expected = quadrature(|u| (lambda * (u * h)).exp() * (value(&r, u * h) * h));
        assert!((polynomial_moment(&r, &at, h) - expected).norm() < 1e-14);
        assert!((integral_of_exponential(lambda, h) - (at[0] * h)).norm() < 1e-15);
    }
}
