//! Random scenes either run or fail with a diagnostic.
//!
//! Any mixture of objects, position functions, pairs and loads, sensible or
//! not: reading, lowering and running never panic, a run ends with a word, and
//! a complete run that is trusted has finite figures and balanced energies.

use dam::integrate::Method;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::time::Duration;

/// How a scene ended.
enum Ending {
    Refused(String),
    Ran(Box<RunResult>),
}

fn number(low: f64, high: f64) -> impl Strategy<Value = f64> {
    // Even over the powers of ten.
    (low.ln()..high.ln()).prop_map(f64::exp)
}

fn drive() -> impl Strategy<Value = Value> {
    let torque = prop_oneof![
        (0.1..100.0).prop_map(|torque| json!({ "constant": torque })),
        (1.0..100.0, 5.0..200.0).prop_map(
            |(stall, speed)| json!({ "linear": { "stall_torque": stall, "no_load_speed": speed } })
        ),
        (1.0..100.0, 0.05..0.9, 5.0..200.0).prop_map(|(torque, slip, speed)| json!({ "kloss":
            { "breakdown_torque": torque, "breakdown_slip": slip, "synchronous_speed": speed } })),
    ];
    prop_oneof![
        (-100.0..100.0).prop_map(|speed| json!({ "kind": "drive", "motion": { "speed": speed } })),
        (1.0..100.0, 0.001..0.1).prop_map(|(speed, time)| {
            json!({ "kind": "drive", "motion": { "run_up": { "speed": speed, "time": time } } })
        }),
        (number(1e-3, 10.0), -10.0..50.0, torque).prop_map(|(inertia, speed, torque)| {
            json!({ "kind": "drive", "motor": { "inertia": inertia, "speed": speed, "torque": torque } })
        }),
    ]
}

fn turning_position() -> impl Strategy<Value = Value> {
    prop_oneof![
        (-3.0..3.0).prop_map(|ratio| json!({ "ratio": ratio })),
        (0.01..2.0, 1..4).prop_map(|(amplitude, harmonic)| {
            json!({ "sine": { "amplitude": amplitude, "harmonic": harmonic } })
        }),
        prop::collection::vec(-1.0..1.0, 1..4)
            .prop_map(|list| json!({ "polynomial": { "coefficients": list } })),
        (0.05..0.5, 0.1..0.6, 0.1..0.6, 0.1..0.6).prop_map(|(crank, coupler, rocker, frame)| {
            json!({ "four_bar": { "crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame } })
        }),
        (0.05..1.0, 30.0..120.0, prop::sample::select(vec!["harmonic", "cycloidal", "3-4-5", "4-5-6-7", "modified_trapezoid"]))
            .prop_map(|(lift, angle, law)| json!({ "cam": {
                "lift": lift, "rise": format!("{angle} deg"), "dwell": "20 deg", "return": format!("{angle} deg"), "law": law } })),
        (0.1..1.0).prop_map(|top| json!({ "table": { "periodic": true,
            "points": [[0, 0], [2, top], [4, 0.3 * top], [std::f64::consts::TAU, 0]] } })),
    ]
}

fn load() -> impl Strategy<Value = Value> {
    prop_oneof![
        (-500.0..500.0).prop_map(|force| json!({ "constant": force, "mass": "last" })),
        (0.0..500.0, -50.0..50.0)
            .prop_map(|(rate, preload)| json!({ "spring": { "rate": rate, "preload": preload } })),
        (0.0..5.0).prop_map(|factor| json!({ "viscous": factor })),
        (0.0..50.0, 0.01..1.0)
            .prop_map(|(force, width)| json!({ "friction": { "force": force, "width": width } })),
        (0.0..3.0, 0.1..2.0, -200.0..200.0).prop_map(|(from, length, force)| {
            json!({ "window": { "from": from, "to": from + length, "force": force } })
        }),
        (-100.0..100.0).prop_map(|force| json!({ "time_table": [[0, 0], [0.01, force]] })),
    ]
}

fn pair() -> impl Strategy<Value = Value> {
    prop_oneof![
        Just(json!({ "closure": "bilateral" })),
        prop::sample::select(vec!["+", "-"])
            .prop_map(|opens| json!({ "closure": "force", "opens": opens })),
        Just(json!({ "closure": "force", "law": "hunt_crossley" })),
        (0.0..1e-3).prop_map(|gap| json!({ "closure": "form", "gap": gap })),
    ]
}

fn body() -> impl Strategy<Value = Value> {
    let elastic = (number(1e-3, 10.0), number(1e3, 1e7), 0.0..1.0, 1..5u32).prop_map(
        |(inertia, stiffness, damping, masses)| {
            json!({ "inertia": inertia, "stiffness": stiffness,
                "damping_capacity": damping, "masses": masses })
        },
    );
    prop_oneof![
        3 => elastic,
        1 => number(1e-3, 10.0).prop_map(|inertia| json!({ "inertia": inertia, "masses": 0 })),
    ]
}

fn object() -> impl Strategy<Value = (Value, usize)> {
    let kind = prop::sample::select(vec!["shaft", "crank", "rocker"]);
    let loads = prop::collection::vec(load(), 0..3);
    (kind, turning_position(), body(), pair(), loads, 0..100usize).prop_map(
        |(kind, position, body, pair, loads, driver)| {
            // Most contradictions are left out; diagnostics have tests of their own.
            let kind = if position.get("ratio").is_some() {
                kind
            } else {
                "rocker"
            };
            let rigid = body["masses"] == 0;
            let pair = if rigid && pair["closure"] == "form" {
                json!({})
            } else {
                pair
            };
            let mut object = json!({ "kind": kind, "position": position, "pair": pair });
            let members = object.as_object_mut().unwrap();
            members.extend(body.as_object().unwrap().clone());
            let named: serde_json::Map<String, Value> = loads
                .into_iter()
                .enumerate()
                .map(|(index, load)| (format!("load{index}"), load))
                .collect();
            members.insert("loads".to_owned(), Value::Object(named));
            (object, driver)
        },
    )
}

pub(super) fn scene() -> impl Strategy<Value = Value> {
    let start = prop::sample::select(vec!["kinetostatic", "static", "on_law"]);
    let methods = [Method::Dopri5, Method::TrBdf2, Method::Bdf, Method::Radau];
    let methods = methods.into_iter().filter(|method| method.is_available());
    let names = ["auto", "auto"]
        .into_iter()
        .chain(methods.map(Method::name));
    let method = prop::sample::select(names.collect::<Vec<_>>());
    let objects = prop::collection::vec(object(), 1..4);
    (drive(), objects, start, method).prop_map(|(drive, objects, start, method)| {
        let mut named = serde_json::Map::new();
        named.insert("object0".to_owned(), drive);
        for (index, (mut object, driver)) in objects.into_iter().enumerate() {
            object["input"] = json!(format!("object{}", driver % (index + 1)));
            named.insert(format!("object{}", index + 1), object);
        }
        json!({ "dam": 1, "name": "random", "objects": named, "run": {
            "duration": 0.02, "start": start, "method": method, "tolerance": 1e-6,
            "samples": 20, "max_switches": 500 } })
    })
}

fn end_of(scene: &Value) -> Ending {
    let text = scene.to_string();
    let read = Document::parse("random.json", text.as_bytes())
        .and_then(|document| document.scene(&BuiltIn, &Overrides::none()));
    let reading = match read {
        Ok(reading) => reading,
        Err(diagnostics) => return Ending::Refused(diagnostics.to_string()),
    };
    let control = Control::FREE.within(Duration::from_millis(300));
    let settings = RunSettings::of(&reading.scene).unwrap();
    let result = lower(&reading.scene)
        .and_then(System::new)
        .and_then(|system| run(&system, &settings, &control, &mut []));
    match result {
        Ok(result) => Ending::Ran(Box::new(result)),
        Err(faults) => Ending::Refused(reading.places.diagnose(&faults).to_string()),
    }
}

fn check(scene: &Value) -> Result<(), TestCaseError> {
    match end_of(scene) {
        Ending::Refused(words) => {
            prop_assert!(words.contains("error"), "refused without a word");
        }
        Ending::Ran(result) => {
            let run = &result.figures.run;
            prop_assert_eq!(run.complete, run.stopped.is_none());
            prop_assert!(run.complete || run.stopped_because.as_deref() != Some(""));
            if result.is_complete() && result.is_trusted() {
                for (name, value) in result.figures.addresses() {
                    prop_assert!(value.is_none_or(f64::is_finite), "{} = {:?}", name, value);
                }
                for column in &result.record.columns {
                    let finite = column.values.iter().all(|value| value.is_finite());
                    prop_assert!(finite, "{}.{}", column.object, column.quantity);
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 150,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_random_scene_runs_or_is_refused(scene in scene()) {
        check(&scene)?;
    }
}

#[test]
fn most_random_scenes_run() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut refused = Vec::new();
    for _ in 0..60 {
        let scene = scene().new_tree(&mut runner).unwrap().current();
        if let Ending::Refused(words) = end_of(&scene) {
            refused.push(words.lines().next().unwrap_or_default().to_owned());
        }
    }
    let list = refused.join("\n");
    assert!(refused.len() <= 30, "the generator has gone stale:\n{list}");
}
