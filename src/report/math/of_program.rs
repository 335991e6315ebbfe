//! Formulas of expressions.

use super::Expr;
use crate::math::expression::{Code, Function, Op};

/// The formula of a program, its variables written as they are said; `None`: it has operations
/// that this notation has no form for.
pub(crate) fn of_program(code: &Code, variable: &dyn Fn(usize) -> Expr) -> Option<Expr> {
    let mut known: Vec<Expr> = Vec::new();
    for op in code.ops() {
        let of = |register: u16| known[usize::from(register)].clone();
        let expr = match *op {
            Op::Number(value) => Expr::Number(value),
            Op::Variable(index) => variable(usize::from(index)),
            Op::Affine { x, factor, shift } => affine(of(x), factor, shift),
            Op::Add(a, b) => of(a).plus(of(b)),
            Op::Sub(a, b) => of(a).minus(of(b)),
            Op::Mul(a, b) if a == b => of(a).squared(),
            Op::Mul(a, b) => of(a).times(of(b)),
            Op::Div(a, b) => of(a).over(of(b)),
            Op::Of(Function::Tanh, x) => Expr::Function("tanh", Box::new(of(x))),
            _ => return None,
        };
        known.push(expr);
    }
    known.pop()
}

/// factor·x + shift.
fn affine(x: Expr, factor: f64, shift: f64) -> Expr {
    let part = match factor.abs() == 1.0 {
        true => x,
        false => Expr::Number(factor.abs()).times(x),
    };
    match (shift == 0.0, factor < 0.0) {
        (true, true) => part.negative(),
        (true, false) => part,
        (false, true) => Expr::Number(shift).minus(part),
        (false, false) => part.plus(Expr::Number(shift)),
    }
}
