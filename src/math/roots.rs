//! A root between two places of opposite sign.

/// What the search for a root came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Found {
    /// The place with the smaller miss.
    pub(crate) at: f64,
    /// The function there.
    pub(crate) miss: f64,
    /// The bracket that is left, ascending.
    pub(crate) bracket: [f64; 2],
    /// Evaluations.
    pub(crate) iterations: u32,
}

/// Most evaluations: bisection alone would need fewer.
const MOST: u32 = 200;

/// A root of `f` between `a` and `b`, where its values have opposite signs:
/// until |f| ≤ `tolerance` or the bracket cannot shrink.
///
/// Inverse quadratic interpolation where it is safe, otherwise bisection
/// (T. R. Chandrupatla, Advances in Engineering Software 28, 1997): the bracket
/// shrinks in every step.
pub(crate) fn bracketed(
    f: &mut dyn FnMut(f64) -> f64,
    [mut a, mut b]: [f64; 2],
    tolerance: f64,
) -> Found {
    let (mut at_a, mut at_b) = (f(a), f(b));
    let mut iterations = 2;
    let (mut c, mut at_c);
    let mut share = 0.5f64;
    loop {
        let (best, miss) = if at_a.abs() < at_b.abs() {
            (a, at_a)
        } else {
            (b, at_b)
        };
        let width = (b - a).abs();
        let resolution = 2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE;
        // Written so that a number that is none ends the search.
        let goes_on = miss.abs() > tolerance && width > resolution && iterations < MOST;
        if !goes_on {
            return Found {
                at: best,
                miss,
                bracket: [a.min(b), a.max(b)],
                iterations,
            };
        }
        let least = 0.5 * resolution / width;
        let next = a + share.clamp(least, 1.0 - least) * (b - a);
        let at_next = f(next);
        iterations += 1;
        if (at_next < 0.0) == (at_a < 0.0) {
            (c, at_c) = (a, at_a);
        } else {
            (c, at_c, b, at_b) = (b, at_b, a, at_a);
        }
        (a, at_a) = (next, at_next);
        let (x, y) = ((a - b) / (c - b), (at_a - at_b) / (at_c - at_b));
        share = if y * y < x && (1.0 - y) * (1.0 - y) < 1.0 - x {
            at_a / (at_b - at_a) * at_c / (at_b - at_c)
                + (c - a) / (b - a) * at_a / (at_c - at_a) * at_b / (at_c - at_b)
        } else {
            0.5
        };
    }
}

#[cfg(test)]
mod tests {
    use super::bracketed;

    #[test]
    fn roots_are_found_superlinearly_and_to_rounding() {
        let found = bracketed(&mut |x| x * x * x - 2.0, [0.0, 4.0], 0.0);
        approx::assert_relative_eq!(found.at, 2f64.cbrt(), max_relative = 1e-15);
        assert!(found.iterations < 20, "{found:?}");
        assert!(found.bracket[0] <= found.at && found.at <= found.bracket[1]);
    }

    #[test]
    fn a_flat_function_ends_by_its_bracket() {
        let found = bracketed(&mut |x: f64| (x - 1.0).powi(9), [0.0, 3.0], 0.0);
        assert!((found.at - 1.0).abs() < 1e-5, "{found:?}");
        let none = bracketed(&mut |_| f64::NAN, [0.0, 1.0], 1e-9);
        assert!(none.miss.is_nan());
    }
}
