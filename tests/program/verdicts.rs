//! One verdict of four values: every output of a scene states the same one.

use serde_json::Value;
use std::process::{Command, Output};

const ROCKER: &str = "scenarios/rocker/one_mass.json";

/// Name in JSON, words in texts, sort on a page, exit status, and the scene with its settings.
type Case = (
    &'static str,
    &'static str,
    &'static str,
    i32,
    [&'static str; 5],
);

const CASES: [Case; 4] = [
    (
        "in_working_order",
        "In working order",
        "good",
        0,
        [
            "scenarios/rocker/ten_masses_closed.json",
            "--set",
            "run.duration=0.4",
            "--set",
            "run.samples=100",
        ],
    ),
    (
        "not_in_working_order",
        "Not in working order",
        "mechanism",
        0,
        [
            ROCKER,
            "--set",
            "run.duration=0.4",
            "--set",
            "run.samples=100",
        ],
    ),
    (
        "not_judged",
        "Not judged",
        "unfinished",
        0,
        [
            ROCKER,
            "--set",
            "run.duration=0.1",
            "--set",
            "run.samples=100",
        ],
    ),
    (
        "not_to_be_trusted",
        "Not to be trusted",
        "numerical",
        1,
        [
            ROCKER,
            "--set",
            "run.method=rk4",
            "--set",
            "run.step=0.0002",
        ],
    ),
];

const VALUES: [&str; 2] = ["6.2831", "6.2832"];
const PARAMETER: &str = "shaft.motion.speed";

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

#[test]
fn every_output_states_the_same_verdict() {
    for (name, words, sort, code, scene) in CASES {
        let run = dam("run", &scene, &[]);
        assert_eq!(run.status.code(), Some(code), "{name}");
        let headline = text(&run);
        let headline = headline.lines().nth(1).unwrap();
        assert!(headline.starts_with(&format!("{words}. ")), "{headline}");
        let document = json_of(&dam("run", &scene, &["--json"]));
        assert_eq!(document["verdict"], name);
        let passed = |check: &Value| check["passed"] == true;
        let checks = document["checks"].as_array().unwrap();
        assert_eq!(checks.iter().all(passed), code == 0, "{name}");
        // The table of pairs has the verdict of each pair.
        let table = table_of_pairs(&text(&run));
        let said = match name {
            "in_working_order" => "yes",
            "not_in_working_order" => "NO",
            "not_judged" => "not judged",
            _ => "not to be trusted",
        };
        assert!(table.contains(said), "{name}: {table}");

        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        dam("run", &scene, &["--out", out.to_str().unwrap()]);
        let page = std::fs::read_to_string(out.join("report.html")).unwrap();
        let answer = format!("class=\"verdict {sort}\"");
        assert!(page.contains(&answer), "{name}: {answer}");
        let saved = std::fs::read(out.join("summary.json")).unwrap();
        let saved: Value = serde_json::from_slice(&saved).unwrap();
        assert_eq!(saved["verdict"], name);
    }
}

fn table_of_pairs(text: &str) -> String {
    let mut lines = text
        .lines()
        .skip_while(|line| !line.starts_with("Driving pairs"));
    lines.nth(2).unwrap_or_default().to_owned()
}

#[test]
fn comparisons_and_maps_state_the_verdicts_of_their_runs() {
    for (name, words, _, code, scene) in CASES {
        let speed = 10.0;
        let [from, to] = VALUES.map(|value| value.parse::<f64>().unwrap() * speed);
        let over = format!("{PARAMETER}={from},{to}");
        let compared = dam("compare", &scene, &["--over", &over]);
        assert_eq!(compared.status.code(), Some(code), "{name}");
        let rows = text(&compared);
        let rows = rows
            .lines()
            .filter(|line| line.starts_with("  shaft.motion"));
        let rows: Vec<&str> = rows.filter(|line| line.contains(words)).collect();
        assert_eq!(rows.len(), 2, "{name}: {}", text(&compared));
        let document = json_of(&dam("compare", &scene, &["--over", &over, "--json"]));
        let axis = format!("{PARAMETER}={from}:{to}:2");
        let map = json_of(&dam("map", &scene, &["--x", &axis, "--json"]));
        let judgements = map["panels"][0]["judgements"].as_array().unwrap();
        assert_eq!(judgements.len(), 2);
        for (place, value) in [from, to].into_iter().enumerate() {
            let value = format!("{PARAMETER}={value}");
            let run = dam("run", &scene, &["--set", &value, "--json"]);
            assert_eq!(json_of(&run)["verdict"], name);
            assert_eq!(document["runs"][place]["verdict"], name);
            assert_eq!(judgements[place], name);
        }
    }
}

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
    let words = "Whether the pair of tappet opens is judged by `dam run` alone.";
    assert!(said.contains(words), "{said}");
}

/// Nothing wrong was found of a run that spent its budget; it does not answer either.
#[test]
fn a_run_that_spent_its_budget_is_not_judged_in_any_output() {
    for method in ["exact", "dop853"] {
        let method = format!("run.method={method}");
        let scene = [
            "scenarios/rocker/two_masses.json",
            "--set",
            "run.max_switches=5",
            "--set",
            &method,
        ];
        let run = dam("run", &scene, &[]);
        assert_eq!(run.status.code(), Some(1));
        let headline = "Not judged. The run is not finished: it ended at t = ";
        assert!(text(&run).contains(headline), "{}", text(&run));
        let document = json_of(&dam("run", &scene, &["--json"]));
        assert_eq!(document["verdict"], "not_judged");
        assert_eq!(document["run"]["stopped"], "too_many_switches");
        let over = format!("{PARAMETER}=62.831,62.832");
        let compared = json_of(&dam("compare", &scene, &["--over", &over, "--json"]));
        let axis = format!("{PARAMETER}=62.831:62.832:2");
        let map = json_of(&dam("map", &scene, &["--x", &axis, "--json"]));
        let panel = &map["panels"][0];
        for place in 0..2 {
            assert_eq!(compared["runs"][place]["verdict"], "not_judged");
            assert_eq!(panel["judgements"][place], "not_judged");
            assert_eq!(panel["verdicts"][place], "not_finished");
            assert!(panel["values"][place].is_null());
        }
        let said = text(&dam("map", &scene, &["--x", &axis]));
        assert!(said.contains("2 are not judged."), "{said}");
        assert!(!said.contains("not to be trusted"), "{said}");
    }
}
