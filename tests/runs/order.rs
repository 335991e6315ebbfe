//! The error of the model itself, and the least model within an accuracy: held against
//! closed forms of the continuum and against long chains.

use dam::ask::ModelAssessment;
use dam::builder::spec::Level;
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::order::{Certainty, Certificate, FigureAccuracy};

/// A scene with its certificate.
fn judged(text: &str) -> (Mechanism, Certificate) {
    let scene = Scene::from_json(text).expect("a scene");
    let reading = scene.decode().expect("a sound scene");
    let mechanism = Mechanism::of_within(reading, ModelAssessment::Asked, &Control::default());
    let mechanism = mechanism.expect("a mechanism");
    let certificate = mechanism.certificate.clone().expect("a certificate");
    (mechanism, certificate)
}

/// Coordinates of the one object whose level was chosen.
fn coordinates(certificate: &Certificate) -> usize {
    certificate.models["one"].coordinates
}

fn of<'c>(certificate: &'c Certificate, figure: &str) -> &'c FigureAccuracy {
    &certificate.accuracy[figure]
}

/// A rod or lever behind a drive that turns with a speed of 0.1.
fn scene(object: &str, run: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Order", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": 0.1 }} }},
            "one": {{ "input": "drive", "inertia": 1, "stiffness": 1, "masses": "auto", {object} }} }},
            "run": {{ "samples": 10, {run} }} }}"#
    )
}

/// Tip of a rod (m = c = 1) in a rise by the cycloidal law of the duration `rise`, less the
/// law itself: 2·Σ(−1)^k·y(t − 2k − 1) − y(t), by d'Alembert; its greatest magnitude.
fn deviation_in_rise(rise: f64) -> f64 {
    let tau = std::f64::consts::TAU;
    let law = |t: f64| match t / rise {
        x if x <= 0.0 => 0.0,
        x if x >= 1.0 => 1.0,
        x => x - (tau * x).sin() / tau,
    };
    let delta = |t: f64| {
        let waves = (0..).map(|k| (f64::from(k), t - 2.0 * f64::from(k) - 1.0));
        let waves = waves.take_while(|(_, t)| *t > 0.0);
        let sign = |k: f64| if k % 2.0 == 0.0 { 2.0 } else { -2.0 };
        waves.map(|(k, t)| sign(k) * law(t)).sum::<f64>() - law(t)
    };
    let fine = 200_000;
    let times = (0..=fine).map(|i| rise * f64::from(i) / f64::from(fine));
    times.map(|t| delta(t).abs()).fold(0.0, f64::max)
}

#[test]
fn a_cycloidal_rise_takes_the_coordinates_that_its_accuracy_needs() {
    let known = deviation_in_rise(4.0 * 5.3);
    assert!((known / 0.008355383138 - 1.0).abs() < 1e-8, "{known}");
    for ratio in [1.5, 2.0, 2.7, 3.3, 4.1, 5.3, 7.6, 10.3, 14.2, 20.0] {
        let rise = 4.0 * ratio;
        let exact = deviation_in_rise(rise);
        for (accuracy, most) in [(0.01, 1), (1e-4, 4)] {
            let angle = 0.05 * rise;
            let object = format!(
                r#""kind": "slider", "position": {{ "cam": {{
                    "lift": 1, "rise": {angle}, "return": 1, "law": "cycloidal" }} }}"#
            );
            let run = format!(
                r#""duration": {rise}, "start": "on_law",
                    "accuracy": {{ "one.delta_abs": "{} %" }}"#,
                100.0 * accuracy
            );
            // Slowly, so that the longest rise has room in a turn.
            let text = scene(&object, &run).replace(r#""speed": 0.1"#, r#""speed": 0.05"#);
            let (mechanism, certificate) = judged(&text);
            let found = of(&certificate, "one.delta_abs");
            let (error, off) = (found.error.expect("an error"), (found.value - exact).abs());
            assert!(off <= error, "{ratio} {accuracy}: {off} beyond {error}");
            assert!(off <= accuracy * exact, "{ratio} {accuracy}: {off}");
            assert!(found.holds && found.kind == Certainty::Bound, "{found:?}");
            let coordinates = coordinates(&certificate);
            assert!(coordinates <= most, "{ratio} {accuracy}: {coordinates}");
            // The run is that of the model chosen.
            let run = mechanism.run().expect("a run");
            assert_eq!(run.figures("one").expect("figures").delta_abs, found.value);
        }
    }
}

/// How the output of a rod or lever (J = c = 1) follows a harmonic motion of its driven end:
/// 1/cos z, and (a/2)^(−¾)/(Γ(¼)·J_{−¾}(a)) with a = √3·z/2, by its power series;
/// z = ω/√(1 + iωτ).
fn follows_harmonic(kind: &str, omega: f64, tau: f64) -> nalgebra::Complex<f64> {
    use nalgebra::Complex;
    let z = Complex::new(omega, 0.0) / Complex::new(1.0, omega * tau).sqrt();
    if kind == "slider" {
        return z.cos().inv();
    }
    let (mut sum, mut term) = (Complex::new(0.0, 0.0), Complex::new(1.0, 0.0));
    for j in 0..40 {
        sum += term;
        let j = f64::from(j);
        term *= -z * z * 0.1875 / ((j + 1.0) * (j + 0.25));
    }
    sum.inv()
}

/// From rest, damped and long, so that the start has faded.
#[test]
fn a_harmonic_base_is_followed_up_to_nine_tenths_of_the_first_frequency() {
    // Undamped figures of a shaft and a lever, known by other means.
    for (kind, omega, known) in [
        ("slider", 0.5, 0.139493927),
        ("slider", 1.0, 0.850815718),
        ("rocker", 0.5, 0.2255032639),
        ("rocker", 1.0, 2.2818106737),
    ] {
        let deviation = follows_harmonic(kind, omega, 0.0).re - 1.0;
        assert!((deviation - known).abs() < 1e-9, "{kind} {deviation}");
    }
    let capacity = 0.5;
    let tau = capacity / std::f64::consts::TAU;
    for (kind, first) in [
        ("slider", std::f64::consts::FRAC_PI_2),
        ("rocker", 1.2222600570),
    ] {
        for share in [0.2, 0.5, 0.9] {
            let omega = share * first;
            let harmonic = omega / 0.1;
            for accuracy in ["1 %", "0.001 %"] {
                let object = format!(
                    r#""kind": "{kind}", "damping_capacity": {capacity},
                        "position": {{ "sine": {{ "amplitude": 1, "harmonic": {harmonic} }} }}"#
                );
                // The start fades by exp(−ω₁²τt/2); then the output is asked for at a late
                // instant, a quarter of a period after a zero of U.
                let periods = (400.0 * omega / std::f64::consts::TAU).ceil() + 0.25;
                let end = periods * std::f64::consts::TAU / omega;
                let run = format!(
                    r#""duration": {end}, "tolerance": 1e-10,
                        "accuracy": {{ "one.final.displacement": "{accuracy}" }}"#
                );
                let (_, certificate) = judged(&scene(&object, &run));
                let found = of(&certificate, "one.final.displacement");
                // Of U = sin ωt it is Re of the transfer function at a quarter of a period.
                let expected = follows_harmonic(kind, omega, tau).re;
                let off = (found.value - expected).abs();
                let error = found.error.expect("an error");
                let told = format!("{kind} {share} {accuracy}: {off} of {error}, {found:?}");
                assert!(off <= error + 1e-9, "{told}");
                assert!(found.holds && found.kind == Certainty::Bound, "{told}");
            }
        }
    }
}

#[test]
fn the_closed_rocker_needs_two_coordinates_at_most() {
    let text = r#"{ "dam": 1, "name": "Closed", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
        "one": { "kind": "rocker", "input": "shaft", "position": { "sine": { "amplitude": "90 deg" } },
            "inertia": 0.1, "stiffness": 1e7, "damping_capacity": 0.4, "masses": "auto",
            "pair": { "closure": "force" },
            "loads": { "closing": { "constant": "-1 kN m" } } } },
        "run": { "duration": 0.2, "start": "static", "accuracy": { "one.delta_max": "1 %" } } }"#;
    let (_, certificate) = judged(text);
    let found = of(&certificate, "one.delta_max");
    assert!((found.value / -5.349e-5 - 1.0).abs() < 0.01, "{found:?}");
    assert!(coordinates(&certificate) <= 2 && found.holds);
    // A closing moment that does not hold it: the pair opens, masses are counted.
    let (_, certificate) = judged(&text.replace("-1 kN m", "-400 N m"));
    assert!(matches!(
        certificate.models["one"].level,
        Level::Masses { .. }
    ));
}

const TWO_MASSES: &str = include_str!("../../scenarios/rocker/two_masses.json");

#[test]
fn a_contact_that_is_link_one_has_no_limit_and_its_deviation_an_interval() {
    // The limit of δ_max, of chains of 1024 and 2048 masses extrapolated in first order.
    let limit = 0.007_486_72;
    for masses in [1, 2, 4, 8, 12, 40] {
        let scene = Scene::from_json(TWO_MASSES).expect("a scene");
        let text = r#"{ "rocker.delta_max": "1 %", "rocker.pair.max_contact_force": "1 %" }"#;
        let accuracy: serde_json::Value = serde_json::from_str(text).expect("JSON");
        let mut document: serde_json::Value = serde_json::from_str(scene.json()).expect("JSON");
        document["run"]["accuracy"] = accuracy;
        document["objects"]["rocker"]["masses"] = masses.into();
        let (_, certificate) = judged(&document.to_string());
        let force = of(&certificate, "rocker.pair.max_contact_force");
        assert_eq!(force.kind, Certainty::NoLimit, "{masses}");
        assert!(force.error.is_none() && !force.holds, "{masses}");
        assert!(
            force
                .why
                .as_ref()
                .is_some_and(|why| why.contains("pair.contact"))
        );
        let deviation = of(&certificate, "rocker.delta_max");
        let error = deviation.error.expect("an error");
        assert!(
            (deviation.value - limit).abs() <= error,
            "{masses}: {deviation:?}"
        );
        assert!(error < 0.004 * limit, "{masses}: {error}");
    }
}

#[test]
fn what_leaves_nothing_to_choose_is_refused() {
    for (object, code) in [
        (
            r#""kind": "slider", "inertias": [1, 1], "stiffnesses": [1, 1], "masses": "auto""#,
            "masses",
        ),
        (
            r#""kind": "slider", "inertia": 1, "stiffness": 1, "masses": "auto", "lumping": "ends""#,
            "lumping",
        ),
        (
            r#""kind": "slider", "inertia": 1, "stiffness": 1, "masses": "auto",
                "loads": { "push": { "mass": 2, "constant": 1 } }"#,
            "loads",
        ),
        (
            r#""kind": "slider", "inertia": 1, "stiffness": 1, "masses": "many""#,
            "masses",
        ),
    ] {
        let text = format!(
            r#"{{ "dam": 1, "name": "Wrong", "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": 1 }} }},
                "one": {{ "input": "drive", "position": {{ "ratio": 1 }}, {object} }} }},
                "run": {{ "duration": 1 }} }}"#
        );
        let error = Scene::from_json(&text)
            .expect("JSON")
            .run()
            .expect_err("a fault");
        assert!(error.to_string().contains(code), "{code}: {error}");
    }
}

#[test]
fn an_object_may_give_way_without_vibrations() {
    // U = 3·φ² with φ̇ = 0.1: Ü = 0.06; δ = −β·J·Ü/c.
    for (kind, beta) in [("slider", 0.5), ("rocker", 0.75)] {
        let text = scene(
            &format!(
                r#""kind": "{kind}", "flexibility": "static",
                    "position": {{ "polynomial": {{ "coefficients": [0, 0, 3] }} }}"#
            ),
            r#""duration": 3"#,
        )
        .replace(r#""masses": "auto","#, "");
        let run = Scene::from_json(&text)
            .expect("a scene")
            .run()
            .expect("a run");
        let figures = run.figures("one").expect("figures");
        approx::assert_relative_eq!(figures.delta_max, -beta * 0.06, max_relative = 1e-9);
        approx::assert_relative_eq!(figures.peak_reaction, 0.06, max_relative = 1e-9);
    }
    // Behind a motor nothing is known beforehand.
    let motor = r#"{ "dam": 1, "name": "Motor", "objects": {
        "motor": { "kind": "drive", "motor": { "inertia": 1, "torque": { "constant": 1 } } },
        "one": { "kind": "rocker", "input": "motor", "position": { "ratio": 1 }, "inertia": 1,
            "stiffness": 9, "flexibility": "static" } }, "run": { "duration": 1 } }"#;
    let error = Scene::from_json(motor)
        .expect("JSON")
        .run()
        .expect_err("a fault");
    assert!(
        error.to_string().contains("static flexibility needs"),
        "{error}"
    );
}

#[test]
fn figures_are_compared_with_where_they_lead() {
    let scene = Scene::from_json(TWO_MASSES).expect("a scene");
    let mut reading = scene
        .set("rocker.masses", 12)
        .decode()
        .expect("a sound scene");
    let settings = dam::studies::RunSettings::of(&reading.scene).expect("settings");
    let figures = [
        "rocker.delta_max",
        "rocker.pair.max_contact_force",
        "rocker.pair.in_working_order",
    ];
    let figures = figures.iter().map(|figure| (*figure).to_owned());
    let found =
        dam::studies::order::limits(&mut reading.scene, &settings, figures, &Control::default());
    let found = found.expect("limits");
    let deviation = &found["rocker.delta_max"];
    let (value, error) = (
        deviation.value.expect("a limit"),
        deviation.error.expect("an error"),
    );
    assert!(
        (value - 0.007_486_72).abs() <= error && error < 1e-6,
        "{deviation:?}"
    );
    // Masses at the far ends of their cells: first order.
    assert!(
        (deviation.order.expect("an order") - 1.0).abs() < 0.1,
        "{deviation:?}"
    );
    let force = &found["rocker.pair.max_contact_force"];
    assert!(force.value.is_none() && force.why.is_some());
    assert_eq!(found["rocker.pair.in_working_order"].value, Some(0.0));
}

#[test]
fn a_map_has_one_level_for_all_its_points() {
    let open = Scene::from_json(TWO_MASSES).expect("a scene").duration(0.1);
    let open = open.set("rocker.masses", "auto");
    let asked = |scene: &Scene| {
        let axis = Axis::linear("rocker.inertia", 0.05, 0.2, 3);
        let question = scene
            .map(axis)
            .figure("rocker", Figure::DeltaAbs)
            .unchecked();
        question.ask().expect("a map")
    };
    let found = asked(&open);
    // Points choose different levels, of different families; that of the map serves them all.
    let mut chosen = Vec::new();
    for (column, inertia) in [0.05, 0.125, 0.2].into_iter().enumerate() {
        let accuracy = open.clone().set("rocker.inertia", inertia);
        let accuracy = accuracy.set("run.accuracy", figure_within("rocker.delta_abs"));
        let certificate = accuracy.prepare().expect("a mechanism").certificate;
        let certificate = certificate.expect("a certificate");
        chosen.push(certificate.models["rocker"].level);
        let own = of(&certificate, "rocker.delta_abs");
        let limit = own.limit.unwrap_or(own.value);
        let within = 0.01 * limit + own.error.expect("an error");
        let value = found[(0, column)].value.expect("a value");
        assert!(
            (value - limit).abs() <= within,
            "{inertia}: {value} {limit} ± {within}, {chosen:?}"
        );
    }
    assert!(chosen.contains(&Level::Static), "{chosen:?}");
    let masses = |level: &Level| matches!(level, Level::Masses { .. });
    assert!(chosen.iter().any(masses), "{chosen:?}");
}

fn figure_within(figure: &str) -> dam::read::Node {
    let mut node = dam::read::Node::object();
    node.set_property(figure, "1 %");
    node
}

#[test]
fn a_scene_that_cannot_be_judged_says_so() {
    let scene = Scene::from_json(TWO_MASSES).expect("a scene");
    let scene = scene
        .set("rocker.masses", "auto")
        .set("run.max_switches", 3);
    let mechanism = scene.prepare().expect("a mechanism");
    let certificate = mechanism.certificate.expect("a certificate");
    assert!(!certificate.accuracy.is_empty());
    for (figure, found) in &certificate.accuracy {
        assert_eq!(found.kind, Certainty::NotDetermined, "{figure}");
        assert!(found.why.is_some() && found.error.is_none());
    }
}

/// Beyond its limit of speed a valve train lifts off; with a contact of its own its force
/// has a limit: 1119.5 ± 1 N, by chains of 64 to 512 masses of another program.
#[test]
fn the_contact_force_of_a_valve_train_leads_to_its_limit() {
    let scene = Scene::read("scenarios/valve_train/in_working_order.json").expect("a scene");
    let figure = "valve.pair.max_contact_force";
    let mut contact = dam::read::Node::object();
    contact.set_property("stiffness", 3e7);
    let mut asked = dam::read::Node::object();
    asked.set_property(figure, "1 %");
    let scene = scene
        .set("camshaft.motion.speed", "1950 rpm")
        .set("valve.pair.contact", contact)
        .set("valve.masses", "auto")
        .set("run.accuracy", asked);
    let certificate = scene.prepare().expect("a mechanism").certificate;
    let certificate = certificate.expect("a certificate");
    let found = of(&certificate, figure);
    let error = found.error.expect("an error");
    assert!(
        found.holds && (found.value - 1119.5).abs() <= error + 1.0,
        "{found:?}"
    );
}
