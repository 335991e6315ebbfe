//! A scene with something left out, run.

use super::removal::{Removal, set_level};
use crate::fault::Fault;
use crate::frontend::diagnostics::{Diagnostics, Severity};
use crate::frontend::scene::{BuiltIn, Document, Levels, Overrides, TypedScene};

/// The scene with what is left out of it.
///
/// # Errors
/// There is no such scene: the first thing that is wrong with it.
pub(super) fn without(whole: &Document, removals: &[Removal]) -> Result<TypedScene, String> {
    let changed = changed(whole, removals);
    let reading = changed.scene(&BuiltIn, &Overrides::none());
    reading
        .map(|reading| reading.scene)
        .map_err(|faults| first(&faults))
}

/// The document with what is left out of it.
fn changed(whole: &Document, removals: &[Removal]) -> Document {
    let mut document = whole.clone();
    document.edit(|root| removals.iter().for_each(|one| one.apply(root)));
    document
}

/// The same with the levels of its elastic objects.
pub(super) fn at_levels(whole: &Document, removals: &[Removal], levels: &Levels) -> Document {
    let mut document = changed(whole, removals);
    document.edit(|root| {
        for (id, level) in levels {
            set_level(root, id, *level);
        }
    });
    document
}

fn first(faults: &Diagnostics) -> String {
    let mut items = faults.items.iter();
    let first = items.find(|item| item.severity == Severity::Error);
    first.map_or(String::new(), |item| item.message.clone())
}

/// What is wrong with a model, in a line.
pub(super) fn words(faults: &[Fault]) -> String {
    faults.first().map_or(String::new(), |fault| {
        format!("{}: {}", fault.path, fault.message)
    })
}
