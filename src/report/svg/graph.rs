//! The object graph as a picture: left to right, drive first.

use crate::dynamics::model::{Closure, Coordinate};
use crate::report::diagram::{Diagram, ObjectBox, Place};
use crate::report::plot::{Plots, characters_per_line, coordinate, document};
use crate::report::quantity::{escape, shortened, with_unit};

const BOX_WIDTH: f64 = 156.0;
const BOX_HEIGHT: f64 = 74.0;
const COLUMN: f64 = BOX_WIDTH + 236.0;
/// Distance between boxes above each other.
const GAP: f64 = 46.0;
/// Height that the arrows of one of several inputs need, with their label.
const INPUT: f64 = 37.0;
const MARGIN: f64 = 16.0;

/// Style of the picture.
pub(in crate::report) const STYLE: &str = "\
.dam-graph{font-family:system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,sans-serif}\
.dam-graph .frame{fill:var(--box);stroke:var(--ink-soft);stroke-width:1.4}\
.dam-graph .drive .frame{fill:var(--box-drive)}\
.dam-graph .id{font-weight:650;font-size:15px;fill:var(--ink)}\
.dam-graph .kind{font-size:12.5px;fill:var(--ink-soft)}\
.dam-graph .edge{fill:none;stroke:var(--ink);stroke-width:1.5}\
.dam-graph .back{fill:none;stroke:var(--ink-soft);stroke-width:1.2;stroke-dasharray:5 3}\
.dam-graph .head{fill:var(--ink)}\
.dam-graph .head-back{fill:var(--ink-soft)}\
.dam-graph .law{font-size:12px;fill:var(--ink)}\
.dam-graph .port{font-size:11px;fill:var(--ink-soft)}\
.dam-graph .pair{fill:var(--paper);stroke:var(--accent);stroke-width:1.5}\
.dam-graph .pair-mark{fill:none;stroke:var(--accent);stroke-width:1.5}\
.dam-graph a:hover .frame{stroke-width:2.4}";

/// The picture by itself.
pub fn svg(diagram: &Diagram) -> String {
    let (size, body) = draw_diagram(diagram, false);
    document("dam-graph", size, "Object graph", STYLE, &body)
}

/// The picture as part of a page, which gives the colours: every box is a link to its anchor
/// `#object-ID`.
pub(in crate::report) fn diagram_with_links(diagram: &Diagram, plots: &Plots) -> String {
    let ([width, height], body) = draw_diagram(diagram, true);
    let (w, h) = (coordinate(width), coordinate(height));
    format!(
        "<svg class=\"dam-graph\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"group\" \
         aria-label=\"Object graph\">\n{}{body}</svg>\n",
        plots.style(STYLE)
    )
}

fn draw_diagram(diagram: &Diagram, links: bool) -> ([f64; 2], String) {
    let places = diagram.places();
    let columns = places.iter().map(|p| p.column).max().unwrap_or(0) as f64;
    // Boxes above each other give the distance of rows; the middles of a row stand level.
    let is_crowded = |index: usize| {
        let beside = |place: &&Place| place.column == places[index].column;
        places.iter().filter(beside).count() > 1
    };
    let heights: Vec<f64> = diagram.boxes.iter().map(height_of).collect();
    let crowded = (0..heights.len()).filter(|&index| is_crowded(index));
    let row = GAP
        + crowded
            .map(|index| heights[index])
            .fold(BOX_HEIGHT, f64::max);
    let top = |index: usize| places[index].row * row - (heights[index] - BOX_HEIGHT) / 2.0;
    let all = || 0..heights.len();
    let first = all().map(top).fold(0.0, f64::min);
    let last = all().map(|index| top(index) + heights[index]);
    let height = 2.0 * MARGIN + last.fold(BOX_HEIGHT, f64::max) - first;
    let width = 2.0 * MARGIN + columns * COLUMN + BOX_WIDTH;
    let corner = |index: usize| -> Corner {
        let x = MARGIN + places[index].column as f64 * COLUMN;
        (x, MARGIN + top(index) - first)
    };
    let mut out = String::new();
    for (index, one) in diagram.boxes.iter().enumerate() {
        for (k, input) in one.inputs.iter().enumerate() {
            let from = corner(input.driver);
            let leaves = Arrival::leaving(&diagram.boxes[input.driver]);
            out.push_str(&edge((one, k), &input.name, (from, leaves), corner(index)));
        }
    }
    for (index, one) in diagram.boxes.iter().enumerate() {
        out.push_str(&object_box(one, corner(index), links));
    }
    ([width, height], out)
}

/// Upper left corner of a box.
type Corner = (f64, f64);

/// Height of a box: room for the arrows of all its inputs.
fn height_of(one: &ObjectBox) -> f64 {
    BOX_HEIGHT.max(INPUT * one.inputs.len() as f64)
}

fn object_box(one: &ObjectBox, (x, y): Corner, links: bool) -> String {
    let height = height_of(one);
    let words = y + (height - BOX_HEIGHT) / 2.0;
    let turning = match one.coordinate {
        Coordinate::Turning => "turning",
        Coordinate::Sliding => "sliding",
    };
    let middle = coordinate(x + BOX_WIDTH / 2.0);
    let text = |class: &str, dy: f64, text: &str, size: f64| {
        format!(
            "<text class=\"{class}\" x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            coordinate(words + dy),
            escape(&shortened(
                text,
                characters_per_line(BOX_WIDTH - 12.0, size)
            ))
        )
    };
    let detail = match one.is_drive() {
        true => one.detail.clone(),
        false => format!("{turning}, {}", one.detail),
    };
    let body = format!(
        "<title>{title}</title><rect class=\"frame\" x=\"{x}\" y=\"{y}\" width=\"{BOX_WIDTH}\" \
         height=\"{height}\" rx=\"{radius}\"/>{id}{kind}{detail}",
        title = escape(&format!(
            "{}: {}, {turning}, {}",
            one.id, one.kind, one.detail
        )),
        x = coordinate(x),
        y = coordinate(y),
        height = coordinate(height),
        radius = if one.is_drive() { 22 } else { 5 },
        id = text("id", 26.0, &one.id, 15.5),
        kind = text("kind", 45.0, &one.kind.replace('_', " "), 12.5),
        detail = text("kind", 62.0, &detail, 12.5),
    );
    let class = if one.is_drive() { "drive" } else { "driven" };
    let group = format!("<g class=\"{class}\">{body}</g>");
    if links {
        format!("<a href=\"#object-{}\">{group}</a>\n", escape(&one.id))
    } else {
        group + "\n"
    }
}

/// Where the arrows of one input meet the box, from its upper edge: those of several inputs one
/// below the other.
#[derive(Clone, Copy)]
struct Arrival {
    forward: f64,
    back: f64,
}

impl Arrival {
    /// Of the arrows of a box with one input.
    const ALONE: Self = Self {
        forward: 28.0,
        back: 48.0,
    };

    /// Of the arrows between a box and what it drives.
    fn leaving(driver: &ObjectBox) -> Self {
        let lower = (height_of(driver) - BOX_HEIGHT) / 2.0;
        Self {
            forward: Self::ALONE.forward + lower,
            back: Self::ALONE.back + lower,
        }
    }

    fn of(input: usize, one: &ObjectBox) -> Self {
        let inputs = one.inputs.len();
        if inputs < 2 {
            return Self::ALONE;
        }
        let share = height_of(one) / inputs as f64;
        let top = share * input as f64;
        Self {
            forward: top + 0.35 * share,
            back: top + 0.75 * share,
        }
    }
}

/// The two arrows between a driver and what it drives: motion forward, force back.
/// `name`: what the connection is called; empty: by its position function.
fn edge(
    (one, input): (&ObjectBox, usize),
    name: &str,
    ((x1, y1), leaves): (Corner, Arrival),
    (x2, y2): Corner,
) -> String {
    let law = if name.is_empty() { &one.position } else { name };
    let arrival = Arrival::of(input, one);
    let (start, end) = (x1 + BOX_WIDTH, x2);
    let (forward_from, forward_to) = (y1 + leaves.forward, y2 + arrival.forward);
    let (back_from, back_to) = (y1 + leaves.back, y2 + arrival.back);
    let bend = start + 34.0;
    let path = |class: &str, from: f64, to: f64| {
        let (s, e) = (coordinate(start), coordinate(end));
        let (from, to) = (coordinate(from), coordinate(to));
        let (b, after) = (coordinate(bend - 16.0), coordinate(bend + 16.0));
        format!(
            "<path class=\"{class}\" d=\"M{s} {from} C{after} {from} {b} {to} {} {to} H{e}\"/>",
            coordinate(bend + 26.0)
        )
    };
    let arrow = |class: &str, x: f64, y: f64, direction: f64| {
        format!(
            "<path class=\"{class}\" d=\"M{} {} l{} -4 v8 z\"/>",
            coordinate(x),
            coordinate(y),
            coordinate(-9.0 * direction)
        )
    };
    let label_x = (bend + 26.0 + end) / 2.0;
    let room = characters_per_line(COLUMN - BOX_WIDTH - 14.0, 12.0);
    // Between the arrows of several inputs there is no room for it.
    let ports = match name.is_empty() {
        true => format!(
            "<text class=\"port\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">φ, φ̇ →   ← Ω</text>",
            coordinate(label_x),
            coordinate(back_to - 6.0)
        ),
        false => String::new(),
    };
    // The pair is one for all inputs.
    let pair = match input + 1 == one.inputs.len() {
        true => pair_symbol(one, label_x - 40.0, back_to + 16.0),
        false => String::new(),
    };
    format!(
        "<g>{}{}{}{}<text class=\"law\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">\
         <title>{}</title>{}</text>{ports}{}</g>\n",
        path("edge", forward_from, forward_to),
        path("back", back_from, back_to),
        arrow("head", end, forward_to, 1.0),
        arrow("head-back", start, back_from, -1.0),
        coordinate((bend + 10.0 + end) / 2.0),
        coordinate(forward_to - 9.0),
        escape(law),
        escape(&shortened_formula(law, room.min(26))),
        pair,
    )
}

/// A formula cut off at its end: its beginning says what kind it is.
fn shortened_formula(text: &str, length: usize) -> String {
    if text.chars().count() <= length {
        return text.to_owned();
    }
    let start: String = text.chars().take(length - 1).collect();
    format!("{}…", start.trim_end())
}

/// The symbol of the driving pair: a cam's roller on its flank for force
/// closure, a pin in a slot for form closure; nothing for a bilateral pair.
fn pair_symbol(one: &ObjectBox, x: f64, y: f64) -> String {
    let (cx, cy) = (coordinate(x), coordinate(y));
    let word = |text: &str| {
        format!(
            "<text class=\"port\" x=\"{}\" y=\"{}\">{text}</text>",
            coordinate(x + 15.0),
            coordinate(y + 4.0)
        )
    };
    match one.closure {
        Closure::Bilateral => String::new(),
        Closure::Force => format!(
            "<g><title>force-closed pair: can lift off</title>\
             <circle class=\"pair\" cx=\"{cx}\" cy=\"{cy}\" r=\"5\"/>\
             <path class=\"pair-mark\" d=\"M{} {} q10 6 20 0\"/>{}</g>",
            coordinate(x - 10.0),
            coordinate(y + 5.0),
            word("force-closed")
        ),
        Closure::Form => {
            format!(
                "<g><title>form-closed pair, gap {}</title>\
                 <path class=\"pair-mark\" d=\"M{l} {t} h20 M{l} {b} h20\"/>\
                 <circle class=\"pair\" cx=\"{cx}\" cy=\"{cy}\" r=\"5\"/>{}</g>",
                with_unit(one.gap, one.coordinate.unit(), 4),
                word("form-closed"),
                l = coordinate(x - 10.0),
                t = coordinate(y - 8.0),
                b = coordinate(y + 8.0)
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{diagram_with_links, svg};
    use crate::report::diagram::Diagram;
    use crate::report::fixture;
    use crate::report::plot::Plots;

    #[test]
    fn every_object_is_drawn_and_nothing_breaks_out() {
        let mut diagram = Diagram::of(&fixture::fan_out());
        diagram.boxes[1].kind = "<script>&".into();
        let picture = diagram_with_links(&diagram, &Plots::default());
        for one in &diagram.boxes {
            assert!(picture.contains(&format!("href=\"#object-{}\"", one.id)));
        }
        assert!(!picture.contains("<script"));
        assert_eq!(picture.matches("class=\"edge\"").count(), 3);
        assert_eq!(picture.matches("force-closed pair").count(), 1);
        assert_eq!(picture.matches("form-closed pair").count(), 1);
        assert!(svg(&Diagram::default()).contains("</svg>"));
    }
}
