//! Derivatives of results against references computed elsewhere, and what has none.

use dam::ask::GradientQuestion;
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::gradient::{DerivativeVerdict, Gradient};
use serde_json::{Value, json};
use std::f64::consts::{FRAC_PI_2, TAU};

const REFERENCE: &str = include_str!("../reference/design-gradients.json");

fn number(value: &Value) -> f64 {
    let text = value
        .as_str()
        .map_or_else(|| value.to_string(), str::to_owned);
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
    scene
        .gradient(&question, &Control::default())
        .expect("derivatives")
}

#[test]
fn all_derivatives_of_the_reference_are_met_through_all_their_events() {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    let (mut compared, mut misses) = (0, Vec::new());
    for (name, case) in all["cases"].as_object().expect("cases") {
        let inputs = &case["inputs"];
        let figures = case["figures"].as_object().expect("figures");
        let events = case["separations"].as_u64().unwrap() + case["closures"].as_u64().unwrap();
        let addresses: Vec<String> = (figures.keys())
            .map(|figure_name| figure(figure_name, (events as usize).saturating_sub(1)))
            .collect();
        let first = figures.values().next().expect("a figure");
        let names: Vec<&str> = first["gradient"]
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        let by: Vec<&str> = names.iter().map(|name| parameter(name).0).collect();
        let found = ask(&rocker(inputs), &by, &addresses, false);
        assert_eq!(found.events as u64, events, "{name}");
        for ((figure_name, reference), own) in figures.iter().zip(&found.figures) {
            for (own, parameter_name) in own.by.iter().zip(&names) {
                let told = &reference["gradient"][parameter_name]["saltation"];
                let mut expected = number(told);
                // Of a result that hardly depends on a number less is known: its own rounding.
                let value = number(&reference["value"]).abs();
                let place = number(&inputs[*parameter_name]).abs();
                let (scale, mut rounding) = (expected.abs(), 1e-15 * value / place);
                if figure_name == "delta_end" {
                    // δ is small beside the law, whose angle is rounded.
                    let law = of_law(inputs, parameter_name);
                    expected += law;
                    if law != 0.0 {
                        rounding += 1e-14 * law.abs().max(1.0);
                    }
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
                if error.is_nan() || error > 1e-6 {
                    misses.push(format!("{label}: {slope} {expected} {error:e}"));
                }
            }
        }
    }
    assert!(
        misses.is_empty(),
        "{compared} compared\n{}",
        misses.join("\n")
    );
    assert_eq!(compared, 226);
}

fn two_masses(settings: &[(&str, f64)]) -> Scene {
    let scene = Scene::read("scenarios/rocker/two_masses.json").expect("scene");
    let settings = settings.iter();
    settings.fold(scene.duration(0.1), |scene, (path, value)| {
        scene.set(path, *value)
    })
}

/// A closing moment of 600 N m, one turn: the derivative grows 3000 times within 1.3 % of the inertia.
#[test]
fn the_nearest_change_of_the_sequence_is_told_where_a_result_bends() {
    let figures = ["rocker.delta_max".to_owned()];
    let at = |inertia: f64| {
        let found = ask(
            &two_masses(&[("rocker.inertia", inertia)]),
            &["rocker.inertia"],
            &figures,
            true,
        );
        assert_eq!(
            found.check.as_ref().map(|check| check.failed),
            Some(0),
            "{found:?}"
        );
        let own = &found.figures[0].by[0];
        let change = own.sequence_changes_at.expect("a change");
        (found.events, own.derivative.expect("a derivative"), change)
    };
    // Separations and derivatives of the specification, by central differences of runs.
    for (inertia, separations, expected) in [
        (0.0967, 0, 5.81e-4),
        (0.0968, 2, 0.0718),
        (0.097, 5, 0.371),
        (0.098, 10, 1.82),
    ] {
        let (events, slope, change) = at(inertia);
        assert_eq!(events, 2 * separations, "{inertia}");
        approx::assert_relative_eq!(slope, expected, max_relative = 5e-3);
        if separations == 0 {
            assert!((0.0967..0.0968).contains(&change), "{change}");
        }
    }
}

#[test]
fn bounces_without_damping_leave_nothing_determined() {
    let scene = two_masses(&[("rocker.damping_capacity", 0.0)]);
    let figures = ["rocker.sigma".to_owned()];
    let found = ask(&scene, &["rocker.inertia"], &figures, false);
    // (68 separations; the last of them are a matter of rounding.)
    assert!((130..145).contains(&found.events), "{}", found.events);
    let own = &found.figures[0].by[0];
    assert!(
        matches!(own.verdict, DerivativeVerdict::NotDetermined { .. }),
        "{own:?}"
    );
    assert!(own.derivative.is_none() && !found.is_answered());
}

#[test]
fn counts_have_no_derivative_but_a_place_of_change() {
    let scene = two_masses(&[("rocker.inertia", 0.0968)]);
    let figures = ["separations", "closures", "in_working_order", "margin"]
        .map(|name| format!("rocker.pair.{name}"));
    let found = ask(&scene, &["rocker.inertia"], &figures, false);
    for figure in &found.figures {
        let own = &figure.by[0];
        assert!(
            matches!(own.verdict, DerivativeVerdict::NotApplicable { .. }),
            "{figure:?}"
        );
        assert!(own.sequence_changes_at.is_some());
    }
}

/// Cams and other laws in pieces, by numbers that move the pieces and by others: the check by
/// differences of runs holds.
#[test]
fn derivatives_of_other_laws_agree_with_differences_of_runs() {
    for (scene, by, figure) in [
        (
            "cams/eccentric_jump",
            ["follower.inertia", "follower.stiffness"],
            "follower.delta_max",
        ),
        (
            "indexing/residual_vibration",
            ["cam.motion.speed", "frame.position.cam.lift"],
            "frame.sigma",
        ),
        (
            "indexing/soft_shock",
            ["cam.motion.speed", "lever.position.cam.lift"],
            "lever.delta_max",
        ),
        // At the start of every part of its law it stands still.
        (
            "../src/frontend/scene/templates/lever",
            ["camshaft.motion.speed", "lever.position.cam.lift"],
            "lever.delta_max",
        ),
    ] {
        let scene = Scene::read(format!("scenarios/{scene}.json")).expect("scene");
        let found = ask(&scene, &by, &[figure.to_owned()], true);
        let check = found.check.as_ref().expect("check");
        assert_eq!((check.compared, check.failed), (2, 0), "{found:?}");
        assert!(check.worst < 1e-7, "{check:?}");
    }
}

#[test]
fn what_has_no_derivative_is_refused_with_the_reason() {
    let question = |by: &str, figure: &str| GradientQuestion {
        by: vec![by.to_owned()],
        figures: vec![figure.to_owned()],
        check: Some(false),
    };
    let refused = |by: &str, figure: &str| {
        let scene = two_masses(&[]);
        let found = scene.gradient(&question(by, figure), &Control::default());
        found.expect_err("no derivatives").to_string()
    };
    for (by, figure, words) in [
        (
            "rocker.masses",
            "rocker.sigma",
            ["counts", "dam compare --over rocker.masses"],
        ),
        (
            "rocker.pair.closure",
            "rocker.sigma",
            ["is no number", "dam compare"],
        ),
        (
            "rocker.inertja",
            "rocker.sigma",
            ["inertja", "did you mean `inertia`?"],
        ),
        (
            "rokker.inertia",
            "rocker.sigma",
            ["rokker", "did you mean `rocker`?"],
        ),
        (
            "rocker.inertia",
            "rocker.sigmma",
            ["rocker.sigmma", "did you mean `rocker.sigma`"],
        ),
        (
            "rocker.inertia",
            "shaft.final.speed",
            ["no result of an elastic object", "rocker."],
        ),
    ] {
        let message = refused(by, figure);
        for words in words {
            assert!(
                message.contains(words),
                "{by}, {figure}: {words} in\n{message}"
            );
        }
    }
    let until = two_masses(&[]).set("run.until", r#"{"of": "rocker", "condition": "phi > 1"}"#);
    let found = until.gradient(
        &question("rocker.inertia", "rocker.sigma"),
        &Control::default(),
    );
    let message = found.expect_err("no derivatives").to_string();
    assert!(message.contains("run.until"), "{message}");
}
