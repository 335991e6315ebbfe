//! Truncated power series in one variable: derivatives up to the third, to full precision.

use crate::jet::Jet;
use std::ops::{Add, Mul, Neg, Sub};

/// c₀ + c₁t + c₂t² + c₃t³ with t the change of the variable: c_k = f⁽ᵏ⁾/k!.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Series([f64; 4]);

impl Series {
    /// sin and cos of `rate`·x at the angle `rate`·x = `angle`.
    pub(super) fn sin_cos(angle: f64, rate: f64) -> (Self, Self) {
        let (sin, cos) = angle.sin_cos();
        let (first, second, third) = (rate, rate * rate / 2.0, rate * rate * rate / 6.0);
        (
            Self([sin, first * cos, -second * sin, -third * cos]),
            Self([cos, -first * sin, -second * cos, third * sin]),
        )
    }

    /// The same times a constant.
    pub(super) fn scale(self, factor: f64) -> Self {
        Self(self.0.map(|c| c * factor))
    }

    /// The same plus a constant.
    pub(super) fn shift(self, value: f64) -> Self {
        let [c0, c1, c2, c3] = self.0;
        Self([c0 + value, c1, c2, c3])
    }

    /// The value.
    pub(super) fn value(self) -> f64 {
        self.0[0]
    }

    /// The same with another value.
    pub(super) fn with_value(self, value: f64) -> Self {
        let [_, c1, c2, c3] = self.0;
        Self([value, c1, c2, c3])
    }

    /// The same plus `rate` times the variable, without changing the value.
    pub(super) fn tilt(self, rate: f64) -> Self {
        let [c0, c1, c2, c3] = self.0;
        Self([c0, c1 + rate, c2, c3])
    }

    /// Square root; not a number where the value is negative.
    pub(super) fn sqrt(self) -> Self {
        let [c0, c1, c2, c3] = self.0;
        let r0 = c0.sqrt();
        let half = 0.5 / r0;
        let r1 = c1 * half;
        let r2 = (c2 - r1 * r1) * half;
        let r3 = (c3 - 2.0 * r1 * r2) * half;
        Self([r0, r1, r2, r3])
    }

    /// Direction of the vector (x, y), in (−π, π] as a value.
    pub(super) fn atan2(y: Self, x: Self) -> Self {
        // α′ = (x·y′ − y·x′)/(x² + y²), a quotient of series of degree 2.
        let ([x0, x1, x2, _], [dy0, dy1, dy2]) = (x.0, y.derivative());
        let ([y0, y1, y2, _], [dx0, dx1, dx2]) = (y.0, x.derivative());
        let n0 = x0 * dy0 - y0 * dx0;
        let n1 = x0 * dy1 + x1 * dy0 - y0 * dx1 - y1 * dx0;
        let n2 = x0 * dy2 + x1 * dy1 + x2 * dy0 - y0 * dx2 - y1 * dx1 - y2 * dx0;
        let [m0, m1, m2, _] = (x * x + y * y).0;
        let q0 = n0 / m0;
        let q1 = (n1 - q0 * m1) / m0;
        let q2 = (n2 - q0 * m2 - q1 * m1) / m0;
        Self([y0.atan2(x0), q0, q1 / 2.0, q2 / 3.0])
    }

    /// Value and derivatives.
    pub(super) fn jet(self) -> Jet {
        let [c0, c1, c2, c3] = self.0;
        Jet {
            value: c0,
            first: c1,
            second: 2.0 * c2,
            third: 6.0 * c3,
        }
    }

    fn derivative(self) -> [f64; 3] {
        [self.0[1], 2.0 * self.0[2], 3.0 * self.0[3]]
    }
}

impl Add for Series {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Series {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl Neg for Series {
    type Output = Self;
    fn neg(self) -> Self {
        self.scale(-1.0)
    }
}

impl Mul for Series {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let ([a0, a1, a2, a3], [b0, b1, b2, b3]) = (self.0, other.0);
        Self([
            a0 * b0,
            a0 * b1 + a1 * b0,
            a0 * b2 + a1 * b1 + a2 * b0,
            a0 * b3 + a1 * b2 + a2 * b1 + a3 * b0,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::Series;

    #[test]
    fn roots_and_directions_have_their_closed_form_derivatives() {
        let (sin, cos) = Series::sin_cos(0.6, 2.0);
        let angle = Series::atan2(sin, cos).jet();
        approx::assert_relative_eq!(angle.value, 0.6, epsilon = 1e-15);
        approx::assert_relative_eq!(angle.first, 2.0, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(angle.second, 0.0, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(angle.third, 0.0, epsilon = 1e-13);
        // √(e² + 2·e·x) at e = 3 in powers of x: 3, 1, −1/3, 1/3.
        let root = Series([9.0, 6.0, 0.0, 0.0]).sqrt().jet();
        assert_eq!((root.value, root.first), (3.0, 1.0));
        approx::assert_relative_eq!(root.second, -1.0 / 3.0, epsilon = 1e-15);
        approx::assert_relative_eq!(root.third, 1.0 / 3.0, epsilon = 1e-15);
        let one = (sin * sin + cos * cos).jet();
        approx::assert_abs_diff_eq!(one.third, 0.0, epsilon = 1e-15);
    }
}
