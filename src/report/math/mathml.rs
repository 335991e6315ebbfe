//! Formulas as MathML Core, for pages.

use super::{Expr, Index, Symbol, fraction_of_pi};
use crate::report::quantity::{escape, significant};

/// The formula for inside of `<math>`; a symbol that bears the name of an object or load
/// tells it in `data-of`.
pub(super) fn write(expr: &Expr) -> String {
    match expr {
        Expr::Number(_) | Expr::Angle(_) | Expr::Sum(_) | Expr::Negative(_) => added(expr),
        Expr::Symbol(symbol) => symbol_in_mathml(symbol),
        Expr::Product(factors) => product(factors),
        Expr::Quotient(top, bottom) => format!("<mfrac>{}{}</mfrac>", one(top), one(bottom)),
        Expr::Power(base, power) => power_of(base, *power),
        Expr::Root(inner) => format!("<msqrt>{}</msqrt>", write(inner)),
        Expr::Function(name, argument) => called(name, argument),
        Expr::At(symbol, argument) => {
            format!("{}{}", symbol_in_mathml(symbol), bracketed(argument))
        }
        Expr::Cases(cases) => table(cases),
        Expr::Compare(left, relation, right) => {
            format!(
                "{}{}{}",
                write(left),
                operator(relation.sign()),
                write(right)
            )
        }
        Expr::All(conditions) => {
            let all: Vec<_> = conditions.iter().map(write).collect();
            all.join(&preserve_blanks(" and "))
        }
        Expr::Absolute(inner) => format!("<mrow><mo>|</mo>{}<mo>|</mo></mrow>", write(inner)),
        Expr::Greater(left, right) => {
            let arguments = format!("{}{}{}", write(left), operator(","), write(right));
            format!("<mi>max</mi><mrow><mo>(</mo>{arguments}<mo>)</mo></mrow>")
        }
        Expr::Words(text) => preserve_blanks(text),
    }
}

/// As one element.
fn one(expr: &Expr) -> String {
    format!("<mrow>{}</mrow>", write(expr))
}

fn operator(text: &str) -> String {
    format!("<mo>{}</mo>", escape(text))
}

/// Blanks at the ends of a text element count for nothing unless they do not break.
fn preserve_blanks(text: &str) -> String {
    format!("<mtext>{}</mtext>", escape(&text.replace(' ', "\u{a0}")))
}

/// The terms with their signs; a sum within a sum is taken apart.
fn terms(expr: &Expr) -> Vec<(bool, String)> {
    match expr {
        Expr::Sum(parts) => parts.iter().flat_map(terms).collect(),
        Expr::Negative(inner) if inner.is_additive() => vec![(true, bracketed(inner))],
        Expr::Negative(inner) => vec![(true, write(inner))],
        Expr::Number(value) => vec![(*value < 0.0, number(value.abs()))],
        Expr::Angle(value) => vec![(*value < 0.0, angle(value.abs()))],
        other => vec![(false, write(other))],
    }
}

fn added(expr: &Expr) -> String {
    let mut out = String::new();
    for (place, (negative, body)) in terms(expr).into_iter().enumerate() {
        match (place, negative) {
            (0, false) => {}
            // A sign before the first term, not between two.
            (0, true) => out.push_str("<mo form=\"prefix\">−</mo>"),
            (_, false) => out.push_str("<mo>+</mo>"),
            (_, true) => out.push_str("<mo>−</mo>"),
        }
        out.push_str(&body);
    }
    out
}

fn product(factors: &[Expr]) -> String {
    let mut out = String::new();
    for (place, factor) in factors.iter().enumerate() {
        if place > 0 {
            let ends = [&factors[place - 1], factor];
            let numbers = ends.iter().all(|end| matches!(end, Expr::Number(_)));
            // Between letters a thin space, which is nothing to be read.
            out.push_str(match numbers {
                true => "<mo>·</mo>",
                false => "<mspace width=\"0.17em\"/>",
            });
        }
        out.push_str(&match factor.is_additive() {
            true => bracketed(factor),
            false => write(factor),
        });
    }
    out
}

fn bracketed(expr: &Expr) -> String {
    format!("<mrow><mo>(</mo>{}<mo>)</mo></mrow>", write(expr))
}

fn power_of(base: &Expr, power: u32) -> String {
    let base = match base {
        Expr::Symbol(symbol) if symbol.primes == 0 => write(base),
        Expr::Number(value) if *value >= 0.0 => one(base),
        _ => bracketed(base),
    };
    format!("<msup>{base}<mn>{power}</mn></msup>")
}

fn called(name: &str, argument: &Expr) -> String {
    let simple = matches!(argument, Expr::Symbol(symbol) if symbol.index == Index::None);
    let argument = match simple {
        true => format!("<mspace width=\"0.17em\"/>{}", write(argument)),
        false => bracketed(argument),
    };
    format!("<mrow><mi>{name}</mi>{argument}</mrow>")
}

fn table(cases: &[(Expr, Expr)]) -> String {
    let row = |(value, condition): &(Expr, Expr)| {
        let condition = match condition {
            Expr::Words(text) => preserve_blanks(text),
            other => format!("{}{}", preserve_blanks("while "), write(other)),
        };
        format!(
            "<mtr><mtd>{}</mtd><mtd>{condition}</mtd></mtr>",
            write(value)
        )
    };
    let rows: String = cases.iter().map(row).collect();
    format!("<mrow><mo>{{</mo><mtable>{rows}</mtable></mrow>")
}

fn symbol_in_mathml(symbol: &Symbol) -> String {
    let letters = symbol.letter.chars();
    let letters: String = letters.map(|c| format!("<mi>{c}</mi>")).collect();
    let mut base = match symbol.letter.chars().count() {
        1 => letters,
        _ => format!("<mrow>{letters}</mrow>"),
    };
    let dots = ["", "˙", "¨"][usize::from(symbol.dots.min(2))];
    if !dots.is_empty() {
        base = format!("<mover>{base}<mo>{dots}</mo></mover>");
    }
    let word = |word: &str| format!("<mtext>{}</mtext>", escape(word));
    let index = match &symbol.index {
        Index::None => String::new(),
        Index::Mass(number) => format!("<mn>{number}</mn>"),
        Index::Any(0) => "<mi>m</mi>".to_owned(),
        Index::Any(offset) => {
            let sign = if *offset < 0 { "−" } else { "+" };
            let size = offset.unsigned_abs();
            format!("<mrow><mi>m</mi><mo>{sign}</mo><mn>{size}</mn></mrow>")
        }
        Index::Word(name) => word(name),
        Index::WordMass(name, number) => {
            format!("<mrow>{}<mo>,</mo><mn>{number}</mn></mrow>", word(name))
        }
    };
    let primes = ["", "′", "″"][usize::from(symbol.primes.min(2))];
    let primes = match primes {
        "" => String::new(),
        primes => operator(primes),
    };
    let whole = match (index.is_empty(), primes.is_empty()) {
        (true, true) => base,
        (true, false) => format!("<msup>{base}{primes}</msup>"),
        (false, true) => format!("<msub>{base}{index}</msub>"),
        (false, false) => format!("<msubsup>{base}{index}{primes}</msubsup>"),
    };
    match &symbol.index {
        Index::Word(name) | Index::WordMass(name, _) => {
            format!("<mrow data-of=\"{}\">{whole}</mrow>", escape(name))
        }
        _ => whole,
    }
}

/// A number to six significant digits: 1.2·10⁻⁷.
fn number(value: f64) -> String {
    if value.is_nan() {
        return preserve_blanks("not a number");
    }
    let text = significant(value, 6);
    let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
    let Some(at) = text.find(|c| digit(c).is_some() || c == '⁻') else {
        return format!("<mn>{text}</mn>");
    };
    let (base, power) = text.split_at(at);
    let power: String = power
        .chars()
        .map(|c| digit(c).map_or("−".to_owned(), |digit| digit.to_string()))
        .collect();
    let ten = format!("<msup><mn>10</mn><mn>{power}</mn></msup>");
    match base.strip_suffix("·10") {
        Some(mantissa) => format!("<mn>{mantissa}</mn><mo>·</mo>{ten}"),
        None => ten,
    }
}

fn angle(value: f64) -> String {
    let top = |top: u32| match top {
        1 => "<mi>π</mi>".to_owned(),
        top => format!("<mrow><mn>{top}</mn><mi>π</mi></mrow>"),
    };
    match fraction_of_pi(value) {
        Some((number, 1)) => top(number),
        Some((number, bottom)) => format!("<mfrac>{}<mn>{bottom}</mn></mfrac>", top(number)),
        None => number(value),
    }
}
