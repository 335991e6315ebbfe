//! The plot of a map over two parameters.

use super::colour::{SHADES, colour};
use super::contour::{Line, contours};
use super::verdict::{ground, hatching};
use super::{Drawing, coordinate};
use crate::analysis::map::Verdict;
use crate::report::quantity::escape;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Contour lines in a plot, about.
const LEVELS: usize = 6;

/// Lines of fewer points carry no label.
const SHORT: usize = 5;

/// Colours, hatching, borders, contour lines, the rigid edge and marks.
pub(super) fn plot(drawing: &Drawing<'_>) -> String {
    let mut out = String::from("<g shape-rendering=\"crispEdges\">\n");
    out.push_str(&fills(drawing));
    out.push_str("</g>\n");
    out.push_str(&hatchings(drawing));
    out.push_str(&borders(drawing));
    out.push_str(&rigid_edge(drawing));
    let (lines, labels) = levels(drawing);
    for part in [lines, marks(drawing), labels] {
        out.push_str(&part);
    }
    out
}

/// Columns and rows.
fn size(drawing: &Drawing<'_>) -> (usize, usize) {
    let columns = drawing.study.columns();
    (columns, drawing.cells.len() / columns)
}

/// Runs of neighbouring cells of a row that fall into the same class, as one
/// path a class.
fn runs<K: Ord + Copy>(
    drawing: &Drawing<'_>,
    class: impl Fn(usize, usize) -> Option<K>,
) -> BTreeMap<K, String> {
    let (columns, rows) = size(drawing);
    let frame = &drawing.frame;
    let mut paths: BTreeMap<K, String> = BTreeMap::new();
    for row in 0..rows {
        let (y, next) = (
            frame.y(drawing.y.edges[row]),
            frame.y(drawing.y.edges[row + 1]),
        );
        let mut column = 0;
        while column < columns {
            let own = class(column, row);
            let start = column;
            while column < columns && class(column, row) == own {
                column += 1;
            }
            let Some(own) = own else { continue };
            let (x, end) = (
                frame.x(drawing.x.edges[start]),
                frame.x(drawing.x.edges[column]),
            );
            let path = paths.entry(own).or_default();
            // Writing to a string cannot fail.
            let _ = write!(
                path,
                "M{} {}H{}V{}H{}z",
                coordinate(x),
                coordinate(y),
                coordinate(end),
                coordinate(next),
                coordinate(x)
            );
        }
    }
    paths
}

fn fills(drawing: &Drawing<'_>) -> String {
    let shade = |column, row| {
        let value = drawing.cell(column, row)?.value?;
        Some(drawing.values.shade(value).min(SHADES - 1))
    };
    let bare = |column, row| {
        let cell = drawing.cell(column, row)?;
        cell.value.is_none().then_some(cell.verdict)
    };
    let mut out = String::new();
    for (shade, path) in runs(drawing, shade) {
        let _ = writeln!(out, "<path fill=\"{}\" d=\"{path}\"/>", colour(shade));
    }
    for (verdict, path) in runs(drawing, bare) {
        let _ = writeln!(out, "<path fill=\"{}\" d=\"{path}\"/>", ground(verdict));
    }
    out
}

fn hatchings(drawing: &Drawing<'_>) -> String {
    let class = |column, row| hatching(drawing.cell(column, row)?.verdict);
    let paths = runs(drawing, class);
    let one = |(name, path)| format!("<path fill=\"url(#{name})\" d=\"{path}\"/>\n");
    paths.into_iter().map(one).collect()
}

/// Lines between regions of different verdicts.
fn borders(drawing: &Drawing<'_>) -> String {
    let (columns, rows) = size(drawing);
    let frame = &drawing.frame;
    let region = |column, row| Some(drawing.cell(column, row)?.verdict);
    let differ = |a: Option<Verdict>, b: Option<Verdict>| a.zip(b).is_some_and(|(a, b)| a != b);
    let mut path = String::new();
    for row in 0..rows {
        for column in 0..columns {
            let own = region(column, row);
            let (x, y) = (&drawing.x.edges, &drawing.y.edges);
            if column + 1 < columns && differ(own, region(column + 1, row)) {
                let at = coordinate(frame.x(x[column + 1]));
                let (from, to) = (coordinate(frame.y(y[row])), coordinate(frame.y(y[row + 1])));
                let _ = write!(path, "M{at} {from}V{to}");
            }
            if row + 1 < rows && differ(own, region(column, row + 1)) {
                let at = coordinate(frame.y(y[row + 1]));
                let (from, to) = (
                    coordinate(frame.x(x[column])),
                    coordinate(frame.x(x[column + 1])),
                );
                let _ = write!(path, "M{from} {at}H{to}");
            }
        }
    }
    match path.is_empty() {
        true => path,
        false => format!("<path class=\"border\" d=\"{path}\"/>\n"),
    }
}

/// Contour lines and their values, those below zero apart from the others:
/// where the sign changes the logarithm says nothing.
fn levels(drawing: &Drawing<'_>) -> (String, String) {
    let (columns, rows) = size(drawing);
    let values = drawing.values;
    let mut out = String::new();
    let mut labels = String::new();
    let mut taken = Vec::new();
    for (level, label) in values.levels(LEVELS) {
        let mut lines = Vec::new();
        for below in [false, true] {
            let field = |column: usize, row: usize| {
                let value = drawing.cell(column, row)?.value?;
                let own = !values.log || (value < 0.0) == below;
                own.then(|| values.shown(value))
            };
            if values.log || !below {
                lines.extend(contours(columns, rows, values.shown(level), &field));
            }
        }
        let path: String = lines.iter().map(|line| path(drawing, line)).collect();
        if path.is_empty() {
            continue;
        }
        let _ = writeln!(
            out,
            "<path class=\"halo\" d=\"{path}\"/><path class=\"contour\" d=\"{path}\"/>"
        );
        labels.push_str(&level_label(drawing, &lines, &label, &mut taken));
    }
    (out, labels)
}

/// The label of a level on its longest line, where no other label stands.
fn level_label(
    drawing: &Drawing<'_>,
    lines: &[Line],
    label: &str,
    taken: &mut Vec<(f64, f64)>,
) -> String {
    let Some(line) = lines.iter().max_by_key(|line| line.len()) else {
        return String::new();
    };
    if line.len() < SHORT {
        return String::new();
    }
    let frame = &drawing.frame;
    let half = 3.2 * label.chars().count() as f64;
    for share in [0.5, 0.3, 0.7, 0.15, 0.85, 0.4, 0.6] {
        let (x, y) = place(drawing, line[(share * (line.len() - 1) as f64) as usize]);
        let x = x.clamp(frame.left + half, frame.x(1.0) - half);
        let y = y.clamp(frame.top + 10.0, frame.y(0.0) - 6.0);
        let near = |&(other, height): &(f64, f64)| {
            (x - other).abs() < 2.0 * half + 8.0 && (y - height).abs() < 14.0
        };
        if taken.iter().any(near) {
            continue;
        }
        taken.push((x, y));
        return format!(
            "<text class=\"level\" x=\"{}\" y=\"{}\" dy=\"3.5\" \
             text-anchor=\"middle\">{}</text>\n",
            coordinate(x),
            coordinate(y),
            escape(label)
        );
    }
    String::new()
}

/// The line along which the rigid mechanism would begin to lift off.
fn rigid_edge(drawing: &Drawing<'_>) -> String {
    let (columns, rows) = size(drawing);
    let field = |column: usize, row: usize| drawing.cell(column, row)?.rigid_margin;
    let lines = contours(columns, rows, 0.0, &field);
    let path: String = lines.iter().map(|line| path(drawing, line)).collect();
    match path.is_empty() {
        true => path,
        false => {
            format!("<path class=\"edge-back\" d=\"{path}\"/><path class=\"edge\" d=\"{path}\"/>\n")
        }
    }
}

/// Where a point of the grid lies in the picture.
fn place(drawing: &Drawing<'_>, (column, row): (f64, f64)) -> (f64, f64) {
    let along = |middles: &[f64], at: f64| {
        let low = (at as usize).min(middles.len() - 2);
        middles[low] + (at - low as f64) * (middles[low + 1] - middles[low])
    };
    (
        drawing.frame.x(along(&drawing.x.middles, column)),
        drawing.frame.y(along(&drawing.y.middles, row)),
    )
}

fn path(drawing: &Drawing<'_>, line: &Line) -> String {
    let mut out = String::new();
    for (index, &point) in line.iter().enumerate() {
        let (x, y) = place(drawing, point);
        let command = if index == 0 { 'M' } else { 'L' };
        let _ = write!(out, "{command}{} {}", coordinate(x), coordinate(y));
    }
    out
}

/// A ring on every cell whose figure is not determined.
fn marks(drawing: &Drawing<'_>) -> String {
    let (columns, rows) = size(drawing);
    let frame = &drawing.frame;
    let cell = (frame.width / columns as f64).min(frame.height / rows as f64);
    let radius = (0.24 * cell).clamp(0.9, 4.5);
    let mut path = String::new();
    for row in 0..rows {
        for column in 0..columns {
            let determined = drawing.cell(column, row).and_then(|cell| cell.determined);
            if determined == Some(false) {
                let (x, y) = place(drawing, (column as f64, row as f64));
                let (r, d) = (coordinate(radius), coordinate(2.0 * radius));
                let _ = write!(
                    path,
                    "M{} {}a{r} {r} 0 1 0 {d} 0a{r} {r} 0 1 0 -{d} 0",
                    coordinate(x - radius),
                    coordinate(y)
                );
            }
        }
    }
    match path.is_empty() {
        true => path,
        false => format!("<path class=\"undetermined\" d=\"{path}\"/>\n"),
    }
}
