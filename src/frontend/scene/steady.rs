//! The `steady` block.

use super::SteadySpec;
use super::objects::ObjectTable;
use crate::dynamics::steady::{MOST_TURNS, Mean};
use crate::frontend::read::{Bounds, Slot, did_you_mean, quoted_list};
use crate::units::quantities as q;
use serde_json::json;

/// Most periods of the drive in a period of the motion.
const MOST_PERIODS: u64 = 64;

/// Reads `steady`.
pub(super) fn read(slot: Slot<'_>, known: &ObjectTable) -> Option<SteadySpec> {
    slot.record(|fields| {
        let drive = fields.maybe(
            "drive",
            "The drive whose motion is wanted; not needed if there is one drive.",
            |slot| read_drive(slot, known),
        );
        let mean_speed = fields.maybe(
            "mean_speed",
            "Required mean speed of the drive. Default: the speed of a prescribed drive; with \
             moments that depend on speed only of elastic objects, with `balance`",
            |slot| slot.quantity(q::ANGULAR_SPEED, Bounds::POSITIVE),
        );
        let means = Mean::ALL.map(|mean| (mean.name(), mean));
        let mean = fields.or(
            "mean",
            "Kind of mean: over `time`, over the `angle`, or `midrange`, midway between the \
             extremes.",
            json!("time"),
            |slot| slot.choice(&means),
        );
        let cycle = fields.or(
            "cycle",
            "Angle of the drive after which the machine repeats, or a part of it: ratios may ask for more turns",
            json!(std::f64::consts::TAU),
            |slot| slot.quantity(q::ANGLE, Bounds::up_to(MOST_TURNS * std::f64::consts::TAU)),
        );
        let balance = fields.or(
            "balance",
            "True: a constant moment on the drive makes the work of a cycle zero.",
            json!(false),
            |slot| slot.flag(),
        );
        let fluctuation = fields.maybe(
            "fluctuation",
            "Required coefficient of fluctuation (ω_max − ω_min)/ω_av: sizes a flywheel",
            |slot| slot.number(Bounds::between(1e-6, 1.99)),
        );
        let tolerance = fields.or(
            "tolerance",
            "How far the mean speed may be off, relative",
            json!(1e-12),
            |slot| slot.number(Bounds::between(1e-15, 0.1)),
        );
        let periods = fields.or(
            "periods",
            "Elastic scenes: turns of the drive after which the motion may repeat, at most.",
            json!(1),
            |slot| slot.count(1..=MOST_PERIODS),
        );
        Some(SteadySpec {
            drive: drive?,
            mean_speed: mean_speed?,
            mean: mean?,
            cycle: cycle?,
            balance: balance?,
            fluctuation: fluctuation?,
            tolerance: tolerance?,
            periods: periods? as usize,
        })
    })
}

/// The id of one of the scene's objects.
fn read_drive(mut slot: Slot<'_>, known: &ObjectTable) -> Option<String> {
    let id = slot.read_in_place(|slot| slot.text())?;
    if known.objects.contains_key(&id) {
        return Some(id);
    }
    let ids = || known.objects.keys().map(String::as_str);
    let hint = did_you_mean(&id, ids())
        .unwrap_or_else(|| format!("the objects are {}", quoted_list(ids().take(20), "and")));
    let fault = slot.refuse("unknown-object", format!("unknown object `{id}`"));
    fault.hints.push(hint);
    None
}
