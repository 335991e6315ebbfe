//! Tables in Markdown.

use crate::ladder::{Miss, Reached};
use std::fmt::Write;

/// A table with its columns aligned also as plain text.
pub(crate) fn table(head: &[String], rows: &[Vec<String>]) -> String {
    let width = |column: usize| {
        let cells = rows.iter().map(|row| &row[column]).chain([&head[column]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let line = |cells: &[String]| {
        let mut text = String::from("|");
        for (cell, width) in cells.iter().zip(&widths) {
            let _ = write!(text, " {cell:<width$} |");
        }
        text + "\n"
    };
    let rule: Vec<String> = widths.iter().map(|width| "-".repeat(*width)).collect();
    let body: String = rows.iter().map(|row| line(row)).collect();
    line(head) + &line(&rule) + &body
}

/// A time in milliseconds with three digits.
pub(crate) fn milliseconds(seconds: f64) -> String {
    let value = 1e3 * seconds;
    let digits = (2 - value.log10().floor() as i32).clamp(0, 5) as usize;
    format!("{value:.digits$}")
}

/// An error or a tolerance with two digits.
pub(crate) fn power(value: f64) -> String {
    format!("{value:.1e}")
}

/// A number of switches; solvers that locate none have none.
fn count(switches: Option<usize>) -> String {
    switches.map_or("none located".to_owned(), |count| count.to_string())
}

/// Tolerance, error, switches, median, least time and runs of a point.
pub(crate) fn reached(point: &Reached) -> Vec<String> {
    let missing = |why: String| {
        let dash = || "-".to_owned();
        vec![dash(), why, dash(), dash(), dash(), dash()]
    };
    match point {
        Ok(point) => vec![
            power(point.tolerance),
            power(point.error),
            count(point.switches),
            milliseconds(point.timing.median),
            milliseconds(point.timing.least),
            point.timing.runs.to_string(),
        ],
        Err(Miss::NoTolerance) => missing("not reached".to_owned()),
        Err(Miss::TooLong(time)) => missing(format!("given up: {time:.1} s a run")),
    }
}
