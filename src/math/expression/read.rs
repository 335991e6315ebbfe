//! From the text of an expression to its program, by climbing precedences.

mod tokens;

use super::builder::Builder;
use super::function::SMOOTH;
use super::program::{Op, Program, Register, Rounding};
use super::{CONSTANTS, Symbol, Symbols};
use std::ops::Range;
use tokens::Token;

/// How deep parentheses, calls and operators may nest.
const DEEPEST: usize = 256;

/// Kind of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    Character,
    Token,
    End,
    Parenthesis,
    Number,
    Variable,
    Function,
    Arguments,
    Factorial,
    TooDeep,
    TooLong,
}

/// A mistake and where it is, in bytes.
pub(super) type Error = (Wrong, Range<usize>);

/// What a text says.
#[derive(Clone, Debug)]
pub(super) struct ParseResult {
    pub(super) program: Program,
    pub(super) builder: Builder,
    pub(super) root: Register,
    /// The first place where a value counts as true or false that changes without a jump.
    pub(super) unlocated: Option<Range<usize>>,
}

/// Precedence from the left and from the right of what stands between operands.
fn precedence(symbol: &str) -> Option<(u8, u8)> {
    Some(match symbol {
        "?" => (2, 1),
        "||" => (3, 4),
        "&&" => (5, 6),
        "==" | "!=" => (7, 8),
        "<" | "<=" | ">" | ">=" => (9, 10),
        "+" | "-" => (11, 12),
        "*" | "/" | "%" | "·" => (13, 14),
        "^" | "**" => (18, 17),
        "!" => (19, 19),
        _ => return None,
    })
}

/// Precedence of a sign before an operand.
const SIGN: u8 = 15;

/// Reads a text.
pub(super) fn read(text: &str, symbols: &mut dyn Symbols) -> Result<ParseResult, Error> {
    let mut reader = Reader {
        text,
        symbols,
        position: 0,
        token: Token::End,
        place: 0..0,
        end: 0,
        depth: 0,
        builder: Builder::default(),
        unlocated: None,
        unknown: None,
    };
    reader.next_token()?;
    let root = reader.expression(0)?;
    if reader.token != Token::End {
        return Err((Wrong::Token, reader.place));
    }
    if let Some(unknown) = reader.unknown {
        return Err(unknown);
    }
    if reader.builder.overflows {
        return Err((Wrong::TooLong, 0..text.len()));
    }
    Ok(ParseResult {
        program: reader.builder.finish(root),
        builder: reader.builder,
        root,
        unlocated: reader.unlocated,
    })
}

struct Reader<'t, 's> {
    text: &'t str,
    symbols: &'s mut dyn Symbols,
    position: usize,
    /// The token that comes next, and where it is.
    token: Token<'t>,
    place: Range<usize>,
    /// End of the token before.
    end: usize,
    depth: usize,
    builder: Builder,
    unlocated: Option<Range<usize>>,
    /// The first name that is not known: what is wrong with the syntax comes first.
    unknown: Option<Error>,
}

impl Reader<'_, '_> {
    fn expression(&mut self, least: u8) -> Result<Register, Error> {
        if self.depth == DEEPEST {
            return Err((Wrong::TooDeep, self.place.clone()));
        }
        self.depth += 1;
        let start = self.place.start;
        let mut left = self.operand()?;
        while let Token::Symbol(symbol) = self.token
            && let Some((before, after)) = precedence(symbol)
            && before >= least
        {
            let place = self.place.clone();
            self.next_token()?;
            left = match symbol {
                "!" => self.factorial(left, start..self.end)?,
                "?" => self.conditional(left, start..place.start)?,
                _ => {
                    let right = self.expression(after)?;
                    self.binary(symbol, [left, right], place)
                }
            };
        }
        self.depth -= 1;
        Ok(left)
    }

    fn conditional(&mut self, condition: Register, place: Range<usize>) -> Result<Register, Error> {
        self.require_truth_value(condition, &place);
        let a = self.expression(0)?;
        match self.token {
            Token::Symbol(":") => self.next_token()?,
            Token::End => return Err((Wrong::End, self.place.clone())),
            _ => return Err((Wrong::Token, self.place.clone())),
        };
        let b = self.expression(1)?;
        Ok(self.builder.select(condition, a, b))
    }

    fn factorial(&mut self, x: Register, place: Range<usize>) -> Result<Register, Error> {
        let known = self.builder.constant_of(x);
        let whole = known.filter(|n| *n >= 0.0 && n.fract() == 0.0 && *n <= 170.0);
        let Some(n) = whole else {
            return Err((Wrong::Factorial, place));
        };
        let product = (1..=n as u32).map(f64::from).product();
        Ok(self.builder.number(product))
    }

    fn operand(&mut self) -> Result<Register, Error> {
        let place = self.place.clone();
        let token = self.next_token()?;
        match token {
            Token::Number(digits) => match digits.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(self.builder.number(value)),
                _ => Err((Wrong::Number, place)),
            },
            Token::Quantity(symbol) => Ok(self.register(symbol)),
            Token::Name(name) if self.token == Token::Symbol("(") => self.call(name, place),
            Token::Name(name) => match self.read_name(name) {
                Some(register) => Ok(register),
                None => Ok(self.not_known((Wrong::Variable, place))),
            },
            Token::Symbol("(") => {
                let value = self.expression(0)?;
                self.close(place)?;
                Ok(value)
            }
            Token::Symbol("-") => {
                let x = self.expression(SIGN)?;
                Ok(self.builder.affine(x, -1.0, 0.0))
            }
            Token::Symbol("+") => self.expression(SIGN),
            Token::Symbol("!") => {
                let x = self.expression(SIGN)?;
                self.require_truth_value(x, &(place.end..self.end));
                Ok(self.builder.operation_on_operands(Op::Not(x)))
            }
            Token::End => Err((Wrong::End, place)),
            Token::Symbol(_) => Err((Wrong::Token, place)),
        }
    }

    fn not_known(&mut self, error: Error) -> Register {
        self.unknown.get_or_insert(error);
        self.builder.number(0.0)
    }

    fn read_name(&mut self, name: &str) -> Option<Register> {
        if let Some(symbol) = self.symbols.symbol(name) {
            return Some(self.register(symbol));
        }
        let (_, value) = CONSTANTS.iter().find(|(known, _)| *known == name)?;
        Some(self.builder.number(*value))
    }

    fn register(&mut self, symbol: Symbol) -> Register {
        match symbol {
            Symbol::Variable(index) => self.builder.variable(index),
            Symbol::Number(value) => self.builder.number(value),
        }
    }

    fn close(&mut self, opening: Range<usize>) -> Result<(), Error> {
        match self.token {
            Token::Symbol(")") => self.next_token().map(drop),
            Token::End => Err((Wrong::Parenthesis, opening)),
            _ => Err((Wrong::Token, self.place.clone())),
        }
    }

    fn call(&mut self, name: &str, place: Range<usize>) -> Result<Register, Error> {
        let opening = self.place.clone();
        self.next_token()?;
        let mut arguments = Vec::new();
        if self.token != Token::Symbol(")") {
            loop {
                let start = self.place.start;
                let value = self.expression(0)?;
                if arguments.len() == 2 {
                    return Err((Wrong::Arguments, start..self.end));
                }
                arguments.push(value);
                if self.token != Token::Symbol(",") {
                    break;
                }
                self.next_token()?;
            }
        }
        self.close(opening)?;
        let whole = place.start..self.end;
        match self.function(name, &arguments) {
            Some(Some(value)) => Ok(value),
            Some(None) => Ok(self.not_known((Wrong::Arguments, whole))),
            None => Ok(self.not_known((Wrong::Function, place))),
        }
    }

    /// A function of arguments; `None`: no such function, `Some(None)`: not of so many.
    fn function(&mut self, name: &str, arguments: &[Register]) -> Option<Option<Register>> {
        let builder = &mut self.builder;
        let two = matches!(name, "atan2" | "min" | "max");
        let smooth = SMOOTH.iter().find(|(known, _)| *known == name);
        let one = smooth.is_some() || super::PIECES.contains(&name);
        if !(one || two) {
            return None;
        }
        Some(match (arguments, smooth) {
            (&[x], Some(&(_, function))) => Some(builder.of(function, x)),
            (&[x], None) if one => Some(match name {
                "abs" => builder.abs(x),
                "signum" | "sign" => builder.sign(x),
                "floor" => builder.round_to_integer(x, Rounding::Floor),
                "ceil" => builder.round_to_integer(x, Rounding::Ceil),
                "round" => builder.round_to_integer(x, Rounding::Round),
                "trunc" => builder.round_to_integer(x, Rounding::Trunc),
                _ => {
                    let whole = builder.round_to_integer(x, Rounding::Trunc);
                    builder.sub(x, whole)
                }
            }),
            (&[a, b], None) if two => Some(match name {
                "atan2" => builder.atan2(a, b),
                "min" => builder.min(a, b),
                _ => builder.max(a, b),
            }),
            _ => None,
        })
    }

    fn binary(&mut self, symbol: &str, [a, b]: [Register; 2], place: Range<usize>) -> Register {
        let builder = &mut self.builder;
        match symbol {
            "+" => builder.add(a, b),
            "-" => builder.sub(a, b),
            "*" | "·" => builder.mul(a, b),
            "/" => builder.div(a, b),
            "%" => builder.remainder(a, b),
            "^" | "**" => builder.power(a, b),
            "<" => builder.less(a, b, false),
            "<=" => builder.less(a, b, true),
            ">" => builder.less(b, a, false),
            ">=" => builder.less(b, a, true),
            "&&" | "||" => {
                self.require_truth_value(a, &place);
                self.require_truth_value(b, &place);
                self.builder.operation_on_operands(match symbol {
                    "&&" => Op::And(a, b),
                    _ => Op::Or(a, b),
                })
            }
            _ => {
                if !(builder.changes_by_jumps(a) && builder.changes_by_jumps(b)) {
                    self.note_place(place);
                }
                let equal = self.builder.operation_on_operands(Op::Equal(a, b));
                match symbol {
                    "==" => equal,
                    _ => self.builder.operation_on_operands(Op::Not(equal)),
                }
            }
        }
    }

    /// A value that counts as true or false.
    fn require_truth_value(&mut self, x: Register, place: &Range<usize>) {
        if !self.builder.changes_by_jumps(x) {
            self.note_place(place.clone());
        }
    }

    fn note_place(&mut self, place: Range<usize>) {
        self.unlocated.get_or_insert(place);
    }
}
