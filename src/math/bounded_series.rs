//! Taylor series in time, with a bound on their rounding.
//!
//! At t = 0 a pair may just touch without pressing: what it does next is said
//! by the first derivative that does not vanish, and "does not vanish" needs to
//! know how large a rounding error may be. Every coefficient therefore carries
//! a magnitude, the sum of the absolute values of all that was added up to it.

use crate::math::expression::{Function, Scalar, taylor_about};
use crate::math::jet::Jet;
use crate::math::number::Number;
use crate::math::quantity::Quantity;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Highest power of time: enough for the wave of a load on the last of 15
/// undamped masses to show at the first.
pub(crate) const ORDER: usize = 32;

/// A coefficient counts as zero below this share of its magnitude.
const ZERO_COEFFICIENT: f64 = 1e-12;

/// Step of the differences that continue a law beyond its third derivative,
/// and the share of the third derivative below which they count as nothing.
const STEP: f64 = 1e-5;
const DIFFERENCE_NOISE: f64 = 1e-6;

/// A truncated Taylor series Σ c_k·t^k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Series {
    /// Powers above are not worked out, and 0. What is made of several series
    /// goes as far as the longest of them: constants are exact as they stand,
    /// and what varies is all made to the same order.
    order: usize,
    /// c_k.
    pub(crate) coefficients: [f64; ORDER + 1],
    /// Sum of the absolute values of what was added up to c_k.
    magnitudes: [f64; ORDER + 1],
}

impl Series {
    /// A constant known up to rounding of numbers of a size.
    pub(crate) fn constant(value: f64, size: f64) -> Self {
        let mut series = Self::zero(0);
        series.set(0, value, size);
        series
    }

    /// Zero, with powers up to `order`.
    fn zero(order: usize) -> Self {
        Self {
            order,
            coefficients: [0.0; ORDER + 1],
            magnitudes: [0.0; ORDER + 1],
        }
    }

    /// The time itself, t; its functions are worked out up to a power.
    pub(crate) fn time(order: usize) -> Self {
        let mut series = Self::zero(order);
        series.set(1, 1.0, 1.0);
        series
    }

    /// Sets a coefficient; `size` is that of the numbers it came from.
    pub(crate) fn set(&mut self, power: usize, value: f64, size: f64) {
        self.order = self.order.max(power);
        self.coefficients[power] = value;
        self.magnitudes[power] = size.abs().max(value.abs());
    }

    /// Magnitude of a coefficient.
    pub(crate) fn magnitude(&self, power: usize) -> f64 {
        self.magnitudes[power]
    }

    /// Derivative with respect to time.
    pub(crate) fn rate(&self) -> Self {
        let mut rate = Self::zero(self.order.saturating_sub(1));
        for power in 1..=self.order {
            let factor = power as f64;
            rate.coefficients[power - 1] = factor * self.coefficients[power];
            rate.magnitudes[power - 1] = factor * self.magnitudes[power];
        }
        rate
    }

    /// Sign just after t = 0: that of the first coefficient that is not zero
    /// beyond rounding; 0 when there is none.
    pub(crate) fn sign(&self) -> f64 {
        let leading = self.leading();
        leading.map_or(0.0, |power| self.coefficients[power].signum())
    }

    /// The power of that coefficient.
    pub(crate) fn leading(&self) -> Option<usize> {
        let coefficients = &self.coefficients[..=self.order];
        let mut both = coefficients.iter().zip(&self.magnitudes);
        both.position(|(value, size)| value.abs() > ZERO_COEFFICIENT * size)
    }

    /// f(self) from the derivatives of f at its start, each with the size of
    /// the numbers it came from.
    fn composed(self, derivatives: &[(f64, f64)]) -> Self {
        let mut change = self;
        change.coefficients[0] = 0.0;
        change.magnitudes[0] = 0.0;
        let mut sum = Self::constant(0.0, 0.0);
        for (order, &(value, size)) in derivatives.iter().enumerate().rev() {
            let factor = 1.0 / (order + 1) as f64;
            sum = Self::constant(value, size) + (sum * change).scale(factor);
        }
        sum
    }

    fn map(mut self, f: impl Fn(f64) -> f64, size: impl Fn(f64) -> f64) -> Self {
        for power in 0..=self.order {
            self.coefficients[power] = f(self.coefficients[power]);
            self.magnitudes[power] = size(self.magnitudes[power]);
        }
        self
    }

    fn sum(self, other: Self, sign: f64) -> Self {
        let mut sum = self;
        sum.order = self.order.max(other.order);
        for power in 0..=other.order {
            sum.coefficients[power] += sign * other.coefficients[power];
            sum.magnitudes[power] += other.magnitudes[power];
        }
        sum
    }
}

/// Horner's scheme above divides by 1, 2, 3 … on the way in, which turns the
/// derivatives of a list into those of its Taylor polynomial. The list carries,
/// with each derivative, how far rounding of the argument moves it.
fn with_sizes(derivatives: &[f64], argument: f64) -> Vec<(f64, f64)> {
    (0..derivatives.len())
        .map(|order| {
            let next = derivatives.get(order + 1).copied().unwrap_or(0.0);
            (
                derivatives[order],
                derivatives[order].abs() + (next * argument).abs(),
            )
        })
        .collect()
}

/// Central difference, 0 where it is within its noise or not finite.
fn difference(above: f64, below: f64) -> f64 {
    let slope = (above - below) / (2.0 * STEP);
    if slope.is_finite() && slope.abs() > DIFFERENCE_NOISE * (above.abs() + below.abs()) {
        slope
    } else {
        0.0
    }
}

impl Quantity for Series {
    const DERIVATIVES: usize = 3;

    /// Exact up to the third derivative of U, the fourth from a difference;
    /// from the fifth on U is taken as a polynomial of degree four.
    fn lift(self, jet: impl Fn(f64) -> Jet) -> [Self; 3] {
        let start = self.coefficients[0];
        let here = jet(start);
        let fourth = difference(jet(start + STEP).third, jet(start - STEP).third);
        let all = [here.value, here.first, here.second, here.third, fourth];
        let derivatives = with_sizes(&all, start);
        [
            self.composed(&derivatives),
            self.composed(&derivatives[1..]),
            self.composed(&derivatives[2..]),
        ]
    }

    /// Exact to the first derivative of f, the second from a difference.
    fn apply(self, function: impl Fn(f64) -> (f64, f64)) -> Self {
        let start = self.coefficients[0];
        let (value, first) = function(start);
        let second = difference(function(start + STEP).1, function(start - STEP).1);
        self.composed(&with_sizes(&[value, first, second], start))
    }
}

/// Derivatives of a function of an expression that are followed.
const FOLLOWED: usize = 8;

impl Series {
    /// A function of it, from the coefficients of its power series.
    fn of_coefficients(self, mut coefficients: [f64; FOLLOWED]) -> Self {
        let mut factorial = 1.0;
        for (order, c) in coefficients.iter_mut().enumerate().skip(1) {
            factorial *= order as f64;
            *c *= factorial;
        }
        self.composed(&with_sizes(&coefficients, self.coefficients[0]))
    }
}

impl Scalar for Series {
    fn number(value: f64) -> Self {
        Self::from(value)
    }

    fn compared_value(self) -> f64 {
        self.coefficients[0]
    }

    fn affine(self, factor: f64, shift: f64) -> Self {
        self.scale(factor) + Self::from(shift)
    }

    /// Exact up to the seventh derivative.
    fn of(self, function: Function) -> Self {
        self.of_coefficients(taylor_about(function, self.coefficients[0]))
    }

    fn power(self, exponent: f64) -> Self {
        let start = self.coefficients[0];
        let mut coefficients = [0.0; FOLLOWED];
        let mut factor = 1.0;
        for (order, c) in coefficients.iter_mut().enumerate() {
            *c = factor * start.powf(exponent - order as f64);
            factor *= (exponent - order as f64) / (order + 1) as f64;
        }
        self.of_coefficients(coefficients)
    }

    fn power_of(self, exponent: Self) -> Self {
        (self.of(Function::Ln) * exponent).of(Function::Exp)
    }

    /// The direction at the start, and from there the angle turned by.
    fn atan2(y: Self, x: Self) -> Self {
        let (v, u) = (y.coefficients[0], x.coefficients[0]);
        let across = y.scale(u) - x.scale(v);
        let along = x.scale(u) + y.scale(v);
        (across / along).of(Function::Atan) + Self::from(v.atan2(u))
    }
}

impl Number for Series {
    fn value(self) -> f64 {
        self.coefficients[0]
    }

    fn compose(self, value: f64, derivative: f64) -> Self {
        self.composed(&with_sizes(&[value, derivative], self.coefficients[0]))
    }

    fn scale(self, factor: f64) -> Self {
        self.map(|value| value * factor, |size| size * factor.abs())
    }
}

impl From<f64> for Series {
    fn from(value: f64) -> Self {
        Self::constant(value, value)
    }
}

impl Add for Series {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.sum(other, 1.0)
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.sum(other, -1.0)
    }
}

impl Mul for Series {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let order = self.order.max(other.order);
        let mut product = Self::zero(order);
        for i in 0..=self.order {
            for j in 0..=other.order.min(order - i) {
                product.coefficients[i + j] += self.coefficients[i] * other.coefficients[j];
                product.magnitudes[i + j] += self.magnitudes[i] * other.magnitudes[j];
            }
        }
        product
    }
}

impl Div for Series {
    type Output = Self;
    /// Division by a series that does not start at zero.
    fn div(self, other: Self) -> Self {
        let order = self.order.max(other.order);
        let mut quotient = Self::zero(order);
        let start = other.coefficients[0];
        for power in 0..=order {
            let (mut value, mut size) = (self.coefficients[power], self.magnitudes[power]);
            for i in 0..power {
                value -= quotient.coefficients[i] * other.coefficients[power - i];
                size += quotient.magnitudes[i] * other.magnitudes[power - i];
            }
            quotient.coefficients[power] = value / start;
            quotient.magnitudes[power] = size / start.abs();
        }
        quotient
    }
}

impl Neg for Series {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|value| -value, |size| size)
    }
}

impl AddAssign for Series {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Series {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::{ORDER, Quantity, Series};
    use crate::math::jet::Jet;
    use crate::math::number::Number;

    /// 1.5·sin 2φ.
    fn sine(phi: f64) -> Jet {
        let (sin, cos) = (2.0 * phi).sin_cos();
        Jet {
            value: 1.5 * sin,
            first: 3.0 * cos,
            second: -6.0 * sin,
            third: -12.0 * cos,
        }
    }

    #[test]
    fn a_law_is_composed_with_a_motion_to_the_fourth_order() {
        let t = Series::time(ORDER);
        let phi = Series::from(0.4) + t.scale(3.0) + (t * t).scale(0.7);
        let [value, first, _] = phi.lift(sine);
        // The series agrees with the law along the motion, to its order.
        let at = |t: f64| sine(0.4 + 3.0 * t + 0.7 * t * t);
        let sum = |series: &Series, t: f64, order: i32| -> f64 {
            (0..=order)
                .map(|power| series.coefficients[power as usize] * t.powi(power))
                .sum()
        };
        for t in [-1e-3, 1e-3] {
            approx::assert_abs_diff_eq!(sum(&value, t, 4), at(t).value, epsilon = 1e-12);
            approx::assert_abs_diff_eq!(sum(&first, t, 3), at(t).first, epsilon = 1e-9);
        }
    }

    #[test]
    fn quotients_undo_products() {
        let t = Series::time(ORDER);
        let a = Series::from(2.0) + t.scale(0.5) - (t * t).scale(0.25);
        let b = Series::from(-1.5) + t + (t * t * t).scale(0.2);
        let quotient = (a * b) / b;
        for power in 0..10 {
            let expected = a.coefficients[power];
            approx::assert_abs_diff_eq!(quotient.coefficients[power], expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn what_is_zero_up_to_rounding_does_not_decide_a_sign() {
        // U″ of sin 2φ at φ = π is 10⁻¹⁵, not zero; U‴ < 0 decides.
        let phi = Series::from(std::f64::consts::PI) + Series::time(ORDER);
        let [_, _, second] = phi.lift(sine);
        assert!(second.value() > 0.0 && second.value() < 1e-14);
        assert_eq!(second.sign(), -1.0);
        assert_eq!((-second).sign(), 1.0);
        // 0.1 + 0.2 − 0.3 is a rounding, and nothing follows it.
        let residue = Series::from(0.1) + Series::from(0.2) - Series::from(0.3);
        assert_ne!(residue.value(), 0.0);
        assert_eq!(residue.sign(), 0.0);
    }
}
