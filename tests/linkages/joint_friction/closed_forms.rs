//! Motions whose closed form is known.

use super::support::{figure, run_of, scene_of, stopped};

const G: f64 = 9.81;

/// A block on a guide that rises by `degrees`, its centre of mass above the
/// axis; a massless rotor of 0.1 m a radian shoves it.
fn incline(degrees: f64, friction: f64, speed: f64) -> String {
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0, "speed": {}, "torque": {{ "constant": 0 }} }} }},
        "m": {{ "kind": "linkage", "input": "motor", "driver": "guide", "position": {{ "ratio": 0.1 }},
            "joint_friction": true, "gravity": {{ "acceleration": {G} }}, "ground": {{ "O": [0, 0] }},
            "links": {{ "block": {{ "mass": 2.5, "centre": [0, 0.02], "moment": 0.01 }} }},
            "pairs": {{ "guide": {{ "friction": {friction}, "sliding": {{ "guide": "ground.O", "block": "block.origin",
                "direction": "{degrees} deg", "corners": [0.1, -0.1] }} }} }} }}"#,
        10.0 * speed
    );
    scene_of(
        &objects,
        r#""duration": 1, "tolerance": 1e-10, "start": "on_law""#,
    )
}

#[test]
fn a_block_stops_on_a_slope_and_stays_where_friction_holds_it() {
    let (slope, friction, speed) = (20f64.to_radians(), 0.4, 2.0);
    let slowing = G * (slope.sin() + friction * slope.cos());
    let found = run_of(&incline(20.0, friction, speed), &[]);
    let way = speed * speed / (2.0 * slowing);
    approx::assert_abs_diff_eq!(figure(&found, "m.final.displacement"), way, epsilon = 1e-10);
    assert_eq!(figure(&found, "m.final.speed"), 0.0);
    assert_eq!(figure(&found, "m.standstills"), 1.0);
    let rest = 1.0 - speed / slowing;
    approx::assert_abs_diff_eq!(figure(&found, "m.time_at_rest"), rest, epsilon = 1e-9);
    let loss = friction * slope.cos() * 2.5 * G * way;
    approx::assert_abs_diff_eq!(figure(&found, "m.friction_loss"), loss, epsilon = 1e-8);
}

#[test]
fn a_block_slides_back_where_the_slope_is_steeper_than_friction_holds() {
    let (slope, friction, speed) = (30f64.to_radians(), 0.4, 2.0);
    let slowing = G * (slope.sin() + friction * slope.cos());
    let falling = G * (slope.sin() - friction * slope.cos());
    let found = run_of(&incline(30.0, friction, speed), &[]);
    let (way, left) = (speed * speed / (2.0 * slowing), 1.0 - speed / slowing);
    let end = way - 0.5 * falling * left * left;
    approx::assert_abs_diff_eq!(figure(&found, "m.final.displacement"), end, epsilon = 1e-9);
    approx::assert_abs_diff_eq!(
        figure(&found, "m.final.speed"),
        -falling * left,
        epsilon = 1e-9
    );
    assert_eq!(figure(&found, "m.time_at_rest"), 0.0);
}

#[test]
fn a_block_at_rest_starts_only_where_the_slope_overcomes_friction() {
    for (friction, degrees) in [
        (0.4, 21.0),
        (0.4, 22.5),
        (0.4, -21.0),
        (0.4, -22.5),
        (0.0, 5.0),
    ] {
        let slope = f64::to_radians(degrees);
        let found = run_of(&incline(degrees, friction, 0.0), &[]);
        let pull = slope.sin().abs() - friction * slope.cos();
        let way = if pull > 0.0 {
            -0.5 * G * pull * slope.signum()
        } else {
            0.0
        };
        let end = figure(&found, "m.final.displacement");
        approx::assert_abs_diff_eq!(end, way, epsilon = 1e-9);
        if friction > 0.0 {
            let rest = if pull > 0.0 { 0.0 } else { 1.0 };
            assert_eq!(figure(&found, "m.time_at_rest"), rest, "{degrees}");
        }
    }
}

/// A wheel of 12 kg on a pin, a rotor turning with it.
fn wheel(speed: f64, torque: f64) -> String {
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.1, "speed": {speed}, "torque": {{ "constant": {torque} }} }} }},
        "m": {{ "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
            "gravity": {{ "acceleration": {G} }}, "ground": {{ "O": [0, 0] }},
            "links": {{ "wheel": {{ "mass": 12, "moment": 0.3 }} }},
            "pairs": {{ "O": {{ "revolute": ["ground.O", "wheel.origin"], "diameter": "50 mm", "friction": 0.2 }} }} }}"#
    );
    scene_of(
        &objects,
        r#""duration": 4, "tolerance": 1e-10, "start": "on_law""#,
    )
}

#[test]
fn a_wheel_is_slowed_evenly_by_the_friction_of_its_pin_and_stays() {
    let moment = 0.2 * 0.025 * 12.0 * G;
    for (speed, torque) in [(3.0, 0.0), (-3.0, 0.0), (3.0, -0.4), (3.0, 0.2)] {
        let found = run_of(&wheel(speed, torque), &[]);
        let slowing = (moment - torque * f64::signum(speed)) / 0.4;
        let angle = speed * speed / (2.0 * slowing) * f64::signum(speed);
        let end = figure(&found, "m.final.displacement");
        approx::assert_abs_diff_eq!(end, angle, epsilon = 1e-9 * angle.abs());
        assert_eq!(figure(&found, "motor.final.speed"), 0.0);
        let rest = figure(&found, "m.time_at_rest");
        approx::assert_abs_diff_eq!(rest, 4.0 - speed.abs() / slowing, epsilon = 1e-8);
        assert_eq!(figure(&found, "m.standstills"), 1.0);
        let loss = figure(&found, "m.friction_loss");
        approx::assert_abs_diff_eq!(loss, moment * angle.abs(), epsilon = 1e-8);
    }
}

#[test]
fn a_torque_above_that_of_friction_starts_a_wheel_from_rest() {
    let moment = 0.2 * 0.025 * 12.0 * G;
    let found = run_of(&wheel(0.0, 0.7), &[]);
    let speed = (0.7 - moment) / 0.4 * 4.0;
    approx::assert_abs_diff_eq!(figure(&found, "m.final.speed"), speed, epsilon = 1e-9);
    let found = run_of(&wheel(0.0, 0.58), &[]);
    assert_eq!(figure(&found, "m.final.displacement"), 0.0);
    assert_eq!(figure(&found, "m.time_at_rest"), 4.0);
}

/// A block that a drive of constant speed pulls through a spring.
const PULLED: &str = r#""drive": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": 0.05 } },
    "spring": { "kind": "slider", "input": "drive", "position": { "ratio": 1 }, "inertia": 0.5,
        "stiffness": 800, "damping_capacity": 0, "masses": 1 },
    "m": { "kind": "linkage", "input": "spring", "driver": "guide", "joint_friction": true,
        "gravity": { "acceleration": 9.81 }, "ground": { "O": [0, 0] }, "links": { "block": { "mass": 3.5 } },
        "pairs": { "guide": { "friction": 0.3, "sliding": { "guide": "ground.O", "block": "block.origin",
            "corners": [0.05, -0.05] } } } }"#;

#[test]
fn a_block_pulled_through_a_spring_sticks_until_the_spring_overcomes_friction() {
    let (stiffness, speed, friction) = (800.0, 0.05, 0.3 * 3.5 * G);
    let sticks = friction / (stiffness * speed);
    let frequency = f64::sqrt(stiffness / 4.0);
    for part in [0.3, 0.75] {
        let after = part * std::f64::consts::TAU / frequency;
        let run = format!(
            r#""duration": {}, "tolerance": 1e-11, "start": {{ "spring": {{ "displacement": [0], "speed": [0] }} }}"#,
            sticks + after
        );
        let found = run_of(&scene_of(PULLED, &run), &[]);
        let way = speed * after - speed / frequency * (frequency * after).sin();
        let end = figure(&found, "m.final.displacement");
        approx::assert_abs_diff_eq!(end, way, epsilon = 1e-9);
        let faster = speed * (1.0 - (frequency * after).cos());
        approx::assert_abs_diff_eq!(figure(&found, "m.final.speed"), faster, epsilon = 1e-8);
        approx::assert_abs_diff_eq!(figure(&found, "m.time_at_rest"), sticks, epsilon = 1e-8);
        let loss = figure(&found, "m.friction_loss");
        approx::assert_abs_diff_eq!(loss, friction * way, epsilon = 1e-8);
    }
}

/// Without friction in any pair the switch changes nothing.
#[test]
fn no_coefficient_of_friction_is_no_friction() {
    let text = incline(20.0, 0.0, 2.0);
    let on = run_of(&text, &[]);
    let off = run_of(&text, &["m.joint_friction=false"]);
    assert_eq!(on.record.columns, off.record.columns);
    assert!(stopped(&on).is_none());
}
