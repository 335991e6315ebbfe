//! Formulas as Unicode text.

use super::{Expr, Index, Symbol, fraction_of_pi};
use crate::report::quantity::{significant, subscript, superscript};

/// The formula on one line; cases separated by semicolons.
pub(super) fn write(expr: &Expr) -> String {
    match expr {
        Expr::Number(value) => significant(*value, 6),
        Expr::Angle(value) => angle(*value),
        Expr::Symbol(symbol) => symbol_in_unicode(symbol),
        Expr::Sum(terms) => sum(terms),
        Expr::Negative(inner) if inner.is_additive() => format!("−({})", write(inner)),
        Expr::Negative(inner) => format!("−{}", write(inner)),
        Expr::Product(factors) => product(factors),
        Expr::Quotient(top, bottom) => format!("{}/{}", operand(top), denominator(bottom)),
        Expr::Power(base, power) => power_of(base, *power),
        Expr::Root(inner) => format!("√({})", write(inner)),
        Expr::Function(name, argument) => called(name, argument),
        Expr::At(symbol, argument) => format!("{}({})", symbol_in_unicode(symbol), write(argument)),
        Expr::Cases(cases) => {
            let case = |(value, condition): &(Expr, Expr)| {
                format!("{} {}", write(value), condition_text(condition))
            };
            cases.iter().map(case).collect::<Vec<_>>().join("; ")
        }
        Expr::Compare(left, relation, right) => {
            format!("{} {} {}", write(left), relation.sign(), write(right))
        }
        Expr::All(conditions) => {
            let all: Vec<_> = conditions.iter().map(write).collect();
            all.join(" and ")
        }
        Expr::Absolute(inner) => format!("|{}|", write(inner)),
        Expr::Greater(left, right) => format!("max({}, {})", write(left), write(right)),
        Expr::Words(words) => words.clone(),
    }
}

/// "while x < 0", or the words as they are ("otherwise").
fn condition_text(condition: &Expr) -> String {
    match condition {
        Expr::Words(words) => words.clone(),
        other => format!("while {}", write(other)),
    }
}

/// Letter, dots, primes, subscript: φ̈₂, U′_rocker.
fn symbol_in_unicode(symbol: &Symbol) -> String {
    let dots = ["", "\u{307}", "\u{308}"][usize::from(symbol.dots.min(2))];
    let primes = ["", "′", "″"][usize::from(symbol.primes.min(2))];
    let index = match &symbol.index {
        Index::None => String::new(),
        Index::Mass(number) => subscript(*number),
        Index::Any(-1) => "ₘ₋₁".into(),
        Index::Any(0) => "ₘ".into(),
        Index::Any(_) => "ₘ₊₁".into(),
        Index::Word(word) => format!("_{word}"),
        Index::WordMass(word, number) => format!("_{word},{number}"),
    };
    format!("{}{dots}{primes}{index}", symbol.letter)
}

fn sum(terms: &[Expr]) -> String {
    let mut out = String::new();
    for (place, term) in terms.iter().enumerate() {
        let text = write(term);
        match text.strip_prefix('−') {
            _ if place == 0 => out.push_str(&text),
            Some(rest) => out.push_str(&format!(" − {rest}")),
            None => out.push_str(&format!(" + {text}")),
        }
    }
    out
}

fn product(factors: &[Expr]) -> String {
    let mut out = String::new();
    for (place, factor) in factors.iter().enumerate() {
        if place > 0 && !joins(&factors[place - 1], factor) {
            out.push('·');
        }
        out.push_str(&operand(factor));
    }
    out
}

/// True when two factors may stand side by side without a dot: c₂(φ₂ − φ₁), J₁φ̈₁.
fn joins(left: &Expr, right: &Expr) -> bool {
    let short = |symbol: &Symbol| !matches!(symbol.index, Index::Word(_) | Index::WordMass(..));
    match (left, right) {
        (Expr::Symbol(left), Expr::Symbol(right)) => short(left) && short(right),
        (Expr::Number(_), Expr::Symbol(_)) => !write(left).contains('·'),
        (Expr::Symbol(left), right) => short(left) && right.is_additive(),
        _ => false,
    }
}

fn operand(expr: &Expr) -> String {
    let text = write(expr);
    let fraction = matches!(expr, Expr::Angle(value) if text.contains('/') && *value > 0.0);
    if expr.is_additive() || fraction {
        format!("({text})")
    } else {
        text
    }
}

fn denominator(expr: &Expr) -> String {
    match expr {
        Expr::Product(_) | Expr::Quotient(..) => format!("({})", write(expr)),
        other => operand(other),
    }
}

fn power_of(base: &Expr, power: u32) -> String {
    let simple = |symbol: &Symbol| {
        symbol.primes == 0 && !matches!(symbol.index, Index::Word(_) | Index::WordMass(..))
    };
    let text = write(base);
    let power = superscript(power.cast_signed());
    match base {
        Expr::Symbol(symbol) if simple(symbol) => format!("{text}{power}"),
        Expr::Number(value) if *value >= 0.0 && !text.contains('·') => format!("{text}{power}"),
        _ => format!("({text}){power}"),
    }
}

fn called(name: &str, argument: &Expr) -> String {
    match argument {
        Expr::Symbol(symbol) if symbol.index == Index::None => {
            format!("{name} {}", symbol_in_unicode(symbol))
        }
        other => format!("{name}({})", write(other)),
    }
}

fn angle(value: f64) -> String {
    let minus = if value < 0.0 { "−" } else { "" };
    match fraction_of_pi(value) {
        Some((1, 1)) => format!("{minus}π"),
        Some((top, 1)) => format!("{minus}{top}π"),
        Some((1, bottom)) => format!("{minus}π/{bottom}"),
        Some((top, bottom)) => format!("{minus}{top}π/{bottom}"),
        None => significant(value, 6),
    }
}
