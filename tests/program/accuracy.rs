//! Figures that do not hold the accuracy asked for: a warning, and exit status 1.

use serde_json::Value;
use std::process::{Command, Output};

const SCENE: &str = "scenarios/rocker/ten_masses_closed.json";
const FIGURE: &str = "rocker.delta_abs";
const SHORT: [&str; 4] = ["--set", "run.duration=0.1", "--set", "run.samples=100"];

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn json_of(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Whether the document warns of the accuracy, and whether the status is 1.
fn warned(arguments: &[&str]) -> (bool, bool) {
    let output = dam(&[arguments, &SHORT, &["--json"]].concat());
    let document = json_of(&output);
    let warnings = document["warnings"].as_array();
    let warnings = warnings.into_iter().flatten();
    let words = format!("{FIGURE} does not have the required accuracy: its error may be ");
    let found = warnings.filter_map(Value::as_str);
    let count = found.filter(|said| said.contains(&words)).count();
    // The terminal says the same.
    let said = dam(&[arguments, &SHORT].concat());
    let told = String::from_utf8(said.stderr).unwrap();
    assert_eq!(told.contains(&words), count > 0, "{arguments:?}: {told}");
    assert_eq!(said.status.code(), output.status.code(), "{arguments:?}");
    assert!([Some(0), Some(1)].contains(&output.status.code()));
    (count > 0, output.status.code() == Some(1))
}

#[test]
fn figures_that_miss_the_accuracy_asked_for_are_no_answer() {
    // Ten masses in place of a continuum.
    for (accuracy, misses) in [("50 %", false), ("0.001 %", true)] {
        let asked = format!("{FIGURE}={accuracy}");
        let set = format!(r#"run.accuracy={{"{FIGURE}":"{accuracy}"}}"#);
        let figure = ["--figure", FIGURE];
        let map = [
            "map",
            SCENE,
            "--x",
            "rocker.inertia=0.5:0.6:2",
            "--set",
            &set,
        ];
        let commands: [&[&str]; 4] = [
            &["run", SCENE, "--accuracy", &asked],
            &["run", SCENE, "--set", &set],
            &[
                "compare",
                SCENE,
                "--over",
                "rocker.inertia=0.5,0.6",
                "--set",
                &set,
            ],
            &[&map[..], &figure].concat(),
        ];
        for command in commands {
            assert_eq!(warned(command), (misses, misses), "{command:?}");
        }
    }
    // A force without a limit holds none.
    let force = "rocker.pair.max_contact_force=1 %";
    let bouncing = "scenarios/rocker/two_masses.json";
    let output = dam(&["run", bouncing, "--accuracy", force, "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let warnings = json_of(&output)["warnings"].to_string();
    let words = "rocker.pair.max_contact_force does not have the required accuracy: ";
    assert!(warnings.contains(words), "{warnings}");
    // Nothing is asked: nothing is missed.
    assert_eq!(warned(&["run", SCENE]), (false, false));
}
