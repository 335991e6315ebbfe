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
        assert!(headline.ends_with(&format!(" {words}.")), "{headline}");
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
            .filter(|line| line.starts_with("  speed of shaft = "));
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
        let said = text(&run);
        let answer = said.lines().nth(1).unwrap();
        assert!(
            answer.starts_with("The run is not finished: it ended at t = "),
            "{answer}"
        );
        assert!(answer.ends_with(". Not judged."), "{answer}");
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

/// At a tolerance of 0.1 the bound of the check is wider than any defect: 65 separations are
/// missed, and nothing may certify that.
#[test]
fn a_tolerance_too_coarse_to_be_checked_certifies_nothing() {
    let run = |tolerance: &str| {
        let set = format!("run.tolerance={tolerance}");
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
            .args([
                "run",
                "scenarios/rocker/two_masses.json",
                "--json",
                "--set",
                &set,
            ])
            .args(["--set", "run.method=dop853"])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let separations = &found["objects"]["rocker"]["pair"]["separations"];
        (found["verdict"].clone(), separations.as_u64().unwrap())
    };
    let (coarse, few) = run("0.1");
    assert!(coarse != "in_working_order" && few < 65, "{coarse} {few}");
    assert_eq!(run("1e-6"), ("not_in_working_order".into(), 65));
}
