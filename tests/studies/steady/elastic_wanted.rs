//! Machines with a motor and elastic objects of which a mean speed or a fluctuation is asked.

use super::scenes::{faults, of_text};
use dam::scene::SteadySpec;
use dam::steady::Mean;
use dam::studies::steady::{Answer, DriveFigures, steady_motion};

fn drive(text: &str, ask: impl Fn(&mut SteadySpec)) -> DriveFigures {
    let (system, settings, mut spec) = of_text(text, &[]);
    ask(&mut spec);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Periodic(answer) => answer.drive.unwrap(),
        Answer::Rigid(_) => panic!("it is elastic"),
    }
}

/// A motor with a straight characteristic, a lever with drag behind a shaft.
fn machine(inertia: f64, [stall, no_load]: [f64; 2], shaft: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "lever", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": {inertia}, "speed": 60,
                "torque": {{ "linear": {{ "stall_torque": {stall}, "no_load_speed": {no_load} }} }} }} }},
            "cam": {{ "kind": "shaft", "input": "motor", "position": {{ "ratio": 0.5 }},
                "inertia": 0.01, {shaft} }},
            "lever": {{ "kind": "rocker", "input": "cam", "masses": 0, "inertia": 0.3,
                "position": {{ "sine": {{ "amplitude": "20 deg" }} }},
                "loads": {{ "drag": {{ "viscous": 2 }} }} }} }},
            "run": {{ "duration": 1 }} }}"#
    )
}

const ELASTIC: &str = r#""stiffness": 4000, "damping": 2"#;

#[test]
fn a_moment_holds_the_mean_speed_of_a_linear_machine_as_its_closed_form_says() {
    let fan = r#"{ "dam": 1, "name": "fan", "objects": {
        "motor": { "kind": "drive", "motor": { "inertia": 0.02, "speed": 10,
            "torque": { "linear": { "stall_torque": 60, "no_load_speed": 100 } } } },
        "fan": { "kind": "shaft", "input": "motor", "position": { "ratio": 0.6 },
            "inertia": 0.05, "stiffness": 800, "damping": 0.4,
            "loads": { "air": { "viscous": 0.9 } } } },
        "run": { "duration": 1 } }"#;
    for speed in [20.0, 150.0] {
        let figures = drive(fan, |spec| {
            (spec.mean_speed, spec.balance) = (Some(speed), true);
        });
        approx::assert_relative_eq!(figures.means.time, speed, max_relative = 1e-9);
        // 60 − 0.6·ω + M = 0.6²·0.9·ω.
        let moment = speed * (0.6 + 0.36 * 0.9) - 60.0;
        approx::assert_relative_eq!(figures.balance.unwrap(), moment, max_relative = 1e-8);
    }
}

#[test]
fn the_moment_that_holds_a_mean_speed_is_that_of_the_stronger_motor_which_has_it() {
    let text = machine(0.05, [60.0, 100.0], ELASTIC);
    for mean in Mean::ALL {
        let held = drive(&text, |spec| {
            (spec.mean_speed, spec.balance, spec.mean) = (Some(75.0), true, mean);
        });
        let moment = held.balance.unwrap();
        // 60·(1 − ω/100) + M is the characteristic of another motor.
        let stall = 60.0 + moment;
        let stronger = machine(0.05, [stall, stall / 0.6], ELASTIC);
        let own = drive(&stronger, |_| {});
        let found = match mean {
            Mean::Time => own.means.time,
            Mean::Angle => own.means.angle,
            Mean::Midrange => own.means.midrange,
        };
        approx::assert_relative_eq!(found, 75.0, max_relative = 1e-8);
        approx::assert_relative_eq!(own.fluctuation, held.fluctuation, max_relative = 1e-6);
        assert!(own.balance.is_none() && own.flywheel.is_none());
    }
}

#[test]
fn a_flywheel_has_the_fluctuation_asked_for_and_is_in_the_stiff_limit_the_rigid_one() {
    let own = drive(&machine(0.05, [60.0, 100.0], ELASTIC), |_| {}).fluctuation;
    let wanted = 0.4 * own;
    let sized = drive(&machine(0.05, [60.0, 100.0], ELASTIC), |spec| {
        spec.fluctuation = Some(wanted);
    });
    let wheel = sized.flywheel.as_ref().unwrap();
    approx::assert_relative_eq!(wheel.fluctuation_without.unwrap(), own, max_relative = 1e-7);
    approx::assert_relative_eq!(sized.fluctuation, wanted, max_relative = 1e-7);
    // The same machine with that rotor.
    let with = drive(
        &machine(0.05 + wheel.inertia, [60.0, 100.0], ELASTIC),
        |_| {},
    );
    approx::assert_relative_eq!(with.fluctuation, wanted, max_relative = 1e-7);
    // None is needed for more than there is.
    let none = drive(&machine(0.05, [60.0, 100.0], ELASTIC), |spec| {
        spec.fluctuation = Some(2.0 * own);
    });
    assert_eq!(none.flywheel.unwrap().inertia, 0.0);
    let rigid = machine(0.05, [60.0, 100.0], r#""masses": 0"#);
    let (system, settings, mut spec) = of_text(&rigid, &[]);
    spec.fluctuation = Some(wanted);
    let Answer::Rigid(rigid) = steady_motion(&system, &settings, &spec).unwrap() else {
        panic!("it is rigid");
    };
    let rigid = rigid.flywheel.unwrap().inertia;
    // What is left is proportional to the give.
    let off = [4e4, 8e4].map(|stiffness| {
        let shaft = format!(r#""stiffness": {stiffness}, "damping": 20"#);
        let sized = drive(&machine(0.05, [60.0, 100.0], &shaft), |spec| {
            spec.fluctuation = Some(wanted);
        });
        sized.flywheel.unwrap().inertia / rigid - 1.0
    });
    println!("off the rigid flywheel: {off:?}");
    assert!(
        off[1].abs() < 5e-3 && off[1].abs() < 0.7 * off[0].abs(),
        "{off:?}"
    );
}

#[test]
fn mean_speed_and_fluctuation_are_had_together() {
    let text = machine(0.05, [60.0, 100.0], ELASTIC);
    let own = drive(&text, |_| {}).fluctuation;
    let both = drive(&text, |spec| {
        (spec.mean_speed, spec.balance) = (Some(70.0), true);
        spec.fluctuation = Some(0.5 * own);
    });
    approx::assert_relative_eq!(both.means.time, 70.0, max_relative = 1e-8);
    approx::assert_relative_eq!(both.fluctuation, 0.5 * own, max_relative = 1e-7);
    let stall = 60.0 + both.balance.unwrap();
    let inertia = 0.05 + both.flywheel.unwrap().inertia;
    let same = drive(&machine(inertia, [stall, stall / 0.6], ELASTIC), |_| {});
    approx::assert_relative_eq!(same.means.time, 70.0, max_relative = 1e-8);
    approx::assert_relative_eq!(same.fluctuation, 0.5 * own, max_relative = 1e-6);
}

#[test]
fn half_a_question_is_refused_with_what_is_missing() {
    let text = machine(0.05, [60.0, 100.0], ELASTIC);
    let found = faults(&text, |spec| spec.mean_speed = Some(70.0));
    assert_eq!(found[0].path, "steady.mean_speed");
    assert!(found[0].hint.contains("`balance`"), "{found:?}");
    let found = faults(&text, |spec| spec.balance = true);
    assert_eq!(found[0].path, "steady.balance");
    assert!(found[0].hint.contains("mean_speed"), "{found:?}");
}
