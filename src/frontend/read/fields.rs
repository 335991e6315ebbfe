//! The properties of an object.

mod closing;

use super::own::OWN;
use super::slot::{Reader, Reading, Slot, join_path, push, store_into};
use super::suggest::quoted_list;
use super::tree::{Member, Node, Value};
use crate::frontend::diagnostics::{Diagnostic, Place, Severity};
use serde_json::{Map, Value as Json, json};

/// Reads the properties of an object one by one; knows which were asked for.
#[derive(Debug)]
pub struct Fields<'a> {
    pub(super) reader: &'a mut Reader,
    node: Option<&'a Node>,
    path: String,
    /// Place to point at when something is missing.
    place: Place,
    pub(super) known: Vec<&'static str>,
    /// Other names of properties: `inertia`, `mass`.
    synonyms: Vec<(&'static str, &'static str)>,
    /// Groups of names of which one is missing.
    missing: Vec<MissingProperty>,
    out: Map<String, Json>,
    required: Vec<&'static str>,
    pub(super) alternatives: Vec<Vec<&'static str>>,
    free: bool,
    /// Number of faults when its named numbers came into scope, which they stay
    /// in until it ends.
    pub(super) faults_before_dimensions: Option<usize>,
}

#[derive(Debug)]
struct MissingProperty {
    names: Vec<&'static str>,
    what: &'static str,
    hint: Option<String>,
}

/// Presence of a property that was asked for.
#[derive(Clone, Copy, Debug)]
enum Presence {
    /// The schema is being written.
    Described,
    Written,
    Absent,
}

impl<'a> Fields<'a> {
    pub(super) fn new(slot: &'a mut Slot<'_>) -> Self {
        let place = match &slot.name_place {
            Some(place) => place.clone(),
            None => slot.place().first(),
        };
        Self {
            reader: slot.reader,
            node: slot.node,
            path: slot.path.clone(),
            place,
            known: Vec::new(),
            synonyms: Vec::new(),
            missing: Vec::new(),
            out: Map::new(),
            required: Vec::new(),
            alternatives: Vec::new(),
            free: false,
            faults_before_dimensions: None,
        }
    }

    /// Address of the object.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The object itself; `None` when describing.
    pub fn node(&self) -> Option<&'a Node> {
        self.node
    }

    /// True when the schema is being written.
    pub fn describing(&self) -> bool {
        self.reader.describing
    }

    /// The property as written, under any of its names; `None` when absent.
    pub fn member(&self, name: &str) -> Option<&'a Member> {
        let node = self.node?;
        let other = || self.other_names(name).find_map(|other| node.member(other));
        node.member(name).or_else(other)
    }

    /// Gives a property another name, under which it may be written instead.
    pub fn synonym(&mut self, name: &'static str, other: &'static str) {
        let both = [name, other].iter().all(|one| self.has(one));
        if both {
            self.clash(name, other, "they are two names of one property");
        }
        self.known.push(other);
        self.synonyms.push((name, other));
    }

    /// The other names of a property.
    pub(super) fn other_names<'n>(
        &'n self,
        name: &'n str,
    ) -> impl Iterator<Item = &'static str> + 'n {
        let own = self.synonyms.iter().filter(move |one| one.0 == name);
        own.map(|one| one.1)
    }

    /// True when the property is written.
    pub fn has(&self, name: &str) -> bool {
        self.member(name).is_some()
    }

    /// Place of a property's name; of the object itself when it is absent.
    pub fn place_of(&self, name: &str) -> Place {
        self.member(name)
            .map_or_else(|| self.place.clone(), |member| member.name_place.clone())
    }

    /// Place of a property's value; of the object itself when it is absent.
    pub fn value_place(&self, name: &str) -> Place {
        self.member(name)
            .map_or_else(|| self.place.clone(), |member| member.value.place.clone())
    }

    /// Reads a property that must be there.
    pub fn need<T>(
        &mut self,
        name: &'static str,
        doc: &str,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        let mut value = None;
        self.required.push(name);
        let presence = self.property(name, doc, &mut store_into(&mut value, read));
        match presence {
            Presence::Written => value,
            Presence::Absent => {
                self.note_missing(name, None);
                None
            }
            Presence::Described => None,
        }
    }

    /// Reads a property that may be left out: `Some(None)`; `None` when faulty.
    pub fn maybe<T>(
        &mut self,
        name: &'static str,
        doc: &str,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<Option<T>> {
        let mut value = None;
        let presence = self.property(name, doc, &mut store_into(&mut value, read));
        match presence {
            Presence::Absent => Some(None),
            Presence::Written => value.map(Some),
            Presence::Described => None,
        }
    }

    /// Reads a property that has a default, given as it would be written.
    pub fn or<T>(
        &mut self,
        name: &'static str,
        doc: &str,
        default: Json,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> Option<T> {
        let mut value = None;
        self.property_or(name, doc, default, &mut store_into(&mut value, read));
        value.filter(|_| !self.describing())
    }

    /// Reads a property, if it is there, or describes it.
    fn property(&mut self, name: &'static str, doc: &str, read: Reading<'_>) -> Presence {
        self.known.push(name);
        if self.describing() {
            let mut schema = self.child(name, None, read);
            add_description(&mut schema, doc);
            for other in self.other_names(name).collect::<Vec<_>>() {
                let mut same = schema.clone();
                same["description"] = json!(format!("Another name of `{name}`."));
                self.out.insert(other.to_owned(), same);
            }
            self.out.insert(name.to_owned(), schema);
            return Presence::Described;
        }
        let Some(member) = self.member(name) else {
            return Presence::Absent;
        };
        let written = Some((&member.value, &member.name_place));
        let out = self.child(&member.name, written, read);
        self.out.insert(name.to_owned(), out);
        Presence::Written
    }

    /// Reads a property or its default, or describes both.
    fn property_or(&mut self, name: &'static str, doc: &str, default: Json, read: Reading<'_>) {
        match self.property(name, doc, read) {
            Presence::Written => {}
            Presence::Described => self.out[name]["default"] = default,
            Presence::Absent => {
                let place = self.place.clone();
                let node = Node::filled_in(&default, &place);
                let out = self.child(name, Some((&node, &place)), read);
                self.out.insert(name.to_owned(), out);
            }
        }
    }

    /// The value given in code as the property [`OWN`], where there is one of this type.
    pub fn own<T: Clone + 'static>(&mut self, doc: &str) -> Option<T> {
        match self.member(OWN)?.value.value {
            Value::Own(_) => self.need(OWN, doc, |mut slot| {
                let found = slot.own();
                if found.is_none() {
                    slot.wrong_type("a value of the kind that belongs here");
                }
                found
            }),
            // Of a text it is a property like any other, and unknown.
            _ => None,
        }
    }

    /// Reads a remark for people, which is no part of the canonical form.
    pub fn remark(&mut self, name: &'static str, doc: &str) {
        self.maybe(name, doc, |slot| slot.text());
        if !self.describing() {
            self.out.remove(name);
        }
    }

    /// Number of faults noted so far, without warnings.
    pub fn faults(&self) -> usize {
        let noted = self.reader.diagnostics.iter();
        noted.filter(|one| one.severity == Severity::Error).count()
    }

    /// Takes any further properties without looking at them.
    pub fn ignore_others(&mut self) {
        self.free = true;
    }

    /// Sets the canonical value of a property whose default was computed.
    pub fn fill_in(&mut self, name: &str, value: Json) {
        if !self.describing() {
            self.out.insert(name.to_owned(), value);
        }
    }

    /// Notes that one of these properties is missing.
    pub(super) fn note_missing_one_of(&mut self, names: Vec<&'static str>, what: &'static str) {
        let alternatives = quoted_list(names.iter().copied(), "or");
        let hint = Some(format!("give {alternatives}"));
        self.missing.push(MissingProperty { names, what, hint });
    }

    /// Notes that a property is missing (unless a misspelled one stands for it).
    pub fn note_missing(&mut self, name: &'static str, hint: Option<String>) {
        let names = vec![name];
        self.missing.push(MissingProperty {
            names,
            what: "",
            hint,
        });
    }

    /// Notes that a property which is written must not be.
    pub fn forbid(&mut self, name: &'static str, message: &str, hint: &str) -> bool {
        let Some(member) = self.member(name) else {
            return false;
        };
        self.known.push(name);
        let fault = Diagnostic::error("contradiction", message)
            .at(member.name_place.clone())
            .path(join_path(&self.path, name))
            .hint(hint);
        self.reader.diagnostics.push(fault);
        true
    }

    /// Notes a fault of a property (or of the object, when it is absent).
    pub fn refuse(
        &mut self,
        name: &str,
        code: &'static str,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        let fault = Diagnostic::error(code, message)
            .at(self.value_place(name))
            .path(match self.member(name) {
                Some(member) => join_path(&self.path, &member.name),
                None => self.path.clone(),
            });
        push(&mut self.reader.diagnostics, fault)
    }

    /// Notes a warning about a property.
    pub fn warn(
        &mut self,
        name: &str,
        code: &'static str,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        let warning = Diagnostic::warning(code, message)
            .at(self.value_place(name))
            .path(join_path(&self.path, name));
        push(&mut self.reader.diagnostics, warning)
    }

    /// Notes that two properties say the same thing in two ways, if both are
    /// written. Returns whether they clash.
    pub fn clash(&mut self, one: &str, other: &str, why: &str) -> bool {
        let (Some(a), Some(b)) = (self.member(one), self.member(other)) else {
            return false;
        };
        // Point at what came last: an override, or what stands further down.
        let rank = |member: &Member| (member.name_place.source, member.name_place.range.start);
        let (early, late) = if rank(a) <= rank(b) { (a, b) } else { (b, a) };
        let fault = Diagnostic::error(
            "two-ways",
            format!("`{}` and `{}` cannot both be given: {why}", a.name, b.name),
        )
        .at(late.name_place.clone())
        .path(join_path(&self.path, &late.name))
        .label(format!("`{}` given here", late.name))
        .with_place(
            early.name_place.clone(),
            format!("`{}` given here", early.name),
        )
        .hint(format!("remove `{}` or `{}`", early.name, late.name));
        push(&mut self.reader.diagnostics, fault);
        true
    }

    /// Reads a value inside this object; its canonical form or schema.
    fn child(&mut self, name: &str, found: Option<(&Node, &Place)>, read: Reading<'_>) -> Json {
        let mut out = Json::Null;
        read(Slot {
            reader: self.reader,
            node: found.map(|found| found.0),
            name_place: found.map(|found| found.1.clone()),
            path: join_path(&self.path, name),
            out: &mut out,
        });
        out
    }

    /// Reports unknown and missing properties. Returns whether there were
    /// none, and the canonical form or schema.
    pub(super) fn finish(mut self) -> (bool, Json) {
        let used = self.end_dimensions();
        if self.describing() {
            return (false, self.schema());
        }
        let suggestions = self.report_unknown();
        let mut complete = suggestions.is_empty() && used;
        for missing in std::mem::take(&mut self.missing) {
            complete = false;
            // A misspelled name has already been reported.
            let meant = |name: &str| suggestions.iter().flatten().any(|found| *found == name);
            let misspelled = |name: &&'static str| meant(name) || self.other_names(name).any(meant);
            if !missing.names.iter().any(misspelled) {
                self.report_missing(&missing);
            }
        }
        (complete, Json::Object(self.out))
    }
}

/// Puts the property's meaning before what the value's schema says of itself.
fn add_description(schema: &mut Json, doc: &str) {
    let Some(map) = schema.as_object_mut() else {
        return;
    };
    let own = map.get("description").and_then(Json::as_str);
    let whole = match own {
        Some(own) => format!("{doc} {own}"),
        None => doc.to_owned(),
    };
    map.insert("description".to_owned(), json!(whole));
}
