//! Reading of values made of other values: objects, lists, alternatives.

use super::fields::Fields;
use super::slot::{Slot, join, last_name};
use super::tree::Value;
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

impl Slot<'_> {
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
            let message = wrong_length(&last_name(&self.path), items.len(), &length);
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
            let message = wrong_length(&last_name(&self.path), items.len(), &(2..=2));
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
    format!("{name} must have {wanted}, found {found}")
}
