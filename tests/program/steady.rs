//! `dam steady` as a program: its sources, forms, files and ends.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("steady")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn document(arguments: &[&str]) -> Value {
    let output = dam(arguments);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn refused(arguments: &[&str], words: &str) {
    let output = dam(arguments);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
    assert!(errors.contains(words), "{arguments:?}: {errors}");
    assert!(output.stdout.is_empty());
}

fn near(value: &Value, expected: f64) {
    approx::assert_relative_eq!(value.as_f64().unwrap(), expected, max_relative = 1e-9);
}

const SINE: [&str; 6] = [
    "--inertia",
    "2",
    "--work",
    "30*sin(phi)",
    "--mean-speed",
    "10 rad/s",
];

#[test]
fn expressions_and_tables_answer_as_documents() {
    let found = document(&[&SINE[..], &["--json"]].concat());
    near(
        &found["rigid_motion"]["figures"]["energy_at_start"],
        103.342_352_430_808_92,
    );
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("machine.csv");
    let rows = (0..72).map(|k| {
        let phi = f64::from(k) * 5.0;
        format!("{phi},2,{}\n", 30.0 * phi.to_radians().sin())
    });
    let text = format!("phi [deg],J,A\n{}", rows.collect::<String>());
    std::fs::write(&table, text).unwrap();
    let path = table.to_str().unwrap();
    let found = document(&[
        "--table",
        path,
        "--mean-speed",
        "10",
        "--json",
        "--mean",
        "angle",
    ]);
    near(
        &found["rigid_motion"]["energy_at_start"],
        101.133_075_096_338_74,
    );
    assert!(found["rigid_motion"]["halving"]["period"].is_number());
}

#[test]
fn a_scene_keeps_its_expectations_and_writes_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("engine");
    let scene = "scenarios/steady/engine.json";
    let output = dam(&[scene, "--out", out.to_str().unwrap()]);
    assert!(output.status.success());
    let talk = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(talk.contains("expectations: 8 of 8 hold"), "{talk}");
    let file = |name: &str| std::fs::read_to_string(Path::new(&out).join(name)).unwrap();
    let summary: Value = serde_json::from_str(&file("steady.json")).unwrap();
    near(&summary["rigid_motion"]["figures"]["means"]["time"], 200.0);
    assert_eq!(file("steady.csv").lines().count(), 362);
    let report = file("report.html");
    for word in ["Energy-mass diagram", "ω_max", "O₂", "Agreement"] {
        assert!(report.contains(word), "{word}");
    }
    assert!(!report.contains("NaN"));
    let csv = String::from_utf8(dam(&[scene, "--form", "csv", "-q"]).stdout).unwrap();
    assert_eq!(csv, file("steady.csv"));
    let svg = String::from_utf8(dam(&[scene, "--form", "svg", "-q"]).stdout).unwrap();
    assert!(svg.starts_with("<svg"));
}

#[test]
fn an_elastic_scene_answers_with_its_multipliers() {
    let found = document(&["scenarios/valve_train/lift_off.json", "--json"]);
    let part = &found["periodic"]["parts"][0];
    assert_eq!(part["stability"], "attracts");
    assert_eq!(part["long_run"]["settles"], true);
    assert_eq!(part["orbit"][0][1].as_array().unwrap().len(), 721);
}

#[test]
fn functions_of_half_the_angle_make_a_cycle_of_two_turns() {
    let of = |inertia: &str, moment: &str, rest: &[&str]| {
        let own = ["--inertia", inertia, "--moment", moment, "--json"];
        document(&[&own[..], &["--mean-speed", "300 rpm"], rest].concat())
    };
    let turn = std::f64::consts::TAU;
    for (inertia, moment) in [("1.5", "12*cos(phi/2)"), ("1.5+0.5*cos(phi/2)", "0")] {
        let found = of(inertia, moment, &[]);
        let found = &found["rigid_motion"];
        near(&found["cycle"], 2.0 * turn);
        let asked = of(inertia, moment, &["--cycle", "720 deg"]);
        let asked = &asked["rigid_motion"]["figures"];
        near(
            &found["figures"]["fluctuation"],
            asked["fluctuation"].as_f64().unwrap(),
        );
    }
    // Without forces J·ω² stays: (ω_max/ω_min)² = 2/1.
    let found = &of("1.5+0.5*cos(phi/2)", "0", &[])["rigid_motion"]["figures"];
    let [least, greatest] = ["least_speed", "greatest_speed"].map(|name| &found[name]["value"]);
    let least = least.as_f64().unwrap();
    near(greatest, least * 2.0f64.sqrt());
    for (inertia, moment) in [("1.5", "cos(sqrt(2)*phi)"), ("1.5+0.01*phi", "0")] {
        let rest = ["--mean-speed", "300 rpm", "--balance"];
        let asked = ["--inertia", inertia, "--moment", moment];
        refused(&[&asked[..], &rest[..]].concat(), "does not repeat");
    }
}

#[test]
fn what_cannot_be_answered_ends_with_status_2_and_the_reason() {
    let engine = "scenarios/steady/engine.json";
    refused(&[engine, "--set", "steady.balance=false"], "gains speed");
    refused(
        &[engine, "--mean-speed", "120 rad/s", "--mean", "angle"],
        "lowest mean is",
    );
    refused(&[engine, "--mean-speed", "10 Hz"], "angular speed");
    refused(&[engine, "--fluctuation", "3"], "fluctuation");
    refused(
        &["--inertia", "2", "--mean-speed", "10"],
        "--work or --moment",
    );
    refused(
        &["--inertia", "2", "--work", "sin(psi)", "--mean-speed", "10"],
        "psi",
    );
    refused(
        &["--inertia", "cos(phi)", "--work", "0", "--mean-speed", "10"],
        "above zero",
    );
    refused(&SINE[..4], "no mean speed");
    refused(
        &["--table", "no such file", "--mean-speed", "10"],
        "cannot read",
    );
    refused(
        &["scenarios/joint_friction/press_runs_out.json"],
        "the joints of `press` have friction",
    );
    refused(&[], "SCENE");
}

/// 900 kN over the last 20 mm take 18 kJ, where the motor's 800 N·m do 5 kJ in a turn; 130 kN
/// are too much for what its rotor stores.
#[test]
fn a_motor_that_stalls_behind_elastic_objects_is_refused_with_the_reason() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let press = std::fs::read_to_string(root.join("scenarios/steady/press_elastic.json")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("press.json");
    for force in ["-130 kN", "-900 kN"] {
        std::fs::write(&scene, press.replace("-90 kN", force)).unwrap();
        refused(
            &[scene.to_str().unwrap()],
            "what drives it is too weak for what it carries",
        );
    }
}

/// Little inertia and a low mean speed: the equation of motion confirms what is found, though
/// the machine almost stops.
#[test]
fn a_machine_that_almost_stops_is_confirmed_and_warned_of() {
    for speed in ["12 rad/s", "13 rad/s", "18 rad/s"] {
        let set = format!("drive.motion.speed=\"{speed}\"");
        let scene = "scenarios/kinetostatics/slotted_lever.json";
        let found = document(&[scene, "--json", "--set", &set]);
        let text = found.to_string();
        assert_eq!(text.contains("almost stops"), speed != "18 rad/s", "{text}");
    }
}

/// A ram leaves its rigid stop in every turn with neither distance nor speed, and the long run gets
/// over that.
#[test]
fn a_machine_settles_on_its_motion_beside_a_rigid_stop() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stop.json");
    let scene = r#"{ "dam": 1, "name": "Ram on a stop", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "600 rpm" } },
        "ram": { "kind": "slider", "input": "shaft", "masses": 1, "inertia": "1 kg",
            "stiffness": "40 N/mm", "damping_capacity": 0.3,
            "position": { "sine": { "amplitude": "10 mm", "phase": "-90 deg", "offset": "10 mm" } },
            "stops": { "seat": { "at": "19 mm", "side": "+", "contact": { "restitution": 0.4 } } } } },
        "run": { "duration": 1 } }"#;
    std::fs::write(&path, scene).unwrap();
    let output = dam(&[path.to_str().unwrap()]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("start settle on it"), "{text}");
    assert!(text.contains("In working order"), "{text}");
}
