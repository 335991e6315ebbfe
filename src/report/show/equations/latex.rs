//! Equations as a LaTeX document.

use super::{Entry, Equations, Line, NOTATION, Section, text};
use crate::report::math::{Expr, latex_text};

/// Rows of a legend on one page.
const ROWS: usize = 30;
/// Sums longer than this (in characters of LaTeX) are broken.
const LINE: usize = 130;
/// Left sides longer than this get a line of their own.
const LONG_LEFT: usize = 60;

/// The equations as a complete document that `pdflatex` compiles (amsmath only).
pub fn latex(equations: &Equations) -> String {
    let sections: String = equations.sections.iter().map(section).collect();
    format!(
        "\\documentclass[11pt,a4paper]{{article}}\n\\usepackage{{amsmath}}\n\\usepackage[margin=20mm]{{geometry}}\n\
         \\allowdisplaybreaks\n\\setlength{{\\parindent}}{{0pt}}\n\n\
         \\begin{{document}}\n{}\n{sections}\\end{{document}}\n",
        latex_text(NOTATION)
    )
}

fn section(section: &Section) -> String {
    let lines: Vec<String> = section.lines.iter().map(equation).collect();
    let mut out = format!(
        "\n\\section*{{{}}}\n{}\n\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        latex_text(&section.object),
        latex_text(&section.heading),
        lines.join(" \\\\\n")
    );
    for rows in section.legend.chunks(ROWS) {
        let rows: String = rows.iter().map(entry_in_latex).collect();
        out.push_str(&format!(
            "\\begin{{tabular}}{{lll}}\n{rows}\\end{{tabular}}\n\n"
        ));
    }
    out
}

fn equation(line: &Line) -> String {
    let sign = if matches!(line.left, Expr::Words(_)) {
        r"\;"
    } else {
        "="
    };
    let remark = if line.remark.is_empty() {
        String::new()
    } else {
        format!(r" \qquad \text{{({})}}", latex_text(&line.remark))
    };
    let right = match &line.right {
        Expr::Sum(terms) if line.right.latex().len() > LINE => broken(terms),
        other => other.latex(),
    };
    let left = line.left.latex();
    if left.len() > LONG_LEFT {
        // The right side goes on a line of its own under the left one.
        return format!("& {left} \\\\\n  &\\quad {sign} {right}{remark}");
    }
    format!("{left} &{sign} {right}{remark}")
}

/// A long sum over several lines.
fn broken(terms: &[Expr]) -> String {
    let mut out = String::new();
    let mut length = 0;
    for (place, term) in terms.iter().enumerate() {
        let text = term.latex();
        if place > 0 && length + text.len() > LINE {
            out.push_str(" \\\\\n  &\\quad {}");
            length = 0;
        }
        if place > 0 && !text.starts_with('-') {
            out.push_str(" + ");
        }
        length += text.len();
        out.push_str(&text);
    }
    out
}

fn entry_in_latex(entry: &Entry) -> String {
    let name = match &entry.until {
        Some(last) if entry.adjacent() => {
            format!("{}, {}", entry.symbol.latex(), last.latex())
        }
        Some(last) => format!(r"{}, \dots, {}", entry.symbol.latex(), last.latex()),
        None => entry.symbol.latex(),
    };
    let values: Vec<String> = match entry.values.as_slice() {
        list if list.len() > 12 => vec![latex_text(&text::values(list))],
        list => list
            .iter()
            .map(|value| format!("${}$", Expr::Number(*value).latex()))
            .collect(),
    };
    format!(
        "${name}$ & {} {} & {} \\\\\n",
        values.join(", "),
        latex_text(&entry.unit),
        entry.meaning
    )
}
