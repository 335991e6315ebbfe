//! Equations as part of a page, in MathML.

use super::{Entry, Equations, Line, NOTATION, Section, text};
use crate::report::math::Expr;
use crate::report::quantity::escape;

/// The equations as sections of a page, one an object. A section tells its object in
/// `data-object`, a letter that bears a name tells that in `data-of`.
pub(in crate::report) fn mathml(equations: &Equations) -> String {
    let sections: String = equations.sections.iter().map(section).collect();
    format!("<p class=\"soft\">{}</p>\n{sections}", escape(NOTATION))
}

fn section(section: &Section) -> String {
    let id = escape(&section.object);
    let lines: String = section.lines.iter().map(equation).collect();
    let legend: String = section.legend.iter().map(entry_in_mathml).collect();
    let legend = match legend.is_empty() {
        true => legend,
        false => format!("<table class=\"letters\"><tbody>{legend}</tbody></table>\n"),
    };
    format!(
        "<section class=\"equations\" data-object=\"{id}\">\n<h2>{id} <small>{}</small></h2>\n\
         {lines}{legend}</section>\n",
        escape(&section.heading)
    )
}

fn equation(line: &Line) -> String {
    let sign = match line.left {
        Expr::Words(_) => "<mspace width=\"0.6em\"/>",
        _ => "<mo>=</mo>",
    };
    let remark = match line.remark.is_empty() {
        true => String::new(),
        false => format!("<span class=\"remark\">{}</span>", escape(&line.remark)),
    };
    let (left, right) = (line.left.mathml(), line.right.mathml());
    format!(
        "<div class=\"equation\"><math display=\"inline\">{left}{sign}{right}</math>{remark}</div>\n"
    )
}

fn entry_in_mathml(entry: &Entry) -> String {
    let first = entry.symbol.mathml();
    let name = match &entry.until {
        Some(last) if entry.adjacent() => format!("{first}<mo>,</mo>{}", last.mathml()),
        Some(last) => format!("{first}<mo>,</mo><mo>…</mo><mo>,</mo>{}", last.mathml()),
        None => first,
    };
    format!(
        "<tr><th><math>{name}</math></th><td>{}</td><td>{}</td></tr>\n",
        escape(format!("{} {}", text::values(&entry.values), entry.unit).trim()),
        escape(&entry.meaning)
    )
}
