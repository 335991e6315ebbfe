//! Plans of motion in scenes.

use super::law::read_composed_law;
use super::measures::Measures;
use super::measures::PositionMeasures;
use crate::dynamics::model::Coordinate;
use crate::fault::Fault;
use crate::frontend::read::{Bounds, Fields, QuantityChoice, Slot, Value};
use crate::kinematics::motion::cycle::{MOST_STATIONS, Motion, Station, USUAL_ORDER};
use crate::kinematics::motion::{Cycle, CycleSpec, LawName, LawSpec};
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::TAU;

/// Quantities of a plan's two axes.
#[derive(Clone, Copy, Debug)]
struct Axes {
    argument: QuantityChoice,
    displacement: QuantityChoice,
    speed: QuantityChoice,
    acceleration: QuantityChoice,
    /// Period when none is given.
    period: Option<f64>,
}

/// Reads a plan of motion over the displacement of a driver.
pub(super) fn of_position(slot: Slot<'_>, ends: PositionMeasures) -> Option<CycleSpec> {
    let axes = Axes {
        argument: ends.driver.displacement(),
        displacement: ends.output.displacement(),
        speed: ends.output.per(ends.driver),
        acceleration: ends.output.coefficient(ends.driver, 2),
        period: (ends.driver.0 != Some(Coordinate::Sliding)).then_some(TAU),
    };
    let doc = "Length of the cycle; default one turn of a driver that turns, else once through";
    read(slot, axes, doc)
}

/// Reads the plan of a drive's motion over time.
pub(super) fn of_drive(slot: Slot<'_>, own: Measures) -> Option<CycleSpec> {
    let axes = Axes {
        argument: q::TIME.into(),
        displacement: own.displacement(),
        speed: own.speed(),
        acceleration: own.acceleration(),
        period: None,
    };
    read(slot, axes, "Duration of the cycle; default: once through")
}

fn read(mut slot: Slot<'_>, axes: Axes, period_doc: &str) -> Option<CycleSpec> {
    let spec = slot.read_in_place(|slot| {
        slot.record(|fields| {
            let doc = "Stations of the plan, ascending. The last one may close the period.";
            let stations = fields.need("stations", doc, |slot| {
                slot.list(2..=MOST_STATIONS, |slot| read_station(slot, axes))
            });
            let period = fields.maybe("period", period_doc, |slot| {
                slot.quantity(axes.argument, Bounds::POSITIVE)
            });
            let any = |wanted| move |slot: Slot<'_>| slot.quantity(wanted, Bounds::ANY);
            let doc = "Displacement gained in every cycle: the pitch of an indexing motion";
            let advance = fields.or("advance", doc, json!(0.0), any(axes.displacement));
            let doc = "Added to the driver's displacement (or to the time)";
            let phase = fields.or("phase", doc, json!(0.0), any(axes.argument));
            let given = period?;
            if let (None, Some(period)) = (given, axes.period) {
                fields.fill_in("period", json!(period));
            }
            Some(CycleSpec {
                stations: stations?,
                period: given.or(axes.period),
                advance: advance?,
                phase: phase?,
            })
        })
    })?;
    match Cycle::new(&spec) {
        Ok(_) => Some(spec),
        Err(faults) => {
            faults
                .iter()
                .for_each(|fault| refuse_plan(&mut slot, fault));
            None
        }
    }
}

/// Notes a fault of the plan at the station concerned, if there is one.
fn refuse_plan(slot: &mut Slot<'_>, fault: &Fault) {
    let number = fault.path.strip_prefix("stations[").and_then(|rest| {
        let (number, _) = rest.split_once(']')?;
        number.parse::<usize>().ok()
    });
    let message = match number {
        Some(number) => format!("station {}: {}", number + 1, fault.message),
        None => fault.message.clone(),
    };
    let place = number.and_then(|number| {
        let stations = &slot.node()?.member("stations")?.value;
        match &stations.value {
            Value::List(items) => items.get(number).map(|item| item.place.clone()),
            _ => None,
        }
    });
    let refused = slot.refuse("contradiction", message);
    if let (Some(place), Some(number)) = (place, number) {
        refused.place = Some(place);
        refused.path = format!("{}.stations[{number}]", refused.path);
    }
    if !fault.hint.is_empty() {
        refused.hints.push(fault.hint.clone());
    }
}

fn read_station(slot: Slot<'_>, axes: Axes) -> Option<Station> {
    slot.record(|fields| {
        let at = fields.need("at", "Displacement of the driver, or time", |slot| {
            slot.quantity(axes.argument, Bounds::ANY)
        });
        let displacement = fields.need("displacement", "Displacement there", |slot| {
            slot.quantity(axes.displacement, Bounds::ANY)
        });
        let doc = "First derivative there, taken by smooth motions that meet here";
        let speed = read_prescribed(fields, "speed", doc, axes.speed);
        let doc = "Second derivative there, taken by smooth motions that meet here";
        let acceleration = read_prescribed(fields, "acceleration", doc, axes.acceleration);
        let order = fields.or(
            "match",
            "Order of derivatives up to which smooth motions match their neighbour here.",
            json!(USUAL_ORDER),
            |slot| slot.count(1..=3),
        );
        let doc = "Motion from here to the next station: `dwell`, `uniform`, `smooth` (the \
                   polynomial that matches its neighbours), or a law from rest to rest.";
        let motion = fields.or("motion", doc, json!("dwell"), read_motion);
        Some(Station {
            at: at?,
            displacement: displacement?,
            speed: speed?,
            acceleration: acceleration?,
            order: order? as usize,
            motion: motion?,
        })
    })
}

fn read_prescribed(
    fields: &mut Fields<'_>,
    name: &'static str,
    doc: &str,
    wanted: QuantityChoice,
) -> Option<Option<f64>> {
    fields.maybe(name, doc, |slot| slot.quantity(wanted, Bounds::ANY))
}

fn read_motion(slot: Slot<'_>) -> Option<Motion> {
    slot.defined("planned_motion", |slot| {
        let mut names = vec![
            ("dwell", Motion::Dwell),
            ("uniform", Motion::Uniform),
            ("smooth", Motion::Smooth),
        ];
        let laws = LawName::ALL.map(|name| (name.name(), Motion::Law(LawSpec::Named(name))));
        names.extend(laws);
        slot.object_or(
            |slot| read_composed_law(slot).map(Motion::Law),
            |slot| slot.choice(&names),
        )
    })
}
