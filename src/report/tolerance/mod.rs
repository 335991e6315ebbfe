//! The tolerance of results, as findings, charts and rows.

mod charts;
mod findings;
mod rows;

pub use findings::findings;
pub use rows::rows;

use crate::report::addresses::result_words;
use crate::report::quantity::capitalised;
use crate::studies::tolerance::Tolerances;

/// A result as a heading; an address stays as it is.
fn heading(figure: &str) -> String {
    let words = result_words(figure);
    match words == figure {
        true => words,
        false => capitalised(&words),
    }
}

/// The places of the dimensions in the order of their effects on a result, the greatest first.
fn by_effect(found: &Tolerances, figure: usize) -> Vec<usize> {
    let effects = &found.figures[figure].effects;
    let reach = |at: &usize| {
        let middle = found.figures[figure].middle.unwrap_or(0.0);
        let limits = effects[*at].limits;
        let each = [limits.lower, limits.upper].into_iter().flatten();
        let moved = each.map(|value| (value - middle).abs()).fold(0.0, f64::max);
        let slope = effects[*at].derivative.unwrap_or(0.0);
        moved.max((slope * found.dimensions[*at].zone.half()).abs())
    };
    let mut all: Vec<usize> = (0..effects.len()).collect();
    all.sort_by(|a, b| reach(b).total_cmp(&reach(a)));
    all
}
