//! Equations as Unicode text.

use super::{Entry, Equations, Line, NOTATION, Section};
use crate::report::findings::width;
use crate::report::math::Expr;
use crate::report::quantity::significant;

/// Lines longer than this are continued on the next one.
const LINE: usize = 100;
/// Left sides wider than this get a line of their own.
const LONG_LEFT: usize = 24;

/// The equations as text, with a legend under each section.
pub fn text(equations: &Equations) -> String {
    let sections: Vec<String> = equations.sections.iter().map(section).collect();
    format!("{NOTATION}\n\n{}", sections.join("\n"))
}

fn section(section: &Section) -> String {
    let mut out = format!("{}: {}\n\n", section.object, section.heading);
    let lefts = section.lines.iter().map(|line| width(&line.left.unicode()));
    let left = lefts.filter(|&w| w <= LONG_LEFT).max().unwrap_or(0);
    for line in &section.lines {
        out.push_str(&equation(line, left));
    }
    if !section.legend.is_empty() {
        out.push('\n');
        out.push_str(&legend(&section.legend));
    }
    out
}

fn equation(line: &Line, left: usize) -> String {
    let name = line.left.unicode();
    let pad = " ".repeat(left.saturating_sub(width(&name)));
    let sign = if matches!(line.left, Expr::Words(_)) {
        " "
    } else {
        "="
    };
    let start = if width(&name) > LONG_LEFT {
        // The right side goes on a line of its own under the left one.
        format!("  {name}\n{}{sign} ", " ".repeat(left + 3))
    } else {
        format!("  {pad}{name} {sign} ")
    };
    let start_width = width(start.rsplit('\n').next().unwrap_or(&start));
    let indent = " ".repeat(start_width);
    let mut rows = match &line.right {
        Expr::Cases(cases) => case_rows(cases),
        Expr::Sum(terms) => sum_rows(terms, start_width),
        other => vec![other.unicode()],
    };
    if !line.remark.is_empty() {
        rows[0].push_str(&format!("    ({})", line.remark));
    }
    format!("{start}{}\n", rows.join(&format!("\n{indent}")))
}

/// One row a case, conditions under each other.
fn case_rows(cases: &[(Expr, Expr)]) -> Vec<String> {
    let values: Vec<String> = cases.iter().map(|(value, _)| value.unicode()).collect();
    let widest = values.iter().map(|value| width(value)).max().unwrap_or(0);
    let row = |(value, (_, condition)): (&String, &(Expr, Expr))| {
        let pad = " ".repeat(widest - width(value));
        let word = match condition {
            Expr::Words(_) => "",
            _ => "while ",
        };
        format!("{value}{pad}  {word}{}", condition.unicode())
    };
    values.iter().zip(cases).map(row).collect()
}

/// A sum broken before a term where it gets too long.
fn sum_rows(terms: &[Expr], start: usize) -> Vec<String> {
    let mut rows = vec![String::new()];
    for (place, term) in terms.iter().enumerate() {
        let text = term.unicode();
        let piece = match (place, text.strip_prefix('−')) {
            (0, _) => text,
            (_, Some(rest)) => format!(" − {rest}"),
            (_, None) => format!(" + {text}"),
        };
        let row = rows
            .last_mut()
            .filter(|row| start + width(row) + width(&piece) <= LINE);
        match row {
            Some(row) => row.push_str(&piece),
            None => rows.push(format!("  {}", piece.trim_start())),
        }
    }
    rows
}

fn legend(entries: &[Entry]) -> String {
    let names: Vec<String> = entries.iter().map(name).collect();
    let widest = names.iter().map(|name| width(name)).max().unwrap_or(0);
    let row = |(name, entry): (&String, &Entry)| {
        let pad = " ".repeat(widest - width(name));
        let unit = if entry.unit.is_empty() {
            String::new()
        } else {
            format!(" {}", entry.unit)
        };
        format!(
            "  {name}{pad} = {}{unit}  ({})\n",
            values(&entry.values),
            entry.meaning
        )
    };
    names.iter().zip(entries).map(row).collect()
}

fn name(entry: &Entry) -> String {
    match &entry.until {
        Some(last) if entry.adjacent() => {
            format!("{}, {}", entry.symbol.unicode(), last.unicode())
        }
        Some(last) => format!("{} … {}", entry.symbol.unicode(), last.unicode()),
        None => entry.symbol.unicode(),
    }
}

/// One value, or a list; long lists are abbreviated in the middle.
pub(super) fn values(values: &[f64]) -> String {
    let shown = |value: &f64| significant(*value, 6);
    if values.len() <= 12 {
        return values.iter().map(shown).collect::<Vec<_>>().join(", ");
    }
    let (start, end) = (&values[..4], &values[values.len() - 2..]);
    let join = |part: &[f64]| part.iter().map(shown).collect::<Vec<_>>().join(", ");
    format!("{}, …, {}", join(start), join(end))
}
