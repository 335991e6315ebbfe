//! Curves through conditions: cubic splines and polynomials, found by another way than the
//! ones that runs are computed with.

use super::local::Local;

/// Sweeps over the slopes of a spline. Each leaves a quarter of what they are off.
const SWEEPS: usize = 60;

/// A cubic spline, known by its points and its slopes there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve {
    points: Vec<(f64, f64)>,
    slopes: Vec<f64>,
    periodic: bool,
}

impl Curve {
    /// With given slopes at both ends.
    pub(crate) fn clamped(points: &[(f64, f64)], ends: (f64, f64)) -> Self {
        let mut slopes = vec![0.0; points.len()];
        (slopes[0], slopes[points.len() - 1]) = ends;
        Self::relaxed(points.to_vec(), slopes, false)
    }

    /// Closed: the last point is the first, one period on.
    pub(crate) fn periodic(points: &[(f64, f64)]) -> Self {
        let mut points = points.to_vec();
        let last = points.len() - 1;
        points[last].1 = points[0].1;
        Self::relaxed(points, vec![0.0; last + 1], true)
    }

    /// With the slopes at its ends of the polynomials through the four points nearest.
    pub(crate) fn through(points: &[(f64, f64)]) -> Self {
        let count = points.len().min(4);
        let backwards: Vec<_> = points.iter().rev().take(count).copied().collect();
        Self::clamped(points, (end_slope(&points[..count]), end_slope(&backwards)))
    }

    /// Finds the slopes at which the second derivative is continuous, one after the other.
    fn relaxed(points: Vec<(f64, f64)>, mut slopes: Vec<f64>, periodic: bool) -> Self {
        let last = points.len() - 1;
        let cell = |k: usize| {
            let (from, to) = (points[k], points[k + 1]);
            (to.0 - from.0, (to.1 - from.1) / (to.0 - from.0))
        };
        for _ in 0..SWEEPS {
            for k in usize::from(!periodic)..last {
                let before = if k == 0 { last - 1 } else { k - 1 };
                let ((a, rise), (b, fall)) = (cell(before), cell(k));
                let neighbours = slopes[before] / a + slopes[k + 1] / b;
                slopes[k] = (3.0 * (rise / a + fall / b) - neighbours) / (2.0 / a + 2.0 / b);
                if periodic && k == 0 {
                    slopes[last] = slopes[0];
                }
            }
        }
        Self {
            points,
            slopes,
            periodic,
        }
    }

    /// First and last argument, with value and slope there.
    pub(crate) fn ends(&self) -> [(f64, f64, f64); 2] {
        [0, self.points.len() - 1].map(|k| (self.points[k].0, self.points[k].1, self.slopes[k]))
    }

    /// Value and derivatives; beyond the ends it goes on straight.
    pub(crate) fn at(&self, x: f64) -> Local {
        let [first, last] = self.ends();
        let mut x = x;
        if self.periodic {
            x = first.0 + (x - first.0).rem_euclid(last.0 - first.0);
        } else if x < first.0 || x > last.0 {
            let end = if x < first.0 { first } else { last };
            return Local::new(end.1 + end.2 * (x - end.0), end.2, 0.0);
        }
        let count = self.points.len();
        let k = (1..count - 1)
            .find(|&k| x < self.points[k].0)
            .unwrap_or(count - 1)
            - 1;
        let ((x0, y0), (x1, y1)) = (self.points[k], self.points[k + 1]);
        let span = x1 - x0;
        let t = Local::variable((x - x0) / span);
        let rest = (-t).shift(1.0);
        // Hermite's four cubics.
        let value = (rest * rest * t.scale(2.0).shift(1.0)).scale(y0)
            + (t * t * rest.scale(2.0).shift(1.0)).scale(y1)
            + (rest * rest * t).scale(span * self.slopes[k])
            - (t * t * rest).scale(span * self.slopes[k + 1]);
        value.faster(1.0 / span)
    }
}

/// Slope at the first point of the polynomial through all, by Newton's divided differences.
fn end_slope(points: &[(f64, f64)]) -> f64 {
    let mut row: Vec<f64> = points.iter().map(|point| point.1).collect();
    let (mut slope, mut product) = (0.0, 1.0);
    for order in 1..points.len() {
        for i in 0..points.len() - order {
            row[i] = (row[i + 1] - row[i]) / (points[i + order].0 - points[i].0);
        }
        slope += row[0] * product;
        product *= points[0].0 - points[order].0;
    }
    slope
}

/// A polynomial on [0, 1] as a sum of Chebyshev polynomials of 2·τ − 1.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sum(pub(crate) Vec<f64>);

impl Sum {
    /// The polynomial of least degree with these derivatives (value first) at 0 and at 1 and
    /// through these points; `None`: the conditions do not determine it.
    pub(crate) fn polynomial_with_derivatives(
        start: &[f64],
        end: &[f64],
        through: &[(f64, f64)],
    ) -> Option<Self> {
        let count = start.len() + end.len() + through.len();
        let mut rows = Vec::with_capacity(count);
        for (at_end, values) in [(false, start), (true, end)] {
            for (order, value) in values.iter().enumerate() {
                let mut row: Vec<f64> = (0..count)
                    .map(|n| chebyshev_end_derivative(n, order, at_end))
                    .collect();
                row.push(*value);
                rows.push(row);
            }
        }
        for &(tau, value) in through {
            let mut row: Vec<f64> = (0..count).map(|n| chebyshev(n, tau).value).collect();
            row.push(value);
            rows.push(row);
        }
        solve(rows).map(Self)
    }

    /// Value and derivatives at τ.
    pub(crate) fn at(&self, tau: f64) -> Local {
        let terms = self.0.iter().enumerate();
        terms.fold(Local::default(), |sum, (n, factor)| {
            sum + chebyshev(n, tau).scale(*factor)
        })
    }
}

/// Tₙ(2·τ − 1) with its derivatives by τ.
fn chebyshev(n: usize, tau: f64) -> Local {
    let x = Local::new(2.0 * tau - 1.0, 2.0, 0.0);
    let (mut last, mut now) = (Local::new(1.0, 0.0, 0.0), x);
    if n == 0 {
        return last;
    }
    for _ in 1..n {
        (last, now) = (now, (x * now).scale(2.0) - last);
    }
    now
}

/// The derivative of an order of Tₙ(2·τ − 1) at τ = 0 or 1, in closed form.
pub(crate) fn chebyshev_end_derivative(n: usize, order: usize, at_end: bool) -> f64 {
    let square = (n * n) as f64;
    let product: f64 = (0..order)
        .map(|k| 2.0 * (square - (k * k) as f64) / (2 * k + 1) as f64)
        .product();
    match at_end || (n + order).is_multiple_of(2) {
        true => product,
        false => -product,
    }
}

/// Solves linear equations, the right side last in every row, by elimination with the
/// greatest pivot of a column; rows are scaled first.
pub(crate) fn solve(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = rows.len();
    for row in &mut rows {
        let greatest = row[..count]
            .iter()
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        row.iter_mut().for_each(|x| *x /= greatest);
    }
    for column in 0..count {
        let greatest = (column..count)
            .max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))?;
        rows.swap(column, greatest);
        let pivot = rows[column].clone();
        if !(pivot[column].abs() > 1e-14) {
            return None;
        }
        for row in rows.iter_mut().skip(column + 1) {
            let factor = row[column] / pivot[column];
            for (x, p) in row.iter_mut().zip(&pivot).skip(column) {
                *x -= factor * p;
            }
        }
    }
    let mut found = vec![0.0; count];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|k| rows[row][k] * found[k]).sum();
        found[row] = (rows[row][count] - known) / rows[row][row];
    }
    found.iter().all(|x| x.is_finite()).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::{Curve, Sum};
    use crate::kinematics::motion::Spline;
    use crate::kinematics::motion::law::{EndPolynomial, PolynomialSpec};

    #[test]
    fn splines_are_those_that_runs_are_computed_with() {
        let points = [(0.0, 0.3), (0.4, 1.0), (1.0, -0.2), (1.7, 0.1), (2.0, 0.3)];
        for (own, other) in [
            (
                Curve::clamped(&points, (0.5, -1.0)),
                Spline::clamped(&points, (0.5, -1.0)),
            ),
            (Curve::through(&points), Spline::through(&points)),
            (Curve::periodic(&points), Spline::periodic(&points)),
        ] {
            for k in 0..40 {
                let x = 0.01 + 0.0495 * f64::from(k);
                let (own, other) = (own.at(x), other.jet(x));
                approx::assert_abs_diff_eq!(own.value, other.value, epsilon = 1e-13);
                approx::assert_abs_diff_eq!(own.first, other.first, epsilon = 1e-12);
                approx::assert_abs_diff_eq!(own.second, other.second, epsilon = 1e-11);
            }
        }
    }

    #[test]
    fn polynomials_are_those_that_runs_are_computed_with() {
        let spec = PolynomialSpec {
            start: vec![0.1, -2.0, 5.0],
            end: vec![1.0, 0.5, 0.0, 3.0],
            through: vec![(0.3, 0.2), (0.8, 0.9)],
        };
        let own = Sum::polynomial_with_derivatives(&spec.start, &spec.end, &spec.through).unwrap();
        let other = EndPolynomial::new(&spec);
        for k in 0..=20 {
            let x = 0.05 * f64::from(k);
            let (own, other) = (own.at(x), other.jet(x));
            approx::assert_abs_diff_eq!(own.value, other.value, epsilon = 1e-11);
            approx::assert_abs_diff_eq!(own.first, other.first, epsilon = 1e-10);
            approx::assert_abs_diff_eq!(own.second, other.second, epsilon = 1e-8);
        }
    }
}
