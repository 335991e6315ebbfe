//! Positions from which friction allows no motion, or more than one: named
//! stops, with everything kept that was found before.

use super::support::{figure, run_of, scene_of, stopped};
use dam::studies::run::RunResult;

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

/// Two tall blocks that a motor shoves together, `rotor` its inertia as a mass. With
/// the push P they slow down evenly, a = (P − 2·μ·m·g)/(M + 2·m), as long as no corner
/// lifts, a > −g·b/h; below, with lifted corners, each rubs with μ·h/b = 1.5 times its
/// inertia force, (M + 2·m − 3·m)·a = P. If M < m, there is such a motion besides the
/// even one. Where one block rubs as it does, the other by itself has none: its share
/// is (M + 2·m − 1.5·m)·a.
fn two(rotor: f64, push: f64) -> RunResult {
    let ratio = r#""position": { "ratio": 0.1 },"#;
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": {}, "speed": 20, "torque": {{ "constant": {} }} }} }}, {}, {}"#,
        0.01 * rotor,
        0.1 * push,
        tall("motor", ratio, G),
        tall("motor", ratio, G).replacen(r#""m""#, r#""n""#, 1),
    );
    let run = r#""duration": 0.05, "tolerance": 1e-10, "start": "on_law""#;
    run_of(&scene_of(&objects, run), &[])
}

#[test]
fn two_blocks_together_may_have_another_motion_though_each_alone_has_not() {
    let mass = 2.0;
    for (rotor, push) in [(1.5, 5.0), (0.9 * mass, 5.0)] {
        let found = two(rotor, push);
        assert_eq!(stopped(&found), Some("several_solutions"), "{rotor} {push}");
        assert_eq!(found.outcome.time, 0.0);
        assert_finite(&found);
    }
    // Without push, and with less than the lifted corners ask for, there is none.
    let found = two(1.5, 0.5);
    assert_eq!(stopped(&found), Some("self_locking"));
    assert_finite(&found);
    // A heavy rotor has one motion only, with corners lifted or not.
    for (rotor, push) in [(2.5, 5.0), (2.5, 0.5), (2.5, -5.0), (1.1 * mass, 5.0)] {
        let found = two(rotor, push);
        assert_eq!(stopped(&found), None, "{rotor} {push}");
        let even = (push - 2.0 * 0.3 * mass * G) / (rotor + 2.0 * mass);
        let slowing = match even > -G * 0.03 / 0.15 {
            true => even,
            false => push / (rotor - mass),
        };
        let end = 10.0 * (2.0 * 0.05 + 0.5 * slowing * 0.05 * 0.05);
        let angle = figure(&found, "motor.final.displacement");
        approx::assert_abs_diff_eq!(angle, end, epsilon = 1e-9);
    }
}

/// A crank of constant speed pulls a block through a rod without masses; the load P on
/// the block is P/(cos α − μ·sin α) in the rod, α its slope. At tan α = 1/μ no force
/// moves it.
#[test]
fn a_given_motion_ends_where_the_mechanism_locks() {
    let (crank, rod, offset, speed) = (0.1, 0.12, 0.03, 2.0);
    let objects = |friction: f64| {
        format!(
            r#""drive": {{ "kind": "drive", "motion": {{ "speed": {speed} }} }},
        "m": {{ "kind": "linkage", "input": "drive", "driver": "O", "joint_friction": true,
            "ground": {{ "O": [0, 0], "G": [0, -{offset}] }},
            "links": {{ "crank": {{ "points": {{ "A": [{crank}, 0] }} }}, "rod": {{ "points": {{ "B": [{rod}, 0] }} }}, "block": {{}} }},
            "pairs": {{
                "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                "B": {{ "revolute": ["rod.B", "block.origin"] }},
                "guide": {{ "friction": {friction}, "sliding": {{ "guide": "ground.G", "block": "block.origin",
                    "corners": [0.02, -0.02] }} }} }},
            "assembly": {{ "block": {{ "near": [0.2, -{offset}] }} }},
            "forces": {{ "load": {{ "force": {{ "point": "block.origin", "force": [50, 0] }} }} }},
            "outputs": {{ "block": {{ "point": "block.origin" }} }} }}"#
        )
    };
    for (friction, method) in [(0.6, "auto"), (0.6, "radau"), (0.2, "dop853")] {
        let slope = f64::atan(1.0 / friction);
        let locks = f64::asin((rod * slope.sin() - offset) / crank) / speed;
        let run = format!(r#""duration": 1, "method": "{method}""#);
        let found = run_of(&scene_of(&objects(friction), &run), &[]);
        assert_eq!(stopped(&found), Some("self_locking"), "{method}");
        approx::assert_abs_diff_eq!(found.outcome.time, locks, epsilon = 1e-9);
        let said = format!("{:?}", found.outcome.stop);
        assert!(said.contains("no force of its drive overcomes"), "{said}");
        assert_finite(&found);
        // Towards there the force grows without limit.
        let reaction = figure(&found, "drive.peak_reaction");
        assert!(reaction > 1e3, "{reaction}");
    }
}
