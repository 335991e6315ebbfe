//! An expression along a motion, as a power series made coefficient by coefficient.
//!
//! Each operation has its rule for the next coefficient (A. Griewank, A. Walther,
//! Evaluating derivatives, 2008, chapter 13); functions by the differential equation
//! that they satisfy.

mod maker;

use super::function::Function;
use super::program::{Code, Op, Program, Register};
use maker::Maker;

/// Coefficients of a series.
pub(crate) type Row<const N: usize> = [f64; N];

/// Operations in a form that extends a series, with its memory.
#[derive(Clone, Debug)]
pub(crate) struct SeriesProgram<const N: usize> {
    steps: Vec<Step>,
    /// For each step, its series and that of its companion.
    rows: Vec<Row<N>>,
    others: Vec<Row<N>>,
}

/// A step of the extension.
#[derive(Clone, Copy, Debug)]
enum Step {
    Op(Op),
    /// y with y′ = slope·x′.
    Along {
        function: Function,
        x: Register,
        slope: Register,
    },
    /// The direction of (x, y), by the slopes of both.
    Direction {
        op: Op,
        by_y: Register,
        by_x: Register,
    },
    /// exp(y·ln x) in place of a power whose exponent changes.
    Exponential {
        x: Register,
        y: Register,
        of: Register,
    },
}

impl<const N: usize> SeriesProgram<N> {
    /// The extension of a program's value.
    pub(crate) fn new(program: &Program) -> Self {
        Self::of(&program.value)
    }

    fn of(code: &Code) -> Self {
        let mut maker = Maker::default();
        let mut places: Vec<Register> = Vec::new();
        for op in code.ops() {
            let op = op.renumbered(|register| places[usize::from(register)]);
            let place = maker.op(op);
            places.push(place);
        }
        // The value stands last.
        let last = places.last().copied().unwrap_or(0);
        maker.push(Step::Op(Op::Affine {
            x: last,
            factor: 1.0,
            shift: 0.0,
        }));
        let count = maker.steps.len();
        Self {
            steps: maker.steps,
            rows: vec![[0.0; N]; count],
            others: vec![[0.0; N]; count],
        }
    }

    /// The coefficient of an order, from those of the variables up to it; orders
    /// ascending from 0.
    pub(crate) fn extend(
        &mut self,
        order: usize,
        variable: impl Fn(usize) -> f64,
        modes: &impl Fn(u16) -> i64,
    ) -> f64 {
        let mut last = 0.0;
        for index in 0..self.steps.len() {
            let step = self.steps[index];
            last = self.advance(index, &step, order, &variable, modes);
            self.rows[index][order] = last;
        }
        last
    }

    fn row(&self, register: Register) -> &Row<N> {
        &self.rows[usize::from(register)]
    }

    fn advance(
        &mut self,
        index: usize,
        step: &Step,
        k: usize,
        variable: &impl Fn(usize) -> f64,
        modes: &impl Fn(u16) -> i64,
    ) -> f64 {
        match *step {
            Step::Op(Op::Variable(own)) => variable(usize::from(own)),
            Step::Op(op) if k == 0 => {
                let value = self.value_of_operation(&op, modes);
                self.begin_other(index, &op, value);
                value
            }
            Step::Op(op) => self.next_coefficient(index, &op, k, modes),
            Step::Along { function, x, .. } if k == 0 => function.value(self.row(x)[0]),
            Step::Along { x, slope, .. } => integrated_coefficient(self.row(x), self.row(slope), k),
            Step::Direction { op, .. } if k == 0 => self.value_of_operation(&op, modes),
            Step::Direction { op, by_y, by_x } => {
                let Op::Atan2 { y, x, .. } = op else {
                    return f64::NAN;
                };
                integrated_coefficient(self.row(y), self.row(by_y), k)
                    + integrated_coefficient(self.row(x), self.row(by_x), k)
            }
            Step::Exponential { x, y, .. } if k == 0 => self.row(x)[0].powf(self.row(y)[0]),
            Step::Exponential { of, .. } => {
                integrated_coefficient(self.row(of), &self.rows[index], k)
            }
        }
    }

    /// Value of an operation.
    fn value_of_operation(&self, op: &Op, modes: &impl Fn(u16) -> i64) -> f64 {
        let operands: [f64; 3] = {
            let mut all = [0.0; 3];
            for (value, register) in all.iter_mut().zip(op.operands()) {
                *value = self.row(register)[0];
            }
            all
        };
        super::evaluate::one(op, &operands, modes)
    }

    fn begin_other(&mut self, index: usize, op: &Op, value: f64) {
        let Op::Of(function, x) = *op else {
            return;
        };
        let x = self.row(x)[0];
        self.others[index][0] = match function {
            Function::Sin => x.cos(),
            Function::Cos => -x.sin(),
            Function::Sinh => x.cosh(),
            Function::Cosh => x.sinh(),
            Function::Tan => 1.0 + value * value,
            Function::Tanh => 1.0 - value * value,
            _ => 0.0,
        };
    }

    /// The next coefficient of an operation, k ≥ 1.
    fn next_coefficient(
        &mut self,
        index: usize,
        op: &Op,
        k: usize,
        modes: &impl Fn(u16) -> i64,
    ) -> f64 {
        let at = |register: Register| self.row(register)[k];
        match *op {
            Op::Affine { x, factor, .. } => factor * at(x),
            Op::Add(a, b) => at(a) + at(b),
            Op::Sub(a, b) => at(a) - at(b),
            Op::Mul(a, b) => product(self.row(a), self.row(b), k),
            Op::Div(a, b) => {
                let (b, own) = (self.row(b), &self.rows[index]);
                let known: f64 = (0..k).map(|i| own[i] * b[k - i]).sum();
                (at(a) - known) / b[0]
            }
            Op::Power(x, exponent) => {
                // x·y′ = a·x′·y.
                let (x, own) = (self.row(x), &self.rows[index]);
                let sum: f64 = (1..=k)
                    .map(|j| (exponent * j as f64 - (k - j) as f64) * x[j] * own[k - j])
                    .sum();
                sum / (k as f64 * x[0])
            }
            Op::Of(function, x) => self.of_function(index, function, x, k),
            Op::Remainder { x, y, .. } => {
                let whole = self.integer_part(op, modes);
                at(x) - whole * at(y)
            }
            Op::Abs { x, .. } => {
                let x = self.row(x);
                let turned =
                    self.rows[index][0] != x[0] || x[0] == 0.0 && self.guard_mode(op, modes) < 0;
                if turned { -x[k] } else { x[k] }
            }
            Op::Min { a, b, .. } | Op::Max { a, b, .. } => {
                let less = matches!(op, Op::Min { .. });
                let first = match self.guard_mode(op, modes) {
                    0 => self.row(a)[0] == self.rows[index][0],
                    side => (side > 0) == less,
                };
                if first { at(a) } else { at(b) }
            }
            Op::Select { condition, a, b } => match self.row(condition)[0] {
                0.0 => at(b),
                c if c.is_nan() => f64::NAN,
                _ => at(a),
            },
            // Numbers, and what changes by jumps alone. (Directions and powers of
            // powers have steps of their own.)
            _ => 0.0,
        }
    }

    /// Mode of the guard of an operation; 0 where it looks at its operands.
    fn guard_mode(&self, op: &Op, modes: &impl Fn(u16) -> i64) -> i64 {
        match op.guard_index().map(modes) {
            None | Some(super::OPEN) => 0,
            Some(mode) => mode,
        }
    }

    /// The whole number of a remainder.
    fn integer_part(&self, op: &Op, modes: &impl Fn(u16) -> i64) -> f64 {
        let Op::Remainder { x, y, .. } = *op else {
            return 0.0;
        };
        match op.guard_index().map(modes) {
            None | Some(super::OPEN) => (self.row(x)[0] / self.row(y)[0]).trunc(),
            Some(mode) if mode < 0 => (mode + 1) as f64,
            Some(mode) => mode as f64,
        }
    }

    fn of_function(&mut self, index: usize, function: Function, x: Register, k: usize) -> f64 {
        let x = self.row(x);
        let (own, other) = (&self.rows[index], &self.others[index]);
        match function {
            Function::Exp => integrated_coefficient(x, own, k),
            Function::Sqrt => {
                let known: f64 = (1..k).map(|i| own[i] * own[k - i]).sum();
                (x[k] - known) / (2.0 * own[0])
            }
            Function::Cbrt => {
                let sum: f64 = (1..=k)
                    .map(|j| (j as f64 / 3.0 - (k - j) as f64) * x[j] * own[k - j])
                    .sum();
                sum / (k as f64 * x[0])
            }
            _ => {
                let value = integrated_coefficient(x, other, k);
                let companion = match function {
                    Function::Sin | Function::Cos => -integrated_coefficient(x, own, k),
                    Function::Sinh | Function::Cosh => integrated_coefficient(x, own, k),
                    // tan′ = 1 + tan², tanh′ = 1 − tanh².
                    _ => {
                        let known: f64 = (1..k).map(|i| own[i] * own[k - i]).sum();
                        let square = known + 2.0 * own[0] * value;
                        match function {
                            Function::Tan => square,
                            _ => -square,
                        }
                    }
                };
                self.others[index][k] = companion;
                value
            }
        }
    }
}

/// Coefficient k of a product.
fn product<const N: usize>(a: &Row<N>, b: &Row<N>, k: usize) -> f64 {
    (0..=k).map(|i| a[i] * b[k - i]).sum()
}

/// Coefficient k ≥ 1 of y with y′ = slope·x′.
fn integrated_coefficient<const N: usize>(x: &Row<N>, slope: &Row<N>, k: usize) -> f64 {
    let sum: f64 = (1..=k).map(|j| j as f64 * x[j] * slope[k - j]).sum();
    sum / k as f64
}

/// The first coefficients of a function about a place.
pub(crate) fn taylor_about<const N: usize>(function: Function, place: f64) -> Row<N> {
    let code = Code(vec![Op::Variable(0), Op::Of(function, 0)]);
    let mut ordered = SeriesProgram::<N>::of(&code);
    std::array::from_fn(|order| {
        let x = |_| match order {
            0 => place,
            1 => 1.0,
            _ => 0.0,
        };
        ordered.extend(order, x, &|_| super::OPEN)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::{Expression, OPEN};

    #[test]
    fn a_series_agrees_with_the_function_along_the_motion() {
        for text in [
            "sin(x)*cos(2*x) + tan(x/2) - tanh(x)",
            "asin(x/3) + acos(x/4) + atan(x) + asinh(x) + acosh(x + 2) + atanh(x/5)",
            "exp(-x)*ln(x + 2) + log10(x + 1) - log2(x + 3)",
            "sqrt(x + 1) + cbrt(x + 2) + (x + 1)^2.3 + (1 + x)^x + x^-3 + 3^x",
            "sinh(x) - cosh(x)/2 + atan2(x, 2 - x) + abs(x - 2) + min(x, x^2) + max(x, 3*x)",
            "x % 0.3 + fract(5*x) + floor(x)*x + (x > 0.2 ? x^2 : 1/x)",
        ] {
            let expression = Expression::new(text, &["x"]).unwrap();
            let mut ordered = SeriesProgram::<12>::new(expression.program());
            let motion = [0.65, 0.5, -0.3, 0.2];
            let series: [f64; 12] = std::array::from_fn(|order| {
                let x = |_| motion.get(order).copied().unwrap_or(0.0);
                ordered.extend(order, x, &|_| OPEN)
            });
            for s in [-0.02, 0.01, 0.02] {
                let at = |row: &[f64]| row.iter().rev().fold(0.0, |sum, c| sum * s + c);
                let exact = expression.at(&[at(&motion)]);
                approx::assert_relative_eq!(at(&series), exact, max_relative = 1e-12);
            }
        }
    }
}
