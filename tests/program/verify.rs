//! `dam verify` as a program: tables, JUnit, the status.

use serde_json::Value;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("verify")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

const ROCKER: &str = "scenarios/rocker/two_masses.json";
/// Expects figures of kinematics and of forces.
const CRANK: &str = "scenarios/kinetostatics/slider_crank.json";
/// Expects figures of the steady motion.
const ENGINE: &str = "scenarios/steady/engine.json";

#[test]
fn every_study_is_asked_and_the_forms_agree() {
    let scenes = [ROCKER, CRANK, ENGINE];
    let json = dam(&[&scenes[..], &["--json"]].concat());
    assert_eq!(
        json.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&json.stderr)
    );
    let found: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(found["holds"], true);
    let all: Vec<&Value> = (found["scenes"].as_array().unwrap().iter())
        .flat_map(|scene| scene["requirements"].as_array().unwrap())
        .collect();
    let studies: std::collections::BTreeSet<&str> = all
        .iter()
        .map(|one| one["study"].as_str().unwrap())
        .collect();
    assert!(
        studies.contains("run") && studies.contains("steady"),
        "{studies:?}"
    );
    assert!(
        studies.contains("kinematics") || studies.contains("forces"),
        "{studies:?}"
    );
    let junit = dam(&[&scenes[..], &["--form", "junit"]].concat());
    let junit = String::from_utf8(junit.stdout).unwrap();
    assert!(junit.starts_with("<?xml"), "{junit}");
    assert_eq!(junit.matches("<testcase ").count(), all.len());
    assert!(junit.contains(&format!(
        "<testsuites name=\"dam\" tests=\"{}\" failures=\"0\" errors=\"0\">",
        all.len()
    )));
    let text = String::from_utf8(dam(&scenes).stdout).unwrap();
    assert_eq!(
        text.matches("requirements hold.").count(),
        scenes.len(),
        "{text}"
    );
}

#[test]
fn what_fails_and_what_is_wrong_have_a_status_each() {
    let folder = tempfile::tempdir().unwrap();
    let failing = dam(&[ROCKER, "--set", "rocker.inertia=0.3", "--form", "junit"]);
    assert_eq!(failing.status.code(), Some(1));
    let text = String::from_utf8(failing.stdout).unwrap();
    assert!(text.contains("<failure "), "{text}");
    // In the words and units of the table.
    assert!(text.contains(", required "), "{text}");
    let table = dam(&[ROCKER, "--set", "rocker.inertia=0.3"]);
    let table = String::from_utf8(table.stdout).unwrap();
    for case in text.lines().filter_map(|line| line.split("name=\"").nth(2)) {
        let name = case.split('"').next().unwrap_or_default();
        assert!(table.contains(name), "{name}: {table}");
    }
    let wrong = folder.path().join("wrong.json");
    std::fs::write(
        &wrong,
        r#"{ "dam": 1, "objects": { "a": { "kind": "roker" } } }"#,
    )
    .unwrap();
    let several = dam(&[ROCKER, wrong.to_str().unwrap(), "--form", "junit"]);
    assert_eq!(several.status.code(), Some(2));
    let text = String::from_utf8(several.stdout).unwrap();
    assert!(
        text.contains("<error ") && text.contains("rocker.delta_max"),
        "{text}"
    );
    let silent = folder.path().join("silent.json");
    let scene = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/",
        "scenarios/rocker/two_masses.json"
    ));
    let mut scene: Value = serde_json::from_str(&scene.unwrap()).unwrap();
    scene.as_object_mut().unwrap().remove("expect");
    std::fs::write(&silent, scene.to_string()).unwrap();
    let silent = dam(&[silent.to_str().unwrap()]);
    assert_eq!(silent.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&silent.stderr).contains("expects"));
}

#[test]
fn a_range_is_one_requirement() {
    let folder = tempfile::tempdir().unwrap();
    let scene = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/",
        "scenarios/rocker/two_masses.json"
    ));
    let with = |expect: &str| {
        let mut scene: Value = serde_json::from_str(scene.as_ref().unwrap()).unwrap();
        scene["expect"] = serde_json::from_str(expect).unwrap();
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        dam(&[path.to_str().unwrap()])
    };
    let range = with(r#"[{ "figure": "rocker.delta_abs", "between": ["7 mrad", "8 mrad"] }]"#);
    assert_eq!(range.status.code(), Some(0));
    let text = String::from_utf8(range.stdout).unwrap();
    assert!(text.contains("between 0.4011 deg and 0.4584 deg"), "{text}");
    let outside = with(r#"[{ "figure": "rocker.delta_abs", "between": ["8 mrad", "9 mrad"] }]"#);
    assert_eq!(outside.status.code(), Some(1));
    for wrong in [
        r#"[{ "figure": "rocker.delta_abs", "between": ["9 mrad", "8 mrad"] }]"#,
        r#"[{ "figure": "rocker.delta_abs", "between": ["7 mrad", "8 mrad"], "at_most": 1 }]"#,
        r#"[{ "figure": "rocker.delta_abs", "between": ["7 mm", "8 mm"] }]"#,
        r#"[{ "figure": "rocker.delta_abs", "between": ["7 mrad"] }]"#,
    ] {
        assert_eq!(with(wrong).status.code(), Some(2), "{wrong}");
    }
}

/// A part of the motion is part of the name of a requirement, in the table and in JUnit; other
/// commands leave such figures of studies to this one.
#[test]
fn a_part_of_the_motion_is_named_in_every_form() {
    let scene = "scenarios/loads/ram_over_machine_angle.json";
    let name = "ram.peak_speed from 300 deg to 315 deg";
    for form in [&["--form", "junit"][..], &["--json"], &[]] {
        let output = dam(&[&[scene], form].concat());
        assert_eq!(output.status.code(), Some(0));
        let shown = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(shown.contains(name), "{form:?}: {shown}");
    }
    let text = std::fs::read_to_string(CRANK).unwrap();
    let mut crank: Value = serde_json::from_str(&text).unwrap();
    crank["expect"] = serde_json::json!([{
        "figure": "kinematics.mechanism.slide.displacement.greatest",
        "over": { "from": "30 deg", "to": "120 deg" }, "at_most": 0.35,
    }]);
    let file = std::env::temp_dir().join(format!("dam-over-{}.json", std::process::id()));
    std::fs::write(&file, crank.to_string()).unwrap();
    let file = file.to_str().unwrap();
    let failing = dam(&[file]);
    let shown = String::from_utf8_lossy(&failing.stdout).into_owned();
    assert_eq!(failing.status.code(), Some(1), "{shown}");
    assert!(
        shown.contains("displacement.greatest from 30 deg to 120 deg"),
        "{shown}"
    );
    let kinematics = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["kinematics", file])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&kinematics.stderr).into_owned();
    assert_eq!(kinematics.status.code(), Some(0), "{said}");
    assert!(said.contains("`dam verify` judges them"), "{said}");
    std::fs::remove_file(file).unwrap();
}

#[test]
fn forces_that_leave_out_a_load_are_not_judged() {
    let scene = std::fs::read_to_string("scenarios/linkages/toggle_press.json").unwrap();
    let mut scene: Value = serde_json::from_str(&scene).unwrap();
    scene["objects"]["press"]["from"] = "linkage/toggle-press".into();
    scene["expect"] = serde_json::json!([
        { "figure": "forces.press.drive.greatest", "at_most": "500 N m" },
        { "figure": "kinematics.press.ram.speed.greatest", "at_most": 9 },
    ]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let path = path.to_str().unwrap();
    let output = dam(&[path, "--json"]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let requirements = &found["scenes"][0]["requirements"];
    // Without a part of the loads there is nothing to judge.
    let why = requirements[0]["not_judged"].as_str().unwrap();
    assert!(why.contains("what the linkage drives (tool)"), "{why}");
    assert_eq!(requirements[1]["holds"], true);
    assert_eq!(output.status.code(), Some(1));
    // What `dam forces` says.
    let forces = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["forces", path])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let said = String::from_utf8(forces.stderr).unwrap();
    assert!(said.contains("what the linkage drives (tool)"), "{said}");
}
