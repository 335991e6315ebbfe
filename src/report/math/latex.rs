//! Formulas as LaTeX (amsmath), for math mode.

use super::{Expr, Index, Relation, Symbol, fraction_of_pi};

/// The formula for math mode.
pub(super) fn write(expr: &Expr) -> String {
    match expr {
        Expr::Number(value) => number(*value),
        Expr::Angle(value) => angle(*value),
        Expr::Symbol(symbol) => symbol_in_latex(symbol),
        Expr::Sum(terms) => sum(terms),
        Expr::Negative(inner) if inner.is_additive() => format!("-{}", bracketed(inner)),
        Expr::Negative(inner) => format!("-{}", write(inner)),
        Expr::Product(factors) => product(factors),
        Expr::Quotient(top, bottom) => format!(r"\frac{{{}}}{{{}}}", write(top), write(bottom)),
        Expr::Power(base, power) => power_of(base, *power),
        Expr::Root(inner) => format!(r"\sqrt{{{}}}", write(inner)),
        Expr::Function(name, argument) => called(name, argument),
        Expr::At(symbol, argument) => format!("{}{}", symbol_in_latex(symbol), bracketed(argument)),
        Expr::Cases(cases) => {
            let case = |(value, condition): &(Expr, Expr)| {
                format!("{} & {}", write(value), condition_text(condition))
            };
            let rows: Vec<_> = cases.iter().map(case).collect();
            format!(r"\begin{{cases}} {} \end{{cases}}", rows.join(r" \\ "))
        }
        Expr::Compare(left, relation, right) => {
            format!("{} {} {}", write(left), sign(*relation), write(right))
        }
        Expr::All(conditions) => {
            let all: Vec<_> = conditions.iter().map(write).collect();
            all.join(r" \text{ and } ")
        }
        Expr::Absolute(inner) => format!(r"\left|{}\right|", write(inner)),
        Expr::Greater(left, right) => {
            format!(r"\max\left({}, {}\right)", write(left), write(right))
        }
        Expr::Words(words) => format!(r"\text{{{}}}", escape(words)),
    }
}

fn condition_text(condition: &Expr) -> String {
    match condition {
        Expr::Words(words) => format!(r"\text{{{}}}", escape(words)),
        other => format!(r"\text{{while }} {}", write(other)),
    }
}

fn sign(relation: Relation) -> &'static str {
    match relation {
        Relation::Equal => "=",
        Relation::Less => "<",
        Relation::AtMost => r"\le",
        Relation::Greater => ">",
        Relation::Unequal => r"\ne",
    }
}

/// Plain text made safe for LaTeX's text mode; characters that the standard
/// fonts lack become their commands or a question mark.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => out.push_str(r"\textbackslash{}"),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '^' => out.push_str(r"\textasciicircum{}"),
            '~' => out.push_str(r"\textasciitilde{}"),
            '<' => out.push_str(r"\textless{}"),
            '>' => out.push_str(r"\textgreater{}"),
            c if c.is_ascii() && !c.is_ascii_control() => out.push(c),
            c => out.push_str(&character_command(c)),
        }
    }
    out
}

fn character_command(c: char) -> String {
    if let Some(command) = greek(c) {
        return format!("${command}$");
    }
    match c {
        '–' => "--",
        '—' => "---",
        '−' => "$-$",
        '…' => r"\dots{}",
        '·' => r"$\cdot$",
        '²' => "$^2$",
        '³' => "$^3$",
        '°' => r"$^\circ$",
        '′' => "$'$",
        '″' => "$''$",
        '≥' => r"$\ge$",
        '≤' => r"$\le$",
        '\n' | '\t' => " ",
        c if ('\u{a0}'..'\u{250}').contains(&c) => return c.to_string(),
        _ => "?",
    }
    .to_owned()
}

/// Command of a Greek letter.
fn greek(c: char) -> Option<&'static str> {
    Some(match c {
        'α' => r"\alpha",
        'γ' => r"\gamma",
        'Γ' => r"\Gamma",
        'δ' => r"\delta",
        'η' => r"\eta",
        'θ' => r"\theta",
        'κ' => r"\kappa",
        'μ' | 'µ' => r"\mu",
        'ν' => r"\nu",
        'π' => r"\pi",
        'Π' => r"\Pi",
        'τ' => r"\tau",
        'φ' => r"\varphi",
        'ψ' => r"\psi",
        'ω' => r"\omega",
        'Ω' => r"\Omega",
        _ => return None,
    })
}

fn symbol_in_latex(symbol: &Symbol) -> String {
    let mut base = String::new();
    for c in symbol.letter.chars() {
        match greek(c) {
            Some(command) => base.push_str(command),
            None => base.push(c),
        }
    }
    let accented = match symbol.dots {
        0 => base,
        1 => format!(r"\dot{{{base}}}"),
        _ => format!(r"\ddot{{{base}}}"),
    };
    let primes = "'".repeat(usize::from(symbol.primes));
    let index = match &symbol.index {
        Index::None => String::new(),
        Index::Mass(number) => format!("_{{{number}}}"),
        Index::Any(0) => "_{m}".into(),
        Index::Any(offset) => format!("_{{m{offset:+}}}"),
        Index::Word(word) => format!(r"_{{\mathrm{{{}}}}}", escape(word)),
        Index::WordMass(word, number) => format!(r"_{{\mathrm{{{}}},{number}}}", escape(word)),
    };
    format!("{accented}{primes}{index}")
}

fn sum(terms: &[Expr]) -> String {
    let mut out = String::new();
    for (place, term) in terms.iter().enumerate() {
        let text = write(term);
        match text.strip_prefix('-') {
            _ if place == 0 => out.push_str(&text),
            Some(rest) => out.push_str(&format!(" - {rest}")),
            None => out.push_str(&format!(" + {text}")),
        }
    }
    out
}

fn product(factors: &[Expr]) -> String {
    let mut out = String::new();
    for (place, factor) in factors.iter().enumerate() {
        if place > 0 {
            let left = &factors[place - 1];
            let number = |e: &Expr| matches!(e, Expr::Number(_));
            out.push_str(if number(left) && number(factor) {
                r" \cdot "
            } else {
                r"\,"
            });
        }
        out.push_str(&operand(factor));
    }
    out
}

fn operand(expr: &Expr) -> String {
    if expr.is_additive() {
        bracketed(expr)
    } else {
        write(expr)
    }
}

fn bracketed(expr: &Expr) -> String {
    format!(r"\left({}\right)", write(expr))
}

fn power_of(base: &Expr, power: u32) -> String {
    match base {
        Expr::Symbol(symbol) if symbol.primes == 0 => format!("{}^{{{power}}}", write(base)),
        Expr::Number(value) if *value >= 0.0 => format!("{}^{{{power}}}", write(base)),
        _ => format!("{}^{{{power}}}", bracketed(base)),
    }
}

fn called(name: &str, argument: &Expr) -> String {
    let simple = matches!(argument, Expr::Symbol(symbol) if symbol.index == Index::None);
    if simple {
        format!(r"\{name} {}", write(argument))
    } else {
        format!(r"\{name}{}", bracketed(argument))
    }
}

/// A number to six significant digits: `1.2 \cdot 10^{-7}`.
fn number(value: f64) -> String {
    let text = crate::report::quantity::significant(value, 6);
    let mut out = String::new();
    let mut power = false;
    for c in text.chars() {
        let exponent = "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|digit| digit == c);
        if (exponent.is_some() || c == '⁻') && !power {
            power = true;
            out.push_str("^{");
        }
        match (c, exponent) {
            (_, Some(digit)) => out.push_str(&digit.to_string()),
            ('⁻' | '−', _) => out.push('-'),
            ('·', _) => out.push_str(r" \cdot "),
            ('∞', _) => out.push_str(r"\infty"),
            (other, _) => out.push(other),
        }
    }
    if power {
        out.push('}');
    }
    if value.is_nan() {
        return r"\text{not a number}".into();
    }
    out
}

fn angle(value: f64) -> String {
    let minus = if value < 0.0 { "-" } else { "" };
    match fraction_of_pi(value) {
        Some((1, 1)) => format!(r"{minus}\pi"),
        Some((top, 1)) => format!(r"{minus}{top}\pi"),
        Some((1, bottom)) => format!(r"{minus}\frac{{\pi}}{{{bottom}}}"),
        Some((top, bottom)) => format!(r"{minus}\frac{{{top}\pi}}{{{bottom}}}"),
        None => number(value),
    }
}
