//! The kinematics as one JSON document.

use crate::kinematics::linkage::multi::SingularCurve;
use crate::studies::kinematics::{Kinematics, Plane, PlaneInput};
use serde_json::{Map, Value, json};

/// Everything, in SI units: structure, summary, and every column.
pub fn document(scene: &str, hash: &str, found: &Kinematics) -> Value {
    let structure = found.linkage.structure();
    let groups: Vec<String> = (0..structure.groups.len())
        .map(|group| structure.describe(group))
        .collect();
    let mut columns = Map::new();
    for (column, extremes) in found.columns.iter().zip(&found.extremes) {
        let end = |(at, value): (f64, f64)| match value.is_infinite() {
            true => json!({ "value": null, "unbounded_towards": at }),
            false => json!({ "at": at, "value": value }),
        };
        columns.insert(
            column.name(),
            json!({
                "unit": column.unit,
                "least": end(extremes.least),
                "greatest": end(extremes.greatest),
                "error": column.error,
                "undetermined": column.undetermined,
                "values": column.values,
            }),
        );
    }
    let mut document = json!({
        "dam": 1,
        "scene": scene,
        "hash": hash,
        "object": found.object,
        "mobility": structure.explanation,
        "groups": groups,
        "input": { "motion": found.motion, "limits": found.limits },
        "axis": found.axis,
        "strokes": strokes(found),
        "transmission_angles": transmission(found),
        "equilibria": equilibria_json(found),
        "stopped": found.stopped,
        "checks": found.checks(),
        "warnings": found.warnings,
        "columns": columns,
    });
    if let (Some(plane), Some(own)) = (&found.plane, document.as_object_mut()) {
        own.insert("singular_positions".to_owned(), singular(found, plane));
    }
    document
}

/// The singular positions over two inputs.
fn singular(found: &Kinematics, plane: &Plane) -> Value {
    let input = |input: &PlaneInput| {
        let unit = input.coordinate.unit();
        json!({ "name": input.name, "unit": unit, "from": input.range[0], "to": input.range[1] })
    };
    let structure = found.linkage.structure();
    let curve = |curve: &SingularCurve| {
        json!({
            "group": structure.describe(curve.group),
            "closed": curve.closed,
            "points": curve.points,
        })
    };
    json!({
        "inputs": plane.inputs.each_ref().map(input),
        "curves": plane.curves.iter().map(curve).collect::<Vec<_>>(),
    })
}

fn strokes(found: &Kinematics) -> Vec<Value> {
    let strokes = found.strokes.iter().map(|stroke| {
        let end = |(at, value): (f64, f64)| json!({ "input": at, "value": value });
        json!({
            "of": stroke.owner,
            "unit": stroke.unit,
            "least": end(stroke.ends[0]),
            "greatest": end(stroke.ends[1]),
            "stroke": stroke.ends[1].1 - stroke.ends[0].1,
            "input_while_rising": stroke.rise_and_return[0],
            "input_while_falling": stroke.rise_and_return[1],
            "time_ratio": stroke.time_ratio,
        })
    });
    strokes.collect()
}

fn transmission(found: &Kinematics) -> Vec<Value> {
    let angles = found.transmission.iter().map(|angle| {
        let end = |(at, value): (f64, f64)| json!({ "at": at, "value": value });
        json!({
            "of": angle.owner,
            "unit": "rad",
            "least": end(angle.least),
            "greatest": end(angle.greatest),
        })
    });
    angles.collect()
}

fn equilibria_json(found: &Kinematics) -> Vec<Value> {
    let equilibria = found.equilibria.iter().map(|rest| {
        json!({
            "input": rest.at,
            "stable": rest.is_stable(),
            "stiffness": rest.stiffness,
            "inertia": rest.inertia,
            "damping": rest.damping,
            "angular_frequency": rest.frequency(),
            "damping_ratio": rest.damping_ratio(),
            "growth": rest.growth(),
        })
    });
    equilibria.collect()
}
