//! Every method finds the same motion, or says that it does not.

use super::random_scenes::scene;

use dam::integrate::Method;
use dam::lower::lower;
use dam::record::ObjectFigures;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings, Warning};
use dam::system::System;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde_json::Value;
use std::collections::BTreeMap;
use std::time::Duration;

fn run_of(text: &str, method: Option<Method>, tolerance: f64) -> RunResult {
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let settings = RunSettings {
        method,
        tolerance,
        ..RunSettings::of(&reading.scene).unwrap()
    };
    let result = run(&system, &settings, &Control::FREE, &mut []).unwrap();
    assert!(result.is_complete(), "{:?}", result.outcome.stop);
    result
}

/// A stiff lever on a slow drive, against a spring: φ = U·c/(c + k) but for what vibrates
/// at its start, U = A·sin ωt.
fn stiff(stiffness: f64, inertia: f64, masses: usize) -> String {
    format!(
        r#"{{ "dam": 1, "name": "stiff", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "run_up": {{ "speed": 1, "time": 2 }} }} }},
            "lever": {{ "kind": "rocker", "input": "drive", "inertia": {inertia:?},
                "stiffness": {stiffness:?}, "damping_capacity": 0.3, "masses": {masses},
                "position": {{ "sine": {{ "amplitude": 0.3 }} }},
                "loads": {{ "spring": {{ "spring": {{ "rate": 1e5 }} }} }} }} }},
            "run": {{ "duration": 8 }} }}"#
    )
}

#[test]
fn steps_over_stiff_vibrations_tell_the_acceleration_of_the_motion() {
    for (stiffness, inertia, masses) in [(1e8, 0.01, 1), (1e8, 0.01, 3), (1e7, 1.0, 3)] {
        let text = stiff(stiffness, inertia, masses);
        // (The spring pulls at the end of the chain, of `masses` links in series.)
        let gives = stiffness / (stiffness + 1e5);
        for (method, tolerance, within) in [
            (Method::Radau, 1e-7, 2e-3),
            (Method::Radau, 1e-9, 2e-4),
            (Method::Radau, 1e-12, 1e-6),
            (Method::Rodas5p, 1e-9, 1e-5),
        ] {
            let result = run_of(&text, Some(method), tolerance);
            let found = result.figures.objects["lever"].peak_acceleration;
            approx::assert_relative_eq!(found, 0.3 * gives, max_relative = within);
        }
    }
}

#[test]
fn a_fixed_step_that_is_too_long_says_so() {
    // 632 rad/s, undamped, for 0.2 s: 20 turns of phase.
    let text = r#"{ "dam": 1, "name": "wheel", "objects": {
        "drive": { "kind": "drive", "motion": { "speed": "30 rad/s" } },
        "wheel": { "kind": "shaft", "input": "drive", "inertia": 0.02, "stiffness": 8000 } },
        "run": { "duration": 0.2, "start": { "wheel": { "displacement": [0.01], "speed": [30] } } } }"#;
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let run_with = |step: f64| {
        let settings = RunSettings {
            method: Some(Method::Rk4),
            step: Some(step),
            tolerance: 1e-6,
            ..RunSettings::of(&reading.scene).unwrap()
        };
        run(&system, &settings, &Control::FREE, &mut []).unwrap()
    };
    let told = |result: &RunResult| {
        let warnings = result.warnings.iter();
        let phases = warnings.filter_map(|warning| match warning {
            Warning::FixedStep { phase, step, .. } => Some((*phase, *step)),
            _ => None,
        });
        phases.collect::<Vec<_>>()
    };
    let rough = run_with(2e-4);
    let [(phase, step)] = told(&rough)[..] else {
        panic!("{:?}", rough.warnings);
    };
    // The phase by the displacement where the vibration passes its middle: the deviation
    // is 0.01·cos ωt but for it.
    let omega = 8000f64.sqrt() / 0.02f64.sqrt();
    let end = &rough.figures.objects["wheel"].end;
    let deviation = end.displacement - 30.0 * 0.2;
    let found = (deviation / 0.01).acos();
    let true_phase = (omega * 0.2).rem_euclid(std::f64::consts::TAU);
    let lag = (found - true_phase)
        .abs()
        .min((found + true_phase - std::f64::consts::TAU).abs());
    approx::assert_relative_eq!(lag, phase, max_relative = 0.2);
    assert!(told(&run_with(0.99 * step)).is_empty());
}

/// Tolerance of the runs that are compared, and how far their figures may be apart.
const TOLERANCE: f64 = 1e-8;
const APART: f64 = 1e-4;
/// A figure of an object counts where it is no less than this part of the greatest among
/// all.
const COUNTS: f64 = 1e-2;

/// Figures of the motion of a run that is whole and has not said that they are in doubt.
fn motion_of(text: &str, method: Option<Method>) -> Option<BTreeMap<String, ObjectFigures>> {
    let document = Document::parse("random.json", text.as_bytes()).ok()?;
    let reading = document.scene(&BuiltIn, &Overrides::none()).ok()?;
    let system = System::new(lower(&reading.scene).ok()?).ok()?;
    let settings = RunSettings {
        method,
        tolerance: TOLERANCE,
        step: (method == Some(Method::Rk4)).then_some(2e-6),
        ..RunSettings::of(&reading.scene).unwrap()
    };
    let control = Control::FREE.within(Duration::from_secs(5));
    let result = run(&system, &settings, &control, &mut []).ok()?;
    let doubtful = |warning: &Warning| {
        matches!(
            warning,
            Warning::Undetermined { .. }
                | Warning::SwitchesUndetermined { .. }
                | Warning::FixedStep { .. }
        )
    };
    if !result.is_complete() || !result.is_trusted() || result.warnings.iter().any(doubtful) {
        return None;
    }
    let figures = result.figures.objects.iter();
    Some(figures.map(|(id, own)| (id.clone(), own.clone())).collect())
}

/// The figures of an object's motion that are compared, each with what it is measured
/// against at least: deviations against each other; speeds and accelerations of what rests
/// against what the object's greatest force would make of it, since there is nothing but
/// what steps leave of that. (What no force acts on flies.)
fn compared(own: &ObjectFigures, body: &Value) -> [(&'static str, f64, f64); 6] {
    let number = |name: &str| body[name].as_f64().unwrap_or(f64::INFINITY);
    let delta = own.delta_max.abs().max(own.delta_min.abs());
    let inertia = number("inertia") / number("masses").max(1.0);
    let [speed, acceleration] = match (own.peak_speed, own.peak_reaction) {
        (0.0, 0.0) => [f64::INFINITY; 2],
        (_, 0.0) => [0.0, f64::INFINITY],
        (0.0, force) => [
            force / (inertia * number("stiffness")).sqrt(),
            force / inertia,
        ],
        _ => [0.0; 2],
    };
    [
        ("delta_max", own.delta_max, delta),
        ("delta_min", own.delta_min, delta),
        ("sigma", own.sigma, delta),
        ("peak_speed", own.peak_speed, speed),
        ("peak_acceleration", own.peak_acceleration, acceleration),
        ("peak_reaction", own.peak_reaction, 0.0),
    ]
}

#[test]
fn random_scenes_have_the_same_figures_by_every_method() {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[11; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let (mut count, mut apart) = (0, Vec::new());
    for number in 0..60 {
        let scene = scene().new_tree(&mut runner).unwrap().current();
        let text = scene.to_string();
        let Some(reference) = motion_of(&text, None) else {
            continue;
        };
        for method in [
            Method::Dop853,
            Method::Dopri5,
            Method::Taylor,
            Method::Rodas5p,
            Method::Radau,
            Method::Rk4,
        ] {
            let Some(found) = motion_of(&text, Some(method)) else {
                continue;
            };
            count += 1;
            let mut greatest = [0.0f64; 6];
            for (id, own) in &reference {
                let all = compared(own, &scene["objects"][id]);
                for (greatest, (_, value, _)) in greatest.iter_mut().zip(all) {
                    *greatest = greatest.max(value.abs());
                }
            }
            for (id, own) in &reference {
                let body = &scene["objects"][id];
                let all = compared(own, body)
                    .into_iter()
                    .zip(compared(&found[id], body));
                for (((name, value, beside), other), greatest) in all.zip(greatest) {
                    let size = value.abs().max(COUNTS * greatest).max(beside);
                    if (value - other.1).abs() > APART * size + f64::EPSILON * greatest {
                        apart.push(format!(
                            "{number} {method} {id}.{name}: {value} {} {text}",
                            other.1
                        ));
                    }
                }
            }
        }
    }
    assert!(count > 100, "{count}");
    assert!(apart.is_empty(), "{}", apart.join("\n"));
}
