//! Position functions of simple linkages.

use crate::dynamics::model::Coordinate::{Sliding, Turning};
use crate::frontend::object::cam::read_phase;
use crate::frontend::object::measures::Measures;
use crate::frontend::object::measures::read_quantity;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::position::{PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput};
use crate::units::quantities as q;
use serde_json::json;

fn read_length(fields: &mut Fields<'_>, name: &'static str, doc: &str) -> Option<f64> {
    fields.need(name, doc, |slot| slot.quantity(q::LENGTH, Bounds::POSITIVE))
}

fn read_branch(fields: &mut Fields<'_>, doc: &str) -> Option<f64> {
    fields.or("branch", doc, json!("+"), |slot| {
        slot.choice(&[("+", 1.0), ("-", -1.0)])
    })
}

pub(super) fn read_slider_crank(slot: Slot<'_>) -> Option<PositionSpec> {
    slot.record(|fields| {
        let crank = read_length(fields, "crank", "Crank radius r");
        let rod = read_length(fields, "rod", "Connecting rod length l");
        let offset = fields.or(
            "offset",
            "Offset e of the guide from the crank's axis",
            json!(0.0),
            read_quantity(q::LENGTH),
        );
        let branch = read_branch(fields, "Side of the crank's axis on which the slide runs.");
        let phase = read_phase(fields);
        Some(PositionSpec::SliderCrank {
            crank: crank?,
            rod: rod?,
            offset: offset?,
            branch: branch?,
            phase: phase?,
        })
    })
}

pub(super) fn read_four_bar(slot: Slot<'_>) -> Option<PositionSpec> {
    slot.record(|fields| {
        let crank = read_length(fields, "crank", "Length of the driving crank");
        let coupler = read_length(fields, "coupler", "Length of the coupler");
        let rocker = read_length(fields, "rocker", "Length of the driven lever");
        let frame = read_length(fields, "frame", "Distance of the fixed pivots");
        let branch = read_branch(fields, "`+`: open, `-`: crossed.");
        let phase = read_phase(fields);
        Some(PositionSpec::FourBar {
            crank: crank?,
            coupler: coupler?,
            rocker: rocker?,
            frame: frame?,
            branch: branch?,
            phase: phase?,
        })
    })
}

pub(super) fn read_slotted_link(slot: Slot<'_>, output: Measures) -> Option<PositionSpec> {
    slot.record(|fields| {
        let crank = read_length(fields, "crank", "Length of the crank");
        let frame = fields.need("frame", "Distance of the fixed pivots", |slot| {
            slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE)
        });
        let doc = "What is driven: the crank by its angle, or the block by its distance from the pivot of the slotted link.";
        let driver = fields.or("driver", doc, json!("crank"), |slot| {
            slot.choice(&[
                ("crank", SlottedDriver::Crank),
                ("block", SlottedDriver::Block),
            ])
        });
        let outputs = [
            ("link", SlottedOutput::Link),
            ("crank", SlottedOutput::Crank),
            ("block", SlottedOutput::Block),
        ];
        let doc = "U: the angle of the slotted link or of the crank, or the distance of the block; default by the object: what turns follows the link, what slides the block.";
        let chosen = fields.maybe("output", doc, |slot| slot.choice(&outputs));
        let doc = "When the block drives: the crank turns counterclockwise (`+`) or clockwise (`-`) as the block moves away from the pivot of the slotted link.";
        let branch = read_branch(fields, doc);
        let input = match driver {
            Some(SlottedDriver::Crank) => Measures(Some(Turning)),
            Some(SlottedDriver::Block) => Measures(Some(Sliding)),
            None => Measures(None),
        };
        let doc = "Added to the driver's displacement";
        let phase = fields.or("phase", doc, json!(0.0), read_quantity(input.displacement()));
        let usual = match output.0 {
            Some(Sliding) => 2,
            _ => 0,
        };
        let chosen = chosen?;
        if chosen.is_none() {
            fields.fill_in("output", json!(outputs[usual].0));
        }
        Some(PositionSpec::SlottedLink(SlottedLinkSpec {
            crank: crank?,
            frame: frame?,
            driver: driver?,
            output: chosen.unwrap_or(outputs[usual].1),
            branch: branch?,
            phase: phase?,
        }))
    })
}
