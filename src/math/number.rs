//! Numbers that may carry a derivative.
//!
//! The equations of motion are written once, for any [`Number`]. Evaluated on
//! `f64` they give the motion; evaluated on [`Dual`] they give, exactly and in
//! the same pass, its change along a direction: the analytic Jacobian that
//! implicit methods need, which therefore cannot drift from the equations.

mod duals;

pub use duals::Duals;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A real number, with or without a derivative along one direction.
///
/// Comparisons look at the value alone: which side of a kink a number lies on
/// does not depend on its derivative.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + From<f64>
{
    /// The number without its derivative.
    fn value(self) -> f64;

    /// `f(self)` for a function whose value and derivative at `self.value()`
    /// are given (the chain rule).
    fn compose(self, value: f64, derivative: f64) -> Self;

    /// `self` times a constant.
    fn scale(self, factor: f64) -> Self;

    /// True for a zero without any derivative; false where that is not looked at.
    #[inline(always)]
    fn vanishes(self) -> bool {
        false
    }
}

impl Number for f64 {
    #[inline(always)]
    fn value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn compose(self, value: f64, _derivative: f64) -> Self {
        value
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn vanishes(self) -> bool {
        self == 0.0
    }
}

/// A value and its derivative along one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// The derivative of the value along the chosen direction.
    pub derivative: f64,
}

impl Dual {
    /// A value with its derivative.
    pub fn new(value: f64, derivative: f64) -> Self {
        Self { value, derivative }
    }
}

/// The derivative of a function times that of its argument: what does not change keeps no
/// derivative, however steep the function is.
#[inline(always)]
pub(crate) fn chain(of_function: f64, of_argument: f64) -> f64 {
    match of_function.is_finite() || of_argument != 0.0 {
        true => of_function * of_argument,
        false => 0.0,
    }
}

impl From<f64> for Dual {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self::new(value, 0.0)
    }
}

impl Number for Dual {
    #[inline(always)]
    fn value(self) -> f64 {
        self.value
    }

    #[inline(always)]
    fn compose(self, value: f64, derivative: f64) -> Self {
        Self::new(value, chain(derivative, self.derivative))
    }

    #[inline(always)]
    fn scale(self, factor: f64) -> Self {
        Self::new(self.value * factor, self.derivative * factor)
    }
}

impl Add for Dual {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.derivative + other.derivative)
    }
}

impl Sub for Dual {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.derivative - other.derivative)
    }
}

impl Mul for Dual {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.value * other.value,
            self.derivative * other.value + self.value * other.derivative,
        )
    }
}

impl Div for Dual {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self::new(
            value,
            (self.derivative - value * other.derivative) / other.value,
        )
    }
}

impl Neg for Dual {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.value, -self.derivative)
    }
}

impl AddAssign for Dual {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dual {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

/// Below this numbers have lost digits, and count as zero.
pub(crate) const NOTHING: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// √x.
pub(crate) fn sqrt<N: Number>(x: N) -> N {
    let root = x.value().sqrt();
    x.compose(root, 0.5 / root)
}

/// Direction of the vector (x, y), in (−π, π] as a value.
#[inline(always)]
pub(crate) fn angle<N: Number>(y: N, x: N) -> N {
    let (a, b) = (x.value(), y.value());
    // (As a value y·a − x·b is zero.)
    N::from(b.atan2(a)) + (y.scale(a) - x.scale(b)).scale((a * a + b * b).recip())
}

/// arctan x.
pub(crate) fn atan<N: Number>(x: N) -> N {
    let value = x.value();
    x.compose(value.atan(), 1.0 / (1.0 + value * value))
}

#[cfg(test)]
mod tests {
    use super::{Dual, Number};

    #[test]
    fn derivatives_follow_the_rules_of_calculus() {
        let x = Dual::new(1.7, 1.0);
        let y = (x * x - Dual::from(2.0)) / (x + Dual::from(1.0));
        let (value, slope) = ((1.7 * 1.7 - 2.0) / 2.7, {
            (2.0 * 1.7 * 2.7 - (1.7 * 1.7 - 2.0)) / (2.7 * 2.7)
        });
        approx::assert_relative_eq!(y.value, value, max_relative = 1e-15);
        approx::assert_relative_eq!(y.derivative, slope, max_relative = 1e-14);
        let sine = x.compose(1.7f64.sin(), 1.7f64.cos());
        assert_eq!((-sine).scale(2.0).derivative, -2.0 * 1.7f64.cos());
    }
}
