//! Formulas of quantities, `2*r + 5 mm`: their value, and its dimension.
//!
//! The language is that of [`Expression`]; besides, a number may have a unit, which ends
//! where a name begins that is declared: of `10 N/r` only the newton is a unit. The
//! operations of the finished program are followed a second time with dimensions.

use super::dimension::Dimension;
use super::parse::{Measure, number_length, parse};
use super::quantity::quantities;
use super::table::{find, known_units};
use crate::math::expression::{
    CONSTANTS, Code, Expression, FUNCTIONS, Function, Mistake, Op, Symbol, Symbols,
};

/// The names that a formula may use.
pub(crate) trait Scope {
    /// The quantity of a name; `None`: there is no such name, `Some(None)`: what is wrong
    /// with it has been said.
    fn quantity(&mut self, name: &str) -> Option<Option<Measure>>;

    /// Length of a declared name with hyphens at the start of a text.
    fn long_name(&self, _text: &str) -> Option<usize> {
        None
    }

    /// The names, as a message lists them.
    fn names(&self) -> Vec<String>;
}

/// The quantity that a formula gives; `Ok(None)`: it uses a name of which it has been said
/// what is wrong.
pub(crate) fn formula(text: &str, scope: &mut dyn Scope) -> Result<Option<Measure>, Mistake> {
    let mut symbols = FormulaSymbols {
        scope,
        quantities: Vec::new(),
        faulty: false,
    };
    let expression = Expression::parse_with_symbols(text, &mut symbols)?;
    if symbols.faulty {
        return Ok(None);
    }
    let quantities = symbols.quantities;
    let wrong = |message: &str, hint: &str| Mistake {
        message: format!("\"{text}\": {message}"),
        hint: hint.to_owned(),
        place: 0..text.len(),
    };
    let kind = kind_of(&expression.program().value, &quantities);
    let kind = kind.map_err(|message| wrong(&message, "units must fit: \"2*r + 5 mm\""))?;
    let values: Vec<f64> = quantities.iter().map(|one| one.value).collect();
    let value = expression.at(&values);
    match value.is_finite() {
        true => Ok(Some(Measure { value, ..kind })),
        false => Err(wrong("it has no finite value", "does it divide by zero?")),
    }
}

/// Why a name cannot be declared: it means something in formulas already.
pub(crate) fn reserved_meaning(name: &str) -> Option<&'static str> {
    let functions = FUNCTIONS.split(", ").map(|one| one.split(' ').next());
    let constant = CONSTANTS.iter().any(|(known, _)| *known == name);
    // `r` and `U` are revolutions only in r/min and U/min, where no name can stand.
    let unit = || !REVOLUTIONS.contains(&name) && known_units().iter().any(|unit| unit == name);
    match name {
        _ if constant => Some("a constant"),
        "mod" | "if" => Some("a word of expressions"),
        _ if functions.flatten().any(|known| known == name) => Some("a function"),
        _ if unit() => Some("a unit"),
        _ => None,
    }
}

/// Units that names may be called like.
const REVOLUTIONS: [&str; 2] = ["r", "U"];

struct FormulaSymbols<'s> {
    scope: &'s mut dyn Scope,
    /// By the index of their variable.
    quantities: Vec<Measure>,
    faulty: bool,
}

impl FormulaSymbols<'_> {
    /// Numbers without a unit are calculated with, all others keep their dimension.
    fn symbol_of_quantity(&mut self, quantity: Measure) -> Symbol {
        if quantity.bare {
            return Symbol::Number(quantity.value);
        }
        self.quantities.push(quantity);
        Symbol::Variable(self.quantities.len() - 1)
    }
}

impl Symbols for FormulaSymbols<'_> {
    fn symbol(&mut self, name: &str) -> Option<Symbol> {
        let found = self.scope.quantity(name)?;
        self.faulty |= found.is_none();
        Some(found.map_or(Symbol::Number(1.0), |found| self.symbol_of_quantity(found)))
    }

    fn quantity(&mut self, text: &str) -> Option<(usize, Symbol)> {
        let number = number_length(text);
        let unit = unit_length(&text[number..], self.scope);
        let length = number + unit;
        let found = parse(&text[..length]).ok().filter(|_| unit > 0)?;
        Some((length, self.symbol_of_quantity(found)))
    }

    fn long_name_length(&self, text: &str) -> Option<usize> {
        self.scope.long_name(text)
    }

    fn names(&self) -> Vec<String> {
        self.scope.names()
    }
}

/// Length of the unit that follows a number, with the space before it; 0: there is none.
fn unit_length(text: &str, scope: &mut dyn Scope) -> usize {
    let blank = |from: usize| text.len() - text[from..].trim_start().len();
    let (mut end, mut at, mut divided) = (0, blank(0), false);
    let mut first = true;
    if text[at..].starts_with('1') && text[at + 1..].trim_start().starts_with('/') {
        (at, divided, first) = (blank(blank(at + 1) + 1), true, false);
    }
    loop {
        let length = symbol_length(&text[at..], first, scope);
        if length == 0 {
            return end;
        }
        at += length;
        at += exponent_length(&text[at..]);
        end = at;
        let next = blank(at);
        let operator = text[next..].chars().next();
        at = match operator {
            Some('/') => {
                divided = true;
                blank(next + 1)
            }
            Some(times @ ('*' | '·' | '⋅' | '×')) if !divided => blank(next + times.len_utf8()),
            Some(letter) if next > at && !divided && letter.is_alphabetic() => next,
            _ => return end,
        };
        first = false;
    }
}

/// Length of the unit's symbol at the start of a text; 0: it is none here.
fn symbol_length(text: &str, first: bool, scope: &mut dyn Scope) -> usize {
    let other = |c: char| !(c.is_alphabetic() || c == '°' || c == '%');
    let length = text.find(other).unwrap_or(text.len());
    let (symbol, rest) = text.split_at(length);
    let word = text.find(|c: char| !(c.is_alphanumeric() || c == '_'));
    let word = &text[..word.unwrap_or(text.len())];
    let after = rest.trim_start();
    let operand = |c: char| c.is_alphanumeric() || c == '(' || c == '.';
    // A remainder, a function, or a longer name; or a name that is called like a unit, but
    // in r/min.
    let other = symbol.starts_with('%') && after.starts_with(operand)
        || after.starts_with('(')
        || rest.starts_with('_')
        || find(&symbol.replace('μ', "µ")).is_none()
        || REVOLUTIONS.contains(&word)
            && !(first && after.starts_with('/'))
            && scope.quantity(word).is_some();
    match other {
        true => 0,
        false => length,
    }
}

/// Length of `^2`, `^-1`, `2`, `-1`, `²`, `⁻¹` at the start of a text.
fn exponent_length(text: &str) -> usize {
    let sign = text.trim_start_matches('^').trim_start_matches(['-', '⁻']);
    let digit = |c: char| c.is_ascii_digit() || "¹²³⁴".contains(c);
    let digits = sign.len() - sign.trim_start_matches(digit).len();
    match digits {
        0 => 0,
        _ => text.len() - sign.len() + digits,
    }
}

/// A pure number that nobody gave a unit.
const NUMBER: Measure = Measure::unitless(0.0);

/// What the result of a program is, all but its value.
fn kind_of(code: &Code, quantities: &[Measure]) -> Result<Measure, String> {
    let mut kinds: Vec<Measure> = Vec::with_capacity(code.ops().len());
    for op in code.ops() {
        let kind = kind(op, code, &kinds, quantities)?;
        kinds.push(kind);
    }
    Ok(kinds.last().copied().unwrap_or(NUMBER))
}

fn kind(op: &Op, code: &Code, kinds: &[Measure], given: &[Measure]) -> Result<Measure, String> {
    let of = |register: u16| kinds[usize::from(register)];
    let zero = |register: u16| code.ops()[usize::from(register)] == Op::Number(0.0);
    let same = |a: u16, b: u16| match (zero(a), zero(b)) {
        (true, false) => Ok(of(b)),
        (false, true) => Ok(of(a)),
        _ => alike(of(a), of(b)),
    };
    let plain = |x: Measure, what: &str| match x.dimension {
        Dimension::NONE => Ok(Measure {
            per_minute: false,
            ..x
        }),
        other => Err(format!("{what} takes a pure number, not {}", words(other))),
    };
    Ok(match *op {
        Op::Number(_) => NUMBER,
        Op::Variable(index) => given[usize::from(index)],
        Op::Affine { x, shift, .. } if shift != 0.0 => alike(of(x), NUMBER)?,
        Op::Affine { x, .. } | Op::Abs { x, .. } => of(x),
        Op::Add(a, b) | Op::Sub(a, b) | Op::Min { a, b, .. } | Op::Max { a, b, .. } => same(a, b)?,
        Op::Remainder { x, y, .. } => same(x, y)?,
        Op::Select { a, b, .. } => same(a, b)?,
        Op::Mul(a, b) => product(of(a), of(b), of(a).dimension * of(b).dimension),
        Op::Div(a, b) => Measure {
            per_minute: of(a).per_minute && of(b).dimension == Dimension::NONE,
            ..product(of(a), of(b), of(a).dimension / of(b).dimension)
        },
        Op::Power(x, exponent) => power(of(x), exponent)?,
        Op::Of(Function::Sqrt, x) => power(of(x), 0.5)?,
        Op::Of(Function::Cbrt, x) => power(of(x), 1.0 / 3.0)?,
        Op::Of(Function::Sin | Function::Cos | Function::Tan, x) => {
            let dimension = of(x).dimension.without_angle();
            plain(Measure { dimension, ..of(x) }, "a function of an angle")?
        }
        Op::Of(Function::Asin | Function::Acos | Function::Atan, x) => Measure {
            dimension: Dimension::ANGLE,
            bare: false,
            ..plain(of(x), "an inverse function")?
        },
        Op::Atan2 { y, x, .. } => Measure {
            dimension: Dimension::ANGLE,
            bare: false,
            ..same(y, x)?
        },
        Op::Of(_, x) => plain(of(x), "this function")?,
        Op::Whole { x, .. } => plain(of(x), "rounding")?,
        Op::PowerOf(a, b) => {
            plain(of(b), "an exponent")?;
            plain(of(a), "a power with this exponent")?
        }
        Op::Less { a, b, .. } | Op::Equal(a, b) => same(a, b).map(|_| NUMBER)?,
        Op::Sign { .. } | Op::And(..) | Op::Or(..) | Op::Not(_) => NUMBER,
    })
}

/// What two quantities are that are added or compared.
fn alike(a: Measure, b: Measure) -> Result<Measure, String> {
    let composed = a.composed || b.composed;
    if a.dimension != b.dimension && !(composed && a.dimension.agrees_but_for_angle(b.dimension)) {
        let (a, b) = (words(a.dimension), words(b.dimension));
        return Err(format!("{a} and {b} cannot be added or compared"));
    }
    Ok(Measure {
        bare: a.bare && b.bare,
        per_minute: a.per_minute && b.per_minute,
        composed,
        ..a
    })
}

fn product(a: Measure, b: Measure, dimension: Dimension) -> Measure {
    let none = |one: Measure| one.dimension == Dimension::NONE;
    Measure {
        dimension,
        bare: a.bare && b.bare,
        per_minute: a.per_minute && none(b) || b.per_minute && none(a),
        composed: a.composed || b.composed || !none(a) && !none(b),
        ..a
    }
}

fn power(x: Measure, exponent: f64) -> Result<Measure, String> {
    let raise = |part: i32| {
        let raised = f64::from(part) * exponent;
        let whole = raised.round();
        ((raised - whole).abs() < 1e-9 && whole.abs() <= 1000.0).then_some(whole as i32)
    };
    let from = x.dimension;
    let raised = || {
        Some(Dimension::new(
            raise(from.mass)?,
            raise(from.length)?,
            raise(from.time)?,
            raise(from.angle)?,
        ))
    };
    let wrong = || format!("{} has no such power", words(from));
    Ok(Measure {
        dimension: raised().ok_or_else(wrong)?,
        per_minute: false,
        composed: x.composed || from != Dimension::NONE,
        ..x
    })
}

/// `a length (m)`, `a number`.
fn words(dimension: Dimension) -> String {
    if dimension == Dimension::NONE {
        return "a pure number".to_owned();
    }
    let known = quantities::ALL
        .iter()
        .find(|one| one.dimension == dimension);
    match known {
        Some(quantity) => format!("{} ({dimension})", quantity.name),
        None => format!("something in {dimension}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Scope, formula, reserved_meaning};
    use crate::units::{Measure, Quantity, parse, quantities as q};
    use proptest::prelude::*;

    /// Names with what they stand for.
    struct Given(Vec<(&'static str, &'static str)>);

    impl Scope for Given {
        fn quantity(&mut self, name: &str) -> Option<Option<Measure>> {
            let found = self.0.iter().find(|one| one.0 == name)?;
            Some(parse(found.1).ok())
        }

        fn names(&self) -> Vec<String> {
            self.0.iter().map(|one| one.0.to_owned()).collect()
        }
    }

    fn given() -> Given {
        Given(vec![
            ("r", "50 mm"),
            ("n", "300 rpm"),
            ("k", "3"),
            ("F", "2 kN"),
            ("eta", "80 %"),
            ("f", "5 1/min"),
            ("a", "30 deg"),
            ("bad", "?"),
        ])
    }

    fn found(text: &str) -> Measure {
        formula(text, &mut given()).unwrap().unwrap()
    }

    fn takes(quantity: Quantity, text: &str, wanted: f64) {
        let value = quantity
            .accept(found(text))
            .unwrap_or_else(|e| panic!("{text}: {e:?}"));
        approx::assert_relative_eq!(value, wanted, max_relative = 4e-15);
    }

    #[test]
    fn formulas_have_the_dimension_of_what_they_calculate() {
        let omega = 10.0 * std::f64::consts::PI;
        for (quantity, text, wanted) in [
            (q::LENGTH, "r", 0.05),
            (q::LENGTH, "2*r + 5 mm", 0.105),
            (q::LENGTH, "-(r/2 - 1 cm)", -0.015),
            (q::LENGTH, "sqrt(r^2 + (12 cm)^2)", 0.13),
            (q::LENGTH, "max(r, 0) + min(r, 40 mm)", 0.09),
            (q::LENGTH, "r > 4 cm ? r : 4 cm", 0.05),
            (q::LENGTH, "r*sin(a) + r*sin(0)", 0.025),
            (q::LENGTH, "r*eta", 0.04),
            (q::LENGTH, "r*2^k", 0.4),
            (q::AREA, "r^2", 0.0025),
            (q::AREA, "pi/4*r^2", std::f64::consts::PI * 0.0025 / 4.0),
            (q::LINEAR_STIFFNESS, "k*10 N/mm", 3e4),
            (q::LINEAR_STIFFNESS, "10 N/r", 200.0),
            (q::LINEAR_STIFFNESS, "F/r", 4e4),
            (q::MOMENT, "F*r", 100.0),
            (
                q::ROTATIONAL_STIFFNESS,
                "F*r/a",
                100.0 / (std::f64::consts::PI / 6.0),
            ),
            (q::LINEAR_SPEED, "n*r", omega * 0.05),
            (q::POWER, "F*r*n", 100.0 * omega),
            (q::ANGULAR_SPEED, "2*n", 2.0 * omega),
            (q::ANGULAR_SPEED, "60 r/min", std::f64::consts::TAU),
            (q::ANGULAR_SPEED, "2*f", std::f64::consts::PI / 3.0),
            (q::FREQUENCY, "f/2", 5.0 / 120.0),
            (q::ANGLE, "atan2(r, 50 mm)", std::f64::consts::FRAC_PI_4),
            (q::ANGLE, "a % 20 deg", 10f64.to_radians()),
            (q::NUMBER, "r/(20 mm)", 2.5),
            (q::NUMBER, "k", 3.0),
            (q::NUMBER, "7 % k + 5 %", 1.05),
        ] {
            takes(quantity, text, wanted);
        }
        assert!(found("k/2").bare && !found("r/r").bare);
    }

    #[test]
    fn dimensions_are_checked() {
        for text in [
            "r + F",
            "r + 1",
            "r + k",
            "r < F",
            "sin(r)",
            "r^0.5",
            "k^r",
            "floor(r)",
            "exp(r)",
            "n + 5 Hz",
            "sqrt(r)",
            "max(r, 1)",
            "r + a",
            "n*1 s + k",
        ] {
            let mistake = formula(text, &mut given()).unwrap_err();
            assert!(mistake.message.contains(text), "{mistake:?}");
            assert_eq!(mistake.place, 0..text.len());
        }
        for (quantity, text) in [
            (q::INERTIA, "r"),
            (q::LENGTH, "r/r"),
            (q::ANGULAR_SPEED, "2*5 Hz"),
            (q::FREQUENCY, "n"),
            (q::MOMENT, "2*(100 N m/rad)"),
            (q::NUMBER, "a"),
        ] {
            assert!(quantity.accept(found(text)).is_err(), "{text}");
        }
        assert_eq!(formula("2*bad", &mut given()), Ok(None));
    }

    #[test]
    fn mistakes_have_their_place() {
        for (text, place) in [
            ("2*q", 2..3),
            ("r + 5 mm*", 9..9),
            ("2 r", 2..3),
            ("r + 5 furlong", 6..13),
            ("r/0", 0..3),
            ("(r", 0..1),
            ("5 N/m*mm", 6..8),
        ] {
            let mistake = formula(text, &mut given()).unwrap_err();
            assert_eq!(mistake.place, place, "{text}: {mistake:?}");
        }
    }

    #[test]
    fn names_that_mean_something_are_hidden() {
        for name in ["m", "s", "mm", "e", "pi", "sin", "max", "mod", "N"] {
            assert!(reserved_meaning(name).is_some(), "{name}");
        }
        for name in ["r", "U", "k", "n", "half", "x_1"] {
            assert!(reserved_meaning(name).is_none(), "{name}");
        }
    }

    proptest! {
        /// A number with a unit is worth the same alone, in a formula, and by parts.
        #[test]
        fn units_in_formulas_are_those_of_texts(
            value in -1e6..1e6f64,
            factor in 1..50i32,
            unit in proptest::sample::select(vec![
                "mm", "kN", "N m/rad", "kg m^2", "N·s/m", "m/s2", "rpm", "deg", "lbf ft", "1/min", "%",
            ]),
        ) {
            let text = format!("{value:?} {unit}");
            let alone = parse(&text).unwrap();
            let same = found(&format!("({text})"));
            prop_assert_eq!(same.value, alone.value);
            prop_assert_eq!(same.dimension, alone.dimension);
            let sum = found(&format!("{factor}*({text}) - ({text})"));
            let wanted = f64::from(factor - 1) * alone.value;
            prop_assert!((sum.value - wanted).abs() <= 1e-14 * alone.value.abs() * f64::from(factor));
            prop_assert_eq!(sum.dimension, alone.dimension);
        }

        /// No text makes it fail otherwise than by a mistake within the text.
        #[test]
        fn any_text_is_read_or_refused(text in "[ a-z0-9.+*/^()%·²-]{0,30}") {
            if let Err(mistake) = formula(&text, &mut given()) {
                prop_assert!(text.get(mistake.place.clone()).is_some(), "{mistake:?}");
            }
        }
    }
}
