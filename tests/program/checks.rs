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
