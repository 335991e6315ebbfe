//! Interval arithmetic of Taylor coefficients.
//!
//! The coefficients c_k = f⁽ᵏ⁾/k! of a function at every place of a stretch are
//! enclosed at once. The last of them bounds by how much the function differs
//! anywhere on the stretch from a polynomial of lower degree: what samples do not
//! show, this does. (R. E. Moore, R. B. Kearfott, M. J. Cloud, Introduction to
//! interval analysis, 2009, chapter 9.)

use super::evaluate::Scalar;
use super::function::Function;
use super::interval::Interval;
use std::array::from_fn;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Whole powers up to here of what may be zero are multiplied out.
const GREATEST_POWER: f64 = 9e15;

/// Bounds of the first `N` Taylor coefficients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TaylorBounds<const N: usize>(pub(crate) [Interval; N]);

impl<const N: usize> TaylorBounds<N> {
    /// The variable itself between two places.
    pub(crate) fn variable(from: f64, to: f64) -> Self {
        let mut all = [Interval::of(0.0); N];
        all[0] = Interval::between(from, to);
        if N > 1 {
            all[1] = Interval::of(1.0);
        }
        Self(all)
    }

    fn constant(value: Interval) -> Self {
        let mut all = [Interval::of(0.0); N];
        all[0] = value;
        Self(all)
    }

    fn scale(self, factor: f64) -> Self {
        Self(self.0.map(|c| c.scale(factor)))
    }

    fn shift(mut self, by: f64) -> Self {
        self.0[0] = self.0[0] + Interval::of(by);
        self
    }

    /// What does not change stays so, however steep a function of it is.
    fn is_still(&self) -> bool {
        self.0[1..].iter().all(|c| *c == Interval::of(0.0))
    }

    /// Coefficient `k` of the integral of x′·g, x this and g known below `k`.
    fn integral_coefficient(&self, g: &[Interval; N], k: usize) -> Interval {
        let each = (1..=k).map(|i| self.0[i].scale(i as f64) * g[k - i]);
        sum(each).scale(1.0 / k as f64)
    }

    /// A function with the value `value` and the slope `slope` over this.
    fn integrated(self, value: Interval, slope: Self) -> Self {
        let mut all = [value; N];
        for k in 1..N {
            all[k] = self.integral_coefficient(&slope.0, k);
        }
        Self(all)
    }

    /// Two functions with the slopes of which each is the other times a factor.
    fn circular(self, [f, g]: [Function; 2], [by_g, by_f]: [f64; 2]) -> [Self; 2] {
        let [mut one, mut other] = [f, g].map(|own| [self.0[0].of_function(own); N]);
        for k in 1..N {
            let [a, b] = [&other, &one].map(|own| self.integral_coefficient(own, k));
            (one[k], other[k]) = (a.scale(by_g), b.scale(by_f));
        }
        [Self(one), Self(other)]
    }

    fn exp(self) -> Self {
        let mut all = [self.0[0].of_function(Function::Exp); N];
        for k in 1..N {
            all[k] = self.integral_coefficient(&all, k);
        }
        Self(all)
    }

    /// tan, whose slope is 1 + tan².
    fn tan(self) -> Self {
        let mut all = [self.0[0].of_function(Function::Tan); N];
        let mut slope = [self.0[0].slope(Function::Tan); N];
        for k in 1..N {
            all[k] = self.integral_coefficient(&slope, k);
            slope[k] = product(&all, &all, k);
        }
        Self(all)
    }

    /// tanh: its slope s = 1/cosh² has the slope −2·s·tanh, which keeps its digits where
    /// tanh is 1 within rounding.
    fn tanh(self) -> Self {
        let mut all = [self.0[0].of_function(Function::Tanh); N];
        let mut slope = [self.0[0].slope(Function::Tanh); N];
        let mut both = [all[0] * slope[0]; N];
        for k in 1..N {
            all[k] = self.integral_coefficient(&slope, k);
            slope[k] = self.integral_coefficient(&both, k).scale(-2.0);
            both[k] = product(&all, &slope, k);
        }
        Self(all)
    }

    /// A power p of it with a known value: x·p′ = exponent·p·x′.
    fn power_with(self, value: Interval, exponent: f64) -> Self {
        let mut all = [value; N];
        for k in 1..N {
            let each = (1..=k).map(|i| {
                let factor = exponent * i as f64 - (k - i) as f64;
                self.0[i].scale(factor) * all[k - i]
            });
            all[k] = sum(each) / self.0[0].scale(k as f64);
        }
        Self(all)
    }

    /// A whole power, multiplied out.
    fn multiplied_out(self, exponent: u64) -> Self {
        let (mut found, mut square, mut rest) = (Self::number(1.0), self, exponent);
        while rest > 0 {
            if rest % 2 == 1 {
                found = found * square;
            }
            rest /= 2;
            if rest > 0 {
                square = square * square;
            }
        }
        found
    }

    /// 1/√(sign·x² + shift).
    fn over_root(self, sign: f64, shift: f64) -> Self {
        (self * self).affine(sign, shift).power(-0.5)
    }
}

fn sum(each: impl Iterator<Item = Interval>) -> Interval {
    each.reduce(Add::add).unwrap_or(Interval::of(0.0))
}

/// Coefficient `k` of a product.
fn product<const N: usize>(a: &[Interval; N], b: &[Interval; N], k: usize) -> Interval {
    sum((0..=k).map(|i| a[i] * b[k - i]))
}

impl<const N: usize> Add for TaylorBounds<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<const N: usize> Sub for TaylorBounds<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<const N: usize> Neg for TaylorBounds<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl<const N: usize> Mul for TaylorBounds<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if other.is_still() {
            return Self(self.0.map(|c| c * other.0[0]));
        }
        if self.is_still() {
            return Self(other.0.map(|c| c * self.0[0]));
        }
        let mut all = from_fn(|k| product(&self.0, &other.0, k));
        // A square, which dependence would widen.
        if self == other {
            all[0] = self.0[0].square();
        }
        Self(all)
    }
}

impl<const N: usize> Div for TaylorBounds<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.is_still() {
            return Self(self.0.map(|c| c / other.0[0]));
        }
        let mut all = [self.0[0] / other.0[0]; N];
        for k in 1..N {
            let known = sum((1..=k).map(|i| other.0[i] * all[k - i]));
            all[k] = (self.0[k] - known) / other.0[0];
        }
        Self(all)
    }
}

impl<const N: usize> Scalar for TaylorBounds<N> {
    fn number(value: f64) -> Self {
        Self::constant(Interval::of(value))
    }

    fn compared_value(self) -> f64 {
        self.0[0].middle()
    }

    fn affine(self, factor: f64, shift: f64) -> Self {
        self.scale(factor).shift(shift)
    }

    fn of(self, function: Function) -> Self {
        let value = self.0[0].of_function(function);
        if self.is_still() {
            return Self::constant(value);
        }
        let by = |slope: Self| self.integrated(value, slope);
        match function {
            Function::Sin => self.circular([Function::Sin, Function::Cos], [1.0, -1.0])[0],
            Function::Cos => self.circular([Function::Sin, Function::Cos], [1.0, -1.0])[1],
            Function::Sinh => self.circular([Function::Sinh, Function::Cosh], [1.0, 1.0])[0],
            Function::Cosh => self.circular([Function::Sinh, Function::Cosh], [1.0, 1.0])[1],
            Function::Exp => self.exp(),
            Function::Tan => self.tan(),
            Function::Tanh => self.tanh(),
            Function::Asin => by(self.over_root(-1.0, 1.0)),
            Function::Acos => by(-self.over_root(-1.0, 1.0)),
            Function::Asinh => by(self.over_root(1.0, 1.0)),
            Function::Acosh => by(self.over_root(1.0, -1.0)),
            Function::Atan => by(Self::number(1.0) / (self * self).shift(1.0)),
            Function::Atanh => by(Self::number(1.0) / (self * self).affine(-1.0, 1.0)),
            Function::Ln | Function::Log10 | Function::Log2 => {
                let factor = match function {
                    Function::Log10 => std::f64::consts::LOG10_E,
                    Function::Log2 => std::f64::consts::LOG2_E,
                    _ => 1.0,
                };
                by(Self::number(factor) / self)
            }
            Function::Sqrt => self.power_with(value, 0.5),
            Function::Cbrt => self.power_with(value, 1.0 / 3.0),
        }
    }

    fn power(self, exponent: f64) -> Self {
        let value = self.0[0].to_power(exponent);
        let whole = exponent.fract() == 0.0 && exponent.abs() < GREATEST_POWER;
        let may_vanish = !(self.0[0].low > 0.0 || self.0[0].high < 0.0);
        if self.is_still() {
            return Self::constant(value);
        }
        match whole && (exponent.abs() < 4.0 || may_vanish) {
            true if exponent < 0.0 => Self::number(1.0) / self.power(-exponent),
            true => {
                let mut power = self.multiplied_out(exponent as u64);
                power.0[0] = value;
                power
            }
            false => self.power_with(value, exponent),
        }
    }

    fn power_of(self, exponent: Self) -> Self {
        let fixed = exponent.0[0].low;
        if fixed == exponent.0[0].high && exponent.is_still() {
            return self.power(fixed);
        }
        (self.of(Function::Ln) * exponent).exp()
    }

    fn atan2(y: Self, x: Self) -> Self {
        // α′ = (x·y′ − y·x′)/(x² + y²); only the value depends on the quadrant.
        let square = x * x + y * y;
        let turned = std::f64::consts::TAU;
        let mut all = [Interval::between(-turned, turned); N];
        let mut slope = [Interval::of(0.0); N];
        for k in 0..N.saturating_sub(1) {
            let each = (0..=k).map(|i| {
                let order = (k + 1 - i) as f64;
                (x.0[i] * y.0[k + 1 - i] - y.0[i] * x.0[k + 1 - i]).scale(order)
            });
            let known = sum((1..=k).map(|i| square.0[i] * slope[k - i]));
            slope[k] = (sum(each) - known) / square.0[0];
            all[k + 1] = slope[k].scale(1.0 / (k + 1) as f64);
        }
        Self(all)
    }
}

#[cfg(test)]
mod tests {
    use super::TaylorBounds;
    use crate::math::expression::{Expression, OPEN, Third};

    fn enclosed<const N: usize>(text: &str, from: f64, to: f64) -> TaylorBounds<N> {
        let expression = Expression::new(text, &["x"]).unwrap();
        let x = TaylorBounds::variable(from, to);
        expression.program().value.evaluate(&[x], &|_| OPEN)
    }

    #[test]
    fn coefficients_hold_what_lies_between() {
        for text in [
            "sin(x)*cos(3*x) + tan(x/3)",
            "x^2 - x^3/(2 + x^4) + (x + 4)^-2 + x^9",
            "sqrt(x + 3)*exp(-x) + ln(x + 4) - cbrt(x - 3)",
            "atan(x) + asinh(x) - tanh(x)*cosh(x)/3 + sinh(x)",
            "asin(x/5) + acos(x/5) + atanh(x/5)*acosh(x + 4)",
            "(x + 3)^1.7 + 2^x + log10(x + 3)*log2(x + 4)",
            "(x + 3)^x + atan2(x, x + 3)",
        ] {
            let expression = Expression::new(text, &["x"]).unwrap();
            let code = &expression.program().value;
            for (low, high) in [(-2.1, -2.0), (0.3, 0.31), (1.0, 1.4)] {
                let found: TaylorBounds<4> = enclosed(text, low, high);
                for k in 0..=20 {
                    let x = low + (high - low) * f64::from(k) / 20.0;
                    let jet = code.evaluate(&[Third::variable(x)], &|_| OPEN).0;
                    let wanted = [jet.value, jet.first, 0.5 * jet.second, jet.third / 6.0];
                    for (own, wanted) in found.0.iter().zip(wanted) {
                        let slack = 1e-12 * wanted.abs();
                        let holds = own.low <= wanted + slack && wanted - slack <= own.high;
                        assert!(holds, "{text} at {x}: {wanted} in {found:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn high_coefficients_of_little_are_close_to_those_in_closed_form() {
        // Of exp(2x) 2ᵏ·eˣ²/k!, of 1/(1 − x) all 1/(1 − x)ᵏ⁺¹, of cos⁴⁰⁰⁰ at 0 −2000 x².
        let found: TaylorBounds<10> = enclosed("exp(2*x)", 0.5, 0.5);
        let wanted = 2f64.powi(9) * 1f64.exp() / 362_880.0;
        assert!((found.0[9].middle() / wanted - 1.0).abs() < 1e-12);
        let found: TaylorBounds<10> = enclosed("1/(1 - x)", 0.5, 0.5);
        assert!((found.0[9].middle() / 1024.0 - 1.0).abs() < 1e-12);
        let found: TaylorBounds<3> = enclosed("cos(x)^4000", 0.0, 0.0);
        assert!((found.0[2].middle() / -2000.0 - 1.0).abs() < 1e-10);
    }

    #[test]
    fn steps_that_are_past_leave_nothing() {
        let found: TaylorBounds<10> = enclosed("tanh((x - 3)/1e-5)", 0.0, 2.5);
        assert!(found.0[9].high.abs() < 1e-200 && found.0[9].low.abs() < 1e-200);
    }
}
