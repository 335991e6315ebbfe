//! Whether a condition may hold while its variables stay within bounds.
//!
//! Unlike on a moving number (`RateBounds`), an operation that has pieces takes all of those
//! that the bounds allow: nothing has to be known of its guard.

use super::evaluate::Scalar;
use super::function::Function;
use super::interval::Interval;
use super::moving::RateBounds;
use super::program::{Code, Op, Register, Rounding};

/// What a result may be.
#[derive(Clone, Copy, Debug)]
struct Reach {
    /// All its values.
    bounds: Interval,
    /// It may be no number at all.
    partial: bool,
}

const EVERYTHING: Interval = Interval {
    low: f64::NEG_INFINITY,
    high: f64::INFINITY,
};
const NOTHING: Interval = Interval {
    low: f64::NAN,
    high: f64::NAN,
};

impl Reach {
    const ANYTHING: Self = Self {
        bounds: EVERYTHING,
        partial: true,
    };

    fn of(bounds: Interval) -> Self {
        let partial = bounds.is_nothing();
        Self { bounds, partial }
    }

    /// A comparison that may come out so.
    fn comparison_result(may_hold: bool, may_fail: bool, partial: bool) -> Self {
        let bounds = match (may_hold, may_fail) {
            (true, true) => Interval {
                low: 0.0,
                high: 1.0,
            },
            (true, false) => Interval::of(1.0),
            (false, true) => Interval::of(0.0),
            (false, false) => NOTHING,
        };
        Self { bounds, partial }
    }

    fn may_hold(self) -> bool {
        !(self.bounds.is_nothing() || self.bounds.low == 0.0 && self.bounds.high == 0.0)
    }

    fn may_fail(self) -> bool {
        self.bounds.low <= 0.0 && self.bounds.high >= 0.0
    }

    /// Either of two.
    fn either_bound(self, other: Self) -> Self {
        let bounds = match (self.bounds.is_nothing(), other.bounds.is_nothing()) {
            (true, _) => other.bounds,
            (_, true) => self.bounds,
            _ => Interval {
                low: self.bounds.low.min(other.bounds.low),
                high: self.bounds.high.max(other.bounds.high),
            },
        };
        let partial = self.partial || other.partial;
        Self { bounds, partial }
    }
}

impl Code {
    /// False only where the value is 0, or no number, for all variables within the bounds.
    pub(crate) fn may_hold(&self, values: &[Interval]) -> bool {
        let mut results: Vec<Reach> = Vec::with_capacity(self.0.len());
        for op in &self.0 {
            let next = range_of_result(op, values, &results);
            results.push(next);
        }
        results.last().is_some_and(|last| last.may_hold())
    }
}

/// What the result of an operation may be.
fn range_of_result(op: &Op, values: &[Interval], results: &[Reach]) -> Reach {
    let at = |register: Register| results[usize::from(register)];
    match *op {
        Op::Number(value) => Reach::of(Interval::of(value)),
        Op::Variable(index) => Reach::of(values[usize::from(index)]),
        Op::Affine { x, factor, shift } => {
            arithmetic(at(x), at(x), |x, _| x.scale(factor) + Interval::of(shift))
        }
        Op::Add(a, b) => arithmetic(at(a), at(b), |a, b| a + b),
        Op::Sub(a, b) if a == b => arithmetic(at(a), at(b), |_, _| Interval::of(0.0)),
        Op::Sub(a, b) => arithmetic(at(a), at(b), |a, b| a - b),
        Op::Mul(a, b) if a == b => arithmetic(at(a), at(b), |a, _| a.square()),
        Op::Mul(a, b) => arithmetic(at(a), at(b), |a, b| a * b),
        Op::Div(a, b) => arithmetic(at(a), at(b), |a, b| a / b),
        Op::Power(x, exponent) => power(at(x), exponent),
        Op::PowerOf(x, exponent) => power_of(at(x), at(exponent)),
        Op::Of(function, x) => of_function(function, at(x)),
        Op::Less { a, b, or_equal, .. } => less(at(a), at(b), or_equal),
        Op::Equal(a, b) => {
            let (a, b) = (at(a), at(b));
            let (one, two) = (a.bounds, b.bounds);
            let meet = one.low <= two.high && two.low <= one.high;
            let fixed = one.low == one.high && two.low == two.high;
            let differ = !(one.is_nothing() || two.is_nothing() || fixed && meet);
            Reach::comparison_result(meet, differ, a.partial || b.partial)
        }
        Op::And(a, b) => {
            let (a, b) = (at(a), at(b));
            let holds = a.may_hold() && b.may_hold();
            Reach::comparison_result(holds, a.may_fail() || b.may_fail(), a.partial || b.partial)
        }
        Op::Or(a, b) => {
            let (a, b) = (at(a), at(b));
            let fails = a.may_fail() && b.may_fail();
            Reach::comparison_result(a.may_hold() || b.may_hold(), fails, a.partial || b.partial)
        }
        Op::Not(x) => Reach::comparison_result(at(x).may_fail(), at(x).may_hold(), at(x).partial),
        Op::Select { condition, a, b } => select(at(condition), at(a), at(b)),
        _ => piecewise(op, at),
    }
}

/// The operations that have pieces and give more than true or false.
fn piecewise(op: &Op, at: impl Fn(Register) -> Reach) -> Reach {
    match *op {
        Op::Abs { x, .. } => absolute(at(x)),
        Op::Sign { x, .. } => monotone(at(x), |x| match x {
            // (The sign of a zero counts for a single number, and not within bounds.)
            0.0 => f64::NAN,
            x => x.signum(),
        }),
        Op::Whole { x, to, .. } => monotone(at(x), |x| Rounding::of(to, x)),
        Op::Min { a, b, .. } => least_or_greatest(at(a), at(b), f64::min),
        Op::Max { a, b, .. } => least_or_greatest(at(a), at(b), f64::max),
        Op::Remainder { x, y, .. } => remainder(at(x), at(y)),
        Op::Atan2 { y, x, .. } => {
            let still = |bounds: Interval| RateBounds {
                value: bounds,
                rate: Interval::of(0.0),
            };
            arithmetic(at(y), at(x), |y, x| {
                RateBounds::atan2(still(y), still(x)).value
            })
        }
        // (The others are smooth.)
        _ => Reach::ANYTHING,
    }
}

/// Of two numbers that are there for certain another comes about, or, at poles and of
/// infinite numbers, anything.
fn arithmetic(a: Reach, b: Reach, f: impl Fn(Interval, Interval) -> Interval) -> Reach {
    if a.bounds.is_nothing() || b.bounds.is_nothing() {
        return Reach::of(NOTHING);
    }
    let bounds = f(a.bounds, b.bounds);
    match bounds.low.is_finite() && bounds.high.is_finite() {
        true => Reach {
            bounds,
            partial: a.partial || b.partial,
        },
        false if bounds.is_nothing() => Reach::ANYTHING,
        false => Reach {
            bounds,
            partial: true,
        },
    }
}

fn power(x: Reach, exponent: f64) -> Reach {
    let whole = exponent.fract() == 0.0;
    if x.bounds.is_nothing() || !whole && x.bounds.high < 0.0 {
        return Reach::of(NOTHING);
    }
    let found = arithmetic(x, x, |x, _| x.to_power(exponent));
    Reach {
        partial: found.partial || !whole && x.bounds.low < 0.0,
        ..found
    }
}

fn power_of(x: Reach, exponent: Reach) -> Reach {
    let fixed = exponent.bounds.low;
    if fixed == exponent.bounds.high {
        return power(x, fixed);
    }
    if !(x.bounds.low > 0.0) {
        return Reach::ANYTHING;
    }
    arithmetic(x, exponent, |x, exponent| {
        (x.of_function(Function::Ln) * exponent).of_function(Function::Exp)
    })
}

fn of_function(function: Function, x: Reach) -> Reach {
    if x.bounds.is_nothing() {
        return x;
    }
    let bounds = x.bounds.of_function(function);
    let within = |low: f64, high: f64| x.bounds.low >= low && x.bounds.high <= high;
    let inside = match function {
        Function::Asin | Function::Acos | Function::Atanh => within(-1.0, 1.0),
        Function::Acosh => within(1.0, f64::INFINITY),
        Function::Ln | Function::Log10 | Function::Log2 | Function::Sqrt => {
            within(0.0, f64::INFINITY)
        }
        Function::Sin
        | Function::Cos
        | Function::Tan
        | Function::Cosh
        | Function::Atan
        | Function::Sinh
        | Function::Tanh
        | Function::Asinh
        | Function::Exp
        | Function::Cbrt => true,
    };
    let finite = bounds.low.is_finite() && bounds.high.is_finite();
    Reach {
        bounds,
        partial: x.partial || !inside || !finite,
    }
}

fn less(a: Reach, b: Reach, or_equal: bool) -> Reach {
    let (one, two) = (a.bounds, b.bounds);
    let (holds, fails) = match or_equal {
        true => (one.low <= two.high, one.high > two.low),
        false => (one.low < two.high, one.high >= two.low),
    };
    Reach::comparison_result(holds, fails, a.partial || b.partial)
}

fn select(condition: Reach, a: Reach, b: Reach) -> Reach {
    let found = match (condition.may_hold(), condition.may_fail()) {
        (true, true) => a.either_bound(b),
        (true, false) => a,
        (false, true) => b,
        (false, false) => Reach::of(NOTHING),
    };
    Reach {
        partial: found.partial || condition.partial,
        ..found
    }
}

fn absolute(x: Reach) -> Reach {
    let Interval { low, high } = x.bounds;
    let bounds = match (low >= 0.0, high <= 0.0) {
        (true, _) => x.bounds,
        (_, true) => -x.bounds,
        _ if x.bounds.is_nothing() => NOTHING,
        _ => Interval {
            low: 0.0,
            high: high.max(-low),
        },
    };
    Reach { bounds, ..x }
}

/// A function that never falls and is no number where its sides differ.
fn monotone(x: Reach, f: impl Fn(f64) -> f64) -> Reach {
    if x.bounds.is_nothing() {
        return x;
    }
    let [low, high] = [f(x.bounds.low), f(x.bounds.high)];
    let bounds = Interval {
        low: if low.is_nan() { -1.0 } else { low },
        high: if high.is_nan() { 1.0 } else { high },
    };
    Reach { bounds, ..x }
}

/// The smaller or the greater of two; the other where one is no number.
fn least_or_greatest(a: Reach, b: Reach, choose: impl Fn(f64, f64) -> f64) -> Reach {
    if a.partial || b.partial {
        return a.either_bound(b);
    }
    let bounds = Interval {
        low: choose(a.bounds.low, b.bounds.low),
        high: choose(a.bounds.high, b.bounds.high),
    };
    Reach::of(bounds)
}

fn remainder(x: Reach, y: Reach) -> Reach {
    let (own, by) = (x.bounds, y.bounds);
    if own.is_nothing() || by.is_nothing() {
        return Reach::of(NOTHING);
    }
    let quotient = own / by;
    let [first, last] = [quotient.low.trunc(), quotient.high.trunc()];
    // Between −1 and 1, and only there, quotients of both signs have one whole part.
    if by.low == by.high && first == last && first.is_finite() {
        return arithmetic(x, y, |x, y| x - y.scale(first));
    }
    let size = by.low.abs().max(by.high.abs());
    let bounds = Interval {
        low: if own.low < 0.0 {
            own.low.max(-size)
        } else {
            0.0
        },
        high: if own.high > 0.0 {
            own.high.min(size)
        } else {
            0.0
        },
    };
    let certain = by.low > 0.0 || by.high < 0.0;
    Reach {
        bounds,
        partial: x.partial || y.partial || !certain || !(own.high - own.low).is_finite(),
    }
}

#[cfg(test)]
mod tests {
    use super::Interval;
    use crate::math::expression::Expression;

    fn may_hold(text: &str, bounds: [[f64; 2]; 2]) -> bool {
        let expression = Expression::new(text, &["x", "y"]).unwrap();
        let bounds = bounds.map(|[low, high]| Interval { low, high });
        expression.program().value.may_hold(&bounds)
    }

    /// Whatever holds at one of the places between the bounds may hold between them.
    #[test]
    fn what_holds_somewhere_is_never_excluded() {
        for text in [
            "x > 1 && x < 1.3",
            "sin(40*x)*y > 0.99",
            "abs(x) < 0.01 || floor(3*y) == 2",
            "!(x < y) && x != y",
            "min(x, y) > 0.4 || max(x, sqrt(y)) < -0.5",
            "x % 0.7 > 0.69",
            "x % y > 0.5*y",
            "(x > 0 ? y : -x) > 1.95",
            "atan2(y, x) > 3.1",
            "sqrt(x) > 1.4 || !(ln(y) < 0.6)",
            "1/x > 1000 || x^y > 3.9",
            "round(x)*sign(y) < -1.5",
            "ceil(x) - trunc(x) + fract(y) > 1.9",
            "0 && 1/x || x*x < 1e-4",
        ] {
            let expression = Expression::new(text, &["x", "y"]).unwrap();
            let mut held = 0;
            for cell in 0..400 {
                let low = [
                    -2.0 + 0.2 * f64::from(cell % 20),
                    -2.0 + 0.2 * f64::from(cell / 20),
                ];
                let bounds = low.map(|low| [low, low + 0.2]);
                let places = (0..=20).flat_map(|i| (0..=20).map(move |j| [i, j]));
                let holds = |[i, j]: [i32; 2]| {
                    let place = |k: usize, n: i32| low[k] + 0.01 * f64::from(n).min(20.0);
                    let value = expression.at(&[place(0, i), place(1, j)]);
                    value != 0.0 && !value.is_nan()
                };
                if places.into_iter().any(holds) {
                    held += 1;
                    // (Places may be off by a rounding.)
                    let wide = bounds.map(|[low, high]| [low - 1e-12, high + 1e-12]);
                    assert!(may_hold(text, wide), "{text} {low:?}");
                }
            }
            assert!(held > 0, "{text}");
        }
    }

    #[test]
    fn what_holds_nowhere_is_excluded() {
        let near = [[0.5, 0.501], [-0.3, -0.299]];
        for text in [
            "x > 0.51",
            "x > 0.4 && y > 0",
            "x < 0.2 || y < -1",
            "sin(x) > 0.5",
            "!(x > y)",
            "min(x, y) > -0.2",
            "sqrt(y) < 5",
            "x == 0.6",
            "x*x < 0.2",
            "x % 0.4 > 0.2",
            "floor(10*y) == -2",
            "(y > 0 ? 1 : 0) > 0.5",
            "abs(y) < 0.2",
        ] {
            assert!(!may_hold(text, near), "{text}");
        }
        // Bounds that are a single number decide at an edge too.
        assert!(!may_hold("x > 0", [[0.0; 2]; 2]));
        assert!(may_hold("x >= 0", [[0.0; 2]; 2]));
    }
}
