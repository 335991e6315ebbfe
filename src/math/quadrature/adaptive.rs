//! An integral with an error that is known: adaptive Gauss and Kronrod.
//!
//! Source of the error estimate: R. Piessens, E. de
//! Doncker-Kapenga, C. W. Überhuber, D. K. Kahaner, QUADPACK, 1983.

use super::kronrod::FIFTEEN;

/// Most halvings of an interval: a root or a logarithm at an end is followed
/// down to where it no longer counts.
const MOST_HALVINGS: u32 = 100;

/// An integral and the estimate of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Area {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// Intervals at most: rounding in the integrand must not be chased for ever.
const MOST_INTERVALS: u32 = 4000;

/// Differences of the two rules that are rounding, relative.
const RULES_AGREE: f64 = 20.0 * f64::EPSILON;

/// ∫ of `f` over [from, to] with an error below `tolerance`, as far as
/// rounding allows.
pub(crate) fn integrate(f: &impl Fn(f64) -> f64, from: f64, to: f64, tolerance: f64) -> Area {
    let mut total = Area::default();
    let mut open = vec![(from, to, 0)];
    let mut intervals = 0;
    while let Some((a, b, depth)) = open.pop() {
        let area = rule(f, a, b);
        intervals += 1;
        let middle = 0.5 * (a + b);
        let settled = area.error <= tolerance;
        let ended = depth >= MOST_HALVINGS || intervals >= MOST_INTERVALS;
        let ended = ended || middle <= a || middle >= b;
        if settled || ended || !area.value.is_finite() {
            total.value += area.value;
            total.error += area.error;
        } else {
            open.push((middle, b, depth + 1));
            open.push((a, middle, depth + 1));
        }
    }
    total
}

fn rule(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> Area {
    let (centre, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut values = [0.0; 15];
    for (i, node) in FIFTEEN.iter().enumerate() {
        values[i] = f(centre - half * node.place);
        values[14 - i] = f(centre + half * node.place);
    }
    let middle = FIFTEEN[7];
    let (mut kronrod, mut gauss) = (middle.kronrod * values[7], middle.gauss * values[7]);
    for (i, node) in FIFTEEN[..7].iter().enumerate() {
        let pair = values[i] + values[14 - i];
        kronrod += node.kronrod * pair;
        // A value without end is no part of the other rule.
        if node.gauss > 0.0 {
            gauss += node.gauss * pair;
        }
    }
    // The mean deviation tells how much of the difference is to be believed.
    let mean = 0.5 * kronrod;
    let weight = |i: usize| FIFTEEN[if i < 8 { i } else { 14 - i }].kronrod;
    let spread: f64 = (0..15).map(|i| weight(i) * (values[i] - mean).abs()).sum();
    let difference = (kronrod - gauss).abs();
    let error = if difference <= RULES_AGREE * kronrod.abs() {
        // No more digits are to be had.
        0.0
    } else if spread > 0.0 {
        spread * (200.0 * difference / spread).powf(1.5).min(1.0)
    } else {
        difference
    };
    Area {
        value: kronrod * half,
        error: error * half,
    }
}

#[cfg(test)]
mod tests {
    use super::integrate;

    #[test]
    fn peaks_and_roots_at_an_end_are_integrated_to_their_tolerance() {
        let peak = |x: f64| 1.0 / (x * x + 1e-12);
        let exact = 2.0 * 1e6 * (1e6f64).atan();
        let found = integrate(&peak, -1.0, 1.0, 1e-6);
        approx::assert_relative_eq!(found.value, exact, max_relative = 1e-12);
        let root = integrate(&|x: f64| 1.0 / x.sqrt(), 0.0, 1.0, 1e-14);
        approx::assert_abs_diff_eq!(root.value, 2.0, epsilon = 1e-12);
        assert!(root.error < 1e-12);
    }
}
