//! Objects of any kind, and objects that no text can state.

use super::{builder, one_property};
use crate::frontend::object::{INPUT, Object};
use crate::frontend::read::{Node, OWN, Own};
use std::sync::Arc;

builder! {
    /// An object of a kind that has no builder of its own, or of the catalogue.
    AnyObject {
        /// Remarks for people.
        description;
        /// Id of the object that drives it, or an output of one: `press`, `press.ram`.
        input;
    }
}

impl AnyObject {
    /// An object of a kind that the scene knows by name.
    pub fn of_kind(kind: &str) -> Self {
        Self(super::of_kind(kind))
    }

    /// A copy of an object of the catalogue, `linkage/toggle-press`; properties given
    /// here replace its own.
    pub fn copy_of(catalogued: &str) -> Self {
        Self(one_property("from", catalogued))
    }
}

/// An object of your own, given as a value.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct OwnObject(Node);

impl OwnObject {
    /// An object that lowers itself.
    pub fn new(object: impl Object + 'static) -> Self {
        let own = crate::frontend::object::OwnObject(Arc::new(object));
        Self(one_property(OWN, Own::new(own)))
    }

    /// Connects the only input.
    pub fn on(mut self, driver: &str) -> Self {
        self.0.set_property(INPUT, driver);
        self
    }

    /// Connects one of several inputs, by the name of its port.
    pub fn input(mut self, port: &str, driver: &str) -> Self {
        self.0
            .property("inputs")
            .set_property(port, one_property("object", driver));
        self
    }
}

impl From<OwnObject> for Node {
    fn from(object: OwnObject) -> Self {
        object.0
    }
}
