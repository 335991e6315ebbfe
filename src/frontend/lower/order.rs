//! Whether every input of a scene's objects is connected, and the order in which the
//! objects are lowered.

use crate::fault::{Fault, Faults};
use crate::frontend::graph::MechanismGraph;
use crate::frontend::object::{INPUT, object_of};
use crate::frontend::scene::TypedScene;

/// The objects' ids, drivers before driven, the smallest id first among those
/// that could come next.
///
/// # Errors
/// Inputs that name nothing, connections without an input and inputs without a
/// connection, and circles. Scenes that were read have none of these.
pub(super) fn drivers_first<'s>(
    scene: &'s TypedScene,
    graph: &MechanismGraph<'s>,
) -> Result<Vec<&'s str>, Vec<Fault>> {
    check_inputs(scene, graph)?;
    graph.order().map_err(|left| {
        let fault = |id: &str| {
            let message = format!("no drive moves `{id}`: its inputs run in a circle");
            let hint = "let the chain of inputs begin at a drive";
            let ports = scene.objects[id].object.ports().inputs;
            let first = ports.first().map_or(INPUT, |port| &port.name);
            Fault::new(property(id, first), message, hint)
        };
        left.into_iter().map(fault).collect()
    })
}

/// Address of the property that connects an input port.
fn property(id: &str, port: &str) -> String {
    match port {
        INPUT => format!("{id}.{INPUT}"),
        _ => format!("{id}.inputs.{port}.object"),
    }
}

fn check_inputs(scene: &TypedScene, graph: &MechanismGraph<'_>) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for (id, entry) in &scene.objects {
        let ports = entry.object.ports().inputs;
        for port in &ports {
            if entry.connection(&port.name).is_none() {
                let message = "it is driven by nothing";
                faults.add(property(id, &port.name), message, "name its driver");
            }
        }
        for connection in &entry.connections {
            if !ports.iter().any(|port| port.name == connection.port) {
                let (message, hint) = match ports.is_empty() {
                    true => ("a drive has no input".to_owned(), "leave `input` out"),
                    false => (format!("it has no input `{}`", connection.port), ""),
                };
                faults.add(property(id, &connection.port), message, hint);
            }
        }
        for end in graph.dangling().iter().filter(|end| end.id == id) {
            if ports.is_empty() {
                continue; // said already
            }
            let object = object_of(end.output);
            let message = match scene.objects.contains_key(object) {
                true => format!(
                    "`{object}` has no output `{}`",
                    &end.output[object.len() + 1..]
                ),
                false => format!("there is no object `{object}`"),
            };
            faults.add(property(id, end.input), message, "");
        }
    }
    faults.check()
}
