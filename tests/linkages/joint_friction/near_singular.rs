//! A five-bar with joint friction that comes to a singular position: which method is taken, and
//! what `dam methods` says.

use super::support::{ran, read};
use dam::integrate::Method;
use dam::lower::lower;
use dam::studies::methods::{Plan, study};
use dam::studies::{Control, RunSettings};
use dam::system::System;

/// Two free cranks under constant torques; `friction` of all joints.
fn five_bar(duration: f64, friction: bool) -> String {
    let pin = |name: &str, a: &str, b: &str| {
        format!(r#""{name}": {{ "revolute": ["{a}", "{b}"], "diameter": 0.03, "friction": 0.1 }}"#)
    };
    let drive = |name: &str, inertia: f64, angle: f64, torque: f64| {
        format!(
            r#""{name}": {{ "kind": "drive", "motor": {{ "inertia": {inertia}, "angle": {angle},
                "torque": {{ "constant": {torque} }} }} }}"#
        )
    };
    let link = |name: &str, point: &str, length: f64, mass: f64| {
        format!(
            r#""{name}": {{ "points": {{ "{point}": [{length}, 0] }}, "geometry": {{ "mass": {mass} }} }}"#
        )
    };
    format!(
        r#"{{ "dam": 1, "name": "five-bar", "objects": {{ {left}, {right},
            "bar": {{ "kind": "linkage", "joint_friction": {friction}, "gravity": true,
                "ground": {{ "O": [0, 0], "P": [0.6, 0] }},
                "inputs": {{ "left": {{ "pair": "O", "object": "left" }},
                    "right": {{ "pair": "P", "object": "right" }} }},
                "links": {{ {links} }}, "pairs": {{ {pairs} }},
                "assembly": {{ "rod": {{ "branch": "-" }} }} }} }},
            "run": {{ "duration": {duration}, "tolerance": 1e-8, "start": "on_law" }} }}"#,
        left = drive("left", 0.02, 0.687, -1.46),
        right = drive("right", 0.03, 2.366, 2.7),
        links = [
            link("crank", "A", 0.304, 1.1),
            link("rod", "C", 0.421, 0.9),
            link("coupler", "C", 0.421, 0.8),
            link("servo", "B", 0.228, 1.3),
        ]
        .join(", "),
        pairs = [
            pin("O", "ground.O", "crank.origin"),
            pin("A", "crank.A", "rod.origin"),
            pin("C", "rod.C", "coupler.C"),
            pin("B", "servo.B", "coupler.origin"),
            pin("P", "ground.P", "servo.origin"),
        ]
        .join(", "),
    )
}

#[test]
fn auto_comes_to_a_singular_position_as_soon_as_the_best_method() {
    let text = five_bar(2.0, true);
    let auto = ran(&read(&text, &[]));
    let best = ran(&read(&text, &["run.method=dop853"]));
    for found in [&auto, &best] {
        let stopped = found.figures.run.stopped.as_deref();
        assert_eq!(
            stopped,
            Some("dead_position"),
            "{:?}",
            found.figures.warnings
        );
    }
    let off = (auto.outcome.time - best.outcome.time).abs();
    assert!(off < 1e-6, "{off}");
    let [own, least] = [&auto, &best].map(|found| found.figures.run.evaluations);
    assert!(own < 2 * least, "{own} {least}");
    let why = &auto.figures.run.why;
    assert!(why.contains("singular positions"), "{why}");
}

#[test]
fn methods_says_that_implicit_ones_are_slow_there() {
    for friction in [true, false] {
        let scene = read(&five_bar(0.02, friction), &[]);
        let system = System::new(lower(&scene).unwrap()).unwrap();
        let settings = RunSettings::of(&scene).unwrap();
        let plan = Plan {
            methods: vec![Method::Dop853],
            tolerances: vec![1e-6, 1e-8],
            repeats: 1,
            ..Plan::new(1e-6)
        };
        let found = study(&system, &settings, &plan, &Control::default(), &mut |_| ()).unwrap();
        let says = |text: &String| text.contains("rodas5p may not finish");
        assert_eq!(found.cautions.iter().any(says), friction, "{found:?}");
    }
}
