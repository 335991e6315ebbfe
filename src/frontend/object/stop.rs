//! One-sided stops of the last mass against the ground: valve seats, end stops.

use super::contact;
use super::measures::Measures;
use super::spec::{BodySpec, ChainSpec, StopSpec};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot};
use serde_json::json;

/// Reads `stops`, in the order of their names.
pub(super) fn read_all(fields: &mut Fields<'_>, own: Measures) -> Option<Vec<StopSpec>> {
    let doc = "One-sided stops of the last mass against the ground, by name.";
    fields.or("stops", doc, json!({}), |slot| {
        slot.names(|name, slot| {
            let definition = match own.0 {
                Some(Coordinate::Turning) => "turning_stop",
                Some(Coordinate::Sliding) => "sliding_stop",
                None => "stop",
            };
            slot.defined(definition, |slot| read(slot, name, own))
        })
    })
}

fn read(slot: Slot<'_>, name: &str, own: Measures) -> Option<StopSpec> {
    slot.record(|fields| {
        let at = fields.need("at", "Displacement at which it is touched", |slot| {
            slot.quantity(own.displacement(), Bounds::ANY)
        });
        let doc = "`-`: it holds the mass from going below `at`; `+`: from going above.";
        let side = fields.need("side", doc, |slot| slot.choice(&[("+", 1.0), ("-", -1.0)]));
        let contact = fields.need("contact", "Its contact.", |slot| contact::read(slot, own));
        if contact.is_some_and(|contact| contact.on_cam.is_some()) {
            let message = "a stop is no cam: the stiffness of its contact does not follow from one";
            let fault = fields.refuse("contact", "contradiction", message);
            let hint = "give a `line` or a `point` with its radii, or the `stiffness`";
            fault.hints.push(hint.to_owned());
            return None;
        }
        Some(StopSpec {
            name: name.to_owned(),
            at: at?,
            side: side?,
            contact: contact?,
        })
    })
}

/// Stops that contradict the object, or each other.
pub(super) fn check(fields: &mut Fields<'_>, chain: &ChainSpec) -> Option<()> {
    if chain.stops.is_empty() {
        return Some(());
    }
    let mut refuse = |message: String, hint: &str| {
        let fault = fields.refuse("stops", "contradiction", message);
        fault.hints.push(hint.to_owned());
        None
    };
    if let BodySpec::Modes { .. } = chain.body {
        return refuse(
            "an object of modes takes no stop: its modes are those of the object free at its output"
                .to_owned(),
            "give `masses` in place of `modes`",
        );
    }
    if chain.masses() == 0 {
        return refuse(
            "a rigid object takes no stop: nothing between its driver and the stop is elastic"
                .to_owned(),
            "give the object at least one mass, or its pair a `contact`",
        );
    }
    let upper = || chain.stops.iter().filter(|stop| stop.side > 0.0);
    for lower in chain.stops.iter().filter(|stop| stop.side < 0.0) {
        if let Some(upper) = upper().find(|upper| upper.at <= lower.at) {
            let message = format!(
                "`{}`, which holds from below, is not below `{}`, which holds from above",
                lower.name, upper.name
            );
            return refuse(message, "exchange their sides, or move one of them");
        }
    }
    Some(())
}
