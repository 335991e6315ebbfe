//! Evaluation of a program on any kind of number.

use super::function::Function;
use super::program::{Code, OPEN, Op, Register, Rounding, UNGUARDED};
use crate::math::number::{Dual, Duals, Number};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number that an expression can be evaluated on.
pub(crate) trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A constant.
    fn number(value: f64) -> Self;

    /// Its value, by which it is compared.
    fn compared_value(self) -> f64;

    /// factor·x + shift.
    fn affine(self, factor: f64, shift: f64) -> Self;

    /// A function of it.
    fn of(self, function: Function) -> Self;

    /// It to a constant power.
    fn power(self, exponent: f64) -> Self;

    /// It times itself.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }

    /// It to the power of another.
    fn power_of(self, exponent: Self) -> Self;

    /// The direction of (x, y), in (−π, π].
    fn atan2(y: Self, x: Self) -> Self;
}

impl Scalar for f64 {
    #[inline(always)]
    fn number(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn compared_value(self) -> f64 {
        self
    }

    #[inline(always)]
    fn affine(self, factor: f64, shift: f64) -> Self {
        factor * self + shift
    }

    #[inline(always)]
    fn of(self, function: Function) -> Self {
        function.value(self)
    }

    #[inline(always)]
    fn power(self, exponent: f64) -> Self {
        self.powf(exponent)
    }

    #[inline(always)]
    fn power_of(self, exponent: Self) -> Self {
        self.powf(exponent)
    }

    #[inline(always)]
    fn atan2(y: Self, x: Self) -> Self {
        y.atan2(x)
    }
}

/// What a number that knows the chain rule does.
macro_rules! by_chain_rule {
    () => {
        #[inline(always)]
        fn number(value: f64) -> Self {
            Self::from(value)
        }

        #[inline(always)]
        fn compared_value(self) -> f64 {
            self.value()
        }

        #[inline(always)]
        fn affine(self, factor: f64, shift: f64) -> Self {
            self.scale(factor) + Self::from(shift)
        }

        #[inline(always)]
        fn of(self, function: Function) -> Self {
            let (value, slope) = function.with_slope(self.value());
            self.compose(value, slope)
        }

        #[inline(always)]
        fn power(self, exponent: f64) -> Self {
            let (value, slope) = power(self.value(), exponent);
            self.compose(value, slope)
        }

        #[inline(always)]
        fn power_of(self, exponent: Self) -> Self {
            let (x, y) = (self.value(), exponent.value());
            let (value, by_base) = power(x, y);
            // Where only the exponent is a whole constant, x may be negative.
            let by_exponent = match x > 0.0 {
                true => value * x.ln(),
                false => 0.0,
            };
            let by_base = self.compose(value, by_base);
            by_base + exponent.compose(0.0, by_exponent)
        }

        #[inline(always)]
        fn atan2(y: Self, x: Self) -> Self {
            let (v, u) = (y.value(), x.value());
            let square = u * u + v * v;
            y.compose(v.atan2(u), u / square) + x.compose(0.0, -v / square)
        }
    };
}

impl Scalar for Dual {
    by_chain_rule!();
}

impl<const K: usize> Scalar for Duals<K> {
    by_chain_rule!();
}

/// A power and its slope.
fn power(x: f64, exponent: f64) -> (f64, f64) {
    (x.powf(exponent), exponent * x.powf(exponent - 1.0))
}

impl Code {
    /// The value; of an operation with a guard by the mode that `modes` gives, or by
    /// its operands where that is [`OPEN`].
    pub(crate) fn evaluate<N: Scalar>(&self, values: &[N], modes: &impl Fn(u16) -> i64) -> N {
        match self.0.len() {
            0..=8 => self.evaluate_in::<N, 8>(values, modes),
            9..=32 => self.evaluate_in::<N, 32>(values, modes),
            33..=128 => self.evaluate_in::<N, 128>(values, modes),
            _ => self.evaluate_in::<N, { super::program::MOST }>(values, modes),
        }
    }

    #[inline(never)]
    fn evaluate_in<N: Scalar, const ROOM: usize>(
        &self,
        values: &[N],
        modes: &impl Fn(u16) -> i64,
    ) -> N {
        let mut results = [N::number(0.0); ROOM];
        let mut last = 0;
        for (index, op) in self.0.iter().enumerate() {
            let result = apply(op, values, &results, modes);
            results[index] = result;
            last = index;
        }
        results[last]
    }
}

/// The value of one operation on numbers, given in their order.
pub(super) fn one(op: &Op, operands: &[f64; 3], modes: &impl Fn(u16) -> i64) -> f64 {
    let mut next = 0;
    let own = op.renumbered(|_| {
        next += 1;
        next - 1
    });
    apply(&own, &[], operands, modes)
}

/// One operation.
#[inline(always)]
fn apply<N: Scalar>(op: &Op, values: &[N], results: &[N], modes: &impl Fn(u16) -> i64) -> N {
    let at = |register: Register| results[usize::from(register)];
    match *op {
        Op::Number(value) => N::number(value),
        Op::Variable(index) => values[usize::from(index)],
        Op::Affine { x, factor, shift } => at(x).affine(factor, shift),
        Op::Add(a, b) => at(a) + at(b),
        Op::Sub(a, b) => at(a) - at(b),
        Op::Mul(a, b) if a == b => at(a).squared(),
        Op::Mul(a, b) => at(a) * at(b),
        Op::Div(a, b) => at(a) / at(b),
        Op::Power(x, exponent) => at(x).power(exponent),
        Op::PowerOf(x, y) => at(x).power_of(at(y)),
        Op::Of(function, x) => at(x).of(function),
        _ => pick(op, at, modes),
    }
}

/// The mode of a guard; [`OPEN`] where there is none.
#[inline(always)]
fn mode_of(guard: u16, modes: &impl Fn(u16) -> i64) -> i64 {
    match guard {
        UNGUARDED => OPEN,
        guard => modes(guard),
    }
}

/// An operation that has pieces.
fn pick<N: Scalar>(op: &Op, at: impl Fn(Register) -> N, modes: &impl Fn(u16) -> i64) -> N {
    let flag = |truth: bool| N::number(if truth { 1.0 } else { 0.0 });
    match *op {
        Op::Atan2 { y, x, guard } => {
            let (y, x) = (at(y), at(x));
            let found = N::atan2(y, x);
            // Beyond the cut along −x the direction goes on as it came.
            match mode_of(guard, modes) {
                OPEN => found,
                mode if x.compared_value() < 0.0 && mode > 0 && y.compared_value() < 0.0 => {
                    found.affine(1.0, std::f64::consts::TAU)
                }
                mode if x.compared_value() < 0.0 && mode < 0 && y.compared_value() >= 0.0 => {
                    found.affine(1.0, -std::f64::consts::TAU)
                }
                _ => found,
            }
        }
        Op::Remainder { x, y, guard } => {
            let (x, y) = (at(x), at(y));
            match mode_of(guard, modes) {
                OPEN => {
                    let whole = (x.compared_value() / y.compared_value()).trunc();
                    let rest = x - y.affine(whole, 0.0);
                    rest.affine(
                        1.0,
                        x.compared_value() % y.compared_value() - rest.compared_value(),
                    )
                }
                mode => x - y.affine(truncated(mode), 0.0),
            }
        }
        Op::Abs { x, guard } => match is_negative(at(x), guard, modes) {
            true => -at(x),
            false => at(x),
        },
        Op::Sign { x, guard } => match mode_of(guard, modes) {
            OPEN => N::number(at(x).compared_value().signum()),
            mode => N::number(mode as f64),
        },
        Op::Whole { x, to, guard } => N::number(match mode_of(guard, modes) {
            OPEN => to.of(at(x).compared_value()),
            mode => to.guard_between(mode),
        }),
        Op::Min { a, b, guard } => match mode_of(guard, modes) {
            OPEN if at(b).compared_value() < at(a).compared_value()
                || at(a).compared_value().is_nan() =>
            {
                at(b)
            }
            OPEN => at(a),
            mode if mode > 0 => at(a),
            _ => at(b),
        },
        Op::Max { a, b, guard } => match mode_of(guard, modes) {
            OPEN if at(b).compared_value() > at(a).compared_value()
                || at(a).compared_value().is_nan() =>
            {
                at(b)
            }
            OPEN => at(a),
            mode if mode > 0 => at(b),
            _ => at(a),
        },
        Op::Less {
            a,
            b,
            or_equal,
            guard,
        } => match mode_of(guard, modes) {
            OPEN => {
                let (a, b) = (at(a).compared_value(), at(b).compared_value());
                match a.partial_cmp(&b) {
                    None => N::number(f64::NAN),
                    Some(order) => flag(order.is_lt() || or_equal && order.is_eq()),
                }
            }
            mode => flag(mode > 0),
        },
        Op::Equal(a, b) => {
            let (a, b) = (at(a).compared_value(), at(b).compared_value());
            match a.partial_cmp(&b) {
                None => N::number(f64::NAN),
                Some(order) => flag(order.is_eq()),
            }
        }
        Op::And(a, b) => logic(at(a).compared_value(), at(b).compared_value(), false),
        Op::Or(a, b) => logic(at(a).compared_value(), at(b).compared_value(), true),
        Op::Not(x) => match at(x).compared_value() {
            x if x.is_nan() => N::number(f64::NAN),
            x => flag(x == 0.0),
        },
        Op::Select { condition, a, b } => match at(condition).compared_value() {
            c if c.is_nan() => N::number(f64::NAN),
            0.0 => at(b),
            _ => at(a),
        },
        // (The others have no pieces.)
        _ => N::number(f64::NAN),
    }
}

fn is_negative<N: Scalar>(x: N, guard: u16, modes: &impl Fn(u16) -> i64) -> bool {
    match mode_of(guard, modes) {
        OPEN => x.compared_value() < 0.0,
        mode => mode < 0,
    }
}

/// `a || b`, or `a && b`: b does not count where a has decided.
fn logic<N: Scalar>(a: f64, b: f64, or: bool) -> N {
    let decided = (a != 0.0) == or;
    let value = match decided && !a.is_nan() {
        true => a,
        false => a * 0.0 + b,
    };
    N::number(match value.is_nan() {
        true => f64::NAN,
        false if value != 0.0 => 1.0,
        false => 0.0,
    })
}

/// The whole number towards zero of what lies between n and n + 1.
fn truncated(floor: i64) -> f64 {
    (if floor < 0 { floor + 1 } else { floor }) as f64
}

impl Rounding {
    pub(super) fn of(self, x: f64) -> f64 {
        match self {
            Self::Floor => x.floor(),
            Self::Ceil => x.ceil(),
            Self::Round => x.round(),
            Self::Trunc => x.trunc(),
        }
    }

    /// Where the guard lies between n and n + 1.
    fn guard_between(self, n: i64) -> f64 {
        match self {
            Self::Floor | Self::Round => n as f64,
            Self::Ceil => (n + 1) as f64,
            Self::Trunc => truncated(n),
        }
    }
}
