//! The steps of a program in the order in which their series follow.

use super::super::function::Function;
use super::super::program::{Op, Register};
use super::Step;
use std::f64::consts::{LN_2, LN_10};

/// Puts steps into their order, with those that others need besides.
#[derive(Default)]
pub(super) struct Maker {
    pub(super) steps: Vec<Step>,
}

impl Maker {
    pub(super) fn push(&mut self, step: Step) -> Register {
        self.steps.push(step);
        (self.steps.len() - 1) as Register
    }

    fn add_operation(&mut self, op: Op) -> Register {
        self.push(Step::Op(op))
    }

    fn affine(&mut self, x: Register, factor: f64, shift: f64) -> Register {
        self.add_operation(Op::Affine { x, factor, shift })
    }

    fn add_quotient(&mut self, numerator: f64, x: Register) -> Register {
        let one = self.add_operation(Op::Number(numerator));
        self.add_operation(Op::Div(one, x))
    }

    pub(super) fn op(&mut self, op: Op) -> Register {
        match op {
            Op::Of(function, x) => match self.slope(function, x) {
                Some(slope) => self.push(Step::Along { function, x, slope }),
                None => self.add_operation(op),
            },
            Op::Atan2 { y, x, .. } => {
                let (yy, xx) = (
                    self.add_operation(Op::Mul(y, y)),
                    self.add_operation(Op::Mul(x, x)),
                );
                let square = self.add_operation(Op::Add(yy, xx));
                let by_y = self.add_operation(Op::Div(x, square));
                let by_x = self.add_operation(Op::Div(y, square));
                let by_x = self.affine(by_x, -1.0, 0.0);
                self.push(Step::Direction { op, by_y, by_x })
            }
            Op::PowerOf(x, y) => {
                let logarithm = self.op(Op::Of(Function::Ln, x));
                let of = self.add_operation(Op::Mul(logarithm, y));
                self.push(Step::Exponential { x, y, of })
            }
            _ => self.add_operation(op),
        }
    }

    /// The slope of functions that have no rule of their own.
    fn slope(&mut self, function: Function, x: Register) -> Option<Register> {
        let root_of = |this: &mut Self, factor: f64, shift: f64| {
            let square = this.add_operation(Op::Mul(x, x));
            let inside = this.affine(square, factor, shift);
            this.add_operation(Op::Of(Function::Sqrt, inside))
        };
        Some(match function {
            Function::Asin => {
                let root = root_of(self, -1.0, 1.0);
                self.add_quotient(1.0, root)
            }
            Function::Acos => {
                let root = root_of(self, -1.0, 1.0);
                self.add_quotient(-1.0, root)
            }
            Function::Asinh => {
                let root = root_of(self, 1.0, 1.0);
                self.add_quotient(1.0, root)
            }
            Function::Acosh => {
                let root = root_of(self, 1.0, -1.0);
                self.add_quotient(1.0, root)
            }
            Function::Atan | Function::Atanh => {
                let sign = if function == Function::Atan {
                    1.0
                } else {
                    -1.0
                };
                let square = self.add_operation(Op::Mul(x, x));
                let inside = self.affine(square, sign, 1.0);
                self.add_quotient(1.0, inside)
            }
            Function::Ln => self.add_quotient(1.0, x),
            Function::Log10 => self.add_quotient(1.0 / LN_10, x),
            Function::Log2 => self.add_quotient(1.0 / LN_2, x),
            _ => return None,
        })
    }
}
