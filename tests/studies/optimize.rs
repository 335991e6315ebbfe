//! Best values of several variables against the optima of the reference, which a linear programme
//! and a bisection with 40 digits gave.

use dam::ask::{FindQuestion, OptimizeQuestion};
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::find::Aim;
use dam::studies::optimize::{Optimization, StartEnd};
use serde_json::{Value, json};

const REFERENCE: &str = include_str!("../reference/design-optimum-tolerance.json");

fn number(value: &Value) -> f64 {
    value.as_str().expect("text").parse().expect("number")
}

fn case(name: &str) -> Value {
    let all: Value = serde_json::from_str(REFERENCE).expect("JSON");
    all[name].clone()
}

/// A rigid follower on an eccentric with its spring, as the reference has it.
fn cam_and_spring(case: &Value) -> Scene {
    let e = number(&case["eccentricity"]);
    let rpm = number(&case["rpm"]);
    let scene = json!({
        "dam": 1,
        "name": "cam and spring",
        "objects": {
            "cam": { "kind": "drive", "motion": { "speed": format!("{rpm} rpm") } },
            "follower": {
                "kind": "slider", "input": "cam", "masses": 0,
                "position": { "sine": { "amplitude": e, "phase": "-90 deg", "offset": e } },
                "inertia": number(&case["mass"]),
                "pair": { "closure": "force" },
                "loads": { "spring": { "spring": { "rate": number(&case["stiffness"]), "preload": 20 } } },
            },
        },
        "run": { "duration": 120.0 / rpm },
    });
    Scene::from_json(&scene.to_string()).expect("JSON")
}

const RATE: &str = "follower.loads.spring.spring.rate";
const PRELOAD: &str = "follower.loads.spring.spring.preload";

fn ask(scene: &Scene, vary: &[String], subject: &[String], goal: (Aim, &str)) -> Optimization {
    let question = OptimizeQuestion {
        vary: vary.to_vec(),
        subject: subject.to_vec(),
        goal: Some((goal.0, goal.1.to_owned())),
        starts: 4,
        ..OptimizeQuestion::default()
    };
    scene
        .optimize(&question, &Control::default())
        .expect("an answer")
}

fn near(found: f64, wanted: f64) {
    let within = 1e-6 * wanted.abs().max(1e-3);
    assert!((found - wanted).abs() <= within, "{found} is not {wanted}");
}

#[test]
fn the_least_preload_is_that_of_the_reference() {
    for name in ["cam_spring", "cam_spring_stiff"] {
        let case = case(name);
        let least = number(&case["least_force_asked"]);
        let found = ask(
            &cam_and_spring(&case),
            &[format!("{PRELOAD}=0:100 N")],
            &[format!("follower.pair.margin >= {least} N")],
            (Aim::Minimize, PRELOAD),
        );
        let best = found.best().expect("an optimum");
        let reference = &case["A_least_preload"];
        near(best.goal, number(&reference["value"]));
        let held = &best.conditions[0];
        assert!(best.stationary && held.active, "{best:?}");
        near(
            held.multiplier.expect("a multiplier"),
            number(&reference["d_by"]["least_force_asked"]),
        );
        assert!(found.starts.iter().all(|start| start.optimum == Some(0)));
    }
}

#[test]
fn the_softest_spring_is_held_by_both_forces() {
    for name in ["cam_spring", "cam_spring_stiff"] {
        let case = case(name);
        let reference = &case["B_softest_spring"];
        let least = number(&case["least_force_asked"]);
        let most = number(&reference["greatest_force_allowed"]);
        let found = ask(
            &cam_and_spring(&case),
            &[format!("{RATE}=0:5000 N/m"), format!("{PRELOAD}=0:100 N")],
            &[
                format!("follower.pair.margin >= {least} N"),
                format!("follower.pair.max_contact_force <= {most} N"),
            ],
            (Aim::Minimize, RATE),
        );
        let best = found.best().expect("an optimum");
        near(best.values[0], number(&reference["stiffness"]));
        near(best.values[1], number(&reference["preload"]));
        let multipliers = &reference["multipliers"];
        let wanted = [
            number(&multipliers["d_stiffness_by_least_force_asked"]),
            number(&multipliers["d_stiffness_by_greatest_force_allowed"]),
        ];
        for (held, wanted) in best.conditions.iter().zip(wanted) {
            near(held.multiplier.expect("a multiplier"), wanted);
            assert_eq!(held.unit, "(N/m)/N");
        }
        assert!(best.stationary && best.flat.is_empty(), "{best:?}");
        // The scene that is written is the scene with these values.
        let written = Scene::from_json(&found.scene_text).expect("JSON");
        let run = written.run().expect("a run");
        near(
            run.figures
                .value("follower.pair.max_contact_force")
                .unwrap(),
            most,
        );
    }
}

#[test]
fn springs_that_are_equally_good_are_a_stretch() {
    for name in ["cam_spring", "cam_spring_stiff"] {
        let case = case(name);
        let reference = &case["C_not_unique"];
        let least = number(&case["least_force_asked"]);
        let found = ask(
            &cam_and_spring(&case),
            &[format!("{RATE}=0:5000 N/m"), format!("{PRELOAD}=0:100 N")],
            &[format!("follower.pair.margin >= {least} N")],
            (Aim::Minimize, "follower.pair.max_contact_force"),
        );
        let best = found.best().expect("an optimum");
        near(best.goal, number(&reference["value"]));
        assert_eq!(best.values[1], 0.0);
        assert_eq!((best.flat.len(), found.optima.len()), (1, 1), "{found:?}");
        let mut ends = [best.flat[0].from[0], best.flat[0].to[0]];
        ends.sort_by(f64::total_cmp);
        near(ends[0], number(&reference["stiffness_from"]));
        near(ends[1], number(&reference["stiffness_to"]));
    }
}

#[test]
fn forces_that_contradict_each_other_are_named() {
    let case = case("cam_spring");
    let found = ask(
        &cam_and_spring(&case),
        &[format!("{RATE}=0:5000 N/m"), format!("{PRELOAD}=0:100 N")],
        &[
            "follower.pair.margin >= 1 N".to_owned(),
            "follower.pair.max_contact_force <= 9 N".to_owned(),
            "follower.peak_speed <= 10 m/s".to_owned(),
        ],
        (Aim::Minimize, RATE),
    );
    // The preload alone gives 8.773 N at the top of the inertia force: 0.227 N are left for it, and
    // the spring is as stiff as it may be at the bottom.
    let best = found.best().expect("an optimum");
    assert!(best.conditions[1].figure <= 9.0 + 1e-6);
    let tight = ask(
        &cam_and_spring(&case),
        &[format!("{RATE}=0:5000 N/m"), format!("{PRELOAD}=1:100 N")],
        &[
            "follower.pair.max_contact_force <= 9 N".to_owned(),
            "follower.peak_speed <= 10 m/s".to_owned(),
        ],
        (Aim::Minimize, RATE),
    );
    // 1 N and the 8.773 N of the inertia are more than 9 N, by 0.773 N.
    let least = tight.least_violation.as_ref().expect("a violation");
    assert!(tight.best().is_none() && !tight.is_answered());
    assert_eq!(
        (least.conflict.as_slice(), least.bounds.as_slice()),
        (&[0][..], &[PRELOAD.to_owned()][..])
    );
    near(least.violations[0], 1.0 + 8.772_981_689_857_21 - 9.0);
    assert!(
        tight
            .starts
            .iter()
            .all(|start| start.end == StartEnd::Infeasible)
    );
}

fn two_masses() -> Scene {
    Scene::read("scenarios/rocker/two_masses.json").expect("a scene")
}

#[test]
fn exact_slopes_lead_to_where_the_search_in_one_variable_ends() {
    let scene = two_masses();
    let subject = vec!["rocker.delta_abs <= 8 mrad".to_owned()];
    let found = ask(
        &scene,
        &["rocker.inertia=0.09:0.12".to_owned()],
        &subject,
        (Aim::Maximize, "rocker.inertia"),
    );
    let best = found.best().expect("an optimum");
    assert!(found.slopes.exact > 0, "{:?}", found.slopes);
    let question = FindQuestion {
        vary: "rocker.inertia=0.09:0.12".to_owned(),
        subject,
        goal: Some((Aim::Maximize, "rocker.inertia".to_owned())),
        ..FindQuestion::default()
    };
    let single = scene
        .find(&question, &Control::default())
        .expect("an answer");
    let single = single.found.best.expect("a value").sample.value;
    assert!(
        best.goal >= single - 1e-6 && best.conditions[0].figure <= 8e-3 * (1.0 + 1e-6),
        "{} {single}",
        best.goal
    );
    // One level finer: four masses.
    let finer = found.finer.as_ref().expect("a check");
    assert!(
        finer.levels.contains('4') && finer.stands.is_some(),
        "{finer:?}"
    );
}

#[test]
fn answers_do_not_depend_on_the_number_of_threads() {
    let scene = cam_and_spring(&case("cam_spring"));
    let of = |threads: usize| {
        let question = OptimizeQuestion {
            vary: vec![format!("{RATE}=0:5000 N/m"), format!("{PRELOAD}=0:100 N")],
            subject: vec!["follower.pair.margin >= 0".to_owned()],
            goal: Some((Aim::Minimize, "follower.pair.max_contact_force".to_owned())),
            starts: 5,
            threads: Some(threads),
        };
        let found = scene
            .optimize(&question, &Control::default())
            .expect("an answer");
        found.document("scene").to_string()
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn a_start_without_values_has_its_cause() {
    // A mass below zero is no mass: half of the range has no values, the first start among it.
    let found = ask(
        &cam_and_spring(&case("cam_spring")),
        &[
            "follower.inertia=-1:1:-0.5 kg".to_owned(),
            format!("{PRELOAD}=0:100 N"),
        ],
        &["follower.pair.margin >= 0".to_owned()],
        (Aim::Maximize, "follower.inertia"),
    );
    let failed: Vec<bool> = (found.starts.iter())
        .map(|start| start.end == StartEnd::Failed)
        .collect();
    assert!(failed[0] && failed.contains(&false), "{:?}", found.starts);
    for (start, failed) in found.starts.iter().zip(failed) {
        assert_eq!(failed, start.goal.is_none(), "{start:?}");
        assert_eq!(failed, start.why.contains("at least 0"), "{start:?}");
    }
    assert_eq!(found.best().expect("an optimum").goal, 1.0);
}

#[test]
fn wrong_questions_are_refused_with_all_that_is_wrong() {
    let question = OptimizeQuestion {
        vary: vec![
            "rocker.inertai=0.1:0.2".to_owned(),
            "rocker.masses=1:4".to_owned(),
        ],
        subject: vec![
            "rocker.delta_abs < 1 mrad".to_owned(),
            "rocker.pair.separations <= 0".to_owned(),
        ],
        goal: None,
        ..OptimizeQuestion::default()
    };
    let error = two_masses()
        .optimize(&question, &Control::default())
        .unwrap_err();
    let text = error.to_string();
    for wanted in ["rocker.inertai", "strict", "separations", "--minimize"] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    let question = OptimizeQuestion {
        vary: vec!["rocker.masses=1:4".to_owned()],
        goal: Some((Aim::Minimize, "rocker.delta_abs".to_owned())),
        ..OptimizeQuestion::default()
    };
    let error = two_masses()
        .optimize(&question, &Control::default())
        .unwrap_err();
    assert!(error.to_string().contains("counts"), "{error}");
}

#[test]
fn a_scene_holds_its_own_question() {
    let mut text: Value = serde_json::from_str(cam_and_spring(&case("cam_spring")).json()).unwrap();
    text["optimize"] = json!({
        "vary": [format!("{PRELOAD}=0:100 N")],
        "subject": ["follower.pair.margin >= 0"],
        "minimize": PRELOAD,
        "starts": 2,
    });
    let scene = Scene::from_json(&text.to_string()).unwrap();
    let ask = |question: &OptimizeQuestion| scene.optimize(question, &Control::default());
    let found = ask(&OptimizeQuestion::default()).expect("an answer");
    near(found.best().expect("an optimum").goal, 8.372_981_689_857_21);
    assert_eq!(found.starts.len(), 2);
    // What is asked goes before what the scene has.
    let other = OptimizeQuestion {
        subject: vec!["follower.pair.margin >= 1 N".to_owned()],
        ..OptimizeQuestion::default()
    };
    let found = ask(&other).expect("an answer");
    near(found.best().expect("an optimum").goal, 9.372_981_689_857_21);
}

#[test]
fn an_end_from_outside_is_said() {
    let flag = std::sync::atomic::AtomicBool::new(true);
    let control = Control::interrupted_by(&flag);
    let question = OptimizeQuestion {
        vary: vec![format!("{PRELOAD}=0:100 N")],
        subject: vec!["follower.pair.margin >= 0".to_owned()],
        goal: Some((Aim::Minimize, PRELOAD.to_owned())),
        starts: 3,
        ..OptimizeQuestion::default()
    };
    let scene = cam_and_spring(&case("cam_spring"));
    let found = scene.optimize(&question, &control).expect("an answer");
    assert!(!found.complete && found.best().is_none());
    assert!(
        found
            .starts
            .iter()
            .all(|start| start.end == StartEnd::Interrupted)
    );
}

/// The follower on its eccentric of the scenario, 1 kg at 52 rpm, rigid.
fn eccentric() -> Scene {
    let scene = Scene::read("scenarios/cams/eccentric_jump.json").expect("a scene");
    scene.set("follower.masses", 0)
}

#[test]
fn the_ends_of_a_range_of_ten_decades_do_not_hide_the_optimum() {
    let limit = ["follower.pair.max_contact_force <= 10 N".to_owned()];
    let narrow = ask(
        &eccentric(),
        &[format!("{RATE}=1:1e4 N/m:log")],
        &limit,
        (Aim::Maximize, RATE),
    );
    let wide = ask(
        &eccentric(),
        &[format!("{RATE}=1:1e10 N/m:log")],
        &limit,
        (Aim::Maximize, RATE),
    );
    for found in [narrow, wide] {
        let best = found.best().expect("an optimum");
        assert!(best.stationary && best.conditions[0].active, "{best:?}");
        // The force is preload, rate times the stroke, and the inertia: a line in the rate.
        near(best.conditions[0].figure, 10.0);
        for other in &found.optima {
            assert!(other.goal <= best.goal * (1.0 + 1e-9), "{other:?}");
        }
    }
}

#[test]
fn a_start_on_the_wrong_end_of_a_kink_goes_on() {
    let question = OptimizeQuestion {
        vary: vec!["follower.position.sine.amplitude=-20:20:0 mm".to_owned()],
        goal: Some((Aim::Maximize, "follower.pair.max_contact_force".to_owned())),
        starts: 1,
        ..OptimizeQuestion::default()
    };
    let found = eccentric().optimize(&question, &Control::default());
    let found = found.expect("an answer");
    // At rest the force is the least that there is; differences across it see no slope.
    let best = found.best().expect("an optimum");
    assert!(best.values[0].abs() > 1.0, "{best:?}");
}

#[test]
fn a_goal_that_counts_is_refused() {
    for goal in [
        "follower.pair.in_working_order",
        "follower.pair.separations",
    ] {
        let question = OptimizeQuestion {
            vary: vec![format!("{RATE}=0:5000 N/m")],
            goal: Some((Aim::Minimize, goal.to_owned())),
            ..OptimizeQuestion::default()
        };
        let refused = eccentric().optimize(&question, &Control::default());
        let refused = refused.expect_err("no slopes").to_string();
        assert!(refused.contains("counts or answers"), "{refused}");
    }
}
