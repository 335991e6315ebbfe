//! Dimensions that a scene declares under a name.

use crate::frontend::diagnostics::Place;
use crate::units::Measure;

/// The named numbers of the object that is being read.
#[derive(Debug, Default)]
pub(super) struct Dimensions {
    /// True while the schema of an object with named numbers is written.
    pub(super) described: bool,
    pub(super) entries: Vec<Entry>,
}

#[derive(Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) place: Place,
    /// A faulty one stands for any number, so that its fault is said once.
    pub(super) value: Option<ParsedNumber>,
    pub(super) used: bool,
}

/// A number with its unit, or without one: then it is in SI units of whatever
/// is wanted where it is referred to.
#[derive(Clone, Copy, Debug)]
pub(super) enum ParsedNumber {
    Plain(f64),
    Measured(Measure),
}

impl Dimensions {
    /// Pattern of the texts that are taken besides a number with a unit.
    pub(super) fn pattern(&self) -> Option<&'static str> {
        self.described.then_some(REFERENCE_PATTERN)
    }
}

/// Texts that refer to a named number.
pub(super) const REFERENCE_PATTERN: &str =
    r"^\s*-?\s*[A-Za-z_][A-Za-z0-9_-]*\s*([*/]\s*[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?)?\s*$";
