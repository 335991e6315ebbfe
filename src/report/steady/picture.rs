//! Pictures of a page about steady motion.

use crate::report::plot::{Plot, Plots};

/// A chart of the page; those over the cycle are zoomed together.
pub(super) fn picture(plots: &mut Plots, chart: &Plot, (width, height): (f64, f64)) -> String {
    let link = if chart.x.name == "φ" { "cycle" } else { "" };
    plots.figure(chart, [width, height], link)
}
