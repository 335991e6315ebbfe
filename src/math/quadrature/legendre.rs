//! Legendre's polynomials, and Gauss's rules at their zeros.

use crate::math::roots::{bisect, middle};

/// Gauss's five places in [0, 1], ascending, and their weights: exact to degree 9.
pub(crate) const FIVE: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Legendre's polynomial of a degree on [0, 1].
pub(crate) fn legendre(degree: usize, x: f64) -> f64 {
    let x = 2.0 * x - 1.0;
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        (before, value) = (value, next);
    }
    value
}

/// Zeros within (0, 1) of a polynomial with simple zeros only, by halving.
pub(crate) fn zeros(f: &dyn Fn(f64) -> f64) -> Vec<f64> {
    const PARTS: usize = 499;
    let mut found = Vec::new();
    for part in 0..PARTS {
        let [low, high] = [part, part + 1].map(|k| (k as f64 + 0.01) / (PARTS as f64 + 1.0));
        let rises = f(high) > 0.0;
        if (f(low) > 0.0) == rises {
            continue;
        }
        let ends = bisect([low, high], 200, |x| (f(x) > 0.0) != rises);
        found.push(middle(ends));
    }
    found
}

/// Gauss's rule of so many places in [0, 1], ascending, and their weights: exact to degree
/// 2·`points` − 1.
pub(crate) fn rule(points: usize) -> Vec<(f64, f64)> {
    let weight = |x: f64| {
        let n = points as f64;
        let below = legendre(points - 1, x);
        let z = 2.0 * x - 1.0;
        (1.0 - z * z) / (n * n * below * below)
    };
    let places = zeros(&|x| legendre(points, x));
    places.into_iter().map(|x| (x, weight(x))).collect()
}

#[cfg(test)]
mod tests {
    use super::{FIVE, rule};

    #[test]
    fn rules_are_exact_to_their_degree_and_no_further() {
        for points in [3, 5, 6, 7] {
            let rule = rule(points);
            assert_eq!(rule.len(), points);
            for degree in 0..=2 * points as i32 {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree)).sum();
                let exact = 1.0 / f64::from(degree + 1);
                assert_eq!((sum - exact).abs() < 1e-14, degree < 2 * points as i32);
            }
        }
    }

    #[test]
    fn the_five_are_those_of_the_definition() {
        for (known, found) in FIVE.iter().zip(rule(5)) {
            approx::assert_abs_diff_eq!(known.0, found.0, epsilon = 1e-15);
            // 1 − z² costs digits near the ends.
            approx::assert_abs_diff_eq!(known.1, found.1, epsilon = 3e-15);
        }
    }
}
