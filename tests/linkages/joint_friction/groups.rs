//! Several linkages that move as one, and the derivatives of the equations of
//! motion.

use super::support::{figure, linkage_of, read, run_of, scene_of, stopped};
use dam::integrate::{Dynamics, Modes};
use dam::lower::lower;
use dam::system::System;

const G: f64 = 9.81;

fn wheel(name: &str, input: &str, ratio: f64, friction: f64) -> String {
    format!(
        r#""{name}": {{ "kind": "linkage", "input": "{input}", "driver": "O", "joint_friction": true,
        "position": {{ "ratio": {ratio} }}, "gravity": {{ "acceleration": {G} }}, "ground": {{ "O": [0, 0] }},
        "links": {{ "wheel": {{ "mass": 12, "moment": 0.3 }} }},
        "pairs": {{ "O": {{ "revolute": ["ground.O", "wheel.origin"], "diameter": "50 mm", "friction": {friction} }} }} }}"#
    )
}

/// Wheels geared to one motor: the moments of their pins add up over the ratios.
#[test]
fn two_wheels_on_one_motor_are_slowed_by_both_pins_and_stop_as_one() {
    let (ratio, speed) = (-1.5, 2.0);
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.1, "speed": {speed}, "torque": {{ "constant": 0.2 }} }} }}, {}, {}"#,
        wheel("a", "motor", 1.0, 0.2),
        wheel("b", "motor", ratio, 0.1)
    );
    let found = run_of(
        &scene_of(
            &objects,
            r#""duration": 4, "tolerance": 1e-10, "start": "on_law""#,
        ),
        &[],
    );
    let pin = |friction: f64| friction * 0.025 * 12.0 * G;
    let inertia = 0.1 + 0.3 + 0.3 * ratio * ratio;
    let slowing = (pin(0.2) + pin(0.1) * f64::abs(ratio) - 0.2) / inertia;
    let way = speed * speed / (2.0 * slowing);
    let near = |name: &str, wanted: f64| {
        approx::assert_abs_diff_eq!(figure(&found, name), wanted, epsilon = 1e-8);
    };
    near("a.final.displacement", way);
    near("b.final.displacement", ratio * way);
    for wheel in ["a", "b"] {
        near(&format!("{wheel}.time_at_rest"), 4.0 - speed / slowing);
        near(&format!("{wheel}.standstills"), 1.0);
    }
    near("a.friction_loss", pin(0.2) * way);
    near("b.friction_loss", pin(0.1) * way * f64::abs(ratio));
}

fn block(name: &str, input: &str, mass: f64, friction: f64) -> String {
    format!(
        r#""{name}": {{ "kind": "linkage", "input": "{input}", "driver": "guide", "joint_friction": true,
        "gravity": {{ "acceleration": {G} }}, "ground": {{ "O": [0, 0] }},
        "links": {{ "block": {{ "mass": {mass} }} }},
        "pairs": {{ "guide": {{ "friction": {friction}, "sliding": {{ "guide": "ground.O",
            "block": "block.origin", "corners": [0.05, -0.05] }} }} }},
        "outputs": {{ "way": {{ "point": "block.origin" }} }} }}"#
    )
}

/// A block that pushes another one: friction of the second is a load on an output of
/// the first.
#[test]
fn a_block_behind_the_output_of_a_block_is_slowed_with_it() {
    let objects = format!(
        r#""push": {{ "kind": "drive", "coordinate": "sliding", "motor": {{ "inertia": 1, "speed": 2, "force": {{ "constant": 3 }} }} }}, {}, {}"#,
        block("a", "push", 2.0, 0.2),
        block("b", "a.way", 3.0, 0.3)
    );
    let found = run_of(
        &scene_of(
            &objects,
            r#""duration": 2, "tolerance": 1e-10, "start": "on_law""#,
        ),
        &[],
    );
    let slowing = (0.2 * 2.0 * G + 0.3 * 3.0 * G - 3.0) / 6.0;
    let way = 2.0 * 2.0 / (2.0 * slowing);
    for (name, wanted) in [
        ("b.final.displacement", way),
        ("b.time_at_rest", 2.0 - 2.0 / slowing),
        ("a.friction_loss", 0.2 * 2.0 * G * way),
        ("b.friction_loss", 0.3 * 3.0 * G * way),
    ] {
        approx::assert_abs_diff_eq!(figure(&found, name), wanted, epsilon = 1e-8);
    }
}

/// Force of the drive at constant speed: that of friction, and nothing is lost from
/// the books.
#[test]
fn friction_behind_a_prescribed_drive_loads_the_drive_alone() {
    let objects = format!(
        r#""drive": {{ "kind": "drive", "motion": {{ "speed": "60 rpm" }} }}, {}"#,
        wheel("a", "drive", -1.0, 0.2)
    );
    let found = run_of(
        &scene_of(&objects, r#""duration": 2, "tolerance": 1e-8"#),
        &[],
    );
    let moment = 0.2 * 0.025 * 12.0 * G;
    let loss = moment * 2.0 * std::f64::consts::TAU;
    approx::assert_relative_eq!(
        figure(&found, "a.friction_loss"),
        loss,
        max_relative = 1e-12
    );
    approx::assert_relative_eq!(
        figure(&found, "drive.peak_reaction"),
        moment,
        max_relative = 1e-12
    );
    assert!(stopped(&found).is_none());
    assert_eq!(figure(&found, "a.standstills"), 0.0);
}

/// Everything that friction depends on: a slider-crank behind a gear, an elastic tool
/// and a rigid weight behind its slide, a second linkage beside it.
fn everything() -> String {
    let crank = r#""m": { "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
        "position": { "ratio": 0.5 }, "ground": { "O": [0, 0] }, "gravity": true,
        "links": {
            "crank": { "points": { "A": [0.06, 0] }, "mass": 0.8, "centre": [0.02, 0], "moment": 0.001 },
            "rod": { "points": { "B": [0.24, 0] }, "mass": 1.1, "centre": [0.1, 0], "moment": 0.006 },
            "slide": { "mass": 1.5 } },
        "pairs": {
            "O": { "revolute": ["ground.O", "crank.origin"], "diameter": 0.04, "friction": 0.1 },
            "A": { "revolute": ["crank.A", "rod.origin"], "diameter": 0.03, "friction": 0.1 },
            "B": { "revolute": ["rod.B", "slide.origin"], "diameter": 0.03, "friction": 0.1 },
            "guide": { "sliding": { "guide": "ground.O", "block": "slide.origin",
                "corners": [0.02, -0.03], "half_height": 0.01 }, "friction": 0.1 } },
        "assembly": { "slide": { "near": [0.3, 0] } },
        "forces": { "damper": { "strut": { "from": "ground.O", "to": "rod.B", "rate": 50, "free_length": 0.2, "damping": 20 } } },
        "outputs": { "slide": { "point": "slide.origin" }, "rod": { "angle": "rod" } } }"#;
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.03, "angle": 0.7, "speed": 6, "torque": {{ "constant": 2 }} }} }}, {crank},
        "weight": {{ "kind": "slider", "input": "m.slide", "position": {{ "ratio": 2 }}, "inertia": 0.4, "masses": 0, "loads": {{ "cut": {{ "constant": -7 }} }} }},
        "tool": {{ "kind": "slider", "input": "m.slide", "position": {{ "ratio": 1 }}, "inertia": 0.8, "stiffness": 40000, "damping_capacity": 0.3, "masses": 2 }},
        {}"#,
        wheel("w", "motor", 0.4, 0.15)
    );
    scene_of(
        &objects,
        r#""duration": 0.1, "tolerance": 1e-9, "start": "on_law""#,
    )
}

fn system_of(text: &str) -> System {
    let model = lower(&read(text, &[])).unwrap_or_else(|faults| panic!("{faults:?}"));
    System::new(model).unwrap_or_else(|faults| panic!("{faults:?}"))
}

#[test]
fn the_tangent_is_that_of_differences() {
    let system = system_of(&everything());
    let start = system.initial_state().expect("a start");
    let mut scratch = system.scratch();
    let size = start.y.len();
    let mut eval = |y: &[f64], modes: &Modes| {
        let mut dy = vec![0.0; size];
        system.derivatives(0.0, y, modes, &mut scratch, &mut dy);
        dy
    };
    let mut other = system.scratch();
    let mut y = start.y.clone();
    for (index, entry) in y.iter_mut().enumerate() {
        *entry += 1e-4 * (index as f64 + 1.0);
    }
    let centre = eval(&y, &start.modes);
    assert!(centre.iter().all(|entry| entry.is_finite()));
    let greatest = centre
        .iter()
        .fold(0.0f64, |most, entry| most.max(entry.abs()));
    for column in 0..size {
        let mut direction = vec![0.0; size];
        direction[column] = 1.0;
        let mut tangent = vec![0.0; size];
        system.tangent(0.0, &y, &start.modes, &direction, &mut other, &mut tangent);
        let step = 1e-6;
        let [mut above, mut below] = [y.clone(), y.clone()];
        above[column] += step;
        below[column] -= step;
        let (above, below) = (eval(&above, &start.modes), eval(&below, &start.modes));
        for row in 0..size {
            let wanted = (above[row] - below[row]) / (2.0 * step);
            let limit = 2e-6 * (wanted.abs() + tangent[row].abs()) + 1e-6 * greatest;
            let found = tangent[row];
            assert!(
                (found - wanted).abs() <= limit,
                "{row} {column}: {found} {wanted}"
            );
        }
    }
}

/// The acceleration that the equations give agrees with the friction that it causes:
/// the motor's torque, found from given motion, is the one that there is.
#[test]
fn the_acceleration_agrees_with_the_friction_that_it_causes() {
    let text = everything();
    let off = system_of(&text.replace(r#""joint_friction": true"#, r#""joint_friction": false"#));
    let on = system_of(&text);
    let [free, rubbing] = [&off, &on].map(|system| {
        let start = system.initial_state().expect("a start");
        let mut dy = vec![0.0; start.y.len()];
        system.derivatives(0.0, &start.y, &start.modes, &mut system.scratch(), &mut dy);
        let mut states = vec![Default::default(); system.model().objects.len()];
        system.observe(
            0.0,
            &start.y,
            &start.modes,
            &mut system.scratch(),
            &mut states,
        );
        let power = system.power(0.0, &start.y, &start.modes, &mut system.scratch());
        (start, dy, power)
    });
    assert!(rubbing.2.friction > 0.0 && free.2.friction == 0.0);
    // Friction slows the motor, and takes what it slows it by: the power that the
    // inertia of the group gives up is that of friction.
    let motor = on.last_coordinate(
        on.model()
            .objects
            .iter()
            .position(|o| o.id == "motor")
            .unwrap(),
    );
    let motor = motor.expect("a rotor");
    let count = free.0.y.len() / 2;
    let change = rubbing.1[count + motor] - free.1[count + motor];
    let (speed, inertia) = (free.0.y[count + motor], group_inertia(&on, &text));
    approx::assert_relative_eq!(
        -change * speed * inertia,
        rubbing.2.friction,
        max_relative = 1e-9
    );
}

/// Inertia of all that follows the motor rigidly, at the start, from the positions of
/// its parts.
fn group_inertia(system: &System, text: &str) -> f64 {
    let spec = linkage_of(&read(text, &[]), "m");
    let linkage = dam::linkage::Linkage::new(spec).expect("a linkage");
    let mut at = linkage.workspace();
    linkage.solve(0.35, 2, &mut at).expect("a position");
    let outputs = &linkage.spec().outputs;
    let slide = outputs.iter().position(|output| output.name == "slide");
    let slide = linkage.output(slide.expect("the slide"), &at).first;
    let crank = linkage.reduced_linkage(&at).inertia[0] + 0.4 * (2.0 * slide).powi(2);
    assert_eq!(system.model().linkages.len(), 2);
    0.03 + 0.25 * crank + 0.16 * 0.3
}
