//! What the descriptions of a reduced scene say.

use super::findings::{Reduction, Role, Step};
use super::removal::Part;
use crate::frontend::read::{Node, Value};
use crate::frontend::scene::edit::{property, remove_property, set_property};
use crate::units::shown;
use std::collections::{BTreeMap, BTreeSet};

/// Writes into the scene what was left out of it and why that is allowed. What it expects of
/// a run was expected of the whole scene and goes.
pub(super) fn describe(root: &mut Node, reduction: &Reduction) {
    remove_property(root, "run.accuracy");
    if let Value::Object(members) = &mut root.value {
        members.retain(|member| member.name != "expect");
    }
    let levels = changed_levels(reduction);
    let removed = || reduction.removed().filter(|step| !is_level(step));
    let ids = removed().map(|step| &step.removal.object);
    let ids: BTreeSet<&String> = ids.chain(levels.keys().copied()).collect();
    for id in ids {
        let own = removed().filter(|step| step.removal.object == *id);
        let own = own.map(|step| sentence(step, reduction));
        let said: Vec<String> = levels.get(id).cloned().into_iter().chain(own).collect();
        let address = format!("{id}.description");
        let before = property(root, &address).and_then(Node::text);
        let text = join_descriptions(before, &format!("Reduced: {}.", said.join("; ")));
        set_property(root, &address, text);
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
        let text = join_descriptions(before, &said);
        put_description(root, text);
    }
}

/// The levels that the reduced scene has in place of others.
fn changed_levels(reduction: &Reduction) -> BTreeMap<&String, String> {
    let levels = |role| reduction.model(role).map(|model| &model.levels);
    let (Some(given), Some(reduced)) = (levels(Role::Given), levels(Role::Reduced)) else {
        return BTreeMap::new();
    };
    let changed = given.iter().filter_map(|(id, from)| {
        let to = reduced.get(id).filter(|to| *to != from)?;
        Some((id, format!("{to} in place of {from}")))
    });
    changed.collect()
}

fn is_level(step: &Step) -> bool {
    matches!(step.removal.part, Part::Level { .. })
}

/// Sets the description of the scene, behind its name where it had none.
fn put_description(root: &mut Node, text: String) {
    let has = root.get("description").is_some();
    root.set_property("description", text);
    let Value::Object(members) = &mut root.value else {
        return;
    };
    let name = members.iter().position(|member| member.name == "name");
    if let (false, Some(name)) = (has, name) {
        members[name + 1..].rotate_right(1);
    }
}

fn join_descriptions(before: Option<&str>, said: &str) -> String {
    match before {
        Some(before) => format!("{before} {said}"),
        None => said.to_owned(),
    }
}

/// What was left out, and the figure that it changes most.
fn sentence(step: &Step, reduction: &Reduction) -> String {
    let part = &step.removal.part;
    match step.greatest() {
        Some((_, change)) if change.change == 0.0 => format!("{part}, which changes nothing"),
        Some((figure, change)) => {
            let by = shown(change.change.abs(), 2);
            let found = reduction.certificate.accuracy.get(figure);
            let unit = found.map_or("", |found| &found.unit);
            let said = format!("{part}, which changes {figure} by {by} {unit}");
            said.trim_end().to_owned()
        }
        None => part.to_string(),
    }
}
