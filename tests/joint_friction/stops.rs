//! Positions from which friction allows no motion, or more than one: named
//! stops, with everything kept that was found before.

use crate::support::{run_of, scene_of, stopped};
use dam::analysis::run::RunResult;

const G: f64 = 9.81;

/// A block whose centre of mass lies 150 mm above a guide of ±30 mm, μ = 0.3: a
/// deceleration a presses the corners with m·a·h/b, which rub with more than m·a.
fn tall(input: &str, more: &str, gravity: f64) -> String {
    format!(
        r#""m": {{ "kind": "linkage", "input": "{input}", "driver": "guide", {more} "joint_friction": true,
            "gravity": {{ "acceleration": {gravity} }}, "ground": {{ "O": [0, 0] }},
            "links": {{ "block": {{ "mass": 2, "centre": [0, 0.15], "moment": 0.01 }} }},
            "pairs": {{ "guide": {{ "friction": 0.3, "sliding": {{ "guide": "ground.O", "block": "block.origin",
                "corners": [0.03, -0.03] }} }} }} }}"#
    )
}

fn shoved(speed: f64, push: f64) -> RunResult {
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0, "speed": {}, "torque": {{ "constant": {} }} }} }}, {}"#,
        10.0 * speed,
        0.1 * push,
        tall("motor", r#""position": { "ratio": 0.1 },"#, G)
    );
    run_of(
        &scene_of(&objects, r#""duration": 1, "start": "on_law""#),
        &[],
    )
}

fn assert_finite(found: &RunResult) {
    let numbers = found
        .record
        .columns
        .iter()
        .flat_map(|column| &column.values);
    assert!(numbers.clone().all(|value| value.is_finite()));
}

/// With the push P there is no solution below m·g·(μ − b/h), and two above.
#[test]
fn a_tall_block_in_motion_has_no_acceleration_or_two() {
    let edge = 2.0 * G * (0.3 - 0.03 / 0.15);
    for (speed, push, reason) in [
        (2.0, 0.0, "self_locking"),
        (2.0, 0.98 * edge, "self_locking"),
        (2.0, 1.02 * edge, "several_solutions"),
        (-2.0, 0.0, "self_locking"),
        (-2.0, -1.02 * edge, "several_solutions"),
    ] {
        let found = shoved(speed, push);
        assert_eq!(stopped(&found), Some(reason), "{speed} {push}");
        assert_eq!(found.outcome.time, 0.0);
        assert_finite(&found);
    }
}

/// A rotor pushes the block through a sine law: the greater U′, the less the
/// rotor has to say. Where J = m·U′²·(μ·h/b − 1) a second solution comes in from
/// an infinite deceleration. Until there the block accelerates, and its friction
/// is μ·h/b times its inertia force: (J + m·(1 + μ·h/b)·U′²)·φ̇² is constant.
#[test]
fn a_second_solution_on_the_way_stops_the_run_where_it_comes_in() {
    let (inertia, amplitude, from, speed) = (0.005, 0.1, f64::to_radians(-80.0), 10.0);
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": {inertia}, "angle": {from}, "speed": {speed}, "torque": {{ "constant": 0 }} }} }},
        "ram": {{ "kind": "slider", "input": "motor", "position": {{ "sine": {{ "amplitude": {amplitude} }} }}, "inertia": 0, "masses": 0 }}, {}"#,
        tall("ram", "", 0.5)
    );
    let run = r#""duration": 1, "tolerance": 1e-10, "start": "on_law""#;
    let found = run_of(&scene_of(&objects, run), &[]);
    let to = -f64::acos(f64::sqrt(inertia / (2.0 * 0.5)) / amplitude);
    let effective = |phi: f64| inertia + 5.0 * (amplitude * phi.cos()).powi(2);
    let pace = |phi: f64| (effective(phi) / effective(from)).sqrt() / speed;
    let n = 2000;
    let h = (to - from) / f64::from(n);
    let time: f64 = (0..n)
        .map(|i| {
            let a = from + f64::from(i) * h;
            h / 6.0 * (pace(a) + 4.0 * pace(a + 0.5 * h) + pace(a + h))
        })
        .sum();
    assert_eq!(stopped(&found), Some("several_solutions"));
    approx::assert_abs_diff_eq!(found.outcome.time, time, epsilon = 1e-6);
    assert_finite(&found);
    let rows = found.record.times.iter().filter(|&&t| t < time).count();
    assert!(rows > 10, "{rows} rows");
}
