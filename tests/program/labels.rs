//! What a result is computed without is stated: elastic objects, conditions that end runs, and
//! errors relative to zero.

use serde_json::Value;
use std::process::{Command, Output};

const SPRING: &str = "scenarios/joint_friction/stick_slip.json";
const FOLLOWER: &str = "scenarios/cams/eccentric_jump.json";

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn text(arguments: &[&str]) -> String {
    String::from_utf8(dam(arguments).stdout).unwrap()
}

fn json_of(arguments: &[&str]) -> Value {
    serde_json::from_slice(&dam(&[arguments, &["--json"]].concat()).stdout).unwrap()
}

fn page(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    dam(&[arguments, &["-q", "--out", out.to_str().unwrap()]].concat());
    std::fs::read_to_string(out.join("report.html")).unwrap()
}

#[test]
fn results_without_elastic_objects_are_labelled_rigid() {
    let follower = ["compare", FOLLOWER, "--over", "follower.stiffness=1e6,2e6"];
    let figure = ["--figure", "cam.follower.greatest_pressure_angle"];
    let compare = [&follower[..], &figure].concat();
    let commands: [(&[&str], &str); 4] = [
        (&["kinematics", SPRING], "spring"),
        (&["forces", SPRING], "spring"),
        (&["cam", FOLLOWER], "follower"),
        (&compare, "follower"),
    ];
    for (command, id) in commands {
        let label = format!("computed without the elasticity of {id}; ");
        for said in [text(command), page(command)] {
            let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(said.to_lowercase().contains("rigid: "), "{command:?}");
            assert!(said.contains(&label), "{command:?}: {label}");
            let after = said.split(&label).nth(1).unwrap();
            assert!(
                after.split('.').next().unwrap().contains("dam run"),
                "{command:?}"
            );
        }
        let document = json_of(command).to_string();
        assert!(document.contains(&label) || document.contains("\"included_by\":[\"dam run\"]"));
        assert!(document.contains(&format!("[\"{id}\"]")) || document.contains(&label));
    }
    // Every document that has a label has it by the same name.
    let map = [
        "map",
        FOLLOWER,
        "--x",
        "follower.stiffness=1e6:2e6:2",
        "--figure",
        "cam.follower.greatest_pressure_angle",
    ];
    let said = text(&map);
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("greatest_pressure_angle is computed without the elasticity of follower; "),
        "{said}"
    );
    assert!(page(&map).contains("computed without the elasticity of follower"));
    for command in commands.iter().map(|one| one.0).chain([&map[..]]) {
        let label = &json_of(command)["rigid"];
        assert_eq!(label["included_by"][0], "dam run", "{command:?}");
        assert_eq!(label["without"].as_array().unwrap().len(), 1, "{command:?}");
    }
    // The same over masses: rigid at the first value only.
    let masses = [&map[..3], &["follower.masses=0:2:3"], &map[4..]].concat();
    assert_eq!(json_of(&masses)["rigid"]["without"][0], "follower");
    // Nothing elastic, or nothing rigid: no label.
    let crank = "scenarios/kinetostatics/slider_crank.json";
    for command in [&["kinematics", crank][..], &["forces", crank], &follower] {
        assert!(
            !text(command).contains("without the elasticity"),
            "{command:?}"
        );
        assert!(
            !json_of(command).to_string().contains("elasticity"),
            "{command:?}"
        );
    }
}

#[test]
fn a_run_labels_its_results_of_rigid_studies() {
    let text = std::fs::read_to_string(format!("{}/{FOLLOWER}", env!("CARGO_MANIFEST_DIR")));
    let mut scene: Value = serde_json::from_str(&text.unwrap()).unwrap();
    let expected = |figure: &str| serde_json::json!([{ "figure": figure, "at_least": 0 }]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    let mut label = |figure: &str| {
        scene["expect"] = expected(figure);
        std::fs::write(&path, scene.to_string()).unwrap();
        json_of(&["run", path.to_str().unwrap()])
    };
    let found = label("cam.follower.greatest_contact_force");
    assert_eq!(found["rigid"]["without"][0], "follower");
    let words = "cam.follower.greatest_contact_force is computed without the elasticity";
    assert!(found["warnings"].to_string().contains(words), "{found}");
    assert!(label("follower.delta_abs")["rigid"].is_null());
}

#[test]
fn a_condition_that_ends_runs_is_stated_where_it_has_no_effect() {
    let crank = "scenarios/kinetostatics/slider_crank.json";
    let engine = "scenarios/steady/press_motor.json";
    for (command, scene, of) in [
        ("kinematics", crank, "mechanism.slide"),
        ("forces", crank, "mechanism.slide"),
        ("steady", engine, ""),
    ] {
        let text = std::fs::read_to_string(format!("{}/{scene}", env!("CARGO_MANIFEST_DIR")));
        let mut given: Value = serde_json::from_str(&text.unwrap()).unwrap();
        let objects = given["objects"].as_object().unwrap();
        let first = objects.keys().next().unwrap().clone();
        let of = if of.is_empty() { first } else { of.to_owned() };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        let said = |given: &Value| {
            std::fs::write(&path, given.to_string()).unwrap();
            let output = dam(&[command, path.to_str().unwrap()]);
            let error = String::from_utf8(output.stderr).unwrap();
            assert!(!output.stdout.is_empty(), "{command}: {error}");
            error.contains("`run.until` has no effect")
        };
        assert!(!said(&given), "{command}");
        given["run"]["until"] = serde_json::json!({ "of": of, "condition": "phi > 1000" });
        assert!(said(&given), "{command}");
        let document = json_of(&[command, path.to_str().unwrap()]);
        assert!(
            document["warnings"].to_string().contains("run.until"),
            "{command}"
        );
    }
}

#[test]
fn no_error_is_relative_to_zero() {
    let scene = "scenarios/rocker/ten_masses_closed.json";
    for figure in ["rocker.pair.separated_time", "shaft.peak_acceleration"] {
        let asked = format!("{figure}=1 %");
        let command = ["run", scene, "--accuracy", &asked];
        let said = text(&command);
        assert!(!said.contains("± 0"), "{said}");
        assert!(
            said.contains("zero within the resolution of the run"),
            "{said}"
        );
        let accuracy = &json_of(&command)["accuracy"][figure];
        assert_eq!(accuracy["value"], 0.0);
        assert!(accuracy["relative"].is_null(), "{accuracy}");
        assert!(accuracy["asked"].as_f64().unwrap() > 0.0, "{accuracy}");
        assert_eq!(accuracy["holds"], true, "{accuracy}");
    }
}
