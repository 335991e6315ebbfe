//! Cubic splines with continuous second derivative.

use crate::math::jet::Jet;
use crate::math::linear::{cyclic, tridiagonal};

/// A cubic spline: value, first and second derivative are continuous; the third
/// is constant between knots and jumps at them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Arguments of the given points, strictly ascending.
    knots: Vec<f64>,
    /// For each interval y + t·(b + t·(c + t·d)), t from its left knot.
    coefficients: Vec<[f64; 4]>,
    periodic: bool,
}

impl Spline {
    /// The spline through at least two points (strictly ascending, finite)
    /// with given slopes at both ends.
    pub fn clamped(points: &[(f64, f64)], end_slopes: (f64, f64)) -> Self {
        let count = points.len();
        let (steps, slopes) = differences(points);
        let mut lower = vec![0.0; count];
        let mut diagonal = vec![0.0; count];
        let mut upper = vec![0.0; count];
        let mut right = vec![0.0; count];
        for i in 0..count {
            let (before, after) = (
                i.checked_sub(1).map_or(0.0, |i| steps[i]),
                steps.get(i).copied().unwrap_or(0.0),
            );
            lower[i] = before;
            upper[i] = after;
            diagonal[i] = 2.0 * (before + after);
            let slope_before = if i == 0 { end_slopes.0 } else { slopes[i - 1] };
            let slope_after = slopes.get(i).copied().unwrap_or(end_slopes.1);
            right[i] = 6.0 * (slope_after - slope_before);
        }
        let curvatures = tridiagonal(&lower, &diagonal, &upper, right);
        Self::from_curvatures(points, &curvatures, false)
    }

    /// The spline through at least three points (strictly ascending, finite),
    /// the last of which closes the period: its value is taken to be the first's.
    pub fn periodic(points: &[(f64, f64)]) -> Self {
        let mut closed = points.to_vec();
        if let (Some(&first), Some(last)) = (points.first(), closed.last_mut()) {
            last.1 = first.1;
        }
        let (steps, slopes) = differences(&closed);
        let count = steps.len();
        let before = |i: usize| (i + count - 1) % count;
        let diagonal: Vec<f64> = (0..count)
            .map(|i| 2.0 * (steps[before(i)] + steps[i]))
            .collect();
        let right = (0..count)
            .map(|i| 6.0 * (slopes[i] - slopes[before(i)]))
            .collect();
        let mut curvatures = cyclic(&steps, &diagonal, right);
        curvatures.push(curvatures[0]);
        Self::from_curvatures(&closed, &curvatures, true)
    }

    /// The spline through at least three points with end slopes estimated from
    /// the points: those of the polynomials through the four (or three)
    /// points nearest each end.
    pub fn through(points: &[(f64, f64)]) -> Self {
        let near = points.len().min(4);
        let last: Vec<_> = points.iter().rev().take(near).copied().collect();
        Self::clamped(
            points,
            (slope_at_first(&points[..near]), slope_at_first(&last)),
        )
    }

    fn from_curvatures(points: &[(f64, f64)], curvatures: &[f64], periodic: bool) -> Self {
        let coefficients = points
            .windows(2)
            .zip(curvatures.windows(2))
            .map(|(ends, curvature)| {
                let step = ends[1].0 - ends[0].0;
                let slope = (ends[1].1 - ends[0].1) / step;
                [
                    ends[0].1,
                    slope - step * (2.0 * curvature[0] + curvature[1]) / 6.0,
                    0.5 * curvature[0],
                    (curvature[1] - curvature[0]) / (6.0 * step),
                ]
            })
            .collect();
        Self {
            knots: points.iter().map(|point| point.0).collect(),
            coefficients,
            periodic,
        }
    }

    /// Value and derivatives at `x`. A periodic spline repeats; another one
    /// goes on beyond its ends by the cubic of its first or last interval.
    pub fn jet(&self, x: f64) -> Jet {
        let (first, last) = self.ends();
        let x = if self.periodic {
            let period = last - first;
            x - period * ((x - first) / period).floor()
        } else {
            x
        };
        let inner = &self.knots[1..self.knots.len() - 1];
        self.jet_of(inner.partition_point(|&knot| knot <= x), x)
    }

    /// Value and derivatives at `x` by the cubic of an interval, also beyond its ends.
    pub fn jet_of(&self, interval: usize, x: f64) -> Jet {
        let t = x - self.knots[interval];
        let [y, b, c, d] = self.coefficients[interval];
        Jet {
            value: y + t * (b + t * (c + t * d)),
            first: b + t * (2.0 * c + t * 3.0 * d),
            second: 2.0 * c + t * 6.0 * d,
            third: 6.0 * d,
        }
    }

    /// For each interval between knots y + t·(b + t·(c + t·d)), t from its left knot.
    pub(crate) fn coefficients(&self) -> &[[f64; 4]] {
        &self.coefficients
    }

    /// First and last knot.
    pub fn ends(&self) -> (f64, f64) {
        (self.knots[0], self.knots[self.knots.len() - 1])
    }

    /// The knots, ascending: the third derivative jumps there.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// True when the spline repeats.
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// True when no coefficient has overflowed.
    pub fn is_finite(&self) -> bool {
        self.coefficients.iter().flatten().all(|c| c.is_finite())
    }
}

fn differences(points: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
    points
        .windows(2)
        .map(|ends| {
            let step = ends[1].0 - ends[0].0;
            (step, (ends[1].1 - ends[0].1) / step)
        })
        .unzip()
}

/// Slope at the first point of the polynomial through all the points (Lagrange).
fn slope_at_first(points: &[(f64, f64)]) -> f64 {
    let (x0, y0) = points[0];
    let mut slope = 0.0;
    for (i, &(xi, yi)) in points.iter().enumerate().skip(1) {
        let mut weight = 1.0 / (xi - x0);
        for (j, &(xj, _)) in points.iter().enumerate().skip(1) {
            if j != i {
                weight *= (xj - x0) / (xj - xi);
            }
        }
        slope += weight * (yi - y0);
    }
    slope
}

#[cfg(test)]
mod tests {
    use super::Spline;

    fn sample(f: impl Fn(f64) -> f64, knots: &[f64]) -> Vec<(f64, f64)> {
        knots.iter().map(|&x| (x, f(x))).collect()
    }

    #[test]
    fn a_cubic_is_reproduced_exactly_by_clamped_and_estimated_ends() {
        let f = |x: f64| 2.0 - x + 0.5 * x * x - 0.25 * x * x * x;
        let slope = |x: f64| -1.0 + x - 0.75 * x * x;
        let knots = [-1.0, 0.2, 0.9, 2.0, 2.4];
        let points = sample(f, &knots);
        let clamped = Spline::clamped(&points, (slope(-1.0), slope(2.4)));
        for spline in [clamped, Spline::through(&points)] {
            for i in 0..=40 {
                let x = -1.1 + 0.09 * f64::from(i);
                let jet = spline.jet(x);
                approx::assert_abs_diff_eq!(jet.value, f(x), epsilon = 1e-13);
                approx::assert_abs_diff_eq!(jet.first, slope(x), epsilon = 1e-12);
                approx::assert_abs_diff_eq!(jet.second, 1.0 - 1.5 * x, epsilon = 1e-11);
                approx::assert_abs_diff_eq!(jet.third, -1.5, epsilon = 1e-10);
            }
        }
    }

    #[test]
    fn three_points_without_slopes_give_the_parabola() {
        let spline = Spline::through(&[(0.0, 1.0), (1.0, 0.0), (3.0, 4.0)]);
        approx::assert_abs_diff_eq!(spline.jet(2.0).value, 1.0, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(spline.jet(0.5).second, 2.0, epsilon = 1e-13);
    }

    #[test]
    fn a_periodic_spline_is_smooth_everywhere_and_repeats() {
        let turn = std::f64::consts::TAU;
        let unequal: Vec<f64> = (0..=24)
            .map(|i| {
                let s = f64::from(i) / 24.0;
                turn * (s + 0.05 * (turn * s).sin())
            })
            .collect();
        let spline = Spline::periodic(&sample(f64::sin, &unequal));
        assert!(spline.is_periodic());
        for &knot in &unequal {
            let (left, right) = (spline.jet(knot - 1e-9), spline.jet(knot + 1e-9));
            approx::assert_abs_diff_eq!(left.value, right.value, epsilon = 1e-8);
            approx::assert_abs_diff_eq!(left.first, right.first, epsilon = 1e-8);
            approx::assert_abs_diff_eq!(left.second, right.second, epsilon = 1e-7);
        }
        for i in 0..100 {
            let x = -8.0 + 0.17 * f64::from(i);
            approx::assert_abs_diff_eq!(spline.jet(x).value, x.sin(), epsilon = 1e-4);
            approx::assert_abs_diff_eq!(spline.jet(x).first, x.cos(), epsilon = 1e-3);
        }
    }

    #[test]
    fn the_shortest_periodic_table_closes() {
        // Two intervals: the wrapped entries of the system fall on its off-diagonal.
        let spline = Spline::periodic(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
        let (left, right) = (spline.jet(2.0 - 1e-12), spline.jet(0.0));
        approx::assert_abs_diff_eq!(left.first, right.first, epsilon = 1e-10);
        approx::assert_abs_diff_eq!(left.second, right.second, epsilon = 1e-10);
        // 3x² − 2x³ between the points, by symmetry.
        approx::assert_abs_diff_eq!(spline.jet(0.25).value, 0.15625, epsilon = 1e-14);
    }
}
