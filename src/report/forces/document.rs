//! A study as one JSON document.

use super::ForcesReport;
use crate::studies::forces::{
    Counterweight, CycleForces, Extreme, ForceStudy, MasslessComparison, NEGLIGIBLE,
};
use serde_json::{Map, Value, json};

/// Everything that a study found, in SI units: figures, zones, checks, and all
/// columns.
pub fn document(report: &ForcesReport<'_>) -> Value {
    let (study, massless) = (report.study, report.massless);
    let linkage = &study.linkage;
    let output = study
        .settings
        .output
        .map(|index| &linkage.outputs[index].name);
    let mut object = Map::new();
    object.insert("dam".into(), json!(1));
    object.insert("scene".into(), json!(report.name));
    object.insert("hash".into(), json!(report.hash));
    object.insert("object".into(), json!(report.object));
    object.insert("motion".into(), json!(report.motion));
    object.insert("convention".into(), json!(study.settings.convention.name()));
    object.insert("output".into(), json!(output));
    object.insert("positions".into(), json!(study.rows.len()));
    object.insert("extremes".into(), extremes(study));
    object.insert(
        "cycle".into(),
        study
            .cycle
            .as_ref()
            .map_or(Value::Null, |c| cycle(c, study)),
    );
    object.insert("zones".into(), zones(study));
    object.insert("indeterminate".into(), indeterminate(study));
    object.insert(
        "counterweight".into(),
        study
            .counterweight
            .as_ref()
            .map_or(Value::Null, |c| counterweight(c, study)),
    );
    object.insert("checks".into(), json!(study.checks()));
    let unique = study.solved().all(|(_, forces)| forces.solved.unique);
    object.insert("unique".into(), json!(unique));
    object.insert("warnings".into(), json!(report.warnings));
    object.insert("columns".into(), values(study));
    if let Some(found) = massless {
        object.insert("massless".into(), comparison(found));
    }
    Value::Object(object)
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
    let mut all = Map::new();
    all.extend(entries);
    Value::Object(all)
}

fn cycle(cycle: &CycleForces, study: &ForceStudy) -> Value {
    let pairs = study.linkage.pairs.iter().zip(&cycle.pair_losses);
    let mut losses = Map::new();
    losses.extend(pairs.map(|(p, loss)| (p.name.clone(), json!(loss))));
    json!({
        "closed": cycle.closed,
        "duration": cycle.duration,
        "drive_work": cycle.drive_work,
        "load_work": cycle.load_work,
        "applied_work": cycle.applied_work,
        "loss": cycle.loss,
        "losses": losses,
        "efficiency": cycle.efficiency,
        "mean_drive": cycle.mean_drive,
        "rms_drive": cycle.rms_drive,
    })
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
    json!({
        "link": study.linkage.links[found.link].name,
        "mass_radius": found.mass_radius,
        "angle": found.angle,
        "rms_without": found.rms[0],
        "rms_with": found.rms[1],
        "greatest_without": found.greatest[0],
        "greatest_with": found.greatest[1],
    })
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

fn comparison(found: &MasslessComparison) -> Value {
    let points = found.points.iter().map(|point| {
        json!({
            "parameter": point.parameter,
            "speed": point.speed,
            "deviation": point.deviation,
            "missing": point.missing,
            "chi": point.chi,
        })
    });
    json!({
        "mass": found.mass,
        "load": found.load,
        "greatest_chi": found.greatest,
        "coordinates": found.coordinates,
        "chi": found.massless,
        "points": points.collect::<Vec<_>>(),
        "negligible": NEGLIGIBLE,
        "negligible_up_to": found.negligible_up_to,
    })
}
