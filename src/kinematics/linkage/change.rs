//! Change points: positions with all links of a dyad in line, where its two
//! assemblies meet and part again, and the linkage passes smoothly from the sign
//! + of the root to the sign − or back.
//!
//! The closed form is 0/0 there. Around such a point the directions of the two
//! bodies are smooth functions of the input; they are interpolated by Chebyshev
//! polynomials through values of the closed form on both sides, none of them
//! close to the point.

use super::vector::Vector;
use crate::math::chebyshev::{self, Nodes};
use crate::math::series::Series;
use std::sync::LazyLock;

/// Nodes: even, so that none is the point itself.
const NODES: usize = 32;
/// Places of the nodes.
static PLACES: LazyLock<Nodes<NODES>> = LazyLock::new(Nodes::new);
/// Coefficients kept; fewer than nodes, which evens out rounding.
const TERMS: usize = 20;
/// Coefficients at the end that must have died away.
const TAIL: usize = 5;
/// What counts as died away.
const NEGLIGIBLE: f64 = 2e-14;
/// What counts as rounding of the values, at most: behind many groups that meet at
/// the same point it is more than that of one.
const NOISE: f64 = 1e-10;
/// Part of the interval in which the polynomials are used.
const USED: f64 = 0.5;

/// A change point of one dyad.
#[derive(Clone, Debug)]
pub(super) struct Change {
    /// The input there.
    pub(super) at: f64,
    /// True: the sign of the root changes there.
    pub(super) flips: bool,
    /// Sign of the root below and above.
    signs: [f64; 2],
    /// Half the width of the interval of interpolation.
    radius: f64,
    /// Rounding of a coefficient.
    noise: f64,
    /// Coefficients that are not rounding alone.
    kept: usize,
    /// cos θ and sin θ of both bodies.
    terms: [[f64; TERMS]; 4],
}

impl Change {
    /// Interpolates `directions(input, sign)`: cos θ and sin θ of both bodies,
    /// the root having a sign. It is come upwards (`way` > 0) or downwards, with the
    /// root of the sign given. `None` where no smooth function goes through the point.
    pub(super) fn fit_directions(
        at: f64,
        (way, sign): (f64, f64),
        widest: f64,
        mut directions: impl FnMut(f64, f64) -> Option<[f64; 4]>,
    ) -> Option<Self> {
        let mut radius = widest;
        let mut best: Option<Self> = None;
        for _ in 0..10 {
            for flips in [true, false] {
                let beyond = if flips { -sign } else { sign };
                let signs = match way > 0.0 {
                    true => [sign, beyond],
                    false => [beyond, sign],
                };
                let Some(fitted) = Self::interpolate_signed(at, signs, radius, &mut directions)
                else {
                    continue;
                };
                if fitted.noise < NEGLIGIBLE {
                    return Some(fitted);
                }
                if best.as_ref().is_none_or(|best| fitted.noise < best.noise) {
                    best = Some(fitted);
                }
            }
            // Narrower, rounding only grows.
            if best
                .as_ref()
                .is_some_and(|best| best.noise < NOISE && best.radius > radius)
            {
                break;
            }
            radius *= 0.6;
        }
        best.filter(|best| best.noise < NOISE)
    }

    /// The same point interpolated through other directions; `None` where these are not known.
    pub(super) fn in_directions(
        &self,
        mut directions: impl FnMut(f64, f64) -> Option<[f64; 4]>,
    ) -> Option<Self> {
        let mut again =
            Self::interpolate_signed(self.at, self.signs, self.radius, &mut directions)?;
        again.kept = self.kept;
        Some(again)
    }

    /// Interpolates with the signs of the root below and above.
    fn interpolate_signed(
        at: f64,
        signs: [f64; 2],
        radius: f64,
        directions: &mut impl FnMut(f64, f64) -> Option<[f64; 4]>,
    ) -> Option<Self> {
        let sign = |x: f64| if x < 0.0 { signs[0] } else { signs[1] };
        let places = PLACES.places.iter();
        let values = places.map(|&x| directions(at + radius * x, sign(x)));
        let terms = first_coefficients(&values.collect::<Option<Vec<_>>>()?)?;
        Some(Self::of(at, signs, radius, terms))
    }

    /// The polynomials with these coefficients, cut where nothing but rounding follows.
    fn of(at: f64, signs: [f64; 2], radius: f64, terms: [[f64; TERMS]; 4]) -> Self {
        let greatest = |n: usize| {
            terms
                .iter()
                .fold(0.0f64, |most, terms| most.max(terms[n].abs()))
        };
        let noise = (TERMS - TAIL..TERMS)
            .map(greatest)
            .fold(f64::EPSILON, f64::max);
        let kept = (0..TERMS).rev().find(|&n| greatest(n) > 2.0 * noise);
        Self {
            at,
            flips: signs[0] != signs[1],
            signs,
            radius,
            noise,
            kept: kept.map_or(1, |last| last + 1),
            terms,
        }
    }

    /// True when the input, this far from the point, is to be interpolated.
    #[inline(always)]
    pub(super) fn is_in_force_at(&self, distance: f64) -> bool {
        distance.abs() < USED * self.radius
    }

    /// The directions of the bodies at a distance from the point.
    pub(super) fn directions<const N: usize>(&self, distance: f64) -> [Vector<N>; 2] {
        let x = Series::variable(distance).scale(self.radius.recip());
        let terms = self.terms.each_ref();
        let [c, s, c2, s2] = terms.map(|terms| chebyshev::value(&terms[..self.kept], x));
        [Vector::new(c, s), Vector::new(c2, s2)].map(Vector::nearly_unit)
    }
}

/// The first coefficients of all functions through values at the nodes.
fn first_coefficients(values: &[[f64; 4]]) -> Option<[[f64; TERMS]; 4]> {
    let terms = std::array::from_fn(|k| {
        let fitted = PLACES.polynomial_through(&std::array::from_fn(|j| values[j][k]));
        std::array::from_fn(|n| fitted[n])
    });
    let mut all = terms.iter().flatten();
    all.all(|c: &f64| c.is_finite()).then_some(terms)
}

#[cfg(test)]
mod tests {
    use super::Change;

    #[test]
    fn a_smooth_function_is_continued_through_its_double_zero() {
        // Directions at the angles ±√(x²·e^x): the smooth one is x·e^(x/2).
        let change = Change::fit_directions(1.0, (-1.0, 1.0), 0.6, |q, side| {
            let x: f64 = q - 1.0;
            let (sin, cos) = (side * (x * x * x.exp()).sqrt()).sin_cos();
            Some([cos, sin, 1.0, 0.0])
        });
        let change = change.expect("a smooth function");
        assert!(change.flips);
        for x in [0.0f64, 1e-6, -0.05] {
            let [first, second] = change.directions::<4>(x);
            let angle = x * (x / 2.0).exp();
            let slope = (1.0 + x / 2.0) * (x / 2.0).exp();
            approx::assert_abs_diff_eq!(first.y.0[0], angle.sin(), epsilon = 1e-14);
            approx::assert_abs_diff_eq!(first.y.0[1], angle.cos() * slope, epsilon = 1e-12);
            approx::assert_abs_diff_eq!(second.x.0[0], 1.0, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(second.x.0[3], 0.0, epsilon = 1e-9);
        }
    }

    #[test]
    fn a_kink_is_not_continued() {
        let kink = Change::fit_directions(0.0, (1.0, 1.0), 0.6, |x: f64, _| {
            Some([x.abs().cos(), x.abs().sin(), 1.0, 0.0])
        });
        assert!(kink.is_none());
    }
}
