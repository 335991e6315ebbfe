//! Every check that the program prints has a bound, and beyond it the exit status is 1.

use serde_json::Value;
use std::process::{Command, Output};

/// Every command that computes a result, over scenes of several kinds.
const COMMANDS: &[&[&str]] = &[
    &["run", "scenarios/rocker/two_masses.json"],
    &["run", "scenarios/joint_friction/stick_slip.json"],
    &["run", "scenarios/limits/cylinder.json"],
    &["run", "scenarios/rigid/pump.json"],
    &[
        "compare",
        "scenarios/rocker/one_mass.json",
        "--over",
        "rocker.stiffness=2e6,3e6",
    ],
    &["steady", "scenarios/steady/press_flywheel.json"],
    &["steady", "scenarios/steady/press_motor.json"],
    &["steady", "scenarios/steady/press_elastic.json"],
    &["steady", "scenarios/rocker/one_mass.json"],
    &[
        "steady",
        "--inertia",
        "2 + cos(phi)",
        "--work",
        "30*sin(phi)",
        "--mean-speed",
        "10 rad/s",
    ],
    &["forces", "scenarios/kinetostatics/slider_crank.json"],
    &["forces", "scenarios/linkages/shaper.json"],
    &["forces", "scenarios/linkages/five_bar.json"],
    &["kinematics", "scenarios/kinetostatics/slider_crank.json"],
    &["kinematics", "scenarios/linkages/five_bar.json"],
    &["cam", "scenarios/cams/flat_tappet.json"],
    &[
        "law",
        "cycle",
        "scenarios/cams/flat_tappet.json",
        "--of",
        "valve",
    ],
    &["show", "scenarios/rocker/two_masses.json"],
    &[
        "map",
        "scenarios/rocker/one_mass.json",
        "--x",
        "rocker.stiffness=1e6:2e6:2",
    ],
    &[
        "methods",
        "scenarios/rocker/one_mass.json",
        "--methods",
        "exact,dop853",
        "--tolerances",
        "1e-6,1e-8",
        "--repeats",
        "1",
    ],
];

/// Words of a check. The line that has one needs a bound.
const OF_CHECKS: &[&str] = &[
    "energy error",
    "energy balance",
    "power balance",
    "balance of power",
    "equations of motion  ",
    "equation of motion",
    "influence coefficients",
    "return of the state",
    "comes back to",
    "closes to",
    "residual ",
    "defect",
    "mismatch",
    "discrepancy",
    "agree",
    " off at",
];

/// Lines that have such a word and show no check.
const EXEMPT: &[(&str, &str)] = &[
    ("Agreement", "the heading over the checks"),
    ("residual vibration", "a term of the field"),
    (
        "errors of δ",
        "the errors that `methods` measures are its answer",
    ),
    ("no two methods agree", "an answer of `methods`"),
];

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

#[test]
fn every_printed_check_has_a_bound() {
    let mut checks = 0;
    for command in COMMANDS {
        let text = String::from_utf8(dam(command).stdout).unwrap();
        assert!(!text.is_empty(), "{command:?}");
        for line in text.lines() {
            let exempt = EXEMPT.iter().any(|(words, _)| line.contains(words));
            if OF_CHECKS.iter().any(|words| line.contains(words)) && !exempt {
                assert!(line.contains("bound"), "{command:?} has no bound: {line}");
                checks += 1;
            }
        }
    }
    assert!(checks > 25, "{checks}");
}

/// All lists of checks in a document.
fn lists<'v>(value: &'v Value, found: &mut Vec<&'v Value>) {
    match value {
        Value::Object(entries) => {
            for (name, value) in entries {
                match name.as_str() {
                    "checks" => found.push(value),
                    _ => lists(value, found),
                }
            }
        }
        Value::Array(values) => values.iter().for_each(|value| lists(value, found)),
        _ => {}
    }
}

#[test]
fn documents_hold_checks_and_the_exit_status_follows_them() {
    for command in COMMANDS {
        if ["cam", "law", "show", "map", "methods"].contains(&command[0]) {
            // These print no check, or one of each run that they keep to themselves.
            continue;
        }
        let output = dam(&[command, &["--json"][..]].concat());
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let mut found = Vec::new();
        lists(&document, &mut found);
        assert!(!found.is_empty(), "{command:?} has no checks");
        let mut all_passed = true;
        for list in found {
            for check in list.as_array().unwrap() {
                let passed = check["passed"].as_bool().unwrap();
                let [value, bound] = ["value", "bound"].map(|name| check[name].as_f64());
                assert_eq!(
                    passed,
                    value.is_some_and(|value| value.abs() <= bound.unwrap()),
                    "{command:?} {check}"
                );
                assert!(check["name"].as_str().is_some_and(|name| !name.is_empty()));
                all_passed &= passed;
            }
        }
        assert!(all_passed, "{command:?}");
        if command[0] != "compare" {
            assert!(document["verdict"].is_string(), "{command:?}");
            assert_ne!(document["verdict"], "not_to_be_trusted", "{command:?}");
        }
        assert_eq!(output.status.code(), Some(0), "{command:?}");
    }
}

/// F·sin(Ωt) on a mass that a stiff link holds: it gives way by F/k, and its acceleration Ω²F/k is
/// what forces leave over that are far greater. The start leaves out what damping takes, which
/// stays as a vibration of the acceleration c·ΩF/(kJ).
#[test]
fn a_stiff_link_gets_one_verdict_from_every_command_and_the_truth_about_its_acceleration() {
    let (force, inertia, damping, rate) = (2.0, 0.05, 0.05, 6.0 * std::f64::consts::PI);
    for stiffness in [1e8, 1e12, 1e13, 1e14, 1e15, 1e16] {
        let scene = serde_json::json!({
            "dam": 1, "name": "t",
            "objects": {
                "d": { "kind": "drive", "motion": { "speed": "10 rad/s" } },
                "w": { "kind": "shaft", "input": "d", "masses": 1, "inertia": inertia,
                       "stiffness": stiffness, "damping": damping,
                       "loads": { "h": { "harmonic": { "amplitude": force, "frequency": "3 Hz" } } } }
            },
            "run": { "duration": 1 }
        });
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        let path = path.to_str().unwrap();
        let json = |arguments: &[&str]| -> serde_json::Value {
            let output = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
                .args(arguments)
                .args(["--json", "--quiet"])
                .output()
                .unwrap();
            serde_json::from_slice(&output.stdout).unwrap()
        };
        let found = json(&["run", path]);
        let by_name = json(&["run", path, "--set", "run.method=exact"]);
        let inertias = format!("w.inertia={inertia}:0.06:2");
        let map = json(&["map", path, "--x", &inertias]);
        assert_eq!(found["verdict"], "in_working_order", "{stiffness:e}");
        assert_eq!(by_name["verdict"], "in_working_order", "{stiffness:e}");
        assert_eq!(map["panels"][0]["judgements"][0], "in_working_order");
        let object = &found["objects"]["w"];
        let number = |name: &str| object[name].as_f64().unwrap();
        let close = |name: &str, wanted: f64| {
            let off = (number(name) / wanted - 1.0).abs();
            assert!(off < 1e-6, "{stiffness:e} {name}: {off:e}");
        };
        close("delta_abs", force / stiffness);
        close("peak_reaction", force);
        let warnings = found["warnings"].as_array().unwrap().iter();
        let mut told = warnings.filter_map(|text| {
            let (_, rest) = text.as_str()?.split_once("may alone change it by ")?;
            rest.split(' ').next()?.parse::<f64>().ok()
        });
        let rounding = told.next();
        assert_eq!(rounding.is_some(), stiffness > 2e13, "{stiffness:e}");
        let peak = number("peak_acceleration");
        let smooth = rate * rate * force / stiffness;
        let vibration = damping * rate * force / stiffness / inertia;
        let off = rounding.unwrap_or(0.01 * peak) + 1e-3 * smooth;
        let range = smooth - off..=smooth + vibration + off;
        assert!(
            range.contains(&peak),
            "{stiffness:e}: {peak:e} in {range:?}"
        );
    }
}

/// The assembly modes that `dam check` states of a scene.
fn assembly_modes(scene: &str, set: &[&str]) -> Vec<String> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dam"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    let output = command.args(["check", scene, "--json"]).args(set).output();
    let document: Value = serde_json::from_slice(&output.expect("dam").stdout).expect("JSON");
    let modes = document["assembly_modes"].as_array().expect("a list");
    let words = modes.iter().map(|mode| mode.as_str().expect("words"));
    words.map(str::to_owned).collect()
}

#[test]
fn the_other_assembly_mode_is_reached_as_check_says() {
    let toggle = "scenarios/linkages/toggle_press.json";
    let sley = "scenarios/four_bar/loom_sley.json";
    for (scene, index, hint, set, own, other) in [
        (
            "scenarios/linkages/slider_crank_spring.json",
            0,
            r#""assembly": { "slide": { "branch": "-" } }"#,
            r#"mechanism.assembly={ "slide": { "branch": "-" } }"#,
            "rod and slide are assembled on branch +",
            "rod and slide are assembled on branch -",
        ),
        // The scene chooses by the second link of the dyad.
        (
            toggle,
            1,
            r#""assembly": { "ram": { "branch": "-" } }"#,
            r#"press.assembly.ram={ "branch": "-" }"#,
            "lower and ram are assembled on branch +",
            "lower and ram are assembled on branch -",
        ),
        (
            sley,
            0,
            r#""four_bar": { …, "branch": "-" }"#,
            r#"sley.position.four_bar.branch="-""#,
            "the four_bar is assembled on branch +",
            "the four_bar is assembled on branch -",
        ),
    ] {
        let before = assembly_modes(scene, &[]);
        assert!(
            before[index].contains(own) && before[index].ends_with(hint),
            "{before:?}"
        );
        let after = assembly_modes(scene, &["--set", set]);
        assert!(after[index].contains(other), "{after:?}");
    }
    // A crank alone has one.
    assert!(assembly_modes("scenarios/rocker/one_mass.json", &[]).is_empty());
}
