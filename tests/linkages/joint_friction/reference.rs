//! The reference itself: against closed forms and against the library's
//! equations of motion at single positions.

use super::oracle::{Going, Signs, accelerations, decide, integrate};
use super::support::{linkage_of, read, scene_of};
use crate::multipliers::Mechanism;
use dam::linkage::Linkage;
use dam::linkage::kinetostatics::{Kinetostatics, Options, Outcome};

/// A slider-crank with pins and a guide that rub, its weight, and a spring.
pub(crate) fn slider_crank(friction: f64) -> String {
    format!(
        r#""m": {{ "kind": "linkage", "input": "motor", "driver": "O", "joint_friction": true,
        "ground": {{ "O": [0, 0] }},
        "links": {{
            "crank": {{ "points": {{ "A": [0.06, 0] }}, "mass": 0.8, "centre": [0.02, 0.005], "moment": 0.001 }},
            "rod": {{ "points": {{ "B": [0.24, 0] }}, "mass": 1.1, "centre": [0.1, 0.01], "moment": 0.006 }},
            "slide": {{ "mass": 1.5, "centre": [0.01, 0.004], "moment": 0.002 }} }},
        "pairs": {{
            "O": {{ "revolute": ["ground.O", "crank.origin"], "diameter": 0.04, "friction": {friction} }},
            "A": {{ "revolute": ["crank.A", "rod.origin"], "diameter": 0.03, "friction": {friction} }},
            "B": {{ "revolute": ["rod.B", "slide.origin"], "diameter": 0.03, "friction": {friction} }},
            "guide": {{ "sliding": {{ "guide": "ground.O", "block": "slide.origin", "direction": "5 deg",
                "corners": [0.02, -0.03], "half_height": 0.015 }}, "friction": {friction} }} }},
        "assembly": {{ "slide": {{ "near": [0.3, 0] }} }},
        "gravity": {{ "direction": "-80 deg" }},
        "forces": {{ "spring": {{ "strut": {{ "from": "ground.O", "to": "slide.origin", "rate": 300, "free_length": 0.22 }} }} }},
        "outputs": {{ "slide": {{ "point": "slide.origin" }}, "rod": {{ "angle": "rod" }} }} }}"#
    )
}

const MOTOR: &str = r#""motor": { "kind": "drive", "motor": { "inertia": 0.02, "speed": 3, "torque": { "constant": 1 } } }"#;

#[test]
fn accelerations_agree_with_the_free_body_equations_at_single_positions() {
    let text = scene_of(
        &format!("{MOTOR}, {}", slider_crank(0.12)),
        r#""duration": 0.1"#,
    );
    let spec = linkage_of(&read(&text, &[]), "m");
    let linkage = Linkage::new(spec.clone()).expect("a linkage");
    let solver = Kinetostatics::new(&spec).expect("numbers");
    let mut w = solver.workspace();
    let mut at = linkage.workspace();
    for (q, speed, torque) in [
        (0.4, 6.0, 2.0),
        (2.2, -4.0, 1.0),
        (3.9, 9.0, -3.0),
        (5.5, -7.0, 0.5),
    ] {
        linkage.solve(q, 3, &mut at).expect("within reach");
        let found = solver
            .accelerate(&at, q, speed, torque, &Options::default(), &mut w)
            .expect("a solution");
        let Outcome::Moves { acceleration } = found.outcome else {
            panic!("{found:?}");
        };
        let mechanism = Mechanism {
            spec: &spec,
            torque,
            rotor: 0.0,
        };
        let state = mechanism.start(&linkage, q, speed);
        let signs = Signs {
            pairs: (0..4)
                .map(|pair| (at.pair(pair).first * speed).signum())
                .collect(),
            corners: None,
        };
        let by_multipliers = accelerations(&mechanism, &state, &signs).expect("a solution");
        let miss = by_multipliers[2] - acceleration;
        assert!(miss.abs() < 1e-9 * acceleration.abs(), "at {q}: {miss:e}");
    }
}

/// A wheel on a pin: μ·(d/2)·m·g slows it down evenly, and it stays.
#[test]
fn a_wheel_stops_by_the_friction_of_its_pin() {
    let text = scene_of(
        r#""motor": { "kind": "drive", "motor": { "inertia": 0, "speed": 3, "torque": { "constant": 0 } } },
        "m": { "kind": "linkage", "input": "motor", "driver": "O", "gravity": { "acceleration": 9.81 },
            "links": { "wheel": { "mass": 12, "moment": 0.3 } },
            "ground": { "O": [0, 0] },
            "pairs": { "O": { "revolute": ["ground.O", "wheel.origin"], "diameter": 0.05, "friction": 0.2 } } }"#,
        r#""duration": 1"#,
    );
    let spec = linkage_of(&read(&text, &[]), "m");
    let linkage = Linkage::new(spec.clone()).expect("a linkage");
    let mechanism = Mechanism {
        spec: &spec,
        torque: 0.0,
        rotor: 0.0,
    };
    let course = integrate(&mechanism, &mechanism.start(&linkage, 0.0, 3.0), 4.0, 10);
    let slowing = 0.2 * 0.025 * 12.0 * 9.81 / 0.3;
    assert_eq!(course.stops.len(), 1);
    approx::assert_abs_diff_eq!(course.stops[0], 3.0 / slowing, epsilon = 1e-11);
    approx::assert_abs_diff_eq!(course.state.place[2], 4.5 / slowing, epsilon = 1e-11);
    approx::assert_abs_diff_eq!(course.loss, 0.5 * 0.3 * 9.0, epsilon = 1e-11);
    assert_eq!(decide(&mechanism, &course.state, &[1.0]), Going::Rests);
}

/// Without friction it is the integration without friction.
#[test]
fn without_friction_it_is_the_plain_integration() {
    let text = scene_of(
        &format!("{MOTOR}, {}", slider_crank(0.0)),
        r#""duration": 0.1"#,
    );
    let spec = linkage_of(&read(&text, &[]), "m");
    let linkage = Linkage::new(spec.clone()).expect("a linkage");
    let mechanism = Mechanism {
        spec: &spec,
        torque: 1.0,
        rotor: 0.02,
    };
    let start = mechanism.start(&linkage, 0.0, 3.0);
    let (one, two) = (
        integrate(&mechanism, &start, 0.3, 20).state,
        mechanism.integrate(&start, 0.3, 300),
    );
    for (one, two) in one.place.iter().zip(&two.place) {
        approx::assert_abs_diff_eq!(one, two, epsilon = 1e-9);
    }
}
