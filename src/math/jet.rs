//! A function of one variable at a point: its value and first three derivatives.

use crate::math::number::Number;

/// Jumps of a derivative below this share of its greatest value are rounding.
pub(crate) const JUMP_ROUNDING: f64 = 1e-9;

/// Value and first three derivatives of a function of one variable at a point.
///
/// For a position function U(φ): `value` = U, `first` = U′, `second` = U″,
/// `third` = U‴ (the geometric transfer functions). For a motion over time:
/// displacement, speed, acceleration, jerk.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// The value.
    pub value: f64,
    /// The first derivative.
    pub first: f64,
    /// The second derivative.
    pub second: f64,
    /// The third derivative.
    pub third: f64,
}

impl Jet {
    /// Jet of what has no value.
    pub(crate) const UNKNOWN: Self = Self {
        value: f64::NAN,
        first: f64::NAN,
        second: f64::NAN,
        third: f64::NAN,
    };

    /// The function's value, first and second derivative as numbers that carry
    /// the derivative of the argument `x` on.
    #[inline(always)]
    pub fn lift<N: Number>(self, x: N) -> [N; 3] {
        [
            x.compose(self.value, self.first),
            x.compose(self.first, self.second),
            x.compose(self.second, self.third),
        ]
    }

    /// Jet of the function times a constant.
    #[must_use]
    #[inline(always)]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            first: self.first * factor,
            second: self.second * factor,
            third: self.third * factor,
        }
    }

    /// Derivatives of f(x(t)) from those of f at x, in `self`, and of x at t.
    #[must_use]
    pub fn composed_with(self, x: Self) -> Self {
        Self {
            value: self.value,
            first: self.first * x.first,
            second: self.second * x.first * x.first + self.first * x.second,
            third: self.third * x.first.powi(3)
                + 3.0 * self.second * x.first * x.second
                + self.first * x.third,
        }
    }

    /// True when all four numbers are finite.
    pub fn is_finite(&self) -> bool {
        [self.value, self.first, self.second, self.third]
            .iter()
            .all(|number| number.is_finite())
    }
}
