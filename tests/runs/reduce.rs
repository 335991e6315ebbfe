//! The smallest scene that gives figures within their accuracy.

use approx::assert_relative_eq;
use dam::prelude::*;
use dam::read::Node;
use dam::studies::Control;
use dam::studies::order::Certainty;
use dam::studies::reduce::{Part, Reduction, Refusal, Step};
use std::sync::atomic::AtomicBool;

fn of(part: &Part) -> impl Fn(&&Step) -> bool + '_ {
    move |step| step.removal.part == *part
}

fn is_left_out(found: &Reduction, part: &Part) -> bool {
    found.removed().any(|step| of(part)(&step))
}

/// The scene with figures asked for within 1 %.
fn asking(scene: &Scene, figures: &[&str]) -> Scene {
    let mut asked = Node::object();
    for figure in figures {
        asked.set_property(figure, "1 %");
    }
    scene.clone().set("run.accuracy", asked)
}

fn value(scene: &Scene, figure: &str) -> f64 {
    let run = scene.run().expect("a run");
    run.figures.value(figure).expect("a figure")
}

#[test]
fn a_closed_rocker_needs_no_coordinates_of_its_own() {
    let scene = Scene::read("scenarios/rocker/ten_masses_closed.json").expect("a scene");
    let figure = "rocker.delta_abs";
    let found = asking(&scene, &[figure]).reduce().expect("a reduction");
    assert!(found.holds() && found.complete);
    let reduced = Scene::of(found.document.clone());
    // The limit by long chains, whose error is of first order.
    let by = |masses: usize| value(&scene.clone().set("rocker.masses", masses), figure);
    let limit = 2.0 * by(256) - by(128);
    assert_relative_eq!(value(&reduced, figure), limit, max_relative = 0.01);
    assert!(is_left_out(&found, &Part::Opening));
    let text = found.document.text();
    assert!(
        text.contains("a bilateral contact, which never separates"),
        "{text}"
    );
    assert!(
        !text.contains("\"expect\"") && text.contains("\"run\""),
        "{text}"
    );
}

/// An elastic slider in a guide: a load that matters, one that does not, a stop that is never
/// reached.
const SLIDE: &str = r#"{ "dam": 1, "name": "Slide", "objects": {
    "drive": { "kind": "drive", "motion": { "speed": "60 rpm" } },
    "shaft": { "kind": "shaft", "input": "drive", "inertia": 0.001, "stiffness": 1e6, "damping_capacity": 0.2, "masses": 2 },
    "slide": { "kind": "slider", "input": "shaft", "position": { "sine": { "amplitude": 0.1 } },
        "inertia": 2, "stiffness": 1e4, "damping_capacity": 0.2, "masses": 3,
        "pair": { "closure": "form", "gap": 1e-5 },
        "stops": { "end": { "at": 0.5, "side": "+", "contact": { "stiffness": 1e6 } } },
        "loads": { "dust": { "constant": 1e-4 }, "cutting": { "constant": -200 } } } },
    "run": { "duration": 2, "tolerance": 1e-8, "accuracy": { "slide.delta_abs": "1 %" } } }"#;

#[test]
fn what_does_not_matter_is_left_out_and_what_matters_stays() {
    let scene = Scene::from_json(SLIDE).expect("a scene");
    let found = scene.reduce().expect("a reduction");
    assert!(found.holds());
    for part in [
        Part::Load("dust".to_owned()),
        Part::Stop("end".to_owned()),
        Part::Opening,
    ] {
        assert!(is_left_out(&found, &part), "{part} of {:#?}", found.steps);
    }
    let cutting = Part::Load("cutting".to_owned());
    let kept = found
        .refused_steps()
        .find(of(&cutting))
        .expect("the load stays");
    assert!(kept.refused.is_some());
    // A thousand times too stiff to matter.
    let levels = &found.certificate.models["shaft"];
    assert_eq!(levels.level.to_string(), "rigid");
    // The reduced scene is a scene: it gives what is said of it.
    assert!(found.is_offered());
    let cost = found.cost.expect("both are run");
    assert!(cost.repeats >= 3 && cost.given.least > 0.0, "{cost:?}");
    assert!(
        cost.reduced.median >= cost.reduced.least && cost.reduced.least > 0.0,
        "{cost:?}"
    );
    let reduced = Scene::of(found.document.clone());
    let said = &found.certificate.accuracy["slide.delta_abs"];
    assert_eq!(value(&reduced, "slide.delta_abs"), said.value);
    // And the whole one, with more masses, gives it too.
    let whole = scene.set("slide.masses", 48).set("shaft.masses", 8);
    let off = (value(&whole, "slide.delta_abs") - said.value).abs();
    assert!(
        off <= said.error.expect("an error") + 0.01 * said.value,
        "{off}"
    );
}

/// Makes every object rigid that a reduction calls so, in the scene with so many masses in
/// each elastic object, and compares the figures asked for.
fn rigid_at_once(path: &str, figures: &[&str], masses: usize) {
    let mut scene = Scene::read(path).expect("a scene");
    scene = scene.set("run.tolerance", 1e-8);
    let found = asking(&scene, figures).reduce().expect("a reduction");
    assert!(found.holds(), "{path}: {:#?}", found.certificate.accuracy);
    let levels = &found.certificate.models;
    let rigid: Vec<&String> = levels
        .iter()
        .filter(|(_, model)| model.coordinates == 0)
        .map(|(id, _)| id)
        .collect();
    assert!(!rigid.is_empty(), "{path}: {levels:#?}");
    for id in levels.keys() {
        scene = scene.set(&format!("{id}.masses"), masses);
    }
    let mut simple = scene.clone();
    for id in &rigid {
        simple = simple.set(&format!("{id}.masses"), 0);
    }
    for figure in figures {
        let (whole, simple) = (value(&scene, figure), value(&simple, figure));
        let share = (simple - whole).abs() / whole.abs();
        assert!(
            share <= 0.01,
            "{path}: {figure} changes by {share} without {rigid:?}"
        );
    }
}

#[test]
fn what_is_called_rigid_changes_no_figure_of_the_sewing_machine() {
    let figures = [
        "motor.peak_speed",
        "needle_bar.peak_reaction",
        "needle_bar.peak_speed",
    ];
    rigid_at_once("scenarios/fan_out/sewing_machine.json", &figures, 8);
}

#[test]
fn what_is_called_rigid_changes_no_figure_of_the_press() {
    let figures = ["motor.peak_speed", "motor.final.speed", "ram.peak_speed"];
    rigid_at_once("scenarios/press/punching.json", &figures, 4);
}

#[test]
fn a_linkage_that_is_driven_by_a_prescribed_motion_may_be_massless() {
    let scene = Scene::read("scenarios/linkages/toggle_press.json").expect("a scene");
    let found = asking(&scene, &["tool.delta_abs"])
        .reduce()
        .expect("a reduction");
    assert!(is_left_out(&found, &Part::Masses), "{:#?}", found.steps);
    let work = Part::Load("work".to_owned());
    let kept = found
        .refused_steps()
        .find(of(&work))
        .expect("the work stays");
    assert!(matches!(kept.refused, Some(Refusal::Figure { .. })));
    let reduced = Scene::of(found.document.clone());
    let (figure, said) = (
        "tool.delta_abs",
        &found.certificate.accuracy["tool.delta_abs"],
    );
    assert_eq!(value(&reduced, figure), said.value);
}

#[test]
fn a_figure_without_a_limit_judges_nothing() {
    let scene = Scene::read("scenarios/rocker/two_masses.json").expect("a scene");
    let found = asking(&scene, &["rocker.pair.max_contact_force"])
        .reduce()
        .expect("a reduction");
    assert!(!found.holds() && found.steps.is_empty());
    let force = &found.certificate.accuracy["rocker.pair.max_contact_force"];
    assert_eq!(force.kind, Certainty::NoLimit);
}

#[test]
fn a_search_that_is_ended_says_so() {
    let scene = Scene::from_json(SLIDE).expect("a scene");
    let flag = AtomicBool::new(true);
    let found = scene
        .reduce_within(&Control::interrupted_by(&flag))
        .expect("a reduction");
    assert!(!found.complete);
}

/// Ten masses are propagated exactly in less time than the motion of the rigid lever is sampled.
#[test]
fn a_smaller_scene_that_runs_slower_is_not_offered() {
    let scene = Scene::read("scenarios/rocker/ten_masses_closed.json").expect("a scene");
    let mut asked = Node::object();
    asked.set_property("rocker.delta_abs", "20 %");
    let asked = scene.clone().set("run.accuracy", asked);
    let found = asked.reduce().expect("a reduction");
    assert!(found.complete && found.holds() && found.given_holds());
    let cost = found.cost.expect("both are run");
    assert!(cost.repeats >= 3 && cost.is_slower(), "{cost:?}");
    assert!(!found.is_offered());
    // The answer is the scene as given, with what its own figures are worth.
    let text = found.document.text();
    assert!(
        text.contains("\"masses\": 10") && !text.contains("Reduced"),
        "{text}"
    );
    let offered = Scene::of(found.document.clone());
    assert_eq!(
        value(&offered, "rocker.delta_abs"),
        value(&scene, "rocker.delta_abs")
    );
    let figure = &found.certificate.accuracy["rocker.delta_abs"];
    assert_relative_eq!(
        figure.value,
        value(&scene, "rocker.delta_abs"),
        max_relative = 1e-9
    );
    let removed: Vec<String> = found
        .removed()
        .map(|step| step.removal.to_string())
        .collect();
    assert!(!removed.is_empty(), "a smaller scene was found");
}
