//! Loads over the displacement of another object than the driver, the machine angle above all:
//! against the same load stated otherwise, closed forms, and the balance of energy.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::prelude::*;

const METHODS: [&str; 6] = ["auto", "exact", "dop853", "taylor", "radau", "rodas5p"];

/// A ram two objects behind the drive `main`: gear 1:2, slider-crank, elastic rod.
fn press(drive: &str, ram: &str, load: &str, run: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "press", "objects": {{
            "main": {{ "kind": "drive", {drive} }},
            "gear": {{ "kind": "shaft", "input": "main", "position": {{ "ratio": {{ "ratio": 0.5 }} }}, "inertia": 0.3, "masses": 0 }},
            "crank": {{ "kind": "slider", "input": "gear", "position": {{ "slider_crank": {{ "crank": 0.1, "rod": 0.4 }} }}, "inertia": 2, "masses": 0 }},
            "ram": {{ "kind": "slider", "input": "crank", "position": {{ "ratio": {{ "ratio": 1 }} }}, {ram},
                "loads": {{ "work": {} }} }} }},
            "run": {{ "duration": 1.3, "tolerance": 1e-11, {run} }} }}"#,
        spelled(load)
    )
}

const STEADY: &str = r#""motion": { "speed": 9 }"#;
const MOTOR: &str = r#""motor": { "inertia": 3, "speed": 9, "torque": { "constant": 2 } }"#;
const ELASTIC: &str = r#""inertia": 5, "stiffness": 2e6, "damping": 900, "masses": 2"#;
const RIGID: &str = r#""inertia": 5, "masses": 0"#;

/// An expression with the place within a turn, or within 4 rad.
fn spelled(text: &str) -> String {
    text.replace("TURN", "(over_phi - 2*pi*floor(over_phi/(2*pi)))")
        .replace("FOUR", "(over_phi - 4*floor(over_phi/4))")
}

/// Loads over the machine angle φ, and the same as expressions.
const ALIKE: [(&str, &str); 4] = [
    (
        r#"{ "window": { "from": "40 deg", "to": "150 deg", "force": "-300 N" }, "over": "main" }"#,
        r#"{ "expression": "TURN > 2*pi/9 && TURN < 5*pi/6 ? -300 : 0", "over": "main" }"#,
    ),
    (
        r#"{ "position_table": { "points": [[0, 0], [1, 500], [2, -300]], "period": 4 }, "over": "main" }"#,
        r#"{ "expression": "FOUR < 1 ? 500*FOUR : FOUR < 2 ? 500 - 800*(FOUR - 1) : -300 + 150*(FOUR - 2)", "over": "main" }"#,
    ),
    (
        r#"{ "harmonic": { "amplitude": 600, "order": 3, "phase": 0.2, "mean": 20 }, "over": "main" }"#,
        r#"{ "expression": "20 + 600*sin(3*over_phi + 0.2)", "over": "main" }"#,
    ),
    (
        r#"{ "indicator": { "points": [[0, 2e5], [2, 9e5], [5, 1e5]], "area": 0.01, "ambient": 1e5 }, "over": "main" }"#,
        r#"{ "expression": "0.01*((TURN < 2 ? 2e5 + 3.5e5*(TURN) : TURN < 5 ? 9e5 - 8e5/3*(TURN - 2) : 1e5 + 1e5/(2*pi - 5)*(TURN - 5)) - 1e5)", "over": "main" }"#,
    ),
];

fn run(text: &str) -> RunResult {
    let scene = Scene::from_json(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let run = scene
        .run()
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    assert!(run.is_complete() && run.is_trusted(), "{text}");
    run
}

fn figures(run: &RunResult) -> [f64; 6] {
    [
        "main.final.displacement",
        "main.final.speed",
        "ram.final.displacement",
        "ram.final.speed",
        "ram.peak_acceleration",
        "main.peak_reaction",
    ]
    .map(|figure| run.figures.value(figure).unwrap())
}

/// The two differ by no more than this share of the largest of their kind.
fn agree(one: &RunResult, other: &RunResult, share: f64, what: &str) {
    for (own, wanted) in figures(one).iter().zip(figures(other)) {
        let off = (own - wanted).abs();
        assert!(
            off <= share * (1e-3 + wanted.abs()),
            "{what}: {own} {wanted}"
        );
    }
}

#[test]
fn a_load_over_the_machine_angle_is_the_expression_that_says_the_same() {
    for ram in [RIGID, ELASTIC] {
        for (own, written) in ALIKE {
            let [own, written] =
                [own, written].map(|load| run(&press(STEADY, ram, load, r#""method": "dop853""#)));
            agree(&own, &written, 1e-9, "prescribed");
        }
    }
    for (own, written) in ALIKE {
        let [own, written] =
            [own, written].map(|load| run(&press(MOTOR, RIGID, load, r#""method": "taylor""#)));
        agree(&own, &written, 1e-9, "motor");
    }
}

#[test]
fn all_methods_give_the_motion_under_a_load_over_the_machine_angle() {
    let window = ALIKE[0].0;
    let wanted = run(&press(STEADY, ELASTIC, window, r#""method": "exact""#));
    for method in METHODS {
        let found = run(&press(
            STEADY,
            ELASTIC,
            window,
            &format!(r#""method": "{method}""#),
        ));
        agree(&found, &wanted, 1e-7, method);
    }
    assert_eq!(
        run(&press(STEADY, ELASTIC, window, r#""method": "auto""#))
            .method
            .name(),
        "exact"
    );
}

/// The displacement of an elastic object is a state: `exact` takes no load over it, `auto`
/// another method, and the breaks are located.
#[test]
fn a_load_over_an_elastic_object_is_over_a_state() {
    let scene = |load: &str, method: &str| {
        format!(
            r#"{{ "dam": 1, "name": "two", "objects": {{
                "main": {{ "kind": "drive", "motion": {{ "speed": 4 }} }},
                "soft": {{ "kind": "rocker", "input": "main", "position": {{ "sine": {{ "amplitude": 0.5 }} }},
                    "inertia": 0.2, "stiffness": 40, "damping": 0.1, "masses": 1 }},
                "other": {{ "kind": "rocker", "input": "main", "position": {{ "sine": {{ "amplitude": 0.3, "phase": 1 }} }},
                    "inertia": 0.1, "stiffness": 900, "damping": 0.5, "masses": 1,
                    "loads": {{ "push": {load} }} }} }},
                "run": {{ "duration": 3, "tolerance": 1e-11, "method": "{method}" }} }}"#
        )
    };
    let window =
        r#"{ "window": { "from": 0.2, "to": 0.31, "force": 7, "once": true }, "over": "soft" }"#;
    let written =
        r#"{ "expression": "over_phi > 0.2 && over_phi < 0.31 ? 7 : 0", "over": "soft" }"#;
    let error = Scene::from_json(&scene(window, "exact")).unwrap().run();
    let error = error.unwrap_err().to_string();
    assert!(error.contains("other") && error.contains("push"), "{error}");
    let value = |run: &RunResult, figure: &str| run.figures.value(figure).unwrap();
    let known = run(&scene(written, "dop853"));
    for method in ["auto", "dop853", "taylor", "radau", "rodas5p"] {
        let found = run(&scene(window, method));
        assert_ne!(found.method.name(), "exact");
        for figure in [
            "other.final.displacement",
            "other.final.speed",
            "other.delta_max",
        ] {
            assert_relative_eq!(
                value(&found, figure),
                value(&known, figure),
                max_relative = 1e-7,
                epsilon = 1e-9
            );
        }
    }
}

/// The object that a load refers to may be lowered behind the one that it acts on.
#[test]
fn a_load_may_be_over_what_lies_behind() {
    let shaft = |load: &str| {
        format!(
            r#"{{ "dam": 1, "name": "behind", "objects": {{
                "a": {{ "kind": "drive", "motor": {{ "inertia": 2, "speed": 3, "torque": {{ "constant": 0 }} }},
                    "loads": {{ "brake": {load} }} }},
                "z": {{ "kind": "slider", "input": "a", "position": {{ "slider_crank": {{ "crank": 0.2, "rod": 0.7 }} }}, "inertia": 1, "masses": 0 }} }},
                "run": {{ "duration": 4, "tolerance": 1e-11, "method": "dop853" }} }}"#
        )
    };
    let ends = |run: &RunResult| {
        ["a.final.displacement", "a.final.speed"].map(|figure| run.figures.value(figure).unwrap())
    };
    let window = r#"{ "window": { "from": "0.6 m", "to": "0.8 m", "force": "-0.4 N m", "once": true }, "over": "z" }"#;
    let written = r#"{ "expression": "over_phi > 0.6 && over_phi < 0.8 ? -0.4 : 0", "over": "z" }"#;
    let [found, wanted] = [window, written].map(|load| ends(&run(&shaft(load))));
    assert_abs_diff_eq!(found[..], wanted[..], epsilon = 1e-9);
    assert!(found[1] < 3.0 - 1e-3);
    // Its own angle is that of the drive: with no `over` too.
    let own = r#"{ "window": { "from": "20 deg", "to": "90 deg", "force": "-0.4 N m" } }"#;
    let named =
        r#"{ "window": { "from": "20 deg", "to": "90 deg", "force": "-0.4 N m" }, "over": "a" }"#;
    let [own, named] = [own, named].map(|load| ends(&run(&shaft(load))));
    assert_eq!(own, named);
}

/// A free mass on a soft base under a window of the machine angle: the jumps of its
/// acceleration lie at the angles of the window, and the momentum is force times time.
#[test]
fn a_window_begins_and_ends_at_its_angles_and_gives_its_impulse() {
    let (speed, force, mass) = (20.0, 6.0, 3.0);
    let [from, to] = [50f64, 140.0].map(f64::to_radians);
    for method in METHODS {
        let text = format!(
            r#"{{ "dam": 1, "name": "impulse", "objects": {{
                "main": {{ "kind": "drive", "motion": {{ "speed": {speed} }} }},
                "crank": {{ "kind": "slider", "input": "main", "position": {{ "sine": {{ "amplitude": 0.01 }} }}, "inertia": 1, "masses": 0 }},
                "ram": {{ "kind": "slider", "input": "crank", "position": {{ "ratio": {{ "ratio": 1e-12 }} }},
                    "inertia": {mass}, "stiffness": 1e-9, "masses": 1,
                    "loads": {{ "push": {{ "window": {{ "from": "50 deg", "to": "140 deg", "force": {force} }}, "over": "main" }} }} }} }},
                "run": {{ "duration": 0.2, "start": "on_law", "tolerance": 1e-11, "method": "{method}",
                    "first_times": {{ "begins": {{ "of": "ram", "condition": "acceleration > 1" }} }} }} }}"#
        );
        let run = run(&text);
        let time = (to - from) / speed;
        let gained = run.figures.value("ram.final.speed").unwrap() * mass;
        assert_relative_eq!(gained, force * time, max_relative = 1e-8);
        let begins = run.figures.value("run.first_times.begins").unwrap();
        assert_relative_eq!(begins, from / speed, max_relative = 1e-12);
    }
}

/// Rigid chain: the load over its own driver that corresponds to the window of the angle.
#[test]
fn the_same_load_over_the_own_driver_gives_the_same_motion() {
    // The crank goes to and fro: x(φ) is one to one from 20 to 160 deg of the gear, which are
    // 40 to 320 deg of the drive; the run ends before it comes back.
    let place = |degrees: f64| {
        let (crank, rod, phi) = (0.1f64, 0.4f64, degrees.to_radians());
        crank * phi.cos() + (rod * rod - (crank * phi.sin()).powi(2)).sqrt()
    };
    let own = format!(
        r#"{{ "window": {{ "from": {:?}, "to": {:?}, "force": -2000, "once": true }} }}"#,
        place(120.0),
        place(50.0)
    );
    let named =
        r#"{ "window": { "from": "100 deg", "to": "240 deg", "force": -2000 }, "over": "main" }"#;
    let brief = r#""method": "dop853", "samples": 10"#;
    for drive in [STEADY, MOTOR] {
        let runs = [own.as_str(), named].map(|load| {
            let text = press(drive, RIGID, load, brief).replace("1.3", "0.6");
            run(&text)
        });
        agree(&runs[0], &runs[1], 1e-9, drive);
    }
}

/// The work of the load over a turn, in `steady` and `forces`.
#[test]
fn steady_motion_and_its_balance_take_the_load() {
    let load = |text: &str| {
        press(MOTOR, RIGID, text, r#""method": "auto""#).replace(
            r#""torque": { "constant": 2 }"#,
            r#""torque": { "linear": { "stall_torque": 400, "no_load_speed": 12 } }"#,
        )
    };
    let steady = |text: &str| {
        let text = load(text).replace(r#""run""#, r#""steady": { "cycle": "720 deg" }, "run""#);
        let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{error}"));
        let answer = scene
            .steady()
            .unwrap_or_else(|error| panic!("{text}: {error}"));
        assert!(answer.is_trusted(), "{text}");
        ["steady.mean_time", "steady.fluctuation"]
            .map(|figure| dam::studies::steady::figure(&answer, figure).unwrap())
    };
    for (own, written) in ALIKE
        .into_iter()
        .filter(|(own, _)| !own.contains("\"period\": 4"))
    {
        let [own, written] = [own, written].map(steady);
        for (own, written) in own.iter().zip(written) {
            assert_relative_eq!(*own, written, max_relative = 1e-8);
        }
    }
}

#[test]
fn what_no_load_can_be_over_is_refused_by_name() {
    let refused = |load: &str| {
        let scene = Scene::from_json(&press(STEADY, RIGID, load, r#""method": "auto""#));
        scene.and_then(|scene| scene.run()).unwrap_err().to_string()
    };
    let error = refused(r#"{ "constant": 3, "over": "main" }"#);
    assert!(error.contains("does not depend on"), "{error}");
    let error = refused(r#"{ "harmonic": { "amplitude": 3, "frequency": 2 }, "over": "main" }"#);
    assert!(
        error.contains("`order` in place of its `frequency`"),
        "{error}"
    );
    let error = refused(r#"{ "window": { "from": 1, "to": 2, "force": 3 }, "over": "mian" }"#);
    assert!(error.contains("did you mean `main`"), "{error}");
    let error =
        refused(r#"{ "window": { "from": "1 mm", "to": "2 mm", "force": 3 }, "over": "main" }"#);
    assert!(error.contains("angle"), "{error}");
}

/// A load over the output of a linkage; the linkage moves by itself.
#[test]
fn a_load_may_be_over_the_output_of_a_linkage() {
    let text = std::fs::read_to_string("scenarios/kinetostatics/slider_crank.json").unwrap();
    let start = text.find("\"expect\"").unwrap();
    let scene = |load: &str| {
        let lever = format!(
            r#"{{ "objects": {{ "lever": {{ "kind": "rocker", "input": "drive", "position": {{ "sine": {{ "amplitude": 0.3 }} }},
                "inertia": 0.1, "stiffness": 900, "damping": 0.5, "masses": 1, "loads": {{ "push": {load} }} }}, "#
        );
        let lever = lever.trim_start_matches("{ ");
        let text = text[..start].replacen("\"objects\": {", lever, 1);
        let text = text.trim_end().trim_end_matches(',').to_owned() + " }";
        let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let run = scene
            .duration(1.1)
            .tolerance(1e-11)
            .method("dop853")
            .run()
            .unwrap();
        assert!(run.is_complete() && run.is_trusted());
        [
            "lever.final.displacement",
            "lever.final.speed",
            "lever.delta_abs",
        ]
        .map(|figure| run.figures.value(figure).unwrap())
    };
    let window = r#"{ "window": { "from": "300 mm", "to": "340 mm", "force": "5 N m", "once": true }, "over": "mechanism.slide" }"#;
    let written = r#"{ "expression": "over_phi > 0.3 && over_phi < 0.34 ? 5 : 0", "over": "mechanism.slide" }"#;
    for (found, wanted) in scene(window).iter().zip(scene(written)) {
        assert_relative_eq!(*found, wanted, max_relative = 1e-9);
    }
}

/// An elastic object whose motion is known beforehand gives its displacement with its deflection.
#[test]
fn a_load_over_a_modal_object_knows_its_deflection() {
    let text = r#"{ "dam": 1, "name": "modal", "objects": {
        "main": { "kind": "drive", "motion": { "speed": 4 } },
        "soft": { "kind": "rocker", "input": "main", "position": { "sine": { "amplitude": 1e-6 } },
            "inertia": 0.2, "stiffness": 40, "damping_capacity": 0.5, "modes": 2, "loads": { "bends": { "constant": 8 } } },
        "other": { "kind": "rocker", "input": "main", "position": { "sine": { "amplitude": 1e-6 } },
            "inertia": 0.1, "stiffness": 100, "damping": 0.5, "masses": 1,
            "loads": { "push": { "window": { "from": 0.1, "to": 0.3, "force": 7, "once": true }, "over": "soft" } } } },
        "run": { "duration": 0.5, "start": "static", "tolerance": 1e-9 } }"#;
    let run = run(text);
    // 8 N m bend it by 0.2 rad, within the window: 7 N m act throughout.
    let delta = run.figures.value("other.delta_min").unwrap();
    assert_abs_diff_eq!(delta, 0.07, epsilon = 1e-4);
}

/// `dam cam` sees a load over the machine angle through the gear between.
#[test]
fn a_cam_carries_a_load_over_the_machine_angle() {
    let greatest = |ratio: f64, load: &str| {
        let text = format!(
            r#"{{ "dam": 1, "name": "cam", "objects": {{
                "main": {{ "kind": "drive", "motion": {{ "speed": 30 }} }},
                "camshaft": {{ "kind": "shaft", "input": "main", "position": {{ "ratio": {{ "ratio": {ratio} }} }}, "inertia": 0.01, "masses": 0 }},
                "follower": {{ "kind": "cam_follower", "input": "camshaft", "motion": "sliding",
                    "position": {{ "cam": {{ "lift": "12 mm", "rise": "120 deg", "dwell": "30 deg", "return": "120 deg", "law": "4-5-6-7" }} }},
                    "cam": {{ "base_radius": "30 mm", "contact": {{ "roller": "10 mm" }} }},
                    "inertia": "0.4 kg", "masses": 0,
                    "loads": {{ "spring": {{ "spring": {{ "rate": "10 N/mm", "preload": "80 N" }} }}, "work": {load} }} }} }},
                "run": {{ "duration": "0.48 s" }},
                "expect": [{{ "figure": "cam.follower.greatest_contact_force", "at_least": 0 }},
                           {{ "figure": "cam.follower.greatest_torque", "at_least": 0 }}] }}"#
        );
        let scene = Scene::from_json(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let all = scene
            .verify()
            .unwrap_or_else(|error| panic!("{text}: {error}"));
        (
            all[0].verdict.found.zip(all[1].verdict.found),
            all[0].not_judged.clone(),
        )
    };
    let own = r#"{ "window": { "from": "40 deg", "to": "75 deg", "force": "-300 N" } }"#;
    let none = r#"{ "constant": 0 }"#;
    let (known, _) = greatest(0.5, own);
    let geared = r#"{ "window": { "from": "80 deg", "to": "150 deg", "force": "-300 N", "period": "720 deg" }, "over": "main" }"#;
    let (found, why) = greatest(0.5, geared);
    let (found, known) = (found.unwrap_or_else(|| panic!("{why:?}")), known.unwrap());
    assert_relative_eq!(found.0, known.0, max_relative = 1e-12);
    assert_relative_eq!(found.1, known.1, max_relative = 1e-12);
    assert!(known.0 > 1.5 * greatest(0.5, none).0.unwrap().0);
    // Every second turn of the cam alone, and no drive of it.
    let twice =
        r#"{ "window": { "from": "80 deg", "to": "150 deg", "force": "-300 N" }, "over": "main" }"#;
    let (_, why) = greatest(2.0, twice);
    assert!(
        why.as_ref()
            .is_some_and(|why| why.contains("does not repeat with each turn")),
        "{why:?}"
    );
}

/// A slider-crank on a rotor: `forces` within it, and `objects` beside it.
fn linkage_press(forces: &str, objects: &str) -> Scene {
    let text = format!(
        r#"{{ "dam": 1, "name": "press", "objects": {{
            "shaft": {{ "kind": "drive", "motor": {{ "inertia": 2, "speed": 20, "torque": {{ "constant": 0 }} }} }},
            "press": {{ "kind": "linkage", "input": "shaft", "driver": "O", "ground": {{ "O": [0, 0] }},
                "links": {{ "crank": {{ "points": {{ "A": [0.08, 0] }}, "moment": 1.5 }},
                            "rod": {{ "points": {{ "B": [0.4, 0] }}, "mass": 25, "centre": [0.15, 0], "moment": 0.6 }},
                            "ram": {{ "mass": 220 }} }},
                "pairs": {{ "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                            "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                            "B": {{ "revolute": ["rod.B", "ram.origin"] }},
                            "guide": {{ "sliding": {{ "guide": "ground.O", "block": "ram.origin" }} }} }},
                "assembly": {{ "ram": {{ "near": [0.48, 0] }} }},
                "forces": {{ {forces} }} }}{objects} }},
            "run": {{ "duration": 0.3, "tolerance": 1e-9 }} }}"#
    );
    Scene::from_json(&text).unwrap()
}

#[test]
fn a_narrow_table_within_a_linkage_acts_as_the_same_load_on_its_shaft() {
    for width in [0.02, 0.5] {
        let (middle, end) = (100.0 + width / 2.0, 100.0 + width);
        let table = format!(
            r#"{{ "points": [["100 deg", 0], ["{middle} deg", -1800], ["{end} deg", 0]], "period": "360 deg" }}"#
        );
        let within = table.replacen('{', r#"{ "link": "crank", "#, 1);
        let within = linkage_press(&format!(r#""w": {{ "couple_table": {within} }}"#), "");
        let beside = format!(
            r#", "brake": {{ "kind": "shaft", "input": "shaft", "masses": 0,
                 "position": {{ "ratio": {{ "ratio": 1 }} }}, "inertia": 0,
                 "loads": {{ "w": {{ "position_table": {table} }} }} }}"#
        );
        let beside = linkage_press("", &beside);
        let free = linkage_press("", "");
        for method in ["auto", "dop853", "radau"] {
            let speed = |scene: &Scene| {
                let run = scene.clone().method(method).run().unwrap();
                (
                    run.figures.value("shaft.final.speed").unwrap(),
                    run.is_trusted(),
                )
            };
            let [within, beside, free] = [&within, &beside, &free].map(speed);
            assert!(
                (beside.0 - free.0).abs() > 1e-3,
                "it brakes: {beside:?} {free:?}"
            );
            // A table within a linkage is evaluated where the stages of a step are: what does not
            // meet it is found out by the balance of energy.
            assert!(
                within.1 || method != "auto",
                "{method} at {width} deg is not to be trusted"
            );
            if within.1 {
                assert_relative_eq!(within.0, beside.0, max_relative = 1e-7);
            }
        }
    }
}

/// Two motors on a five-bar, one under a load over the angle of the other.
#[test]
fn a_load_on_one_of_several_inputs_may_be_over_another() {
    let text = std::fs::read_to_string("scenarios/linkages/five_bar.json").unwrap();
    let scene: serde_json::Value = serde_json::from_str(&text).unwrap();
    let speeds = |load: serde_json::Value, method: &str| {
        let mut scene = scene.clone();
        scene["objects"]["left"]["loads"] = serde_json::json!({ "w": load });
        scene["run"] = serde_json::json!({ "duration": 0.2, "tolerance": 1e-10, "start": "on_law", "method": method });
        scene.as_object_mut().unwrap().remove("expect");
        let run = run(&scene.to_string());
        ["left.final.speed", "right.final.speed"].map(|figure| run.figures.value(figure).unwrap())
    };
    for method in ["auto", "dop853", "radau"] {
        let written =
            serde_json::json!({ "expression": "5*over_phi + over_phi_dot*0", "over": "right" });
        let table = serde_json::json!({ "position_table": { "points": [[-90, -450], [90, 450]] }, "over": "right" });
        let [written, table] = [written, table].map(|load| speeds(load, method));
        for (one, other) in written.into_iter().zip(table) {
            assert_relative_eq!(one, other, max_relative = 1e-8);
        }
        let free = speeds(serde_json::json!({ "constant": 0 }), method);
        assert!((free[0] - table[0]).abs() > 1e-3, "{free:?} {table:?}");
    }
}
