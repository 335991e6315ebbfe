//! The state at t = 0 that a scene asks for.

use crate::dynamics::builder::ModelBuilder;
use crate::dynamics::model::{ExplicitStart, NodeIndex, Start};
use crate::frontend::scene::{StartSpec, TypedScene};
use std::collections::BTreeMap;

/// Displacements of the masses of objects whose start is given, by id.
pub(super) fn displacements(scene: &TypedScene) -> BTreeMap<String, Vec<f64>> {
    match &scene.run.start {
        StartSpec::Explicit(states) => (states.iter())
            .map(|(id, (displacement, _))| (id.clone(), displacement.clone()))
            .collect(),
        _ => BTreeMap::new(),
    }
}

/// Sets the start; explicit ones are checked and go by index.
pub(super) fn set(scene: &TypedScene, builder: &mut ModelBuilder) {
    let start = match &scene.run.start {
        StartSpec::Kinetostatic => Start::Kinetostatic,
        StartSpec::Static => Start::Static,
        StartSpec::OnLaw => Start::OnLaw,
        StartSpec::Explicit(states) => explicit(states, builder),
    };
    builder.model_mut().start = start;
}

fn explicit(states: &BTreeMap<String, (Vec<f64>, Vec<f64>)>, builder: &mut ModelBuilder) -> Start {
    let mut explicit = Vec::new();
    for (id, (displacement, speed)) in states {
        let path = format!("run.start.{id}");
        let objects = &builder.model().objects;
        let Some(object) = objects.iter().position(|part| part.id == *id) else {
            let message = format!("there is no object `{id}`");
            builder.other_faults().add(path, message, "");
            continue;
        };
        if let Some(reduced) = builder.model().reduction_of(object) {
            let modes: Vec<NodeIndex> = reduced.modes.iter().map(|mode| mode.0).collect();
            whole_body(builder, &modes, &path, [displacement, speed], &mut explicit);
            continue;
        }
        check(builder, object, &path, [displacement, speed]);
        explicit.push(ExplicitStart {
            object,
            displacement: displacement.clone(),
            speed: speed.clone(),
        });
    }
    Start::Explicit(explicit)
}

/// An object that is reduced to modes starts as a whole: every mode, or every mass of its
/// chain, at its displacement and its speed.
fn whole_body(
    builder: &mut ModelBuilder,
    modes: &[NodeIndex],
    path: &str,
    state: [&[f64]; 2],
    explicit: &mut Vec<ExplicitStart>,
) {
    let [Some(_), Some(_)] = state.map(|values| (values.len() == 1).then_some(values)) else {
        let message = "an object that is reduced to modes starts with one displacement and one \
                       speed, those of the whole body";
        let faults = builder.other_faults();
        faults.add(path, message, "give one value each");
        return;
    };
    for (name, values) in ["displacement", "speed"].into_iter().zip(state) {
        let faults = builder.other_faults();
        faults.finite(&format!("{path}.{name}[0]"), values[0]);
    }
    let objects = &builder.model().objects;
    explicit.extend(objects.iter().enumerate().filter_map(|(object, part)| {
        let masses = part
            .nodes
            .iter()
            .filter(|node| modes.contains(node))
            .count();
        let of_each = |value: f64| vec![value; masses];
        (masses > 0).then(|| ExplicitStart {
            object,
            displacement: of_each(state[0][0]),
            speed: of_each(state[1][0]),
        })
    }));
}

fn check(builder: &mut ModelBuilder, object: usize, path: &str, state: [&[f64]; 2]) {
    let model = builder.model();
    let nodes = &model.objects[object].nodes;
    let free = |&&node: &&NodeIndex| model.nodes[node].motion.is_free();
    let masses = nodes.iter().filter(free).count();
    // An object with faults of its own has no nodes to compare with.
    let known = !nodes.is_empty();
    let faults = builder.other_faults();
    if masses == 0 && known {
        let message = "it has no masses of its own: its motion follows from its driver";
        faults.add(path, message, "leave it out of the start");
        return;
    }
    for (name, values) in ["displacement", "speed"].into_iter().zip(state) {
        let path = format!("{path}.{name}");
        if values.len() != masses && known {
            let message = format!("{} values for {masses} masses", values.len());
            faults.add(&*path, message, "give one value a mass");
        }
        for (index, &value) in values.iter().enumerate() {
            faults.finite(&format!("{path}[{index}]"), value);
        }
    }
}
