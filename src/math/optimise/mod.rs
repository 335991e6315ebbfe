//! Greatest values: golden section for what may have kinks, Brent's method and
//! parabolas for what is smooth, and the search over the pieces of a function. The least
//! value of f is the greatest of −f.
//!
//! Golden section tolerates kinks; Brent's method is quick without them; `refine_maximum_among` is
//! quicker if seven values are known.

mod among;
mod brent;
pub(crate) mod constrained;
mod parabola;
mod pieces;

pub(crate) use among::refine_maximum_among;
pub(crate) use brent::brent;
pub(crate) use parabola::vertex;
pub(crate) use pieces::greatest;

use serde::Serialize;

/// An extreme and the place where it is (first) reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Peak {
    /// The value.
    pub value: f64,
    /// The place: of a law its time τ.
    pub at: f64,
}

/// Share of an interval that a step of golden section keeps.
const KEPT: f64 = 0.618_033_988_749_894_9;

/// The greatest value between two places of a function that rises and falls once, by
/// golden section: each step keeps 0.618 of the interval and asks for one value. Near a
/// smooth top the place is known to the root of the rounding only.
pub(crate) fn golden(
    f: &mut dyn FnMut(f64) -> f64,
    [mut low, mut high]: [f64; 2],
    steps: u32,
) -> Peak {
    let (mut a, mut b) = (high - KEPT * (high - low), low + KEPT * (high - low));
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..steps {
        if fa >= fb {
            high = b;
            (b, fb) = (a, fa);
            a = high - KEPT * (high - low);
            fa = f(a);
        } else {
            low = a;
            (a, fa) = (b, fb);
            b = low + KEPT * (high - low);
            fb = f(b);
        }
    }
    match fa >= fb {
        true => Peak { value: fa, at: a },
        false => Peak { value: fb, at: b },
    }
}

#[cfg(test)]
mod tests {
    use super::golden;

    #[test]
    fn a_kink_is_found_to_rounding_and_a_smooth_top_to_its_root() {
        let mut asked = 0;
        let mut kink = |x: f64| {
            asked += 1;
            -(x - 0.37).abs()
        };
        let found = golden(&mut kink, [-1.0, 2.0], 80);
        approx::assert_abs_diff_eq!(found.at, 0.37, epsilon = 1e-15);
        assert_eq!(asked, 82);
        let found = golden(&mut |x| (x - 0.2).cos(), [-1.0, 2.0], 60);
        approx::assert_abs_diff_eq!(found.at, 0.2, epsilon = 3e-8);
        assert_eq!(found.value, 1.0);
        // What is never reached counts as nothing.
        let mut part = |x: f64| if x > 0.5 { f64::NEG_INFINITY } else { x };
        approx::assert_abs_diff_eq!(golden(&mut part, [0.0, 1.0], 60).at, 0.5, epsilon = 1e-12);
    }
}
