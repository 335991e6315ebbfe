//! Named numbers: an object that gives `dimensions` can refer to them by name
//! wherever it takes a number: `"rod"`, `"-rod"`, `"rod/2"`, `"2*rod + 5 mm"`.

use super::dimension::{Dimensions, Entry};
use super::fields::Fields;
use super::formulas::FORMULA_PATTERN;
use super::parameters;
use super::slot::Slot;
use super::suggest::{did_you_mean, quoted_list};
use super::tree::{Node, Value};
use super::wanted::QuantityChoice;
use crate::units::Measure;
use serde_json::json;

impl Fields<'_> {
    /// Reads `dimensions`, named numbers that the properties asked for from
    /// here on may refer to; a name to which nothing refers is an error.
    pub fn dimensions(&mut self, doc: &str) {
        self.reader.dimensions = Dimensions::default();
        self.faults_before_dimensions = Some(self.faults());
        let mut entries = Vec::new();
        self.maybe("dimensions", doc, |slot| {
            slot.names(|name, mut slot| {
                let place = slot.name_place();
                let value = slot.read_in_place(read_dimension);
                entries.push(Entry {
                    name: name.to_owned(),
                    place,
                    value,
                    used: false,
                });
                value.map(drop)
            })
        });
        self.reader.dimensions = Dimensions { entries };
    }

    /// Reads `parameters` of the scene, to which all numbers asked for from here on may refer.
    pub fn parameters(&mut self, doc: &str) -> Option<()> {
        self.maybe("parameters", doc, parameters::read).map(drop)
    }

    /// A parameter with a unit that the text of a property refers to.
    pub(crate) fn quantity_in(&self, property: &str) -> Option<&str> {
        let text = self.member(property)?.value.text()?;
        let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        words.find(|word| {
            let found = self.reader.parameters.get(word).flatten();
            found.is_some_and(|found| !found.bare)
        })
    }

    /// Ends the scope of the named numbers; false when some were not used.
    pub(super) fn end_dimensions(&mut self) -> bool {
        let Some(before) = self.faults_before_dimensions else {
            return true;
        };
        let entries = std::mem::take(&mut self.reader.dimensions).entries;
        if self.faults() > before {
            // What refers to a name may not have been read at all.
            return false;
        }
        let known: Vec<&str> = (entries.iter())
            .filter(|entry| entry.used)
            .map(|entry| entry.name.as_str())
            .collect();
        let path = self.path().to_owned();
        let node = self.node();
        // What referred to it may have been set to another value from the command line.
        let overrides = self.reader.overrides.clone();
        let is_set = |node: &Node| overrides.contains(&node.place.source);
        let set = node.is_some_and(|node| any_below(node, &is_set));
        let replaced = |entry: &Entry| set && !overrides.contains(&entry.place.source);
        for entry in entries
            .iter()
            .filter(|entry| !entry.used && !replaced(entry))
        {
            let name = &entry.name;
            let fault = self.refuse(
                "dimensions",
                "unknown-dimension",
                format!("nothing refers to the dimension `{name}`"),
            );
            fault.place = Some(entry.place.clone());
            fault.path = format!("{path}.dimensions.{name}");
            fault
                .hints
                .push(match did_you_mean(name, known.iter().copied()) {
                    Some(guess) => guess,
                    None if known.is_empty() => {
                        format!("write \"{name}\" in place of a number, or remove it")
                    }
                    None => format!(
                        "those that are referred to are {}",
                        quoted_list(known.iter().copied(), "and")
                    ),
                });
        }
        self.faults() == before
    }
}

/// True where a node or one under it is as asked.
fn any_below(node: &Node, asked: &dyn Fn(&Node) -> bool) -> bool {
    asked(node)
        || match &node.value {
            Value::Object(members) => members.iter().any(|member| any_below(&member.value, asked)),
            Value::List(items) => items.iter().any(|item| any_below(item, asked)),
            _ => false,
        }
}

/// Reads one named number.
fn read_dimension(mut slot: Slot<'_>) -> Option<Measure> {
    if slot.describing() {
        slot.describe(json!({
            "description": "A number in SI units, or a text with a unit.",
            "anyOf": [{ "type": "number" }, { "type": "string", "pattern": FORMULA_PATTERN }],
        }));
        return None;
    }
    let found = match &slot.node()?.value {
        Value::Number(value) if value.is_finite() => Some(Measure::unitless(*value)),
        Value::Text(text) => slot.stated(text, &QuantityChoice::anything()),
        _ => {
            slot.wrong_type("a number");
            None
        }
    };
    *slot.out = json!(found.map(|found| found.value));
    found
}
