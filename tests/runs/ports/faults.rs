//! What is wrong with the inputs of an object is said with its place.

use super::document;
use dam::lower::lower;
use dam::object::Registry;
use dam::scene::{BuiltIn, Overrides};
use dam::system::System;

const DRIVES: &str = r#""a": { "kind": "drive", "motion": { "speed": 4 } },
    "b": { "kind": "drive", "motion": { "fixed": 0 } },
    "s": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": 1 } },"#;

/// The faults of a differential with these properties, as (path, message) and hints.
fn told(properties: &str) -> Vec<(String, String)> {
    let objects = format!(
        r#"{DRIVES} "d": {{ "kind": "differential", "inertia": 1, "masses": 0, {properties} }}"#
    );
    let document = document(&objects, r#""duration": 1"#, Registry::standard());
    match document.scene(&BuiltIn, &Overrides::none()) {
        Ok(_) => Vec::new(),
        Err(diagnostics) => {
            let items = diagnostics.items.iter();
            items
                .map(|fault| (fault.path.clone(), fault.message.clone()))
                .collect()
        }
    }
}

#[test]
fn sound_inputs_are_taken() {
    for properties in [
        r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "object": "b", "ratio": -1 } }"#,
        r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "object": "a", "ratio": -1 } }"#,
        r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "object": "s", "ratio": "3 rad/m" } },
            "offset": "5 deg""#,
        r#""inputs": { "sun": { "object": "a" }, "carrier": { "object": "b" } },
            "planetary": { "basic_ratio": -2.5 }"#,
        r#""coordinate": "sliding", "lever": { "output": "0.3 m" },
            "inputs": { "x": { "object": "s", "at": 0 }, "y": { "object": "s", "at": "0.5 m" } }"#,
    ] {
        assert_eq!(told(properties), [], "{properties}");
    }
}

#[test]
fn faulty_inputs_are_told() {
    let mut missed = Vec::new();
    for (properties, path, message) in [
        (
            r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "object": "c", "ratio": 1 } }"#,
            "d.inputs.y.object",
            "unknown object `c`",
        ),
        (
            r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "ratio": 1 } }"#,
            "d.inputs.y",
            "`y` has no `object`",
        ),
        (
            r#""inputs": { "x": { "object": "a", "ratio": 2 } }"#,
            "d.inputs",
            "one input is nothing to sum",
        ),
        (
            r#""inputs": { "x": { "object": "a", "ratio": 2 }, "y": { "object": "b" } }"#,
            "d.inputs",
            "input `y` has no ratio",
        ),
        (
            r#""inputs": { "x": { "object": "a", "ratio": 0 }, "y": { "object": "b", "ratio": 1 } }"#,
            "d.inputs.x.ratio",
            "",
        ),
        (
            r#""inputs": { "x": { "object": "a", "ratio": "2 m" }, "y": { "object": "b", "ratio": 1 } }"#,
            "d.inputs.x.ratio",
            "",
        ),
        (
            r#""inputs": { "sun": { "object": "a" }, "moon": { "object": "b" } },
                "planetary": { "basic_ratio": -3 }"#,
            "d.inputs",
            "a planetary gear has no `moon`",
        ),
        (
            r#""inputs": { "sun": { "object": "a" }, "ring": { "object": "b", "ratio": 2 } },
                "planetary": { "basic_ratio": -3 }"#,
            "d.inputs.ring.ratio",
            "the ratio follows from `planetary`",
        ),
        (
            r#""inputs": { "sun": { "object": "a" }, "ring": { "object": "b" } },
                "planetary": { "basic_ratio": 1 }"#,
            "d.planetary.basic_ratio",
            "",
        ),
        (
            r#""inputs": { "sun": { "object": "a" }, "ring": { "object": "b" } },
                "planetary": { "teeth": { "sun": 24 } }"#,
            "d.planetary.teeth",
            "`teeth` has no `ring`",
        ),
        (
            r#""coordinate": "sliding", "lever": { "output": 0 },
                "inputs": { "x": { "object": "s", "at": 0 }, "y": { "object": "s", "at": 1 } }"#,
            "d.lever",
            "",
        ),
        (
            r#""input": "a", "inputs": { "x": { "object": "a", "ratio": 1 }, "y": { "object": "b", "ratio": 1 } }"#,
            "d.input",
            "",
        ),
    ] {
        let found = told(properties);
        let hit = found
            .iter()
            .any(|(at, said)| *at == path && said.contains(message));
        if !hit {
            missed.push((properties, found));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

#[test]
fn circles_through_several_inputs_are_found() {
    let objects = r#""a": { "kind": "drive", "motion": { "speed": 4 } },
        "d": { "kind": "differential", "inertia": 1, "masses": 0,
            "inputs": { "x": { "object": "a", "ratio": 1 }, "y": { "object": "g", "ratio": 1 } } },
        "g": { "kind": "shaft", "input": "d", "inertia": 1, "masses": 0 }"#;
    let document = document(objects, r#""duration": 1"#, Registry::standard());
    let told = document
        .scene(&BuiltIn, &Overrides::none())
        .unwrap_err()
        .to_string();
    assert!(told.contains("d → g → d"), "{told}");
}

/// What the method of joint friction cannot do is said before the run.
#[test]
fn joint_friction_on_coupled_coordinates_is_refused() {
    let objects = r#""a": { "kind": "drive", "motor": { "inertia": 1, "torque": { "constant": 1 } } },
        "b": { "kind": "drive", "motor": { "inertia": 1, "torque": { "constant": 1 } } },
        "d": { "kind": "differential", "inertia": 1, "masses": 0,
            "inputs": { "x": { "object": "a", "ratio": 1 }, "y": { "object": "b", "ratio": 1 } } },
        "press": { "from": "linkage/toggle-press", "input": "a", "joint_friction": true }"#;
    let document = document(
        objects,
        r#""duration": 1, "start": "on_law""#,
        Registry::standard(),
    );
    let reading = document.scene(
        &BuiltIn,
        &Overrides::new(["press.pairs.O.friction=0.1", "press.pairs.O.diameter=0.1"]),
    );
    let scene = reading.unwrap_or_else(|e| panic!("{e}")).scene;
    let faults = System::new(lower(&scene).unwrap()).unwrap_err();
    assert_eq!(faults[0].path, "press.joint_friction");
    assert!(
        faults[0]
            .hint
            .contains("give one of the objects between masses")
    );
}
