//! The marks of points.

use super::{Shape, coordinate, palette};
use crate::report::quantity::escape;

/// The mark of a point: circle, square, triangle or diamond by series, about its place; series
/// that have one colour have other marks. `colour`: that of a kind of cells.
pub(super) fn draw_mark(
    [x, y]: [f64; 2],
    index: usize,
    shape: Shape,
    note: &str,
    colour: impl Fn(usize) -> Option<&'static str>,
) -> String {
    let style = palette::style(index);
    let body = |fill: &str| match (style + index / palette::SERIES.len()) % 4 {
        0 => format!("<circle class=\"{fill}\" r=\"4\"/>"),
        1 => format!("<rect class=\"{fill}\" x=\"-3.5\" y=\"-3.5\" width=\"7\" height=\"7\"/>"),
        2 => format!("<path class=\"{fill}\" d=\"M0 -5l4.6 8h-9.2z\"/>"),
        _ => format!("<path class=\"{fill}\" d=\"M0 -5l5 5-5 5-5-5z\"/>"),
    };
    let drawn = match shape {
        Shape::None => return String::new(),
        Shape::Good => body(&format!("f{style}")),
        Shape::Open => body("hollow"),
        Shape::Cross => "<path class=\"bare\" d=\"M-4 -4l8 8m0-8l-8 8\"/>".to_owned(),
        Shape::AtMost => {
            let arrow = "<path class=\"bare\" d=\"M0 4v13m-4-5l4 5 4-5\"/>";
            body(&format!("f{style}")) + arrow
        }
        Shape::Ring => "<circle class=\"ring\" r=\"3.2\"/>".to_owned(),
        Shape::Kind(kind) => {
            let colour = colour(kind).unwrap_or(palette::map_verdicts::STOPPED);
            format!("<circle fill=\"{colour}\" stroke=\"none\" r=\"2.6\"/>")
        }
    };
    let title = match note {
        "" => String::new(),
        note => format!("<title>{}</title>", escape(note)),
    };
    format!(
        "<g class=\"mark s{style}\" transform=\"translate({} {})\">{title}{drawn}</g>",
        coordinate(x),
        coordinate(y)
    )
}
