//! Loads over time behind a drive of constant speed: the cycle holds their periods whole times.

use super::scenes::{faults, of_text};
use dam::studies::steady::{Answer, PeriodicAnswer, steady_motion};
use std::f64::consts::{PI, TAU};

/// The mass (kg).
const MASS: f64 = 1.0;
/// Its damping (N·s/m).
const DAMPING: f64 = 20.0;
/// Its stiffness (N/m).
const STIFFNESS: f64 = 20_000.0;
/// The amplitude of its law (m).
const LIFT: f64 = 0.01;

/// The drive's angular speed: 600 rpm.
const SPEED: f64 = 20.0 * PI;

/// A damped mass on a sine law, with a load.
fn text(load: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "slider", "objects": {{
            "c": {{ "kind": "drive", "motion": {{ "speed": "600 rpm" }} }},
            "f": {{ "kind": "slider", "input": "c", "masses": 1, "inertia": "1 kg",
                    "stiffness": "20 N/mm", "damping": "20 N s/m",
                    "position": {{ "sine": {{ "amplitude": "10 mm" }} }},
                    "loads": {{ "h": {load} }} }} }},
          "run": {{ "duration": 5 }} }}"#
    )
}

fn answer(load: &str) -> PeriodicAnswer {
    let (system, settings, spec) = of_text(&text(load), &[]);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Periodic(answer) => *answer,
        Answer::Rigid(_) => panic!("it is elastic"),
    }
}

/// Deviation and its rate at t = 0 under `size`·sin(ωt + phase), by complex amplitudes.
fn response(size: f64, speed: f64, phase: f64) -> [f64; 2] {
    let (real, imaginary) = (STIFFNESS - MASS * speed * speed, DAMPING * speed);
    let modulus = size / real.hypot(imaginary);
    let (sin, cos) = (phase - imaginary.atan2(real)).sin_cos();
    [modulus * sin, modulus * speed * cos]
}

#[test]
fn a_harmonic_load_over_time_makes_the_cycle_as_long_as_both_need() {
    // Frequency (Hz) and turns of the drive (10 Hz) after which both repeat.
    for (frequency, turns) in [(5.0, 2.0), (20.0, 1.0), (7.5, 4.0), (12.0, 5.0)] {
        let found = answer(&format!(
            r#"{{ "harmonic": {{ "amplitude": 20, "frequency": "{frequency} Hz", "phase": 0.4 }} }}"#
        ));
        approx::assert_relative_eq!(found.cycle, turns * TAU, max_relative = 1e-12);
        approx::assert_relative_eq!(found.turn, turns * 0.1, max_relative = 1e-12);
        assert!(found.is_trusted() && found.parts[0].long_run.settles);
        let law = response(MASS * LIFT * SPEED * SPEED, SPEED, 0.0);
        let load = response(20.0, TAU * frequency, 0.4);
        for (entry, scale) in [(0, 1e-3), (1, 0.1)] {
            let off = (found.state[entry] - law[entry] - load[entry]).abs() / scale;
            assert!(off < 1e-8, "{frequency} Hz, {entry}: off by {off:e}");
        }
    }
}

#[test]
fn expressions_over_time_and_angles_lengthen_the_cycle_where_their_operations_prove_it() {
    for (load, turns) in [
        ("5*sin(2*pi*2.5*t)*driver_phi_dot", 4.0),
        ("max(0, 20*sin(2*pi*5*t + driver_phi/2))", 1.0),
        ("20*sin(2*pi*5*t + driver_phi)", 2.0),
        ("20*sin(2*pi*5*t - driver_phi/2)", 1.0),
        ("(t % 0.3) < 0.1 ? 20 : 0", 3.0),
        ("20*sin(2*pi*5*t + 30*phi)", 2.0),
    ] {
        let found = answer(&format!(r#"{{ "expression": "{load}" }}"#));
        approx::assert_relative_eq!(found.cycle, turns * TAU, max_relative = 1e-12);
        assert!(found.is_trusted(), "{load}");
        assert!(found.parts[0].long_run.settles, "{load}");
    }
}

#[test]
fn loads_that_never_repeat_have_no_periodic_motion() {
    for (load, wanted) in [
        (r#"{ "expression": "-20*exp(-t)" }"#, "does not repeat"),
        (
            r#"{ "expression": "20*sin(2*pi*5*t^2)" }"#,
            "does not repeat",
        ),
        (r#"{ "expression": "t < 0.2 ? 20 : 0" }"#, "does not repeat"),
        (
            r#"{ "time_table": [[0, 0], [0.1, -20], [0.2, 0]] }"#,
            "table over time",
        ),
        (
            r#"{ "position_table": { "points": [[0, 0], ["90 deg", -50], ["180 deg", 0]] } }"#,
            "moves past it",
        ),
        (
            r#"{ "harmonic": { "amplitude": 20, "frequency": "7.31 Hz" } }"#,
            "do not repeat together",
        ),
        (
            r#"{ "expression": "20*sin(5*t)" }"#,
            "do not repeat together",
        ),
    ] {
        let found = faults(&text(load), |_| ());
        assert_eq!(found.len(), 1, "{load}: {found:?}");
        assert!(found[0].message.contains(wanted), "{load}: {found:?}");
        assert!(!found[0].hint.is_empty(), "{load}");
    }
}

#[test]
fn a_table_over_time_of_one_value_is_a_constant() {
    let table = answer(r#"{ "time_table": [[0, -20], [0.1, -20]] }"#);
    let constant = answer(r#"{ "constant": -20 }"#);
    assert_eq!(table.cycle, TAU);
    for (one, other) in table.state.iter().zip(&constant.state) {
        approx::assert_relative_eq!(one, other, max_relative = 1e-9);
    }
}

/// A law that grows faster and faster behind a drive that turns on never comes back, though its
/// acceleration is the same for ever.
#[test]
fn a_motion_that_never_repeats_has_no_periodic_motion() {
    let own = text(r#"{ "constant": -20 }"#).replace(
        r#"{ "sine": { "amplitude": "10 mm" } }"#,
        r#"{ "polynomial": { "coefficients": [0, 0.01, 0.001] } }"#,
    );
    let found = faults(&own, |_| ());
    assert!(found[0].message.contains("does not repeat"), "{found:?}");
}

/// A follower behind a differential on drives of 600 rpm, or on one that is held.
fn behind_a_differential(ratios: [f64; 2], second: &str, loads: &str) -> String {
    let [one, two] = ratios;
    format!(
        r#"{{ "dam": 1, "name": "sum", "objects": {{
            "a": {{ "kind": "drive", "motion": {{ "speed": "600 rpm" }} }},
            "b": {{ "kind": "drive", "motion": {second} }},
            "sum": {{ "kind": "differential", "masses": 0, "inertia": 0.01, "inputs": {{
                "one": {{ "object": "a", "ratio": {one} }}, "two": {{ "object": "b", "ratio": {two} }} }} }},
            "f": {{ "kind": "slider", "input": "sum", "masses": 1, "inertia": "1 kg",
                "stiffness": "20 N/mm", "damping": "20 N s/m",
                "position": {{ "sine": {{ "amplitude": "10 mm" }} }}, "loads": {{ {loads} }} }} }},
          "run": {{ "duration": 5 }} }}"#
    )
}

/// What follows Σ ratio·φ at the speed Σ ratio·ω moves as on a single drive of that speed.
#[test]
fn several_inputs_lengthen_the_cycle_by_the_speed_of_their_sum() {
    let (held, turning) = (r#"{ "fixed": 0 }"#, r#"{ "speed": "600 rpm" }"#);
    for (ratios, second, turns) in [
        ([0.75, 0.25], held, 4.0),
        ([0.75, 0.25], turning, 1.0),
        ([0.5, 0.1], turning, 5.0),
        ([1.5, -0.25], turning, 4.0),
        ([2.0, 1.0], held, 1.0),
    ] {
        let (system, settings, spec) = of_text(&behind_a_differential(ratios, second, ""), &[]);
        let Answer::Periodic(found) = steady_motion(&system, &settings, &spec).unwrap() else {
            panic!("it is elastic");
        };
        approx::assert_relative_eq!(found.cycle, turns * TAU, max_relative = 1e-12);
        assert!(
            found.is_trusted() && found.parts[0].long_run.settles,
            "{ratios:?}"
        );
        let second = if second == held { 0.0 } else { ratios[1] };
        let speed = SPEED * (ratios[0] + second);
        let law = response(MASS * LIFT * speed * speed, speed, 0.0);
        for (entry, scale) in [(0, 1e-3), (1, 0.1)] {
            let off = (found.state[entry] - law[entry]).abs() / scale;
            assert!(off < 1e-8, "{ratios:?}, {entry}: off by {off:e}");
        }
    }
}

/// Everything that has no cycle in common with the drive is named, each by itself.
#[test]
fn what_stands_against_a_cycle_is_named_singly() {
    let held = r#"{ "fixed": 0 }"#;
    let paths = |text: &str| -> Vec<String> {
        let found = faults(text, |_| ());
        let whole = found
            .iter()
            .all(|fault| fault.message.contains("no periodic motion") && !fault.hint.is_empty());
        assert!(whole, "{found:?}");
        found.into_iter().map(|fault| fault.path).collect()
    };
    // The ratio of the sum.
    let irrational = 2.0f64.sqrt() - 1.0;
    let own = behind_a_differential([irrational, 0.25], held, "");
    assert_eq!(paths(&own), ["f"]);
    // Loads over time, beside such as never repeat; one repeats with the drive.
    let loads = r#""five": { "harmonic": { "amplitude": 20, "frequency": "5 Hz" } },
        "odd": { "harmonic": { "amplitude": 20, "frequency": "7.31415926 Hz" } },
        "other": { "expression": "20*sin(2*pi*11.41421356*t)" },
        "fading": { "expression": "-20*exp(-t)" }, "growing": { "expression": "t*sin(2*pi*5*t)" }"#;
    let mut named = paths(&behind_a_differential([0.5, 0.5], held, loads));
    named.sort();
    assert_eq!(
        named,
        [
            "f.loads.fading",
            "f.loads.growing",
            "f.loads.odd",
            "f.loads.other"
        ]
    );
    // Each repeats with the drive, after 13 turns and after 11, and not with the other.
    let loads = r#""one": { "harmonic": { "amplitude": 20, "frequency": 0.7692307692307692 } },
        "two": { "harmonic": { "amplitude": 20, "frequency": 0.9090909090909091 } }"#;
    assert_eq!(
        paths(&behind_a_differential([1.0, 1.0], held, loads)),
        ["f.loads.one", "f.loads.two"]
    );
}
