//! Linkages as an editor draws them: their points, pairs and positions, and what is known of their
//! structure.

use crate::dynamics::model::{Coordinate, LinkageBody, Model};
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::spec::{LinkageSpec, NamedPoint, PairKind, PairSpec, PointOf};
use serde_json::{Value, json};

/// Positions over the reach of the input.
const PLACES: usize = 181;

/// All linkages of a model: lengths in m, angles in rad. Positions that cannot be are left out,
/// `null`.
pub(in crate::report) fn sketches(model: &Model) -> Value {
    model
        .linkages
        .iter()
        .map(|body| sketch(model, body))
        .collect()
}

fn sketch(model: &Model, body: &LinkageBody) -> Value {
    let (linkage, part) = (&body.linkage, &model.objects[body.object]);
    let (spec, structure) = (linkage.spec(), linkage.structure());
    let turning = part.coordinate == Coordinate::Turning;
    let (inputs, start) = inputs(linkage);
    let structure_told = structure.to_string();
    let links = spec.links.iter();
    json!({
        "id": part.id,
        "told": structure_told.lines().collect::<Vec<_>>(),
        "range": linkage.range().describe(structure, turning),
        "unit": if turning { "rad" } else { "m" },
        "links": links
            .map(|link| json!({ "name": link.name, "points": points(&link.points) }))
            .collect::<Vec<_>>(),
        "ground": points(&spec.ground),
        "pairs": spec.pairs.iter().map(|pair| joined(spec, pair)).collect::<Vec<_>>(),
        "poses": poses(linkage, &inputs),
        "inputs": inputs,
        "start": start,
    })
}

fn points(points: &[NamedPoint]) -> Value {
    let point = |point: &NamedPoint| json!({ "name": point.name, "at": point.at });
    points.iter().map(point).collect()
}

fn joined(spec: &LinkageSpec, pair: &PairSpec) -> Value {
    let end = |end: &PointOf| json!({ "link": end.link, "at": end.at });
    let direction = match pair.kind {
        PairKind::Revolute { .. } => None,
        PairKind::Sliding { direction, .. } => Some(direction),
    };
    let driven = spec.pairs.get(spec.driver).is_some_and(|one| one == pair);
    json!({ "name": pair.name, "on": end(&pair.on), "link": end(&pair.link),
            "direction": direction, "driven": driven })
}

/// Inputs over the reach, and the place of the start among them.
fn inputs(linkage: &Linkage) -> (Vec<f64>, usize) {
    let range = linkage.range();
    let size = linkage.size().max(f64::MIN_POSITIVE);
    let [from, to] = match (range.period, range.ends()) {
        (Some(period), _) => [range.start, range.start + period.length],
        (None, [from, to]) => [
            if from.is_finite() {
                from
            } else {
                range.start - size
            },
            if to.is_finite() {
                to
            } else {
                range.start + size
            },
        ],
    };
    let last = (PLACES - 1) as f64;
    let share = ((range.start - from) / (to - from)).clamp(0.0, 1.0);
    let start = if share.is_finite() {
        (share * last).round() as usize
    } else {
        0
    };
    let value = |place: usize| match place == start {
        // Itself, not what is near it.
        true => range.start,
        false => from + (to - from) * place as f64 / last,
    };
    ((0..PLACES).map(value).collect(), start)
}

/// Of each input the links' frames: x, y, cosine and sine of the angle, one after the other.
fn poses(linkage: &Linkage, inputs: &[f64]) -> Vec<Option<Vec<f64>>> {
    let mut work = linkage.workspace();
    let links = linkage.spec().links.len();
    let place = |&input: &f64| {
        linkage.solve(input, 0, &mut work).ok()?;
        let poses = (0..links).map(|link| work.pose(link));
        let numbers: Vec<f64> = poses
            .flat_map(|pose| [pose.x, pose.y, pose.cos, pose.sin])
            .collect();
        numbers
            .iter()
            .all(|number| number.is_finite())
            .then_some(numbers)
    };
    inputs.iter().map(place).collect()
}
