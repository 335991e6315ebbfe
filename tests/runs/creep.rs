//! Regularised friction below its limit: the creep is stated, with the figures of closed
//! forms, and the answer is never "in working order".

use dam::integrate::Method;
use dam::prelude::*;
use dam::report::verdict::verdict;
use dam::studies::judgement::Judgement;

fn run(load: &str, torque: f64, speed: f64, method: &str) -> RunResult {
    let text = format!(
        r#"{{ "dam": 1, "name": "block", "objects": {{ "d": {{ "kind": "drive",
            "motor": {{ "inertia": 2, "speed": {speed}, "torque": {{ "constant": {torque} }} }},
            "loads": {{ "hold": {load} }} }} }},
            "run": {{ "duration": 10, "method": "{method}" }} }}"#
    );
    let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    scene
        .run()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

const FRICTION: &str = r#"{ "friction": { "force": 5, "width": 0.001 } }"#;
const WRITTEN: &str = r#"{ "expression": "-5*tanh(phi_dot/0.001)" }"#;

/// 3 rad/s against 5 N·m less 4 N·m on 2 kg·m²: slides for 6 s, then creeps.
#[test]
fn a_creep_is_stated_and_not_in_working_order() {
    for load in [FRICTION, WRITTEN] {
        for method in [Method::Radau, Method::Dop853, Method::Taylor] {
            let found = run(load, 4.0, 3.0, method.name());
            let figure = |name: &str| found.figures.value(name).expect(name);
            approx::assert_relative_eq!(
                figure("d.creep.speed"),
                1e-3 * 0.8f64.atanh(),
                max_relative = 1e-2
            );
            approx::assert_relative_eq!(figure("d.creep.force"), 4.0, max_relative = 1e-2);
            approx::assert_relative_eq!(figure("d.creep.limit"), 5.0, max_relative = 1e-2);
            approx::assert_abs_diff_eq!(figure("d.creep.from"), 6.0, epsilon = 0.05);
            assert_eq!(found.judgement(), Judgement::NotJudged, "{load} {method}");
            let answer = verdict(&found.figures);
            assert_eq!(answer.headline.to_string(), "Not judged", "{load} {method}");
            let text = answer.text.to_string();
            assert!(
                text.contains("d creeps at") && text.contains("would rest"),
                "{text}"
            );
            let warned = found.figures.warnings.iter();
            assert!(
                warned
                    .clone()
                    .any(|text| text.contains("d creeps at") && text.contains("would rest")),
                "{:?}",
                found.figures.warnings
            );
        }
    }
}

#[test]
fn a_block_that_slides_or_carries_nothing_does_not_creep() {
    // Above its limit it speeds up; without a force it comes to rest.
    for (torque, speed) in [(6.0, 3.0), (0.0, 3.0), (0.0, 0.0)] {
        for load in [FRICTION, WRITTEN] {
            let found = run(load, torque, speed, "radau");
            assert!(
                found.figures.value("d.creep.speed").is_err(),
                "{torque} {speed} {load}"
            );
        }
    }
}

#[test]
fn a_viscous_drag_is_no_friction() {
    let drag = r#"{ "expression": "-4000*phi_dot" }"#;
    let found = run(drag, 4.0, 3.0, "radau");
    assert!(found.figures.value("d.creep.speed").is_err());
}

/// The objects of a run that creep.
fn creeping(objects: &str, duration: f64) -> Vec<String> {
    let text = format!(
        r#"{{ "dam": 1, "name": "pair", "objects": {{ {objects} }},
            "run": {{ "duration": {duration}, "tolerance": 1e-8 }} }}"#
    );
    let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let found = scene
        .run()
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    assert!(found.is_complete() && found.is_trusted(), "{text}");
    let creeping: Vec<String> = (found.figures.objects.iter())
        .filter(|(_, own)| own.creep.is_some())
        .map(|(id, _)| id.clone())
        .collect();
    let expected = match creeping.is_empty() {
        true => Judgement::InWorkingOrder,
        false => Judgement::NotJudged,
    };
    assert_eq!(found.judgement(), expected, "{text}");
    creeping
}

/// A rotor with a torque and a load that may read another object.
fn rotor(id: &str, speed: f64, torque: f64, load: &str, over: &str) -> String {
    format!(
        r#""{id}": {{ "kind": "drive", "motor": {{ "inertia": 1, "speed": {speed},
            "torque": {{ "constant": {torque} }} }},
            "loads": {{ "c": {{ "expression": "{load}"{over} }} }} }}"#
    )
}

/// Laws that are steep at rest and flat beyond, under 4 of their 5 N·m.
#[test]
fn all_forms_of_a_steep_friction_are_seen() {
    for load in [
        "-5*tanh(phi_dot/0.001)",
        "-5*phi_dot/(abs(phi_dot)+0.001)",
        "-5*phi_dot/sqrt(phi_dot^2+1e-6)",
        "-5*2/pi*atan(phi_dot/0.001)",
        "-(5+2*exp(-(phi_dot/0.1)^2))*tanh(phi_dot/0.001)",
        "-5*max(-1, min(1, phi_dot/0.001))",
    ] {
        assert_eq!(
            creeping(&rotor("d", 0.5, 4.0, load, ""), 2.0),
            ["d"],
            "{load}"
        );
    }
}

/// Two discs that slip against each other by 0.8 of what holds them: on a slow or a
/// standing disc that is a creep, between two that turn fast together it is not.
#[test]
fn a_friction_between_two_objects_creeps_as_one_on_the_ground_does() {
    let pair = |torque: f64, speed: f64| {
        let a = rotor(
            "a",
            speed,
            torque,
            "-5*tanh((phi_dot-over_phi_dot)/0.001)",
            r#", "over": "b""#,
        );
        format!(r#"{a}, "b": {{ "kind": "drive", "motion": {{ "speed": "{speed} rad/s" }} }}"#)
    };
    assert_eq!(creeping(&pair(4.0, 0.01), 2.0), ["a"]);
    assert!(creeping(&pair(4.0, 30.0), 2.0).is_empty());
    assert!(creeping(&pair(6.0, 0.01), 2.0).is_empty());
}

/// A mass on a spring of 10 kN·m/rad that a law leaves at rest: under 4 of 5 N·m it would stay
/// where it is. A law that moves it slowly is no creep.
#[test]
fn an_elastic_object_creeps_against_its_law_not_with_it() {
    let rocker = |ratio: f64, load: f64| {
        format!(
            r#""d": {{ "kind": "drive", "motion": {{ "speed": "1 rad/s" }} }},
            "m": {{ "kind": "shaft", "input": "d", "inertia": 0.001, "stiffness": 1e4,
                "damping_capacity": 0.2, "position": {{ "ratio": {ratio} }},
                "loads": {{ "w": {{ "expression": "t < 0.1 ? 0 : {load}" }},
                "hold": {{ "friction": {{ "force": 5, "width": 0.001 }} }} }} }}"#
        )
    };
    assert_eq!(creeping(&rocker(1e-9, 4.0), 1.0), ["m"]);
    assert!(creeping(&rocker(1e-3, 0.0), 1.0).is_empty());
}

/// A slide behind a crank on a motor whose torque does not overcome the friction of its guide.
#[test]
fn a_slide_that_friction_holds_against_a_motor_creeps() {
    let slide = |torque: f64| {
        format!(
            r#""d": {{ "kind": "drive", "motor": {{ "inertia": 0.2, "angle": "90 deg",
                "torque": {{ "constant": {torque} }} }} }},
            "s": {{ "kind": "slider", "input": "d", "masses": 0, "inertia": 2,
                "position": {{ "slider_crank": {{ "crank": 0.1, "rod": 0.4 }} }},
                "loads": {{ "guide": {{ "friction": {{ "force": 500, "width": 0.001 }} }} }} }}"#
        )
    };
    assert!(creeping(&slide(30.0), 2.0).contains(&"s".to_owned()));
    assert!(creeping(&slide(80.0), 2.0).is_empty());
}

/// A map over the torque: held below the limit of 4.5 N·m, sliding above it.
#[test]
fn a_map_tells_cells_that_creep_from_those_that_work() {
    let text = format!(
        r#"{{ "dam": 1, "name": "map", "objects": {{ {} }},
            "run": {{ "duration": 2, "tolerance": 1e-8 }} }}"#,
        rotor("d", 0.0, 4.0, "-4.5*tanh(phi_dot/0.001)", "")
    );
    let scene = Scene::from_json(&text).unwrap();
    let map = scene
        .map(Axis::linear("d.motor.torque.constant", 3.0, 7.0, 3))
        .figure("d", Figure::FinalSpeed)
        .ask()
        .unwrap();
    let verdicts: Vec<Verdict> = map.cells.iter().map(|cell| cell.verdict).collect();
    let [creeps, works] = [Verdict::CreepNotJudged, Verdict::InWorkingOrder];
    assert_eq!(verdicts, [creeps, works, works]);
}

/// The creep is a figure that a scene may expect.
#[test]
fn a_creep_may_be_expected() {
    let text = format!(
        r#"{{ "dam": 1, "name": "expected", "objects": {{ {} }},
            "run": {{ "duration": 2, "tolerance": 1e-8 }},
            "expect": [ {{ "figure": "d.creep.speed", "value": "0.0010986 rad/s", "within": 1e-7 }} ] }}"#,
        rotor("d", 0.5, 4.0, "-5*tanh(phi_dot/0.001)", "")
    );
    let warnings = Scene::from_json(&text).unwrap().check().unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
}
