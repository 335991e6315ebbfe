//! Every method gives the same motion, or says why it cannot.

use super::reference::slider_crank;
use super::support::{figure, read, run_of, scene_of};
use dam::lower::lower;
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;

const MOTOR: &str = r#""motor": { "kind": "drive", "motor": { "inertia": 0.05, "speed": 6, "torque": { "constant": 1 } } }"#;
const RUN: &str = r#""duration": 0.6, "tolerance": 1e-9, "start": "on_law""#;

#[test]
fn the_methods_agree() {
    let text = scene_of(&format!("{MOTOR}, {}", slider_crank(0.1)), RUN);
    let names = [
        "motor.final.displacement",
        "motor.final.speed",
        "m.friction_loss",
    ];
    let of = |method: &str| {
        let found = run_of(&text, &[&format!("run.method={method}")]);
        names.map(|name| figure(&found, name))
    };
    let wanted = of("dop853");
    for method in ["dopri5", "rodas5p", "radau"] {
        for (found, wanted) in of(method).iter().zip(wanted) {
            approx::assert_abs_diff_eq!(*found, wanted, epsilon = 2e-7 * (1.0 + wanted.abs()));
        }
    }
}

/// A wheel of 12 kg with an eccentric weight: its pin's reaction is smooth.
const WHEEL: &str = r#""m": { "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
    "gravity": { "acceleration": 9.81 }, "ground": { "O": [0, 0] },
    "links": { "wheel": { "mass": 12, "centre": [0.05, 0], "moment": 0.1 } },
    "pairs": { "O": { "revolute": ["ground.O", "wheel.origin"], "diameter": 0.05, "friction": 0.2 } } }"#;

#[test]
fn the_order_is_kept_through_changes_of_direction() {
    let motor = r#""motor": { "kind": "drive", "motor": { "inertia": 0.05, "speed": 6, "torque": { "constant": 0 } } }"#;
    let text = scene_of(
        &format!("{motor}, {WHEEL}"),
        r#""duration": 1.2, "tolerance": 1e-12, "start": "on_law""#,
    );
    let exact = run_of(&text, &["run.method=dop853"]);
    assert!(figure(&exact, "m.standstills") >= 2.0);
    let error = |step: f64| {
        let step = format!("run.step={step}");
        let scene = read(&text, &["run.method=rk4", &step]);
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let settings = RunSettings::of(&scene).expect("settings");
        let found = run(&system, &settings, &Control::default(), &mut []).expect("a run");
        let name = "motor.final.displacement";
        (figure(&found, name) - figure(&exact, name)).abs()
    };
    let errors = [0.04, 0.02, 0.01].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 3.0, "{errors:?}");
    }
}

#[test]
fn methods_that_cannot_say_so() {
    let text = scene_of(&format!("{MOTOR}, {}", slider_crank(0.1)), RUN);
    for method in ["taylor", "exact"] {
        let scene = read(&text, &[&format!("run.method={method}")]);
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let settings = RunSettings::of(&scene).expect("settings");
        let faults = run(&system, &settings, &Control::default(), &mut []).expect_err(method);
        let said = format!("{faults:?}");
        assert!(said.contains(method) && said.contains("friction"), "{said}");
    }
}

#[test]
fn the_order_of_the_objects_changes_nothing() {
    let linkage = slider_crank(0.1);
    let one = run_of(&scene_of(&format!("{MOTOR}, {linkage}"), RUN), &[]);
    let two = run_of(&scene_of(&format!("{linkage}, {MOTOR}"), RUN), &[]);
    let pairs = one.record.columns.iter().zip(&two.record.columns);
    for (one, two) in pairs {
        assert_eq!((&one.object, &one.values), (&two.object, &two.values));
    }
}
