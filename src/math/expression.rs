//! Expressions over named variables, written as text: `1.5 + 0.2*cos(phi)`.
//!
//! Numbers (`2`, `.5`, `1.5e-3`), `+ - * / % ^`, parentheses, comparisons
//! (`< <= > >= == !=`, worth 1 or 0), `&& || !`, the conditional `c ? a : b`,
//! the constants [`CONSTANTS`] and the functions [`FUNCTIONS`]. As in
//! mathematics, `-2^2` is −4 and `2^3^2` is 2⁹.
//!
//! A text is read once (`read`) into a list of operations (`program`), which is
//! evaluated without allocating: on numbers, on numbers with derivatives, on bounds
//! (`interval`) and as a power series (`ordered`). Where it has kinks and jumps
//! (`crossing`) it can be told which piece is in force.

mod affine;
mod bounds;
mod builder;
mod crossing;
mod enclosed;
mod evaluate;
mod function;
mod interval;
mod moving;
mod of_one;
mod ordered;
#[cfg(test)]
mod other_reader_tests;
mod program;
mod read;
mod third;

use read::Wrong;
use std::f64::consts::{E, PI, TAU};
use std::ops::Range;
use std::sync::Arc;

pub(crate) use affine::Affine;
pub(crate) use crossing::{Stretch, VARIABLES, change_mode};
pub(crate) use enclosed::TaylorBounds;
pub(crate) use evaluate::Scalar;
pub(crate) use function::Function;
pub(crate) use interval::Interval;
pub(crate) use moving::RateBounds;
pub(crate) use of_one::{MOST, OfOne, Repetition};
pub(crate) use ordered::{SeriesProgram, taylor_about};
pub(crate) use program::{Code, OPEN, Op, Program};
pub(crate) use third::Third;

/// Constants that an expression knows, with their values.
pub const CONSTANTS: [(&str, f64); 7] = [
    ("PI", PI),
    ("pi", PI),
    ("π", PI),
    ("TAU", TAU),
    ("τ", TAU),
    ("E", E),
    ("e", E),
];

/// Functions of one argument that have kinks or jumps.
const PIECES: [&str; 8] = [
    "abs", "signum", "sign", "floor", "ceil", "round", "trunc", "fract",
];

/// Names of all functions, as a message lists them.
pub const FUNCTIONS: &str = "sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, \
     acosh, atanh, exp, ln, log (natural), log10, log2, sqrt, cbrt, abs, sign, signum, min, max, \
     floor, ceil, round, trunc, fract";

/// Longest text that is read, in bytes.
const LONGEST: usize = 2000;

/// Variables by name, each with the index of its value: several names may mean one.
pub(crate) type Names<'a> = [(&'a str, usize)];

/// What a name in a text stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Symbol {
    /// A variable, by the index of its value.
    Variable(usize),
    Number(f64),
}

/// The names that a text may use, and the numbers with units, where it may have any.
pub(crate) trait Symbols {
    fn symbol(&mut self, name: &str) -> Option<Symbol>;

    /// The number with a unit that a text begins with: its length, and what it stands for.
    fn quantity(&mut self, _text: &str) -> Option<(usize, Symbol)> {
        None
    }

    /// Length of a name at the start of a text that has more than letters and digits.
    fn long_name_length(&self, _text: &str) -> Option<usize> {
        None
    }

    /// The names, as a message lists them.
    fn names(&self) -> Vec<String>;
}

/// Variables alone.
struct Variables<'a>(&'a Names<'a>);

impl Symbols for Variables<'_> {
    fn symbol(&mut self, name: &str) -> Option<Symbol> {
        let found = self.0.iter().find(|(known, _)| *known == name);
        found.map(|(_, index)| Symbol::Variable(*index))
    }

    fn names(&self) -> Vec<String> {
        self.0.iter().map(|(name, _)| (*name).to_owned()).collect()
    }
}

/// A function of named variables, written as an expression.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    program: Arc<Program>,
    /// The program in the making, and its result: what others are made of.
    builder: Arc<builder::Builder>,
    root: program::Register,
    unlocated: Option<Range<usize>>,
}

/// Two are equal that are written alike, over the same variables.
impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text && self.program == other.program
    }
}

/// A mistake in an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Message with the place in words.
    pub message: String,
    /// Hint at what would be right; empty where nothing can be said.
    pub hint: String,
    /// The bytes of the text that are wrong.
    pub place: Range<usize>,
}

impl Expression {
    /// Reads `text`, an expression over `variables`.
    ///
    /// # Errors
    /// The first mistake: of the syntax, an unknown name or a wrong number of arguments,
    /// also in a branch of a conditional that is never taken.
    pub fn new(text: &str, variables: &[&str]) -> Result<Self, Mistake> {
        let names: Vec<(&str, usize)> = variables.iter().copied().zip(0..).collect();
        Self::parse_over_names(text, &names)
    }

    /// Reads `text`, an expression over variables that may have several names.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn parse_over_names(text: &str, names: &Names<'_>) -> Result<Self, Mistake> {
        Self::parse_with_symbols(text, &mut Variables(names))
    }

    /// Reads `text`, an expression over whatever its names stand for.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn parse_with_symbols(
        text: &str,
        symbols: &mut dyn Symbols,
    ) -> Result<Self, Mistake> {
        if text.len() > LONGEST {
            let mut start = LONGEST;
            while !text.is_char_boundary(start) {
                start -= 1;
            }
            return Err(Mistake {
                message: format!("longer than {LONGEST} characters"),
                hint: String::new(),
                place: start..text.len(),
            });
        }
        let found = read::read(text, symbols);
        let found = found.map_err(|error| mistake(text, &symbols.names(), &error))?;
        Ok(Self {
            text: text.to_owned(),
            program: Arc::new(found.program),
            builder: Arc::new(found.builder),
            root: found.root,
            unlocated: found.unlocated,
        })
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value where the variables have these values, in the order of their
    /// names; NaN where there is none.
    pub fn at(&self, values: &[f64]) -> f64 {
        self.program.value.evaluate(values, &|_| OPEN)
    }

    /// Its operations.
    pub(crate) fn program(&self) -> &Arc<Program> {
        &self.program
    }

    /// What of it is linear in some variables, if nothing else of it depends on them.
    pub(crate) fn affine_in(&self, variables: &[usize]) -> Option<Affine> {
        affine::of(&self.builder, self.root, variables)
    }

    /// The program with each variable replaced by slope·x + shift of variable 0; `None`
    /// for a variable that must not count.
    pub(crate) fn along_a_line(program: &Program, lines: &[Option<[f64; 2]>]) -> Option<Program> {
        affine::along_a_line(program, lines)
    }

    /// The first place that cannot be a switch, told as a mistake: whether two numbers
    /// that change continuously are just equal, or whether such a number is just zero.
    ///
    /// # Errors
    /// That mistake.
    pub(crate) fn switches(&self) -> Result<(), Mistake> {
        let Some(place) = &self.unlocated else {
            return Ok(());
        };
        let words = self.text.get(place.clone()).unwrap_or_default().trim();
        let at = self
            .text
            .get(..place.start)
            .map_or(0, |s| s.chars().count())
            + 1;
        let what = match words {
            "==" | "!=" => format!("`{words}` of what changes continuously"),
            _ => format!("`{words}` takes what changes continuously as true or false"),
        };
        Err(Mistake {
            message: format!("\"{}\", character {at}: {what}", self.text),
            hint: "compare with `<` or `>`: t < 2 ? 1 : 0".to_owned(),
            place: place.clone(),
        })
    }
}

/// How what other languages call `if` is written.
const CONDITION: &str = "a condition is written `phi < pi ? sin(phi) : 0`";

/// True for a text with an `if` in it, as spreadsheets have it.
fn asks_if(text: &str) -> bool {
    let mut words = text.split(|letter: char| !letter.is_alphanumeric());
    words.any(|word| word.eq_ignore_ascii_case("if"))
}

fn mistake(text: &str, known: &[String], (wrong, place): &read::Error) -> Mistake {
    let words = text.get(place.clone()).unwrap_or_default();
    let (what, hint) = match wrong {
        Wrong::Variable => {
            let hint = match known.is_empty() {
                true => "known are the constants pi, tau, e".to_owned(),
                false => format!(
                    "known are {} and the constants pi, tau, e",
                    known.join(", ")
                ),
            };
            (format!("`{words}` is not known"), hint)
        }
        Wrong::Function if words == "if" => {
            (format!("`{words}` is no function"), CONDITION.to_owned())
        }
        Wrong::Function => (
            format!("`{words}` is no function"),
            format!("the functions are {FUNCTIONS}"),
        ),
        Wrong::Arguments => (
            format!("`{words}` has a wrong number of arguments"),
            match asks_if(text) {
                true => CONDITION.to_owned(),
                false => "atan2, min and max take two, the others one".to_owned(),
            },
        ),
        Wrong::End => ("the expression ends too early".to_owned(), String::new()),
        Wrong::Parenthesis => ("this `(` is not closed".to_owned(), String::new()),
        Wrong::Token if place.start > 0 => (
            format!("`{words}` cannot stand here"),
            "between two operands stands an operator: 2*phi, sin(phi)".to_owned(),
        ),
        Wrong::Token | Wrong::Character => (format!("`{words}` cannot stand here"), String::new()),
        Wrong::Number => ("invalid number".to_owned(), String::new()),
        Wrong::Factorial => (
            format!("`{words}`: only whole numbers up to 170 have a factorial"),
            String::new(),
        ),
        Wrong::TooDeep => ("expression nested too deeply".to_owned(), String::new()),
        Wrong::TooLong => ("too many operations".to_owned(), String::new()),
    };
    let at = text.get(..place.start).unwrap_or(text).chars().count() + 1;
    Mistake {
        message: format!("\"{text}\", character {at}: {what}"),
        hint,
        place: place.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::function::SMOOTH;
    use super::{CONSTANTS, Expression, FUNCTIONS, PIECES};

    fn value(text: &str, x: f64) -> f64 {
        let expression = Expression::new(text, &["x", "φ"]).unwrap();
        expression.at(&[x, 10.0 * x])
    }

    #[test]
    fn values_are_those_of_the_formulas_written_in_rust() {
        let x = 0.7f64;
        for (text, wanted) in [
            ("3", 3.0),
            (
                "1.5 + 0.2*cos(x) - 2^x/PI",
                1.5 + 0.2 * x.cos() - 2f64.powf(x) / std::f64::consts::PI,
            ),
            ("2e-3 + .5E2 + 1e+1 - 4.", 2e-3 + 50.0 + 10.0 - 4.0),
            ("-2^2", -4.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("7 - 2 - 1 + 12/3/2*5", 14.0),
            ("x < 1 ? x*2 : 1/0", 1.4),
            ("x > 1 ? 1 : x > 0.5 ? 2 : 3", 2.0),
            (
                "(x >= 0.7) + (x != 0.7) + (x <= 0.6 || x == 0.7 && !0)",
                2.0,
            ),
            ("7 % 4 + 4!", 27.0),
            ("φ/x + 2*φ", 24.0),
            ("π - pi + τ - TAU + E - e", 0.0),
            ("max(x, 2) + min(x, 2) + atan2(1, x)", 2.7 + 1f64.atan2(x)),
        ] {
            approx::assert_relative_eq!(value(text, x), wanted, max_relative = 1e-15);
        }
        assert!(value("sqrt(x - 1)", x).is_nan());
        assert!(value("sqrt(x - 1) > 0 ? 1 : 2", x).is_nan());
    }

    #[test]
    fn mistakes_are_told_with_their_place() {
        for (text, place, word) in [
            ("", 0..0, "ends"),
            ("1 +", 3..3, "ends"),
            ("2*psi", 2..5, "`psi` is not known"),
            ("1 + sin(", 8..8, "ends"),
            ("π*(x + 1", 3..4, "not closed"),
            ("φ + foo(x)", 5..8, "`foo` is no function"),
            ("x > 1 ? 1 : bar", 12..15, "`bar` is not known"),
            ("x > 1 ? (x < 2 ? 1 : u) : 2", 21..22, "`u` is not known"),
            ("x || y", 5..6, "`y` is not known"),
            ("0 && sin(x, x)", 5..14, "arguments"),
            ("sin()", 0..5, "arguments"),
            ("max(1, 2, 3)", 10..11, "arguments"),
            ("2 x", 2..3, "cannot stand"),
            ("sin x", 4..5, "cannot stand"),
            ("x_f", 0..3, "`x_f` is not known"),
            ("2..3", 2..4, "cannot stand"),
            ("1e999", 0..5, "invalid number"),
            ("x = 3", 2..3, "cannot stand"),
        ] {
            let mistake = Expression::new(text, &["x", "φ"]).unwrap_err();
            assert_eq!(mistake.place, place, "{text}: {mistake:?}");
            assert!(mistake.message.contains(word), "{text}: {mistake:?}");
        }
        let long = Expression::new(&"1+".repeat(2000), &["x"]).unwrap_err();
        assert!(long.message.contains("longer"));
        let deep = format!("{}x{}", "(".repeat(900), ")".repeat(900));
        let deep = Expression::new(&deep, &["x"]).unwrap_err();
        assert!(deep.message.contains("nested too deeply"), "{deep:?}");
        assert_eq!(
            value(&format!("{}x{}", "(".repeat(200), ")".repeat(200)), 0.7),
            0.7
        );
    }

    #[test]
    fn every_function_and_constant_is_known_and_listed() {
        let listed: Vec<&str> = FUNCTIONS
            .split(", ")
            .map(|name| name.split(' ').next().unwrap())
            .collect();
        for name in SMOOTH.iter().map(|(name, _)| *name).chain(PIECES) {
            assert!(listed.contains(&name), "{name}");
            let _ = value(&format!("{name}(x)"), 0.6);
        }
        for name in ["atan2", "min", "max"] {
            assert!(listed.contains(&name), "{name}");
            let _ = value(&format!("{name}(x, 2)"), 0.6);
        }
        assert_eq!(listed.len(), SMOOTH.len() + PIECES.len() + 3);
        let x = 0.6f64;
        for (text, wanted) in [
            ("sin(x)", x.sin()),
            ("cos(x)", x.cos()),
            ("tan(x)", x.tan()),
            ("asin(x)", x.asin()),
            ("acos(x)", x.acos()),
            ("atan(x)", x.atan()),
            ("sinh(x)", x.sinh()),
            ("cosh(x)", x.cosh()),
            ("tanh(x)", x.tanh()),
            ("asinh(x)", x.asinh()),
            ("acosh(1/x)", (1.0 / x).acosh()),
            ("atanh(x)", x.atanh()),
            ("exp(x)", x.exp()),
            ("ln(x)", x.ln()),
            ("log(x)", x.ln()),
            ("log10(x)", x.log10()),
            ("log2(x)", x.log2()),
            ("sqrt(x)", x.sqrt()),
            ("cbrt(x)", x.cbrt()),
            ("abs(-x)", x),
            ("sign(-x) + signum(x)", 0.0),
            ("floor(-x)", -1.0),
            ("ceil(-x)", 0.0),
            ("round(-x)", -1.0),
            ("trunc(-x)", 0.0),
            ("fract(-x)", -x),
            ("atan2(-x, -2)", (-x).atan2(-2.0)),
        ] {
            approx::assert_relative_eq!(value(text, x), wanted, epsilon = 1e-15);
        }
        for (name, wanted) in CONSTANTS {
            assert_eq!(value(name, 0.6), wanted);
        }
    }
}
