//! Changes of a scene's tree, property by property.

use super::address::{self, Part, RESERVED, Step};
use crate::frontend::read::{Node, Value};

/// The property at an address (`rocker.pair.gap`); `None`: there is none.
pub fn property<'n>(root: &'n Node, address: &str) -> Option<&'n Node> {
    let parts = address::split_address(address)?;
    let top = match is_of_scene(&parts) {
        true => root,
        false => root.get("objects")?,
    };
    parts
        .iter()
        .try_fold(top, |node, part| match (&part.step, &node.value) {
            (step, Value::List(items)) => items.get(step.list_index()?),
            (Step::Name(name), _) => node.get(name),
            (Step::Index(_), _) => None,
        })
}

/// Sets a property; objects on the way are made where they are missing. An address that is
/// none, or goes through a list, changes nothing.
pub fn set_property(root: &mut Node, address: &str, value: impl Into<Node>) {
    if let Some((owner, name)) = object_and_property(root, address) {
        owner.set_property(&name, value);
    }
}

/// Takes a property away; false: there was none.
pub fn remove_property(root: &mut Node, address: &str) -> bool {
    if property(root, address).is_none() {
        return false;
    }
    let Some((owner, name)) = object_and_property(root, address) else {
        return false;
    };
    match &mut owner.value {
        Value::Object(members) => {
            members.retain(|member| member.name != name);
            true
        }
        _ => false,
    }
}

fn is_of_scene(parts: &[Part]) -> bool {
    matches!(&parts[0].step, Step::Name(name) if RESERVED.contains(&name.as_str()))
}

/// The object whose property is addressed, and the property's name.
fn object_and_property<'n>(root: &'n mut Node, address: &str) -> Option<(&'n mut Node, String)> {
    let parts = address::split_address(address)?;
    let names: Option<Vec<String>> = parts
        .iter()
        .map(|part| match &part.step {
            Step::Name(name) => Some(name.clone()),
            Step::Index(_) => None,
        })
        .collect();
    let mut names = names?;
    let last = names.pop()?;
    let top = match is_of_scene(&parts) {
        true => root,
        false => root.property("objects"),
    };
    let owner = names.iter().fold(top, |node, name| node.property(name));
    Some((owner, last))
}

#[cfg(test)]
mod tests {
    use super::{property, remove_property, set_property};
    use crate::frontend::read::Node;

    #[test]
    fn properties_are_set_and_taken_away() {
        let mut root = Node::object();
        set_property(&mut root, "rocker.pair.gap", "0.1 mm");
        set_property(&mut root, "run.duration", 0.5);
        let text = r#"{"objects":{"rocker":{"pair":{"gap":"0.1 mm"}}},"run":{"duration":0.5}}"#;
        assert_eq!(root.json(), text);
        let gap = property(&root, "rocker.pair.gap").and_then(Node::text);
        assert_eq!(gap, Some("0.1 mm"));
        assert!(remove_property(&mut root, "rocker.pair.gap"));
        assert!(!remove_property(&mut root, "rocker.pair.gap"));
        assert!(!remove_property(&mut root, "slider.mass"));
        assert_eq!(
            root.json(),
            r#"{"objects":{"rocker":{"pair":{}}},"run":{"duration":0.5}}"#
        );
    }
}
