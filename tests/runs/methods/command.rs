//! The command `dam methods`.

use super::{WHEEL, dam, path};
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::process::Output;
use std::time::Duration;

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn the_command_prints_and_writes_one_and_the_same_study() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("wheel.json");
    std::fs::write(&scene, WHEEL).unwrap();
    let scene = scene.display().to_string();
    let out = folder.path().join("out").display().to_string();
    let common = [
        "--methods",
        "exact,rk4,dop853",
        "--tolerances",
        "1e-5,1e-9",
        "--steps",
        "1e-2,1e-5",
        "--repeats",
        "2",
        "--accuracy",
        "1e-7",
    ];
    let mut arguments = vec!["methods", &scene, "--json", "--quiet", "--out", &out];
    arguments.extend(common);
    let output = dam(&arguments);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert!(output.stderr.is_empty(), "{}", stderr(&output));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let file = |name: &str| std::fs::read_to_string(PathBuf::from(&out).join(name)).unwrap();
    let written: Value = serde_json::from_str(&file("methods.json")).unwrap();
    assert_eq!(printed, written);
    assert_eq!(printed["dam"], 1);
    assert_eq!(printed["methods"][0]["method"], "exact");
    assert_eq!(printed["methods"][1]["points"][0]["verdict"], "unstable");
    assert_eq!(printed["accuracy"], 1e-7);
    assert!(file("methods.csv").lines().count() == 6);
    assert!(
        file("error-time.svg").contains("<svg") && file("error-evaluations.svg").contains("dop853")
    );
    let page = file("report.html");
    assert!(page.contains("Recommendation") && page.contains("Limits of stability"));
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!outside.contains("http:") && !outside.contains("https:"));

    let mut arguments = vec!["methods", &scene];
    arguments.extend(common);
    let output = dam(&arguments);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("exact: no truncation error") && text.contains("For an error of 1e-7: "),
        "{text}"
    );
    assert!(text.contains("UNSTABLE: "), "{text}");
}

#[test]
fn the_command_goes_over_a_parameter() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("wheel.json");
    std::fs::write(&scene, WHEEL).unwrap();
    let out = folder.path().join("out");
    let output = dam(&[
        "methods",
        &scene.display().to_string(),
        "--x",
        "wheel.stiffness=8000:80000:3:log",
        "--methods",
        "exact,rk4",
        "--accuracy",
        "1e-5",
        "--repeats",
        "1",
        "--set",
        "wheel.damping=0.1",
        "--out",
        &out.display().to_string(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("methods over stiffness of wheel"), "{text}");
    for name in ["regions.svg", "cost.svg", "report.html", "methods.csv"] {
        assert!(out.join(name).exists(), "{name}");
    }
    let document = std::fs::read_to_string(out.join("methods.json")).unwrap();
    let document: Value = serde_json::from_str(&document).unwrap();
    assert_eq!(document["slices"].as_array().unwrap().len(), 3);
    assert_eq!(document["axis"]["path"], "wheel.stiffness");
    // The unit of the scene, as on a map, though none was given.
    assert_eq!(document["axis"]["unit"], "N m/rad");
    let report = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(report.contains("stiffness of wheel, N m/rad"));
}

#[test]
fn bad_arguments_end_with_status_two_and_say_what_is_right() {
    let scene = path("rocker/two_masses.json").display().to_string();
    for (arguments, word) in [
        (["--methods", "euler"], "dop853"),
        (["--accuracy", "2"], "below 1"),
        (["--tolerances", "1e-3,x"], "invalid"),
        (["--steps", "-1"], "above 0"),
        (["--repeats", "0"], "1..=1000"),
        (["--point-limit", "0"], "above 0"),
        (["--x", "rocker.stiffness"], "PATH=FROM:TO:COUNT"),
        (["--x", "rocker.stiffness=1e6:1e7:9999"], "at most 1000"),
        (["--x", "rocker.nonsense=1:2:3"], "nonsense"),
    ] {
        let joined = format!("{}={}", arguments[0], arguments[1]);
        let output = dam(&["methods", &scene, &joined]);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(
            stderr(&output).contains(word),
            "{arguments:?}: {}",
            stderr(&output)
        );
    }
    // Nothing elastic: there is no method to choose.
    let rigid = path("rigid/engine_slider.json").display().to_string();
    let output = dam(&["methods", &rigid]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("no method to choose"),
        "{}",
        stderr(&output)
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_was_done() {
    // A busy machine may need longer for the first point.
    let documents = [3, 30].into_iter().map(interrupted_after);
    let points = |document: &Value| {
        let points = document["methods"][0]["points"].as_array();
        points.is_some_and(|points| !points.is_empty())
    };
    assert!(documents.into_iter().any(|document| points(&document)));
}

/// What is printed by a study that is interrupted after so many seconds.
#[cfg(unix)]
fn interrupted_after(seconds: u64) -> Value {
    use std::time::Instant;
    let scene = path("rocker/two_masses.json").display().to_string();
    let mut child = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["methods", &scene, "--json", "--quiet", "--repeats", "1"])
        .args(["--methods", "exact,rk4,dopri5", "--point-limit", "600"])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(seconds));
    let begun = Instant::now();
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.unwrap().success());
    let mut text = String::new();
    std::io::Read::read_to_string(child.stdout.as_mut().unwrap(), &mut text).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(begun.elapsed() < Duration::from_secs(120));
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(document["complete"], false);
    document
}
