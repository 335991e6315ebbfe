//! The units in which this command shows results: those that were asked for, else those of its scene.

use crate::report::display_units::{DisplayUnits, SIGNIFICANT};
use std::cell::Cell;

thread_local! {
    /// Digits that are shown where the units follow the scene; `None`: the units were asked for.
    static OF_SCENE: Cell<Option<usize>> = const { Cell::new(None) };
}

/// Takes what the arguments say. In SI units results have their own digits, unless others are asked
/// for.
pub(crate) fn start(asked: Option<DisplayUnits>, digits: Option<usize>) {
    let own = asked == Some(DisplayUnits::NONE) && digits.is_none();
    let digits = digits.unwrap_or(SIGNIFICANT);
    OF_SCENE.set(asked.is_none().then_some(digits));
    let units = asked.unwrap_or_default();
    match own {
        true => units.choose(),
        false => units.with_digits(digits).choose(),
    }
}

/// Takes the units of a scene's text, unless others were asked for.
pub(crate) fn adopt_units(scene: &str) {
    if let Some(digits) = OF_SCENE.get() {
        DisplayUnits::of_scene(scene).with_digits(digits).choose();
    }
}
