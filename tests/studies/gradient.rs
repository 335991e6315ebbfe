//! Derivatives of results against references computed elsewhere, and what has none.

use dam::ask::GradientQuestion;
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::gradient::{Gradient, Verdict};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, TAU};

const REFERENCE: &str = include_str!("../reference/design-gradients.json");

fn number(value: &Value) -> f64 {
    let text = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    match text.as_str() {
        "pi/2" => FRAC_PI_2,
        text => text.parse().expect("number"),
    }
}

/// The scene of the reference: a rocker on a sine under a constant moment.
fn rocker(inputs: &Value) -> Scene {
    let pair = match inputs["closure"].as_str() {
        Some("form") => json!({ "closure": "form", "gap": number(&inputs["gap"]) }),
        _ => json!({ "closure": "force" }),
    };
    let scene = json!({
        "dam": 1,
        "name": "rocker",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": TAU * number(&inputs["nu"]) } },
            "rocker": {
                "kind": "rocker", "input": "shaft",
                "position": { "sine": { "amplitude": number(&inputs["A"]) } },
                "inertia": number(&inputs["J"]),
                "stiffness": number(&inputs["c"]),
                "damping_capacity": number(&inputs["psi"]),
                "masses": number(&inputs["masses"]) as u64,
                "pair": pair,
                "loads": { "closing": { "mass": "last", "constant": -number(&inputs["M"]) } },
            },
        },
        "run": { "duration": number(&inputs["duration"]), "start": inputs["start"], "samples": 10 },
    });
    Scene::from_json(&scene.to_string()).expect("JSON")
}

/// Names of the reference as addresses, with the derivative of the number there by the name's.
fn parameter(name: &str) -> (&'static str, f64) {
    match name {
        "J" => ("rocker.inertia", 1.0),
        "c" => ("rocker.stiffness", 1.0),
        "psi" => ("rocker.damping_capacity", 1.0),
        "M" => ("rocker.loads.closing.constant", -1.0),
        "nu" => ("shaft.motion.speed", TAU),
        "A" => ("rocker.position.sine.amplitude", 1.0),
        "gap" => ("rocker.pair.gap", 1.0),
        other => panic!("{other}"),
    }
}

/// A result of the reference as an address; `last`: the number of the last event.
fn figure(name: &str, last: usize) -> String {
    let name = match name {
        "max_contact_force" => "pair.max_contact_force".to_owned(),
        "min_contact_force" => "pair.margin".to_owned(),
        "delta_end" => "final.displacement".to_owned(),
        "speed_end" => "final.speed".to_owned(),
        "first_switch" => "pair.switch_times.0".to_owned(),
        "last_switch" => format!("pair.switch_times.{last}"),
        same => same.to_owned(),
    };
    format!("rocker.{name}")
}

/// What the law adds to the derivative of δ at the end.
fn of_law(inputs: &Value, name: &str) -> f64 {
    let [amplitude, speed, end] = ["A", "nu", "duration"].map(|name| number(&inputs[name]));
    let angle = TAU * speed * end;
    match name {
        "nu" => amplitude * angle.cos() * TAU * end,
        "A" => angle.sin(),
        _ => 0.0,
    }
}

fn ask(scene: &Scene, by: &[&str], figures: &[String], check: bool) -> Gradient {
    let question = GradientQuestion {
        by: by.iter().map(|&path| path.to_owned()).collect(),
        figures: figures.to_vec(),
        check: Some(check),
    };
    scene.gradient(&question, &Control::default()).expect("derivatives")
}

#[test]
fn all_derivatives_of_the_reference_are_met_through_all_their_events() {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    let (mut compared, mut worst, mut misses) = (0, 0.0f64, Vec::new());
    for (name, case) in all["cases"].as_object().expect("cases") {
        let inputs = &case["inputs"];
        let figures = case["figures"].as_object().expect("figures");
        let events = case["separations"].as_u64().unwrap() + case["closures"].as_u64().unwrap();
        let addresses: Vec<String> = (figures.keys())
            .map(|figure_name| figure(figure_name, (events as usize).saturating_sub(1)))
            .collect();
        let first = figures.values().next().expect("a figure");
        let names: Vec<&str> = first["gradient"].as_object().unwrap().keys().map(String::as_str).collect();
        let by: Vec<&str> = names.iter().map(|name| parameter(name).0).collect();
        let found = ask(&rocker(inputs), &by, &addresses, false);
        assert_eq!(found.events as u64, events, "{name}");
        for ((figure_name, reference), own) in figures.iter().zip(&found.figures) {
            for (own, parameter_name) in own.by.iter().zip(&names) {
                let told = &reference["gradient"][parameter_name]["saltation"];
                let mut expected = number(told);
                let (scale, mut rounding) = (expected.abs(), 0.0);
                if figure_name == "delta_end" {
                    // δ is small beside the law, whose angle is rounded.
                    let law = of_law(inputs, parameter_name);
                    expected += law;
                    rounding = 1e-14 * law.abs().max(1.0);
                }
                let label = format!("{name}.{figure_name} by {parameter_name}");
                let Some(slope) = own.derivative else {
                    misses.push(format!("{label}: {:?}", own.verdict));
                    continue;
                };
                let slope = slope * parameter(parameter_name).1;
                let error = match scale == 0.0 {
                    true => slope.abs() * 1e6,
                    false => ((slope - expected).abs() - rounding).max(0.0) / scale,
                };
                compared += 1;
                worst = worst.max(error);
                if error.is_nan() || error > 1e-6 {
                    misses.push(format!("{label}: {slope} {expected} {error:e}"));
                }
            }
        }
    }
    eprintln!("{compared} derivatives, worst {worst:e}");
    assert!(misses.is_empty(), "{compared} compared\n{}", misses.join("\n"));
    assert_eq!(compared, 226);
}
