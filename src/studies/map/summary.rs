//! What a map shows, in a few numbers.

use super::cell::Cell;
use super::grid::MapResult;
use super::study::Study;
use crate::studies::prepared::Verdict;
use serde::Serialize;
use std::collections::BTreeMap;

/// An extreme of the figure, and where it lies.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extreme {
    /// The figure.
    pub value: f64,
    /// Value of the x parameter, with its unit.
    pub x: String,
    /// Value of the y parameter, with its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<String>,
    /// Values of the parameters in the units of the axes.
    #[serde(skip)]
    pub place: (f64, Option<f64>),
    /// The verdict there.
    pub verdict: Verdict,
}

/// Summary of a panel in a few numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PanelSummary {
    /// Label of what the panel differs in.
    pub label: String,
    /// Number of cells of each verdict that occurs.
    pub verdicts: BTreeMap<Verdict, usize>,
    /// Cells whose figure is not known to the digits asked for.
    pub undetermined: usize,
    /// Cells that are not known, because the map was interrupted.
    pub missing: usize,
    /// Least value; `None` when no cell has one.
    pub least: Option<Extreme>,
    /// Greatest value.
    pub greatest: Option<Extreme>,
}

/// Sums up every panel.
pub fn summary(study: &Study<'_>, result: &MapResult) -> Vec<PanelSummary> {
    let panels = study.panels.panels.iter().zip(&result.panels);
    panels
        .map(|(panel, cells)| {
            let mut verdicts = BTreeMap::new();
            for cell in cells.iter().flatten() {
                *verdicts.entry(cell.verdict).or_insert(0) += 1;
            }
            PanelSummary {
                label: panel.label.clone(),
                verdicts,
                undetermined: cells
                    .iter()
                    .flatten()
                    .filter(|cell| cell.determined == Some(false))
                    .count(),
                missing: cells.iter().filter(|cell| cell.is_none()).count(),
                least: extreme(study, cells, |new, old| new < old),
                greatest: extreme(study, cells, |new, old| new > old),
            }
        })
        .collect()
}

/// The first cell whose value beats all others.
fn extreme(
    study: &Study<'_>,
    cells: &[Option<Cell>],
    beats: impl Fn(f64, f64) -> bool,
) -> Option<Extreme> {
    let mut best: Option<(usize, f64, Verdict)> = None;
    for (index, cell) in cells.iter().enumerate() {
        let Some((value, verdict)) = cell
            .as_ref()
            .and_then(|cell| Some((cell.value?, cell.verdict)))
        else {
            continue;
        };
        if best.is_none_or(|(_, old, _)| beats(value, old)) {
            best = Some((index, value, verdict));
        }
    }
    let (index, value, verdict) = best?;
    let place = study.parameters_at_cell(index);
    Some(Extreme {
        value,
        x: study.x.value_with_unit(place.0),
        y: (study.y.as_ref().zip(place.1)).map(|(axis, y)| axis.value_with_unit(y)),
        place,
        verdict,
    })
}
