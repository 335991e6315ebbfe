//! Numbers of scenes from records: a free decay whose estimates are known to 15 digits, and what a
//! record cannot say.

use dam::ask::{IdentifyQuestion, MeasuredRecord};
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::identify::{Ending, Identification, Standing};
use serde_json::{Value, json};

const REFERENCE: &str = include_str!("../reference/design-optimum-tolerance.json");
const STIFFNESS: &str = "wheel.stiffness=2e6:3e7";
const CAPACITY: &str = "wheel.damping_capacity=0:1";

fn number(value: &Value) -> f64 {
    value.as_str().expect("text").parse().expect("number")
}

fn case() -> Value {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    all["identify"].clone()
}

/// A wheel that is released on its shaft, as the reference has it; the values that are sought are
/// other ones.
fn scene() -> Scene {
    let case = case();
    let scene = json!({
        "dam": 1,
        "name": "free decay",
        "objects": {
            "drive": { "kind": "drive", "motion": { "speed": "1 rad/s" } },
            "wheel": {
                "kind": "shaft", "input": "drive", "inertia": number(&case["inertia"]),
                "stiffness": 9e6, "damping_capacity": 0.2,
            },
        },
        "run": {
            "duration": 0.01,
            "start": { "wheel": { "displacement": [number(&case["start"])], "speed": [1] } },
        },
    });
    Scene::from_json(&scene.to_string()).expect("JSON")
}

/// Free decay from rest: J·ẍ + b·ẋ + c·x = 0 with b = ψ·√(cJ)/2π.
fn decay([stiffness, capacity, inertia]: [f64; 3], time: f64) -> f64 {
    let natural = (stiffness / inertia).sqrt();
    let share = capacity / (2.0 * std::f64::consts::TAU);
    let own = natural * (1.0 - share * share).sqrt();
    let slow = (-share * natural * time).exp();
    1e-3 * slow * ((own * time).cos() + share * natural / own * (own * time).sin())
}

/// The record of the reference.
fn reference_record() -> MeasuredRecord {
    let case = case();
    let step = number(&case["step"]);
    let amplitude = number(&case["amplitude"]);
    let known = ["c0", "psi0", "inertia"].map(|name| number(&case[name]));
    let samples = case["samples"].as_u64().expect("a number") as u32;
    let rows = (1..=samples).map(|at| {
        let time = f64::from(at) * step;
        let noise = amplitude * f64::from(at * at).sin();
        (time, decay(known, time) + noise)
    });
    record("decay.csv", rows)
}

fn record(name: &str, rows: impl Iterator<Item = (f64, f64)>) -> MeasuredRecord {
    let rows = rows.map(|(t, x)| format!("{t:?},{x:?}\n"));
    MeasuredRecord {
        name: name.to_owned(),
        text: format!("t [s],x [rad]\n{}", rows.collect::<String>()),
        settings: Vec::new(),
    }
}

fn question(records: Vec<MeasuredRecord>, vary: &[&str]) -> IdentifyQuestion {
    IdentifyQuestion {
        records,
        signals: vec!["x=wheel.delta".to_owned()],
        vary: vary.iter().map(|&one| one.to_owned()).collect(),
        starts: Some(4),
        ..IdentifyQuestion::default()
    }
}

fn ask(scene: &Scene, question: &IdentifyQuestion) -> Identification {
    let found = scene.identify(question, &Control::default());
    found.expect("an answer")
}

fn near(found: f64, wanted: f64, within: f64) {
    let off = (found / wanted - 1.0).abs();
    assert!(off <= within, "{found} is not {wanted}: {off}");
}

#[test]
fn a_free_decay_is_that_of_the_reference() {
    let found = ask(
        &scene(),
        &question(vec![reference_record()], &[STIFFNESS, CAPACITY]),
    );
    let case = case();
    for (at, name) in ["stiffness", "damping_capacity"].into_iter().enumerate() {
        let (value, error) = found.estimates[at].value().expect("determined");
        near(value, number(&case["estimate"][name]), 1e-8);
        near(error, number(&case["standard_errors"][name]), 1e-6);
    }
    near(found.correlations[0][1], number(&case["correlation"]), 1e-5);
    near(found.sigma.unwrap(), number(&case["residual_sigma"]), 1e-8);
    assert!(found.is_answered() && found.complete && found.open_directions.is_empty());
    assert!(found.signals[0].test.unwrap().is_random());
    // The scene that is written has the estimates.
    let written = Scene::from_json(&found.scene_text).expect("JSON");
    let again = ask(
        &written,
        &question(vec![reference_record()], &[STIFFNESS, CAPACITY]),
    );
    near(again.estimates[0].given, found.estimates[0].fitted, 1e-15);
    near(again.estimates[1].given, found.estimates[1].fitted, 1e-15);
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let one = IdentifyQuestion {
        threads: Some(1),
        ..question(vec![reference_record()], &[STIFFNESS, CAPACITY])
    };
    let four = IdentifyQuestion {
        threads: Some(4),
        ..one.clone()
    };
    let [one, four] = [one, four].map(|question| ask(&scene(), &question).document("scene"));
    assert_eq!(one.to_string(), four.to_string());
}

/// A free decay depends on c/J and ψ alone.
#[test]
fn stiffness_and_inertia_of_a_free_decay_are_not_determined() {
    let sought = [STIFFNESS, CAPACITY, "wheel.inertia=0.05:0.3"];
    let found = ask(&scene(), &question(vec![reference_record()], &sought));
    let [stiffness, capacity, inertia] = found.estimates.as_slice() else {
        panic!("three numbers");
    };
    assert!(stiffness.value().is_none() && inertia.value().is_none());
    let (value, _) = capacity.value().expect("determined");
    near(value, number(&case()["estimate"]["damping_capacity"]), 1e-6);
    near(
        stiffness.fitted / inertia.fitted,
        number(&case()["estimate"]["stiffness"]) / 0.1,
        1e-7,
    );
    assert_eq!(
        found.open_directions.len(),
        1,
        "{:?}",
        found.open_directions
    );
    let [one, other] = found.open_directions[0].as_slice() else {
        panic!("two numbers: {:?}", found.open_directions);
    };
    assert_eq!(
        [&one.path, &other.path],
        ["wheel.stiffness", "wheel.inertia"]
    );
    near(one.change / other.change, 1.0, 1e-4);
    assert!(!found.is_answered() && found.settings.is_empty() && found.scene_text.is_empty());
    let document = found.document("scene");
    assert!(document["estimates"][0]["value"].is_null());
    assert!(document["estimates"][2]["standard_error"].is_null());
}

/// With a second record of a known further inertia both are determined.
#[test]
fn several_records_determine_what_one_leaves_open() {
    let known = [1e7, 0.4];
    let rows = |inertia: f64| {
        (0..=120).map(move |at| {
            let time = 3e-5 * f64::from(at);
            (time, decay([known[0], known[1], inertia], time))
        })
    };
    let mut with_load = record("load.csv", rows(0.25));
    with_load.settings = vec!["parameters.load=0.15".to_owned()];
    let records = vec![record("bare.csv", rows(0.1)), with_load];
    let mut text: Value = serde_json::from_str(&json!({
        "dam": 1, "name": "two tests",
        "parameters": { "load": 0, "own": 0.08 },
        "objects": {
            "drive": { "kind": "drive", "motion": { "speed": "1 rad/s" } },
            "wheel": {
                "kind": "shaft", "input": "drive", "inertia": "own + load",
                "stiffness": 9e6, "damping_capacity": 0.2,
            },
        },
        "run": { "duration": 0.01, "start": { "wheel": { "displacement": [1e-3], "speed": [1] } } },
    }).to_string()).unwrap();
    text["run"]["samples"] = 10.into();
    let scene = Scene::from_json(&text.to_string()).expect("JSON");
    let sought = [STIFFNESS, CAPACITY, "parameters.own=0.05:0.3"];
    let found = ask(&scene, &question(records, &sought));
    assert!(found.is_answered(), "{found:?}");
    for (one, wanted) in found.estimates.iter().zip([1e7, 0.4, 0.1]) {
        near(one.fitted, wanted, 1e-8);
    }
    assert_eq!(found.signals.len(), 2);
}

/// Times that are not even are interpolated.
#[test]
fn uneven_times_are_interpolated() {
    let rows = (0..150).map(|at| {
        let time = 2e-5 * (f64::from(at) + 0.3 * f64::from(at).sin().abs());
        (time, decay([1e7, 0.4, 0.1], time))
    });
    let found = ask(
        &scene(),
        &question(vec![record("uneven.csv", rows)], &[STIFFNESS, CAPACITY]),
    );
    near(found.estimates[0].fitted, 1e7, 1e-7);
    near(found.estimates[1].fitted, 0.4, 1e-6);
    assert!(found.remarks[0].contains("not even"), "{:?}", found.remarks);
}

#[test]
fn an_estimate_at_the_end_of_its_range_is_not_one() {
    let found = ask(
        &scene(),
        &question(
            vec![reference_record()],
            &["wheel.stiffness=9e6:9.9e6:9.8e6", CAPACITY],
        ),
    );
    let one = &found.estimates[0];
    assert!(
        one.standing == Standing::AtEnd && one.value().is_none() && !found.is_answered(),
        "{one:?}"
    );
    // The other one is known under this condition alone.
    let other = &found.estimates[1];
    assert_eq!(other.standing, Standing::Conditional);
    assert!(
        other.value().is_some() && !other.is_determined(),
        "{other:?}"
    );
    assert_eq!(found.starts[0].start[0], 9.8e6);
    assert_eq!(found.ending, Ending::Converged);
}

#[test]
fn what_a_question_lacks_is_said_at_once() {
    let wrong = IdentifyQuestion {
        signals: vec!["x=wheel.delt".to_owned(), "y".to_owned()],
        sigmas: vec!["z=1 mrad".to_owned()],
        starts: Some(0),
        ..question(Vec::new(), &["wheel.stifness=1:2"])
    };
    let error = scene().identify(&wrong, &Control::default()).unwrap_err();
    let text = error.to_string();
    for part in [
        "no record is named",
        "0: 1 to 1000 starts",
        "there is no signal `wheel.delt`",
        "`y`: no `=`",
        "no column of this name",
        "no number `wheel.stifness`",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// A rocker between two flanks that it changes at each turn of its acceleration.
fn rocker_in_a_groove([stiffness, capacity, gap]: [f64; 3]) -> Scene {
    let scene = Scene::read("scenarios/rocker/one_mass.json").expect("a scene");
    scene
        .set("rocker.stiffness", stiffness)
        .set("rocker.damping_capacity", capacity)
        .set("rocker.pair.closure", "form")
        .set("rocker.pair.gap", gap)
        .set("rocker.loads.closing.constant", -100)
        .set("run.duration", 0.06)
        .set("run.samples", 300)
}

/// The record of a run with errors of 1 µrad.
fn record_of_a_run(scene: &Scene) -> MeasuredRecord {
    let run = scene.run().expect("a run");
    let delta = run.delta("rocker").expect("a signal").to_vec();
    let error = |at: usize| 1e-6 * ((at * at) as f64).sin();
    let rows = run.times().iter().zip(delta).enumerate();
    record(
        "groove.csv",
        rows.map(|(at, (time, delta))| (*time, delta + error(at))),
    )
}

const GROOVE: [&str; 3] = [
    "rocker.stiffness=8e6:1.3e7",
    "rocker.damping_capacity=0.1:0.8",
    "rocker.pair.gap=0.05:0.2 mrad",
];

/// Beside stiffness and damping the clearance is estimated, from both flanks of the contact.
#[test]
fn a_gap_is_the_third_number() {
    let known = [1e7, 0.4, 1e-4];
    let question = IdentifyQuestion {
        signals: vec!["x=rocker.delta".to_owned()],
        ..question(vec![record_of_a_run(&rocker_in_a_groove(known))], &GROOVE)
    };
    let found = ask(&rocker_in_a_groove([1.02e7, 0.35, 9e-5]), &question);
    let gap = &found.estimates[2];
    let (value, error) = gap.value().expect("determined");
    assert!((value - 0.1).abs() <= 5.0 * error, "{gap:?}");
    assert!(error < 2e-3 * value, "{gap:?}");
    for (one, known) in found.estimates.iter().zip([1e7, 0.4, 0.1]) {
        let error = one.error.expect("an error");
        assert!((one.fitted - known).abs() <= 5.0 * error, "{one:?}");
    }
}

/// Up to the first separation the speed is the same with any gap.
#[test]
fn a_gap_without_effect_is_not_determined() {
    let known = rocker_in_a_groove([1e7, 0.4, 1e-4]);
    let run = known.run().expect("a run");
    let speed = run.speed("rocker").expect("a signal").to_vec();
    let rows = run.times().iter().copied().zip(speed);
    let mut own = record("speed.csv", rows);
    own.text = own.text.replace("x [rad]", "x [rad/s]");
    let question = IdentifyQuestion {
        signals: vec!["x=rocker.speed".to_owned()],
        until_first_separation: true,
        ..question(vec![own], &GROOVE[2..])
    };
    let found = ask(&known, &question);
    assert!(found.estimates[0].value().is_none(), "{found:?}");
    assert_eq!(found.open_directions[0][0].path, "rocker.pair.gap");
    assert_eq!(found.open_directions[0].len(), 1);
    assert!(
        found.remarks[0].contains("first separation"),
        "{:?}",
        found.remarks
    );
}
