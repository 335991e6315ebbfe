//! A scene with something left out, run.

use super::removal::{Removal, set_level};
use crate::fault::Fault;
use crate::frontend::diagnostics::Severity;
use crate::frontend::scene::edit::remove_property;
use crate::frontend::scene::{BuiltIn, Document, Levels, Overrides, TypedScene};

/// The scene with what is left out of it.
///
/// # Errors
/// There is no such scene: the first thing that is wrong with it.
pub(super) fn scene_without(whole: &Document, removals: &[Removal]) -> Result<TypedScene, String> {
    let mut document = whole.clone();
    document.edit(|root| removals.iter().for_each(|one| one.apply(root)));
    without_unused_dimensions(document).1
}

/// The document with what is left out of it, and with the levels of its elastic objects.
pub(super) fn at_levels(whole: &Document, removals: &[Removal], levels: &Levels) -> Document {
    let mut document = whole.clone();
    document.edit(|root| {
        removals.iter().for_each(|one| one.apply(root));
        for (id, level) in levels {
            set_level(root, id, *level);
        }
    });
    without_unused_dimensions(document).0
}

/// The document without dimensions to which nothing refers any more, and its scene.
fn without_unused_dimensions(mut document: Document) -> (Document, Result<TypedScene, String>) {
    loop {
        let faults = match document.scene(&BuiltIn, &Overrides::none()) {
            Ok(reading) => return (document, Ok(reading.scene)),
            Err(faults) => faults,
        };
        let errors = || (faults.items.iter()).filter(|item| item.severity == Severity::Error);
        let mut taken = false;
        document.edit(|root| {
            for one in errors().filter(|item| item.code == "unknown-dimension") {
                taken |= one.path.contains(".dimensions.") && remove_property(root, &one.path);
            }
        });
        if !taken {
            let first = errors().next().map(|item| item.message.clone());
            return (document, Err(first.unwrap_or_default()));
        }
    }
}

/// What is wrong with a model, in a line.
pub(super) fn words(faults: &[Fault]) -> String {
    faults.first().map_or(String::new(), |fault| {
        format!("{}: {}", fault.path, fault.message)
    })
}
