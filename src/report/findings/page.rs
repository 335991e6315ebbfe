//! Findings as a page that opens without a network.

use super::{Cell, Charts, Figure, Findings, Item, Layout, Section, Table, Value};
use crate::report::addresses::{in_words, result_words};
use crate::report::html::{
    bar, fact_list, header, name_with_symbols, number, scene, shell, warnings,
};
use crate::report::plot::{Plot, Plots};
use crate::report::quantity::{coded, escape, with_raised_powers};
use crate::report::symbols::{Setting, symbols};
use std::fmt::Write as _;

/// Width of a chart over the whole page, of one of two beside each other, of a round one (pixels).
pub(in crate::report) const WIDE: f64 = 1184.0;
const HALF: [f64; 2] = [579.0, 300.0];
const ROUND: [f64; 2] = [360.0, 370.0];
/// A table of so many columns does not fit a narrow page: there its rows are lists.
const MANY: usize = 7;

impl Findings<'_> {
    /// The page.
    pub fn page(&self) -> String {
        let mut plots = Plots::default();
        let mut body = String::new();
        body.push_str(&warnings(&self.warnings));
        for section in self.sections.iter().filter(|section| !section.is_empty()) {
            body.push_str(&section.html(&mut plots));
        }
        if let Some(text) = self.source.scene {
            body.push_str(&scene(text));
        }
        let (body, contents) = with_contents(&body);
        let header = header(&self.title, &self.subtitle, self.answer.as_ref());
        let footer = self.footer();
        let body = format!("{header}<main>\n{contents}{body}</main>\n{footer}");
        shell(&self.title, &body, &plots.json())
    }

    fn footer(&self) -> String {
        let source = &self.source;
        let mut rows = Vec::new();
        let mut add = |name: &str, text: &str| rows.push((name.to_owned(), escape(text)));
        if source.scene.is_some() {
            add("Scene", &self.title);
        }
        if !source.hash.is_empty() {
            add(&format!("SHA-256 of {}", source.hashed), source.hash);
        }
        add("Program", concat!("dam ", env!("CARGO_PKG_VERSION")));
        for (name, text) in &source.more {
            add(name, text);
        }
        format!(
            "<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
            fact_list(&rows)
        )
    }
}

impl Section<'_> {
    /// The section on a page.
    pub(in crate::report) fn html(&self, plots: &mut Plots) -> String {
        let mut out = String::new();
        if !self.heading.is_empty() {
            let _ = writeln!(out, "<h2>{}</h2>", escape(&self.heading));
        }
        let mut zoomed = "";
        for item in &self.items {
            match item {
                Item::Words(words) | Item::Legend(words) if words.is_empty() => {}
                Item::Words(words) => {
                    let _ = writeln!(out, "<p>{}</p>", prose(words));
                }
                Item::Legend(words) => {
                    let _ = writeln!(out, "<p class=\"soft\">{}</p>", prose(words));
                }
                Item::Notes(notes) => out.push_str(&list(notes)),
                Item::Figures(figures) => out.push_str(&list_of_figures(figures)),
                Item::Table(table) => out.push_str(&table.html()),
                Item::Folded(summary, table) => {
                    let table = table.html().replacen("scroll", "scroll tall", 1);
                    let summary = escape(summary);
                    let _ = writeln!(
                        out,
                        "<details>\n<summary>{summary}</summary>\n{table}</details>"
                    );
                }
                Item::Charts(charts) => {
                    // The buttons stand once above all that they zoom.
                    if charts.link != zoomed && !charts.charts.is_empty() {
                        out.push_str(&bar(charts.link));
                        zoomed = charts.link;
                    }
                    out.push_str(&charts.html(plots));
                }
                Item::Drawing(make) => out.push_str(&make.0(plots)),
            }
        }
        out
    }
}

fn list(notes: &[String]) -> String {
    let item = |note: &String| format!("<li>{}</li>\n", prose(note));
    format!(
        "<ul>\n{}</ul>\n",
        notes.iter().map(item).collect::<String>()
    )
}

/// A sentence.
fn prose(words: &str) -> String {
    coded(&symbols(
        &escape(&with_raised_powers(&in_words(words))),
        Setting::Page,
    ))
}

/// Headings of a page from which on it has a list of them.
const FEW: usize = 2;

/// The body with names for its headings to be jumped to, and the list of these.
fn with_contents(body: &str) -> (String, String) {
    let mut parts = body.split("<h2>");
    let mut named = parts.next().unwrap_or_default().to_owned();
    let mut list = String::new();
    let mut count = 0;
    for part in parts {
        count += 1;
        let _ = write!(named, "<h2 id=\"section-{count}\">{part}");
        let heading = part.split('<').next().unwrap_or_default().trim_end();
        let _ = write!(list, "<a href=\"#section-{count}\">{heading}</a> ");
    }
    match count {
        FEW.. => (
            named,
            format!("<nav class=\"contents\">{}</nav>\n", list.trim_end()),
        ),
        _ => (body.to_owned(), String::new()),
    }
}

fn list_of_figures(figures: &[Figure]) -> String {
    let row = |figure: &Figure| {
        let note = match figure.note.as_str() {
            "" => String::new(),
            note => format!(" <span class=\"note\">{}</span>", prose(note)),
        };
        (figure.name.clone(), value(&figure.value) + &note)
    };
    fact_list(&figures.iter().map(row).collect::<Vec<_>>())
}

/// A value for reading, the full number on hover.
fn value(value: &Value) -> String {
    match value {
        Value::Words(words) => prose(words),
        Value::Number { value, .. } if !value.is_finite() => "–".to_owned(),
        Value::Number {
            value,
            unit,
            digits,
        } => number(*value, unit, *digits),
    }
}

impl Charts {
    fn html(&self, plots: &mut Plots) -> String {
        let size = |plot: &Plot| match self.layout {
            Layout::Grid => HALF,
            Layout::Round => ROUND,
            Layout::Panels(1) => [WIDE, 560.0],
            Layout::Panels(2) => [HALF[0], 400.0],
            Layout::Panels(_) => ROUND,
            Layout::Wide(height) => match plot.y.rows.len() {
                0 => [WIDE, height],
                rows => [WIDE, 150.0 + 24.0 * rows as f64],
            },
        };
        let figures = self.charts.iter();
        let figures: String = figures
            .map(|plot| plots.figure(plot, size(plot), self.link))
            .collect();
        let rows = self.charts.len().div_ceil(2);
        match self.layout {
            _ if figures.is_empty() => figures,
            Layout::Wide(_) => figures,
            // The studio lets no style stand in its page, and has columns of its own.
            Layout::Grid | Layout::Panels(_) if plots.is_live() => {
                let class = match self.layout {
                    Layout::Grid => "plots",
                    _ => "panels",
                };
                format!("<div class=\"{class}\">\n{figures}</div>\n")
            }
            Layout::Grid => {
                format!("<div class=\"plots\" style=\"--rows:{rows}\">\n{figures}</div>\n")
            }
            Layout::Round => format!("<div class=\"round\">\n{figures}</div>\n"),
            Layout::Panels(columns) => format!(
                "<div class=\"panels{}\" style=\"--columns:{columns};--few:{}\">\n{figures}</div>\n",
                if columns == 1 { " single" } else { "" },
                columns.div_ceil(2)
            ),
        }
    }
}

impl Table {
    /// The table, with its first column as heads of the rows.
    pub(in crate::report) fn html(&self) -> String {
        if self.rows.is_empty() {
            return String::new();
        }
        let class_of = |at: usize, tag: &str| match self.columns.get(at) {
            Some(column) if column.minor && column.right => "minor ",
            Some(column) if column.minor => "left minor ",
            Some(column) if column.prose && tag != "head" => "words ",
            Some(column) if column.right => "",
            _ => "left ",
        };
        let wide = self.columns.iter().filter(|one| !one.minor).count() >= MANY;
        let head = self.columns.iter().enumerate();
        let head: String = head
            .map(|(at, column)| {
                format!(
                    "<th class=\"{}\">{}</th>",
                    class_of(at, "head"),
                    name_with_symbols(&result_words(&column.name))
                )
            })
            .collect();
        let cell = |(at, cell): (usize, &Cell)| {
            let tone = match cell.good {
                Some(true) => "yes",
                Some(false) => "no",
                None => "",
            };
            let below = |text: String| format!("<span class=\"sub\">{text}</span>");
            let mut note = match cell.words.is_empty() {
                true => String::new(),
                false => below(escape(&cell.value.words())),
            };
            if !cell.note.is_empty() {
                note.push_str(&below(prose(&cell.note)));
            }
            let tag = if at == 0 { "th" } else { "td" };
            let class = format!("{}{tone}", class_of(at, tag));
            let class = match class.trim() {
                "" => String::new(),
                class => format!(" class=\"{class}\""),
            };
            let value = match cell.object {
                true => format!("<a href=\"#object-{0}\">{0}</a>", value(&cell.value)),
                false if !cell.words.is_empty() => name_with_symbols(&cell.words),
                false => value(&cell.value),
            };
            let label = match self.columns.get(at) {
                Some(column) if wide && at > 0 => {
                    let name = symbols(&escape(&result_words(&column.name)), Setting::Letters);
                    format!(" data-label=\"{name}\"")
                }
                _ => String::new(),
            };
            format!("<{tag}{class}{label}>{value}{note}</{tag}>")
        };
        let row = |cells: &[Cell]| {
            let cells: String = cells.iter().enumerate().map(cell).collect();
            format!("<tr>{cells}</tr>\n")
        };
        let rows: String = self.rows.iter().map(|one| row(&one.cells)).collect();
        let class = if wide { "wide" } else { "" };
        format!(
            "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"table\"><table class=\"{class}\">\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\
             </table></div>\n"
        )
        .replace(" class=\"\"", "")
        .replace("class=\"left \"", "class=\"left\"")
        .replace("class=\"minor \"", "class=\"minor\"")
    }
}
