//! What is said of an object when all its properties have been asked for: which
//! are unknown, which are missing, and the schema.

use super::{Fields, Missing};
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::slot::{join, last_name};
use crate::frontend::read::suggest::{closest, quoted_list};
use crate::frontend::read::tree::Node;
use serde_json::{Value as Json, json};

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
            let suggestion = closest(&member.name, names)
                .and_then(|found| self.known.iter().copied().find(|name| *name == found));
            let mut fault = Diagnostic::error(
                "unknown-property",
                format!("unknown property `{}`", member.name),
            )
            .at(member.name_place.clone())
            .path(join(&self.path, &member.name));
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

    pub(super) fn report_missing(&mut self, missing: &Missing) {
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
        if !self.required.is_empty() {
            schema["required"] = json!(self.required);
        }
        let groups: Vec<Json> = self
            .alternatives
            .iter()
            .map(|names| {
                let one = |name: &&str| json!({ "required": [name] });
                json!({ "oneOf": names.iter().map(one).collect::<Vec<_>>() })
            })
            .collect();
        if !groups.is_empty() {
            schema["allOf"] = json!(groups);
        }
        schema
    }
}
