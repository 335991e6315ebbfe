//! The picture of a map's page that answers pointing and clicking.

use super::picture;
use super::report::MapReport;
use crate::report::html::bar;
use crate::report::plot::Plots;
use crate::report::quantity::with_unit;
use crate::studies::axis::Axis;
use crate::studies::map::{Cell, Verdict};
use serde_json::{Value, json};

const SCRIPT: &str = include_str!("pointing.js");

/// The picture, the words about the cell that is pointed at, and the command of
/// the one that was clicked.
pub(super) fn section(report: &MapReport<'_>, plots: &mut Plots) -> String {
    let data = data(report).to_string().replace('<', "\\u003c");
    format!(
        "{}{}\
         <div id=\"cell\" class=\"told\" aria-live=\"polite\">Point at a cell for its value, verdict \
         and cause; click it for the command that runs it.</div>\n\
         <pre id=\"cell-command\" hidden></pre>\n\
         <script id=\"map-data\" type=\"application/json\">{data}</script>\n\
         <script>\n{SCRIPT}</script>\n",
        bar("map"),
        picture::on_page(report.study, report.result, plots)
    )
}

/// Every cell as it is told of.
fn data(report: &MapReport<'_>) -> Value {
    let study = report.study;
    let axis = |axis: &Axis| {
        let written: Vec<String> = axis.values().into_iter().map(|v| axis.written(v)).collect();
        json!({ "path": axis.path, "values": written })
    };
    let mut causes = Causes::default();
    let mut panels = Vec::new();
    for (panel, cells) in study.panels.panels.iter().zip(&report.result.panels) {
        let value = |cell: &Option<Cell>| {
            let value = cell.as_ref().and_then(|cell| cell.value);
            value.map(|value| with_unit(value, &study.unit, 6))
        };
        let verdict = |cell: &Option<Cell>| {
            let own = cell.as_ref().map(|cell| cell.verdict);
            own.and_then(|own| Verdict::ALL.iter().position(|verdict| *verdict == own))
        };
        let undetermined = |cell: &Option<Cell>| {
            cell.as_ref()
                .is_some_and(|cell| cell.determined == Some(false))
        };
        let marked = cells
            .iter()
            .enumerate()
            .filter(|(_, cell)| undetermined(cell));
        let marked: Vec<usize> = marked.map(|(index, _)| index).collect();
        let cause = |cell: &Option<Cell>| {
            let cause = cell.as_ref().map_or("", |cell| cell.cause.as_str());
            causes.number(cause)
        };
        let numbers: Vec<usize> = cells.iter().map(cause).collect();
        panels.push(json!({
            "label": panel.label,
            "settings": panel.settings,
            "values": cells.iter().map(value).collect::<Vec<_>>(),
            "verdicts": cells.iter().map(verdict).collect::<Vec<_>>(),
            "undetermined": marked,
            "causes": numbers,
        }));
    }
    json!({
        "figure": study.figure,
        "digits": study.digits,
        "x": axis(&study.x),
        "y": study.y.as_ref().map(axis),
        "verdicts": Verdict::ALL.map(Verdict::words),
        "causes": causes.texts,
        "command": report.command,
        "panels": panels,
    })
}

/// Causes, each once.
#[derive(Default)]
struct Causes {
    numbers: std::collections::BTreeMap<String, usize>,
    texts: Vec<String>,
}

impl Causes {
    fn number(&mut self, text: &str) -> usize {
        if let Some(&number) = self.numbers.get(text) {
            return number;
        }
        self.numbers.insert(text.to_owned(), self.texts.len());
        self.texts.push(text.to_owned());
        self.texts.len() - 1
    }
}
