//! What a map's page answers to pointing and clicking.

use crate::report::quantity::with_unit;
use crate::studies::axis::Axis;
use crate::studies::map::{Cell, MapResult, Study, Verdict};
use serde_json::{Value, json};

const SCRIPT: &str = include_str!("pointing.js");

/// The words about the cell that is pointed at, and the command of the one that was clicked.
pub(super) fn section(study: &Study<'_>, result: &MapResult, command: &[String]) -> String {
    let data = data(study, result, command);
    let data = data.to_string().replace('<', "\\u003c");
    format!(
        "<div id=\"cell\" class=\"told\" aria-live=\"polite\">Point at a cell for its value, verdict \
         and cause; click it for the command that runs it.</div>\n\
         <pre id=\"cell-command\" hidden></pre>\n\
         <script id=\"map-data\" type=\"application/json\">{data}</script>\n\
         <script>\n{SCRIPT}</script>\n"
    )
}

/// Every cell as it is told of.
fn data(study: &Study<'_>, result: &MapResult, command: &[String]) -> Value {
    let axis = |axis: &Axis| {
        let written: Vec<String> = axis
            .values()
            .into_iter()
            .map(|v| axis.value_with_unit(v))
            .collect();
        json!({ "path": axis.path, "values": written })
    };
    let mut causes = Causes::default();
    let mut panels = Vec::new();
    for (panel, cells) in study.panels.panels.iter().zip(&result.panels) {
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
        "command": command,
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
