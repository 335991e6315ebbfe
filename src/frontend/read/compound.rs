//! Reading of values made of other values: objects, lists, alternatives.

use super::fields::Fields;
use super::slot::{Reading, Slot, join_path, last_name, store_into};
use super::tree::{Node, Value};
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

impl Slot<'_> {
    /// Reads an object by its properties; every property that is not asked for
    /// is an error, as is every missing one.
    pub fn record<T>(self, read: impl FnOnce(&mut Fields<'_>) -> Option<T>) -> Option<T> {
        let (mut value, mut read) = (None, Some(read));
        let complete = self.properties(&mut |fields| {
            value = read.take().and_then(|read| read(fields));
        });
        value.filter(|_| complete)
    }

    /// Reads an object by its properties; whether none is unknown or missing.
    fn properties(mut self, read: &mut dyn FnMut(&mut Fields<'_>)) -> bool {
        let object = |node: &Node| matches!(node.value, Value::Object(_));
        if !self.describing() && !self.node.is_some_and(object) {
            self.wrong_type("an object");
            return false;
        }
        let mut fields = Fields::new(&mut self);
        read(&mut fields);
        let (complete, out) = fields.finish();
        *self.out = out;
        complete
    }

    /// Reads an object whose property names are free.
    pub fn map<T>(
        self,
        read: impl FnMut(&str, Slot<'_>) -> Option<T>,
    ) -> Option<BTreeMap<String, T>> {
        let mut values = BTreeMap::new();
        let complete = self.read_members(&mut gathered(&mut values, read));
        complete.then_some(values)
    }

    /// As [`Slot::map`], for values that hold their names: in the order of these.
    pub fn values<T>(self, read: impl FnMut(&str, Slot<'_>) -> Option<T>) -> Option<Vec<T>> {
        let mut values = Vec::new();
        let complete = self.read_members(&mut gathered(&mut values, read));
        complete.then(|| by_name(values))
    }

    /// As [`Slot::values`], for names that serve as addresses: they must fit
    /// [`super::NAME_PATTERN`].
    pub fn names<T>(self, read: impl FnMut(&str, Slot<'_>) -> Option<T>) -> Option<Vec<T>> {
        let mut values = Vec::new();
        let complete = self.named_members(&mut gathered(&mut values, read));
        complete.then(|| by_name(values))
    }

    /// Reads the properties of an object with `read`, which says whether a
    /// value is sound; whether all are.
    fn read_members(mut self, read: &mut dyn FnMut(&str, Slot<'_>) -> bool) -> bool {
        if self.describing() {
            let schema = self.inner("*", None, &mut |slot| {
                read("*", slot);
            });
            *self.out = json!({ "type": "object", "additionalProperties": schema });
            return false;
        }
        let Some(Value::Object(members)) = self.node.map(|node| &node.value) else {
            self.wrong_type("an object");
            return false;
        };
        let (mut canonical, mut complete) = (Map::new(), true);
        for member in members {
            let path = join_path(&self.path, &member.name);
            let mut out = Json::Null;
            let slot = Slot {
                reader: self.reader,
                node: Some(&member.value),
                name_place: Some(member.name_place.clone()),
                path,
                out: &mut out,
            };
            complete &= read(&member.name, slot);
            canonical.insert(member.name.clone(), out);
        }
        *self.out = Json::Object(canonical);
        complete
    }

    /// As [`Slot::read_members`], for names that serve as addresses.
    fn named_members(mut self, read: &mut dyn FnMut(&str, Slot<'_>) -> bool) -> bool {
        let complete = self.reborrow().read_members(&mut |name, mut slot| {
            let sound = slot.describing() || super::is_name(name);
            if !sound {
                slot.refuse_name(name);
            }
            read(name, slot) && sound
        });
        if self.describing() {
            self.out["propertyNames"] = json!({ "pattern": super::NAME_PATTERN });
        }
        complete
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
        self,
        length: RangeInclusive<usize>,
        mut read: impl FnMut(Slot<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        let mut values = Vec::new();
        let complete = self.items(length, &mut |slot| {
            let value = read(slot);
            let sound = value.is_some();
            values.extend(value);
            sound
        });
        complete.then_some(values)
    }

    /// Reads the entries of a list with `read`, which says whether one is
    /// sound; whether all are, and as many as there should be.
    fn items(
        mut self,
        length: RangeInclusive<usize>,
        read: &mut dyn FnMut(Slot<'_>) -> bool,
    ) -> bool {
        if self.describing() {
            let items = self.inner("[]", None, &mut |slot| {
                read(slot);
            });
            let mut schema = json!({ "type": "array", "items": items, "minItems": length.start() });
            if *length.end() < usize::MAX {
                schema["maxItems"] = json!(length.end());
            }
            *self.out = schema;
            return false;
        }
        let Some(Value::List(items)) = self.node.map(|node| &node.value) else {
            self.wrong_type("a list");
            return false;
        };
        let (mut canonical, mut complete) = (Vec::new(), true);
        for (number, item) in items.iter().enumerate() {
            let entry = &mut |slot: Slot<'_>| complete &= read(slot);
            canonical.push(self.inner(&format!("[{number}]"), Some(item), entry));
        }
        *self.out = Json::Array(canonical);
        if !length.contains(&items.len()) {
            let message = wrong_length(&last_name(&self.path), items.len(), &length);
            self.refuse("wrong-length", message);
            return false;
        }
        complete
    }

    /// Reads a list of exactly two values.
    pub fn pair<A, B>(
        self,
        first: impl FnOnce(Slot<'_>) -> Option<A>,
        second: impl FnOnce(Slot<'_>) -> Option<B>,
    ) -> Option<(A, B)> {
        let (mut a, mut b) = (None, None);
        self.two(
            &mut store_into(&mut a, first),
            &mut store_into(&mut b, second),
        );
        Some((a?, b?))
    }

    fn two(mut self, first: Reading<'_>, second: Reading<'_>) {
        if self.describing() {
            let items = [
                self.inner("[0]", None, first),
                self.inner("[1]", None, second),
            ];
            *self.out = json!({
                "type": "array", "prefixItems": items, "minItems": 2, "maxItems": 2
            });
            return;
        }
        let Some(Value::List(items)) = self.node.map(|node| &node.value) else {
            self.wrong_type("a list of two values");
            return;
        };
        let [one, other] = items.as_slice() else {
            let message = wrong_length(&last_name(&self.path), items.len(), &(2..=2));
            self.refuse("wrong-length", message);
            return;
        };
        let one = self.inner("[0]", Some(one), first);
        let other = self.inner("[1]", Some(other), second);
        *self.out = json!([one, other]);
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

    /// Reads one of several names, or anything else, a formula too, another way.
    pub fn choice_or<T: Clone>(
        self,
        choices: &[(&'static str, T)],
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        let text = self.node.and_then(Node::text);
        let named = choices.iter().any(|choice| Some(choice.0) == text);
        match self.is_formula() && !named {
            true => other(self),
            false => self.text_or(|slot| slot.choice(choices), other),
        }
    }

    /// Reads `true` or `false` one way and anything else another way.
    pub fn flag_or<T>(
        self,
        flag: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        self.fork(|value| matches!(value, Value::Flag(_)), flag, other)
    }

    /// Reads a list one way (`Ok`) and anything else another way (`Err`); the
    /// slot can still note faults afterwards.
    pub fn list_or<A, B>(
        &mut self,
        list: impl FnOnce(Slot<'_>) -> Option<A>,
        other: impl FnOnce(Slot<'_>) -> Option<B>,
    ) -> Option<Result<A, B>> {
        self.reborrow().fork(
            |value| matches!(value, Value::List(_)),
            |slot| list(slot).map(Ok),
            |slot| other(slot).map(Err),
        )
    }

    fn fork<T>(
        self,
        is_first: fn(&Value) -> bool,
        first: impl FnOnce(Slot<'_>) -> Option<T>,
        other: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        let describing = self.describing();
        let (mut a, mut b) = (None, None);
        self.either(
            is_first,
            &mut store_into(&mut a, first),
            &mut store_into(&mut b, other),
        );
        a.or(b).filter(|_| !describing)
    }

    /// Reads a value one way or another, or describes both.
    fn either(mut self, is_first: fn(&Value) -> bool, first: Reading<'_>, other: Reading<'_>) {
        if self.describing() {
            let forms = [self.inner("", None, other), self.inner("", None, first)];
            *self.out = any_of(forms);
        } else if let Some(node) = self.node {
            match is_first(&node.value) {
                true => first(self),
                false => other(self),
            }
        }
    }

    /// Reads a value whose schema is written once under a name.
    pub fn defined<T>(self, name: &str, read: impl FnOnce(Slot<'_>) -> Option<T>) -> Option<T> {
        let describing = self.describing();
        let mut value = None;
        self.read_alternative(name, &mut store_into(&mut value, read));
        value.filter(|_| !describing)
    }

    fn read_alternative(mut self, name: &str, read: Reading<'_>) {
        if !self.describing() {
            return read(self);
        }
        if !self.reader.definitions.contains_key(name) {
            self.reader.definitions.insert(name.to_owned(), Json::Null);
            let schema = self.inner("", None, read);
            self.reader.definitions.insert(name.to_owned(), schema);
        }
        *self.out = json!({ "$ref": format!("#/$defs/{name}") });
    }
}

/// Puts sound values into `values`, with their names.
fn gathered<T>(
    values: &mut impl Extend<(String, T)>,
    mut read: impl FnMut(&str, Slot<'_>) -> Option<T>,
) -> impl FnMut(&str, Slot<'_>) -> bool {
    move |name, slot| {
        let value = read(name, slot);
        let sound = value.is_some();
        values.extend(value.map(|value| (name.to_owned(), value)));
        sound
    }
}

/// Values in the order of their names.
fn by_name<T>(mut values: Vec<(String, T)>) -> Vec<T> {
    values.sort_by_cached_key(|(name, _)| name.clone());
    values.into_iter().map(|(_, value)| value).collect()
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
