//! Comparisons and spreads on the terminal.

use super::terminal::number;
use crate::studies::compare::{Comparison, TableRow};
use crate::studies::spread::Spread;
use crate::units::shown;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Figures side by side, errors against the last.
pub(crate) fn comparison(scene: &str, comparison: &Comparison) -> String {
    let table = &comparison.table;
    let mut text = format!("{scene}\n");
    let last = table.labels.last().map_or("", String::as_str);
    let against = match table.against_limit {
        true => format!("the limit of finer models, where there is one, else the run with {last}"),
        false => last.to_owned(),
    };
    let _ = writeln!(text, "{} compared; errors against {against}", table.over);
    for answer in comparison.enough() {
        let _ = writeln!(text, "{answer}");
    }
    text.push('\n');
    let name = width(table.rows.iter().map(|row| row.figure.as_str()), 6);
    let unit = width(table.rows.iter().map(|row| row.unit.as_str()), 4);
    let _ = write!(text, "{:<name$}  {:<unit$}", "figure", "unit");
    for label in &table.labels {
        let _ = write!(text, "  {label:>14} {:>10}", "error");
    }
    if table.against_limit {
        let _ = write!(text, "  {:>14} {:>10}  {:>5}", "limit", "±", "order");
    }
    text.push('\n');
    let rows = table.rows.iter();
    for row in rows.filter(|row| row.values.iter().any(Option::is_some)) {
        comparison_row(&mut text, row, [name, unit]);
    }
    text
}

fn comparison_row(text: &mut String, row: &TableRow, [name, unit]: [usize; 2]) {
    let _ = write!(text, "{:<name$}  {:<unit$}", row.figure, row.unit);
    for (value, error) in row.values.iter().zip(&row.errors) {
        let value = value.map_or("–".to_owned(), number);
        let _ = write!(text, "  {value:>14} {:>10}", percent(*error));
    }
    if let Some(limit) = &row.limit {
        let share = limit
            .error
            .zip(limit.value)
            .map(|(error, value)| error / value.abs());
        let share = share.filter(|share| share.is_finite());
        let value = limit.value.map_or("none".to_owned(), number);
        let order = limit
            .order
            .map_or(String::new(), |order| format!("{order:.2}"));
        let _ = write!(text, "  {value:>14} {:>10}  {order:>5}", percent(share));
    }
    text.push('\n');
}

fn percent(error: Option<f64>) -> String {
    match error {
        None => "–".to_owned(),
        Some(0.0) => "0 %".to_owned(),
        Some(error) if error.abs() < 1e-4 || error.abs() >= 100.0 => {
            format!("{} %", shown(100.0 * error, 2))
        }
        Some(error) => format!("{:.3} %", 100.0 * error),
    }
}

fn width<'a>(words: impl Iterator<Item = &'a str>, least: usize) -> usize {
    words
        .map(|word| word.chars().count())
        .max()
        .unwrap_or(0)
        .max(least)
}

/// The document of a comparison.
pub(crate) fn comparison_document(scene: &str, comparison: &Comparison) -> Value {
    let runs: Vec<Value> = comparison
        .runs
        .iter()
        .map(|run| json!({ "value": run.label, "figures": run.result.figures }))
        .collect();
    json!({ "dam": 1, "scene": scene, "over": comparison.over, "table": comparison.table, "runs": runs })
}

/// How far figures move under a tiny change.
pub(crate) fn spread(spread: &Spread) -> String {
    let mut text = format!(
        "\nspread: loads and gaps changed by {}, tolerance by {}\n",
        number(spread.change),
        spread.tolerance_factor
    );
    let name = width(
        spread.figures.iter().map(|figure| figure.figure.as_str()),
        6,
    );
    let _ = writeln!(
        text,
        "{:<name$}  {:>14}  {:>10}  {:>12}",
        "figure", "value", "by loads", "by tolerance"
    );
    for figure in &spread.figures {
        let moved = |by: Option<f64>| by.map_or("gone".to_owned(), |by| shown(by, 2));
        let mark = if figure.determined {
            ""
        } else {
            "  NOT DETERMINED"
        };
        let _ = writeln!(
            text,
            "{:<name$}  {:>14}  {:>10}  {:>12}{mark}",
            figure.figure,
            number(figure.value),
            moved(figure.by_loads),
            moved(figure.by_tolerance)
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::percent;

    #[test]
    fn errors_read_as_percentages() {
        for (error, text) in [
            (None, "–"),
            (Some(0.0), "0 %"),
            (Some(-0.004), "-0.400 %"),
            (Some(1e-9), "1e-7 %"),
        ] {
            assert_eq!(percent(error), text);
        }
    }
}
