//! From a scene to the model.
//!
//! Objects are taken drivers first, ids breaking ties, so that the model
//! depends on the objects and their ids alone, not on their order in a file.

mod order;
mod start;
#[cfg(test)]
mod tests;

pub use crate::dynamics::builder::{ChainParameters, FREE_FALL};

use crate::dynamics::builder::ModelBuilder;
use crate::dynamics::model::{Model, NodeMotion, OUTPUT, ObjectPart, PartInput};
use crate::fault::Fault;
use crate::frontend::graph::MechanismGraph;
use crate::frontend::scene::TypedScene;
use std::collections::BTreeMap;

/// Masses of a model beyond which its user is asked whether they are meant.
const MANY_MASSES: usize = 3000;

/// Lowers a scene's objects to a model.
///
/// Positions that cannot be assembled are looked for here: at t = 0 they are
/// faults; where the drive's prescribed motion leads into one later, the
/// model's warnings say when and name the reachable interval, and a stopping
/// track ends the run there.
///
/// # Errors
/// Every fault found, with the property it lies in.
pub fn lower(scene: &TypedScene) -> Result<Model, Vec<Fault>> {
    let graph = scene.graph();
    let order = order::drivers_first(scene, &graph)?;
    let explicit = start::displacements(scene);
    let objects = scene.objects.values();
    let followed = objects.flat_map(|one| {
        let driving = one.connections.iter().map(|one| &one.output);
        driving.chain(&one.mentions).cloned()
    });
    let followed = followed.collect();
    let builder = ModelBuilder::new(object_parts(&graph), scene.run.duration, explicit);
    let mut builder = builder.with_followed(followed);
    for id in order {
        let entry = &scene.objects[id];
        let inputs = entry.connections.iter();
        let inputs = inputs.map(|one| (one.port.as_str(), one.output.as_str()));
        if let Some(place) = builder.place(id, inputs) {
            entry.object.lower(&place, &mut builder);
        }
    }
    start::set(scene, &mut builder);
    let mut model = builder.finish()?;
    count_masses(&mut model);
    model.conditions.clone_from(&scene.run.conditions);
    Ok(model)
}

/// A word on models of more masses than engineers mean.
fn count_masses(model: &mut Model) {
    let masses = model.nodes.iter();
    let masses = masses.filter(|node| matches!(node.motion, NodeMotion::Mass { .. }));
    let count = masses.count();
    if count > MANY_MASSES {
        model.warnings.push(format!(
            "{count} masses: every step takes time in proportion to their number, and there \
             are as many natural frequencies; `dam compare --over OBJECT.masses=10,100,1000` \
             shows how many are needed"
        ));
    }
}

/// The objects of a mechanism and their outputs, without nodes, in the order of their
/// ids.
fn object_parts(graph: &MechanismGraph<'_>) -> Vec<ObjectPart> {
    let part = |id: String, kind, coordinate| ObjectPart {
        id,
        kind,
        coordinate,
        nodes: Vec::new(),
        inputs: Vec::new(),
        combination: None,
        driven_end: None,
        links: Vec::new(),
        contact: None,
        rigid_pair: None,
        pressing: None,
    };
    let mut parts = Vec::new();
    for vertex in graph.objects() {
        let Some(object) = vertex.object else {
            continue;
        };
        parts.push(part(
            vertex.id.to_owned(),
            object.kind(),
            object.coordinate(),
        ));
        for port in object.ports().outputs.into_iter().skip(1) {
            let id = format!("{}.{}", vertex.id, port.name);
            parts.push(part(id, OUTPUT, port.coordinate.unwrap_or_default()));
        }
    }
    parts.sort_by(|one, other| one.id.cmp(&other.id));
    let indices: BTreeMap<String, usize> = (parts.iter().enumerate())
        .map(|(index, part)| (part.id.clone(), index))
        .collect();
    let input = |port: &str, output: &str| {
        let driver = *indices.get(output)?;
        let port = port.to_owned();
        Some(PartInput { port, driver })
    };
    for part in &mut parts {
        part.inputs = match part.id.split_once('.') {
            // An output is driven by its own object.
            Some((id, _)) => input("", id).into_iter().collect(),
            None => {
                let joints = graph.inputs(&part.id).into_iter();
                joints
                    .filter_map(|(_, joint)| input(joint.input, joint.output))
                    .collect()
            }
        };
    }
    parts
}
