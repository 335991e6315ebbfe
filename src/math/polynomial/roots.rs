//! Where polynomials in Bernstein form change sign: isolation that skips none.
//!
//! The number of sign variations of the Bernstein coefficients bounds the
//! number of roots inside the interval and has the same parity (Descartes):
//! without variation there is no root, with one there is exactly one. Intervals
//! with more are halved (de Casteljau) until one of the two cases holds.

use super::{Coefficients, MAX_DEGREE, evaluate, parts};

/// Halvings after which two roots closer than rounding are taken for none.
const DEEPEST: u32 = 52;

/// The earliest s in 0 ≤ s < 1 just after which both polynomials (Bernstein
/// coefficients over 0 ≤ s ≤ 1, same degree) are positive; `None` when there
/// is no such place. A zero exactly at s = 0 followed by positive values gives
/// s = 0; touching zero from below without becoming positive gives `None`.
pub fn first_both_positive(first: &[f64], second: &[f64]) -> Option<f64> {
    let degree = first.len() - 1;
    debug_assert_eq!(second.len(), first.len());
    if never_positive(first) || never_positive(second) {
        return None;
    }
    let mut pair = [[0.0; MAX_DEGREE + 1]; 2];
    pair[0][..=degree].copy_from_slice(first);
    pair[1][..=degree].copy_from_slice(second);
    search(&pair, degree, 0.0, 1.0, DEEPEST)
}

/// Least positive root of one polynomial.
pub fn first_positive(coefficients: &[f64]) -> Option<f64> {
    first_both_positive(coefficients, coefficients)
}

/// Adds all places 0 < s < 1 at which a polynomial (Bernstein coefficients over 0 ≤ s ≤ 1)
/// changes its sign, in their order. Two that are closer than rounding are none.
pub(crate) fn sign_changes(coefficients: &[f64], found: &mut Vec<f64>) {
    if variations(coefficients) == 0 {
        return;
    }
    let mut row = [0.0; MAX_DEGREE + 1];
    row[..coefficients.len()].copy_from_slice(coefficients);
    add_sign_changes(&row, coefficients.len() - 1, [0.0, 1.0], DEEPEST, found);
}

fn add_sign_changes(
    row: &Coefficients,
    degree: usize,
    [from, to]: [f64; 2],
    halvings: u32,
    found: &mut Vec<f64>,
) {
    let own = &row[..=degree];
    match variations(own) {
        0 => {}
        1 => {
            let rising = own.iter().find(|&&c| c != 0.0).is_some_and(|&c| c < 0.0);
            found.push(from + only_root(own, rising) * (to - from));
        }
        _ if halvings == 0 => {}
        _ => {
            let middle = 0.5 * (from + to);
            let (left, right) = split_in_halves(row, degree);
            add_sign_changes(&left, degree, [from, middle], halvings - 1, found);
            // A root exactly in the middle is in neither half.
            let last = left[..=degree].iter().rev().find(|&&c| c != 0.0);
            let next = right[..=degree].iter().find(|&&c| c != 0.0);
            if right[0] == 0.0
                && let (Some(last), Some(next)) = (last, next)
                && last.signum() != next.signum()
            {
                found.push(middle);
            }
            add_sign_changes(&right, degree, [middle, to], halvings - 1, found);
        }
    }
}

fn search(
    pair: &[Coefficients; 2],
    degree: usize,
    from: f64,
    to: f64,
    halvings: u32,
) -> Option<f64> {
    let [first, second] = [&pair[0][..=degree], &pair[1][..=degree]];
    if never_positive(first) || never_positive(second) {
        return None;
    }
    if variations(first) <= 1 && variations(second) <= 1 {
        let (a, b) = (where_positive(first), where_positive(second));
        let (lower, upper) = (a.0.max(b.0), a.1.min(b.1));
        return (lower < upper).then_some(from + lower * (to - from));
    }
    if halvings == 0 {
        return (first[degree] > 0.0 && second[degree] > 0.0).then_some(to);
    }
    let middle = 0.5 * (from + to);
    let (left_first, right_first) = split_in_halves(&pair[0], degree);
    let (left_second, right_second) = split_in_halves(&pair[1], degree);
    search(
        &[left_first, left_second],
        degree,
        from,
        middle,
        halvings - 1,
    )
    .or_else(|| {
        search(
            &[right_first, right_second],
            degree,
            middle,
            to,
            halvings - 1,
        )
    })
}

/// True when the coefficients prove that the polynomial is nowhere positive.
fn never_positive(coefficients: &[f64]) -> bool {
    coefficients.iter().all(|&c| c <= 0.0)
}

/// Number of sign changes along the coefficients, zeros left out.
fn variations(coefficients: &[f64]) -> usize {
    let mut last = 0.0;
    let mut count = 0;
    for &c in coefficients {
        if c != 0.0 {
            count += usize::from(last * c.signum() < 0.0);
            last = c.signum();
        }
    }
    count
}

/// The part of the interval where a polynomial with at most one variation,
/// somewhere positive, is positive.
fn where_positive(coefficients: &[f64]) -> (f64, f64) {
    if variations(coefficients) == 0 {
        return (0.0, 1.0);
    }
    let rising = coefficients
        .iter()
        .find(|&&c| c != 0.0)
        .is_some_and(|&c| c < 0.0);
    let root = only_root(coefficients, rising);
    if rising { (root, 1.0) } else { (0.0, root) }
}

/// The root of a polynomial with exactly one sign variation, to rounding:
/// Newton's method inside a bracket, bisection where it leaves it.
fn only_root(coefficients: &[f64], rising: bool) -> f64 {
    let (mut lower, mut upper, mut s) = (0.0f64, 1.0f64, 0.5f64);
    for iteration in 0..120 {
        let (value, slope) = evaluate(coefficients, s);
        if value == 0.0 {
            return s;
        }
        if (value > 0.0) == rising {
            upper = s;
        } else {
            lower = s;
        }
        let newton = s - value / slope;
        let inside = newton > lower && newton < upper;
        // A root of high multiplicity slows Newton down: halve from then on.
        let next = if inside && iteration < 40 {
            newton
        } else {
            0.5 * (lower + upper)
        };
        if (next - s).abs() <= 0.5 * f64::EPSILON * s {
            return next;
        }
        s = next;
    }
    s
}

/// Both halves of a polynomial, each over its own 0 … 1 (de Casteljau).
fn split_in_halves(coefficients: &Coefficients, degree: usize) -> (Coefficients, Coefficients) {
    let mut left = [0.0; MAX_DEGREE + 1];
    let mut right = *coefficients;
    parts::halve(&mut left[..=degree], &mut right[..=degree]);
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bernstein coefficients of ∏ (s − root) · factor.
    fn from_roots(roots: &[f64], factor: f64) -> Vec<f64> {
        let mut power = vec![factor];
        for &root in roots {
            let mut next = vec![0.0; power.len() + 1];
            for (i, &c) in power.iter().enumerate() {
                next[i + 1] += c;
                next[i] -= root * c;
            }
            power = next;
        }
        to_bernstein(&power)
    }

    fn to_bernstein(power: &[f64]) -> Vec<f64> {
        let degree = power.len() - 1;
        let binomial = |n: usize, k: usize| -> f64 {
            (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
        };
        (0..=degree)
            .map(|i| {
                (0..=i)
                    .map(|k| binomial(i, k) / binomial(degree, k) * power[k])
                    .sum()
            })
            .collect()
    }

    #[test]
    fn a_crossing_is_found_to_rounding_and_a_falling_one_is_none() {
        let rising = from_roots(&[0.3, -1.0, 2.5, 1.7, -0.4], 1.0);
        let sign = rising[0].signum();
        let rising: Vec<f64> = rising.iter().map(|c| -sign * c).collect();
        approx::assert_abs_diff_eq!(first_positive(&rising).unwrap(), 0.3, epsilon = 2e-15);
        let falling: Vec<f64> = rising.iter().map(|c| -c).collect();
        assert_eq!(
            first_positive(&falling),
            Some(0.0),
            "positive from the start"
        );
    }

    #[test]
    fn a_short_excursion_between_two_close_roots_is_not_skipped() {
        for gap in [1e-2, 1e-4, 1e-6] {
            let middle = 0.617;
            let hump = from_roots(&[middle - gap, middle + gap, -0.5, 1.5, 3.0], 1.0);
            let sign = evaluate(&hump, middle).0.signum();
            let hump: Vec<f64> = hump.iter().map(|c| sign * c).collect();
            let found = first_positive(&hump).expect("two roots in the interval");
            approx::assert_abs_diff_eq!(found, middle - gap, epsilon = 1e-15 / gap);
        }
    }

    #[test]
    fn touching_zero_from_below_is_no_crossing() {
        let touch = from_roots(&[0.25, 0.25], -1.0);
        assert_eq!(first_positive(&touch), None);
        let lower: Vec<f64> = touch.iter().map(|c| c - 1e-13).collect();
        assert_eq!(first_positive(&lower), None);
    }

    #[test]
    fn zero_at_the_start_is_decided_by_the_first_derivative_that_is_not_zero() {
        assert_eq!(first_positive(&[0.0, 1.0, 2.0, 3.0]), Some(0.0));
        assert_eq!(first_positive(&[0.0, 0.0, 1.0, 3.0]), Some(0.0));
        assert_eq!(first_positive(&[0.0, 0.0, -1.0, -3.0]), None);
        let leaves_and_returns = from_roots(&[0.0, 0.75], 1.0);
        approx::assert_abs_diff_eq!(
            first_positive(&leaves_and_returns).unwrap(),
            0.75,
            epsilon = 1e-15
        );
        assert_eq!(first_positive(&[0.0; 6]), None);
    }

    #[test]
    fn all_changes_of_sign_are_found_in_order_and_touches_are_none() {
        let found = |roots: &[f64]| {
            let mut found = Vec::new();
            sign_changes(&from_roots(roots, -2.0), &mut found);
            found
        };
        for roots in [
            &[0.2, 0.25, 0.9][..],
            &[0.25, 0.5, 0.75],
            &[0.5],
            &[-1.0, 2.0],
        ] {
            let inside: Vec<f64> = roots
                .iter()
                .copied()
                .filter(|r| *r > 0.0 && *r < 1.0)
                .collect();
            let places = found(roots);
            assert_eq!(places.len(), inside.len(), "{roots:?} {places:?}");
            for (place, root) in places.iter().zip(&inside) {
                approx::assert_abs_diff_eq!(place, root, epsilon = 1e-13);
            }
        }
        assert!(found(&[0.375, 0.375]).is_empty());
    }

    #[test]
    fn both_have_to_be_positive_at_once() {
        let line = |root: f64, slope: f64| vec![-root * slope, (1.0 - root) * slope];
        let both = |a: &[f64], b: &[f64]| first_both_positive(a, b);
        approx::assert_abs_diff_eq!(
            both(&line(0.2, 1.0), &line(0.6, 3.0)).unwrap(),
            0.6,
            epsilon = 1e-15
        );
        assert_eq!(both(&line(0.6, 1.0), &line(0.4, -1.0)), None);
        let early = both(&line(0.3, 1.0), &line(0.4, -1.0)).unwrap();
        approx::assert_abs_diff_eq!(early, 0.3, epsilon = 1e-15);
    }

    #[test]
    fn a_root_exactly_in_the_middle_of_a_halving_is_found() {
        // (s − ½)(s − ¼)(s − ¾): positive on ¼ … ½ and beyond ¾.
        let cubic = from_roots(&[0.5, 0.25, 0.75], 1.0);
        approx::assert_abs_diff_eq!(first_positive(&cubic).unwrap(), 0.25, epsilon = 1e-15);
        let after = from_roots(&[0.5, 0.5, 0.5], 1.0);
        approx::assert_abs_diff_eq!(first_positive(&after).unwrap(), 0.5, epsilon = 1e-5);
    }

    proptest::proptest! {
        /// Against a dense scan: whatever the scan sees positive, the search has
        /// found no later, and just after what it found the value is positive.
        #[test]
        fn the_first_positive_place_agrees_with_a_dense_scan(
            coefficients in proptest::collection::vec(-1.0f64..1.0, 6),
            other in proptest::collection::vec(-1.0f64..1.0, 6),
        ) {
            let positive = |s: f64| evaluate(&coefficients, s).0.min(evaluate(&other, s).0);
            let found = first_both_positive(&coefficients, &other);
            let scanned = (0..=4000).map(|i| f64::from(i) / 4000.0).find(|&s| positive(s) > 1e-12);
            if let Some(scanned) = scanned {
                proptest::prop_assert!(found.is_some_and(|s| s <= scanned));
            }
            if let Some(s) = found {
                let slope = evaluate(&coefficients, s).1.abs() + evaluate(&other, s).1.abs();
                proptest::prop_assert!(positive(s) > -1e-14 * (1.0 + slope));
                let nearest = (1..60).map(|k| s + (1.0 - s) * 0.5f64.powi(k));
                proptest::prop_assert!(nearest.map(positive).any(|w| w > 0.0));
            }
        }
    }
}
