//! A map as one JSON document.

use crate::studies::axis::Axis;
use crate::studies::map::{Cell, MapResult, NEAR_HARMONIC, RESONANCE, Study, THROWN_OFF, summary};
use crate::studies::spread::CHANGE;
use serde_json::{Value, json};

/// The document that `dam map --json` prints. Cells stand in the order of the
/// rows, along the x axis first; unknown ones are null.
pub fn document(study: &Study<'_>, result: &MapResult) -> Value {
    let of = |cells: &[Option<Cell>], read: &dyn Fn(&Cell) -> Value| -> Value {
        let one = |cell: &Option<Cell>| cell.as_ref().map_or(Value::Null, read);
        cells.iter().map(one).collect()
    };
    let panels: Vec<Value> = (study.panels.panels.iter())
        .zip(&result.panels)
        .zip(summary(study, result))
        .map(|((panel, cells), summary)| {
            json!({
                "label": panel.label,
                "settings": panel.settings,
                "summary": summary,
                "values": of(cells, &|cell| json!(cell.value)),
                "verdicts": of(cells, &|cell| json!(cell.verdict)),
                "judgements": of(cells, &|cell| json!(cell.verdict.judgement())),
                "causes": of(cells, &|cell| json!(cell.cause)),
                "determined": of(cells, &|cell| json!(cell.determined)),
                "moved": of(cells, &|cell| json!(cell.moved)),
                "rigid_margin": of(cells, &|cell| json!(cell.rigid_margin)),
            })
        })
        .collect();
    json!({
        "dam": 1,
        "scene": study.scene,
        "hash": study.hash,
        "figure": study.figure,
        "rigid": study.rigid,
        "unit": study.unit,
        "x": axis(&study.x, &study.parameter_units[0]),
        "y": study.y.as_ref().map(|y| axis(y, &study.parameter_units[1])),
        "complete": result.complete,
        "thresholds": {
            "thrown_off": THROWN_OFF,
            "resonance": RESONANCE,
            "near_harmonic": NEAR_HARMONIC,
            "change_of_loads": study.check_determined.then_some(CHANGE),
            "digits": study.check_determined.then_some(study.digits),
        },
        "panels": panels,
    })
}

/// An axis with the unit of its values: the one it was given in, else the SI
/// unit of the parameter where it is known.
fn axis(axis: &Axis, unit: &str) -> Value {
    json!({ "path": axis.path, "unit": unit, "log": axis.log, "values": axis.values() })
}
