//! An expression as a list of operations, each on results of earlier ones.
//!
//! Numbers are calculated with when the program is made, what stands twice is
//! worked out once, and what nothing needs is left out. Where a value has a kink
//! or jumps stands a *guard*: a function whose sign, or whose whole part, says
//! which of the smooth pieces is in force. Which one it is can be given from
//! outside, as a mode: the program is then smooth, also a little beyond the place
//! where the mode should have changed.

use super::function::Function;

/// Index of an operation, whose result others take.
pub(crate) type Register = u16;

/// No guard: the operation looks at its operands.
pub(crate) const UNGUARDED: u16 = u16::MAX;

/// Mode of a guard that is not known: operations look at their operands.
pub(crate) const OPEN: i64 = i64::MIN;

/// Most operations of a program.
pub(super) const MOST: usize = 1024;

/// An operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    Number(f64),
    Variable(u16),
    /// factor·x + shift.
    Affine {
        x: Register,
        factor: f64,
        shift: f64,
    },
    Add(Register, Register),
    Sub(Register, Register),
    Mul(Register, Register),
    Div(Register, Register),
    /// x to a constant power.
    Power(Register, f64),
    /// x to the power y.
    PowerOf(Register, Register),
    Of(Function, Register),
    /// The direction of (x, y); the guard is the sign of y.
    Atan2 {
        y: Register,
        x: Register,
        guard: u16,
    },
    /// What remains of x after whole y; the guard is the whole part of x/y.
    Remainder {
        x: Register,
        y: Register,
        guard: u16,
    },
    /// |x|; the guard is the sign of x.
    Abs {
        x: Register,
        guard: u16,
    },
    /// ±1 with the sign of x.
    Sign {
        x: Register,
        guard: u16,
    },
    /// A whole number beside x; the guard is the whole part of x, for `Round` of x + 1/2.
    Whole {
        x: Register,
        to: Rounding,
        guard: u16,
    },
    /// The smaller of two; the guard is the sign of b − a.
    Min {
        a: Register,
        b: Register,
        guard: u16,
    },
    /// The greater of two; the guard is the sign of b − a.
    Max {
        a: Register,
        b: Register,
        guard: u16,
    },
    /// 1 where a < b (or a ≤ b), else 0; the guard is the sign of b − a.
    Less {
        a: Register,
        b: Register,
        or_equal: bool,
        guard: u16,
    },
    /// 1 where a = b, else 0.
    Equal(Register, Register),
    And(Register, Register),
    Or(Register, Register),
    Not(Register),
    /// a where the condition is not zero, else b.
    Select {
        condition: Register,
        a: Register,
        b: Register,
    },
}

/// Direction in which a number is made whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rounding {
    Floor,
    Ceil,
    Round,
    Trunc,
}

/// Meaning of a guard's mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GuardKind {
    /// ±1: its sign; `at_rest` where it stays zero.
    Sign { at_rest: i64 },
    /// n where it lies between n and n + 1.
    Whole,
}

/// A guard: a function of the variables, and what of it counts.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Guard {
    pub(crate) code: Code,
    pub(crate) kind: GuardKind,
}

/// Operations whose last result is what is wanted.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Code(pub(super) Vec<Op>);

/// An expression, ready to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Program {
    /// The value.
    pub(crate) value: Code,
    /// The guards that its operations name.
    pub(crate) guards: Vec<Guard>,
}

/// How the result of an operation may change with its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Steepness {
    Mild,
    /// Much within a small part of their range.
    Steep,
    /// Without bound at finite operands.
    Pole,
}

impl Op {
    /// The results that it takes.
    pub(super) fn operands(&self) -> impl Iterator<Item = Register> {
        let (mut all, mut count) = ([Register::MAX; 3], 0);
        self.renumbered(|register| {
            all[count] = register;
            count += 1;
            register
        });
        all.into_iter().take(count)
    }

    /// The same operation on other results.
    pub(super) fn renumbered(mut self, mut to: impl FnMut(Register) -> Register) -> Self {
        match &mut self {
            Self::Number(_) | Self::Variable(_) => {}
            Self::Affine { x, .. }
            | Self::Power(x, _)
            | Self::Of(_, x)
            | Self::Abs { x, .. }
            | Self::Sign { x, .. }
            | Self::Whole { x, .. }
            | Self::Not(x) => *x = to(*x),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::PowerOf(a, b)
            | Self::Equal(a, b)
            | Self::And(a, b)
            | Self::Or(a, b)
            | Self::Atan2 { y: a, x: b, .. }
            | Self::Remainder { x: a, y: b, .. }
            | Self::Min { a, b, .. }
            | Self::Max { a, b, .. }
            | Self::Less { a, b, .. } => {
                *a = to(*a);
                *b = to(*b);
            }
            Self::Select { condition, a, b } => {
                *condition = to(*condition);
                *a = to(*a);
                *b = to(*b);
            }
        }
        self
    }

    /// How its result may change with its operands.
    fn steepness(&self) -> Steepness {
        match *self {
            Self::Div(..) | Self::PowerOf(..) => Steepness::Pole,
            Self::Power(_, exponent) => match exponent {
                _ if exponent < 0.0 => Steepness::Pole,
                _ if exponent > 3.0 => Steepness::Steep,
                _ => Steepness::Mild,
            },
            Self::Of(function, _) => match function {
                Function::Tan
                | Function::Ln
                | Function::Log10
                | Function::Log2
                | Function::Atanh => Steepness::Pole,
                Function::Sin | Function::Cos => Steepness::Mild,
                Function::Asin
                | Function::Acos
                | Function::Atan
                | Function::Sinh
                | Function::Cosh
                | Function::Tanh
                | Function::Asinh
                | Function::Acosh
                | Function::Exp
                | Function::Sqrt
                | Function::Cbrt => Steepness::Steep,
            },
            Self::Number(_)
            | Self::Variable(_)
            | Self::Affine { .. }
            | Self::Add(..)
            | Self::Sub(..)
            | Self::Mul(..)
            | Self::Atan2 { .. }
            | Self::Remainder { .. }
            | Self::Abs { .. }
            | Self::Sign { .. }
            | Self::Whole { .. }
            | Self::Min { .. }
            | Self::Max { .. }
            | Self::Less { .. }
            | Self::Equal(..)
            | Self::And(..)
            | Self::Or(..)
            | Self::Not(_)
            | Self::Select { .. } => Steepness::Mild,
        }
    }

    /// True where it may change much within a small part of the range of its operands.
    pub(crate) fn may_be_steep(&self) -> bool {
        self.steepness() != Steepness::Mild
    }

    /// True where it may grow without bound at finite operands.
    pub(crate) fn may_have_poles(&self) -> bool {
        self.steepness() == Steepness::Pole
    }

    /// The guard that it looks at.
    pub(super) fn guard_index(&self) -> Option<u16> {
        match *self {
            Self::Atan2 { guard, .. }
            | Self::Remainder { guard, .. }
            | Self::Abs { guard, .. }
            | Self::Sign { guard, .. }
            | Self::Whole { guard, .. }
            | Self::Min { guard, .. }
            | Self::Max { guard, .. }
            | Self::Less { guard, .. } => (guard != UNGUARDED).then_some(guard),
            _ => None,
        }
    }
}

impl Code {
    /// The operations in their order.
    pub(crate) fn ops(&self) -> &[Op] {
        &self.0
    }

    /// True where the variable counts.
    pub(crate) fn reads(&self, variable: usize) -> bool {
        let is = |op: &Op| matches!(op, Op::Variable(own) if usize::from(*own) == variable);
        self.0.iter().any(is)
    }

    /// The value of what depends on nothing.
    pub(crate) fn constant(&self) -> Option<f64> {
        match self.0.as_slice() {
            [Op::Number(value)] => Some(*value),
            _ => None,
        }
    }
}

impl Program {
    /// True where the variable counts, for the value or a guard.
    pub(crate) fn reads(&self, variable: usize) -> bool {
        let guards = self.guards.iter().map(|guard| &guard.code);
        std::iter::once(&self.value)
            .chain(guards)
            .any(|code| code.reads(variable))
    }
}

impl Op {
    /// The same with the guards numbered anew.
    pub(super) fn with_guards(mut self, numbers: &[Option<u16>]) -> Self {
        let own = self.guard_index();
        let named = own.and_then(|guard| numbers[usize::from(guard)]);
        match &mut self {
            Self::Atan2 { guard, .. }
            | Self::Remainder { guard, .. }
            | Self::Abs { guard, .. }
            | Self::Sign { guard, .. }
            | Self::Whole { guard, .. }
            | Self::Min { guard, .. }
            | Self::Max { guard, .. }
            | Self::Less { guard, .. } => *guard = named.unwrap_or(UNGUARDED),
            _ => {}
        }
        self
    }
}
