//! Lists and ranges carry units.

use super::{ROCKER, VALVE, dam, json_of, text};
use serde_json::Value;
use serde_json::json;

#[test]
fn a_unit_after_a_list_is_that_of_all_its_values() {
    let run = |over: &str| json_of(&["compare", VALVE, "--over", over, "--json", "-q"]);
    let short = run("valve.stiffness=5,10,20 kN/mm");
    let long = run("valve.stiffness=5 kN/mm,10 kN/mm,20 kN/mm");
    assert_eq!(short["table"], long["table"]);
    assert_eq!(
        short["table"]["labels"],
        json!(["5 kN/mm", "10 kN/mm", "20 kN/mm"])
    );
    // 5 kN/mm = 5e6 N/m and so on, by numbers without a unit.
    let plain = run("valve.stiffness=5e6,1e7,2e7");
    assert_eq!(short["table"]["rows"], plain["table"]["rows"]);
}

#[test]
fn a_list_in_which_a_unit_may_mean_two_things_is_refused() {
    let scene = "scenarios/kinetostatics/slider_crank.json";
    for arguments in [
        vec!["compare", VALVE, "--over", "valve.stiffness=5 kN/mm,10"],
        vec!["map", VALVE, "--x", "camshaft.motion.speed=500 rpm:900:3"],
        vec![
            "map",
            VALVE,
            "--x",
            "camshaft.motion.speed=500:900 rpm:3",
            "--panels",
            "valve.stiffness=5 kN/mm,10",
        ],
        vec![
            "methods",
            VALVE,
            "--x",
            "camshaft.motion.speed=500 rpm:900:3",
        ],
        vec!["kinematics", scene, "--range", "10 deg:90"],
        vec!["forces", scene, "--range", "10 deg:90"],
    ] {
        let output = dam(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = text(&output.stderr);
        assert!(said.contains("has no unit"), "{arguments:?}: {said}");
    }
}

#[test]
fn both_ends_of_a_range_are_in_the_unit_after_the_last() {
    let scene = "scenarios/kinetostatics/slider_crank.json";
    let rows = |range: &str| {
        let output = dam(&[
            "kinematics",
            scene,
            "--range",
            range,
            "--positions",
            "4",
            "--csv",
        ]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let wanted = rows("10 deg:90 deg");
    assert_eq!(rows("10:90 deg"), wanted);
    assert_eq!(rows("10:90°"), wanted);
}

#[test]
fn figures_of_comparisons_carry_their_units() {
    let over = "rocker.masses=1,2";
    let settings = ["--set", "run.duration=0.02"];
    let with = |more: &[&str]| {
        let mut all = vec!["compare", ROCKER, "--over", over];
        all.extend(settings);
        all.extend(more);
        all.into_iter().map(str::to_owned).collect::<Vec<_>>()
    };
    let called = |arguments: &[String]| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        text(&dam(&arguments).stdout)
    };
    let table = called(&with(&["-q"]));
    let line = |figure: &str| {
        let of_rocker = |line: &&str| !line.starts_with("Results of rocker");
        let mut rows = table.lines().skip_while(of_rocker);
        let found = rows.find(|line| line.trim_start().starts_with(figure));
        found
            .unwrap_or_else(|| panic!("{figure}: {table}"))
            .to_owned()
    };
    assert!(line("greatest |δ| ").contains("0.003438 deg"), "{table}");
    assert!(line("peak acceleration ").contains(" rad/s² "), "{table}");
    assert!(line("peak reaction ").contains("N m "), "{table}");
    let document: Value = serde_json::from_str(&called(&with(&["-q", "--json"]))).unwrap();
    let rows = document["table"]["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["figure"] == "rocker.peak_speed");
    assert_eq!(row.unwrap()["unit"], "rad/s");
}
