//! Machines side by side in one scene, and motions that are steep for a moment: each moves as
//! it does alone, and steps are as short as what moves asks for.

use approx::assert_relative_eq;
use dam::prelude::*;
use dam::studies::run::RunResult;
use serde_json::{Value, json};

fn run(objects: &Value, duration: f64) -> RunResult {
    let scene = json!({ "dam": 1, "name": "Side by side", "objects": objects,
        "run": { "duration": duration, "tolerance": 1e-9 } });
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    scene.run().expect("a run")
}

fn both(one: &Value, other: &Value) -> Value {
    let mut all = one.clone();
    let own = all.as_object_mut().expect("objects");
    own.extend(other.as_object().expect("objects").clone());
    all
}

fn figure(result: &RunResult, name: &str) -> f64 {
    let found = result.figures.value(name);
    found.unwrap_or_else(|_| panic!("{name}"))
}

/// What `dam` propagates exactly.
fn shaft() -> Value {
    json!({ "turning": { "kind": "drive", "motion": { "speed": 20 } },
        "shaft": { "kind": "rocker", "input": "turning", "inertia": 0.5, "stiffness": 4000,
            "damping": 3, "masses": 2, "position": { "sine": { "amplitude": 0.3 } } } })
}

/// A rotor under loads that switch with its angle and its speed.
fn switching() -> Value {
    json!({ "motor": { "kind": "drive",
        "motor": { "inertia": 0.3, "speed": 5, "torque": { "constant": 2 } },
        "loads": { "past": { "expression": "phi > 1 ? -3 : 0.5" },
            "fast": { "expression": "phi_dot > 6 ? -1 : 0" } } } })
}

/// A rigid crank mechanism at constant speed.
fn rigid() -> Value {
    json!({ "crank": { "kind": "drive", "motion": { "speed": 30 } },
        "ram": { "kind": "slider", "input": "crank", "inertia": 8, "masses": 0,
            "position": { "slider_crank": { "crank": 0.1, "rod": 0.35 } } } })
}

/// What stands still.
fn at_rest() -> Value {
    json!({ "still": { "kind": "drive",
        "motor": { "inertia": 0.5, "speed": 0, "torque": { "constant": 0 } },
        "loads": { "w": { "expression": "-0.2*phi^3" } } } })
}

#[test]
fn exact_propagation_goes_on_beside_loads_that_switch() {
    let alone = [run(&shaft(), 3.0), run(&switching(), 3.0)];
    let beside = run(&both(&shaft(), &switching()), 3.0);
    assert!(beside.is_trusted());
    for (alone, names) in alone.iter().zip([
        [
            "shaft.final.displacement",
            "shaft.final.speed",
            "shaft.peak_reaction",
        ],
        [
            "motor.final.displacement",
            "motor.final.speed",
            "motor.peak_speed",
        ],
    ]) {
        for name in names {
            let (own, other) = (figure(alone, name), figure(&beside, name));
            assert_relative_eq!(own, other, max_relative = 1e-7);
        }
    }
}

#[test]
fn a_rigid_mechanism_keeps_its_peaks_and_its_energies_beside_what_is_at_rest() {
    let alone = run(&rigid(), 4.0);
    let beside = run(&both(&rigid(), &at_rest()), 4.0);
    assert!(alone.is_trusted() && beside.is_trusted());
    for name in [
        "ram.peak_speed",
        "ram.peak_acceleration",
        "ram.peak_reaction",
    ] {
        let (own, other) = (figure(&alone, name), figure(&beside, name));
        assert_relative_eq!(own, other, max_relative = 1e-7);
    }
    let balance = beside.figures.run.energy_error;
    assert!(balance < 1e-9, "{balance}");
}

#[test]
fn steps_grow_again_after_a_steep_start() {
    let steep = json!({ "a": { "kind": "drive",
        "motion": { "expression": "0.1*sqrt(t + 1e-12)" } } });
    let slider = json!({ "b": { "kind": "slider", "input": "a", "inertia": 0, "masses": 0,
        "position": { "cam": { "lift": 0.02, "rise": "3 deg", "dwell": "40 deg",
            "return": "120 deg", "law": "cycloidal" } } } });
    for objects in [
        both(&steep, &slider),
        both(&both(&steep, &slider), &at_rest()),
    ] {
        let found = run(&objects, 1.0);
        let steps = found.figures.run.steps;
        assert!(steps < 8000, "{steps}");
        assert_relative_eq!(
            figure(&found, "b.final.displacement"),
            0.02,
            max_relative = 1e-9
        );
    }
}
