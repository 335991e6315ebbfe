//! What the descriptions of a reduced scene say.

use super::findings::{Reduction, Step};
use crate::frontend::read::{Node, Value};
use crate::frontend::scene::edit::{property, put, take};
use crate::units::shown;

/// Writes into the scene what was left out of it and why that is allowed. What it expects of
/// a run was expected of the whole scene and goes.
pub(super) fn describe(root: &mut Node, reduction: &Reduction) {
    take(root, "run.accuracy");
    if let Value::Object(members) = &mut root.value {
        members.retain(|member| member.name != "expect");
    }
    let mut ids: Vec<&String> = reduction
        .removed()
        .map(|step| &step.removal.object)
        .collect();
    ids.sort();
    ids.dedup();
    for id in ids {
        let own = reduction
            .removed()
            .filter(|step| step.removal.object == *id);
        let said: Vec<String> = own.map(sentence).collect();
        let address = format!("{id}.description");
        let before = property(root, &address).and_then(Node::text);
        let text = joined(before, &format!("Reduced: {}.", said.join("; ")));
        put(root, &address, text);
    }
    let kept: Vec<String> = (reduction.certificate.accuracy.iter())
        .filter_map(|(figure, found)| {
            let error = found.error?;
            let unit = &found.unit;
            let said = format!(
                "{figure} = {} ± {} {unit}",
                shown(found.value, 6),
                shown(error, 2)
            );
            Some(said.trim_end().to_owned())
        })
        .collect();
    if !kept.is_empty() {
        let before = root.get("description").and_then(Node::text);
        let said = format!("Reduced to what gives {}.", kept.join(", "));
        let text = joined(before, &said);
        put_description(root, text);
    }
}

/// Sets the description of the scene, behind its name where it had none.
fn put_description(root: &mut Node, text: String) {
    let has = root.get("description").is_some();
    root.put("description", text);
    let Value::Object(members) = &mut root.value else {
        return;
    };
    let name = members.iter().position(|member| member.name == "name");
    if let (false, Some(name), Some(last)) = (has, name, members.pop()) {
        members.insert(name + 1, last);
    }
}

fn joined(before: Option<&str>, said: &str) -> String {
    match before {
        Some(before) => format!("{before} {said}"),
        None => said.to_owned(),
    }
}

/// What was left out, and the figure that it changes most.
fn sentence(step: &Step) -> String {
    let part = &step.removal.part;
    match step.greatest() {
        Some((_, change)) if change.change == 0.0 => format!("{part}, which changes nothing"),
        Some((figure, change)) => {
            let by = shown(change.change.abs(), 2);
            format!("{part}, which changes {figure} by {by}")
        }
        None => part.to_string(),
    }
}
