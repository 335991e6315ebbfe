//! An expression of one variable: where its pieces end, and which is in force where.
//!
//! A function of time alone is cut into its pieces beforehand, with the period at which they
//! repeat. So motions of drives, and the loads of `exact`, know their breaks.

use super::crossing::{Stretch, change_mode};
use super::evaluate::Scalar;
use super::function::Function;
use super::interval::Interval;
use super::moving::RateBounds;
use super::program::{Code, Guard, GuardKind, OPEN, Op, Program, Register};
use crate::math::fraction::Fraction;
use crate::math::number::Dual;
use std::f64::consts::TAU;

/// Most places at which pieces end that a function of time is followed to.
pub(crate) const MOST: usize = 20_000;

/// What does not repeat is looked at up to here.
const FARTHEST: f64 = 1e6;

/// A place in a period at which nothing of what people write changes.
const SOMEWHERE: f64 = 0.381_966_011_250_105_15;

/// Places closer than this share of their size are one.
const ONE_PLACE: f64 = 1e-13;

/// An expression of one variable, with its pieces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OfOne {
    program: Program,
    /// Places at which a piece ends, ascending; of one period where it repeats.
    pub(crate) points: Vec<f64>,
    /// Length after which the pieces repeat.
    pub(crate) period: Option<f64>,
    /// Modes of the guards on each piece: with a period piece k lies behind point k,
    /// else before it.
    modes: Vec<Vec<i64>>,
    /// What is added to the modes with each period.
    drifts: Vec<i64>,
    repetition: Option<Repetition>,
}

/// How the value of a function repeats over the whole of its variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Repetition {
    /// It is a straight line of this slope.
    Line(f64),
    /// f(x + period) = f(x) + advance.
    Cycles {
        /// Length of a cycle, above zero.
        period: f64,
        /// What the value gains in a cycle.
        advance: f64,
    },
}

impl Repetition {
    /// What follows from the operations of a function of variable 0; `None`: it does not
    /// repeat, or that it does cannot be proved from them.
    fn of(code: &Code) -> Option<Self> {
        Self::where_each(code, &|_| Some(Self::Line(1.0)))
    }

    /// The same of several variables that all follow one, each in its own way; `None`: one of
    /// them does not repeat.
    fn where_each(code: &Code, each: &dyn Fn(usize) -> Option<Self>) -> Option<Self> {
        let own = rhythm(code, &|variable| each(variable).map(Self::rhythm))?;
        Some(match own.period {
            None => Self::Line(own.drift),
            Some(period) => Self::Cycles {
                period,
                advance: own.drift * period,
            },
        })
    }

    /// How the value of a program repeats while its variables do; `None`: it does not, or its
    /// operations do not prove that it does.
    pub(crate) fn repetition_of_program(
        program: &Program,
        variables: &dyn Fn(usize) -> Option<Self>,
    ) -> Option<Self> {
        Self::where_each(&program.value, variables)
    }

    /// True where a piece of a program of what runs on evenly ends at one place and never
    /// again: `x < 2 ? 3*x : 6`.
    pub(crate) fn ends_a_piece_once(program: &Program) -> bool {
        let even = |_: usize| Some(Self::Line(1.0));
        program.guards.iter().any(|guard| {
            let own = Self::where_each(&guard.code, &even);
            matches!(guard.kind, GuardKind::Sign { .. })
                && matches!(own, Some(Self::Line(slope)) if slope != 0.0)
        })
    }

    fn rhythm(self) -> Rhythm {
        match self {
            Self::Line(drift) => Rhythm {
                period: None,
                drift,
            },
            Self::Cycles { period, advance } => Rhythm {
                period: Some(period),
                drift: advance / period,
            },
        }
    }
}

impl OfOne {
    /// Finds the pieces of a function of variable 0, from 0 on; those that do not repeat up
    /// to so many places. Beyond them it looks at its operands. Whether it found all.
    pub(crate) fn new(program: &Program, most: usize) -> (Self, bool) {
        let mut found = Self {
            program: program.clone(),
            points: Vec::new(),
            period: None,
            modes: vec![Vec::new()],
            drifts: vec![0; program.guards.len()],
            repetition: Repetition::of(&program.value),
        };
        if program.guards.is_empty() {
            return (found, true);
        }
        let rhythm = common(&program.guards);
        let (from, to) = match rhythm {
            Some(period) => (SOMEWHERE * period, (1.0 + SOMEWHERE) * period),
            None => (0.0, FARTHEST),
        };
        let (mut at, mut modes) = (from, located(program, from));
        found.modes[0].clone_from(&modes);
        while let Some((place, guard, target)) = next_guard_change(program, &modes, at, to) {
            let place = rhythm.map_or(place, |period| snap_to_period(place, period));
            let value = |own: usize, modes: &[i64]| {
                let x = Dual::new(place, 1.0);
                let mode = |one: u16| modes[usize::from(one)];
                program.guards[own].code.evaluate(&[x], &mode)
            };
            change_mode(&program.guards, guard, target, &mut modes, value);
            let last = found.points.last().copied();
            let same = last.is_some_and(|last| place - last <= ONE_PLACE * place.abs());
            match same {
                true => {
                    found.modes.pop();
                    found.modes.push(modes.clone());
                }
                false => {
                    found.points.push(place);
                    found.modes.push(modes.clone());
                }
            }
            if found.points.len() >= most {
                found.modes.pop();
                found.modes.push(vec![OPEN; modes.len()]);
                return (found, false);
            }
            at = place;
        }
        if let (Some(period), false) = (rhythm, found.points.is_empty()) {
            let first = &found.modes[0];
            found.drifts = modes
                .iter()
                .zip(first)
                .map(|(to, from)| to - from)
                .collect();
            found.period = Some(period);
            // The piece before the first point is the last of the period before.
            found.modes.remove(0);
        }
        (found, true)
    }

    /// How the value repeats, where its operations prove it.
    pub(crate) fn repetition(&self) -> Option<Repetition> {
        self.repetition
    }

    /// The value on a piece, so many periods on.
    pub(crate) fn at<N: Scalar>(&self, x: N, piece: usize, turn: i64) -> N {
        let modes = self.modes.get(piece);
        let mode = |guard: u16| {
            let guard = usize::from(guard);
            match modes.map(|modes| modes[guard]) {
                Some(mode) if mode != OPEN => mode + turn * self.drifts[guard],
                _ => OPEN,
            }
        };
        self.program.value.evaluate(&[x], &mode)
    }
}

/// A place that is the end of the period but for rounding is that end.
fn snap_to_period(place: f64, period: f64) -> f64 {
    match (place - period).abs() <= ONE_PLACE * period {
        true => period,
        false => place,
    }
}

/// A stretch of the variable itself.
struct Axis {
    from: f64,
    to: f64,
}

impl Stretch for Axis {
    fn at(&self, s: f64, out: &mut [f64]) {
        out[0] = self.from + s * (self.to - self.from);
    }

    fn over(&self, from: f64, to: f64, out: &mut [RateBounds]) {
        let length = self.to - self.from;
        out[0] = RateBounds {
            value: Interval::between(self.from + from * length, self.from + to * length),
            rate: Interval::of(length),
        };
    }
}

/// The modes just behind a place.
fn located(program: &Program, place: f64) -> Vec<i64> {
    let mut modes = vec![OPEN; program.guards.len()];
    for (index, guard) in program.guards.iter().enumerate() {
        let x = Dual::new(place, 1.0);
        let value = guard
            .code
            .evaluate(&[x], &|own: u16| modes[usize::from(own)]);
        modes[index] = guard.mode_at(value.value, value.derivative);
    }
    modes
}

/// The next change of a guard: its place, the guard and its mode behind.
fn next_guard_change(
    program: &Program,
    modes: &[i64],
    from: f64,
    to: f64,
) -> Option<(f64, usize, i64)> {
    // Pieces of a long way, so that places keep their digits.
    let mut start = from;
    let mut length = (to - from).min(1.0 + from.abs());
    while start < to {
        let end = (start + length).min(to);
        let axis = Axis {
            from: start,
            to: end,
        };
        let mode = |own: u16| modes[usize::from(own)];
        let mut first: Option<(f64, usize, i64)> = None;
        for (index, guard) in program.guards.iter().enumerate() {
            if modes[index] == OPEN {
                continue;
            }
            let limit = first.map_or(1.0, |first| first.0);
            let found =
                guard.first_crossing(modes[index], &mode, &axis, limit, (start == from, 0.0));
            if let Some(found) = found
                && first.is_none_or(|first| found.s < first.0)
            {
                first = Some((found.s, index, found.target));
            }
        }
        if let Some((s, guard, target)) = first {
            return Some((start + s * (end - start), guard, target));
        }
        start = end;
        length *= 2.0;
    }
    None
}

/// How a function repeats: f(x + period) = f(x) + drift·period.
#[derive(Clone, Copy, Debug)]
struct Rhythm {
    /// `None`: after any way.
    period: Option<f64>,
    drift: f64,
}

impl Rhythm {
    /// Of the variable itself.
    const ITSELF: Self = Self {
        period: None,
        drift: 1.0,
    };
}

/// The least period of several guards; `None`: they do not repeat.
fn common(guards: &[Guard]) -> Option<f64> {
    let mut all = None;
    for guard in guards {
        let own = rhythm(&guard.code, &|_| Some(Rhythm::ITSELF))?;
        let period = match (guard.kind, own.period) {
            (GuardKind::Sign { .. }, period) if own.drift == 0.0 => period,
            (GuardKind::Sign { .. }, _) => return None,
            (GuardKind::Whole, None) if own.drift != 0.0 => Some(1.0 / own.drift.abs()),
            (GuardKind::Whole, Some(period)) if is_whole(own.drift * period) => Some(period),
            (GuardKind::Whole, period) if own.drift == 0.0 => period,
            _ => return None,
        };
        all = least_common_period(all, period)?;
    }
    all
}

fn is_whole(x: f64) -> bool {
    (x - x.round()).abs() <= 1e-12 * x.abs().max(1.0)
}

/// The least whole number by which a number becomes whole.
fn whole_after(x: f64) -> Option<f64> {
    Fraction::of(x).map(|fraction| fraction.denominator as f64)
}

/// The least period of both; `None`: there is none.
#[allow(clippy::option_option)] // that there is none is not that any will do
fn least_common_period(a: Option<f64>, b: Option<f64>) -> Option<Option<f64>> {
    let (Some(p), Some(q)) = (a, b) else {
        return Some(a.or(b));
    };
    let ratio = Fraction::of(q / p)?;
    let one = Fraction::of(1.0)?;
    let common = one.common_multiple(ratio)?;
    Some(Some(p * common.value()))
}

/// The number that a result is.
fn number(code: &Code, register: Register) -> Option<f64> {
    match code.ops()[usize::from(register)] {
        Op::Number(value) => Some(value),
        _ => None,
    }
}

/// How the result of operations repeats while the variables do; `None`: it does not.
fn rhythm(code: &Code, variables: &dyn Fn(usize) -> Option<Rhythm>) -> Option<Rhythm> {
    let mut all: Vec<Rhythm> = Vec::new();
    for op in code.ops() {
        let at = |register: Register| all[usize::from(register)];
        let mut period = None;
        for operand in op.operands() {
            period = least_common_period(period, at(operand).period)?;
        }
        let still = op.operands().all(|operand| at(operand).drift == 0.0);
        let plain = Rhythm { period, drift: 0.0 };
        let found = match *op {
            Op::Number(_) => plain,
            Op::Variable(own) => variables(usize::from(own))?,
            Op::Affine { x, factor, .. } => Rhythm {
                period,
                drift: factor * at(x).drift,
            },
            Op::Div(a, b) if number(code, b).is_some() => Rhythm {
                period,
                drift: at(a).drift / number(code, b).unwrap_or(1.0),
            },
            Op::Add(a, b) | Op::Sub(a, b) => {
                let sign = if matches!(op, Op::Add(..)) { 1.0 } else { -1.0 };
                let drift = at(a).drift + sign * at(b).drift;
                let size = at(a).drift.abs() + at(b).drift.abs();
                let none = drift.abs() <= 1e-14 * size;
                Rhythm {
                    period,
                    drift: if none { 0.0 } else { drift },
                }
            }
            Op::Min { a, b, .. } | Op::Max { a, b, .. } if at(a).drift == at(b).drift => Rhythm {
                period,
                drift: at(a).drift,
            },
            Op::Less { a, b, .. } if at(a).drift == at(b).drift => plain,
            Op::Select { condition, a, b }
                if at(condition).drift == 0.0 && at(a).drift == at(b).drift =>
            {
                Rhythm {
                    period,
                    drift: at(a).drift,
                }
            }
            Op::Of(Function::Sin | Function::Cos | Function::Tan, x) if at(x).drift != 0.0 => {
                match at(x).period {
                    None => Rhythm {
                        period: Some(TAU / at(x).drift.abs()),
                        drift: 0.0,
                    },
                    Some(own) if is_whole(own * at(x).drift / TAU) => plain,
                    // Some whole turns later it is a whole number of them.
                    Some(own) => Rhythm {
                        period: Some(own * whole_after((own * at(x).drift / TAU).abs())?),
                        drift: 0.0,
                    },
                }
            }
            Op::Whole { x, .. } if at(x).drift != 0.0 => match at(x).period {
                None => Rhythm {
                    period: Some(1.0 / at(x).drift.abs()),
                    drift: at(x).drift,
                },
                Some(own) if is_whole(own * at(x).drift) => at(x),
                Some(_) => return None,
            },
            Op::Remainder { x, y, .. } if at(x).period.is_none() && at(x).drift != 0.0 => {
                let divisor = number(code, y)?;
                Rhythm {
                    period: Some((divisor / at(x).drift).abs()),
                    drift: 0.0,
                }
            }
            _ if still => plain,
            _ => return None,
        };
        all.push(found);
    }
    all.last().copied()
}

#[cfg(test)]
mod tests {
    use super::OfOne;
    use crate::math::expression::Expression;
    use std::f64::consts::{FRAC_PI_2, PI, TAU};

    fn pieces(text: &str) -> (OfOne, Expression) {
        let expression = Expression::new(text, &["t"]).unwrap();
        let found = OfOne::new(expression.program(), 100);
        assert!(found.1, "{text}");
        let found = found.0;
        (found, expression)
    }

    #[test]
    fn pieces_repeat_where_the_expression_does() {
        for (text, period, count) in [
            ("t^2*sin(t)", None, 0),
            ("t < 2 ? 3*t : 6", None, 1),
            ("abs(sin(2*pi*5*t))", Some(0.2), 2),
            ("floor(t/0.3)*0.1 + t", Some(0.3), 1),
            ("(t % 0.2) < 0.05 ? 1 : 0", Some(0.2), 2),
            ("max(0, sin(10*pi*t)) + max(0, sin(15*pi*t))", Some(0.4), 8),
            ("sin(2*pi*t) > 0.5 ? 1 : 0", Some(1.0), 2),
            ("abs(t^2 - 2) + max(t, 5)", None, 2),
            ("fract(4*t)", Some(0.25), 1),
            ("round(t) + ceil(3*t)", Some(1.0), 4),
        ] {
            let (found, _) = pieces(text);
            match (period, found.period) {
                (Some(wanted), Some(own)) => {
                    approx::assert_relative_eq!(own, wanted, max_relative = 1e-13);
                }
                (wanted, own) => assert_eq!(wanted, own, "{text}"),
            }
            assert_eq!(found.points.len(), count, "{text}: {:?}", found.points);
        }
    }

    #[test]
    fn a_value_of_several_variables_repeats_as_they_do_together() {
        use super::Repetition::{self, Cycles, Line};
        // Per unit of what all follow: t runs on, x swings, y does both.
        let variables = |index: usize| {
            Some(match index {
                0 => Line(0.5),
                1 => Cycles {
                    period: TAU,
                    advance: 0.0,
                },
                _ => Cycles {
                    period: PI,
                    advance: PI,
                },
            })
        };
        let of = |text: &str| {
            let expression = Expression::new(text, &["t", "x", "y"]).unwrap();
            Repetition::repetition_of_program(expression.program(), &variables)
        };
        for (text, wanted) in [
            ("sin(t)", Some(2.0)),
            ("sin(t + x)", Some(2.0)),
            ("sin(2*t)*x", Some(1.0)),
            ("x^2", Some(1.0)),
            ("sin(y)", Some(1.0)),
            ("sin(2*t - y)", Some(0.5)),
            ("y - 2*t", Some(0.5)),
            ("sin(sqrt(2)*t) + x", None),
            ("exp(-t)", None),
            ("t*x", None),
        ] {
            match (of(text), wanted) {
                (Some(Cycles { period, advance }), Some(turns)) => {
                    approx::assert_relative_eq!(period, turns * TAU, max_relative = 1e-13);
                    approx::assert_abs_diff_eq!(advance, 0.0, epsilon = 1e-13);
                }
                (found, wanted) => {
                    assert!(found.is_none() && wanted.is_none(), "{text}: {found:?}")
                }
            }
        }
        let unknown = |index: usize| (index == 0).then_some(Line(1.0));
        let expression = Expression::new("sin(t) + x", &["t", "x"]).unwrap();
        assert_eq!(
            Repetition::repetition_of_program(expression.program(), &unknown),
            None
        );
    }

    #[test]
    fn a_value_repeats_only_where_its_operations_prove_it() {
        use super::Repetition::{Cycles, Line};
        for (text, wanted) in [
            ("3", Some(Line(0.0))),
            ("2*t + 1", Some(Line(2.0))),
            (
                "0.3*sin(20*t)",
                Some(Cycles {
                    period: TAU / 20.0,
                    advance: 0.0,
                }),
            ),
            (
                "20*t + 0.5*sin(5*t)",
                Some(Cycles {
                    period: TAU / 5.0,
                    advance: 8.0 * PI,
                }),
            ),
            (
                "((t%1)*(1-t%1))^3",
                Some(Cycles {
                    period: 1.0,
                    advance: 0.0,
                }),
            ),
            (
                "floor(t)*pi/2 + (t%1)^3",
                Some(Cycles {
                    period: 1.0,
                    advance: FRAC_PI_2,
                }),
            ),
            ("t^2", None),
            ("exp(-t)", None),
            ("t*sin(t)", None),
            ("sin(t) + sin(sqrt(2)*t)", None),
            ("t < 100 ? sin(t) : 0", None),
            ("tanh(t - 3)", None),
        ] {
            let (found, expression) = pieces(text);
            match (found.repetition(), wanted) {
                (Some(Line(own)), Some(Line(slope))) => {
                    approx::assert_relative_eq!(own, slope, epsilon = 1e-14);
                }
                (
                    Some(Cycles { period, advance }),
                    Some(Cycles {
                        period: p,
                        advance: a,
                    }),
                ) => {
                    approx::assert_relative_eq!(period, p, max_relative = 1e-14);
                    approx::assert_relative_eq!(advance, a, epsilon = 1e-13, max_relative = 1e-13);
                    for k in 0..50 {
                        let t = 0.0123 + 0.137 * f64::from(k);
                        let gained = expression.at(&[t + period]) - expression.at(&[t]);
                        approx::assert_relative_eq!(gained, advance, epsilon = 1e-12);
                    }
                }
                (own, wanted) => assert_eq!(own, wanted, "{text}"),
            }
        }
    }

    #[test]
    fn every_piece_has_the_value_of_the_expression() {
        for text in [
            "t < 2 ? 3*t : 6",
            "abs(sin(2*pi*5*t))",
            "floor(t/0.3)*0.1 + t",
            "(t % 0.2) < 0.05 ? 1 : 0",
            "max(0, sin(10*pi*t)) + max(0, sin(15*pi*t))",
            "abs(t^2 - 2) + max(t, 5)",
            "fract(4*t) - ceil(3*t)*t",
            "floor(t) > 2 ? floor(2*t) : t",
        ] {
            let (found, expression) = pieces(text);
            for k in 0..400 {
                let t = 0.0137 + f64::from(k) * 0.0171;
                let (piece, turn) = match found.period {
                    None => (found.points.partition_point(|&point| point <= t), 0),
                    Some(period) => {
                        let turn = ((t - found.points[0]) / period).floor();
                        let place = t - turn * period;
                        let behind = found.points.partition_point(|&point| point <= place);
                        (behind - 1, turn as i64)
                    }
                };
                let own = found.at(t, piece, turn);
                approx::assert_relative_eq!(own, expression.at(&[t]), epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn what_changes_without_end_and_without_period_is_not_followed() {
        let expression = Expression::new("abs(sin(1000*t)) + abs(t - 3)", &["t"]).unwrap();
        let (found, whole) = OfOne::new(expression.program(), 100);
        assert!(!whole && found.points.len() == 100);
        // Beyond what was followed it has its values all the same.
        for t in [0.1, 0.5, 20.0] {
            let piece = found.points.partition_point(|&point| point <= t);
            let own = found.at(t, piece, 0);
            approx::assert_relative_eq!(own, expression.at(&[t]), epsilon = 1e-12);
        }
    }
}
