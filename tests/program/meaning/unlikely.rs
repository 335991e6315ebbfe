//! What is likely not meant is warned of.

use super::{Written, json_of};
use serde_json::Value;
use serde_json::json;
use std::path::Path;

/// A crank that goes from 0 to 90 deg, a slider with a load over it.
fn press(load: Value) -> Value {
    json!({
        "dam": 1,
        "name": "press",
        "objects": {
            "crank": { "kind": "drive", "motion": { "speed": "0.25 rev/s" } },
            "ram": {
                "kind": "slider", "input": "crank", "inertia": "2 kg", "stiffness": "20 kN/mm",
                "damping_capacity": 0.2, "masses": 1,
                "position": { "sine": { "amplitude": "40 mm" } },
                "loads": { "cutting": load }
            }
        },
        "run": { "duration": 1 }
    })
}

/// Warnings of `check` and of `run --json`, which are the same.
fn warnings(scene: &Value, settings: &[&str]) -> Vec<String> {
    let written = Written::new(scene);
    let mut arguments = vec!["run", written.path(), "--json", "-q"];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let run = json_of(&arguments);
    let list = |value: &Value| -> Vec<String> {
        let texts = value.as_array().unwrap().iter();
        texts
            .map(|text| text.as_str().unwrap().to_owned())
            .collect()
    };
    let found = list(&run["warnings"]);
    arguments[0] = "check";
    let document = json_of(&arguments);
    let check = list(&document["remarks"]);
    // Under the name that `run` has for them they are there too, beside what is doubtful
    // in the text.
    let named = document["warnings"].as_array().unwrap().iter();
    let named: Vec<&str> = (named.map(|one| one["message"].as_str().unwrap())).collect();
    assert!(check.iter().all(|text| named.contains(&text.as_str())));
    let meant = |text: &&String| text.contains("never") || text.contains("unit");
    let of = |all: &[String]| all.iter().filter(meant).cloned().collect::<Vec<_>>();
    assert_eq!(of(&found), of(&check));
    found
}

#[test]
fn a_window_or_table_that_is_never_entered_is_named() {
    let window = |from: &str, to: &str| {
        press(json!({ "window": { "from": from, "to": to, "force": "-5 kN" } }))
    };
    let found = warnings(&window("170 deg", "180 deg"), &[]);
    assert_eq!(found.len(), 1, "{found:?}");
    for word in [
        "`ram.loads.cutting` never acts",
        "between 170 deg and 180 deg",
        "`crank` goes from",
    ] {
        assert!(found[0].contains(word), "{found:?}");
    }
    assert!(warnings(&window("70 deg", "180 deg"), &[]).is_empty());
    let table = |points: Value| press(json!({ "position_table": { "points": points } }));
    let found = warnings(
        &table(json!([["200 deg", "-1 kN"], ["210 deg", "-2 kN"]])),
        &[],
    );
    assert!(
        found.len() == 1 && found[0].contains("never entered"),
        "{found:?}"
    );
    assert!(
        warnings(
            &table(json!([["20 deg", "-1 kN"], ["210 deg", "-2 kN"]])),
            &[]
        )
        .is_empty()
    );
    // Over time: it begins after the end of the run.
    let late = press(json!({ "time_table": [["2 s", 0], ["3 s", "1 kN"]] }));
    let found = warnings(&late, &[]);
    assert!(
        found.len() == 1 && found[0].contains("the run ends at 1 s"),
        "{found:?}"
    );
    assert!(warnings(&late, &["run.duration=2.5"]).is_empty());
}

/// A period brings every window within reach.
#[test]
fn a_window_that_repeats_is_entered_in_every_turn() {
    let scene = press(json!({ "window": {
        "from": "170 deg", "to": "180 deg", "force": "-5 kN" } }));
    assert_eq!(warnings(&scene, &[]).len(), 1);
    assert!(warnings(&scene, &["crank.motion.speed=2 rev/s"]).is_empty());
    assert!(warnings(&scene, &["crank.motion.speed=-2 rev/s"]).is_empty());
    // The same a turn back, which 90 deg do not reach and 200 deg backwards do.
    assert_eq!(
        warnings(&scene, &["crank.motion.speed=-0.25 rev/s"]).len(),
        1
    );
    assert!(warnings(&scene, &["crank.motion.speed=-0.55 rev/s"]).is_empty());
}

#[test]
fn a_load_that_never_acts_is_named() {
    for load in [
        json!({ "constant": 0 }),
        json!({ "spring": { "rate": 0, "preload": 0 } }),
        json!({ "viscous": 0 }),
        json!({ "window": { "from": "10 deg", "to": "20 deg", "force": 0 } }),
        json!({ "time_table": [[0, 0], ["1 s", 0]] }),
    ] {
        let found = warnings(&press(load.clone()), &[]);
        assert_eq!(found.len(), 1, "{load}: {found:?}");
        assert!(found[0].contains("zero throughout"), "{load}: {found:?}");
    }
    assert!(warnings(&press(json!({ "constant": "-1 N" })), &[]).is_empty());
}

/// Behind a motor only the run tells how far the crank comes.
#[test]
fn a_window_behind_a_motor_is_judged_by_the_run() {
    let mut scene =
        press(json!({ "window": { "from": "200 deg", "to": "210 deg", "force": "-1 N" } }));
    scene["objects"]["crank"] = json!({ "kind": "drive", "motor": {
        "torque": { "constant": "0.01 N m" }, "inertia": "0.1 kg m^2" } });
    let run = |duration: &str| {
        let written = Written::new(&scene);
        let setting = format!("run.duration={duration}");
        let document = json_of(&["run", written.path(), "--set", &setting, "--json", "-q"]);
        document["warnings"].to_string()
    };
    let short = run("1");
    assert!(short.contains("`ram.loads.cutting` never acts"), "{short}");
    let long = run("20");
    assert!(!long.contains("never acts"), "{long}");
}

/// Levers with a cam each beside each other on an elastic shaft, in all places of their
/// motion.
fn levers(count: usize) -> Value {
    let mut objects = json!({
        "motor": { "kind": "drive", "motion": { "speed": "600 rpm" } },
        "shaft": {
            "kind": "shaft", "input": "motor", "position": { "ratio": 1 }, "inertia": 0.1,
            "stiffness": "1 MN m/rad", "damping_capacity": 0.3
        }
    });
    for index in 0..count {
        objects[format!("lever{index}")] = json!({
            "kind": "rocker", "input": "shaft", "inertia": "0.02 kg m^2",
            "stiffness": "20 kN m/rad", "damping_capacity": 0.3,
            "position": { "cam": {
                "lift": "10 deg", "rise": "70 deg", "dwell": "10 deg", "return": "70 deg",
                "law": "4-5-6-7", "phase": format!("{} deg", 37 * index % 360)
            } }
        });
    }
    json!({ "dam": 1, "name": "levers", "objects": objects, "run": { "duration": 0.001 } })
}

#[test]
fn what_rests_in_a_short_run_is_not_out_of_proportion() {
    assert!(warnings(&levers(13), &[]).is_empty());
    // Each that is, once.
    let found = warnings(
        &levers(13),
        &[
            "lever3.stiffness=2e13 N m/rad",
            "lever7.inertia=2e-12 kg m^2",
        ],
    );
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].contains("stiffness of `lever3`"), "{found:?}");
    assert!(found[1].contains("inertia of `lever7`"), "{found:?}");
    // Of one among many that fit each other it is that one.
    let found = warnings(&levers(13), &["shaft.stiffness=1e15 N m/rad"]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("stiffness of `shaft`"), "{found:?}");
}

#[test]
fn stiffnesses_and_masses_out_of_proportion_are_named() {
    let scene = json!({
        "dam": 1,
        "name": "two",
        "objects": {
            "crank": { "kind": "drive", "motion": { "speed": "2 rev/s" } },
            "lever": {
                "kind": "rocker", "input": "crank", "inertia": "0.1 kg m^2",
                "stiffness": "1e5 N m/rad", "damping_capacity": 0.2, "masses": 1,
                "position": { "sine": { "amplitude": "20 deg" } }
            },
            "ram": {
                "kind": "slider", "input": "lever", "inertia": "2 kg", "stiffness": "20 kN/mm",
                "damping_capacity": 0.2, "masses": 1,
                "position": { "ratio": "100 mm/rad" }
            }
        },
        "run": { "duration": 0.5 }
    });
    assert!(warnings(&scene, &[]).is_empty());
    // N/mm twice taken for N/m.
    let found = warnings(&scene, &["ram.stiffness=2e13 N/m"]);
    assert!(
        found
            .iter()
            .any(|text| text.contains("stiffness of `ram`") && text.contains("`lever`")),
        "{found:?}"
    );
    let found = warnings(&scene, &["ram.inertia=2e6 kg"]);
    assert!(
        found.iter().any(|text| text.contains("inertia of `ram`")),
        "{found:?}"
    );
    // The same behind a motor.
    let mut motor = scene.clone();
    motor["objects"]["crank"] = json!({ "kind": "drive", "motor": {
        "torque": { "constant": "1 N m" }, "inertia": "0.1 kg m^2" } });
    assert!(warnings(&motor, &["run.duration=0.01"]).is_empty());
    let found = warnings(&motor, &["run.duration=0.01", "ram.stiffness=2e13 N/m"]);
    assert!(
        found.iter().any(|text| text.contains("stiffness of `ram`")),
        "{found:?}"
    );
    // Too soft to follow.
    let found = warnings(&scene, &["lever.stiffness=1e-3 N m/rad"]);
    assert!(
        found
            .iter()
            .any(|text| text.contains("`lever` does not follow its law")),
        "{found:?}"
    );
    let lists = json!({
        "kind": "slider", "input": "lever",
        "inertias": ["1 kg", "1 kg"], "stiffnesses": ["20 kN/mm", "20 N/m"], "dampings": [0, 0],
        "position": { "ratio": "100 mm/rad" }
    });
    let mut chain = scene.clone();
    chain["objects"]["ram"] = lists;
    let found = warnings(&chain, &[]);
    assert!(
        found.iter().any(|text| text.contains("link 1 of `ram`")),
        "{found:?}"
    );
}

#[test]
fn speeds_beyond_sense_are_named() {
    let scene = press(json!({ "constant": "-1 N" }));
    let found = warnings(
        &scene,
        &["crank.motion.speed=30000 rev/s", "run.duration=1e-4"],
    );
    assert!(
        found
            .iter()
            .any(|text| text.contains("`crank` reaches") && text.contains("rpm")),
        "{found:?}"
    );
}

#[test]
fn no_shipped_scene_is_called_unlikely() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios")];
    let mut looked_at = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.file_name().unwrap().to_str().unwrap();
            if !name.ends_with(".json") || name.ends_with(".schema.json") {
                continue;
            }
            let remarks =
                json_of(&["check", path.to_str().unwrap(), "--json"])["remarks"].to_string();
            for word in [
                "never acts",
                "never entered",
                "another unit",
                "beyond sense",
                "does not follow",
            ] {
                assert!(!remarks.contains(word), "{}: {remarks}", path.display());
            }
            looked_at += 1;
        }
    }
    assert!(looked_at > 40, "{looked_at}");
}
