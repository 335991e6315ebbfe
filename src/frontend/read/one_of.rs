//! Properties of which exactly one is given.

use super::fields::Fields;
use super::slot::{Slot, push};
use crate::frontend::diagnostics::Diagnostic;

/// Reads a group of properties of which exactly one may be there.
#[derive(Debug)]
pub struct OneOf<'f, 'a, T> {
    group: Group<'f, 'a>,
    value: Option<T>,
}

/// The names of the group, whatever its values are.
#[derive(Debug)]
struct Group<'f, 'a> {
    fields: &'f mut Fields<'a>,
    /// Meaning of the group, for messages: `its law`.
    what: &'static str,
    names: Vec<&'static str>,
    found: Vec<&'static str>,
}

impl<'a> Fields<'a> {
    /// Reads properties of which exactly one must be there.
    pub fn one_of<T>(&mut self, what: &'static str) -> OneOf<'_, 'a, T> {
        OneOf::new(self, what)
    }
}

impl<'f, 'a, T> OneOf<'f, 'a, T> {
    pub(super) fn new(fields: &'f mut Fields<'a>, what: &'static str) -> Self {
        Self {
            group: Group {
                fields,
                what,
                names: Vec::new(),
                found: Vec::new(),
            },
            value: None,
        }
    }

    /// One of the properties.
    pub fn case(
        &mut self,
        name: &'static str,
        doc: &str,
        read: impl FnOnce(Slot<'_>) -> Option<T>,
    ) -> &mut Self {
        self.group.add(name);
        if let Some(Some(value)) = self.group.fields.maybe(name, doc, read) {
            self.value = Some(value);
        }
        self
    }

    /// True if one of the properties is there, right or wrong.
    pub fn is_given(&self) -> bool {
        !self.group.found.is_empty()
    }

    /// The value of the one that is there.
    pub fn finish(self) -> Option<T> {
        let alone = self.group.finish();
        self.value.filter(|_| alone)
    }
}

impl Group<'_, '_> {
    fn add(&mut self, name: &'static str) {
        self.names.push(name);
        if self.fields.has(name) {
            self.found.push(name);
        }
    }

    /// Whether exactly one is there.
    fn finish(self) -> bool {
        self.fields.alternatives.push(self.names.clone());
        match self.found.as_slice() {
            [] if self.fields.describing() => false,
            [] => {
                self.fields.note_missing_one_of(self.names, self.what);
                false
            }
            [_] => true,
            [first, others @ ..] => {
                for other in others {
                    clash(self.fields, first, other, self.what);
                }
                false
            }
        }
    }
}

fn clash(fields: &mut Fields<'_>, first: &str, other: &str, what: &str) {
    let fault = Diagnostic::error(
        "two-ways",
        format!("`{first}` and `{other}` both say {what}"),
    )
    .at(fields.place_of(other))
    .path(format!("{}.{other}", fields.path()))
    .label("given again here")
    .with_place(fields.place_of(first), "first given here")
    .hint("keep one of them");
    push(&mut fields.reader.diagnostics, fault);
}
