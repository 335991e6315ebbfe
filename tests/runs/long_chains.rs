//! A step of the own stiff methods costs in proportion to the number of masses, a start of
//! many objects in some evaluations.

use dam::integrate::{Dynamics, Method};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde_json::json;
use std::time::{Duration, Instant};

/// Evaluations of the whole system in a step of the press with its crankshaft
/// in so many masses, behind a motor that it reacts upon.
fn evaluations_per_step(method: Method, masses: usize) -> f64 {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/press/punching.json");
    let bytes = std::fs::read(path).expect("a scenario");
    let document = Document::parse(path, &bytes).expect("JSON");
    let overrides = Overrides::new(vec![format!("crankshaft.masses={masses}")]);
    let reading = document.scene(&BuiltIn, &overrides).expect("a scene");
    let system = System::new(lower(&reading.scene).expect("a model")).expect("a system");
    let settings = RunSettings {
        method: Some(method),
        tolerance: 1e-4,
        duration: 0.02,
        samples: 10,
        window: None,
        ..RunSettings::of(&reading.scene).expect("settings")
    };
    let result = run(&system, &settings, &Control::default(), &mut []).expect("a start");
    assert!(result.is_complete(), "{:?}", result.outcome);
    let counts = result.outcome.statistics;
    counts.evaluations as f64 / (counts.steps + counts.rejected) as f64
}

/// Each evaluation goes once over the masses, and the linear systems do not fill
/// in (tested where they are solved): the number of evaluations is what might
/// have grown, with the columns of the Jacobian.
#[test]
fn a_hundred_times_the_masses_need_no_more_evaluations_in_a_step() {
    for method in [Method::Rodas5p, Method::Radau] {
        let [short, long] = [10, 1000].map(|masses| evaluations_per_step(method, masses));
        assert!(long < 1.3 * short, "{method}: {short} {long}");
    }
}

/// Undamped and in flight for 16 ms: a step of the search is then thousands of turns of the fastest mode.
#[test]
fn a_long_undamped_chain_is_followed_between_its_bounces() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/rocker/one_mass_undamped.json"
    );
    let deltas = [64, 128].map(|masses| {
        let bytes = std::fs::read(path).expect("a scenario");
        let document = Document::parse(path, &bytes).expect("JSON");
        let overrides = [
            format!("rocker.masses={masses}"),
            "run.duration=0.05".into(),
        ];
        let reading = document.scene(&BuiltIn, &Overrides::new(overrides.to_vec()));
        let reading = reading.expect("a scene");
        let system = System::new(lower(&reading.scene).expect("a model")).expect("a system");
        let settings = RunSettings {
            method: Some(Method::Exact),
            ..RunSettings::of(&reading.scene).expect("settings")
        };
        let result = run(&system, &settings, &Control::default(), &mut []).expect("a start");
        assert!(result.is_complete(), "{masses}: {:?}", result.outcome);
        result.figures.objects["rocker"].delta_max
    });
    // As they were when nothing limited how far the modes of a step are followed.
    assert!((deltas[0] - 7.518242e-3).abs() < 1e-9, "{deltas:?}");
    assert!((deltas[1] - 7.51643e-3).abs() < 1e-8, "{deltas:?}");
}

/// Levers on cams on one shaft.
fn levers(count: usize) -> System {
    let mut objects = json!({
        "motor": { "kind": "drive", "motion": { "speed": 60 } },
        "shaft": { "kind": "shaft", "input": "motor", "inertia": 0.1, "stiffness": 1e6 }
    });
    for index in 0..count {
        objects[format!("lever{index}")] = json!({
            "kind": "rocker", "input": "shaft", "inertia": 0.02, "stiffness": 2e4,
            "position": { "cam": { "lift": 0.2, "rise": "70 deg", "dwell": "10 deg",
                "return": "70 deg", "law": "4-5-6-7", "phase": format!("{} deg", 37 * index % 360) } }
        });
    }
    let scene = json!({ "dam": 1, "name": "many", "objects": objects, "run": { "duration": 1 } });
    let document = Document::parse("many", scene.to_string().as_bytes()).expect("JSON");
    let reading = document
        .scene(&BuiltIn, &Overrides::none())
        .expect("a scene");
    System::new(lower(&reading.scene).expect("a model")).expect("a system")
}

/// The least time of several.
fn least(mut work: impl FnMut()) -> Duration {
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed()
    };
    (0..7).map(time).min().expect("some")
}

/// (Not one evaluation for each of them, and more than once.)
#[test]
fn the_start_of_many_objects_takes_some_evaluations() {
    let system = levers(800);
    let initial = system.initial_state().expect("a start");
    let mut scratch = system.scratch();
    let mut dy = vec![0.0; initial.y.len()];
    let one = least(|| {
        for _ in 0..10 {
            system.derivatives(0.0, &initial.y, &initial.modes, &mut scratch, &mut dy);
        }
    }) / 10;
    let start = least(|| drop(system.initial_state()));
    assert!(
        start < 1500 * one,
        "{start:?} for the start, {one:?} for an evaluation"
    );
}
