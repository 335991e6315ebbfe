//! A value with its derivatives along several directions at once.

use super::{Number, chain};
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A value and its derivatives along K directions: what the value costs is paid
/// once, and the derivatives stand side by side for the processor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duals<const K: usize> {
    /// The value.
    pub value: f64,
    /// The derivatives of the value along the chosen directions.
    pub derivatives: [f64; K],
}

impl<const K: usize> Duals<K> {
    /// A number with this value and each derivative, `k` of K, replaced by a function of
    /// it.
    #[inline(always)]
    fn with(value: f64, derivative: impl Fn(usize) -> f64) -> Self {
        let mut derivatives = [0.0; K];
        for (k, out) in derivatives.iter_mut().enumerate() {
            *out = derivative(k);
        }
        Self { value, derivatives }
    }
}

impl<const K: usize> From<f64> for Duals<K> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self {
            value,
            derivatives: [0.0; K],
        }
    }
}

impl<const K: usize> Number for Duals<K> {
    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn compose(self, value: f64, derivative: f64) -> Self {
        match derivative.is_finite() {
            true => Self::with(value, |k| derivative * self.derivatives[k]),
            false => Self::with(value, |k| chain(derivative, self.derivatives[k])),
        }
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        Self::with(self.value * factor, |k| self.derivatives[k] * factor)
    }
}

impl<const K: usize> Add for Duals<K> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::with(self.value + other.value, |k| {
            self.derivatives[k] + other.derivatives[k]
        })
    }
}

impl<const K: usize> Sub for Duals<K> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::with(self.value - other.value, |k| {
            self.derivatives[k] - other.derivatives[k]
        })
    }
}

impl<const K: usize> Mul for Duals<K> {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl)] // the rule of products is a sum
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::with(self.value * other.value, |k| {
            self.derivatives[k] * other.value + self.value * other.derivatives[k]
        })
    }
}

impl<const K: usize> Div for Duals<K> {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl)] // the rule of quotients
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let (value, inverse) = (self.value / other.value, 1.0 / other.value);
        Self::with(value, |k| {
            (self.derivatives[k] - value * other.derivatives[k]) * inverse
        })
    }
}

impl<const K: usize> Neg for Duals<K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::with(-self.value, |k| -self.derivatives[k])
    }
}

impl<const K: usize> AddAssign for Duals<K> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const K: usize> SubAssign for Duals<K> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::number::Dual;

    /// Every lane is what a number with one derivative gives.
    #[test]
    fn lanes_agree_with_single_derivatives() {
        fn formula<N: Number>(x: N, y: N) -> N {
            let mut z = (x * y - y.scale(2.5)) / (x * x + N::from(1.5));
            z += x.compose(x.value().sin(), x.value().cos());
            z -= -y;
            z
        }
        let (x, y, dx, dy) = (0.7, -1.3, [1.0, 0.0, -0.4], [0.0, 2.0, 0.9]);
        let together = formula(
            Duals::<3>::with(x, |k| dx[k]),
            Duals::<3>::with(y, |k| dy[k]),
        );
        for k in 0..3 {
            let alone = formula(Dual::new(x, dx[k]), Dual::new(y, dy[k]));
            approx::assert_relative_eq!(together.value, alone.value, max_relative = 1e-15);
            let derivative = together.derivatives[k];
            approx::assert_relative_eq!(derivative, alone.derivative, max_relative = 1e-14);
        }
    }
}
