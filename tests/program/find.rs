//! `dam find` as a program: its answers beside closed forms and other commands, its ends.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn document(arguments: &[&str]) -> Value {
    let output = dam(&[&["find"], arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn best(arguments: &[&str]) -> f64 {
    document(arguments)["best"]["value"].as_f64().unwrap()
}

fn scene(folder: &Path, text: &str) -> String {
    let path = folder.join("scene.json");
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// A mass on a spring behind a drive.
const LEVER: &str = r#"{
    "dam": 1, "name": "Lever",
    "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "10 rad/s" } },
        "lever": {
            "kind": "rocker", "input": "shaft", "masses": 1, "position": { "sine": { "amplitude": "5 deg" } },
            "inertia": 0.2, "stiffness": "80 kN m/rad", "damping": 1
        }
    },
    "run": { "duration": "0.7 s" }
}"#;

#[test]
fn a_stiffness_for_a_frequency_is_that_of_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let lever = scene(folder.path(), LEVER);
    // f = √(c/J)/2π.
    let wanted = 0.2 * (std::f64::consts::TAU * 120.0).powi(2);
    for subject in ["frequency.1 >= 120 Hz", "frequency.1 = 0.12 kHz"] {
        let vary = "lever.stiffness=20:400 kN m/rad";
        let goal = ["--minimize", "lever.stiffness"];
        let found = best(&[&[&*lever, "--vary", vary, "--subject", subject], &goal[..]].concat());
        let off = (1e3 * found / wanted - 1.0).abs();
        assert!(off < 1e-6, "{subject}: {found} kN m/rad, {off}");
    }
}

#[test]
fn the_speed_of_lift_off_is_that_of_the_closed_form_and_of_the_search_over_runs() {
    let folder = tempfile::tempdir().unwrap();
    let cam = folder.path().join("cam.json").display().to_string();
    assert!(dam(&["new", "cam", &cam]).status.success());
    let lift_off = dam(&["cam", &cam, "--lift-off", "--json"]);
    let lift_off: Value = serde_json::from_slice(&lift_off.stdout).unwrap();
    let rpm = |found: &Value| found.as_f64().unwrap() * 30.0 / std::f64::consts::PI;
    let goal = ["--maximize", "camshaft.motion.speed"];
    let vary = ["--vary", "camshaft.motion.speed=1000:1600 rpm"];
    let rigid = [
        "--set",
        "follower.masses=0",
        "--subject",
        "follower.pair.margin >= 0 N",
    ];
    let rigid = best(&[&[cam.as_str()], &vary[..], &rigid[..], &goal[..]].concat());
    let elastic = ["--subject", "follower.pair.separations <= 0"];
    let elastic = best(&[&[cam.as_str()], &vary[..], &elastic[..], &goal[..]].concat());
    let force = &lift_off["cam"]["force"];
    let wanted_rigid = rpm(&force["lets_go"]["at"]["value"]);
    let wanted_elastic = rpm(&force["elastic"]["at"]);
    assert!(
        (rigid / wanted_rigid - 1.0).abs() < 1e-5,
        "{rigid} rpm, {wanted_rigid} rpm"
    );
    assert!(
        (elastic / wanted_elastic - 1.0).abs() < 1e-3,
        "{elastic} rpm, {wanted_elastic} rpm"
    );
}

#[test]
fn the_least_flywheel_is_that_of_the_energy_mass_diagram() {
    let engine = "scenarios/steady/engine.json";
    let sized = dam(&["steady", engine, "--fluctuation", "10 %", "--json"]);
    let sized: Value = serde_json::from_slice(&sized.stdout).unwrap();
    let added = sized["rigid_motion"]["flywheel"]["inertia"]
        .as_f64()
        .unwrap();
    let vary = ["--vary", "crank.motor.inertia=0.02:20:log"];
    let subject = ["--subject", "steady.fluctuation <= 10 %"];
    let goal = ["--minimize", "crank.motor.inertia"];
    let found = best(&[&[engine], &vary[..], &subject[..], &goal[..]].concat());
    assert!(
        (found / (0.02 + added) - 1.0).abs() < 1e-4,
        "{found} kg m², {added} added"
    );
}

#[test]
fn a_parameter_that_counts_takes_whole_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let lever = scene(folder.path(), LEVER);
    let all = [
        &*lever,
        "--vary",
        "lever.masses=1:8",
        "--subject",
        "frequency.1 <= 165 Hz",
    ];
    let found = document(&[&all[..], &["--minimize", "lever.masses"]].concat());
    let places = found["places"].as_array().unwrap();
    assert_eq!(places.len(), 8);
    let number = found["best"]["value"].as_f64().unwrap();
    assert_eq!(number.fract(), 0.0);
    let figure = |place: &Value| place["figures"][0].as_f64().unwrap();
    let first = places.iter().find(|place| figure(place) <= 165.0).unwrap();
    assert_eq!(first["value"].as_f64().unwrap(), number);
}

#[test]
fn what_is_wrong_is_said_at_once_and_no_answer_is_no_success() {
    let folder = tempfile::tempdir().unwrap();
    let lever = scene(folder.path(), LEVER);
    let vary = ["--vary", "lever.stiffness=20:400 kN m/rad"];
    let ask = |more: &[&str]| {
        let output = dam(&[&["find", &*lever], &vary[..], more].concat());
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let shown = String::from_utf8_lossy(&output.stdout).into_owned();
        (output.status.code().unwrap(), text, shown)
    };
    let wrong = [
        "--subject",
        "lever.delta <= 1",
        "--subject",
        "frequency.1 > 2 mm",
    ];
    let (status, text, _) = ask(&[&wrong[..], &["--maximize", "lever.stifness"]].concat());
    assert_eq!(status, 2);
    for part in ["lever.delta", "strict comparison", "lever.stifness"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let (status, text, _) = ask(&["--subject", "frequency.1 >= 2 mm"]);
    assert!(status == 2 && text.contains("another unit"), "{text}");
    let (status, text, _) = ask(&[]);
    assert!(status == 2 && text.contains("nothing is sought"), "{text}");
    let (status, _, shown) = ask(&["--subject", "frequency.1 >= 900 Hz"]);
    assert!(status == 1 && shown.contains("No value"), "{shown}");
    let (status, _, shown) = ask(&[
        "--subject",
        "frequency.1 >= 100 Hz",
        "--set",
        "run.duration=0.1",
    ]);
    assert!(
        status == 0 && shown.contains("All conditions hold"),
        "{shown}"
    );
    let output = dam(&[
        "find",
        &lever,
        "--vary",
        "lever.stifness=1:2",
        "--minimize",
        "lever.stifness",
    ]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        output.status.code() == Some(2) && text.contains("stiffness"),
        "{text}"
    );
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let lever = scene(folder.path(), LEVER);
    let all = [
        &*lever,
        "--vary",
        "lever.stiffness=20:400 kN m/rad",
        "--minimize",
        "lever.delta_abs",
    ];
    let [one, two] =
        ["1", "2"].map(|threads| document(&[&all[..], &["--threads", threads]].concat()));
    assert_eq!(one, two);
}

#[test]
fn a_span_beyond_the_end_of_the_run_is_named() {
    let scene = "scenarios/valve_train/rigid_margin.json";
    let subject = "valve.pair.margin >= 50 N from 0.1 s to 0.3 s";
    let vary = ["--vary", "camshaft.motion.speed=1000:1500 rpm:3"];
    let found = dam(&[&["find", scene, "--subject", subject], &vary[..]].concat());
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        words.contains("which ends at 0.16 s, does not go through all of"),
        "{text}"
    );
    assert!(!words.contains("no such mechanism"), "{text}");
    // Up to its end it is judged.
    let within = "valve.pair.margin >= 50 N from 0.1 s to 0.16 s";
    let found = dam(&[&["find", scene, "--subject", within], &vary[..]].concat());
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    assert!(text.contains("All conditions hold"), "{text}");
}
