//! Runs that end just after a switch: the last step is then so short that the
//! rounding of a great angle would swallow its speed.

use dam::integrate::Method;
use dam::lower::lower;
use dam::record::Quantity;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde_json::json;

/// A rocker that lifts off, behind a motor after some 1600 turns (for exact
/// propagation: a prescribed drive).
fn solve(method: Method, duration: f64) -> RunResult {
    let motion = match method {
        Method::Exact => json!({ "kind": "drive", "motion": { "angle": 1e4, "speed": 60 } }),
        _ => json!({ "kind": "drive", "motor": {
            "inertia": 20, "angle": 1e4, "speed": 60, "torque": { "constant": 5 } } }),
    };
    let text = json!({
        "dam": 1, "name": "test",
        "objects": {
            "drive": motion,
            "rocker": { "kind": "rocker", "input": "drive",
                "position": { "sine": { "amplitude": "90 deg" } },
                "inertia": 0.1, "stiffness": 1e7, "damping_capacity": 0.4, "masses": 1,
                "pair": { "closure": "force" },
                "loads": { "closing": { "mass": "last", "constant": -400 } } }
        },
        "run": { "duration": duration, "samples": 10, "switch_rows": true }
    });
    let document = Document::parse("scene.json", text.to_string().as_bytes()).expect("a document");
    let reading = document
        .scene(&BuiltIn, &Overrides::none())
        .expect("a scene");
    let system = System::new(lower(&reading.scene).expect("a model")).expect("a system");
    let settings = RunSettings {
        method: Some(method),
        tolerance: 1e-9,
        ..RunSettings::of(&reading.scene).expect("settings")
    };
    run(&system, &settings, &Control::default(), &mut []).expect("runs")
}

/// A run that ends about a `rest` after a switch, and what the rest is. The end
/// moves the switch by what the method errs.
fn ended(method: Method, rest: f64) -> Option<(RunResult, f64)> {
    let mut end = 0.1;
    for _ in 0..12 {
        let found = solve(method, end);
        end = match found.record.switches.last().map(|last| last.time) {
            None => end + rest,
            Some(time) if (0.5 * rest..2.0 * rest).contains(&(end - time)) => {
                return Some((found, end - time));
            }
            Some(time) => time + rest,
        };
    }
    None
}

/// Speed and acceleration of an object in a row counted from the end.
fn late(result: &RunResult, object: &str, before: usize) -> [f64; 2] {
    [Quantity::Speed, Quantity::Acceleration].map(|quantity| {
        let column = result.record.column(object, quantity);
        let values = &column.expect("a column").values;
        values[values.len() - 1 - before]
    })
}

#[test]
fn runs_that_end_just_after_a_switch_are_trusted_and_their_speeds_right() {
    for method in [
        Method::Taylor,
        Method::Dop853,
        Method::Radau,
        Method::Rodas5p,
        Method::Exact,
    ] {
        for rest in [1e-12, 3e-11, 1e-9, 3e-8, 1e-7, 1e-5] {
            let Some((found, left)) = ended(method, rest) else {
                // The method errs by more than the rest: nothing to be seen here.
                assert!(rest < 1e-10, "{method} {rest:e}");
                continue;
            };
            let label = format!("{method}, {left:e} s after a switch");
            assert!(found.is_trusted(), "{label}: {:?}", found.warnings);
            assert!(
                found.audit.error() < 1e-7,
                "{label}: {:e}",
                found.audit.error()
            );
            // Last row: the end; before it: just after the switch.
            for object in ["drive", "rocker"] {
                let [speed, _] = late(&found, object, 0);
                let [before, acceleration] = late(&found, object, 1);
                let expected = before + acceleration * left;
                let bend = 2e4f64.powi(2) * left * left;
                assert!(
                    (speed - expected).abs() <= (1e-9 + bend) * (60.0 + before.abs()),
                    "{label}: {object} at {speed} rad/s, not {expected}"
                );
            }
        }
    }
}
