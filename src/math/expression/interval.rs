//! Numbers that lie between two bounds, with the rate at which they change.
//!
//! An expression evaluated on them gives bounds of its value and of its rate over a
//! whole stretch of a motion, rounding included: what they exclude does not happen
//! there. (R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to interval
//! analysis, 2009.)

use super::function::Function;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `low` to `high`; NaN where there is none at all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// Roundings that a bound is moved outward by.
const OUTWARD: f64 = 4.0 * f64::EPSILON;

impl Interval {
    const EVERYTHING: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };
    const NOTHING: Self = Self {
        low: f64::NAN,
        high: f64::NAN,
    };

    /// One number.
    pub(crate) fn of(value: f64) -> Self {
        Self {
            low: value,
            high: value,
        }
    }

    /// The numbers between two, in any order, and rounding.
    pub(crate) fn between(a: f64, b: f64) -> Self {
        Self {
            low: a.min(b),
            high: a.max(b),
        }
        .outward()
    }

    fn outward(self) -> Self {
        let own = |end: f64| match end.is_finite() {
            true => OUTWARD * end.abs() + f64::MIN_POSITIVE,
            // (∞ − ∞ is no bound.)
            false => 0.0,
        };
        Self {
            low: self.low - own(self.low),
            high: self.high + own(self.high),
        }
    }

    pub(crate) fn is_nothing(self) -> bool {
        self.low.is_nan() || self.high.is_nan()
    }

    fn holds(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    pub(crate) fn middle(self) -> f64 {
        match (self.low.is_finite(), self.high.is_finite()) {
            (true, true) => 0.5 * self.low + 0.5 * self.high,
            (true, false) => self.low,
            (false, true) => self.high,
            _ if self.is_nothing() => f64::NAN,
            _ => 0.0,
        }
    }

    /// The greatest absolute value; infinite where there is no bound.
    pub(crate) fn magnitude(self) -> f64 {
        match self.is_nothing() {
            true => f64::INFINITY,
            false => self.low.abs().max(self.high.abs()),
        }
    }

    /// What lies in both.
    pub(crate) fn intersection(self, other: Self) -> Self {
        if other.is_nothing() {
            return self;
        }
        Self {
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    pub(crate) fn scale(self, factor: f64) -> Self {
        let product = |x: f64| match factor {
            0.0 => 0.0,
            _ => x * factor,
        };
        Self::between(product(self.low), product(self.high))
    }

    pub(super) fn square(self) -> Self {
        let (a, b) = (self.low * self.low, self.high * self.high);
        match self.holds(0.0) {
            true => Self::between(0.0, a.max(b)).intersection(upper_half()),
            false => Self::between(a, b),
        }
    }

    /// A function that rises, of what lies in its domain.
    fn rising(self, domain: Self, f: impl Fn(f64) -> f64) -> Self {
        let (low, high) = (self.low.max(domain.low), self.high.min(domain.high));
        if self.is_nothing() || !(low <= high) {
            return Self::NOTHING;
        }
        Self::between(f(low), f(high))
    }

    fn cos(self) -> Self {
        if self.is_nothing() {
            return Self::NOTHING;
        }
        if !(self.high - self.low < TAU && self.low.abs() < 1e9 && self.high.abs() < 1e9) {
            return Self {
                low: -1.0,
                high: 1.0,
            };
        }
        let mut found = Self::between(self.low.cos(), self.high.cos());
        // A summit at 2πk, a valley at π + 2πk; a little beside them counts.
        let near = 1e-6;
        let reaches = |place: f64| {
            let turns = ((self.low - near - place) / TAU).ceil();
            place + turns * TAU <= self.high + near
        };
        if reaches(0.0) {
            found.high = 1.0;
        }
        if reaches(PI) {
            found.low = -1.0;
        }
        found
    }

    fn sin(self) -> Self {
        // The constant is rounded too, by more than a small difference is.
        Self {
            low: self.low - FRAC_PI_2 - OUTWARD,
            high: self.high - FRAC_PI_2 + OUTWARD,
        }
        .outward()
        .cos()
    }

    fn tan(self) -> Self {
        if self.is_nothing() {
            return Self::NOTHING;
        }
        let pole = ((self.low - FRAC_PI_2) / PI - 1e-6).ceil();
        if !(self.high - self.low < PI) || FRAC_PI_2 + pole * PI <= self.high + 1e-6 {
            return Self::EVERYTHING;
        }
        Self::between(self.low.tan(), self.high.tan())
    }

    fn cosh(self) -> Self {
        let (a, b) = (self.low.cosh(), self.high.cosh());
        match self.holds(0.0) {
            true => Self::between(1.0, a.max(b)),
            false => Self::between(a, b),
        }
    }

    pub(super) fn of_function(self, function: Function) -> Self {
        let all = Self::EVERYTHING;
        let upward = |low: f64| Self {
            low,
            high: f64::INFINITY,
        };
        let within = Self {
            low: -1.0,
            high: 1.0,
        };
        match function {
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Cosh => self.cosh(),
            Function::Acos => -self.rising(within, |x| -x.acos()),
            Function::Asin | Function::Atanh => self.rising(within, |x| function.value(x)),
            Function::Acosh => self.rising(upward(1.0), |x| function.value(x)),
            Function::Ln | Function::Log10 | Function::Log2 | Function::Sqrt => {
                self.rising(upward(0.0), |x| function.value(x))
            }
            Function::Atan
            | Function::Sinh
            | Function::Tanh
            | Function::Asinh
            | Function::Exp
            | Function::Cbrt => self.rising(all, |x| function.value(x)),
        }
    }

    /// Bounds of the derivative of a function.
    pub(super) fn slope(self, function: Function) -> Self {
        let one = Self::of(1.0);
        let root = |x: Self| x.of_function(Function::Sqrt);
        match function {
            Function::Sin => self.cos(),
            Function::Cos => -self.sin(),
            Function::Tan => one + self.tan().square(),
            Function::Asin => one / root(one - self.square()),
            Function::Acos => -(one / root(one - self.square())),
            Function::Atan => one / (one + self.square()),
            Function::Sinh => self.cosh(),
            Function::Cosh => self.of_function(Function::Sinh),
            Function::Tanh => one / self.of_function(Function::Cosh).square(),
            Function::Asinh => one / root(self.square() + one),
            Function::Acosh => one / root(self.square() - one),
            Function::Atanh => one / (one - self.square()),
            Function::Exp => self.of_function(Function::Exp),
            Function::Ln => one / self.intersection(upper_half()),
            Function::Log10 => {
                (one / self.intersection(upper_half())).scale(std::f64::consts::LOG10_E)
            }
            Function::Log2 => {
                (one / self.intersection(upper_half())).scale(std::f64::consts::LOG2_E)
            }
            Function::Sqrt => Self::of(0.5) / root(self),
            Function::Cbrt => {
                let root = self.of_function(Function::Cbrt);
                one / root.square().scale(3.0)
            }
        }
    }

    /// It to a constant power.
    pub(super) fn to_power(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::of(1.0);
        }
        let f = |x: f64| x.powf(exponent);
        if exponent.fract() != 0.0 {
            let power = match exponent > 0.0 {
                true => self.rising(upper_half(), f),
                false => -self.rising(upper_half(), |x| -f(x)),
            };
            return power;
        }
        if exponent < 0.0 {
            return Self::of(1.0) / self.to_power(-exponent);
        }
        match exponent % 2.0 == 0.0 {
            false => self.rising(Self::EVERYTHING, f),
            true if self.holds(0.0) => {
                Self::between(0.0, f(self.low).max(f(self.high))).intersection(upper_half())
            }
            true => Self::between(f(self.low), f(self.high)),
        }
    }
}

fn upper_half() -> Interval {
    Interval {
        low: 0.0,
        high: f64::INFINITY,
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            low: self.low + other.low,
            high: self.high + other.high,
        }
        .outward()
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
        }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is_nothing() || other.is_nothing() {
            return Self::NOTHING;
        }
        let ends = [self.low, self.high].map(|a| {
            // (0·∞ bounds nothing: a zero that is exact keeps a product at zero.)
            [other.low, other.high].map(|b| if a == 0.0 || b == 0.0 { 0.0 } else { a * b })
        });
        let all = ends.iter().flatten();
        Self {
            low: all.clone().copied().fold(f64::INFINITY, f64::min),
            high: all.copied().fold(f64::NEG_INFINITY, f64::max),
        }
        .outward()
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if self.is_nothing() || other.is_nothing() {
            return Self::NOTHING;
        }
        if other.low > 0.0 || other.high < 0.0 {
            let inverse = Self {
                low: 1.0 / other.high,
                high: 1.0 / other.low,
            };
            return self * inverse;
        }
        // A divisor of one sign that reaches down to zero.
        let inverse = match (other.low, other.high) {
            (0.0, 0.0) => return Self::NOTHING,
            (0.0, high) => Self {
                low: 1.0 / high,
                high: f64::INFINITY,
            },
            (low, 0.0) => Self {
                low: f64::NEG_INFINITY,
                high: 1.0 / low,
            },
            _ => return Self::EVERYTHING,
        };
        self * inverse
    }
}

#[cfg(test)]
mod tests {
    use super::Interval;
    use crate::math::expression::{Expression, RateBounds};

    #[test]
    fn bounds_hold_what_lies_between() {
        for text in [
            "sin(x)*cos(3*x) + tan(x/3)",
            "x^2 - x^3/(2 + x^4) + (x + 4)^-2",
            "sqrt(x + 3)*exp(-x) + ln(x + 4) - cbrt(x)",
            "atan(x) + asinh(x) - tanh(x)*cosh(x)/3 + sinh(x)",
            "asin(x/5) + acos(x/5) + atanh(x/5)*acosh(x + 4)",
            "(x + 3)^1.7 + 2^x + atan2(x, x + 3) + log10(x + 3)*log2(x + 4)",
            "(x + 3)^x",
        ] {
            let expression = Expression::new(text, &["x"]).unwrap();
            let code = &expression.program().value;
            for (low, high) in [(-2.1, -2.0), (-1.0, 1.5), (0.3, 0.31), (1.0, 1.9)] {
                let x = RateBounds {
                    value: Interval { low, high },
                    rate: Interval::of(1.0),
                };
                let found = code.evaluate(&[x], &|_| crate::math::expression::OPEN);
                for k in 0..=50 {
                    let x = low + (high - low) * f64::from(k) / 50.0;
                    let dual = crate::math::number::Dual::new(x, 1.0);
                    let exact = code.evaluate(&[dual], &|_| crate::math::expression::OPEN);
                    let holds = |one: Interval, value: f64| {
                        one.is_nothing() || one.low <= value && value <= one.high
                    };
                    assert!(holds(found.value, exact.value), "{text} {x} {found:?}");
                    assert!(holds(found.rate, exact.derivative), "{text} {x} {found:?}");
                }
            }
        }
    }

    #[test]
    fn a_product_of_what_is_bounded_alike_is_no_square() {
        let expression = Expression::new("sin(x)*cos(x)", &["x"]).unwrap();
        let x = RateBounds {
            value: Interval::between(-4.0, 4.0),
            rate: Interval::of(1.0),
        };
        let code = &expression.program().value;
        let found = code.evaluate(&[x], &|_| crate::math::expression::OPEN);
        assert!(
            found.value.low <= -0.5 && found.value.high >= 0.5,
            "{found:?}"
        );
    }

    #[test]
    fn bounds_of_little_are_close() {
        let expression = Expression::new("sin(x)*x^3 + exp(x)", &["x"]).unwrap();
        let x = RateBounds {
            value: Interval::between(0.7, 0.7 + 1e-6),
            rate: Interval::of(1.0),
        };
        let found = expression
            .program()
            .value
            .evaluate(&[x], &|_| crate::math::expression::OPEN);
        assert!(found.value.high - found.value.low < 1e-5);
        assert!(found.rate.high - found.rate.low < 1e-4);
    }
}
