//! The place of one value, and what can be read there.

use super::fields::Fields;
use super::suggest::{did_you_mean, quoted_list};
use super::tree::{Node, Value};
use crate::diagnostics::{Diagnostic, Place};
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// Collects what reading finds, or describes what it would accept.
#[derive(Debug, Default)]
pub struct Reader {
    /// Faults and warnings found so far.
    pub diagnostics: Vec<Diagnostic>,
    pub(super) describing: bool,
    pub(super) definitions: Map<String, Json>,
}

impl Reader {
    /// A reader of trees.
    pub fn new() -> Self {
        Self::default()
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

/// The place of one value. Its methods consume it: a value is read once.
#[derive(Debug)]
pub struct Slot<'a> {
    pub(super) reader: &'a mut Reader,
    pub(super) node: Option<&'a Node>,
    /// Where the property's name stands.
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

    /// Where the property's name stands; the value itself when it has none.
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

    /// Where the value stands.
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
    pub(super) fn wrong_type(&mut self, wanted: &str) {
        let found = self.node.map_or("nothing", Node::type_name);
        let property = last_name(&self.path).to_owned();
        let message = format!("`{property}` must be {wanted}, found {found}");
        self.refuse("wrong-type", message).label = format!("expected {wanted}");
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
    pub fn look<T>(&mut self, read: impl FnOnce(Slot<'_>) -> Option<T>) -> Option<T> {
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
            None => self.wrong_type("a text"),
            Some("") => {
                self.refuse(
                    "out-of-range",
                    format!("`{}` is empty", last_name(&self.path)),
                );
            }
            Some(text) => {
                *self.out = json!(text);
                return Some(text.to_owned());
            }
        }
        None
    }

    /// Reads one of several names.
    pub fn choice<T: Clone>(mut self, choices: &[(&'static str, T)]) -> Option<T> {
        let names = || choices.iter().map(|choice| choice.0);
        if self.describing() {
            *self.out = json!({ "enum": names().collect::<Vec<_>>() });
            return None;
        }
        let wanted = quoted_list(names(), "or");
        let Some(text) = self.node?.text() else {
            self.wrong_type(&wanted);
            return None;
        };
        if let Some(found) = choices.iter().find(|choice| choice.0 == text) {
            *self.out = json!(text);
            return Some(found.1.clone());
        }
        let message = format!("unknown {} `{text}`", last_name(&self.path));
        let fault = self.refuse("unknown-choice", message);
        fault.hints.extend(did_you_mean(text, names()));
        fault.hints.push(format!("it is one of {wanted}"));
        None
    }

    /// Reads an object by its properties; every property that is not asked for
    /// is an error, as is every missing one.
    pub fn record<T>(mut self, read: impl FnOnce(&mut Fields<'_>) -> Option<T>) -> Option<T> {
        if !self.describing() && !matches!(self.node?.value, Value::Object(_)) {
            self.wrong_type("an object");
            return None;
        }
        let mut fields = Fields::new(&mut self);
        let value = read(&mut fields);
        let (complete, out) = fields.finish();
        *self.out = out;
        value.filter(|_| complete)
    }

    /// Reads an object whose property names are free.
    pub fn map<T>(
        mut self,
        mut read: impl FnMut(&str, Slot<'_>) -> Option<T>,
    ) -> Option<BTreeMap<String, T>> {
        if self.describing() {
            let schema = self.inner("*", None, |slot| read("*", slot)).1;
            *self.out = json!({ "type": "object", "additionalProperties": schema });
            return None;
        }
        let Value::Object(members) = &self.node?.value else {
            self.wrong_type("an object");
            return None;
        };
        let (mut values, mut canonical, mut complete) = (BTreeMap::new(), Map::new(), true);
        for member in members {
            let path = join(&self.path, &member.name);
            let mut out = Json::Null;
            let slot = Slot {
                reader: self.reader,
                node: Some(&member.value),
                name_place: Some(member.name_place.clone()),
                path,
                out: &mut out,
            };
            match read(&member.name, slot) {
                Some(value) => drop(values.insert(member.name.clone(), value)),
                None => complete = false,
            }
            canonical.insert(member.name.clone(), out);
        }
        *self.out = Json::Object(canonical);
        complete.then_some(values)
    }

    /// As [`Slot::map`], for names that serve as addresses: they must fit
    /// [`super::NAME_PATTERN`].
    pub fn names<T>(
        mut self,
        mut read: impl FnMut(&str, Slot<'_>) -> Option<T>,
    ) -> Option<BTreeMap<String, T>> {
        let values = self.look(|slot| {
            slot.map(|name, mut slot| {
                let sound = slot.describing() || super::is_name(name);
                if !sound {
                    slot.refuse_name(name);
                }
                read(name, slot).filter(|_| sound)
            })
        });
        if self.describing() {
            self.out["propertyNames"] = json!({ "pattern": super::NAME_PATTERN });
        }
        values
    }

    /// Notes that the name of this value cannot serve as an address.
    fn refuse_name(&mut self, name: &str) {
        let place = self.name_place();
        let fault = self.refuse("bad-id", format!("`{name}` cannot be a name"));
        fault.place = Some(place);
        fault.hints.push(super::NAME_RULE.to_owned());
    }

    /// Reads a list of a length in the given range.
    pub fn list<T>(
        mut self,
        length: RangeInclusive<usize>,
        mut read: impl FnMut(Slot<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        if self.describing() {
            let items = self.inner("[]", None, &mut read).1;
            let mut schema = json!({ "type": "array", "items": items, "minItems": length.start() });
            if *length.end() < usize::MAX {
                schema["maxItems"] = json!(length.end());
            }
            *self.out = schema;
            return None;
        }
        let Value::List(items) = &self.node?.value else {
            self.wrong_type("a list");
            return None;
        };
        let (mut values, mut canonical) = (Vec::with_capacity(items.len()), Vec::new());
        for (number, item) in items.iter().enumerate() {
            let (value, out) = self.inner(&format!("[{number}]"), Some(item), &mut read);
            values.extend(value);
            canonical.push(out);
        }
        *self.out = Json::Array(canonical);
        if !length.contains(&items.len()) {
            let message = wrong_length(last_name(&self.path), items.len(), &length);
            self.refuse("wrong-length", message);
            return None;
        }
        (values.len() == items.len()).then_some(values)
    }

    /// Reads a list of exactly two values.
    pub fn pair<A, B>(
        mut self,
        first: impl FnOnce(Slot<'_>) -> Option<A>,
        second: impl FnOnce(Slot<'_>) -> Option<B>,
    ) -> Option<(A, B)> {
        if self.describing() {
            let items = [
                self.inner("[0]", None, first).1,
                self.inner("[1]", None, second).1,
            ];
            *self.out = json!({
                "type": "array", "prefixItems": items, "minItems": 2, "maxItems": 2
            });
            return None;
        }
        let Value::List(items) = &self.node?.value else {
            self.wrong_type("a list of two values");
            return None;
        };
        let [one, other] = items.as_slice() else {
            let message = wrong_length(last_name(&self.path), items.len(), &(2..=2));
            self.refuse("wrong-length", message);
            return None;
        };
        let (a, a_out) = self.inner("[0]", Some(one), first);
        let (b, b_out) = self.inner("[1]", Some(other), second);
        *self.out = json!([a_out, b_out]);
        Some((a?, b?))
    }

    /// Reads an object one way and anything else another way.
    pub fn object_or<T>(
        self,
        object: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        self.fork(|value| matches!(value, Value::Object(_)), object, other)
    }

    /// Reads a text one way and anything else another way.
    pub fn text_or<T>(
        self,
        text: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        self.fork(|value| matches!(value, Value::Text(_)), text, other)
    }

    /// Reads `true` or `false` one way and anything else another way.
    pub fn flag_or<T>(
        self,
        flag: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        self.fork(|value| matches!(value, Value::Flag(_)), flag, other)
    }

    fn fork<T>(
        mut self,
        is_first: impl FnOnce(&Value) -> bool,
        first: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        if self.describing() {
            let forms = [self.inner("", None, other).1, self.inner("", None, first).1];
            *self.out = any_of(forms);
            return None;
        }
        match is_first(&self.node?.value) {
            true => first(self),
            false => other(self),
        }
    }

    /// Reads a list one way (`Ok`) and anything else another way (`Err`); the
    /// slot can still note faults afterwards.
    pub fn list_or<A, B>(
        &mut self,
        list: impl FnOnce(Slot<'_>) -> Option<A>,
        other: impl FnOnce(Slot<'_>) -> Option<B>,
    ) -> Option<Result<A, B>> {
        if self.describing() {
            let forms = [self.inner("", None, other).1, self.inner("", None, list).1];
            *self.out = any_of(forms);
            return None;
        }
        match self.node?.value {
            Value::List(_) => list(self.reborrow()).map(Ok),
            _ => other(self.reborrow()).map(Err),
        }
    }

    /// Reads a value whose schema is written once under a name.
    pub fn defined<T>(mut self, name: &str, read: impl FnOnce(Slot<'_>) -> Option<T>) -> Option<T> {
        if !self.describing() {
            return read(self);
        }
        if !self.reader.definitions.contains_key(name) {
            self.reader.definitions.insert(name.to_owned(), Json::Null);
            let schema = self.inner("", None, read).1;
            self.reader.definitions.insert(name.to_owned(), schema);
        }
        *self.out = json!({ "$ref": format!("#/$defs/{name}") });
        None
    }

    /// Reads a value inside this one.
    pub(super) fn inner<T>(
        &mut self,
        suffix: &str,
        node: Option<&Node>,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> (Option<T>, Json) {
        let mut out = Json::Null;
        let slot = Slot {
            reader: self.reader,
            node,
            name_place: None,
            path: format!("{}{suffix}", self.path),
            out: &mut out,
        };
        let value = read(slot);
        (value, out)
    }
}

/// Two forms of a value; forms that are themselves alternatives are flattened.
fn any_of(forms: [Json; 2]) -> Json {
    let mut all = Vec::new();
    let mut description = None;
    for mut form in forms {
        match form.get_mut("anyOf").and_then(Json::as_array_mut) {
            Some(inner) => {
                all.append(inner);
                description = description.or_else(|| form.get("description").cloned());
            }
            None => all.push(form),
        }
    }
    let mut schema = json!({ "anyOf": all });
    if let Some(description) = description {
        schema["description"] = description;
    }
    schema
}

fn wrong_length(name: &str, found: usize, wanted: &RangeInclusive<usize>) -> String {
    let entries = |count: usize| match count {
        1 => "1 entry".to_owned(),
        _ => format!("{count} entries"),
    };
    let wanted = match (*wanted.start(), *wanted.end()) {
        (least, most) if least == most => entries(least),
        (least, usize::MAX) => format!("at least {}", entries(least)),
        (least, most) => format!("{least} to {most} entries"),
    };
    format!("`{name}` must have {wanted}, found {found}")
}

/// Adds a diagnostic and hands it back for finishing touches.
pub(super) fn push(list: &mut Vec<Diagnostic>, fault: Diagnostic) -> &mut Diagnostic {
    list.push(fault);
    let last = list.len() - 1;
    &mut list[last]
}

/// `a.b` from `a` and `b`.
pub(super) fn join(path: &str, name: &str) -> String {
    match path.is_empty() {
        true => name.to_owned(),
        false => format!("{path}.{name}"),
    }
}

/// The last part of an address.
pub(super) fn last_name(path: &str) -> &str {
    match path.rsplit('.').next() {
        Some("") | None => "the scene",
        Some(name) => name,
    }
}
