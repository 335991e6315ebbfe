//! The plot of a figure over one parameter, its verdicts in a strip below.

use super::verdict::{hatching, plain};
use super::{Drawing, coordinate};
use crate::analysis::map::Cell;
use std::fmt::Write as _;

/// Height of the strip with its distance from the plot.
pub(super) const STRIP: f64 = 20.0;

/// Marks are drawn as long as there are fewer points than this.
const MOST_MARKS: usize = 120;

/// Curve, marks, strip of verdicts and rigid edge.
pub(super) fn plot(drawing: &Drawing<'_>) -> String {
    let mut out = curve(drawing);
    out.push_str(&marks(drawing));
    out.push_str(&strip(drawing));
    out.push_str(&rigid_edge(drawing));
    out
}

fn points<'a>(drawing: &'a Drawing<'_>) -> impl Iterator<Item = Option<(f64, f64, &'a Cell)>> + 'a {
    (0..drawing.cells.len()).map(|column| {
        let cell = drawing.cell(column, 0)?;
        let x = drawing.frame.x(drawing.x.middles[column]);
        // On a logarithmic axis a zero stands on the floor.
        let y = drawing.frame.y(drawing.y.share(cell.value?).max(0.0));
        Some((x, y, cell))
    })
}

/// The curve, interrupted where there is no value or none that is determined.
fn curve(drawing: &Drawing<'_>) -> String {
    let (mut path, mut pen_down) = (String::new(), false);
    for point in points(drawing) {
        match point.filter(|point| point.2.determined != Some(false)) {
            Some((x, y, _)) => {
                let command = if pen_down { 'L' } else { 'M' };
                let _ = write!(path, "{command}{} {}", coordinate(x), coordinate(y));
                pen_down = true;
            }
            None => pen_down = false,
        }
    }
    format!("<path class=\"curve\" d=\"{path}\"/>\n")
}

fn marks(drawing: &Drawing<'_>) -> String {
    let few = drawing.cells.len() < MOST_MARKS;
    let mut out = String::new();
    for (x, y, cell) in points(drawing).flatten() {
        let undetermined = cell.determined == Some(false);
        if !(few || undetermined) {
            continue;
        }
        let (x, y) = (coordinate(x), coordinate(y));
        let look = match undetermined {
            true => "class=\"undetermined\" r=\"3.2\"".to_owned(),
            false => format!("fill=\"{}\" r=\"2.4\"", plain(cell.verdict)),
        };
        let _ = writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" {look}/>");
    }
    out
}

/// The verdict of every point, side by side.
fn strip(drawing: &Drawing<'_>) -> String {
    let (frame, edges) = (&drawing.frame, &drawing.x.edges);
    let verdict = |column: usize| drawing.cell(column, 0).map(|cell| cell.verdict);
    let (top, height) = (coordinate(frame.y(0.0) + 5.0), coordinate(STRIP - 8.0));
    let mut out = String::new();
    let mut column = 0;
    while column < drawing.cells.len() {
        let (start, own) = (column, verdict(column));
        while column < drawing.cells.len() && verdict(column) == own {
            column += 1;
        }
        let Some(own) = own else { continue };
        let (x, end) = (frame.x(edges[start]), frame.x(edges[column]));
        let place = format!(
            "x=\"{}\" y=\"{top}\" width=\"{}\" height=\"{height}\"",
            coordinate(x.min(end)),
            coordinate((end - x).abs())
        );
        let _ = writeln!(out, "<rect {place} fill=\"{}\"/>", plain(own));
        if let Some(name) = hatching(own) {
            let _ = writeln!(out, "<rect {place} fill=\"url(#{name})\"/>");
        }
    }
    out
}

/// Where the rigid mechanism would begin to lift off.
fn rigid_edge(drawing: &Drawing<'_>) -> String {
    let frame = &drawing.frame;
    let margin = |column: usize| drawing.cell(column, 0)?.rigid_margin;
    let mut out = String::new();
    for column in 1..drawing.cells.len() {
        let Some((before, here)) = margin(column - 1).zip(margin(column)) else {
            continue;
        };
        if (before >= 0.0) == (here >= 0.0) {
            continue;
        }
        let part = before / (before - here);
        let middles = &drawing.x.middles;
        let share = middles[column - 1] + part * (middles[column] - middles[column - 1]);
        let path = format!(
            "M{} {}V{}",
            coordinate(frame.x(share)),
            coordinate(frame.top),
            coordinate(frame.y(0.0))
        );
        let _ = writeln!(
            out,
            "<path class=\"edge-back\" d=\"{path}\"/><path class=\"edge\" d=\"{path}\"/>"
        );
    }
    out
}
