//! A step of the own stiff methods costs in proportion to the number of masses.

use dam::integrate::Method;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;

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
