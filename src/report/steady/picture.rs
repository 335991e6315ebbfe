//! Pictures of a page about steady motion.

use super::text::Line;
use crate::report::html::facts;
use crate::report::plot::{Plot, Plots};

/// A chart of the page; those over the cycle are zoomed together.
pub(super) fn picture(plots: &mut Plots, chart: &Plot, (width, height): (f64, f64)) -> String {
    let link = if chart.x.name == "φ" { "cycle" } else { "" };
    plots.figure(chart, [width, height], link)
}

pub(super) fn list(lines: &[Line]) -> String {
    let rows: Vec<(&str, String)> = lines
        .iter()
        .map(|(name, text)| (name.as_str(), text.clone()))
        .collect();
    facts(&rows)
}
