//! Values with their first three derivatives.

use super::evaluate::Scalar;
use super::function::Function;
use crate::math::jet::Jet;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value with its first three derivatives by one variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Third(pub(crate) Jet);

impl Third {
    /// The variable itself.
    pub(crate) fn variable(value: f64) -> Self {
        Self(Jet {
            value,
            first: 1.0,
            ..Jet::default()
        })
    }

    fn map2(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self.0, other.0);
        Self(Jet {
            value: f(a.value, b.value),
            first: f(a.first, b.first),
            second: f(a.second, b.second),
            third: f(a.third, b.third),
        })
    }

    /// f of it, for a function given by its derivatives at the value.
    fn composed(self, [value, f1, f2, f3]: [f64; 4]) -> Self {
        let x = self.0;
        // (What does not change keeps no derivative, however steep f is.)
        if x.first == 0.0 && x.second == 0.0 && x.third == 0.0 {
            return Self::number(value);
        }
        Self(Jet {
            value,
            first: f1 * x.first,
            second: f2 * x.first * x.first + f1 * x.second,
            third: f3 * x.first * x.first * x.first + 3.0 * f2 * x.first * x.second + f1 * x.third,
        })
    }
}

impl Add for Third {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.map2(other, |a, b| a + b)
    }
}

impl Sub for Third {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.map2(other, |a, b| a - b)
    }
}

impl Neg for Third {
    type Output = Self;
    fn neg(self) -> Self {
        self.affine(-1.0, 0.0)
    }
}

impl Mul for Third {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self(Jet {
            value: a.value * b.value,
            first: a.first * b.value + a.value * b.first,
            second: a.second * b.value + 2.0 * a.first * b.first + a.value * b.second,
            third: a.third * b.value
                + 3.0 * (a.second * b.first + a.first * b.second)
                + a.value * b.third,
        })
    }
}

impl Div for Third {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.0.value;
        let square = inverse * inverse;
        let reciprocal = other.composed([
            inverse,
            -square,
            2.0 * square * inverse,
            -6.0 * square * square,
        ]);
        let mut quotient = self * reciprocal;
        quotient.0.value = self.0.value / other.0.value;
        quotient
    }
}

impl Scalar for Third {
    fn number(value: f64) -> Self {
        Self(Jet {
            value,
            ..Jet::default()
        })
    }

    fn compared_value(self) -> f64 {
        self.0.value
    }

    fn affine(self, factor: f64, shift: f64) -> Self {
        let mut scaled = self.0.scaled(factor);
        scaled.value += shift;
        Self(scaled)
    }

    fn of(self, function: Function) -> Self {
        self.composed(derivatives(function, self.0.value))
    }

    fn power(self, exponent: f64) -> Self {
        let x = self.0.value;
        let (a, b, c) = (exponent, exponent - 1.0, exponent - 2.0);
        // (What has been differentiated away is zero, also at x = 0.)
        let term = |factor: f64, order: f64| match factor {
            0.0 => 0.0,
            _ => factor * x.powf(exponent - order),
        };
        self.composed([
            x.powf(a),
            term(a, 1.0),
            term(a * b, 2.0),
            term(a * b * c, 3.0),
        ])
    }

    fn power_of(self, exponent: Self) -> Self {
        let value = self.0.value.powf(exponent.0.value);
        let mut power = (self.of(Function::Ln) * exponent).of(Function::Exp);
        power.0.value = value;
        power
    }

    fn atan2(y: Self, x: Self) -> Self {
        let (v, u) = (y.0.value, x.0.value);
        let across = y.affine(u, 0.0) - x.affine(v, 0.0);
        let along = x.affine(u, 0.0) + y.affine(v, 0.0);
        (across / along).of(Function::Atan).affine(1.0, v.atan2(u))
    }
}

/// A function with its first three derivatives.
fn derivatives(function: Function, x: f64) -> [f64; 4] {
    let y = function.value(x);
    let root = |square: f64| 1.0 / square.sqrt();
    match function {
        Function::Sin => [y, x.cos(), -y, -x.cos()],
        Function::Cos => [y, -x.sin(), -y, x.sin()],
        Function::Tan => {
            let d = 1.0 + y * y;
            [y, d, 2.0 * y * d, 2.0 * d * (1.0 + 3.0 * y * y)]
        }
        Function::Asin | Function::Acos => {
            let sign = if function == Function::Asin {
                1.0
            } else {
                -1.0
            };
            let r = root(1.0 - x * x);
            let cube = r * r * r;
            let third = cube + 3.0 * x * x * cube * r * r;
            [y, sign * r, sign * x * cube, sign * third]
        }
        Function::Atan => {
            let d = 1.0 / (1.0 + x * x);
            [y, d, -2.0 * x * d * d, (6.0 * x * x - 2.0) * d * d * d]
        }
        Function::Sinh => [y, x.cosh(), y, x.cosh()],
        Function::Cosh => [y, x.sinh(), y, x.sinh()],
        Function::Tanh => {
            let d = x.cosh().recip().powi(2);
            [y, d, -2.0 * y * d, d * (6.0 * y * y - 2.0)]
        }
        Function::Asinh => {
            let r = root(1.0 + x * x);
            let cube = r * r * r;
            [y, r, -x * cube, -cube + 3.0 * x * x * cube * r * r]
        }
        Function::Acosh => {
            let r = root(x * x - 1.0);
            let cube = r * r * r;
            [y, r, -x * cube, -cube + 3.0 * x * x * cube * r * r]
        }
        Function::Atanh => {
            let d = 1.0 / (1.0 - x * x);
            [y, d, 2.0 * x * d * d, (2.0 + 6.0 * x * x) * d * d * d]
        }
        Function::Exp => [y; 4],
        Function::Ln | Function::Log10 | Function::Log2 => {
            let factor = match function {
                Function::Log10 => std::f64::consts::LOG10_E,
                Function::Log2 => std::f64::consts::LOG2_E,
                _ => 1.0,
            };
            let r = 1.0 / x;
            [y, factor * r, -factor * r * r, 2.0 * factor * r * r * r]
        }
        Function::Sqrt => {
            let r = 1.0 / y;
            let cube = r * r * r;
            [y, 0.5 * r, -0.25 * cube, 0.375 * cube * r * r]
        }
        Function::Cbrt => {
            let r = 1.0 / y;
            let square = r * r;
            let fifth = square * square * r;
            [
                y,
                square / 3.0,
                -2.0 / 9.0 * fifth,
                10.0 / 27.0 * fifth * r * square,
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::{Expression, OPEN, SeriesProgram};

    #[test]
    fn derivatives_agree_with_the_series() {
        for text in [
            "sin(x)*cos(2*x) + tan(x/2) - tanh(x)",
            "asin(x/3) + acos(x/4) + atan(x) + asinh(x) + acosh(x + 2) + atanh(x/5)",
            "exp(-x)*ln(x + 2) + log10(x + 1) - log2(x + 3)",
            "sqrt(x + 1) + cbrt(x + 2) + (x + 1)^2.3 + (1 + x)^x + x^-3 + 3^x",
            "sinh(x) - cosh(x)/2 + atan2(x, 2 - x) + x^2/(1 + x)",
        ] {
            let expression = Expression::new(text, &["x"]).unwrap();
            let jet = expression
                .program()
                .value
                .evaluate(&[Third::variable(0.65)], &|_| OPEN)
                .0;
            let mut ordered = SeriesProgram::<4>::new(expression.program());
            let series: [f64; 4] = std::array::from_fn(|order| {
                ordered.extend(order, |_| [0.65, 1.0, 0.0, 0.0][order], &|_| OPEN)
            });
            let own = [jet.value, jet.first, jet.second / 2.0, jet.third / 6.0];
            for (own, wanted) in own.iter().zip(series) {
                approx::assert_relative_eq!(*own, wanted, max_relative = 1e-12);
            }
        }
    }
}
