//! Curves and the marks of their points.

use super::{COLOURS, Frame, LogPoint, Mark, Series};
use crate::report::quantity::escape;
use crate::report::svg::coordinate;

/// The curve through what is no failure, and the marks of all points.
pub(super) fn draw(series: &Series, frame: &Frame) -> String {
    let colour = COLOURS[series.style % COLOURS.len()];
    let mut path = String::new();
    let mut pen_down = false;
    for point in &series.points {
        if point.y.is_none() || point.mark == Mark::Cross || !is_shown(point, frame) {
            pen_down = false;
            continue;
        }
        let (x, y) = (coordinate(frame.x(point.x)), coordinate(frame.y(point.y)));
        path.push_str(&format!("{}{x} {y}", if pen_down { 'L' } else { 'M' }));
        pen_down = true;
    }
    let dash = if series.bare {
        " stroke-dasharray=\"5 3\""
    } else {
        ""
    };
    let mut out = format!("<path class=\"curve\" d=\"{path}\" stroke=\"{colour}\"{dash}/>\n");
    if series.bare {
        return out;
    }
    for point in series.points.iter().filter(|point| is_shown(point, frame)) {
        let (x, y) = (frame.x(point.x), frame.y(point.y));
        out.push_str(&format!(
            "<g>{}<title>{}</title></g>\n",
            mark(x, y, series.style, point.mark),
            escape(&point.note)
        ));
    }
    out
}

fn is_shown(point: &LogPoint, frame: &Frame) -> bool {
    point.x.is_finite()
        && (frame.linear_x || point.x > 0.0)
        && point.y.is_none_or(f64::is_finite)
        && (frame.lane || point.y.is_some_and(|y| y > 0.0))
}

/// The mark of a point: circle, square, triangle or diamond by series.
pub(super) fn mark(x: f64, y: f64, style: usize, mark: Mark) -> String {
    let colour = COLOURS[style % COLOURS.len()];
    let (cx, cy) = (coordinate(x), coordinate(y));
    if mark == Mark::Cross {
        return format!(
            "<path d=\"M{} {}l8 8m0-8l-8 8\" stroke=\"{colour}\" stroke-width=\"2\" fill=\"none\"/>",
            coordinate(x - 4.0),
            coordinate(y - 4.0)
        );
    }
    let fill = if mark == Mark::Open { "#fff" } else { colour };
    let shape = match style % 4 {
        0 => format!("<circle cx=\"{cx}\" cy=\"{cy}\" r=\"4\""),
        1 => format!(
            "<rect x=\"{}\" y=\"{}\" width=\"7\" height=\"7\"",
            coordinate(x - 3.5),
            coordinate(y - 3.5)
        ),
        2 => format!("<path d=\"M{cx} {}l4.6 8h-9.2z\"", coordinate(y - 5.0)),
        _ => format!("<path d=\"M{cx} {}l5 5-5 5-5-5z\"", coordinate(y - 5.0)),
    };
    let arrow = match mark {
        Mark::AtMost => format!(
            "<path d=\"M{cx} {}v13m-4-5l4 5 4-5\" stroke=\"{colour}\" stroke-width=\"1.5\" fill=\"none\"/>",
            coordinate(y + 4.0)
        ),
        _ => String::new(),
    };
    format!("{shape} fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"/>{arrow}")
}
