//! Polynomials from conditions at the ends of the unit interval and points between.

use crate::math::fourier::Terms;
use crate::math::jet::Jet;

/// Conditions that a polynomial law fulfils: its degree is one less than their number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolynomialSpec {
    /// θ, θ′, θ″, … at τ = 0.
    pub start: Vec<f64>,
    /// θ, θ′, θ″, … at τ = 1.
    pub end: Vec<f64>,
    /// Points (τ, θ) between, 0 < τ < 1, all different.
    pub through: Vec<(f64, f64)>,
}

/// Most conditions: beyond, the polynomial swings more than it helps.
pub(crate) const MOST_CONDITIONS: usize = 16;

impl PolynomialSpec {
    /// Number of conditions.
    pub fn conditions(&self) -> usize {
        self.start.len() + self.end.len() + self.through.len()
    }
}

/// The polynomial of least degree through given derivatives at 0 and 1 and
/// given points between (Hermite interpolation).
///
/// It is kept in Newton's form twice, expanded from either end, and evaluated
/// by the nearer one, so that what is prescribed at an end holds there without
/// the rounding of large coefficients that cancel.
#[derive(Clone, Debug, PartialEq)]
pub struct EndPolynomial {
    from_start: Newton,
    from_end: Newton,
}

/// c₀ + (x − z₀)·(c₁ + (x − z₁)·(c₂ + …)).
#[derive(Clone, Debug, PartialEq)]
struct Newton {
    nodes: Vec<f64>,
    coefficients: Vec<f64>,
}

impl EndPolynomial {
    /// The polynomial that fulfils `spec`, which has at least one condition,
    /// finite numbers, and points between 0 and 1 that differ.
    pub fn new(spec: &PolynomialSpec) -> Self {
        let (start, end) = ((0.0, &spec.start[..]), (1.0, &spec.end[..]));
        Self {
            from_start: Newton::divided_differences([start, end], &spec.through),
            from_end: Newton::divided_differences([end, start], &spec.through),
        }
    }

    /// Value and derivatives at `x`.
    pub fn jet(&self, x: f64) -> Jet {
        if x < 0.5 {
            self.from_start.jet(x)
        } else {
            self.from_end.jet(x)
        }
    }

    /// The first `count` derivatives at `x`, the value first.
    pub(crate) fn derivatives(&self, x: f64, count: usize) -> Vec<f64> {
        let form = if x < 0.5 {
            &self.from_start
        } else {
            &self.from_end
        };
        form.derivatives(x, count)
    }

    /// The same in powers of y on the interval about `middle` of half the length `half`.
    pub(crate) fn terms(&self, [middle, half]: [f64; 2]) -> Terms {
        let count = self.from_start.nodes.len();
        let (mut scale, mut taylor) = (1.0, self.derivatives(middle, count));
        for (power, own) in taylor.iter_mut().enumerate() {
            *own *= scale;
            scale *= half / (power + 1) as f64;
        }
        Terms::of_polynomial(taylor)
    }

    /// True when no coefficient has overflowed.
    pub fn is_finite(&self) -> bool {
        let forms = [&self.from_start, &self.from_end];
        forms
            .iter()
            .all(|form| form.coefficients.iter().all(|c| c.is_finite()))
    }
}

impl Newton {
    /// Divided differences over the nodes, each end as often as it has
    /// derivatives; equal nodes take f⁽ᵏ⁾/k!.
    fn divided_differences(ends: [(f64, &[f64]); 2], points: &[(f64, f64)]) -> Self {
        let mut nodes = Vec::new();
        // (derivatives known at the node, in order)
        let mut known: Vec<&[f64]> = Vec::new();
        for (at, derivatives) in ends {
            for _ in derivatives {
                nodes.push(at);
                known.push(derivatives);
            }
        }
        let values: Vec<[f64; 1]> = points.iter().map(|point| [point.1]).collect();
        nodes.extend(points.iter().map(|point| point.0));
        known.extend(values.iter().map(|value| &value[..]));
        let mut row: Vec<f64> = known.iter().map(|derivatives| derivatives[0]).collect();
        let mut coefficients: Vec<f64> = row.first().copied().into_iter().collect();
        let mut factorial = 1.0;
        for order in 1..nodes.len() {
            factorial *= order as f64;
            for i in 0..nodes.len() - order {
                let gap = nodes[i + order] - nodes[i];
                row[i] = if gap == 0.0 {
                    known[i][order] / factorial
                } else {
                    (row[i + 1] - row[i]) / gap
                };
            }
            coefficients.push(row[0]);
        }
        Self {
            nodes,
            coefficients,
        }
    }

    fn derivatives(&self, x: f64, count: usize) -> Vec<f64> {
        let mut taylor = vec![0.0; count];
        for (node, coefficient) in self.nodes.iter().zip(&self.coefficients).rev() {
            for order in (1..count).rev() {
                taylor[order] = taylor[order] * (x - node) + taylor[order - 1];
            }
            taylor[0] = taylor[0] * (x - node) + coefficient;
        }
        let mut factorial = 1.0;
        for (order, value) in taylor.iter_mut().enumerate().skip(1) {
            factorial *= order as f64;
            *value *= factorial;
        }
        taylor
    }

    fn jet(&self, x: f64) -> Jet {
        let [mut value, mut first, mut second, mut third] = [0.0f64; 4];
        for (node, coefficient) in self.nodes.iter().zip(&self.coefficients).rev() {
            let step = x - node;
            third = third * step + second;
            second = second * step + first;
            first = first * step + value;
            value = value * step + coefficient;
        }
        Jet {
            value,
            first,
            second: 2.0 * second,
            third: 6.0 * third,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{EndPolynomial, PolynomialSpec};

    fn spec(start: &[f64], end: &[f64], through: &[(f64, f64)]) -> PolynomialSpec {
        PolynomialSpec {
            start: start.to_vec(),
            end: end.to_vec(),
            through: through.to_vec(),
        }
    }

    #[test]
    fn conditions_hold_and_the_known_polynomials_come_out() {
        let p = EndPolynomial::new(&spec(&[0.0; 3], &[1.0, 0.0, 0.0], &[]));
        for i in 0..=20 {
            let x = f64::from(i) / 20.0;
            let y = 10.0 * x.powi(3) - 15.0 * x.powi(4) + 6.0 * x.powi(5);
            approx::assert_abs_diff_eq!(p.jet(x).value, y, epsilon = 1e-14);
            let third = 60.0 - 360.0 * x + 360.0 * x * x;
            approx::assert_abs_diff_eq!(p.jet(x).third, third, epsilon = 1e-12);
        }
        let odd = [0.3, -2.0, 5.0, 7.0];
        let p = EndPolynomial::new(&spec(&odd, &[1.5, 4.0, -1.0], &[(0.3, 0.2), (0.8, -1.0)]));
        let (a, b) = (p.jet(0.0), p.jet(1.0));
        assert_eq!([a.value, a.first, a.second], [0.3, -2.0, 5.0]);
        approx::assert_relative_eq!(a.third, 7.0, max_relative = 1e-14);
        assert_eq!([b.value, b.first, b.second], [1.5, 4.0, -1.0]);
        let (jet, all) = (p.jet(0.4), p.derivatives(0.4, 4));
        let jet = [jet.value, jet.first, jet.second, jet.third];
        approx::assert_relative_eq!(jet[..], all[..], max_relative = 1e-13);
        approx::assert_abs_diff_eq!(p.jet(0.3).value, 0.2, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(p.jet(0.8).value, -1.0, epsilon = 1e-13);
    }

    #[test]
    fn both_expansions_are_the_same_polynomial() {
        let mut end = [0.0; 8];
        end[0] = 1.0;
        let p = EndPolynomial::new(&spec(&[0.0; 8], &end, &[]));
        for x in [0.0, 0.2, 0.5, 0.7, 1.0] {
            let (a, b) = (p.from_start.jet(x), p.from_end.jet(x));
            approx::assert_abs_diff_eq!(a.value, b.value, epsilon = 1e-11);
            approx::assert_abs_diff_eq!(a.second, b.second, epsilon = 1e-8);
        }
        approx::assert_abs_diff_eq!(p.jet(0.5).value, 0.5, epsilon = 1e-13);
    }
}
