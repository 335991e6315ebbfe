//! Change points: positions with all links of a dyad in line, where its two
//! assemblies meet and part again, and the linkage passes smoothly from the sign
//! + of the root to the sign − or back.
//!
//! The closed form is 0/0 there. Around such a point the directions of the two
//! bodies are smooth functions of the input; they are interpolated by Chebyshev
//! polynomials through values of the closed form on both sides, none of them
//! close to the point.

use super::series::Series;
use super::vector::Vector;
use std::f64::consts::PI;

/// Nodes: even, so that none is the point itself.
const NODES: usize = 32;
/// Coefficients kept; fewer than nodes, which evens out rounding.
const TERMS: usize = 20;
/// Coefficients at the end that must have died away.
const TAIL: usize = 5;
/// What counts as died away.
const NEGLIGIBLE: f64 = 2e-14;
/// Part of the interval in which the polynomials are used.
const USED: f64 = 0.5;

/// A change point of one dyad.
#[derive(Clone, Debug)]
pub(super) struct Change {
    /// The input there.
    pub(super) at: f64,
    /// True: the sign of the root changes there.
    pub(super) flips: bool,
    /// Half the width of the interval of interpolation.
    radius: f64,
    /// cos θ and sin θ of both bodies.
    terms: [[f64; TERMS]; 4],
}

impl Change {
    /// Interpolates `directions(input, sign)`: cos θ and sin θ of both bodies,
    /// the root having the sign that it is come with, times `sign`. It is come
    /// upwards (`way` > 0) or downwards. `None` where no smooth function goes
    /// through the point.
    pub(super) fn fit(
        at: f64,
        way: f64,
        widest: f64,
        mut directions: impl FnMut(f64, f64) -> Option<[f64; 4]>,
    ) -> Option<Self> {
        let mut radius = widest;
        for _ in 0..10 {
            for flips in [true, false] {
                let sign = |x: f64| if flips && x * way > 0.0 { -1.0 } else { 1.0 };
                let values = nodes().map(|x| directions(at + radius * x, sign(x)));
                let Some(terms) = expand(values.collect::<Option<Vec<_>>>()) else {
                    continue;
                };
                let tail = terms.iter().flat_map(|terms| &terms[TERMS - TAIL..]);
                if tail.map(|c| c.abs()).all(|c| c < NEGLIGIBLE) {
                    return Some(Self {
                        at,
                        flips,
                        radius,
                        terms,
                    });
                }
            }
            radius *= 0.6;
        }
        None
    }

    /// True when the input, this far from the point, is to be interpolated.
    #[inline(always)]
    pub(super) fn holds(&self, distance: f64) -> bool {
        distance.abs() < USED * self.radius
    }

    /// The directions of the bodies at a distance from the point.
    pub(super) fn directions<const N: usize>(&self, distance: f64) -> [Vector<N>; 2] {
        let x = Series::variable(distance).scale(self.radius.recip());
        let [c, s, c2, s2] = self.terms.each_ref().map(|terms| clenshaw(terms, x));
        [Vector::new(c, s), Vector::new(c2, s2)]
    }
}

fn nodes() -> impl Iterator<Item = f64> {
    (0..NODES).map(|j| (PI * (j as f64 + 0.5) / NODES as f64).cos())
}

fn expand(values: Option<Vec<[f64; 4]>>) -> Option<[[f64; TERMS]; 4]> {
    let values = values?;
    let mut terms = [[0.0; TERMS]; 4];
    for (j, value) in values.iter().enumerate() {
        for n in 0..TERMS {
            let weight = (PI * (j as f64 + 0.5) * n as f64 / NODES as f64).cos();
            let share = if n == 0 { 1.0 } else { 2.0 } / NODES as f64 * weight;
            for (term, v) in terms.iter_mut().zip(value) {
                term[n] += share * v;
            }
        }
    }
    terms
        .iter()
        .flatten()
        .all(|c| c.is_finite())
        .then_some(terms)
}

/// Σ c_n T_n(x).
fn clenshaw<const N: usize>(terms: &[f64; TERMS], x: Series<N>) -> Series<N> {
    let (mut one, mut two) = (Series::constant(0.0), Series::constant(0.0));
    for &c in terms[1..].iter().rev() {
        (one, two) = ((x * one).scale(2.0).shift(c) - two, one);
    }
    (x * one).shift(terms[0]) - two
}

#[cfg(test)]
mod tests {
    use super::Change;

    #[test]
    fn a_smooth_function_is_continued_through_its_double_zero() {
        // Directions at the angles ±√(x²·e^x): the smooth one is x·e^(x/2).
        let change = Change::fit(1.0, -1.0, 0.6, |q, side| {
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
        let kink = Change::fit(0.0, 1.0, 0.6, |x: f64, _| {
            Some([x.abs().cos(), x.abs().sin(), 1.0, 0.0])
        });
        assert!(kink.is_none());
    }
}
