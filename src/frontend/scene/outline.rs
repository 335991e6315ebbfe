//! The objects of a text with their ports, as far as the text tells: what an editor draws.

use super::{Catalogue, Document};
use crate::dynamics::model::Coordinate;
use crate::frontend::object::{Inputs, Kind};
use crate::frontend::read::{Node, Value};
use serde::Serialize;

/// An object of a text, which may be faulty.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Outline {
    /// Its id.
    pub(crate) id: String,
    /// Its kind, its own or that of what it copies; empty: the text names none that there is.
    pub(crate) kind: String,
    /// What it copies from a catalogue; empty: nothing.
    pub(crate) from: String,
    /// What its text says in a few words: `2 masses`, `speed 10 rev/s`.
    pub(crate) detail: String,
    /// Input ports.
    pub(crate) inputs: Vec<Input>,
    /// True: further inputs may be added by name.
    pub(crate) open: bool,
    /// Outputs: its own displacement, which is named by the id alone, and others.
    pub(crate) outputs: Vec<Output>,
}

/// An input port.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Input {
    /// Its name.
    pub(crate) name: String,
    /// Address of the property that connects it: `rocker.input`.
    pub(crate) address: String,
    /// The output that it hangs on, as written; empty: none.
    pub(crate) output: String,
}

/// An output port.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(crate) struct Output {
    /// How others refer to it: `press`, `press.ram`.
    pub(crate) address: String,
    /// Whether it turns or slides; `None`: the text does not tell.
    pub(crate) coordinate: Option<Coordinate>,
}

impl Document {
    /// Its objects in the order of the text, however faulty they are.
    pub(crate) fn outline(&self, catalogue: &dyn Catalogue) -> Vec<Outline> {
        let tree = self.copied(catalogue);
        let own = self.root().get("objects");
        let objects = tree.get("objects").map_or(&[][..], Node::members);
        let outline = |member: &crate::frontend::read::Member| {
            let written = own.and_then(|own| own.get(&member.name));
            let from = written.and_then(|one| one.get("from")).and_then(Node::text);
            let name = member.value.get("kind").and_then(Node::text);
            let kind = name.and_then(|name| self.kinds().kind(name));
            of(&member.name, &member.value, kind, from)
        };
        objects.iter().map(outline).collect()
    }
}

fn of(id: &str, node: &Node, kind: Option<&Kind>, from: Option<&str>) -> Outline {
    let several = kind.is_some_and(|kind| kind.inputs == Inputs::Several);
    let coordinate = kind.and_then(|kind| (kind.coordinate)(node));
    let others = kind.map_or(Vec::new(), |kind| (kind.outputs)(node));
    let others = others.into_iter().map(|(name, coordinate)| Output {
        address: format!("{id}.{name}"),
        coordinate,
    });
    let own = Output {
        address: id.to_owned(),
        coordinate,
    };
    Outline {
        id: id.to_owned(),
        kind: kind.map_or("", |kind| kind.name).to_owned(),
        from: from.unwrap_or_default().to_owned(),
        detail: detail(node),
        inputs: inputs(id, node, kind.map(|kind| kind.inputs)),
        open: several,
        outputs: std::iter::once(own).chain(others).collect(),
    }
}

/// The ports that the declaration of its kind has for the text; of an object of unknown kind, what
/// it has.
fn inputs(id: &str, node: &Node, inputs: Option<Inputs>) -> Vec<Input> {
    let declared = inputs.unwrap_or(match node.get("input") {
        Some(_) => Inputs::One,
        None => Inputs::Several,
    });
    let is_named = declared.alternative_in_text(node) == Inputs::Several;
    let port = |(name, output): (&str, Option<&str>)| Input {
        name: name.to_owned(),
        address: match is_named {
            true => format!("{id}.inputs.{name}.object"),
            false => format!("{id}.{name}"),
        },
        output: output.unwrap_or_default().to_owned(),
    };
    declared.ports(node).into_iter().map(port).collect()
}

fn detail(node: &Node) -> String {
    let plain = |node: &Node| match &node.value {
        Value::Text(text) => text.clone(),
        Value::Number(value) => value.to_string(),
        _ => String::new(),
    };
    let members = |name: &str| node.get(name).map_or(&[][..], Node::members);
    if let Some(motion) = members("motion").first() {
        return format!("{} {}", motion.name, plain(&motion.value))
            .trim()
            .to_owned();
    }
    if node.get("motor").is_some() {
        return "motor".to_owned();
    }
    if let Value::Object(links) = node.get("links").map_or(&Value::Null, |links| &links.value) {
        return format!("{} links", links.len());
    }
    let position = members("position").first().map(|one| one.name.clone());
    let masses = match node.get("masses").map(plain).as_deref() {
        None | Some("") => None,
        Some("0") => Some("rigid".to_owned()),
        Some("1") => Some("1 mass".to_owned()),
        Some(count) => Some(format!("{count} masses")),
    };
    let parts: Vec<String> = masses.into_iter().chain(position).collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::super::{BuiltIn, Document};
    use crate::frontend::object::{Inputs, Registry};

    fn outline(text: &str) -> Vec<super::Outline> {
        Document::parse("scene", text.as_bytes())
            .unwrap()
            .outline(&BuiltIn)
    }

    #[test]
    fn ports_of_faulty_objects_are_known() {
        let objects = outline(
            r#"{ "objects": {
                "motor": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
                "lever": { "from": "rocker/steel-lever-205mm", "input": "moter" },
                "sum": { "kind": "differential", "inputs": { "a": { "object": "motor" }, "b": {} } },
                "press": { "kind": "linkage", "input": "motor" },
                "loose": { "kind": "linkage" },
                "arm": { "kind": "linkage", "inputs": { "hip": { "object": "motor" }, "knee": {} } },
                "odd": { "kind": "rokcer", "input": "motor" } } }"#,
        );
        let told: Vec<_> = objects
            .iter()
            .map(|one| {
                (
                    one.id.as_str(),
                    one.kind.as_str(),
                    one.inputs.len(),
                    one.open,
                )
            })
            .collect();
        assert_eq!(
            told,
            [
                ("motor", "drive", 0, false),
                ("lever", "rocker", 1, false),
                ("sum", "differential", 2, true),
                ("press", "linkage", 1, false),
                ("loose", "linkage", 1, false),
                ("arm", "linkage", 2, false),
                ("odd", "", 1, false),
            ]
        );
        assert_eq!(objects[0].detail, "speed 10 rev/s");
        assert_eq!(objects[1].from, "rocker/steel-lever-205mm");
        assert_eq!(objects[1].inputs[0].output, "moter");
        assert_eq!(objects[2].inputs[1].address, "sum.inputs.b.object");
        assert_eq!(objects[2].inputs[1].output, "");
        let port = |object: usize, input: usize| {
            let port = &objects[object].inputs[input];
            (port.address.as_str(), port.output.as_str())
        };
        assert_eq!(port(3, 0), ("press.input", "motor"));
        assert_eq!(port(4, 0), ("loose.input", ""));
        assert_eq!(port(5, 1), ("arm.inputs.knee.object", ""));
    }

    #[test]
    fn every_kind_that_is_driven_has_a_port() {
        for kind in Registry::standard().kinds() {
            let name = kind.name;
            let text = format!(
                r#"{{ "objects": {{ "one": {{ "kind": "{name}", "input": "x", "inputs": {{}} }},
                    "other": {{ "kind": "{name}", "input": "x" }} }} }}"#
            );
            let objects = outline(&text);
            let has = objects.iter().any(|one| !one.inputs.is_empty() || one.open);
            let is_driven = kind.inputs != Inputs::None;
            assert_eq!(has, is_driven, "{name}");
        }
    }

    #[test]
    fn outputs_of_a_linkage_are_ports() {
        let text = std::fs::read_to_string("scenarios/linkages/toggle_press.json").unwrap();
        let objects = outline(&text);
        let press = objects.iter().find(|one| one.kind == "linkage").unwrap();
        assert_eq!(press.outputs[0].address, press.id);
        assert!(press.outputs.len() > 1);
        assert!(
            press.outputs[1]
                .address
                .starts_with(&format!("{}.", press.id))
        );
    }
}
