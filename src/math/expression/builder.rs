//! Programs in the making: numbers are calculated with, what stands twice is worked out
//! once, and what nothing needs is left out.

use super::function::Function;
use super::program::{
    Code, Guard, GuardKind, MOST, OPEN, Op, Program, Register, Rounding, UNGUARDED,
};

/// Greatest whole exponent that is written out as products.
const PRODUCTS: u32 = 16;

/// The sign of what has none counts as +1.
const SIGN: GuardKind = GuardKind::Sign { at_rest: 1 };

/// A program in the making.
#[derive(Clone, Debug, Default)]
pub(crate) struct Builder {
    ops: Vec<Op>,
    /// For each operation: true where its value changes by jumps alone.
    steps: Vec<bool>,
    guards: Vec<(Register, GuardKind)>,
    /// More operations than a program may have.
    pub(super) overflows: bool,
}

impl Builder {
    /// The result of an operation: one that is there already, or a new one.
    pub(super) fn op(&mut self, op: Op) -> Register {
        // (NaN is like nothing, not even itself: such numbers stand apart.)
        if let Some(known) = self.ops.iter().position(|known| *known == op) {
            return known as Register;
        }
        if self.ops.len() >= MOST {
            self.overflows = true;
            return 0;
        }
        let steps = match op {
            Op::Number(_)
            | Op::Sign { .. }
            | Op::Whole { .. }
            | Op::Less { .. }
            | Op::Equal(..)
            | Op::And(..)
            | Op::Or(..)
            | Op::Not(_) => true,
            Op::Variable(_) => false,
            _ => op
                .operands()
                .all(|operand| self.steps[usize::from(operand)]),
        };
        self.ops.push(op);
        self.steps.push(steps);
        (self.ops.len() - 1) as Register
    }

    pub(super) fn number(&mut self, value: f64) -> Register {
        self.op(Op::Number(value))
    }

    pub(super) fn variable(&mut self, index: usize) -> Register {
        self.op(Op::Variable(index as u16))
    }

    /// True of what changes by jumps alone.
    pub(super) fn changes_by_jumps(&self, x: Register) -> bool {
        self.steps[usize::from(x)]
    }

    /// The number that a result is.
    pub(super) fn constant_of(&self, x: Register) -> Option<f64> {
        match self.ops[usize::from(x)] {
            Op::Number(value) => Some(value),
            _ => None,
        }
    }

    /// An operation, worked out where all that it takes is numbers.
    fn operation_or_constant(&mut self, op: Op) -> Register {
        let known: Option<Vec<f64>> = op
            .operands()
            .map(|operand| self.constant_of(operand))
            .collect();
        let Some(known) = known else {
            return self.op(op);
        };
        // The operands stand before it, each as a number.
        let mut code: Vec<Op> = known.into_iter().map(Op::Number).collect();
        let places: Vec<Register> = op.operands().collect();
        code.push(op.renumbered(|register| {
            let place = places.iter().position(|&place| place == register);
            place.unwrap_or(0) as Register
        }));
        let value = Code(code).evaluate(&[], &|_| OPEN);
        self.number(value)
    }

    pub(super) fn affine(&mut self, x: Register, factor: f64, shift: f64) -> Register {
        if factor == 1.0 && shift == 0.0 {
            return x;
        }
        if let Op::Affine {
            x: inner,
            factor: f,
            shift: s,
        } = self.ops[usize::from(x)]
        {
            let (f, s) = (factor * f, factor * s + shift);
            if f.is_finite() && s.is_finite() {
                return self.affine(inner, f, s);
            }
        }
        self.operation_or_constant(Op::Affine { x, factor, shift })
    }

    pub(super) fn add(&mut self, a: Register, b: Register) -> Register {
        match (self.constant_of(a), self.constant_of(b)) {
            (None, Some(b)) => self.affine(a, 1.0, b),
            (Some(a), None) => self.affine(b, 1.0, a),
            _ => self.operation_or_constant(Op::Add(a, b)),
        }
    }

    pub(super) fn sub(&mut self, a: Register, b: Register) -> Register {
        match (self.constant_of(a), self.constant_of(b)) {
            (None, Some(b)) => self.affine(a, 1.0, -b),
            (Some(a), None) => self.affine(b, -1.0, a),
            _ => self.operation_or_constant(Op::Sub(a, b)),
        }
    }

    pub(super) fn mul(&mut self, a: Register, b: Register) -> Register {
        match (self.constant_of(a), self.constant_of(b)) {
            (None, Some(b)) => self.affine(a, b, 0.0),
            (Some(a), None) => self.affine(b, a, 0.0),
            _ => self.operation_or_constant(Op::Mul(a, b)),
        }
    }

    pub(super) fn div(&mut self, a: Register, b: Register) -> Register {
        self.operation_or_constant(Op::Div(a, b))
    }

    pub(super) fn of(&mut self, function: Function, x: Register) -> Register {
        self.operation_or_constant(Op::Of(function, x))
    }

    pub(super) fn power(&mut self, x: Register, y: Register) -> Register {
        let Some(exponent) = self.constant_of(y) else {
            return self.operation_or_constant(Op::PowerOf(x, y));
        };
        if self.constant_of(x).is_some() {
            return self.operation_or_constant(Op::PowerOf(x, y));
        }
        let whole = exponent.fract() == 0.0 && exponent.abs() <= f64::from(PRODUCTS);
        match exponent {
            0.5 => self.of(Function::Sqrt, x),
            0.0 => self.number(1.0),
            _ if whole => {
                let product = self.product(x, exponent.abs() as u32);
                if exponent > 0.0 {
                    return product;
                }
                let one = self.number(1.0);
                self.div(one, product)
            }
            _ => self.operation_or_constant(Op::Power(x, exponent)),
        }
    }

    /// x to a whole power ≥ 1, by squares.
    fn product(&mut self, x: Register, exponent: u32) -> Register {
        if exponent == 1 {
            return x;
        }
        let half = self.product(x, exponent / 2);
        let square = self.mul(half, half);
        match exponent % 2 {
            0 => square,
            _ => self.mul(square, x),
        }
    }

    /// The guard that a function is; none where it changes by jumps alone.
    fn guard_of_function(&mut self, x: Register, kind: GuardKind) -> u16 {
        if self.changes_by_jumps(x) {
            return UNGUARDED;
        }
        let known = self.guards.iter().position(|known| *known == (x, kind));
        known.unwrap_or_else(|| {
            self.guards.push((x, kind));
            self.guards.len() - 1
        }) as u16
    }

    /// The guard of which of two is greater.
    fn order(&mut self, a: Register, b: Register, at_rest: i64) -> u16 {
        let difference = self.sub(b, a);
        self.guard_of_function(difference, GuardKind::Sign { at_rest })
    }

    pub(super) fn atan2(&mut self, y: Register, x: Register) -> Register {
        let guard = self.guard_of_function(y, SIGN);
        self.operation_or_constant(Op::Atan2 { y, x, guard })
    }

    pub(super) fn remainder(&mut self, x: Register, y: Register) -> Register {
        let quotient = self.div(x, y);
        let guard = self.guard_of_function(quotient, GuardKind::Whole);
        self.operation_or_constant(Op::Remainder { x, y, guard })
    }

    pub(super) fn abs(&mut self, x: Register) -> Register {
        let guard = self.guard_of_function(x, SIGN);
        self.operation_or_constant(Op::Abs { x, guard })
    }

    pub(super) fn sign(&mut self, x: Register) -> Register {
        let guard = self.guard_of_function(x, SIGN);
        self.operation_or_constant(Op::Sign { x, guard })
    }

    pub(super) fn round_to_integer(&mut self, x: Register, to: Rounding) -> Register {
        let guarded = match to {
            Rounding::Round => self.affine(x, 1.0, 0.5),
            _ => x,
        };
        let guard = self.guard_of_function(guarded, GuardKind::Whole);
        self.operation_or_constant(Op::Whole { x, to, guard })
    }

    pub(super) fn min(&mut self, a: Register, b: Register) -> Register {
        let guard = self.order(a, b, 1);
        self.operation_or_constant(Op::Min { a, b, guard })
    }

    pub(super) fn max(&mut self, a: Register, b: Register) -> Register {
        let guard = self.order(a, b, 1);
        self.operation_or_constant(Op::Max { a, b, guard })
    }

    pub(super) fn less(&mut self, a: Register, b: Register, or_equal: bool) -> Register {
        // (`a < b` is not true where they stay equal.)
        let guard = self.order(a, b, if or_equal { 1 } else { -1 });
        self.operation_or_constant(Op::Less {
            a,
            b,
            or_equal,
            guard,
        })
    }

    /// An operation that looks at its operands alone.
    pub(super) fn operation_on_operands(&mut self, op: Op) -> Register {
        self.operation_or_constant(op)
    }

    pub(super) fn select(&mut self, condition: Register, a: Register, b: Register) -> Register {
        if a == b && self.constant_of(a).is_some() {
            return a;
        }
        match self.constant_of(condition) {
            Some(value) if value.is_nan() => self.number(f64::NAN),
            Some(0.0) => b,
            Some(_) => a,
            None => self.op(Op::Select { condition, a, b }),
        }
    }

    /// The program whose value is a result.
    pub(super) fn finish(&self, value: Register) -> Program {
        // Guards that the value needs, and those that they need.
        let mut numbers: Vec<Option<u16>> = vec![None; self.guards.len()];
        let mut wanted: Vec<u16> = Vec::new();
        let note = |code: &Code, numbers: &mut Vec<Option<u16>>, wanted: &mut Vec<u16>| {
            for guard in code.0.iter().filter_map(Op::guard_index) {
                let number = &mut numbers[usize::from(guard)];
                if number.is_none() {
                    *number = Some(wanted.len() as u16);
                    wanted.push(guard);
                }
            }
        };
        let own = self.code(value);
        note(&own, &mut numbers, &mut wanted);
        let (mut next, mut guards) = (0, Vec::new());
        while let Some(&guard) = wanted.get(next) {
            let (register, kind) = self.guards[usize::from(guard)];
            let code = self.code(register);
            note(&code, &mut numbers, &mut wanted);
            guards.push(Guard { code, kind });
            next += 1;
        }
        let renamed = |code: &Code| {
            let ops = code.0.iter().map(|op| op.with_guards(&numbers));
            Code(ops.collect())
        };
        Program {
            value: renamed(&own),
            guards: guards
                .iter()
                .map(|guard| Guard {
                    code: renamed(&guard.code),
                    kind: guard.kind,
                })
                .collect(),
        }
    }

    /// The operations that a result needs, in their order.
    fn code(&self, root: Register) -> Code {
        let root = usize::from(root);
        let mut needed = vec![false; root + 1];
        needed[root] = true;
        for index in (0..=root).rev() {
            if needed[index] {
                for operand in self.ops[index].operands() {
                    needed[usize::from(operand)] = true;
                }
            }
        }
        let mut places = vec![0; root + 1];
        let mut ops = Vec::new();
        for index in (0..=root).filter(|&index| needed[index]) {
            places[index] = ops.len() as Register;
            ops.push(self.ops[index].renumbered(|operand| places[usize::from(operand)]));
        }
        Code(ops)
    }
}
