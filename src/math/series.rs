//! Truncated power series of the input coordinate, and vectors of them.
//!
//! A quantity of a linkage is known at one position together with its first
//! derivatives: c₀ + c₁t + … with t the change of the input, c_k = f⁽ᵏ⁾/k!.
//! Closed formulas evaluated on series give transfer functions of every order
//! at once, to the precision of the formulas themselves.

use crate::math::chebyshev::Argument;
use crate::math::jet::Jet;
use crate::math::number::{Number, angle, sqrt};
use std::ops::{Add, Mul, Neg, Sub};

/// The first `N` coefficients of a power series, each a number that may carry a derivative of
/// its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Series<const N: usize, T = f64>(pub(crate) [T; N]);

impl<const N: usize, T: Number> Series<N, T> {
    /// A constant, of any kind of number.
    #[inline(always)]
    pub(crate) fn fixed(value: f64) -> Self {
        let mut coefficients = [T::from(0.0); N];
        coefficients[0] = T::from(value);
        Self(coefficients)
    }

    /// The series times a constant.
    #[inline(always)]
    pub(crate) fn scale(mut self, factor: f64) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].scale(factor);
        }
        self
    }

    /// Square of the series.
    #[inline(always)]
    pub(crate) fn square(self) -> Self {
        self * self
    }

    /// Square root; not a number where the value is negative.
    #[inline(always)]
    pub(crate) fn sqrt(self) -> Self {
        let mut root = [T::from(0.0); N];
        root[0] = sqrt(self.0[0]);
        let half = T::from(0.5) / root[0];
        for k in 1..N {
            let mut rest = self.0[k];
            for i in 1..k {
                rest -= root[i] * root[k - i];
            }
            root[k] = rest * half;
        }
        Self(root)
    }

    /// 1 over the series.
    #[inline(always)]
    pub(crate) fn reciprocal(self) -> Self {
        let mut quotient = [T::from(0.0); N];
        let inverse = T::from(1.0) / self.0[0];
        quotient[0] = inverse;
        for k in 1..N {
            let mut rest = T::from(0.0);
            for i in 1..=k {
                rest -= self.0[i] * quotient[k - i];
            }
            quotient[k] = rest * inverse;
        }
        Self(quotient)
    }

    /// Direction of the vector (x, y), in (−π, π] as a value.
    #[inline(always)]
    pub(crate) fn atan2(y: Self, x: Self) -> Self {
        // α′ = (x·y′ − y·x′)/(x² + y²), a quotient of series of one degree less.
        let square = x * x + y * y;
        let mut direction = [T::from(0.0); N];
        let mut slope = [T::from(0.0); N];
        direction[0] = angle(y.0[0], x.0[0]);
        for k in 0..N.saturating_sub(1) {
            let mut rest = T::from(0.0);
            for i in 0..=k {
                let order = (k + 1 - i) as f64;
                rest += (x.0[i] * y.0[k + 1 - i] - y.0[i] * x.0[k + 1 - i]).scale(order);
                if i > 0 {
                    rest -= square.0[i] * slope[k - i];
                }
            }
            slope[k] = rest / square.0[0];
            direction[k + 1] = slope[k] / T::from((k + 1) as f64);
        }
        Self(direction)
    }
}

impl<const N: usize> Series<N> {
    /// A constant.
    #[inline(always)]
    pub(crate) fn constant(value: f64) -> Self {
        Self::fixed(value)
    }

    /// The variable itself, at `value`.
    #[inline(always)]
    pub(crate) fn variable(value: f64) -> Self {
        let mut series = Self::constant(value);
        if N > 1 {
            series.0[1] = 1.0;
        }
        series
    }

    /// sin and cos of `rate`·x at the angle `rate`·x = `angle`.
    #[inline(always)]
    pub(crate) fn sin_cos(angle: f64, rate: f64) -> (Self, Self) {
        let (sin, cos) = angle.sin_cos();
        let (mut s, mut c) = ([0.0; N], [0.0; N]);
        let (mut now, mut power) = ((sin, cos), 1.0);
        for k in 0..N {
            if k > 0 {
                power *= rate / k as f64;
                now = (now.1, -now.0);
            }
            (s[k], c[k]) = (now.0 * power, now.1 * power);
        }
        (Self(s), Self(c))
    }

    /// The value.
    #[inline(always)]
    pub(crate) fn value(&self) -> f64 {
        self.0[0]
    }

    /// True when it is zero everywhere.
    #[inline(always)]
    pub(crate) fn is_zero(&self) -> bool {
        self.0 == [0.0; N]
    }

    /// The series plus a constant.
    #[inline(always)]
    pub(crate) fn shift(mut self, value: f64) -> Self {
        self.0[0] += value;
        self
    }

    /// The series with another value.
    #[inline(always)]
    pub(crate) fn with_value(mut self, value: f64) -> Self {
        self.0[0] = value;
        self
    }

    /// The series plus `rate` times the variable, its value kept.
    #[inline(always)]
    pub(crate) fn tilt(mut self, rate: f64) -> Self {
        if N > 1 {
            self.0[1] += rate;
        }
        self
    }

    /// The first coefficients of a longer series.
    #[inline(always)]
    pub(crate) fn load(stored: &[f64; 4]) -> Self {
        let mut coefficients = [0.0; N];
        coefficients.copy_from_slice(&stored[..N]);
        Self(coefficients)
    }

    /// Puts the coefficients into a longer series.
    #[inline(always)]
    pub(crate) fn store(self, stored: &mut [f64; 4]) {
        stored[..N].copy_from_slice(&self.0);
    }

    /// Value and derivatives; those not known are zero.
    #[inline(always)]
    pub(crate) fn jet(self) -> Jet {
        let at = |k: usize| if k < N { self.0[k] } else { 0.0 };
        Jet {
            value: at(0),
            first: at(1),
            second: 2.0 * at(2),
            third: 6.0 * at(3),
        }
    }
}

impl<const N: usize> Argument for Series<N> {
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::constant(value)
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        self.scale(factor)
    }

    #[inline(always)]
    fn shift(self, value: f64) -> Self {
        self.shift(value)
    }
}

impl<const N: usize, T: Number> Add for Series<N, T> {
    type Output = Self;
    #[inline(always)]
    fn add(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] += other.0[k];
        }
        self
    }
}

impl<const N: usize, T: Number> Sub for Series<N, T> {
    type Output = Self;
    #[inline(always)]
    fn sub(mut self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] -= other.0[k];
        }
        self
    }
}

impl<const N: usize, T: Number> Neg for Series<N, T> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for k in 0..N {
            self.0[k] = -self.0[k];
        }
        self
    }
}

impl<const N: usize, T: Number> Mul for Series<N, T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let mut product = [T::from(0.0); N];
        for k in 0..N {
            for i in 0..=k {
                product[k] += self.0[i] * other.0[k - i];
            }
        }
        Self(product)
    }
}

#[cfg(test)]
mod tests {
    use super::Series;

    #[test]
    fn roots_and_directions_have_their_closed_form_derivatives() {
        let (sin, cos) = Series::<4>::sin_cos(0.6, 2.0);
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

    #[test]
    fn quotients_multiply_back() {
        let (a, b) = (Series([1.0, 2.0, -3.0, 0.5]), Series([4.0, -1.0, 2.0, 3.0]));
        let back = (a * b.reciprocal()) * b;
        for k in 0..4 {
            approx::assert_abs_diff_eq!(back.0[k], a.0[k], epsilon = 1e-15);
        }
    }
}
