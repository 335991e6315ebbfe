//! What lies between two places: a root of a function of opposite signs, or where
//! something ceases to hold. Roots of polynomials: see
//! [`polynomial`](crate::math::polynomial).
//!
//! `bisect` asks whether something still holds. `bracketed` (T. R. Chandrupatla) is for the
//! root of a function whose values count.

/// Bisections that place a change to rounding, relative to the bracket.
pub(crate) const BISECTIONS: u32 = 60;

/// Result of the search for a root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
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
pub(crate) fn bracketed(f: &mut dyn FnMut(f64) -> f64, ends: [f64; 2], tolerance: f64) -> Root {
    bracketed_within(f, ends, tolerance, 0.0)
}

/// As [`bracketed`], and no further than until the bracket is this narrow.
pub(crate) fn bracketed_within(
    f: &mut dyn FnMut(f64) -> f64,
    [mut a, mut b]: [f64; 2],
    tolerance: f64,
    narrow: f64,
) -> Root {
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
        let resolution = (2.0 * f64::EPSILON * best.abs() + f64::MIN_POSITIVE).max(narrow);
        // Written so that a number that is none ends the search.
        let goes_on = miss.abs() > tolerance && width > resolution && iterations < MOST;
        if !goes_on {
            return Root {
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

/// As [`bracketed`], the root alone, to rounding.
pub(crate) fn root(f: &dyn Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    bracketed(&mut |x| f(x), [from, to], 0.0).at
}

/// Bisection: the two neighbouring places between which `holds` ceases to be true,
/// from a first place where it is (which may be the greater one) and a last where it is
/// not; neither is asked for. After so many halvings at most, or where no number is left
/// between.
pub(crate) fn bisect(
    ends: [f64; 2],
    halvings: u32,
    mut holds: impl FnMut(f64) -> bool,
) -> [f64; 2] {
    let found = try_bisect(ends, halvings, 0.0, |place| Some(holds(place)));
    let (Ok(ends) | Err(ends)) = found;
    ends
}

/// As [`bisect`], down to a width relative to the first place.
///
/// # Errors
/// The places between which a place lies that `holds` cannot tell of.
pub(crate) fn try_bisect(
    [mut first, mut last]: [f64; 2],
    halvings: u32,
    width: f64,
    mut holds: impl FnMut(f64) -> Option<bool>,
) -> Result<[f64; 2], [f64; 2]> {
    for _ in 0..halvings {
        let middle = 0.5 * (first + last);
        let narrow = (last - first).abs() <= width * first.abs();
        if narrow || middle == first || middle == last {
            break;
        }
        match holds(middle) {
            Some(true) => first = middle,
            Some(false) => last = middle,
            None => return Err([first, last]),
        }
    }
    Ok([first, last])
}

/// The middle between two places.
pub(crate) fn middle([first, last]: [f64; 2]) -> f64 {
    0.5 * (first + last)
}

#[cfg(test)]
mod tests {
    use super::{bisect, bracketed, middle, try_bisect};

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

    #[test]
    fn halving_ends_at_neighbours_from_either_side() {
        let square = |x: f64| x * x < 2.0;
        let [below, above] = bisect([0.0, 2.0], 200, square);
        assert_eq!(above, below.next_up());
        assert!(square(below) && !square(above));
        let [above, below] = bisect([2.0, 0.0], 200, |x| !square(x));
        assert_eq!(above, below.next_up());
        assert!((middle(bisect([0.0, 2.0], 3, square)) - 1.375).abs() < 1e-15);
        // A place that is not a number is none between.
        assert!(bisect([0.0, f64::NAN], 50, square)[1].is_nan());
    }

    #[test]
    fn halving_stops_at_a_width_and_where_nothing_is_known() {
        let mut asked = 0;
        let found = try_bisect([8.0, 10.0], 200, 0.05, |x| {
            asked += 1;
            Some(x < 9.1)
        });
        assert_eq!((found, asked), (Ok([9.0, 9.25]), 3));
        let unknown = |x: f64| (x < 6.0).then_some(x < 5.0);
        assert_eq!(
            try_bisect([0.0, 10.0], 200, 0.0, unknown)
                .map(middle)
                .unwrap(),
            5.0
        );
        assert_eq!(try_bisect([0.0, 14.0], 200, 0.0, unknown), Err([0.0, 14.0]));
    }
}
