//! Interval arithmetic of a number that moves: bounds of its value and of its rate.

use super::evaluate::Scalar;
use super::function::Function;
use super::interval::Interval;
use std::f64::consts::TAU;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Bounds of a value and of its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RateBounds {
    pub(crate) value: Interval,
    pub(crate) rate: Interval,
}

impl RateBounds {
    fn composed(self, value: Interval, slope: Interval) -> Self {
        // What does not change has no rate, however steep the function is.
        let still = self.rate == Interval::of(0.0);
        Self {
            value,
            rate: match still {
                true => self.rate,
                false => slope * self.rate,
            },
        }
    }
}

impl Add for RateBounds {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            rate: self.rate + other.rate,
        }
    }
}

impl Sub for RateBounds {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for RateBounds {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            rate: -self.rate,
        }
    }
}

impl Mul for RateBounds {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            rate: self.value * other.rate + other.value * self.rate,
        }
    }
}

impl Div for RateBounds {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self {
            value,
            rate: (self.rate - value * other.rate) / other.value,
        }
    }
}

impl Scalar for RateBounds {
    fn number(value: f64) -> Self {
        Self {
            value: Interval::of(value),
            rate: Interval::of(0.0),
        }
    }

    fn compared_value(self) -> f64 {
        self.value.middle()
    }

    fn affine(self, factor: f64, shift: f64) -> Self {
        Self {
            value: self.value.scale(factor) + Interval::of(shift),
            rate: self.rate.scale(factor),
        }
    }

    fn of(self, function: Function) -> Self {
        self.composed(self.value.of_function(function), self.value.slope(function))
    }

    fn power(self, exponent: f64) -> Self {
        let slope = self.value.to_power(exponent - 1.0).scale(exponent);
        self.composed(self.value.to_power(exponent), slope)
    }

    /// (A product of what is bounded alike need not be a square.)
    fn squared(self) -> Self {
        Self {
            value: self.value.square(),
            rate: (self.value * self.rate).scale(2.0),
        }
    }

    fn power_of(self, exponent: Self) -> Self {
        let fixed = exponent.value.low;
        if fixed == exponent.value.high && exponent.rate == Interval::of(0.0) {
            return self.power(fixed);
        }
        (self.of(Function::Ln) * exponent).of(Function::Exp)
    }

    fn atan2(y: Self, x: Self) -> Self {
        let square = x.value.square() + y.value.square();
        let rate = (x.value * y.rate - y.value * x.rate) / square;
        let plain = |y: f64, x: f64| y.atan2(x);
        // Monotone along each side of a box that does not hold the cut or the origin.
        let value = match x.value.low > 0.0 || y.value.low > 0.0 || y.value.high < 0.0 {
            true => {
                let corners = [y.value.low, y.value.high]
                    .map(|y| [x.value.low, x.value.high].map(|x| plain(y, x)));
                let all = corners.iter().flatten();
                let low = all.clone().copied().fold(f64::INFINITY, f64::min);
                Interval::between(low, all.copied().fold(f64::NEG_INFINITY, f64::max))
            }
            false => Interval {
                low: -TAU,
                high: TAU,
            },
        };
        Self { value, rate }
    }
}
