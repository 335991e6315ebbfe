//! Linkages as an editor draws them: their points, pairs and positions, and what is known of their
//! structure.

mod courses;

use crate::dynamics::model::{Coordinate, Model};
use crate::kinematics::linkage::Structure;
use crate::kinematics::linkage::multi::spec::InputCoordinate;
use crate::kinematics::linkage::spec::{LinkageSpec, NamedPoint, PairKind, PairSpec, PointOf};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// All linkages of a model: lengths in m, angles in rad. Those of several inputs go from where
/// `at` has them, by the object's id, one input at a time; else from where they are put together.
pub(in crate::report) fn sketches(model: &Model, at: &BTreeMap<String, Vec<f64>>) -> Value {
    let ones = model.linkages.iter().map(|body| {
        let part = &model.objects[body.object];
        let turning = part.coordinate == Coordinate::Turning;
        let (linkage, spec) = (&body.linkage, body.linkage.spec());
        let course = courses::course_of_one(linkage, turning);
        let driven = |pair: usize| pair == spec.driver;
        sketch(&part.id, spec, linkage.structure(), &driven, vec![course])
    });
    let several = model.multi_linkages.iter().map(|body| {
        let part = &model.objects[body.object];
        let (linkage, spec) = (&body.linkage, &body.linkage.spec().linkage);
        let at = at.get(&part.id).map(Vec::as_slice);
        let moves = |pair: usize| {
            let mut inputs = linkage.inputs().iter();
            inputs.any(|input| input.coordinate == InputCoordinate::Pair(pair))
        };
        let courses = courses::multi_input_courses(linkage, at);
        let mut told = sketch(&part.id, spec, linkage.structure(), &moves, courses);
        let floating = linkage.inputs().iter();
        let floating = floating.filter_map(|input| input.coordinate.floating_link());
        told["floating"] = json!(floating.collect::<BTreeSet<usize>>());
        told
    });
    ones.chain(several).collect()
}

fn sketch(
    id: &str,
    spec: &LinkageSpec,
    structure: &Structure,
    driven: &dyn Fn(usize) -> bool,
    courses: Vec<Value>,
) -> Value {
    let told = structure.to_string();
    let links = spec.links.iter();
    let pairs = spec.pairs.iter().enumerate();
    json!({
        "id": id,
        "told": told.lines().collect::<Vec<_>>(),
        "links": links
            .map(|link| json!({ "name": link.name, "points": points(&link.points) }))
            .collect::<Vec<_>>(),
        "floating": [],
        "ground": points(&spec.ground),
        "pairs": pairs.map(|(k, pair)| pair_json(pair, driven(k))).collect::<Vec<_>>(),
        "courses": courses,
    })
}

fn points(points: &[NamedPoint]) -> Value {
    let point = |point: &NamedPoint| json!({ "name": point.name, "at": point.at });
    points.iter().map(point).collect()
}

fn pair_json(pair: &PairSpec, driven: bool) -> Value {
    let end = |end: &PointOf| json!({ "link": end.link, "at": end.at });
    let direction = match pair.kind {
        PairKind::Sliding { direction, .. } => Some(direction),
        _ => None,
    };
    json!({ "name": pair.name, "on": end(&pair.on), "link": end(&pair.link),
            "direction": direction, "driven": driven })
}
