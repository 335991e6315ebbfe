//! Results of other studies as figures of `run`, `compare`, `map` and accuracy, against closed
//! forms, the values that scenarios expect, and the commands of the studies.

use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .arg("--quiet")
        .output()
        .unwrap()
}

#[track_caller]
fn document(arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    let output = dam(&arguments);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A scene in a file, gone with the folder.
fn written(scene: &Value) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, serde_json::to_string_pretty(scene).unwrap()).unwrap();
    let path = path.display().to_string();
    (folder, path)
}

#[track_caller]
fn near(found: &Value, wanted: f64, share: f64) {
    let found = found.as_f64().unwrap_or_else(|| panic!("{found}"));
    let off = (found - wanted).abs();
    assert!(off <= share * wanted.abs(), "{found} for {wanted}");
}

/// The row of a figure in a comparison of two runs that differ in their tolerance alone.
#[track_caller]
fn compared(scene: &str, figure: &str) -> Value {
    let over = ["--over", "run.tolerance=1e-6,1e-7", "--figure", figure];
    let mut arguments = vec!["compare", scene];
    arguments.extend(over);
    let found = document(&arguments);
    let rows = found["table"]["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["figure"] == figure);
    row.unwrap_or_else(|| panic!("{figure}")).clone()
}

fn rocker() -> Value {
    json!({
        "dam": 1, "name": "t",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
            "rocker": {
                "kind": "rocker", "input": "shaft", "position": { "sine": { "amplitude": 0.5 } },
                "inertia": 2, "stiffness": 2e4, "damping_capacity": 0, "masses": 1
            }
        },
        "run": { "duration": 0.2 }
    })
}

#[test]
fn natural_frequencies_are_figures() {
    let wanted = 100.0 / TAU;
    let mut scene = rocker();
    scene["expect"] = json!([
        { "figure": "frequency.1", "value": format!("{wanted} Hz"), "within": "1e-10 %" },
        { "figure": "frequency.open.1", "at_least": 0 },
    ]);
    let (_folder, path) = written(&scene);
    let found = document(&["run", &path]);
    near(&found["studies"]["frequency.1"]["value"], wanted, 1e-14);
    assert_eq!(found["studies"]["frequency.1"]["unit"], "Hz");
    assert_eq!(found["expect"][0]["holds"], true);
    let over = ["compare", &path, "--over", "rocker.stiffness=20000,80000"];
    let mut arguments = over.to_vec();
    arguments.extend(["--figure", "frequency.1"]);
    let found = document(&arguments);
    let rows = found["table"]["rows"].as_array().unwrap().iter();
    let row = rows.clone().find(|row| row["figure"] == "frequency.1");
    let row = row.unwrap();
    near(&row["values"][0], wanted, 1e-14);
    near(&row["values"][1], 2.0 * wanted, 1e-14);
    near(&row["errors"][0], -0.5, 1e-12);
    let x = "rocker.stiffness=20000:80000:4";
    let found = document(&["map", &path, "--x", x, "--figure", "frequency.1"]);
    assert_eq!(found["unit"], "Hz");
    let values = found["panels"][0]["values"].as_array().unwrap();
    for (value, stiffness) in values.iter().zip([1.0, 2.0, 3.0, 4.0f64]) {
        near(value, wanted * stiffness.sqrt(), 1e-14);
    }
    assert_eq!(values.len(), 4);
}

/// The lowest frequency of a uniform rod that is held at one end is √(k/J)/4 cycles a second.
#[test]
fn models_are_chosen_for_the_accuracy_of_a_frequency() {
    let (_folder, path) = written(&json!({
        "dam": 1, "name": "t",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": "1 rev/s" } },
            "rod": {
                "kind": "shaft", "input": "shaft", "inertia": 1, "stiffness": 1e4,
                "damping_capacity": 0.2, "masses": "auto"
            }
        },
        "run": { "duration": 0.2 }
    }));
    let found = document(&["run", &path, "--accuracy", "frequency.1=0.5 %"]);
    near(&found["studies"]["frequency.1"]["value"], 25.0, 5e-3);
    // (A lumped mass alone would have √(k/J)/2π.)
    let (_folder, rocker) = written(&rocker());
    let output = dam(&["run", &rocker, "--accuracy", "frequency.0=1 %"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn steady_motions_are_figures() {
    let scene = "scenarios/steady/press_motor.json";
    let expected = std::fs::read_to_string(scene).unwrap();
    let expected: Value = serde_json::from_str(&expected).unwrap();
    let mut seen = 0;
    for one in expected["expect"].as_array().unwrap() {
        let figure = one["figure"].as_str().unwrap_or_default();
        let (Some(value), true) = (one["value"].as_f64(), figure.starts_with("steady.")) else {
            continue;
        };
        let row = compared(scene, figure);
        near(&row["values"][0], value, 1e-6);
        seen += 1;
    }
    assert!(seen > 0);
}

#[test]
fn kinematics_are_figures() {
    let scene = "scenarios/linkages/shaper.json";
    let found = document(&["kinematics", scene]);
    let judged = found["expect"].as_array().unwrap().iter();
    let mut judged = judged.filter(|one| one["what"] == "kinematics.shaper.ram.time_ratio");
    let wanted = judged.next().unwrap()["found"].as_f64().unwrap();
    let row = compared(scene, "kinematics.shaper.ram.time_ratio");
    near(&row["values"][1], wanted, 1e-12);
    // The ram moves at the speed of the motor in the run too.
    let row = compared(scene, "kinematics.shaper.ram.acceleration.greatest");
    let run = document(&["run", scene]);
    let peak = run["objects"]["shaper.ram"]["peak_acceleration"].as_f64();
    assert!(row["values"][0].as_f64().unwrap() <= peak.unwrap() * (1.0 + 1e-9));
}

#[test]
fn cams_are_figures() {
    let scene = "scenarios/cams/flat_tappet.json";
    let cam = document(&["cam", scene]);
    // Under a flat face the radius of curvature is R + y + y″.
    let figures = &cam["cam"];
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
    let base = number(&figures["base_radius"]);
    let radius = base + number(&figures["stroke"]) + number(&figures["acceleration"][1]["value"]);
    near(
        &compared(scene, "cam.valve.least_radius")["values"][0],
        radius,
        1e-9,
    );
    let force = number(&figures["force"]["contact_force"]["value"]);
    let row = compared(scene, "cam.valve.greatest_contact_force");
    near(&row["values"][0], force, 1e-12);
    assert_eq!(row["unit"], "N");
    assert_eq!(
        compared(scene, "cam.valve.greatest_pressure_angle")["values"][0],
        0.0
    );
    let x = "valve.cam.base_radius=15:21 mm:3";
    let figure = ["--figure", "cam.valve.least_radius"];
    let found = document(&["map", scene, "--x", x, figure[0], figure[1]]);
    let values = found["panels"][0]["values"].as_array().unwrap();
    for (value, other) in values.iter().zip([0.015, 0.018, 0.021]) {
        near(value, radius - base + other, 1e-9);
    }
}

#[test]
fn results_that_no_study_has_are_refused() {
    let (_folder, path) = written(&rocker());
    let x = ["--x", "rocker.stiffness=20000:80000:3"];
    for (figure, words) in [
        ("frequency.0", "counted from 1"),
        ("steady.mean_tim", "did you mean `steady.mean_time`?"),
        ("cam.roker.least_radius", "there is no object `roker`"),
        ("kinematics.rocker.x.y", "kinematics"),
    ] {
        let compare = [
            "compare",
            &path,
            "--over",
            "rocker.masses=1,2",
            "--figure",
            figure,
        ];
        let map = ["map", &path, x[0], x[1], "--figure", figure];
        for arguments in [&compare[..], &map[..]] {
            let output = dam(arguments);
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
            let known = error.contains(words) || words == "kinematics";
            assert!(known, "{words}: {error}");
        }
    }
    let own = [
        "compare",
        &path,
        "--over",
        "rocker.masses=1,2",
        "--figure",
        "rocker.delta_abs",
    ];
    let output = dam(&own);
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("compared in any case"), "{error}");
    let mut scene = rocker();
    for (figure, words) in [
        ("frequency.0", "counted from 1"),
        ("cam.rocker.least_radius", "tells nothing of its cam"),
    ] {
        scene["expect"] = json!([{ "figure": figure, "at_least": 0 }]);
        let (_folder, path) = written(&scene);
        let output = dam(&["run", &path]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.contains(words) && error.contains("scene.json:"),
            "{error}"
        );
    }
}
