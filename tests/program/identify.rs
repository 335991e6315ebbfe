//! `dam identify` as a program: a free decay beside its reference, its files, records that it
//! refuses, and numbers that a record does not determine.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("identify")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn document(arguments: &[&str], status: i32) -> Value {
    let output = dam(&[arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        output.status.code(),
        Some(status),
        "{arguments:?}: {errors}"
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Text in one line, without the frame of a message.
fn in_a_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn errors(arguments: &[&str]) -> String {
    let output = dam(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    in_a_line(&output.stderr)
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

/// `tests/reference/design-optimum-tolerance.json`.
fn reference() -> Value {
    let text = std::fs::read_to_string("tests/reference/design-optimum-tolerance.json").unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["identify"].clone()
}

const SCENE: &str = r#"{
    "dam": 1, "name": "Free decay",
    "objects": {
        "drive": { "kind": "drive", "motion": { "speed": "1 rad/s" } },
        "wheel": { "kind": "shaft", "input": "drive", "inertia": 0.1, "stiffness": "9 MN m/rad", "damping_capacity": 0.2 }
    },
    "run": { "duration": 0.01, "start": { "wheel": { "displacement": [0.001], "speed": [1] } } }
}"#;

/// The record of the reference, times in ms and angles in µrad.
fn record() -> String {
    let decay = |time: f64| {
        let natural = 1e4;
        let share = 0.4 / (2.0 * std::f64::consts::TAU);
        let own = natural * f64::sqrt(1.0 - share * share);
        let slow = f64::exp(-share * natural * time);
        1e-3 * slow * ((own * time).cos() + share * natural / own * (own * time).sin())
    };
    let row = |at: i32| {
        let time = f64::from(at) * 2e-5;
        let value = decay(time) + 1e-6 * f64::from(at * at).sin();
        format!("{:?};{:?}\n", time * 1e3, value * 1e6)
    };
    let rows: String = (1..=200).map(row).collect();
    format!("t [ms];x [µrad]\n{rows}")
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

const SOUGHT: [&str; 6] = [
    "--match",
    "x=wheel.delta",
    "--vary",
    "wheel.stiffness=2:30 MN m/rad",
    "--vary",
    "wheel.damping_capacity=0:1",
];

#[test]
fn a_free_decay_is_that_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let out = folder.path().join("out").display().to_string();
    let arguments = [
        &[
            scene.as_str(),
            "--record",
            &record,
            "--starts",
            "4",
            "--out",
            &out,
        ],
        &SOUGHT[..],
    ]
    .concat();
    let found = document(&arguments, 0);
    let wanted = reference();
    let sizes = [("stiffness", 1e6), ("damping_capacity", 1.0)];
    for (at, (name, size)) in sizes.into_iter().enumerate() {
        let own = &found["estimates"][at];
        let value = number(&own["value"]) * size / number(&wanted["estimate"][name]) - 1.0;
        assert!(value.abs() < 1e-8, "{own}");
        let error =
            number(&own["standard_error"]) * size / number(&wanted["standard_errors"][name]);
        assert!((error - 1.0).abs() < 1e-5, "{own}");
        assert_eq!(own["determined"], true);
    }
    assert_eq!(found["answered"], true);
    // The settings and the scene that is written are the estimates.
    let stiffness = number(&found["estimates"][0]["value"]);
    let setting = format!("wheel.stiffness={stiffness:?} MN m/rad");
    assert_eq!(found["settings"][0], setting.as_str());
    let written = std::fs::read_to_string(format!("{out}/identified.json")).unwrap();
    assert!(written.contains(&format!("{stiffness:?}")), "{written}");
    let rows = std::fs::read_to_string(format!("{out}/fit.csv")).unwrap();
    assert_eq!(rows.lines().count(), 201);
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(page.contains("Residuals: fit less record"));
    let answer = std::fs::read_to_string(format!("{out}/identification.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&answer).unwrap(), found);
}

#[test]
fn what_a_record_does_not_determine_has_a_direction_and_no_number() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let arguments = [
        &[scene.as_str(), "--record", &record, "--starts", "2"],
        &SOUGHT[..],
        &["--vary", "wheel.inertia=0.05:0.3"],
    ]
    .concat();
    let output = dam(&arguments);
    assert_eq!(output.status.code(), Some(1));
    let text = in_a_line(&output.stdout);
    assert!(
        text.contains("The record does not determine stiffness"),
        "{text}"
    );
    assert!(
        text.contains("These changes together leave the fit as it is"),
        "{text}"
    );
    let found = document(&arguments, 1);
    assert!(found["estimates"][0]["value"].is_null() && found["estimates"][2]["value"].is_null());
    assert_eq!(found["open_directions"][0].as_array().unwrap().len(), 2);
    assert_eq!(found["settings"].as_array().unwrap().len(), 0);
}

#[test]
fn records_that_are_wrong_are_refused_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let refused = |text: &str| {
        let record = write(folder.path(), "bad.csv", text);
        errors(&[&[scene.as_str(), "--record", &record], &SOUGHT[..]].concat())
    };
    for (text, parts) in [
        ("t [s],y [rad]\n0,1\n", &["no column `x`", "bad.csv:1"][..]),
        (
            "t [s],x [mm]\n0,1\n",
            &["column `x` has the wrong unit", "bad.csv:1"],
        ),
        (
            "t [mm],x [mm]\n0,1\n",
            &[
                "column `t` has the wrong unit",
                "column `x` has the wrong unit",
            ],
        ),
        (
            "t [s],x [rad]\n0,1\n1,NaN\n",
            &["`NaN` is not a number", "bad.csv:3"],
        ),
        ("t [s],x [rad]\n0,1\n1,\n", &["no number here", "bad.csv:3"]),
        ("t [s],x [rad]\n0,1\n1,1e999\n", &["too large"]),
        (
            "t [s],x [rad]\n0,1\n2,1\n1,1\n2,3\n",
            &["not later than the one before", "bad.csv:4"],
        ),
        ("t [s],x [rad]\n-1,1\n1,1\n", &["below 0", "bad.csv:2"]),
        ("t [s],x [rad]\n0,1\n", &["no row after the start"]),
        (
            "t [s],x [rad]\n1e-3,1\n2e-3,1\n",
            &["have 2 values in all", "more rows"],
        ),
        ("t [s],x [rad]\n", &["no rows"]),
        ("", &["empty"]),
    ] {
        let found = refused(text);
        for part in parts {
            assert!(found.contains(part), "{text:?}: {part}: {found}");
        }
    }
}

#[test]
fn all_faults_of_several_records_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let one = write(folder.path(), "one.csv", "t [s],x [rad]\n0,1\n0,2\n");
    let two = write(folder.path(), "two.csv", "t [s],z [rad]\n0,1\n");
    let found = errors(
        &[
            &[scene.as_str(), "--record", &one, "--record", &two],
            &SOUGHT[..],
        ]
        .concat(),
    );
    assert!(
        found.contains("one.csv:3") && found.contains("two.csv:1"),
        "{found}"
    );
    let absent = errors(&[&[scene.as_str(), "--record", "no/such.csv"], &SOUGHT[..]].concat());
    assert!(absent.contains("cannot read `no/such.csv`"), "{absent}");
    let good = write(folder.path(), "good.csv", &record());
    let sets = format!("{good}; wheel.stiffness=1e6; wheel.mass=1 kg");
    let found = errors(&[&[scene.as_str(), "--record", &sets], &SOUGHT[..]].concat());
    assert!(
        found.contains("sets `wheel.stiffness`, which is sought"),
        "{found}"
    );
}

#[test]
fn questions_that_are_wrong_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let refused = |more: &[&str]| {
        errors(&[&[scene.as_str(), "--record", &record], &SOUGHT[..], more].concat())
    };
    for (more, part) in [
        (&["--vary", "wheel.masses=1:3"][..], "counts"),
        (&["--vary", "wheel.inertia=1:2 mm"], "unit"),
        (&["--vary", "wheel.inertia=2:1"], "lesser"),
        (&["--vary", "wheel.stiffness=1:2 MN m/rad"], "twice"),
        (&["--match", "x=wheel.speed"], "twice"),
        (&["--match", "y=wheel.spede"], "wheel.speed"),
        (&["--match", "x2=wheel.speed"], "weighed"),
        (&["--sigma", "x=1 mm"], "rad"),
        (&["--sigma", "x=0 rad"], "greater than 0"),
        (&["--sigma", "q=1 rad"], "no column"),
        (&["--starts", "0"], "1 to 1000"),
    ] {
        let found = refused(more);
        assert!(found.contains(part), "{more:?}: {part}: {found}");
    }
}

/// What is known when the time is over is kept.
#[test]
fn an_end_from_outside_keeps_what_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let arguments = [
        &[scene.as_str(), "--record", &record, "--starts", "1000"],
        &SOUGHT[..],
        &["--time-limit", "2", "--json"],
    ]
    .concat();
    let output = dam(&arguments);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["complete"], false);
    assert_eq!(found["starts_requested"], 1000);
    let starts = found["starts"].as_array().unwrap();
    assert!(!starts.is_empty() && starts.len() < 1000);
    assert_ne!(output.status.code(), Some(0));
}
