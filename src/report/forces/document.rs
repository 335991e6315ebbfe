//! A study as one JSON document.

use super::ForcesReport;
use crate::studies::forces::{Counterweight, CycleForces, Extreme, ForceStudy, NEGLIGIBLE};
use serde_json::{Map, Value, json};

/// Everything that a study found, in SI units: figures, zones, checks, and all
/// columns.
pub fn document(report: &ForcesReport<'_>) -> Value {
    let study = report.study;
    let output = study.settings.output;
    let mut document = json!({
        "dam": 1,
        "scene": report.name,
        "hash": report.hash,
        "object": report.object,
        "motion": report.motion,
        "convention": study.settings.convention.name(),
        "output": output.map(|index| &study.linkage.outputs[index].name),
        "positions": study.rows.len(),
        "extremes": extremes(study),
        "cycle": study.cycle.as_ref().map(|found| cycle(found, study)),
        "zones": zones(study),
        "indeterminate": indeterminate(study),
        "counterweight": study.counterweight.as_ref().map(|found| counterweight(found, study)),
        "checks": study.checks(),
        "unique": study.solved().all(|(_, forces)| forces.solved.unique),
        "warnings": report.warnings,
        "columns": values(study),
    });
    if let Some(found) = report.massless {
        document["massless"] = json!(found);
        document["massless"]["negligible"] = json!(NEGLIGIBLE);
    }
    document
}

/// What rigid links leave open, and which constraints are redundant.
fn indeterminate(study: &ForceStudy) -> Value {
    let linkage = &study.linkage;
    let redundant = linkage.redundant.iter().map(|one| one.describe(linkage));
    json!({
        "redundant": redundant.collect::<Vec<_>>(),
        "reactions": study.open_names(),
        "drive": study.indeterminate.drive,
    })
}

fn extremes(study: &ForceStudy) -> Value {
    let entries = study.extremes.iter().map(|found| {
        // An infinite value is null in JSON.
        let end = |extreme: &Extreme| match extreme.value.is_finite() {
            true => json!({ "value": extreme.value, "at": extreme.at }),
            false => json!({ "value": null, "unbounded_towards": extreme.at }),
        };
        let value = json!({
            "unit": found.unit,
            "least": end(&found.least),
            "greatest": end(&found.greatest),
        });
        (found.name.clone(), value)
    });
    Value::Object(entries.collect())
}

fn cycle(cycle: &CycleForces, study: &ForceStudy) -> Value {
    let pairs = study.linkage.pairs.iter().zip(&cycle.pair_losses);
    let losses = pairs.map(|(pair, loss)| (pair.name.clone(), json!(loss)));
    let mut document = json!(cycle);
    document["losses"] = Value::Object(losses.collect());
    document
}

fn zones(study: &ForceStudy) -> Value {
    let zones = study.zones.iter().map(|zone| {
        let ends = [zone.from, zone.to].into_iter().zip(zone.unbounded);
        let ends = ends.filter(|(_, unbounded)| *unbounded);
        let towards: Vec<f64> = ends.map(|(at, _)| at).collect();
        json!({
            "kind": zone.kind.name(),
            "from": zone.from,
            "to": zone.to,
            "unbounded_towards": towards,
        })
    });
    Value::Array(zones.collect())
}

fn counterweight(found: &Counterweight, study: &ForceStudy) -> Value {
    let figures = found
        .figures()
        .map(|(name, value)| (name.to_owned(), json!(value)));
    let link = &study.linkage.links[found.link].name;
    let link = ("link".to_owned(), json!(link));
    Value::Object(figures.into_iter().chain([link]).collect())
}

fn values(study: &ForceStudy) -> Value {
    let list = |values: Vec<Option<f64>>, unit: &str| json!({ "unit": unit, "values": values });
    let mut object = Map::new();
    let coordinates = study.rows.iter().map(|row| Some(row.motion.coordinate));
    object.insert(
        "coordinate".into(),
        list(coordinates.collect(), study.coordinate_unit()),
    );
    if study.rows.iter().any(|row| row.time.is_some()) {
        let times = study.rows.iter().map(|row| row.time);
        object.insert("time".into(), list(times.collect(), "s"));
    }
    for column in study.columns() {
        let values = study.rows.iter().map(|row| column.value(row));
        let mut told = list(values.collect(), &column.unit);
        if column.indeterminate {
            told["indeterminate"] = json!(true);
        }
        object.insert(column.name.clone(), told);
    }
    Value::Object(object)
}
