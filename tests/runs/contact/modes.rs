//! Objects reduced to vibration modes behind a contact element: against the waves in a rod,
//! against long chains, `exact` against integration.

use super::rod::{Waves, contact};
use super::{INTEGRATED, Wall, pair, run_text};
use crate::levels::modes_carry_followers;
use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::Method;
use dam::prelude::*;
use dam::studies::run::RunResult;

/// A rod on a wall, with so many modes.
fn rod(modes: usize, k: f64, capacity: f64) -> Wall {
    let body = format!(
        "\"inertia\": 1, \"stiffness\": 1, \"damping_capacity\": {capacity}, \"modes\": {modes}"
    );
    Wall {
        body,
        ..Wall::rod(1, capacity, &contact(k), 6.0)
    }
}

/// Errors of the greatest force and the contact time (%).
fn errors(result: &RunResult, k: f64) -> [f64; 2] {
    let (waves, own) = (Waves(k), pair(result));
    [
        100.0 * (own.max_contact_force / waves.force() - 1.0),
        100.0 * (own.switch_times[0] / waves.end() - 1.0),
    ]
}

#[test]
fn modes_come_to_the_waves_of_a_rod_on_a_wall() {
    // Rigid with the residual flexibility 1/3 in series, by hand: F = v·√(k·m), T = π·√(m/k).
    for (k, force, time) in [(1.0, -0.36, -0.25), (10.0, 52.0, -4.6)] {
        let series = 1.0 / (1.0 / k + 1.0 / 3.0);
        let result = Wall::rigid(&contact(series), 1.0, 6.0).run(Method::Exact);
        let found = errors(&result, k);
        assert_abs_diff_eq!(found[0], force, epsilon = 0.5);
        assert_abs_diff_eq!(found[1], time, epsilon = 0.05);
    }
    // Measured on independent programs: k, errors of force and time with 8 modes (%).
    for (k, force, time, within) in [
        (1.0, -0.01, -0.005, 0.005),
        (10.0, 3.5, -0.12, 0.06),
        (100.0, 52.0, 0.65, 0.5),
    ] {
        let found = errors(&rod(8, k, 0.0).run(Method::Exact), k);
        assert_abs_diff_eq!(found[0], force, epsilon = within);
        assert_abs_diff_eq!(found[1], time, epsilon = within);
    }
    // Where the wall is soft one mode does what sixteen masses do not.
    let one = errors(&rod(1, 0.5, 0.0).run(Method::Exact), 0.5);
    let chain = Wall::rod(16, 0.0, &contact(0.5), 6.0).run(Method::Exact);
    let chain = errors(&chain, 0.5);
    for (one, chain) in one.into_iter().zip(chain) {
        assert!(
            one.abs() < 0.1 && one.abs() < 0.2 * chain.abs(),
            "{one} {chain}"
        );
    }
}

#[test]
fn every_method_runs_the_modes_of_a_rod_on_a_wall_alike() {
    let exact = rod(3, 10.0, 0.0).run(Method::Exact);
    for method in INTEGRATED.into_iter().chain([Method::Taylor]) {
        let own = rod(3, 10.0, 0.0).run(method);
        let [own, known] = [&own, &exact].map(|run| &run.figures.objects["body"]);
        assert_relative_eq!(own.delta_max, known.delta_max, max_relative = 1e-6);
        assert_relative_eq!(own.delta_min, known.delta_min, max_relative = 1e-6);
        assert_relative_eq!(own.sigma, known.sigma, max_relative = 1e-5);
        assert_relative_eq!(own.peak_speed, known.peak_speed, max_relative = 1e-5);
        assert_relative_eq!(
            own.end.displacement,
            known.end.displacement,
            max_relative = 1e-6
        );
        let [own, known] = [own, known].map(|figures| figures.pair.as_ref().unwrap());
        assert_eq!(own.separations, known.separations);
        assert_relative_eq!(own.max_lift, known.max_lift, max_relative = 1e-6);
        assert_relative_eq!(
            own.max_contact_force,
            known.max_contact_force,
            max_relative = 1e-6
        );
    }
    // Behind a massless point, hardly damped: the same motion.
    let damped = rod(3, 10.0, 1e-4).run(Method::Rodas5p);
    let off = errors(&damped, 10.0);
    for (off, known) in off.into_iter().zip(errors(&exact, 10.0)) {
        assert_abs_diff_eq!(off, known, epsilon = 0.05);
    }
}

/// A rocker or a shaft behind a drive.
fn behind(kind: &str, level: &str, pair: &str, more: &str) -> RunResult {
    let text = format!(
        r#"{{ "dam": 1, "name": "Modes", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": 10 }} }},
            "body": {{ "kind": "{kind}", "input": "drive", "position": {{ "sine": {{ "amplitude": 0.5 }} }},
                "inertia": 0.01, "stiffness": 400, {level}, "pair": {{ {pair} }}, {more} }} }},
            "run": {{ "duration": 2, "tolerance": 1e-9, "start": "static" }} }}"#
    );
    run_text(&text, None)
}

const BILATERAL: &str = r#""closure": "bilateral", "contact": { "law": "kelvin_voigt", "stiffness": 2000, "damping": 0.5 }"#;
const DAMPED: &str = r#""damping_capacity": 0.2"#;

#[test]
fn long_chains_behind_a_closed_contact_lead_to_a_few_modes() {
    for kind in ["rocker", "slider"] {
        let delta = |level: &str| {
            let run = behind(kind, level, BILATERAL, DAMPED);
            let audit = run.audit.error();
            assert!(audit < 1e-8, "{kind} {level}: {audit}");
            run.figures.objects["body"].delta_abs
        };
        let modes = delta(r#""modes": 8"#);
        assert_relative_eq!(delta(r#""modes": 1"#), modes, max_relative = 1e-3);
        assert_relative_eq!(delta(r#""modes": 4"#), modes, max_relative = 3e-5);
        // Far ends: first order. Balanced cells, but for the first one: far nearer.
        let error = |masses: usize, lumping: &str| {
            let level = format!(r#""masses": {masses}, "lumping": "{lumping}""#);
            delta(&level) / modes - 1.0
        };
        let order = (error(16, "ends") / error(32, "ends")).log2();
        assert!((0.9..1.1).contains(&order), "{kind}: {order}");
        assert!(error(32, "ends").abs() > 0.01, "{kind}");
        assert!(error(64, "balanced").abs() < 3e-4, "{kind}");
        // Slow as it is: static flexibility, the contact in series.
        let rest = delta(r#""flexibility": "static""#);
        assert_relative_eq!(rest, modes, max_relative = 0.03);
        let share = match kind {
            "rocker" => 0.75,
            _ => 0.5,
        };
        let by_hand = 0.01 * 50.0 * (share / 400.0 + 1.0 / 2000.0);
        assert_relative_eq!(rest, by_hand, max_relative = 1e-6);
    }
}

#[test]
fn long_chains_that_lift_off_and_strike_lead_to_some_modes() {
    let spring = r#""loads": { "spring": { "spring": { "rate": 0.2, "preload": 0.2 } } }"#;
    for law in [
        r#""law": "hunt_crossley", "stiffness": 2000, "dissipation": 0.3"#,
        r#""law": "hertz", "stiffness": 30000, "dissipation": 0.1"#,
        r#""law": "kelvin_voigt", "stiffness": 2000, "damping": 0.5"#,
    ] {
        let contact = format!(r#""closure": "force", "contact": {{ {law} }}"#);
        let of = |level: &str| {
            let kind = if law.contains("hertz") {
                "slider"
            } else {
                "rocker"
            };
            let run = behind(kind, level, &contact, &format!("{DAMPED}, {spring}"));
            let audit = run.audit.error();
            assert!(audit < 1e-6, "{law} {level}: {audit}");
            let own = pair(&run);
            assert!(own.separations > 2, "{law} {level}");
            [own.max_lift, own.max_contact_force]
        };
        // Balanced cells come to the modes by the second order, from ten times as far.
        let [coarse, fine] =
            [24, 48].map(|n| of(&format!(r#""masses": {n}, "lumping": "balanced""#)));
        let modes = of(r#""modes": 8"#);
        for ((coarse, fine), modes) in coarse.into_iter().zip(fine).zip(modes) {
            assert_relative_eq!((4.0 * fine - coarse) / 3.0, modes, max_relative = 2e-3);
            assert!((fine - modes).abs() < 0.5 * (coarse - modes).abs(), "{law}");
        }
    }
}

#[test]
fn exact_and_integrated_runs_of_modes_in_a_play_agree() {
    let text = r#"{ "dam": 1, "name": "Play", "objects": {
        "drive": { "kind": "drive", "motion": { "speed": 10 } },
        "body": { "kind": "rocker", "input": "drive", "position": { "sine": { "amplitude": 0.5 } },
            "inertia": 0.01, "stiffness": 400, "modes": 2, "loads": { "tool": { "constant": 0.05 } },
            "pair": { "closure": "form", "gap": 0.01, "contact": { "stiffness": 300 } } } },
        "run": { "duration": 0.5, "tolerance": 1e-11, "start": { "body": { "displacement": [0.001], "speed": [5] } } } }"#;
    let exact = run_text(text, Some(Method::Exact));
    let own = pair(&exact);
    assert!(own.separations > 1 && own.closures > 1, "{own:?}");
    let integrated = run_text(text, Some(Method::Dop853));
    let [one, other] = [&exact, &integrated].map(|run| &run.figures.objects["body"]);
    assert_relative_eq!(one.delta_max, other.delta_max, max_relative = 1e-6);
    assert_relative_eq!(one.delta_min, other.delta_min, max_relative = 1e-6);
    assert_relative_eq!(one.sigma, other.sigma, max_relative = 1e-4);
    assert_relative_eq!(one.peak_reaction, other.peak_reaction, max_relative = 1e-6);
    let [one, other] = [one, other].map(|figures| figures.pair.as_ref().unwrap());
    assert_eq!(one.separations, other.separations);
    for (one, other) in one.switch_times.iter().zip(&other.switch_times) {
        assert_relative_eq!(one, other, max_relative = 1e-6);
    }
}

#[test]
fn what_hangs_on_modes_behind_a_contact_moves_as_behind_a_long_chain() {
    modes_carry_followers(r#""closure": "bilateral", "contact": { "stiffness": 900 }"#);
}

#[test]
fn a_weight_and_a_constant_load_bend_the_free_object_as_the_continuum() {
    // At rest on the contact: −(F + m·g)/k − F/c − m·g/(2c) of a slider.
    let text = r#"{ "dam": 1, "name": "Rest", "objects": {
        "wall": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": 0 } },
        "body": { "kind": "slider", "input": "wall", "position": { "ratio": 1 },
            "inertia": 2, "stiffness": 500, "modes": 3, "damping_capacity": 0.3,
            "pair": { "closure": "force", "contact": { "stiffness": 800 } },
            "loads": { "weight": { "weight": { "inclination": "90 deg" } }, "tool": { "constant": -30 } } } },
        "run": { "duration": 0.2, "start": "static" } }"#;
    let run = run_text(text, None);
    let weight = 2.0 * 9.80665;
    let sunk = -(30.0 + weight) / 800.0 - 30.0 / 500.0 - 0.5 * weight / 500.0;
    let body = &run.figures.objects["body"];
    assert_relative_eq!(body.end.displacement, sunk, max_relative = 1e-6);
    assert_relative_eq!(body.delta_min, body.delta_max, max_relative = 1e-6);
    assert_relative_eq!(
        pair(&run).max_contact_force,
        30.0 + weight,
        max_relative = 1e-6
    );
}

#[test]
fn few_coordinates_serve_a_closed_pair_with_a_contact() {
    let text = |pair: &str, figure: &str, level: &str| {
        format!(
            r#"{{ "dam": 1, "name": "Auto", "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": 60 }} }},
                "body": {{ "kind": "rocker", "input": "drive", "position": {{ "sine": {{ "amplitude": 0.1 }} }},
                    "inertia": 0.01, "stiffness": 400, "damping_capacity": 0.2, {level},
                    "pair": {{ {pair} }}, "loads": {{ "closing": {{ "constant": -6 }} }} }} }},
                "run": {{ "duration": 0.4, "accuracy": {{ "body.{figure}": "1 %" }} }} }}"#
        )
    };
    let force = r#""closure": "force", "contact": { "law": "hunt_crossley", "stiffness": 9000, "dissipation": 0.2 }"#;
    for (pair, figure) in [
        (BILATERAL, "delta_abs"),
        (force, "delta_abs"),
        (force, "pair.max_contact_force"),
    ] {
        let scene = Scene::from_json(&text(pair, figure, r#""masses": "auto""#)).unwrap();
        let ready = scene.prepare().unwrap();
        let certificate = ready.certificate.as_ref().unwrap();
        let model = &certificate.models["body"];
        assert!(model.coordinates <= 2, "{figure}: {model:?}");
        let found = &certificate.accuracy[&format!("body.{figure}")];
        assert!(found.holds, "{found:?}");
        // A long chain tells the same within the interval.
        let long = text(pair, figure, r#""masses": 48, "lumping": "balanced""#);
        let long = run_text(&long, None);
        let own = &long.figures.objects["body"];
        let known = match figure {
            "delta_abs" => own.delta_abs,
            _ => own.pair.as_ref().unwrap().max_contact_force,
        };
        let interval = found.error.unwrap() + 3e-3 * known;
        assert_abs_diff_eq!(found.value, known, epsilon = interval);
    }
}

#[test]
fn what_does_not_go_with_a_contact_is_refused_by_name() {
    let refused = |object: &str, words: &[&str]| {
        let text = format!(
            r#"{{ "dam": 1, "name": "Refused", "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": 1 }} }},
                "one": {{ "kind": "slider", "input": "drive", "position": {{ "sine": {{ "amplitude": 1 }} }},
                    "inertia": 1, "stiffness": 1, {object} }} }}, "run": {{ "duration": 1 }} }}"#
        );
        let error = Scene::from_json(&text).and_then(|scene| scene.run().map(|_| ()));
        let error = error.expect_err(object).to_string();
        for word in words {
            assert!(error.contains(word), "{word} in\n{error}");
        }
    };
    let pair = |closure: &str, contact: &str| {
        format!(r#""pair": {{ "closure": "{closure}", "contact": {{ {contact} }} }}"#)
    };
    let rigid = pair("force", r#""law": "restitution", "restitution": 0.5"#);
    let loaded = format!(r#"{rigid}, "loads": {{ "closing": {{ "constant": -1 }} }}"#);
    refused(
        &format!(r#""modes": 2, {loaded}"#),
        &["masses: 0", "rigid contact"],
    );
    refused(
        &format!(r#""flexibility": "static", {loaded}"#),
        &["masses: 0"],
    );
    let elastic = r#""stiffness": 5"#;
    // What is held needs a pair that stays closed, modes of the free object do not.
    refused(
        &format!(r#""flexibility": "static", {}"#, pair("form", elastic)),
        &["stays closed", "`modes`"],
    );
    let hertz = r#""law": "hertz", "stiffness": 5"#;
    refused(
        &format!(r#""flexibility": "static", {}"#, pair("force", hertz)),
        &["proportional to the indentation", "`elastic`"],
    );
    let stop = r#""stops": { "seat": { "at": 0, "side": "-", "contact": { "stiffness": 3 } } }"#;
    refused(
        &format!(r#""modes": 2, {stop}, {}"#, pair("force", elastic)),
        &["stop", "`masses`"],
    );
    let crossley = r#""law": "hunt_crossley", "stiffness": 5, "dissipation": 1"#;
    refused(
        &format!(r#""modes": 2, {}"#, pair("force", crossley)),
        &["without damping", "damping_capacity"],
    );
}

#[test]
fn the_sum_that_is_the_output_is_told_as_the_object() {
    let run = behind("rocker", r#""modes": 2"#, BILATERAL, DAMPED);
    let told: Vec<&String> = run.figures.objects.keys().collect();
    assert_eq!(told, ["body", "drive"]);
    let columns = &run.record.columns;
    assert!(
        columns
            .iter()
            .all(|column| *column.object != *"body.output")
    );
    let last = columns
        .iter()
        .find(|column| column.object == "body" && column.unit == "rad")
        .and_then(|column| column.values.last());
    assert_eq!(last, Some(&run.figures.objects["body"].end.displacement));
}
