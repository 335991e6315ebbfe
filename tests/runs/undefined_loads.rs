//! Loads by expressions that have no finite value from some place of the motion on: the run
//! ends there for that reason, whatever the method; pieces that only end there are passed.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::{Method, Stop};
use dam::prelude::*;

/// A free rotor of 2 kg m², so that motions are known in closed form.
fn rotor(torque: &str, method: &str) -> String {
    let step = match method {
        "rk4" => r#", "step": 1e-4"#,
        _ => "",
    };
    format!(
        r#"{{ "dam": 1, "name": "rotor", "objects": {{ "rotor": {{ "kind": "drive",
            "motor": {{ "inertia": 2, "speed": 1, "torque": {{ "expression": "{torque}" }} }} }} }},
            "run": {{ "duration": 3, "tolerance": 1e-9, "method": "{method}"{step} }} }}"#
    )
}

/// A rigid lever, an elastic shaft behind it, and a load on the shaft.
fn shaft(load: &str, masses: usize, method: &str) -> String {
    let step = match method {
        "rk4" => r#", "step": 1e-4"#,
        _ => "",
    };
    let elastic = match masses {
        0 => String::new(),
        _ => r#""stiffness": 800, "damping_capacity": 0.3, "#.to_owned(),
    };
    format!(
        r#"{{ "dam": 1, "name": "shaft", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "expression": "2*t + 0.1*sin(5*t)" }} }},
            "lever": {{ "kind": "shaft", "input": "drive", "inertia": 0.02, {elastic}
                "masses": {masses}, "loads": {{ "own": {{ "expression": "{load}" }} }} }} }},
            "run": {{ "duration": 0.5, "tolerance": 1e-9, "method": "{method}"{step} }} }}"#
    )
}

fn run(text: &str) -> RunResult {
    let scene = Scene::from_json(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    scene
        .run()
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The methods that this build has, and `auto`.
fn methods() -> Vec<&'static str> {
    let own = Method::available().map(Method::name);
    own.chain(["auto"]).collect()
}

/// The run ends near a time since the load of an object has no value, and says where.
#[track_caller]
fn ends(text: &str, load: &str, time: f64, place: &str) {
    let run = run(text);
    let Stop::Physical(stop) = &run.outcome.stop else {
        panic!("{text}: {:?}", run.outcome);
    };
    assert_eq!(stop.name, "no_value", "{text}");
    assert_abs_diff_eq!(run.outcome.time, time, epsilon = 2e-4);
    for words in [load, "has no finite value at t = ", place] {
        assert!(stop.message.contains(words), "{text}\n{}", stop.message);
    }
    assert_eq!(load.split('.').next(), Some(stop.object.as_str()));
    // (Fixed steps are too long for what is as steep.)
    let fixed = text.contains("rk4");
    assert!(
        fixed || format!("{:?}", run.judgement()) == "NotJudged",
        "{text}"
    );
}

#[test]
fn a_run_ends_where_a_load_has_no_value() {
    for method in methods() {
        // φ = t.
        let load = "rotor.motor.torque";
        for (torque, time, place) in [
            ("1e-9*sqrt(0.7 - phi)", 0.7, "phi = 0.7"),
            ("1e-9*log(phi_dot - t)", 1.0, "phi_dot = "),
            ("1e-9*acos(phi - 0.5)", 1.5, "phi = 1.5"),
        ] {
            ends(&rotor(torque, method), load, time, place);
        }
        // The pole attracts: φ̇² = 1 + ln(1/(1 − φ)). Energies are in doubt close to it.
        let told = format!("{:?}", run(&rotor("1/(1-phi)", method)).outcome.stop);
        let names = told.contains("no_value") && told.contains(load);
        let place = ["phi = 0.99", "phi = 1"]
            .iter()
            .any(|own| told.contains(own));
        assert!(names && place, "{method}: {told}");
    }
}

#[test]
fn a_load_behind_a_given_motion_ends_alike() {
    // driver_phi = 0.6 where 2·t + 0.1·sin(5·t) is.
    let mut time = 0.3f64;
    for _ in 0..30 {
        time -= (2.0 * time + 0.1 * (5.0 * time).sin() - 0.6) / (2.0 + 0.5 * (5.0 * time).cos());
    }
    for method in methods() {
        let load = "lever.loads.own";
        for masses in [0, 2] {
            for expression in ["sqrt(0.6 - driver_phi)", "log(0.6 - driver_phi)"] {
                let text = shaft(expression, masses, method);
                ends(&text, load, time, "driver_phi = 0.6");
            }
        }
    }
}

#[test]
fn pieces_with_a_value_on_either_side_of_their_edge_are_passed() {
    for method in methods() {
        // 2·φ̈ = √(0.7 − t), then nothing: φ̇ = 1 + 0.7^1.5/3.
        let fine = match method {
            "rk4" => 1e-5,
            "tr_bdf2" | "esdirk34" => 1e-6,
            _ => 3e-8,
        };
        for torque in [
            "t < 0.7 ? sqrt(0.7 - t) : 0",
            "t > 0.7 ? 0 : sqrt(0.7 - t)",
            "t < 0.7 ? 0 : t < 1.4 ? sqrt(t - 0.7) : 0",
            "t < 1 ? 0 : t < 1.7 ? sqrt(1.7 - t) : 0",
        ] {
            let run = run(&rotor(torque, method));
            assert!(run.is_complete(), "{method} {torque}: {:?}", run.outcome);
            let speed = run.figures.value("rotor.final.speed").unwrap();
            assert_relative_eq!(speed, 1.0 + 0.7f64.powf(1.5) / 3.0, max_relative = fine);
        }
        // 2·φ̈ = √(0.7 − φ): φ̇² = 1 + (2/3)·0.7^1.5.
        for torque in [
            "phi < 0.7 ? sqrt(0.7 - phi) : 0",
            "phi < 0.7 ? 0 : phi < 1.4 ? sqrt(phi - 0.7) : 0",
        ] {
            let run = run(&rotor(torque, method));
            assert!(run.is_complete(), "{method} {torque}: {:?}", run.outcome);
            let speed = run.figures.value("rotor.final.speed").unwrap();
            let wanted = (1.0 + 2.0 / 3.0 * 0.7f64.powf(1.5)).sqrt();
            assert_relative_eq!(speed, wanted, max_relative = fine);
        }
    }
}

#[test]
fn exact_passes_them_too() {
    let scene = |load: &str, method: &str| {
        let text = shaft(load, 2, method);
        text.replace(
            "{ \"expression\": \"2*t + 0.1*sin(5*t)\" }",
            "{ \"speed\": 2 }",
        )
    };
    for load in [
        "t < 0.2 ? sqrt(0.2 - t) : 0",
        "t < 0.2 ? 0 : sqrt(t - 0.2)",
        "driver_phi < 0.4 ? 3*sqrt(0.4 - driver_phi) : 0",
    ] {
        let [own, other] = ["exact", "radau"].map(|method| run(&scene(load, method)));
        assert!(own.is_trusted() && other.is_trusted(), "{load}");
        for figure in ["lever.delta_max", "lever.final.speed"] {
            let [own, other] = [&own, &other].map(|run| run.figures.value(figure).unwrap());
            assert_abs_diff_eq!(own, other, epsilon = 1e-8);
        }
    }
}

/// What is not told at one place alone, 0/0 that tends to a number, is passed.
#[test]
fn places_without_a_pole_are_passed() {
    for method in methods() {
        for torque in ["sin(phi - 0.7)/(phi - 0.7)", "1/(1e-4 + (phi - 0.7)^2)/1e4"] {
            let run = run(&rotor(torque, method));
            assert!(run.is_complete(), "{method} {torque}: {:?}", run.outcome);
        }
    }
}

/// A load that grows with an infinite rate at the start is in balance there, but the deflection
/// has no rate: a quiet start is refused for that reason, a static one runs.
#[test]
fn a_load_that_rises_infinitely_fast_starts_at_rest() {
    let text = |start: &str| {
        let own = shaft("3*sqrt(t)", 1, "dop853");
        own.replace(
            r#""duration""#,
            &format!(r#""start": "{start}", "duration""#),
        )
    };
    let [at_rest, on_law] = ["static", "on_law"].map(|start| run(&text(start)));
    let end = |run: &RunResult| run.figures.objects["lever"].end.displacement;
    assert_relative_eq!(end(&at_rest), end(&on_law), max_relative = 1e-6);
    let scene = Scene::from_json(&text("kinetostatic")).unwrap();
    let refused = scene.run().unwrap_err().to_string();
    assert!(refused.contains("infinitely fast at t = 0"), "{refused}");
}
