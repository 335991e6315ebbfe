//! The `run` block.

use super::accuracy;
use super::objects::ObjectTable;
use super::{RunSpec, StartSpec};
use crate::dynamics::integrate::Method;
use crate::dynamics::model::{CONDITION_NAMES, Condition, UNTIL};
use crate::frontend::object::KnownObject;
use crate::frontend::object::{Measures, read_condition};
use crate::frontend::read::{Bounds, Fields, Slot, did_you_mean, quoted_list};
use crate::units::quantities as q;
use serde_json::json;
use std::collections::BTreeMap;

/// Most sample intervals.
const MOST_SAMPLES: u64 = 1_000_000;

const ACCURACY: &str = "Accuracy wanted of the results, the error of the model included: a share \
                        of each, \"1 %\", or by the address of a result a share or a quantity. \
                        Objects of `masses`: \"auto\" are modelled as finely as this needs.";

const ENDS: &str = "Condition that ends the run before `duration`, at the first time at which it \
    holds: { \"of\": \"rocker\", \"condition\": \"phi > 0.3\" }. The motion is found up to `duration` \
    first.";

const FIRST_TIMES: &str = "Conditions by names of their own: the first time at which each holds is \
    the result `run.first_times.NAME`.";

/// Reads `run`.
pub(super) fn read(slot: Slot<'_>, known: &ObjectTable) -> Option<RunSpec> {
    slot.record(|fields| {
        let seconds = |slot: Slot<'_>| slot.quantity(q::TIME, Bounds::POSITIVE);
        let duration = fields.need("duration", "Simulated time", seconds);
        let start = fields.or(
            "start",
            "State at t = 0: `kinetostatic` (quiet; of a law that repeats, as before t = 0), `static`, `on_law`, or explicit states by object.",
            json!("kinetostatic"),
            |slot| read_start(slot, known),
        );
        let method = fields.or("method", "Method of integration.", json!("auto"), read_method);
        let tolerance_given = fields.has("tolerance");
        let tolerance = fields.or(
            "tolerance",
            "Error wanted in each object's δ, relative to its scale. Without it, and with the \
             method `auto` and results that must keep an accuracy (`accuracy`, `masses`: \
             \"auto\"), it is a tenth of that accuracy.",
            json!(1e-6),
            |slot| slot.number(Bounds::between(1e-14, 1e-1)),
        );
        let step = fields.maybe(
            "step",
            "Step of `rk4`; greatest step of the other methods",
            seconds,
        );
        let samples = fields.or(
            "samples",
            "Number of equal sample intervals.",
            json!(1000),
            |slot| slot.count(1..=MOST_SAMPLES),
        );
        let switch_rows = fields.or(
            "switch_rows",
            "True: two rows (before, after) at each event.",
            json!(false),
            |slot| slot.flag(),
        );
        let record = fields.maybe(
            "record",
            "Columns of the record: `objects`, six of each object (default), or `all`, displacement and speed of every mass and the force of every link of elastic objects too",
            |slot| slot.choice(&[("objects", false), ("all", true)]),
        );
        let window = fields.maybe(
            "window",
            "[from, to]: window of the steady results. Default: the last whole cycle of the drive.",
            |slot| {
                let time = |slot: Slot<'_>| slot.quantity(q::TIME, Bounds::NOT_NEGATIVE);
                slot.pair(time, time)
            },
        );
        let max_switches = fields.or(
            "max_switches",
            "Greatest number of events; the run ends at the next.",
            json!(1_000_000),
            |slot| slot.count(1..=1_000_000_000),
        );
        let until = fields.maybe("until", ENDS, |slot| read_one_condition(slot, UNTIL, known));
        let first_times = fields.maybe("first_times", FIRST_TIMES, |slot| {
            slot.names(|name, mut slot| {
                if name == UNTIL {
                    let message = format!("`{UNTIL}` is the name of the condition that ends the run");
                    let place = slot.name_place();
                    let fault = slot.refuse("bad-name", message);
                    fault.place = Some(place);
                    fault.hints.push("choose another name".to_owned());
                    return None;
                }
                read_one_condition(slot, name, known)
            })
        });
        let accuracy = fields.maybe("accuracy", ACCURACY, |slot| accuracy::read(slot, known));
        let run = RunSpec {
            accuracy: accuracy?,
            duration: duration?,
            start: start?,
            method: method?,
            tolerance: tolerance?,
            tolerance_given,
            step: step?,
            samples: samples? as usize,
            switch_rows: switch_rows?,
            masses: record?.unwrap_or(false),
            window: window?,
            max_switches: max_switches?,
            conditions: until?.into_iter().chain(first_times?.unwrap_or_default()).collect(),
        };
        check(fields, &run).then_some(run)
    })
}

/// A condition on the motion of an object or of an output.
fn read_one_condition(slot: Slot<'_>, name: &str, known: &ObjectTable) -> Option<Condition> {
    slot.record(|fields| {
        let doc = "Object, output or stop whose motion the condition is about: `rocker`, `press.ram`.";
        let object = fields.need("of", doc, |mut slot| {
            let id = slot.read_in_place(|slot| slot.text())?;
            let ids = || known.objects.keys().chain(known.stops.keys()).map(String::as_str);
            if ids().any(|known| known == id) {
                return Some(id);
            }
            let fault = slot.refuse("unknown-object", format!("unknown object `{id}`"));
            let all = || format!("the objects are {}", quoted_list(ids().take(20), "and"));
            fault.hints.push(did_you_mean(&id, ids()).unwrap_or_else(all));
            None
        });
        let doc = "Comparisons over t, phi, phi_dot, acceleration, delta, reaction, contact_force and \
            clearance of the object, in SI units: \"phi > 0.3 && t > 1\".";
        let expression = fields.need("condition", doc, |slot| read_condition(slot, &CONDITION_NAMES));
        Some(Condition { name: name.to_owned(), object: object?, expression: expression? })
    })
}

fn read_method(slot: Slot<'_>) -> Option<String> {
    let exact = Method::Exact.name();
    let mut names = vec![("auto", "auto"), (exact, exact)];
    names.extend(Method::ALL.map(|method| (method.name(), method.name())));
    slot.choice(&names).map(str::to_owned)
}

fn check(fields: &mut Fields<'_>, run: &RunSpec) -> bool {
    let before = fields.faults();
    if run.duration < f64::MIN_POSITIVE {
        let message = format!("`duration` ({:?} s) is too short", run.duration);
        let fault = fields.refuse("duration", "out-of-range", message);
        let least = "times below 2.3e-308 s have no number of full precision".to_owned();
        fault.hints.push(least);
    }
    if run.method == Method::Rk4.name() && run.step.is_none() {
        let fault = fields.refuse("method", "missing-property", "`rk4` needs a `step`");
        fault
            .hints
            .push(r#"add "step": "10 µs", or choose another method"#.to_owned());
    }
    if let Some(step) = run.step
        && step > run.duration
    {
        let message = format!(
            "`step` ({step} s) is longer than `duration` ({} s)",
            run.duration
        );
        fields.refuse("step", "out-of-range", message);
    }
    if let Some((from, to)) = run.window
        && !(from < to && to <= run.duration * (1.0 + 1e-12))
    {
        let message = format!(
            "the window [{from}, {to}] does not lie within the run [0, {}]",
            run.duration
        );
        fields.refuse("window", "out-of-range", message);
    }
    fields.faults() == before
}

fn read_start(slot: Slot<'_>, known: &ObjectTable) -> Option<StartSpec> {
    let names = [
        ("kinetostatic", StartSpec::Kinetostatic),
        ("static", StartSpec::Static),
        ("on_law", StartSpec::OnLaw),
    ];
    slot.object_or(
        |slot| {
            let states = slot.map(|id, slot| read_state(slot, id, known))?;
            Some(StartSpec::Explicit(states))
        },
        |slot| slot.choice(&names),
    )
}

/// Displacements and speeds of all masses of one object.
fn read_state(mut slot: Slot<'_>, id: &str, known: &ObjectTable) -> Option<(Vec<f64>, Vec<f64>)> {
    let object = match known.objects.get(id) {
        Some(object) => *object,
        None if slot.describing() => KnownObject::default(),
        None => {
            unknown(&mut slot, id, &known.objects);
            return None;
        }
    };
    if object.masses == Some(0) {
        let place = slot.name_place();
        let message = format!("`{id}` has no state of its own");
        let fault = slot.refuse("contradiction", message);
        fault.place = Some(place);
        fault
            .hints
            .push("rigid objects and prescribed drives follow from the others".to_owned());
        return None;
    }
    let measures = Measures(object.coordinate);
    let length = object
        .masses
        .map_or(1..=usize::MAX, |masses| masses..=masses);
    slot.record(|fields| {
        let displacement = fields.need("displacement", "Displacement of each mass", |slot| {
            slot.list(length.clone(), |slot| {
                slot.quantity(measures.displacement(), Bounds::ANY)
            })
        });
        let speed = fields.need("speed", "Speed of each mass", |slot| {
            slot.list(length, |slot| slot.quantity(measures.speed(), Bounds::ANY))
        });
        Some((displacement?, speed?))
    })
}

fn unknown(slot: &mut Slot<'_>, id: &str, objects: &BTreeMap<String, KnownObject>) {
    let ids = || objects.keys().map(String::as_str);
    let place = slot.name_place();
    let fault = slot.refuse("unknown-object", format!("unknown object `{id}`"));
    fault.place = Some(place);
    fault.hints.push(
        did_you_mean(id, ids())
            .unwrap_or_else(|| format!("the objects are {}", quoted_list(ids().take(20), "and"))),
    );
}
