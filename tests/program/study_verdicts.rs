//! Studies that are no run state the verdict of four values, and what they leave out.

use serde_json::Value;
use std::process::{Command, Output};

const ROCKER: &str = "scenarios/rocker/one_mass.json";

/// A command and what it answers: its verdict in JSON and in words, exit status, objects that
/// were taken for rigid.
type Study = (
    &'static [&'static str],
    &'static str,
    &'static str,
    i32,
    &'static [&'static str],
);

const CRANK: &str = "scenarios/kinetostatics/slider_crank.json";
const SPRING: &str = "scenarios/joint_friction/stick_slip.json";
const FOLLOWER: &str = "scenarios/cams/eccentric_jump.json";
const GOOD: (&str, &str) = ("in_working_order", "In working order.");
const BAD: (&str, &str) = ("not_in_working_order", "Not in working order.");
const OPEN: (&str, &str) = ("not_judged", "Not judged.");
const WRONG: (&str, &str) = ("not_to_be_trusted", "Not to be trusted.");

const STUDIES: &[Study] = &[
    (&["kinematics", CRANK], GOOD.0, GOOD.1, 0, &[]),
    (
        &["kinematics", "scenarios/limits/short_rod.json"],
        BAD.0,
        BAD.1,
        1,
        &[],
    ),
    (&["kinematics", SPRING], OPEN.0, OPEN.1, 0, &["spring"]),
    (
        &["kinematics", CRANK, "--speed", "1e200 rad/s"],
        WRONG.0,
        WRONG.1,
        1,
        &[],
    ),
    (&["forces", CRANK], GOOD.0, GOOD.1, 0, &[]),
    (&["forces", SPRING], OPEN.0, OPEN.1, 0, &["spring"]),
    (
        &["forces", CRANK, "--speed", "1e150 rad/s"],
        WRONG.0,
        WRONG.1,
        1,
        &[],
    ),
    (
        &["steady", "scenarios/steady/press_motor.json"],
        GOOD.0,
        GOOD.1,
        0,
        &[],
    ),
    (
        &["steady", "scenarios/rocker/ten_masses_closed.json"],
        GOOD.0,
        GOOD.1,
        0,
        &[],
    ),
    (&["steady", ROCKER], BAD.0, BAD.1, 0, &[]),
    // Nothing damps it: from its own start it goes on beside the periodic motion.
    (
        &["steady", "scenarios/indexing/residual_vibration.json"],
        OPEN.0,
        "on which the scene does not settle from its own start",
        0,
        &[],
    ),
    // Its pair stays closed, and its long run ends early.
    (
        &["steady", "scenarios/valve_train/valve_lash.json"],
        OPEN.0,
        "its long run ended early",
        0,
        &[],
    ),
    (
        &[
            "steady",
            "--inertia",
            "2",
            "--work",
            "30*sin(phi)",
            "--mean-speed",
            "10 rad/s",
        ],
        GOOD.0,
        GOOD.1,
        0,
        &[],
    ),
    (
        &["cam", "scenarios/cams/flat_tappet.json"],
        GOOD.0,
        GOOD.1,
        0,
        &[],
    ),
    (&["cam", FOLLOWER], BAD.0, BAD.1, 0, &["follower"]),
    (
        &["cam", FOLLOWER, "--reserve", "0"],
        OPEN.0,
        OPEN.1,
        0,
        &["follower"],
    ),
    (
        &[
            "cam",
            FOLLOWER,
            "--reserve",
            "0",
            "--speed",
            "40 rpm",
            "--lift-off",
        ],
        GOOD.0,
        GOOD.1,
        0,
        &["follower"],
    ),
    (
        &[
            "cam",
            FOLLOWER,
            "--reserve",
            "0",
            "--speed",
            "60 rpm",
            "--lift-off",
        ],
        BAD.0,
        BAD.1,
        0,
        &["follower"],
    ),
    (
        &[
            "methods",
            ROCKER,
            "--methods",
            "exact,dop853",
            "--tolerances",
            "1e-6",
            "--repeats",
            "1",
            "--set",
            "run.duration=0.02",
        ],
        OPEN.0,
        "The mechanism is not judged.",
        0,
        &[],
    ),
];

#[test]
fn studies_that_are_no_run_state_the_same_verdict_in_every_output() {
    for (command, name, words, code, without) in STUDIES {
        let output = dam(command[0], &command[1..], &[]);
        assert_eq!(output.status.code(), Some(*code), "{command:?}");
        let said = text(&output);
        let answer = said.lines().nth(1).unwrap();
        assert!(answer.contains(words), "{command:?}: {answer}");
        let json = dam(command[0], &command[1..], &["--json"]);
        let document = json_of(&json);
        assert_eq!(document["verdict"], *name, "{command:?}");
        let label = &document["rigid"];
        match without.is_empty() {
            true => assert!(label.is_null(), "{command:?}: {label}"),
            false => {
                assert_eq!(label["without"], serde_json::json!(without), "{command:?}");
                assert_eq!(label["included_by"][0], "dam run", "{command:?}");
            }
        }
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        dam(command[0], &command[1..], &["--out", out.to_str().unwrap()]);
        let page = std::fs::read_to_string(out.join("report.html")).unwrap();
        assert!(page.contains(words), "{command:?}");
        let saved = std::fs::read(out.join(format!("{}.json", command[0]))).unwrap();
        let saved: Value = serde_json::from_slice(&saved).unwrap();
        assert_eq!(saved["verdict"], *name, "{command:?}");
    }
}

/// A study that does not look at the pairs does not certify them.
#[test]
fn a_steady_motion_of_rigid_objects_leaves_their_pairs_open() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/steady/press_motor.json"
    ));
    let mut scene: Value = serde_json::from_str(&text.unwrap()).unwrap();
    let drive = scene["objects"].as_object().unwrap();
    let is_drive = |one: &(&String, &Value)| one.1["kind"] == "drive";
    let drive = drive.iter().find(is_drive).unwrap().0.clone();
    scene["objects"]["tappet"] = serde_json::json!({
        "kind": "cam_follower",
        "input": drive,
        "motion": "sliding",
        "position": { "sine": { "amplitude": "1 mm" } },
        "inertia": "0.01 kg",
        "masses": 0,
        "loads": { "spring": { "constant": "-1000 N" } },
    });
    scene.as_object_mut().unwrap().remove("expect");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let path = path.to_str().unwrap();
    let output = dam("steady", &[path], &["--json"]);
    assert_eq!(json_of(&output)["verdict"], "not_judged");
    let said = self::text(&dam("steady", &[path], &[]));
    let words = "Whether the contact of tappet separates is judged by `dam run` alone.";
    assert!(said.contains(words), "{said}");
}

fn dam(command: &str, scene: &[&str], more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg(command)
        .args(scene)
        .args(more)
        .arg("-q")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn json_of(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

fn text(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}
