//! Stand-alone pictures: the object graph, line charts, charts on logarithmic axes, strips of regions.

pub mod chart;
pub mod graph;
mod legend;
pub mod log_chart;
pub mod map;
pub mod strips;

/// Characters per line that fit `width` at a font size, for a sans-serif face.
fn fits(width: f64, font_size: f64) -> usize {
    (width / (0.56 * font_size)).max(3.0) as usize
}

/// A coordinate for an SVG attribute: two decimals, no negative zero.
pub(in crate::report) fn coordinate(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.to_owned()
    }
}
