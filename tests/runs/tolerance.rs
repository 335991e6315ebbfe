//! A run whose figures are to keep an accuracy is integrated no more finely than that needs,
//! and says truly how far its figures are off by it.

use dam::ask::ModelAssessment;
use dam::prelude::*;
use dam::studies::run::{RunResult, run};
use dam::studies::spread::repeat_with_changes;
use dam::studies::{Control, RunSettings};
use serde_json::Value;

/// A scenario without a tolerance of its own, nothing expected of it.
fn scenario(name: &str) -> Value {
    let path = format!("scenarios/{name}.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut scene: Value = serde_json::from_str(&text).expect("JSON");
    scene["run"]
        .as_object_mut()
        .expect("a run")
        .remove("tolerance");
    scene.as_object_mut().expect("a scene").remove("expect");
    scene
}

/// The same with the accuracy of a figure, and the model of an object to be chosen.
fn asking(name: &str, figure: &str, accuracy: &str, open: &[&str]) -> Value {
    let mut scene = scenario(name);
    scene["run"]["accuracy"] = serde_json::json!({ figure: accuracy });
    for id in open {
        scene["objects"][id]["masses"] = "auto".into();
    }
    if name.starts_with("rocker") && figure.starts_with("rocker.pair") {
        // With a contact that is not linear there is something to integrate.
        scene["run"]["duration"] = 0.1.into();
        scene["objects"]["rocker"]["pair"]["contact"] = serde_json::json!(
            { "law": "hunt_crossley", "stiffness": 1e7, "dissipation": 0.3 }
        );
    }
    scene
}

fn prepared(scene: &Value) -> Mechanism {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    let reading = scene.decode().expect("a sound scene");
    Mechanism::of_within(reading, ModelAssessment::Asked, &Control::default()).expect("a mechanism")
}

fn run_at(mechanism: &Mechanism, tolerance: f64) -> RunResult {
    let settings = RunSettings {
        tolerance,
        of_accuracy: None,
        ..mechanism.settings.clone()
    };
    run(&mechanism.system, &settings, &Control::default(), &mut []).expect("a run")
}

/// Of motors against a fan and a press, a screw, an ejector that lifts off, a run-up, a branch
/// beside an exact one, bounces on a Hunt–Crossley contact; by four methods.
#[test]
fn an_accuracy_is_integrated_for_with_fewer_steps_and_the_error_that_is_stated() {
    for (name, figure, accuracy, open) in [
        ("shafts/fan_on_line", "tube.delta_abs", "1 %", &[][..]),
        ("shafts/fan_on_line", "tube.peak_reaction", "0.1 %", &[]),
        ("shafts/vertical_feed", "screw.delta_abs", "1 %", &[]),
        (
            "press/ejector",
            "ejector.delta_abs",
            "1 %",
            &["ejector", "ram"],
        ),
        ("steady/press_elastic", "ram.delta_abs", "1 %", &[]),
        ("press/run_up", "ram.delta_abs", "1 %", &[]),
        ("packaging/pusher", "lever.delta_abs", "1 %", &[]),
        (
            "rocker/two_masses",
            "rocker.pair.max_contact_force",
            "1 %",
            &["rocker"],
        ),
    ] {
        let mechanism = prepared(&asking(name, figure, accuracy, open));
        let certificate = mechanism.certificate.as_ref().expect("a certificate");
        let told = &certificate.accuracy[figure];
        let stated = told.shares.expect("an error").integration;
        let found = mechanism.run().expect("a run");
        let value = found.figures.value(figure).expect("a value");
        assert_eq!(value, told.value, "{name} {figure}");
        let truth = run_at(&mechanism, 1e-12).figures.value(figure);
        let off = (value - truth.expect("a value")).abs();
        let words = format!(
            "{name} {figure}: {off:e}, stated {stated:e} of {:e}",
            told.asked
        );
        assert!(off <= stated, "{words}");
        assert!(stated <= 0.1 * told.asked, "{words}");
        let taken = mechanism
            .settings
            .of_accuracy
            .as_ref()
            .expect("a tolerance");
        assert!(
            taken.tolerance > 1e-6 && taken.why.contains(figure),
            "{taken:?}"
        );
        assert_eq!(found.figures.run.tolerance, taken.tolerance);
        assert_eq!(found.figures.run.tolerance_why.as_ref(), Some(&taken.why));
        let usual = run_at(&mechanism, 1e-6).figures.run.evaluations;
        let less = found.figures.run.evaluations;
        assert!(less < usual, "{words}: {less} of {usual} evaluations");
    }
}

/// The acceleration at its start is off by more than a coarse tolerance promises.
#[test]
fn a_tolerance_that_a_figure_does_not_keep_is_not_taken() {
    let figure = "ram.peak_acceleration";
    let mechanism = prepared(&asking("press/run_up", figure, "1 %", &[]));
    let truth = run_at(&mechanism, 1e-12)
        .figures
        .value(figure)
        .expect("a value");
    let off = |tolerance: f64| {
        let value = run_at(&mechanism, tolerance).figures.value(figure);
        (value.expect("a value") - truth).abs()
    };
    assert!(off(1e-1) > 0.1 * 0.01 * truth);
    let taken = mechanism
        .settings
        .of_accuracy
        .as_ref()
        .map_or(1e-6, |found| found.tolerance);
    assert!(taken < 1e-1 && off(taken) < 0.1 * 0.01 * truth, "{taken}");
}

/// Counts are right or wrong, and what is expected of a scene binds too.
#[test]
fn what_counts_and_what_is_expected_bind_the_tolerance() {
    let mut scene = asking("shafts/fan_on_line", "tube.delta_abs", "1 %", &[]);
    let free = prepared(&scene).settings.of_accuracy.expect("a tolerance");
    let value = prepared(&scene)
        .run()
        .expect("a run")
        .figures
        .value("tube.delta_abs");
    let value = value.expect("a value");
    scene["expect"] = serde_json::json!([
        { "figure": "tube.delta_abs", "value": value, "within": 5e-5 * value }
    ]);
    let bound = prepared(&scene).settings.of_accuracy.expect("a tolerance");
    assert!(bound.tolerance < free.tolerance, "{bound:?} {free:?}");
    let counted = prepared(&asking(
        "press/ejector",
        "ejector.pair.separations",
        "0",
        &["ejector"],
    ));
    let separations = |tolerance: f64| {
        let found = run_at(&counted, tolerance);
        found.figures.value("ejector.pair.separations")
    };
    let taken = counted
        .settings
        .of_accuracy
        .as_ref()
        .map_or(1e-6, |found| found.tolerance);
    assert_eq!(separations(taken), separations(1e-11));
}

/// What a coarse integration moves is no spread: that is told beside it.
#[test]
fn a_spread_is_that_of_the_usual_tolerance() {
    let mechanism = prepared(&asking("press/run_up", "ram.delta_abs", "1 %", &[]));
    assert!(mechanism.settings.of_accuracy.is_some());
    let base = mechanism.run().expect("a run");
    let control = Control::default();
    let found = repeat_with_changes(&mechanism.system, &mechanism.settings, &base, &control);
    let found = found.expect("a spread");
    let usual = run_at(&mechanism, 1e-6);
    let own = RunSettings {
        of_accuracy: None,
        ..mechanism.settings.clone()
    };
    let plain = repeat_with_changes(&mechanism.system, &own, &usual, &control).expect("a spread");
    assert_eq!(found, plain);
}

#[test]
fn what_the_author_says_and_what_nobody_asks_for_stays() {
    let asked = asking("shafts/fan_on_line", "tube.delta_abs", "1 %", &[]);
    let with = |name: &str, value: Value| {
        let mut scene = asked.clone();
        scene["run"][name] = value;
        prepared(&scene)
    };
    let own = with("tolerance", 1e-6.into());
    assert_eq!(own.settings.of_accuracy, None);
    let found = own.run().expect("a run");
    assert_eq!(found.figures.run.tolerance, 1e-6);
    assert_eq!(found.figures.run.tolerance_why, None);
    // By the usual tolerance the figures are those of a scene that asks for nothing.
    let plain = Scene::from_json(&scenario("shafts/fan_on_line").to_string()).expect("a scene");
    let plain = plain.run().expect("a run");
    assert_eq!(plain.figures.objects, found.figures.objects);
    assert_eq!(with("method", "radau".into()).settings.of_accuracy, None);
    // In closed form there is nothing to integrate.
    let exact = asking("rocker/two_masses", "rocker.delta_max", "1 %", &[]);
    let exact = prepared(&exact);
    assert_eq!(exact.settings.of_accuracy, None);
    assert_eq!(exact.run().expect("a run").figures.run.tolerance, 1e-6);
}
