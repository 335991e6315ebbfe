//! What is said of an object when all its properties have been asked for: which
//! are unknown, which are missing, and the schema.

use super::{Fields, MissingProperty};
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::slot::{join_path, last_name};
use crate::frontend::read::suggest::{closest, quoted_list};
use crate::frontend::read::tree::Node;
use serde_json::{Value as Json, json};

/// What words mean that other programs and textbooks have for properties.
const MEANT: [(&str, &[&str]); 33] = [
    ("stroke", &["lift", "amplitude"]),
    ("travel", &["lift", "amplitude"]),
    ("width", &["thickness"]),
    ("turns", &["duration"]),
    ("time", &["duration"]),
    ("duration", &["time"]),
    ("end", &["duration"]),
    ("t_end", &["duration"]),
    ("rpm", &["speed"]),
    ("velocity", &["speed"]),
    ("omega", &["speed"]),
    ("spring", &["stiffness"]),
    ("spring_rate", &["stiffness", "rate"]),
    ("rate", &["stiffness"]),
    ("k", &["stiffness"]),
    ("c", &["stiffness"]),
    ("J", &["inertia", "moment"]),
    ("m", &["mass", "inertia"]),
    ("inertia", &["moment"]),
    ("weight", &["mass", "inertia"]),
    ("mass", &["inertia"]),
    ("moment_of_inertia", &["inertia"]),
    ("dashpot", &["damping"]),
    ("damper", &["damping"]),
    ("damping_ratio", &["damping_capacity"]),
    ("force", &["constant"]),
    ("torque", &["constant", "moment"]),
    ("driver", &["input"]),
    ("parent", &["input"]),
    ("type", &["kind"]),
    ("young", &["modulus"]),
    ("youngs_modulus", &["modulus"]),
    ("E", &["modulus"]),
];

/// The property that a foreign word means, among those that are not given.
fn meant(word: &str, absent: &[&'static str]) -> Option<&'static str> {
    let (_, all) = MEANT.iter().find(|one| one.0 == word)?;
    all.iter()
        .find_map(|name| absent.iter().copied().find(|one| one == name))
}

impl Fields<'_> {
    /// One entry for each unknown property: the known one it may be a slip of.
    pub(super) fn report_unknown(&mut self) -> Vec<Option<&'static str>> {
        let mut suggestions = Vec::new();
        let members = self.node.map_or(&[][..], Node::members);
        let known = self.known.iter().copied();
        let absent: Vec<&'static str> = known.filter(|name| !self.has(name)).collect();
        for member in members {
            let known = self.known.contains(&member.name.as_str());
            if known || self.free {
                continue;
            }
            // Of names as near as each other, one that is not given yet.
            let names = absent.iter().chain(&self.known).copied();
            let suggestion = meant(&member.name, &absent)
                .or_else(|| closest(&member.name, names))
                .and_then(|found| self.known.iter().copied().find(|name| *name == found));
            let mut fault = Diagnostic::error(
                "unknown-property",
                format!("unknown property `{}`", member.name),
            )
            .at(member.name_place.clone())
            .path(join_path(&self.path, &member.name));
            fault = match suggestion {
                Some(found) => fault.hint(format!("did you mean `{found}`?")),
                None => fault.hint(format!(
                    "{} has {}",
                    last_name(&self.path),
                    quoted_list(self.known.iter().copied(), "and")
                )),
            };
            self.reader.diagnostics.push(fault);
            suggestions.push(suggestion);
        }
        suggestions
    }

    pub(super) fn report_missing(&mut self, missing: &MissingProperty) {
        let owner = last_name(&self.path);
        let (message, label) = match missing.names.as_slice() {
            [name] => (
                format!("{owner} has no `{name}`"),
                format!("`{name}` is missing"),
            ),
            _ => (
                format!("{owner} does not say {}", missing.what),
                String::new(),
            ),
        };
        let fault = Diagnostic::error("missing-property", message)
            .at(self.place.clone())
            .path(self.path.clone())
            .label(label)
            .maybe_hint(missing.hint.clone());
        self.reader.diagnostics.push(fault);
    }

    pub(super) fn schema(&mut self) -> Json {
        let mut schema = json!({ "type": "object", "properties": self.out });
        if !self.free {
            schema["additionalProperties"] = json!(false);
        }
        let (several, required): (Vec<&str>, Vec<&str>) = (self.required.iter().copied())
            .partition(|name| self.other_names(name).next().is_some());
        if !required.is_empty() {
            schema["required"] = json!(required);
        }
        let at_most_one = |name: &'static str| {
            let given = |one: &str| json!({ "required": [one] });
            let mut all = vec![given(name)];
            all.extend(self.other_names(name).map(given));
            if !several.contains(&name) {
                let any = all.clone();
                all.push(json!({ "not": { "anyOf": any } }));
            }
            json!({ "oneOf": all })
        };
        let mut named: Vec<&'static str> = self.synonyms.iter().map(|one| one.0).collect();
        named.dedup();
        let synonyms: Vec<Json> = named.into_iter().map(at_most_one).collect();
        let groups: Vec<Json> = self
            .alternatives
            .iter()
            .map(|names| {
                let one = |name: &&str| json!({ "required": [name] });
                json!({ "oneOf": names.iter().map(one).collect::<Vec<_>>() })
            })
            .chain(synonyms)
            .collect();
        if !groups.is_empty() {
            schema["allOf"] = json!(groups);
        }
        schema
    }
}
