//! The place of one value, and what can be read there.

use super::bounds::Bounds;
use super::csv::Files;
use super::dimension::Dimensions;
use super::parameter::{Parameters, unused};
use super::suggest::{did_you_mean, quoted_list};
use super::tree::{Node, Value};
use super::wanted::QuantityChoice;
use crate::frontend::diagnostics::{Diagnostic, Place, SourceId};
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeSet;
use std::ops::Range;

/// Collects what reading finds, or describes what it would accept.
#[derive(Debug, Default)]
pub struct Reader {
    /// Faults and warnings found so far.
    pub diagnostics: Vec<Diagnostic>,
    pub(super) describing: bool,
    pub(super) definitions: Map<String, Json>,
    pub(super) dimensions: Dimensions,
    /// The parameters of the scene.
    pub parameters: Parameters,
    /// The files that the scene names.
    pub files: Files,
    /// The parameters to which something has referred.
    pub(super) used: BTreeSet<String>,
    /// Sources of values that were set from the command line.
    pub overrides: Range<SourceId>,
    /// Numbers met on the way, where they are asked for.
    pub(super) numbers: Option<Vec<DeclaredNumber>>,
}

/// A number of a text with what is declared of it.
#[derive(Clone, Debug, PartialEq)]
pub struct DeclaredNumber {
    /// Address of the number.
    pub path: String,
    /// Place of the value in the text.
    pub place: Place,
    /// What it measures; `None`: a whole number.
    pub wanted: Option<QuantityChoice>,
    /// The interval it must lie in.
    pub bounds: Bounds,
}

impl Reader {
    /// A reader of trees.
    pub fn new() -> Self {
        Self::default()
    }

    /// A reader of parts of a scene with these parameters and files.
    pub fn of_parts(parameters: &Parameters, files: &Files) -> Self {
        Self {
            parameters: parameters.clone(),
            files: files.clone(),
            ..Self::default()
        }
    }

    /// A reader of trees that keeps what is declared of every number it meets.
    pub fn of_numbers() -> Self {
        Self {
            numbers: Some(Vec::new()),
            ..Self::default()
        }
    }

    /// The numbers met, faulty ones too, in the order of reading.
    pub fn numbers(self) -> Vec<DeclaredNumber> {
        self.numbers.unwrap_or_default()
    }

    /// Warnings of parameters that nothing refers to. What refers to them may have been
    /// set to another value from the command line: then those alone that are set there.
    pub fn unused_parameters(&self) -> Vec<Diagnostic> {
        let found = self.parameters.unused(|name| self.used.contains(name));
        let set = |place: &Place| self.overrides.contains(&place.source);
        let found: Vec<_> = found
            .filter(|(_, _, value)| self.overrides.is_empty() || set(value))
            .collect();
        unused(&found)
    }

    /// A reader that writes the JSON Schema of whatever it is made to read.
    pub fn describing() -> Self {
        Self {
            describing: true,
            ..Self::default()
        }
    }

    /// Reads a tree. Returns the value, if nothing was wrong with it, and its
    /// canonical form; when describing, the schema.
    pub fn read<T>(
        &mut self,
        node: Option<&Node>,
        path: &str,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> (Option<T>, Json) {
        let mut out = Json::Null;
        let slot = Slot {
            reader: self,
            node,
            name_place: None,
            path: path.to_owned(),
            out: &mut out,
        };
        let value = read(slot);
        (value, out)
    }

    /// The named definitions met while describing.
    pub fn definitions(self) -> Map<String, Json> {
        self.definitions
    }
}

/// A reading whose value the caller keeps: what stands around values is
/// compiled once, not once for every kind of value.
pub(super) type Reading<'r> = &'r mut dyn FnMut(Slot<'_>);

/// A [`Reading`] for one slot that leaves its value in `value`.
pub(super) fn store_into<T>(
    value: &mut Option<T>,
    read: impl FnOnce(Slot<'_>) -> Option<T>,
) -> impl FnMut(Slot<'_>) {
    let mut read = Some(read);
    move |slot| *value = read.take().and_then(|read| read(slot))
}

/// The place of one value. Its methods consume it: a value is read once.
#[derive(Debug)]
pub struct Slot<'a> {
    pub(super) reader: &'a mut Reader,
    pub(super) node: Option<&'a Node>,
    /// Place of the property's name.
    pub(super) name_place: Option<Place>,
    pub(super) path: String,
    /// Canonical form, or schema when describing.
    pub(super) out: &'a mut Json,
}

impl<'a> Slot<'a> {
    /// True when the schema is being written and there is no value.
    pub fn describing(&self) -> bool {
        self.reader.describing
    }

    /// Writes the schema by hand, when describing.
    pub fn describe(self, schema: Json) {
        *self.out = schema;
    }

    /// A definition written so far, when describing, to be changed in place.
    pub fn definition(&mut self, name: &str) -> Option<&mut Json> {
        self.reader.definitions.get_mut(name)
    }

    /// Place of the property's name; of the value itself when it has none.
    pub fn name_place(&self) -> Place {
        self.name_place.clone().unwrap_or_else(|| self.place())
    }

    /// Address of the value.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The value itself; `None` when describing.
    pub fn node(&self) -> Option<&'a Node> {
        self.node
    }

    /// Place of the value.
    pub fn place(&self) -> Place {
        self.node.map(|node| node.place.clone()).unwrap_or_default()
    }

    /// Notes that this value is wrong.
    pub fn refuse(&mut self, code: &'static str, message: impl Into<String>) -> &mut Diagnostic {
        let fault = Diagnostic::error(code, message)
            .at(self.place())
            .path(self.path.clone());
        push(&mut self.reader.diagnostics, fault)
    }

    /// Notes that this value is of the wrong type.
    pub(super) fn wrong_type(&mut self, wanted: &str) -> &mut Diagnostic {
        let found = self.node.map_or("nothing", Node::type_name);
        let property = last_name(&self.path);
        let message = format!("{property} must be {wanted}, found {found}");
        let fault = self.refuse("wrong-type", message);
        fault.label = format!("expected {wanted}");
        fault
    }

    /// Keeps what is declared of this number, where that is asked for.
    pub(super) fn declare(&mut self, wanted: Option<QuantityChoice>, bounds: Bounds) {
        let Some((numbers, node)) = self.reader.numbers.as_mut().zip(self.node) else {
            return;
        };
        numbers.push(DeclaredNumber {
            path: self.path.clone(),
            place: node.place.clone(),
            wanted,
            bounds,
        });
    }

    /// The same of a number inside this value, which may lie anywhere.
    pub(super) fn declare_at(&mut self, name: &str, node: &Node, wanted: QuantityChoice) {
        if let Some(numbers) = self.reader.numbers.as_mut() {
            numbers.push(DeclaredNumber {
                path: join_path(&self.path, name),
                place: node.place.clone(),
                wanted: Some(wanted),
                bounds: Bounds::ANY,
            });
        }
    }

    /// Another reading of the same value, when the first was only a look.
    pub(super) fn reborrow(&mut self) -> Slot<'_> {
        Slot {
            reader: self.reader,
            node: self.node,
            name_place: self.name_place.clone(),
            path: self.path.clone(),
            out: self.out,
        }
    }

    /// Reads the value and keeps the slot, to note faults of the value as a whole.
    pub fn read_in_place<T>(&mut self, read: impl FnOnce(Slot<'_>) -> Option<T>) -> Option<T> {
        read(self.reborrow())
    }

    /// Notes that an entry of this list is wrong.
    pub fn refuse_item(
        &mut self,
        number: usize,
        code: &'static str,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        let item = match self.node.map(|node| &node.value) {
            Some(Value::List(items)) => items.get(number).map(|item| item.place.clone()),
            _ => None,
        };
        let path = format!("{}[{number}]", self.path);
        let fault = self.refuse(code, message);
        fault.path = path;
        if let Some(place) = item {
            fault.place = Some(place);
        }
        fault
    }

    /// The value, where it was given in code and is of this type.
    pub fn own<T: Clone + 'static>(&mut self) -> Option<T> {
        let Value::Own(own) = &self.node?.value else {
            return None;
        };
        let found = own.get::<T>()?.clone();
        *self.out = json!({ "own": own.words() });
        Some(found)
    }

    /// Reads `true` or `false`.
    pub fn flag(mut self) -> Option<bool> {
        if self.describing() {
            *self.out = json!({ "type": "boolean" });
            return None;
        }
        match self.node?.value {
            Value::Flag(flag) => {
                *self.out = json!(flag);
                Some(flag)
            }
            _ => {
                self.wrong_type("true or false");
                None
            }
        }
    }

    /// Reads a text that is not empty.
    pub fn text(mut self) -> Option<String> {
        if self.describing() {
            *self.out = json!({ "type": "string", "minLength": 1 });
            return None;
        }
        match self.node?.text() {
            None => {
                self.wrong_type("a text");
            }
            Some("") => {
                self.refuse(
                    "out-of-range",
                    format!("{} is empty", last_name(&self.path)),
                );
            }
            Some(text) => {
                *self.out = json!(text);
                return Some(text.to_owned());
            }
        }
        None
    }

    /// Reads a text that is not empty; editors offer some that fit.
    pub(crate) fn text_like<'t>(self, fitting: impl Iterator<Item = &'t str>) -> Option<String> {
        if !self.describing() {
            return self.text();
        }
        let fitting: Vec<&str> = fitting.collect();
        *self.out = json!({ "type": "string", "minLength": 1 });
        if !fitting.is_empty() {
            self.out["examples"] = json!(fitting);
        }
        None
    }

    /// Reads one of several names.
    pub fn choice<T: Clone>(self, choices: &[(&'static str, T)]) -> Option<T> {
        let names: Vec<_> = choices.iter().map(|choice| choice.0).collect();
        let found = self.name_among(&names)?;
        Some(choices[found].1.clone())
    }

    /// Reads one of several names; its number.
    fn name_among(mut self, names: &[&'static str]) -> Option<usize> {
        if self.describing() {
            *self.out = json!({ "enum": names });
            return None;
        }
        let wanted = || quoted_list(names.iter().copied(), "or");
        let Some(text) = self.node?.text() else {
            self.wrong_type(&wanted());
            return None;
        };
        if let Some(found) = names.iter().position(|name| *name == text) {
            *self.out = json!(text);
            return Some(found);
        }
        let property = last_name(&self.path);
        let message = format!("unknown {} `{text}`", property.trim_matches('`'));
        let fault = self.refuse("unknown-choice", message);
        fault
            .hints
            .extend(did_you_mean(text, names.iter().copied()));
        fault.hints.push(format!("it is one of {}", wanted()));
        None
    }

    /// Reads a value inside this one; its canonical form or schema.
    pub(super) fn inner(&mut self, suffix: &str, node: Option<&Node>, read: Reading<'_>) -> Json {
        let mut out = Json::Null;
        read(Slot {
            reader: self.reader,
            node,
            name_place: None,
            path: format!("{}{suffix}", self.path),
            out: &mut out,
        });
        out
    }
}

/// Adds a diagnostic and hands it back for finishing touches.
pub(super) fn push(list: &mut Vec<Diagnostic>, fault: Diagnostic) -> &mut Diagnostic {
    list.push(fault);
    let last = list.len() - 1;
    &mut list[last]
}

/// `a.b` from `a` and `b`.
pub(super) fn join_path(path: &str, name: &str) -> String {
    match path.is_empty() {
        true => name.to_owned(),
        false => format!("{path}.{name}"),
    }
}

/// The last part of an address, quoted; empty addresses are the scene.
pub(super) fn last_name(path: &str) -> String {
    match path.rsplit('.').next() {
        Some("") | None => "the scene".to_owned(),
        Some(name) => format!("`{name}`"),
    }
}
