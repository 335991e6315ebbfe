//! Spreads on the terminal.

use super::terminal::number;
use crate::studies::spread::Spread;
use crate::units::shown;
use std::fmt::Write as _;

/// How far figures move under a tiny change.
pub(crate) fn spread(spread: &Spread) -> String {
    let mut text = format!(
        "\nspread: loads and gaps changed by {}, tolerance by {}\n",
        number(spread.change),
        spread.tolerance_factor
    );
    let names = spread.figures.iter();
    let names = names.map(|figure| figure.figure.chars().count());
    let name = names.max().unwrap_or(0).max(6);
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
