//! Expressions over named variables, written as text: `1.5 + 0.2*cos(phi)`.
//!
//! Numbers (`2`, `.5`, `1.5e-3`), `+ - * / % ^`, parentheses, comparisons
//! (`< <= > >= == !=`, worth 1 or 0), `&& || !`, the conditional `c ? a : b`,
//! the constants [`CONSTANTS`] and the functions [`FUNCTIONS`]. As in
//! mathematics, `-2^2` is −4 and `2^3^2` is 2⁹.
//!
//! The text is read by `nanoexpr` at every evaluation, without allocating: what
//! is kept is the text.

mod evaluate;

use evaluate::{Known, Names, Nothing, Real};
use nanoexpr::{Error, ErrorKind, Evaluator};
use std::f64::consts::{E, PI, TAU};
use std::ops::Range;

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

/// A function of one number.
type OfOne = fn(f64) -> f64;

/// A function of two numbers.
type OfTwo = fn(f64, f64) -> f64;

/// Functions of one argument that an expression knows.
const OF_ONE: [(&str, OfOne); 26] = [
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("tanh", f64::tanh),
    ("asinh", f64::asinh),
    ("acosh", f64::acosh),
    ("atanh", f64::atanh),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("log", f64::ln),
    ("log10", f64::log10),
    ("log2", f64::log2),
    ("sqrt", f64::sqrt),
    ("cbrt", f64::cbrt),
    ("abs", f64::abs),
    ("signum", f64::signum),
    ("floor", f64::floor),
    ("ceil", f64::ceil),
    ("round", f64::round),
    ("trunc", f64::trunc),
    ("fract", f64::fract),
];

/// Functions of two arguments that an expression knows.
const OF_TWO: [(&str, OfTwo); 3] = [("atan2", f64::atan2), ("min", f64::min), ("max", f64::max)];

/// Names of all functions, as a message lists them.
pub const FUNCTIONS: &str = "sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, asinh, \
     acosh, atanh, exp, ln, log (natural), log10, log2, sqrt, cbrt, abs, signum, min, max, floor, \
     ceil, round, trunc, fract";

/// Longest text that is read, in bytes.
const LONGEST: usize = 2000;

/// How deep parentheses, calls and operators may nest.
const DEEPEST: usize = 256;

/// Most arguments of a function.
const ARGUMENTS: usize = 2;

/// A function of named variables, written as an expression.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    /// The text in the reader's alphabet, byte by byte at the same place.
    source: String,
    /// Names of the variables in the reader's alphabet.
    variables: Vec<String>,
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
    /// The first mistake: of the syntax, or else an unknown name or a wrong
    /// number of arguments, also in a branch of a conditional that is never
    /// taken.
    pub fn new(text: &str, variables: &[&str]) -> Result<Self, Mistake> {
        if text.len() > LONGEST {
            return Err(Mistake {
                message: format!("longer than {LONGEST} characters"),
                hint: String::new(),
                place: LONGEST..text.len(),
            });
        }
        let expression = Self {
            text: text.to_owned(),
            source: in_ascii(text),
            variables: variables.iter().map(|name| in_ascii(name)).collect(),
        };
        match expression.fault() {
            None => Ok(expression),
            Some(error) => Err(mistake(text, variables, error)),
        }
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The value where the variables have these values, in the order of their
    /// names; NaN where there is none.
    pub fn at(&self, values: &[f64]) -> f64 {
        let known = Known {
            variables: &self.variables,
            values,
        };
        let evaluator = Evaluator::<_, ARGUMENTS>::new(&known).max_depth(DEEPEST);
        evaluator
            .evaluate(&self.source)
            .map_or(f64::NAN, |Real(value)| value)
    }

    /// The first error that does not depend on the values of variables.
    fn fault(&self) -> Option<Error> {
        let names = Names(&self.variables);
        let evaluator = Evaluator::<_, ARGUMENTS>::new(&names).max_depth(DEEPEST);
        // What follows a condition is evaluated in one case only: to hear of the
        // names in all branches, the text is read again without conditions.
        let all = self.source.replace(['?', ':'], "+");
        let all = all.replace("&&", "+ ").replace("||", "+ ");
        [self.source.as_str(), &all]
            .into_iter()
            .find_map(|text| evaluator.evaluate::<Nothing>(text).err())
    }
}

/// Greek letters are names of two ASCII characters to the reader: as many bytes
/// as before, so that places stay. No other name begins with an underscore.
const GREEK: [(&str, &str); 3] = [("φ", "_f"), ("π", "_p"), ("τ", "_t")];

fn in_ascii(text: &str) -> String {
    // An underscore of the text itself is no letter of any name.
    let text = text.replace('_', "\u{1}");
    GREEK
        .iter()
        .fold(text, |text, (letter, name)| text.replace(letter, name))
}

fn constant(name: &str) -> Option<f64> {
    let is = |known: &str| known == name || GREEK.contains(&(known, name));
    CONSTANTS
        .iter()
        .find_map(|(known, value)| is(known).then_some(*value))
}

/// How what other languages call `if` is written.
const CONDITION: &str = "a condition is written `phi < pi ? sin(phi) : 0`";

/// True for a text with an `if` in it, as spreadsheets have it.
fn asks_if(text: &str) -> bool {
    let mut words = text.split(|letter: char| !letter.is_alphanumeric());
    words.any(|word| word.eq_ignore_ascii_case("if"))
}

fn mistake(text: &str, variables: &[&str], error: Error) -> Mistake {
    let place = error.span.start..error.span.end;
    let words = text.get(place.clone()).unwrap_or_default();
    let (what, hint) = match error.kind {
        ErrorKind::UnknownVariable => {
            let hint = format!(
                "known are {} and the constants pi, tau, e",
                variables.join(", ")
            );
            (format!("`{words}` is not known"), hint)
        }
        ErrorKind::UnknownFunction if words == "if" => {
            (format!("`{words}` is no function"), CONDITION.to_owned())
        }
        ErrorKind::UnknownFunction => (
            format!("`{words}` is no function"),
            format!("the functions are {FUNCTIONS}"),
        ),
        ErrorKind::ArgumentCount | ErrorKind::TooManyArguments => (
            format!("`{words}` has a wrong number of arguments"),
            match asks_if(text) {
                true => CONDITION.to_owned(),
                false => "atan2, min and max take two, the others one".to_owned(),
            },
        ),
        ErrorKind::UnexpectedEnd => ("the expression ends too early".to_owned(), String::new()),
        ErrorKind::UnclosedParenthesis => ("this `(` is not closed".to_owned(), String::new()),
        ErrorKind::UnexpectedToken if place.start > 0 => (
            format!("`{words}` cannot stand here"),
            "between two operands stands an operator: 2*phi, sin(phi)".to_owned(),
        ),
        ErrorKind::UnexpectedToken | ErrorKind::UnexpectedCharacter => {
            (format!("`{words}` cannot stand here"), String::new())
        }
        kind => (kind.description().to_owned(), String::new()),
    };
    let at = text.get(..place.start).unwrap_or(text).chars().count() + 1;
    Mistake {
        message: format!("\"{text}\", character {at}: {what}"),
        hint,
        place,
    }
}

#[cfg(test)]
mod tests {
    use super::{CONSTANTS, Expression, FUNCTIONS, OF_ONE, OF_TWO};

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
            ("x_f", 1..2, "cannot stand"),
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
        for (name, function) in OF_ONE {
            assert!(listed.contains(&name), "{name}");
            let found = value(&format!("{name}(x)"), 0.6);
            assert!(found == function(0.6) || found.is_nan() && function(0.6).is_nan());
        }
        for (name, function) in OF_TWO {
            assert!(listed.contains(&name), "{name}");
            assert_eq!(value(&format!("{name}(x, 2)"), 0.6), function(0.6, 2.0));
        }
        assert_eq!(listed.len(), OF_ONE.len() + OF_TWO.len());
        for (name, wanted) in CONSTANTS {
            assert_eq!(value(name, 0.6), wanted);
        }
    }
}
