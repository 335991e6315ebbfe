//! Overrides of single properties: `--set rocker.masses=10`.

use super::address::{self, RESERVED, Step};
use crate::frontend::diagnostics::{Diagnostic, Place, Source, SourceId, Sources};
use crate::frontend::read::{Member, Node, Value, did_you_mean, parse_fragment, synonyms};
use std::sync::Arc;

/// Properties to be changed before a scene is read, in order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overrides(Vec<String>);

impl Overrides {
    /// None.
    pub fn none() -> Self {
        Self::default()
    }

    /// From arguments `path=value`; the value is JSON, or else a text. Faults
    /// show when a scene is read with them.
    pub fn new<S: Into<String>>(arguments: impl IntoIterator<Item = S>) -> Self {
        Self(arguments.into_iter().map(Into::into).collect())
    }

    /// Adds one more.
    pub fn set(&mut self, path: &str, value: &serde_json::Value) {
        self.0.push(format!("{path}={value}"));
    }

    /// With one more, given in code.
    #[must_use]
    pub fn and(mut self, address: &str, value: &Node) -> Self {
        self.0.push(format!("{address}={}", value.json()));
        self
    }

    /// The arguments.
    pub fn arguments(&self) -> &[String] {
        &self.0
    }
}

/// An override, read: where it points and what it says.
pub(super) struct Override {
    pub(super) parts: Vec<address::Part>,
    value: Node,
    source: SourceId,
}

impl Override {
    /// True when it replaces a `from`, which must happen before copying.
    pub(super) fn chooses_from(&self) -> bool {
        let last = self.parts.last().map(|part| &part.step);
        self.parts.len() == 2 && last == Some(&Step::Name("from".to_owned()))
    }

    /// Value, if it is a plain number.
    pub(super) fn number(&self) -> Option<f64> {
        match self.value.value {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    fn place(&self, part: usize) -> Place {
        Place::new(self.source, self.parts[part].range.clone())
    }
}

/// Reads all overrides; each becomes a source of its own.
pub(super) fn read(
    overrides: &Overrides,
    sources: &mut Sources,
    faults: &mut Vec<Diagnostic>,
) -> Vec<Override> {
    let mut all = Vec::new();
    for argument in &overrides.0 {
        match read_one(argument, sources) {
            Ok(found) => all.push(found),
            Err(mut found) => faults.append(&mut found),
        }
    }
    all
}

fn read_one(argument: &str, sources: &mut Sources) -> Result<Override, Vec<Diagnostic>> {
    let source = sources.add(Arc::new(Source {
        name: "--set".to_owned(),
        text: argument.to_owned(),
    }));
    let form = |message: &str| {
        vec![
            Diagnostic::error("bad-override", message)
                .at(Place::new(source, 0..argument.len()))
                .hint("write object.property=value, as in rocker.pair.gap=\"0.1 mm\""),
        ]
    };
    let Some((path, text)) = argument.split_once('=') else {
        return Err(form("this override has no `=`"));
    };
    let parts = address::split_address(path.trim_end())
        .ok_or_else(|| form("this override does not begin with an address"))?;
    let offset = path.len() + 1;
    let value = match parse_fragment(text, source, offset) {
        Ok(node) => node,
        Err(faults) if faults.iter().all(|fault| fault.code == "not-json") => Node {
            place: Place::new(source, offset..argument.len()),
            value: Value::Text(text.to_owned()),
        },
        Err(faults) => return Err(faults),
    };
    Ok(Override {
        parts,
        value,
        source,
    })
}

/// Changes the tree.
pub(super) fn apply(root: &mut Node, change: &Override) -> Result<(), Box<Diagnostic>> {
    let Step::Name(first) = &change.parts[0].step else {
        return Ok(());
    };
    let fixed = ["expect", "objects", "dam"].contains(&first.as_str());
    if fixed {
        let message = format!("`{first}` cannot be overridden as a whole");
        let fault = Diagnostic::error("bad-override", message).at(change.place(0));
        let hint = "override properties of objects or of `run`";
        return Err(Box::new(fault.hint(hint)));
    }
    if let (PARAMETERS, Some(name)) = (first.as_str(), change.parts.get(1)) {
        known_parameter(root, change, &name.step)?;
    }
    if RESERVED.contains(&first.as_str()) {
        return descend(root, change, 0);
    }
    let Some(objects) = member_mut(root, "objects") else {
        // The missing objects are reported by themselves.
        return Ok(());
    };
    if objects.value.get(first).is_none() {
        let ids: Vec<&str> = objects
            .value
            .members()
            .iter()
            .map(|m| m.name.as_str())
            .collect();
        let fault = Diagnostic::error("unknown-object", format!("there is no object `{first}`"))
            .at(change.place(0))
            .maybe_hint(did_you_mean(first, ids.iter().copied().chain(["run"])));
        return Err(Box::new(match ids.is_empty() {
            true => fault,
            false => fault.hint(format!(
                "the objects are {}",
                crate::frontend::read::quoted_list(ids, "and")
            )),
        }));
    }
    descend(&mut objects.value, change, 0)
}

const PARAMETERS: &str = "parameters";

/// Refuses to set a parameter that the scene does not have.
fn known_parameter(root: &Node, change: &Override, step: &Step) -> Result<(), Box<Diagnostic>> {
    let parameters = root.get(PARAMETERS);
    let Step::Name(name) = step else {
        return Ok(());
    };
    if parameters.is_some_and(|all| all.get(name).is_some()) {
        return Ok(());
    }
    let members = parameters.map_or(&[][..], Node::members);
    let names = || members.iter().take(1000).map(|one| one.name.as_str());
    let message = format!("there is no parameter `{name}`");
    let fault = Diagnostic::error("unknown-parameter", message).at(change.place(1));
    Err(Box::new(match (did_you_mean(name, names()), members) {
        (Some(guess), _) => fault.hint(guess),
        (None, []) => fault.hint("the scene has no `parameters`"),
        (None, _) => fault.hint(format!(
            "the parameters are {}",
            crate::frontend::read::quoted_list(names().take(20), "and")
        )),
    }))
}

fn member_mut<'a>(node: &'a mut Node, name: &str) -> Option<&'a mut Member> {
    match &mut node.value {
        Value::Object(members) => members.iter_mut().find(|member| member.name == name),
        _ => None,
    }
}

/// Goes down from part to part; objects on the way are made where they are
/// missing, so that what is wrong with them is said by the reading.
fn descend(node: &mut Node, change: &Override, part: usize) -> Result<(), Box<Diagnostic>> {
    let last = part + 1 == change.parts.len();
    let child = match (&change.parts[part].step, &mut node.value) {
        (Step::Name(name), Value::Object(members)) => {
            let place = |name: &str| members.iter().position(|member| member.name == name);
            // What is written under another name of the property is replaced.
            let other = || synonyms(name).find_map(place);
            let at = place(name).or_else(other);
            let at = at.unwrap_or_else(|| {
                members.push(Member {
                    name: name.clone(),
                    name_place: change.place(part),
                    value: Node {
                        place: change.place(part),
                        value: Value::Object(Vec::new()),
                    },
                });
                members.len() - 1
            });
            if last {
                members[at].name_place = change.place(part);
                members[at].name.clone_from(name);
            }
            Some(&mut members[at].value)
        }
        (step, Value::List(items)) => step.list_index().and_then(|index| items.get_mut(index)),
        _ => None,
    };
    match child {
        None => Err(Box::new(no_such_part(node, change, part))),
        Some(child) if last => {
            *child = change.value.clone();
            Ok(())
        }
        Some(child) => descend(child, change, part + 1),
    }
}

fn no_such_part(node: &Node, change: &Override, part: usize) -> Diagnostic {
    let step = &change.parts[part].step;
    let message = match (step, &node.value) {
        (_, Value::List(items)) if step.list_index().is_some() => {
            let index = step.list_index().unwrap_or_default();
            let last = items.len().saturating_sub(1);
            format!("there is no entry {index}: this list has the entries 0 to {last}")
        }
        (Step::Index(_), _) => format!("this is {}, not a list", node.type_name()),
        (Step::Name(name), _) => format!("this is {} and has no `{name}`", node.type_name()),
    };
    Diagnostic::error("bad-override", message)
        .at(change.place(part))
        .with_place(node.place.clone(), "the value in question")
}
