//! Closures of the dyads that have two assemblies: where two links that meet
//! in a pin, or a link and a guide, find each other.
//!
//! What a linkage places group by group and what a position function knows as
//! a formula of its own (a slider-crank, a four-bar, a slotted link without
//! masses) close in the same way, so that both take the closure from here. They
//! differ in how they come by what goes in: a linkage subtracts places, a
//! position function has its dimensions and takes each factor of a discriminant
//! from terms of one sign, which loses no digits next to a dead-centre position.

use super::vector::Vector;
use crate::math::series::Series;

/// Three pins (RRR): the inner one lies on two circles, of radius a about the
/// first outer pin and of radius b about the second, which is f away.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TwoCircles<const N: usize> {
    /// (a + b)² − f² and f² − (a − b)², zero in the dead-centre positions with the links
    /// stretched and folded; or the same with the sides exchanged, since the
    /// product, the square of four times the triangle's area, is the same.
    pub(crate) factors: [Series<N>; 2],
    /// f² + a² − b².
    pub(crate) along: Series<N>,
}

impl<const N: usize> TwoCircles<N> {
    /// From the first outer pin to the inner one, times 2·f, seen along the line
    /// to the second outer pin: the inner pin lies to its left on branch +.
    #[inline(always)]
    pub(crate) fn vector_to_inner_pin(self, branch: f64) -> Vector<N> {
        let [one, other] = self.factors;
        Vector::new(self.along, closing_root(one, other, branch))
    }
}

/// An outer pin and an outer guide (RRP): how far ahead of the outer pin, along
/// the guide, the inner pin lies on branch +, behind it on branch −.
///
/// `short` and `long` are l − d and l + d, the length of the link less and plus
/// the distance of the inner pin's line from the outer pin; where one of them is
/// zero the link stands across the guide, a dead-centre position.
#[inline(always)]
pub(crate) fn circle_and_line<const N: usize>(
    short: Series<N>,
    long: Series<N>,
    branch: f64,
) -> Series<N> {
    closing_root(short, long, branch)
}

/// A guide between two outer pins (RPR), the square of their distance given:
/// the direction of the guide, times the distance, seen along the line from the
/// first pin to the second. `off` is how far to the left of the guide through
/// the first pin the second one lies; it lies ahead on branch +.
#[inline(always)]
pub(crate) fn guide_between_pins<const N: usize>(
    square: Series<N>,
    off: Series<N>,
    branch: f64,
) -> Vector<N> {
    // Where the guide passes through both pins the distance itself is wanted:
    // its square has lost half the digits of a small one.
    let distance = square.sqrt();
    let ahead = if off.is_zero() {
        distance.scale(branch)
    } else {
        closing_root(distance - off, distance + off, branch)
    };
    Vector::new(ahead, -off)
}

/// The root of a discriminant given as a product of differences, on a branch;
/// not a number where there is no assembly.
#[inline(always)]
fn closing_root<const N: usize>(one: Series<N>, other: Series<N>, branch: f64) -> Series<N> {
    (one * other).sqrt().scale(branch)
}

#[cfg(test)]
mod tests {
    use super::{TwoCircles, circle_and_line, guide_between_pins};
    use crate::math::series::Series;

    #[test]
    fn a_triangle_of_three_four_five_closes_on_both_sides() {
        let (a, b, f) = (3.0, 4.0, 5.0f64);
        for branch in [1.0, -1.0] {
            let closure = TwoCircles {
                factors: [(a + b) * (a + b) - f * f, f * f - (a - b) * (a - b)]
                    .map(Series::<1>::constant),
                along: Series::constant(f * f + a * a - b * b),
            };
            // The height on the side of length 5 is 12/5, its foot 9/5 away.
            let [x, y] = closure.vector_to_inner_pin(branch).value();
            approx::assert_relative_eq!(x, 2.0 * f * 1.8, max_relative = 1e-15);
            approx::assert_relative_eq!(y, branch * 2.0 * f * 2.4, max_relative = 1e-15);
        }
    }

    #[test]
    fn a_link_meets_a_line_and_a_guide_passes_a_pin() {
        let constant = Series::<1>::constant;
        for branch in [1.0, -1.0] {
            let ahead = circle_and_line(constant(5.0 - 3.0), constant(5.0 + 3.0), branch);
            assert_eq!(ahead.value(), branch * 4.0);
            let seen = guide_between_pins(constant(25.0), constant(3.0), branch);
            assert_eq!(seen.value(), [branch * 4.0, -3.0]);
            // Through both pins, nothing is squared: a small distance keeps its digits.
            let near = guide_between_pins(constant(1e-200), constant(0.0), branch);
            assert_eq!(near.value()[0], branch * 1e-100);
        }
        let out_of_reach = circle_and_line(constant(-1e-9), constant(2.0), 1.0);
        assert!(out_of_reach.value().is_nan());
    }
}
