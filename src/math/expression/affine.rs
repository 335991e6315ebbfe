//! What of an expression is linear in some of its variables.

use super::builder::Builder;
use super::program::{Op, Program, Register};

/// Most variables that are looked at.
const MOST: usize = 4;

/// Σ factorᵢ·xᵢ + a rest that does not depend on the xᵢ.
#[derive(Clone, Debug)]
pub(crate) struct Affine {
    /// The factors, in the order of the variables asked for.
    pub(crate) factors: Vec<f64>,
    /// The rest.
    pub(crate) rest: Program,
}

/// A result: its factors, and its rest in the new program.
#[derive(Clone, Copy)]
struct Parts {
    factors: [f64; MOST],
    rest: Register,
}

impl Parts {
    fn is_rest(&self) -> bool {
        self.factors == [0.0; MOST]
    }

    fn scaled(self, factor: f64, into: &mut Builder) -> Self {
        Self {
            factors: self.factors.map(|own| own * factor),
            rest: into.affine(self.rest, factor, 0.0),
        }
    }
}

/// Takes a result apart; `None` where it is not linear in the variables, or a guard
/// depends on them.
pub(super) fn of(builder: &Builder, root: Register, variables: &[usize]) -> Option<Affine> {
    if variables.len() > MOST {
        return None;
    }
    let code = builder.finish(root).value;
    let mut into = Builder::default();
    let mut parts: Vec<Parts> = Vec::new();
    for op in code.ops() {
        let part = affine_part(op, &parts, variables, &mut into)?;
        parts.push(part);
    }
    let last = parts.last()?;
    Some(Affine {
        factors: last.factors[..variables.len()].to_vec(),
        rest: into.finish(last.rest),
    })
}

/// A program over one variable, on which those of another depend as slope·x + shift.
pub(super) fn along_a_line(program: &Program, lines: &[Option<[f64; 2]>]) -> Option<Program> {
    let mut into = Builder::default();
    let mut places: Vec<Register> = Vec::new();
    for op in program.value.ops() {
        let place = match *op {
            Op::Variable(index) => {
                let [slope, shift] = (*lines.get(usize::from(index))?)?;
                let x = into.variable(0);
                match slope {
                    0.0 => into.number(shift),
                    _ => into.affine(x, slope, shift),
                }
            }
            _ => rebuild_operation(op, |register| places[usize::from(register)], &mut into),
        };
        places.push(place);
    }
    Some(into.finish(*places.last()?))
}

fn affine_part(op: &Op, parts: &[Parts], variables: &[usize], into: &mut Builder) -> Option<Parts> {
    let at = |register: Register| parts[usize::from(register)];
    let rest = |rest: Register| Parts {
        factors: [0.0; MOST],
        rest,
    };
    if let Op::Variable(index) = *op {
        let own = variables.iter().position(|&v| v == usize::from(index));
        let Some(own) = own else {
            return Some(rest(into.variable(usize::from(index))));
        };
        let mut factors = [0.0; MOST];
        factors[own] = 1.0;
        return Some(Parts {
            factors,
            rest: into.number(0.0),
        });
    }
    let sum = |a: Parts, b: Parts, into: &mut Builder| Parts {
        factors: std::array::from_fn(|k| a.factors[k] + b.factors[k]),
        rest: into.add(a.rest, b.rest),
    };
    if op.operands().all(|operand| at(operand).is_rest()) {
        return Some(rest(rebuild_operation(
            op,
            |register| at(register).rest,
            into,
        )));
    }
    Some(match *op {
        Op::Affine { x, factor, shift } => {
            let scaled = at(x).scaled(factor, into);
            Parts {
                rest: into.affine(scaled.rest, 1.0, shift),
                ..scaled
            }
        }
        Op::Add(a, b) => sum(at(a), at(b), into),
        Op::Sub(a, b) => {
            let negative = at(b).scaled(-1.0, into);
            sum(at(a), negative, into)
        }
        Op::Mul(a, b) => {
            let (a, b) = match at(a).is_rest() {
                true => (at(a), at(b)),
                false => (at(b), at(a)),
            };
            let factor = a.is_rest().then(|| into.constant_of(a.rest)).flatten()?;
            b.scaled(factor, into)
        }
        Op::Div(a, b) => {
            let divisor = at(b)
                .is_rest()
                .then(|| into.constant_of(at(b).rest))
                .flatten()?;
            at(a).scaled(1.0 / divisor, into)
        }
        _ => return None,
    })
}

/// An operation anew, on other results.
fn rebuild_operation(op: &Op, at: impl Fn(Register) -> Register, into: &mut Builder) -> Register {
    match *op {
        Op::Number(value) => into.number(value),
        Op::Variable(index) => into.variable(usize::from(index)),
        Op::Affine { x, factor, shift } => into.affine(at(x), factor, shift),
        Op::Add(a, b) => into.add(at(a), at(b)),
        Op::Sub(a, b) => into.sub(at(a), at(b)),
        Op::Mul(a, b) => into.mul(at(a), at(b)),
        Op::Div(a, b) => into.div(at(a), at(b)),
        Op::Of(function, x) => into.of(function, at(x)),
        Op::Atan2 { y, x, .. } => into.atan2(at(y), at(x)),
        Op::Remainder { x, y, .. } => into.remainder(at(x), at(y)),
        Op::Abs { x, .. } => into.abs(at(x)),
        Op::Sign { x, .. } => into.sign(at(x)),
        Op::Whole { x, to, .. } => into.round_to_integer(at(x), to),
        Op::Min { a, b, .. } => into.min(at(a), at(b)),
        Op::Max { a, b, .. } => into.max(at(a), at(b)),
        Op::Less { a, b, or_equal, .. } => into.less(at(a), at(b), or_equal),
        Op::Select { condition, a, b } => into.select(at(condition), at(a), at(b)),
        Op::Power(..) | Op::PowerOf(..) | Op::Equal(..) | Op::And(..) | Op::Or(..) | Op::Not(_) => {
            into.operation_on_operands(op.renumbered(at))
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::math::expression::{Expression, OPEN};

    #[test]
    fn what_is_linear_is_taken_apart_and_the_rest_is_the_same() {
        let names = ["t", "x", "v"];
        for (text, wanted) in [
            ("-3*x + 2*(v - 4*x)/5 + sin(t)*2", Some([-4.6, 0.4])),
            ("t*x", None),
            ("x*v", None),
            ("abs(t - 1) + (t < 2 ? 3 : t^2) - x", Some([-1.0, 0.0])),
            ("x > 0 ? 1 : 2", None),
            ("x - x + t", Some([0.0, 0.0])),
            ("5", Some([0.0, 0.0])),
        ] {
            let expression = Expression::new(text, &names).unwrap();
            let found = expression.affine_in(&[1, 2]);
            assert_eq!(found.is_some(), wanted.is_some(), "{text}");
            let (Some(found), Some(wanted)) = (found, wanted) else {
                continue;
            };
            for (own, wanted) in found.factors.iter().zip(wanted) {
                approx::assert_relative_eq!(*own, wanted, epsilon = 1e-15);
            }
            for values in [[0.3, 0.7, -1.1], [1.7, -2.0, 0.4]] {
                let rest = found.rest.value.evaluate(&values, &|_| OPEN);
                let sum = rest + found.factors[0] * values[1] + found.factors[1] * values[2];
                approx::assert_relative_eq!(sum, expression.at(&values), max_relative = 1e-14);
            }
        }
    }
}
