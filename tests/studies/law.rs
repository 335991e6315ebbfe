//! `dam law …` as its users meet it.

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", said(output));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

#[track_caller]
fn refused(arguments: &[&str], wanted: &[&str]) {
    let output = dam(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    for word in wanted {
        assert!(said(&output).contains(word), "{word}: {}", said(&output));
    }
}

#[test]
fn laws_are_listed_and_shown() {
    let list = text(&dam(&["law", "list"]));
    assert!(list.contains("modified_trapezoid") && list.contains("unequal_trapezoid"));
    assert!(list.contains("Modifizierte Sinuslinie"));
    let all = json(&dam(&["law", "list", "--json"]));
    assert_eq!(all["strokes"].as_array().unwrap().len(), 8);
    let csv = text(&dam(&["law", "list", "--csv"]));
    assert_eq!(csv.lines().count(), 1 + 8 + 7);
    let shown = text(&dam(&["law", "show", "harmonic"]));
    assert!(shown.contains("soft shock at τ = 0"), "{shown}");
    let run_up = json(&dam(&[
        "law",
        "show",
        "modified_sine",
        "--run-up",
        "--json",
    ]));
    assert_eq!(run_up["run_up"], true);
    let samples = text(&dam(&[
        "law",
        "show",
        "cosine",
        "--form",
        "csv",
        "--samples",
        "10",
    ]));
    assert_eq!(samples.lines().count(), 12);
    let picture = text(&dam(&["law", "show", "scca:0.2,0.5", "--form", "svg"]));
    assert!(picture.starts_with("<svg") && picture.contains("θ‴"));
    refused(&["law", "show", "cycloid"], &["did you mean `cycloidal`"]);
    refused(&["law", "show", "trapezoid:0.7,0.7"], &["at most 1"]);
}

#[test]
fn strokes_are_synthesized_and_refusals_give_the_interval() {
    let basic = ["law", "synthesize", "--run-up", "equilateral_trapezoid"];
    fn joined<'a>(first: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
        [first, more].concat()
    }
    let with = |more: &[&'static str]| joined(&basic, more);
    let found = dam(&with(&[
        "--stroke",
        "50 mm",
        "--span",
        "120 deg",
        "--uniform-optimum",
        "--json",
    ]));
    let found = json(&found);
    assert_eq!(found["unit"], "m");
    let share = found["figures"]["uniform_stroke"].as_f64().unwrap();
    assert!((share - 0.5).abs() < 1e-14, "{share}");
    // The example of Vulfson's text: what the best uniform section changes.
    let shown = text(&dam(&with(&[
        "--stroke",
        "50 mm",
        "--span",
        "120 deg",
        "--uniform-optimum",
    ])));
    for (name, change) in [
        ("greatest Π′ ", "-25 %"),
        ("greatest |Π″|", "+12.5 %"),
        ("greatest |Π′Π″|", "-15.625 %"),
    ] {
        let mut lines = shown
            .lines()
            .skip_while(|line| !line.contains("Against no uniform"));
        assert!(
            lines.any(|line| line.contains(name) && line.ends_with(change)),
            "{name}: {shown}"
        );
    }
    let table = text(&dam(&with(&[
        "--stroke",
        "-30 deg",
        "--span",
        "90 deg",
        "--uniform-span",
        "0.2",
    ])));
    assert!(table.contains("Π_III") && table.contains("rad"), "{table}");
    let csv = with(&[
        "--stroke",
        "50 mm",
        "--span",
        "120 deg",
        "--uniform-stroke",
        "0",
        "--form",
        "csv",
    ]);
    assert!(text(&dam(&csv)).starts_with("phi [rad],Pi [m]"));
    let fast = with(&[
        "--stroke",
        "50 mm",
        "--span",
        "120 deg",
        "--peak-speed",
        "60 mm/rad",
    ]);
    refused(&fast, &["--peak-speed", "0.0238732", "0.0477464"]);
    refused(&with(&["--stroke", "50 mm"]), &["exactly three of"]);
    let wrong = with(&[
        "--stroke",
        "50 kg",
        "--span",
        "120 deg",
        "--uniform-span",
        "0.2",
    ]);
    refused(&wrong, &["kg"]);
}

#[test]
fn laws_are_ranked_by_the_response_of_a_scene() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let scene = root.join("scenarios/valve_train/in_working_order.json");
    let scene = scene.display().to_string();
    let arguments = [
        "law",
        "compare",
        &scene,
        "--at",
        "valve.position.cam.law",
        "--law",
        "harmonic",
        "--law",
        "cycloidal",
        "--law",
        "scca:0.25,0.75",
        "--lift-off",
        "--json",
        "--quiet",
    ];
    let output = dam(&arguments);
    assert!(output.status.success(), "{}", said(&output));
    let found = json(&output);
    let laws = found["laws"].as_array().unwrap();
    assert_eq!(laws.len(), 3);
    for law in laws {
        let response = &law["response"];
        assert!(response["contact_force"].as_f64().unwrap() > 0.0);
        assert!(response["driver_torque"].as_f64().unwrap() > 0.0);
        assert!(
            response["lift_off"]["at"].as_f64().unwrap() > 0.0,
            "{response}"
        );
    }
    // The harmonic law has the least acceleration, and shakes most in the dwell.
    assert_eq!(found["places"]["C_a"][0], 1);
    assert_eq!(found["places"]["residual"][0], 3);
    refused(
        &[
            "law",
            "compare",
            &scene,
            "--at",
            "nobody.position.cam.law",
            "--law",
            "harmonic",
            "--law",
            "3-4-5",
        ],
        &["nobody"],
    );
}

#[test]
fn the_cycle_of_a_cam_is_shown_with_its_shocks() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let scene = root.join("scenarios/indexing/thread_guide.json");
    let scene = scene.display().to_string();
    let shown = text(&dam(&["law", "cycle", &scene, "--of", "guide"]));
    assert_eq!(shown.matches("soft shock at").count(), 1, "{shown}");
    let found = json(&dam(&["law", "cycle", &scene, "--of", "guide", "--json"]));
    // The cosine run-out ends in the dwell, 180 deg after the rest of 30 deg.
    let at = found["cycle"]["jumps"]
        .as_array()
        .unwrap()
        .iter()
        .find(|jump| jump["order"] == 2)
        .unwrap()["at"]
        .as_f64()
        .unwrap();
    assert!((at - std::f64::consts::PI).abs() < 1e-12, "{at}");
    let csv = text(&dam(&[
        "law", "cycle", &scene, "--of", "guide", "--form", "csv",
    ]));
    assert!(csv.starts_with("phi [rad],U [m],"), "{csv}");
    refused(
        &["law", "cycle", &scene, "--of", "cam"],
        &["a drive follows no law"],
    );
}
