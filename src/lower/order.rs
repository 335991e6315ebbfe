//! The order in which objects are lowered.

use crate::fault::{Fault, Faults};
use crate::object::Description;
use crate::scene::Scene;
use std::collections::{BTreeMap, BTreeSet};

/// The objects' ids, drivers before driven, the smallest id first among those
/// that could come next.
///
/// # Errors
/// Inputs that name nothing, drives with and other objects without input, and
/// circles. Scenes that were read have none of these.
pub(super) fn drivers_first(scene: &Scene) -> Result<Vec<&str>, Vec<Fault>> {
    check_inputs(scene)?;
    let mut order = Vec::with_capacity(scene.objects.len());
    let mut ready: BTreeSet<&str> = BTreeSet::new();
    let mut followers: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (id, entry) in &scene.objects {
        match entry.driver() {
            None => {
                ready.insert(id);
            }
            Some(input) => followers.entry(input).or_default().push(id),
        }
    }
    while let Some(id) = ready.pop_first() {
        order.push(id);
        ready.extend(followers.remove(id).unwrap_or_default());
    }
    // Whoever waits for an object that was never taken is left over.
    let left: BTreeSet<&str> = followers.into_values().flatten().collect();
    let mut faults = Faults::default();
    for id in left {
        let message = format!("no drive moves `{id}`: its inputs run in a circle");
        let hint = "let the chain of inputs begin at a drive";
        faults.add(format!("{id}.input"), message, hint);
    }
    faults.check()?;
    Ok(order)
}

fn check_inputs(scene: &Scene) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    for (id, entry) in &scene.objects {
        let path = format!("{id}.input");
        match (entry.object.description(), entry.driver()) {
            (Description::Drive(_), Some(_)) => {
                faults.add(path, "a drive has no input", "leave `input` out");
            }
            (Description::Chain(_) | Description::Linkage(_), None) => {
                faults.add(path, "it is driven by nothing", "name its driver");
            }
            (_, Some(input)) if !scene.objects.contains_key(input) => {
                faults.add(path, format!("there is no object `{input}`"), "");
            }
            _ => {}
        }
    }
    faults.check()
}
