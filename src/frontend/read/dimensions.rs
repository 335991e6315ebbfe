//! Named numbers: an object that gives `dimensions` can refer to them by name
//! wherever it takes a number: `"rod"`, `"-rod"`, `"rod/2"`, `"rod*0.4"`.

use super::dimension::{Dimensions, Entry, ParsedNumber};
use super::fields::Fields;
use super::number::{NUMBER_PATTERN, shorten};
use super::slot::Slot;
use super::suggest::{did_you_mean, quoted_list};
use super::tree::{Node, Value};
use super::wanted::QuantityChoice;
use crate::units::parse;
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
                let value = slot.read_in_place(dimension);
                entries.push(Entry {
                    name: name.to_owned(),
                    place,
                    value,
                    used: false,
                });
                value.map(drop)
            })
        });
        self.reader.dimensions = Dimensions {
            described: self.describing(),
            entries,
        };
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
        let set = node.is_some_and(|node| holds(node, &is_set));
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
fn holds(node: &Node, asked: &dyn Fn(&Node) -> bool) -> bool {
    asked(node)
        || match &node.value {
            Value::Object(members) => members.iter().any(|member| holds(&member.value, asked)),
            Value::List(items) => items.iter().any(|item| holds(item, asked)),
            _ => false,
        }
}

/// Reads one named number.
fn dimension(mut slot: Slot<'_>) -> Option<ParsedNumber> {
    if slot.describing() {
        slot.describe(json!({
            "description": "A number in SI units, or a text with a unit.",
            "anyOf": [{ "type": "number" }, { "type": "string", "pattern": NUMBER_PATTERN }],
        }));
        return None;
    }
    match &slot.node()?.value {
        Value::Number(value) if value.is_finite() => {
            let value = *value;
            *slot.out = json!(value);
            Some(ParsedNumber::Plain(value))
        }
        Value::Text(text) => match parse(text) {
            Ok(measure) => {
                *slot.out = json!(measure.value);
                Some(match measure.bare {
                    true => ParsedNumber::Plain(measure.value),
                    false => ParsedNumber::Measured(measure),
                })
            }
            Err(error) => {
                slot.unit_fault(text, error, &QuantityChoice::anything());
                None
            }
        },
        _ => {
            slot.wrong_type("a number");
            None
        }
    }
}

/// `-name*factor` taken apart: sign, name, factor.
fn split_signed_factor(text: &str) -> Option<(&str, f64)> {
    let text = text.trim();
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest.trim_start()),
        None => (1.0, text),
    };
    let (name, factor) = match rest.split_once(['*', '/']) {
        None => (rest, 1.0),
        Some((name, number)) => {
            let number: f64 = number.trim().parse().ok().filter(|n: &f64| n.is_finite())?;
            let divided = rest.as_bytes().get(name.len()) == Some(&b'/');
            (name.trim_end(), if divided { 1.0 / number } else { number })
        }
    };
    (super::is_name(name) && factor.is_finite()).then_some((name, sign * factor))
}

impl Slot<'_> {
    /// What a text that refers to a named number stands for; `None`: it is a
    /// number of its own. The inner `None`: it is faulty, which has been said.
    pub(super) fn reference(&mut self, text: &str, wanted: &QuantityChoice) -> Option<Option<f64>> {
        let dimensions = &mut self.reader.dimensions;
        let bare = text.trim_start().trim_start_matches('-').trim_start();
        let named = bare.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        if dimensions.entries.is_empty() || !named {
            return None;
        }
        let Some((name, factor)) = split_signed_factor(text) else {
            let message = format!("`{}` is no dimension", shorten(text));
            let hint = "write a name, -name, name/2 or name*0.4, or a number with a unit";
            self.refuse("unknown-dimension", message)
                .hints
                .push(hint.to_owned());
            return Some(None);
        };
        let found = dimensions.entries.iter_mut().find(|e| e.name == name);
        let Some(entry) = found else {
            let names: Vec<String> = dimensions.entries.iter().map(|e| e.name.clone()).collect();
            let names = || names.iter().map(String::as_str);
            let hint = did_you_mean(name, names())
                .unwrap_or_else(|| format!("the dimensions are {}", quoted_list(names(), "and")));
            self.refuse("unknown-dimension", format!("unknown dimension `{name}`"))
                .hints
                .push(hint);
            return Some(None);
        };
        entry.used = true;
        Some(match entry.value {
            None => None,
            Some(ParsedNumber::Plain(value)) => Some(factor * value),
            Some(ParsedNumber::Measured(measure)) => match wanted.accept(measure) {
                Ok(value) => Some(factor * value),
                Err(mismatch) => {
                    self.mismatch(text, measure, mismatch, wanted);
                    None
                }
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::split_signed_factor;

    #[test]
    fn references_have_a_sign_a_name_and_a_factor() {
        assert_eq!(split_signed_factor("rod"), Some(("rod", 1.0)));
        assert_eq!(split_signed_factor(" - rod "), Some(("rod", -1.0)));
        assert_eq!(split_signed_factor("rod/2"), Some(("rod", 0.5)));
        assert_eq!(split_signed_factor("-rod * 0.4"), Some(("rod", -0.4)));
        for wrong in ["rod crank", "rod/0", "rod*x", "rod + 1", "rod*1/2", ""] {
            assert_eq!(split_signed_factor(wrong), None, "{wrong}");
        }
    }
}
