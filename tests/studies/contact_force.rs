//! Least contact force, preload and speed of lift-off of followers, rigid and elastic: against
//! Fourier series and closed forms computed in another language (`tests/reference/contact_force.py`).

use dam::prelude::*;
use dam::studies::Control;
use dam::studies::lookup::{Subject, figure};
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

const LAW: &str = r#""position": { "cam": { "lift": "10.5 mm", "rise": "70 deg", "dwell": "4 deg",
    "return": "70 deg", "law": "4-5-6-7", "phase": "-30 deg" } }"#;
const SPRING: &str =
    r#""loads": { "spring": { "spring": { "rate": "40 N/mm", "preload": "300 N" } } }"#;
const ONE: &str = r#""inertia": "300 g", "stiffness": "3e6 N/m", "damping_capacity": 0.5"#;
const TWO: &str = r#""inertias": ["180 g", "160 g"], "stiffnesses": ["9e6 N/m", "4.5e6 N/m"],
    "dampings": ["180 N s/m", "120 N s/m"]"#;

fn train(rpm: f64, objects: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Train", "objects": {{
            "camshaft": {{ "kind": "drive", "motion": {{ "speed": "{rpm} rpm" }} }}, {objects} }},
            "run": {{ "duration": "0.16 s", "start": "static", "tolerance": 1e-9 }} }}"#
    )
}

fn follower(rpm: f64, own: &str) -> String {
    let object = format!(
        r#""valve": {{ "kind": "cam_follower", "input": "camshaft", "motion": "sliding", {LAW}, {own} }}"#
    );
    train(rpm, &object)
}

/// A valve that a tappet drives, with its spring.
fn tappet(cam: &str, more: &str) -> String {
    let objects = format!(
        r#""tappet": {{ "kind": "cam_follower", "input": "camshaft", "motion": "sliding", {LAW}, {cam}
            "inertia": "80 g", "masses": 0 }},
        "valve": {{ "kind": "slider", "input": "tappet", "position": {{ "ratio": 1.5 }},
            "inertia": "120 g", "masses": 0,
            "loads": {{ "spring": {{ "spring": {{ "rate": "30 N/mm", "preload": "200 N" }} }} }} }} {more}"#
    );
    train(2000.0, &objects)
}

const ROLLER: &str = r#""cam": { "base_radius": "20 mm", "contact": { "roller": "9 mm" } },"#;

fn result(text: &str, address: &str) -> Result<f64, String> {
    let ready = Scene::from_json(text).unwrap().prepare().unwrap();
    let control = Control::default();
    let subject = Subject {
        scene: ready.scene(),
        system: &ready.system,
        settings: &ready.settings,
        control: &control,
    };
    match figure(address, subject) {
        Ok(found) => Ok(found.unwrap().value.unwrap()),
        Err(faults) => Err(faults[0].message.clone()),
    }
}

fn reference(case: &str) -> Value {
    let text = include_str!("../reference/contact_force.json");
    let document: Value = serde_json::from_str(text).unwrap();
    document["scenes"][case].clone()
}

#[track_caller]
fn agrees(text: &str, object: &str, case: &str, names: &[(&str, f64)]) {
    let reference = reference(case);
    for &(name, within) in names {
        let found = result(text, &format!("cam.{object}.{name}")).unwrap();
        let wanted = reference[name].as_f64().unwrap();
        let off = (found / wanted - 1.0).abs();
        assert!(off <= within, "{case}, {name}: {found}, {wanted}, {off}");
    }
}

#[test]
fn elastic_followers_have_the_results_of_their_fourier_series() {
    let names = [
        ("margin", 1e-7),
        ("margin_angle", 1e-6),
        ("preload_needed", 1e-7),
        ("lift_off_speed", 2e-5),
    ];
    let one = follower(1500.0, &format!("{ONE}, {SPRING}"));
    agrees(&one, "valve", "valve-pushrod-one-mass at 1500 rpm", &names);
    let two = follower(1500.0, &format!("{TWO}, {SPRING}"));
    agrees(&two, "valve", "two masses at 1500 rpm", &names);
}

#[test]
fn a_spring_on_the_valve_closes_the_contact_of_its_tappet() {
    let names = [
        ("margin", 1e-8),
        ("preload_needed", 1e-8),
        ("lift_off_speed", 1e-6),
    ];
    let case = "tappet with a valve behind it at 2000 rpm";
    agrees(&tappet(ROLLER, ""), "tappet", case, &names);
    // Without the shape of the cam the same follows from runs; the spring is another object's.
    let bare = tappet("", "");
    agrees(
        &bare,
        "tappet",
        case,
        &[("margin", 1e-7), ("lift_off_speed", 2e-5)],
    );
    let refused = result(&bare, "cam.tappet.preload_needed").unwrap_err();
    assert!(
        refused.contains("no closing spring of its own"),
        "{refused}"
    );
}

#[test]
fn past_lift_off_the_margin_is_nothing_and_the_preload_needed_closes_the_contact() {
    let fast = |preload: f64| {
        let spring = SPRING.replace("300", &preload.to_string());
        follower(1950.0, &format!("{ONE}, {spring}"))
    };
    assert_eq!(result(&fast(300.0), "cam.valve.margin"), Ok(0.0));
    let needed = result(&fast(300.0), "cam.valve.preload_needed").unwrap();
    assert!(needed > 300.0, "{needed}");
    let above = result(&fast(needed + 10.0), "cam.valve.margin").unwrap();
    // The valve's own spring takes its share of the preload: c/(c + rate).
    let wanted = 10.0 * 3e6 / (3e6 + 40e3);
    assert!((above - wanted).abs() < 1e-4, "{above} {wanted}");
    let speed = result(&fast(needed + 0.5), "cam.valve.lift_off_speed").unwrap();
    let own = 1950f64 * std::f64::consts::PI / 30.0;
    assert!((speed / own - 1.0).abs() < 2e-3, "{speed} {own}");
}

#[test]
fn what_cannot_be_known_is_refused_by_name() {
    let form = follower(
        1500.0,
        &format!("{ONE}, {SPRING}, \"pair\": {{ \"closure\": \"form\" }}"),
    );
    for name in ["margin", "lift_off_speed", "preload_needed"] {
        let refused = result(&form, &format!("cam.valve.{name}")).unwrap_err();
        assert!(refused.contains(&format!("no `{name}`")), "{refused}");
    }
    let none = r#""loads": { "weight": { "constant": "-600 N" } }"#;
    let none = follower(1500.0, &format!("{ONE}, {none}"));
    assert!(result(&none, "cam.valve.margin").unwrap() > 0.0);
    let refused = result(&none, "cam.valve.preload_needed").unwrap_err();
    assert!(refused.contains("no closing spring"), "{refused}");
    // A seat holds the valve off its cam in each dwell.
    let lash = r#""stops": { "seat": { "at": "0.2 mm", "side": "-", "contact": { "law": "kelvin_voigt",
        "stiffness": "2000 kN/mm", "damping": "1500 N s/m" } } }"#;
    let lash = follower(600.0, &format!("{ONE}, {SPRING}, {lash}"));
    assert_eq!(result(&lash, "cam.valve.margin"), Ok(0.0));
    let refused = result(&lash, "cam.valve.preload_needed").unwrap_err();
    assert!(refused.contains("stays open"), "{refused}");
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn written(folder: &tempfile::TempDir, text: &str) -> String {
    let path: PathBuf = folder.path().join("scene.json");
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn find_and_cam_have_the_margin_of_an_elastic_follower() {
    let folder = tempfile::tempdir().unwrap();
    let shape = r#""cam": { "base_radius": "20 mm", "contact": { "roller": "9 mm" } }"#;
    let scene = written(
        &folder,
        &follower(1500.0, &format!("{ONE}, {SPRING}, {shape}")),
    );
    let reference = reference("valve-pushrod-one-mass at 1500 rpm");
    let wanted = |name: &str| reference[name].as_f64().unwrap();
    let found = dam(&[
        "find",
        &scene,
        "--vary",
        "camshaft.motion.speed=1000:2500 rpm",
        "--subject",
        "cam.valve.margin >= 50 N",
        "--maximize",
        "camshaft.motion.speed",
        "--json",
    ]);
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let speed = found["best"]["value"].as_f64().unwrap() * std::f64::consts::PI / 30.0;
    assert!(
        (speed / wanted("speed_for_50_N") - 1.0).abs() < 1e-6,
        "{speed}"
    );
    assert_eq!(found["rigid"], Value::Null);
    let cam = dam(&["cam", &scene, "--lift-off", "--json"]);
    let cam: Value = serde_json::from_slice(&cam.stdout).unwrap();
    let elastic = &cam["cam"]["force"]["elastic_contact"];
    let margin = elastic["margin"]["value"].as_f64().unwrap();
    assert!((margin / wanted("margin") - 1.0).abs() < 1e-7, "{margin}");
    let preload = elastic["preload"].as_f64().unwrap();
    assert!(
        (preload / wanted("preload_needed") - 1.0).abs() < 1e-7,
        "{preload}"
    );
    // At another speed of the cam: that at which 50 N are left.
    let rpm = format!("{} rad/s", wanted("speed_for_50_N"));
    let cam = dam(&["cam", &scene, "--lift-off", "--speed", &rpm, "--json"]);
    let cam: Value = serde_json::from_slice(&cam.stdout).unwrap();
    let margin = cam["cam"]["force"]["elastic_contact"]["margin"]["value"]
        .as_f64()
        .unwrap();
    assert!((margin - 50.0).abs() < 1e-3, "{margin}");
}

#[test]
fn cam_states_on_which_object_the_closing_spring_acts() {
    let folder = tempfile::tempdir().unwrap();
    let scene = written(&folder, &tappet(ROLLER, ""));
    let output = dam(&["cam", &scene, "--reserve", "0"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let line = text
        .lines()
        .find(|line| line.contains("preload needed"))
        .unwrap();
    assert!(
        line.contains("120.5 N") && line.contains("spring on valve"),
        "{line}"
    );
    // Two objects with springs: none of them alone closes the contact.
    let more = r#", "other": { "kind": "slider", "input": "tappet", "position": { "ratio": 1 },
        "inertia": "10 g", "masses": 0,
        "loads": { "spring": { "spring": { "rate": "1 N/mm", "preload": "10 N" } } } }"#;
    let scene = written(&folder, &tappet(ROLLER, more));
    let output = dam(&["cam", &scene]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("act on several objects"), "{text}");
}

/// A harmonic law with little damping: the start dies away over hundreds of turns, and a contact
/// that opens meanwhile has the least force zero in turn after turn.
fn lightly_damped(start: &str, preload: f64, capacity: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Follower", "objects": {{
            "camshaft": {{ "kind": "drive", "motion": {{ "speed": "800 rpm" }} }},
            "follower": {{ "kind": "cam_follower", "input": "camshaft", "motion": "sliding",
                "position": {{ "cam": {{ "lift": "12 mm", "rise": "120 deg", "dwell": "30 deg",
                    "return": "120 deg", "law": "harmonic" }} }},
                "inertia": "0.4 kg", "stiffness": "3 kN/mm", "masses": 1, "damping_capacity": {capacity},
                "loads": {{ "spring": {{ "spring": {{ "rate": "10 N/mm", "preload": "{preload} N" }} }} }} }} }},
            "run": {{ "duration": "0.48 s", "start": "{start}", "tolerance": 1e-8 }} }}"#
    )
}

#[test]
fn the_preload_that_keeps_contact_and_the_margin_do_not_follow_from_the_start() {
    let of = |start, preload, capacity, name: &str| {
        result(
            &lightly_damped(start, preload, capacity),
            &format!("cam.follower.{name}"),
        )
        .unwrap()
    };
    // Both would be those of the first turns: the contact opens in many of them.
    for (preload, capacity) in [(60.0, 0.02), (100.0, 0.02), (60.0, 0.002)] {
        let [one, other] =
            ["static", "on_law"].map(|start| of(start, preload, capacity, "preload_needed"));
        assert!(
            (one - other).abs() < 1e-3 * one,
            "{preload} {capacity}: {one} and {other}"
        );
        assert!(one > 60.0 && one < 100.0, "{one}");
    }
    let [one, other] = ["static", "on_law"].map(|start| of(start, 100.0, 0.02, "margin"));
    assert!(
        one > 5.0 && (one - other).abs() < 1e-3 * one,
        "{one} and {other}"
    );
}

#[test]
fn the_least_speed_of_lift_off_is_that_of_the_closed_motion_whatever_the_start() {
    for (capacity, preload) in [(0.02, 60.0), (0.02, 100.0), (0.002, 60.0)] {
        let case = format!("lightly damped, {capacity}, {preload} N");
        let wanted = reference(&case)["lift_off_speed"].as_f64().unwrap();
        let scenes = ["static", "on_law"].map(|start| lightly_damped(start, preload, capacity));
        let longer = scenes[0].replace("0.48 s", "3 s");
        let speeds = [&scenes[0], &scenes[1], &longer]
            .map(|scene| result(scene, "cam.follower.lift_off_speed").unwrap());
        assert!(
            (speeds[0] / wanted - 1.0).abs() < 2e-5,
            "{case}: {} and {wanted}",
            speeds[0]
        );
        for other in &speeds[1..] {
            assert!((other / speeds[0] - 1.0).abs() < 1e-9, "{case}: {speeds:?}");
        }
        // From another speed of the scene the same band is found.
        let slow = scenes[0].replace("800 rpm", "300 rpm");
        let slow = result(&slow, "cam.follower.lift_off_speed").unwrap();
        assert!((slow / wanted - 1.0).abs() < 2e-5, "{case}: {slow}");
    }
}

/// A follower as that of a disc cam with a roller, and what `dam cam --lift-off` says of it.
fn on_a_disc_cam(folder: &tempfile::TempDir, scene: &str) -> (String, String) {
    let shape =
        r#""masses": 1, "cam": { "base_radius": "30 mm", "contact": { "roller": "10 mm" } }"#;
    let scene = written(folder, &scene.replace(r#""masses": 1"#, shape));
    let text = dam(&["cam", &scene, "--lift-off"]).stdout;
    (scene, String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn a_follower_between_bands_of_lift_off_is_in_working_order() {
    let folder = tempfile::tempdir().unwrap();
    let (_, text) = on_a_disc_cam(&folder, &lightly_damped("static", 100.0, 0.02));
    assert!(text.contains("lifts off in bands of speed"), "{text}");
    assert!(!text.contains("Not in working order"), "{text}");
    assert!(!text.contains("bounces on"), "{text}");
}

#[test]
fn a_start_from_which_the_follower_bounces_on_below_lift_off_is_stated() {
    let folder = tempfile::tempdir().unwrap();
    let scene = lightly_damped("static", 250.0, 0.02);
    let high = r#"{ "follower": { "displacement": ["30 mm"], "speed": ["-3 m/s"] } }"#;
    let (scene, text) = on_a_disc_cam(&folder, &scene.replace(r#""static""#, high));
    assert!(text.contains("bounces on at 777.0 rpm"), "{text}");
    assert!(text.contains("792.8 rpm"), "{text}");
    // A run at that speed from the same start confirms it in its last turns.
    let run = ["camshaft.motion.speed=777 rpm", "run.duration=20 s"];
    let run = dam(&["run", &scene, "--set", run[0], "--set", run[1], "--json"]);
    let run: Value = serde_json::from_slice(&run.stdout).unwrap();
    let pair = &run["objects"]["follower"]["pair"];
    let last = pair["switch_times"].as_array().unwrap().last().unwrap();
    assert!(last.as_f64().unwrap() > 19.9, "{last}");
}
