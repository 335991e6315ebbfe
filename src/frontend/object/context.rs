//! What an object's reading knows of the others.

use super::ports::INPUT;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Fields, Slot, did_you_mean, quoted_list};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// What is known of an object, or of an output of one, also of a faulty one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownObject {
    /// Whether it turns or slides; `None`: not known.
    pub coordinate: Option<Coordinate>,
    /// Number of coordinates that a start state has; `None`: not known.
    pub masses: Option<usize>,
}

/// A connection: an input of an object hangs on an output of another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Connection {
    /// Name of the input port.
    pub port: String,
    /// The output it is connected to: `press`, `press.ram`.
    pub output: String,
}

/// Surroundings of an object while it is read, and what it connects to.
#[derive(Debug)]
pub struct Context<'a> {
    /// Whether the driver of an object with one input turns or slides; `None`: not
    /// known.
    pub driver: Option<Coordinate>,
    /// All objects by id; outputs of objects as `object.output`.
    objects: &'a BTreeMap<String, KnownObject>,
    connections: RefCell<Vec<Connection>>,
    mentions: RefCell<Vec<String>>,
}

/// What a property that names a driver holds.
const REFERENCE: &str =
    "Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.";

impl<'a> Context<'a> {
    /// Among the objects of a scene.
    pub(crate) fn among(objects: &'a BTreeMap<String, KnownObject>) -> Self {
        Self {
            driver: None,
            objects,
            connections: RefCell::default(),
            mentions: RefCell::default(),
        }
    }

    /// The connections read so far, and the outputs to whose motion something refers.
    pub(crate) fn into_references(self) -> (Vec<Connection>, Vec<String>) {
        (self.connections.into_inner(), self.mentions.into_inner())
    }

    /// Whether an output turns or slides; `None`: not known.
    pub(super) fn coordinate_of(&self, output: &str) -> Option<Coordinate> {
        self.objects.get(output).and_then(|known| known.coordinate)
    }

    /// Reads a property that names an object, or one of its outputs, to whose motion something
    /// refers without being driven by it: `Some(None)` where it is not there.
    pub(super) fn mention(
        &self,
        fields: &mut Fields<'_>,
        property: &'static str,
        doc: &str,
    ) -> Option<Option<String>> {
        if fields.describing() {
            let ids = self.objects.keys().map(String::as_str);
            return fields.maybe(property, doc, |slot| slot.text_like(ids));
        }
        let output = fields.maybe(property, doc, |slot| self.reference(slot))?;
        if let Some(output) = &output {
            self.mentions.borrow_mut().push(output.clone());
        }
        Some(output)
    }

    /// Reads the property `input` of an object with one driver, and remembers whether
    /// that turns or slides.
    pub(crate) fn input(&mut self, fields: &mut Fields<'_>) -> Option<()> {
        self.driver = self.connect(fields, INPUT, INPUT)?;
        Some(())
    }

    /// Describes the property `input` of an object that may have several instead.
    pub(crate) fn maybe_input(&self, fields: &mut Fields<'_>) {
        let ids = self.objects.keys().map(String::as_str);
        fields.maybe(INPUT, REFERENCE, |slot| slot.text_like(ids));
    }

    /// Reads a property that may name the output which an input `port` hangs on:
    /// `Some(None)` where it is not there, else whether that output turns or slides.
    pub fn connect_if_given(
        &self,
        fields: &mut Fields<'_>,
        property: &'static str,
        port: &str,
    ) -> Option<Option<Option<Coordinate>>> {
        if fields.describing() {
            let ids = self.objects.keys().map(String::as_str);
            fields.maybe(property, REFERENCE, |slot| slot.text_like(ids));
            return None;
        }
        match fields.has(property) {
            true => self.connect(fields, property, port).map(Some),
            false => Some(None),
        }
    }

    /// Reads a property that names the output which an input `port` hangs on; it must
    /// exist. Returns whether it turns or slides, `Some(None)` where that is not known.
    pub fn connect(
        &self,
        fields: &mut Fields<'_>,
        property: &'static str,
        port: &str,
    ) -> Option<Option<Coordinate>> {
        if fields.describing() {
            let ids = self.objects.keys().map(String::as_str);
            fields.need(property, REFERENCE, |slot| slot.text_like(ids));
            return None;
        }
        let output = fields.maybe(property, REFERENCE, |slot| self.reference(slot))?;
        let Some(output) = output else {
            let ids = self.objects.keys().map(String::as_str);
            let path = fields.path();
            let path = path.strip_prefix("objects.").unwrap_or(path);
            let others = ids.filter(|id| path.split('.').next() != Some(id));
            let hint = format!(
                "name what drives it: {}",
                quoted_list(others.take(20), "or")
            );
            fields.note_missing(property, Some(hint));
            return None;
        };
        let coordinate = self.objects.get(&output).and_then(|known| known.coordinate);
        self.connections.borrow_mut().push(Connection {
            port: port.to_owned(),
            output,
        });
        Some(coordinate)
    }

    fn reference(&self, mut slot: Slot<'_>) -> Option<String> {
        let output = slot.read_in_place(|slot| slot.text())?;
        if self.objects.contains_key(&output) {
            return Some(output);
        }
        match output.split_once('.') {
            Some((id, name)) if self.objects.contains_key(id) => {
                self.unknown_output(&mut slot, id, name);
            }
            _ => {
                let id = object_of(&output);
                let ids = || self.objects.keys().map(String::as_str);
                let guess = did_you_mean(id, ids());
                let all = format!("the objects are {}", quoted_list(ids().take(20), "and"));
                let fault = slot.refuse("unknown-object", format!("unknown object `{id}`"));
                fault.hints.push(guess.unwrap_or(all));
            }
        }
        None
    }

    fn unknown_output(&self, slot: &mut Slot<'_>, id: &str, output: &str) {
        let outputs: Vec<&str> = (self.objects.keys())
            .filter_map(|known| known.strip_prefix(id)?.strip_prefix('.'))
            .collect();
        let hint = match did_you_mean(output, outputs.iter().copied()) {
            Some(guess) => guess,
            None if outputs.is_empty() => format!("it has one output: write \"{id}\""),
            None => format!("its outputs are {}", quoted_list(outputs, "and")),
        };
        let fault = slot.refuse("unknown-object", format!("`{id}` has no output `{output}`"));
        fault.hints.push(hint);
    }
}

/// Id of the object that a reference names, without its output.
pub fn object_of(reference: &str) -> &str {
    reference.split_once('.').map_or(reference, |(id, _)| id)
}
