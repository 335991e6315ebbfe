//! The property `accuracy` of a run.

use super::objects::ObjectTable;
use super::{Accuracy, AccuracySpec, expect};
use crate::frontend::read::{Bounds, QuantityChoice, Slot};

/// Reads `accuracy`.
pub(super) fn read(slot: Slot<'_>, known: &ObjectTable) -> Option<AccuracySpec> {
    slot.object_or(
        |slot| {
            let named = |address: &str, slot: Slot<'_>| {
                Some((address.to_owned(), read_one(slot, address, known)?))
            };
            slot.values(named).map(AccuracySpec::Figures)
        },
        |slot| slot.number(Bounds::POSITIVE).map(AccuracySpec::Share),
    )
}

/// How accurate the figure of an address is to be.
fn read_one(mut slot: Slot<'_>, address: &str, known: &ObjectTable) -> Option<Accuracy> {
    let wanted = match slot.describing() {
        true => QuantityChoice::anything(),
        false => expect::read_figure_of_run(&mut slot, address, known)?,
    };
    match expect::is_share(&slot) {
        true => slot.number(Bounds::POSITIVE).map(Accuracy::Share),
        false => {
            if wanted == QuantityChoice::anything() {
                known.keep_measure(address, &mut slot);
            }
            slot.quantity(wanted, Bounds::NOT_NEGATIVE)
                .map(Accuracy::Bound)
        }
    }
}
