//! Greatest and least values within a part of the motion, between machine angles or times:
//! against closed forms, by all methods; in `expect`, `verify` and `find`.

use approx::assert_relative_eq;
use dam::ask::FindQuestion;
use dam::prelude::*;
use dam::studies::Control;

/// A slider that follows A·sin φ of a drive, A = 0.02 m, and a mass on a spring under a constant
/// force that starts undeflected: δ = F/c·(1 − cos ωt).
fn scene(drive: &str, method: &str, expect: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "spans", "objects": {{
            "main": {{ "kind": "drive", {drive} }},
            "slide": {{ "kind": "slider", "input": "main", "position": {{ "sine": {{ "amplitude": 0.02 }} }}, "inertia": 1e-9, "masses": 0 }},
            "mass": {{ "kind": "slider", "input": "main", "position": {{ "ratio": {{ "ratio": 1e-14 }} }},
                "inertia": 2, "stiffness": 1800, "damping": 0, "masses": 1,
                "loads": {{ "push": {{ "constant": 90 }} }} }} }},
            "run": {{ "duration": 0.9, "start": "on_law", "tolerance": 1e-12, "method": "{method}" }},
            "expect": [{expect}] }}"#
    )
}

const SPEED: f64 = 10.0;
const PRESCRIBED: &str = r#""motion": { "speed": 10 }"#;
/// A rotor so heavy that its speed is that of the start.
const ROTOR: &str = r#""motor": { "inertia": 1e9, "speed": 10, "torque": { "constant": 0 } }"#;

/// What an expectation finds, and whether it holds.
fn found(text: &str) -> Vec<(Option<f64>, bool, String)> {
    let scene = Scene::from_json(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let all = scene
        .verify()
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    let one = |one: &dam::studies::expectations::Requirement| {
        (one.verdict.found, one.holds(), one.verdict.message.clone())
    };
    all.iter().map(one).collect()
}

#[test]
fn extremes_between_machine_angles_are_those_of_the_closed_form() {
    let (a, w) = (0.02, SPEED);
    let rate = (1800.0f64 / 2.0).sqrt();
    let delta = |degrees: f64| 0.05 * (1.0 - (rate * degrees.to_radians() / w).cos());
    // Over both turns of the run that have begun: 0.9 s are 515 deg.
    let turn = 360.0;
    let cases = [
        (
            "slide.peak_speed",
            30.0,
            120.0,
            a * w * 30f64.to_radians().cos(),
        ),
        (
            "slide.peak_speed",
            70.0,
            100.0,
            a * w * 70f64.to_radians().cos(),
        ),
        ("slide.peak_acceleration", 30.0, 120.0, a * w * w),
        (
            "slide.peak_acceleration",
            100.0,
            150.0,
            a * w * w * 100f64.to_radians().sin(),
        ),
        ("slide.peak_speed", 350.0, 370.0, a * w),
        // ω·t = 3φ: greatest at 60 deg and 180 deg, least at 120 deg.
        (
            "mass.delta_max",
            10.0,
            40.0,
            delta(40.0).max(delta(40.0 + turn)),
        ),
        ("mass.delta_max", 70.0, 100.0, delta(70.0).max(delta(100.0))),
        ("mass.delta_max", 50.0, 70.0, 0.1),
        ("mass.delta_min", 110.0, 125.0, 0.0),
        ("mass.delta_abs", 70.0, 80.0, delta(70.0)),
    ];
    for drive in [PRESCRIBED, ROTOR] {
        let methods = match drive == PRESCRIBED {
            true => &["exact", "dop853", "taylor", "radau"][..],
            false => &["dop853", "taylor"][..],
        };
        for method in methods {
            let expect: Vec<String> = cases
                .iter()
                .map(|(figure, from, to, wanted)| {
                    format!(
                        r#"{{ "figure": "{figure}", "over": {{ "from": "{from} deg", "to": "{to} deg" }}, "value": {wanted:?}, "within": 1 }}"#
                    )
                })
                .collect();
            let text = scene(drive, method, &expect.join(", "));
            for ((figure, from, to, wanted), (value, _, _)) in cases.iter().zip(found(&text)) {
                let value = value.unwrap();
                let off = (value - wanted).abs();
                assert!(
                    off <= 1e-9 * (0.01 + wanted.abs()),
                    "{method} {figure} {from} {to}: {value} {wanted}"
                );
            }
        }
    }
}

#[test]
fn a_span_of_times_counts_once_and_the_verdict_names_it() {
    let text = scene(
        PRESCRIBED,
        "auto",
        r#"{ "figure": "slide.peak_speed", "over": { "from": "0.1 s", "to": "0.2 s" }, "at_most": 0.11 },
           { "figure": "slide.peak_speed", "over": { "from": "100 ms", "to": "200 ms" }, "at_most": 0.1 },
           { "figure": "slide.peak_speed from 2 rad to 3 rad", "at_most": 1 },
           { "figure": "slide.peak_acceleration", "over": { "from": "10 mm", "to": "30 mm", "of": "slide" }, "at_least": 0 },
           { "figure": "slide.peak_speed", "over": { "from": "2 s", "to": "3 s" }, "at_most": 1 }"#,
    );
    let all = found(&text);
    let speed = 0.2 * 1f64.cos();
    assert_relative_eq!(all[0].0.unwrap(), speed, max_relative = 1e-13);
    assert!(all[0].1 && !all[1].1);
    assert!(
        all[1].2.contains("slide.peak_speed from 100 ms to 200 ms"),
        "{}",
        all[1].2
    );
    assert_relative_eq!(all[2].0.unwrap(), 0.2 * -3f64.cos(), max_relative = 1e-12);
    // Of its own displacement, from half the amplitude on.
    assert_relative_eq!(
        all[3].0.unwrap(),
        0.02 * SPEED * SPEED,
        max_relative = 1e-12
    );
    assert_eq!(all[4].0, None);
    // The run alone says the same.
    let run = Scene::from_json(&text).unwrap().run().unwrap();
    let value = run
        .figures
        .value("slide.peak_speed from 0.1 s to 0.2 s")
        .unwrap();
    assert_eq!(Some(value), all[0].0);
    assert_eq!(
        run.figures.unit("slide.peak_speed from 0.1 s to 0.2 s"),
        "m/s"
    );
}

#[test]
fn what_has_no_value_over_a_part_is_refused_with_what_has() {
    let refused = |entry: &str| {
        let scene = Scene::from_json(&scene(PRESCRIBED, "auto", entry));
        scene
            .and_then(|scene| scene.verify())
            .unwrap_err()
            .to_string()
    };
    let over = |figure: &str, over: &str| {
        refused(&format!(
            r#"{{ "figure": "{figure}", "over": {over}, "at_most": 1 }}"#
        ))
    };
    let angles = r#"{ "from": "30 deg", "to": "60 deg" }"#;
    for figure in [
        "mass.sigma",
        "mass.final.speed",
        "run.switches",
        "frequency.1",
        "steady.period",
    ] {
        let error = over(figure, angles);
        assert!(
            error.contains("no greatest or least value"),
            "{figure}: {error}"
        );
    }
    assert!(over("mass.sigma", angles).contains("delta_abs"));
    // What the whole run does not have, no part of it has.
    let error = over("mass.pair.margin", angles);
    assert!(error.contains("there is no result"), "{error}");
    let error = over("mass.delta_abs", r#"{ "from": "60 deg", "to": "30 deg" }"#);
    assert!(error.contains("from 350 deg to 370 deg"), "{error}");
    let error = over("mass.delta_abs", r#"{ "from": "60 deg", "to": "1 s" }"#);
    assert!(error.contains("different units"), "{error}");
    let error = over("mass.delta_abs", r#"{ "from": 1, "to": "2 s" }"#);
    assert!(error.contains("must be a text"), "{error}");
    let error = over("mass.delta_abs", r#"{ "from": "1 mm", "to": "2 mm" }"#);
    assert!(error.contains("no drive slides"), "{error}");
    let error = over(
        "mass.delta_abs",
        r#"{ "from": "1 deg", "to": "2 deg", "of": "slid" }"#,
    );
    assert!(error.contains("no object `slid`"), "{error}");
}

#[test]
fn kinematics_and_forces_have_extremes_over_the_angle_of_the_drive() {
    let text = std::fs::read_to_string("scenarios/kinetostatics/slider_crank.json").unwrap();
    let start = text.find("\"expect\"").unwrap();
    let place = |degrees: f64| {
        let phi = degrees.to_radians();
        0.06 * phi.cos() + (0.09 - (0.06 * phi.sin()).powi(2)).sqrt()
    };
    let expect = |from: f64, to: f64| {
        let over = format!(r#""over": {{ "from": "{from} deg", "to": "{to} deg" }}"#);
        format!(
            r#""expect": [
            {{ "figure": "kinematics.mechanism.slide.displacement.greatest", {over}, "value": {:?}, "within": 1e-12 }},
            {{ "figure": "kinematics.mechanism.slide.displacement.least", {over}, "value": {:?}, "within": 1e-12 }},
            {{ "figure": "forces.mechanism.shaking.force.greatest", {over}, "at_least": 0 }} ] }}"#,
            place(30.0),
            place(120.0)
        )
    };
    let whole = format!("{}{}", &text[..start], expect(30.0, 120.0));
    let all = found(&whole);
    assert!(all[0].1 && all[1].1, "{all:?}");
    // Behind a gear the drive turns half as far.
    let geared = format!("{}{}", &text[..start], expect(15.0, 60.0))
        .replace(
            r#""drive": { "kind": "drive", "motion": { "speed": "10 rad/s" } },"#,
            r#""drive": { "kind": "drive", "motion": { "speed": "5 rad/s" } },
               "gear": { "kind": "shaft", "input": "drive", "position": { "ratio": { "ratio": 2 } }, "inertia": 1, "masses": 0 },"#,
        )
        .replace(r#""kind": "linkage", "input": "drive""#, r#""kind": "linkage", "input": "gear""#);
    let behind = found(&geared);
    assert!(behind[0].1 && behind[1].1, "{behind:?}");
    assert_relative_eq!(
        all[2].0.unwrap(),
        behind[2].0.unwrap(),
        max_relative = 1e-12
    );
    // The shaking force is greatest, 6.6 N, in the inner dead centre: at 0 deg, outside.
    assert!(all[2].0.unwrap() < 6.59);
    let times = text[..start].to_owned()
        + r#""expect": [{ "figure": "kinematics.mechanism.slide.displacement.least", "over": { "from": "0 s", "to": "0.1 s" }, "at_least": 0 }] }"#;
    let error = Scene::from_json(&times)
        .and_then(|scene| scene.verify())
        .unwrap_err();
    assert!(
        error.to_string().contains("give angles of the drive"),
        "{error}"
    );
}

#[test]
fn find_takes_conditions_over_a_part_of_the_motion() {
    // Peak speed 0.2·cos 60 deg from 60 to 120 deg, in proportion to the speed of the drive.
    let scene = Scene::from_json(&scene(PRESCRIBED, "dop853", "")).unwrap();
    for subject in [
        "slide.peak_speed <= 0.15 m/s from 60 deg to 120 deg",
        "slide.peak_speed from 60 deg to 120 deg <= 150 mm/s",
    ] {
        let question = FindQuestion {
            vary: "main.motion.speed=8:20 rad/s:9".to_owned(),
            subject: vec![subject.to_owned()],
            goal: Some((
                dam::studies::find::Aim::Maximize,
                "main.motion.speed".to_owned(),
            )),
            threads: Some(1),
        };
        let found = scene.find(&question, &Control::default()).unwrap();
        let best = found.found.best.as_ref().unwrap();
        assert_relative_eq!(best.sample.value, 15.0, max_relative = 1e-6);
    }
}

/// Over the whole motion they are the figures of the run, which are found another way.
#[test]
fn over_the_whole_run_they_are_its_figures() {
    const NAMES: [&str; 9] = [
        "delta_max",
        "delta_min",
        "delta_abs",
        "peak_speed",
        "peak_acceleration",
        "peak_reaction",
        "pair.max_contact_force",
        "pair.margin",
        "pair.max_lift",
    ];
    let mut seen = [0; NAMES.len()];
    for (file, method) in [
        ("scenarios/rocker/two_masses.json", "exact"),
        ("scenarios/rocker/two_masses.json", "dop853"),
        ("scenarios/valve_train/lift_off.json", "auto"),
        ("scenarios/valve_train/rigid_margin.json", "auto"),
        ("scenarios/press/punching.json", "auto"),
    ] {
        let text = std::fs::read_to_string(file).unwrap();
        let mut scene: serde_json::Value = serde_json::from_str(&text).unwrap();
        let objects = scene["objects"].as_object().unwrap();
        let ids: Vec<String> = objects.keys().cloned().collect();
        let figures: Vec<(usize, String)> = ids
            .iter()
            .flat_map(|id| {
                NAMES
                    .iter()
                    .enumerate()
                    .map(move |(k, name)| (k, format!("{id}.{name}")))
            })
            .collect();
        scene["run"]["method"] = method.into();
        scene["expect"] = serde_json::json!([]);
        let run_of = |scene: &serde_json::Value| {
            let run = Scene::from_json(&scene.to_string()).and_then(|scene| scene.run());
            run.unwrap_or_else(|error| panic!("{file}: {error}"))
        };
        let whole = run_of(&scene);
        let end = format!("{:?} s", whole.times().last().unwrap());
        let expect: Vec<serde_json::Value> = figures
            .iter()
            .filter(|(_, figure)| whole.figures.value(figure).is_ok())
            .map(|(_, figure)| {
                serde_json::json!({ "figure": figure, "over": { "from": "0 s", "to": end }, "at_least": 0 })
            })
            .collect();
        scene["expect"] = expect.into();
        let run = run_of(&scene);
        for (k, figure) in &figures {
            let over = run.figures.value(&format!("{figure} from 0 s to {end}"));
            let (Ok(whole), Ok(over)) = (run.figures.value(figure), over) else {
                continue;
            };
            seen[*k] += 1;
            let off = (whole - over).abs();
            assert!(
                off <= 1e-7 * whole.abs() + 1e-12,
                "{file} {method} {figure}: {over} {whole}"
            );
        }
    }
    for (name, seen) in NAMES.iter().zip(seen) {
        assert!(seen > 0, "{name}");
    }
}

#[test]
fn a_part_that_the_run_does_not_go_through_has_no_value() {
    // 1.5 turns: of the drive's angles all are met, of the times those up to its end.
    let ends = scene(
        PRESCRIBED,
        "auto",
        r#"{ "figure": "slide.peak_speed", "over": { "from": "-0.1 s", "to": "0.2 s" }, "at_most": 9 },
           { "figure": "slide.peak_speed", "over": { "from": "0.9 s", "to": "9 s" }, "at_most": 9 },
           { "figure": "slide.peak_speed", "over": { "from": "0.1 s", "to": "0.2 s" }, "at_most": 9 }"#,
    );
    let all = found(&ends);
    for partly in &all[..2] {
        assert!(partly.0.is_none() && !partly.1, "{partly:?}");
        assert!(partly.2.contains("does not go through all"), "{partly:?}");
    }
    assert!(all[2].0.is_some() && all[2].1);
    // A short run ends within the angles.
    let short = ends.replace(
        r#""from": "0.1 s", "to": "0.2 s""#,
        r#""from": "0 deg", "to": "300 deg""#,
    );
    let short = Scene::from_json(&short).unwrap().duration("0.1 s");
    let verdict = short.verify().unwrap().pop().unwrap();
    assert!(
        !verdict.holds() && verdict.verdict.found.is_none(),
        "{verdict:?}"
    );
}

#[test]
fn angles_of_a_linkage_count_in_every_turn_or_are_refused() {
    let scene = |ratio: &str, over: &str| {
        let text = format!(
            r#"{{ "dam": 1, "name": "press", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": 1 }} }},
                "press": {{ "kind": "linkage", "input": "shaft", "driver": "O", "ground": {{ "O": [0, 0] }},
                    "position": {{ "ratio": {{ "ratio": {ratio} }} }},
                    "links": {{ "crank": {{ "points": {{ "A": [0.08, 0] }} }},
                                "rod": {{ "points": {{ "B": [0.4, 0] }} }}, "ram": {{ "mass": 2 }} }},
                    "pairs": {{ "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                                "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                                "B": {{ "revolute": ["rod.B", "ram.origin"] }},
                                "guide": {{ "sliding": {{ "guide": "ground.O", "block": "ram.origin" }} }} }},
                    "assembly": {{ "ram": {{ "near": [0.48, 0] }} }},
                    "outputs": {{ "ram": {{ "point": "ram.origin" }} }} }} }},
                "run": {{ "duration": 13 }},
                "expect": [{{ "figure": "kinematics.press.ram.speed.greatest", "over": {{ {over} }}, "at_most": 9 }},
                           {{ "figure": "press.ram.peak_speed", "over": {{ {over} }}, "at_most": 9 }}] }}"#
        );
        Scene::from_json(&text).and_then(|scene| scene.verify())
    };
    // Twice as fast as the shaft: the same in each of its turns, and as the run has it.
    let angles = r#""from": "100 deg", "to": "125 deg""#;
    let all = scene("2", angles).unwrap();
    let [one, other] = [0, 1].map(|at: usize| all[at].verdict.found.unwrap());
    assert_relative_eq!(one, other, max_relative = 1e-9);
    // Half as fast it is elsewhere in every second turn.
    let refused = scene("0.5", angles).unwrap_err().to_string();
    assert!(refused.contains("goes on by 0.5 of a turn"), "{refused}");
    let own = r#""from": "200 deg", "to": "250 deg", "of": "press""#;
    let own = scene("0.5", own).unwrap();
    let [one, other] = [0, 1].map(|at: usize| own[at].verdict.found.unwrap());
    assert_relative_eq!(one, other, max_relative = 1e-9);
}
