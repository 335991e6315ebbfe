//! Some branches propagated exactly, the rest integrated, against an
//! integration of everything.

use super::mixed;
use crate::dynamics::integrate::{Method, Stop};
use crate::dynamics::system::System;
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::studies::run::{RunResult, run};
use crate::studies::{Control, RunSettings};
use serde_json::{Value, json};
use std::sync::atomic::AtomicBool;

const DURATION: f64 = 0.3;

/// A lever that lifts off, with a rigid tip on it; a damper of dry friction
/// behind a law in pieces, with something elastic on it.
fn objects() -> Vec<(&'static str, Value)> {
    let lever = json!({ "kind": "rocker", "input": "shaft", "masses": 2, "inertia": 0.1,
        "stiffness": 1e7, "damping_capacity": 0.4, "pair": { "closure": "force" },
        "position": { "sine": { "amplitude": "90 deg" } },
        "loads": { "closing": { "mass": "last", "constant": -600 } } });
    let tip = json!({ "kind": "shaft", "input": "lever", "masses": 0, "inertia": 0.002,
        "position": { "ratio": 2 } });
    let brake = json!({ "kind": "rocker", "input": "shaft", "inertia": 0.2, "stiffness": 3e5,
        "masses": 2, "damping_capacity": 0.3,
        "position": { "cam": { "lift": "30 deg", "rise": "100 deg", "dwell": "40 deg",
            "return": "100 deg", "law": "3-4-5" } },
        "loads": { "shoe": { "friction": { "force": 40, "width": 0.5 } } } });
    let hand = json!({ "kind": "shaft", "input": "brake", "inertia": 0.01, "stiffness": 4e4,
        "damping_capacity": 0.3, "masses": 1, "pair": { "closure": "form", "gap": 0.002 },
        "position": { "ratio": 1.5 } });
    let shaft = json!({ "kind": "drive", "motion": { "speed": "10 rev/s" } });
    vec![
        ("shaft", shaft),
        ("lever", lever),
        ("tip", tip),
        ("brake", brake),
        ("hand", hand),
    ]
}

fn scene(objects: &[(&str, Value)]) -> Value {
    let objects: serde_json::Map<String, Value> = objects
        .iter()
        .map(|(id, object)| ((*id).to_owned(), object.clone()))
        .collect();
    json!({ "dam": 1, "name": "Mixed", "objects": objects,
        "run": { "duration": DURATION, "samples": 300, "start": "on_law", "tolerance": 1e-10 } })
}

/// With objects in the order of the list (a map of serde_json sorts).
fn text(objects: &[(&str, Value)]) -> String {
    let all: Vec<String> = objects
        .iter()
        .map(|(id, object)| format!("\"{id}\": {object}"))
        .collect();
    let whole = scene(&[]).to_string();
    whole.replace(
        "\"objects\":{}",
        &format!("\"objects\":{{{}}}", all.join(",")),
    )
}

fn prepare(text: &str) -> (System, RunSettings) {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none());
    let reading = reading.unwrap_or_else(|faults| panic!("{faults}"));
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    (system, RunSettings::of(&reading.scene).unwrap())
}

fn solve(system: &System, settings: &RunSettings, method: Option<Method>) -> RunResult {
    let settings = RunSettings {
        method,
        ..settings.clone()
    };
    run(system, &settings, &Control::default(), &mut []).unwrap()
}

#[test]
fn what_goes_which_way_is_told_apart() {
    let (system, settings) = prepare(&text(&objects()));
    let found = mixed(&system).unwrap();
    let id = |object: &usize| system.model().objects[*object].id.as_str();
    let held: Vec<&str> = found
        .parts
        .trees
        .iter()
        .flat_map(|part| &part.objects)
        .map(id)
        .collect();
    assert_eq!(held, ["lever"]);
    let rest: Vec<&str> = found
        .rest
        .system
        .model()
        .objects
        .iter()
        .map(|part| part.id.as_str())
        .collect();
    assert_eq!(rest, ["brake", "hand", "shaft"]);
    let result = solve(&system, &settings, None);
    let run = &result.figures.run;
    assert!(run.method.starts_with("exact + "), "{}", run.method);
    for word in [
        "exact propagation of lever",
        "for brake, hand",
        "its load `shoe` is friction",
    ] {
        assert!(run.why.contains(word), "{}", run.why);
    }
}

#[test]
fn a_mixed_run_is_the_run_of_a_general_method() {
    let (system, settings) = prepare(&text(&objects()));
    let result = solve(&system, &settings, None);
    assert!(
        result.is_complete() && result.is_trusted(),
        "{:?}",
        result.warnings
    );
    let fine = RunSettings {
        tolerance: 1e-13,
        ..settings.clone()
    };
    let general = solve(&system, &fine, Some(Method::Dop853));
    assert!(general.is_complete());
    assert_eq!(result.record.times, general.record.times);
    assert_eq!(result.record.switches.len(), general.record.switches.len());
    assert!(result.record.switches.len() > 50);
    for (own, other) in result.record.switches.iter().zip(&general.record.switches) {
        assert_eq!(own.object, other.object);
        approx::assert_abs_diff_eq!(own.time, other.time, epsilon = 1e-8 * DURATION);
    }
    for (own, other) in result.record.columns.iter().zip(&general.record.columns) {
        if own.quantity != crate::dynamics::record::Quantity::Delta {
            continue;
        }
        let size = other.values.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        for (a, b) in own.values.iter().zip(&other.values) {
            assert!((a - b).abs() <= 1e-8 * size, "{}: {a} for {b}", own.object);
        }
    }
    for (id, own) in &result.figures.objects {
        let other = &general.figures.objects[id];
        for (a, b) in [
            (own.delta_max, other.delta_max),
            (own.delta_min, other.delta_min),
            (own.sigma, other.sigma),
            (own.peak_speed, other.peak_speed),
            (own.peak_reaction, other.peak_reaction),
        ] {
            approx::assert_relative_eq!(a, b, max_relative = 1e-7, epsilon = 1e-12);
        }
    }
    // One audit of everything.
    assert!(
        result.figures.run.energy_error < 1e-9,
        "{:e}",
        result.figures.run.energy_error
    );
    let switches = result.outcome.statistics.switches;
    assert_eq!(switches, general.outcome.statistics.switches);
}

#[test]
fn the_order_of_objects_changes_nothing() {
    let mut all = objects();
    let document = |text: &str| {
        let (system, settings) = prepare(text);
        let result = solve(&system, &settings, None);
        let columns = format!("{:?} {:?}", result.record.columns, result.record.switches);
        serde_json::to_string(&result.figures.objects).unwrap() + &columns
    };
    let wanted = document(&text(&all));
    all.reverse();
    assert_eq!(document(&text(&all)), wanted);
    all.swap(0, 3);
    assert_eq!(document(&text(&all)), wanted);
}

#[test]
fn a_motor_beside_a_drive_is_a_rest_too() {
    let mut all = objects();
    let motor = json!({ "kind": "drive", "motor": { "inertia": 2, "speed": 30,
        "torque": { "linear": { "stall_torque": 50, "no_load_speed": 40 } } } });
    let wheel = json!({ "kind": "shaft", "input": "motor", "inertia": 0.5, "stiffness": 2e4,
        "damping_capacity": 0.2, "masses": 1, "position": { "ratio": 1 } });
    all.truncate(3);
    all.extend([("motor", motor), ("wheel", wheel)]);
    let (system, settings) = prepare(&text(&all));
    let result = solve(&system, &settings, None);
    assert!(
        result.figures.run.method.starts_with("exact + "),
        "{}",
        result.figures.run.why
    );
    assert!(
        result.is_complete() && result.is_trusted(),
        "{:?}",
        result.warnings
    );
    let fine = RunSettings {
        tolerance: 1e-13,
        ..settings.clone()
    };
    let general = solve(&system, &fine, Some(Method::Dop853));
    for (id, own) in &result.figures.objects {
        let other = &general.figures.objects[id];
        approx::assert_relative_eq!(own.delta_max, other.delta_max, max_relative = 1e-7);
        let (a, b) = (own.end.displacement, other.end.displacement);
        approx::assert_relative_eq!(a, b, max_relative = 1e-7);
    }
}

#[test]
fn limits_and_interrupts_reach_both() {
    let (system, settings) = prepare(&text(&objects()));
    let told = AtomicBool::new(true);
    let control = Control::interrupted_by(&told);
    let result = run(&system, &settings, &control, &mut []).unwrap();
    assert_eq!(result.outcome.stop, Stop::Interrupted);
    let few = RunSettings {
        max_switches: 10,
        ..settings
    };
    let result = run(&system, &few, &Control::default(), &mut []).unwrap();
    assert_eq!(result.outcome.stop, Stop::TooManySwitches { bound: 10 });
    assert!(result.outcome.time < DURATION);
}

#[test]
fn whole_systems_and_dead_positions_are_not_mixed() {
    let mut all = objects();
    all.truncate(3);
    let (system, _) = prepare(&text(&all));
    assert!(mixed(&system).is_none(), "all of it is exact");
    let (system, _) = prepare(&text(&objects()[..1]));
    assert!(mixed(&system).is_none(), "nothing is elastic");
}
