//! Dimensions that a scene declares under a name.

use crate::frontend::diagnostics::Place;
use crate::units::Measure;

/// The named numbers of the object that is being read.
#[derive(Debug, Default)]
pub(super) struct Dimensions {
    pub(super) entries: Vec<Entry>,
}

#[derive(Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) place: Place,
    /// A faulty one stands for any number, so that its fault is said once.
    pub(super) value: Option<Measure>,
    pub(super) used: bool,
}
