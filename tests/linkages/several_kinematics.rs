//! Kinematics of linkages of several inputs, as `dam kinematics` asks for it.

use dam::lower::lower;
use dam::model::Model;
use dam::report::kinematics::{document, findings, rows};
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::kinematics::{InputCourse, InputOver, Kinematics, Over, Question, kinematics_of};
use std::f64::consts::{PI, TAU};

/// Cranks of 0.3 and 0.25 m, 0.8 m apart, and rods of 0.7 and 0.6 m.
const FIVE_BAR: &str = r#"{ "dam": 1, "name": "five-bar", "run": { "duration": 0.5 }, "objects": {
    "one": { "kind": "drive", "motion": { "speed": "2 rad/s", "angle": "0.4 rad" } },
    "other": { "kind": "drive", "motion": { "speed": "-1 rad/s" } },
    "bar": { "kind": "linkage", "ground": { "O": [0, 0], "P": [0.8, 0] },
        "inputs": { "left": { "pair": "O"LEFT }, "right": { "pair": "P"RIGHT } },
        "links": {
            "crank": { "points": { "A": [0.3, 0] } }, "rod": { "points": { "C": [0.7, 0] } },
            "coupler": { "points": { "C": [0.6, 0] } }, "servo": { "points": { "B": [0.25, 0] } } },
        "pairs": {
            "O": { "revolute": ["ground.O", "crank.origin"] },
            "A": { "revolute": ["crank.A", "rod.origin"] },
            "C": { "revolute": ["rod.C", "coupler.C"] },
            "B": { "revolute": ["servo.B", "coupler.origin"] },
            "P": { "revolute": ["ground.P", "servo.origin"] } },
        "outputs": { "x": { "point": "rod.C" }, "pin": { "pair": "C" } } } } }"#;

fn model(left: &str, right: &str) -> Model {
    let text = FIVE_BAR.replace("LEFT", left).replace("RIGHT", right);
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let reading = document.scene(&BuiltIn, &Overrides::default());
    lower(&reading.expect("a scene").scene).expect("a model")
}

fn free() -> Model {
    model(r#", "start": "1.1 rad""#, r#", "start": "0.6 rad""#)
}

fn course(name: &str, over: Option<InputOver>, speed: Option<f64>) -> InputCourse {
    InputCourse {
        name: name.to_owned(),
        over,
        speed,
        acceleration: None,
    }
}

fn question(inputs: Vec<InputCourse>) -> Question {
    Question {
        inputs,
        duration: 0.5,
        ..Question::default()
    }
}

/// C of the five-bar as the crossing of two circles, on the branch + of coupler and rod.
fn crossing(one: f64, two: f64) -> [f64; 2] {
    let a = [0.3 * one.cos(), 0.3 * one.sin()];
    let b = [0.8 + 0.25 * two.cos(), 0.25 * two.sin()];
    let apart = [a[0] - b[0], a[1] - b[1]];
    let length = apart[0].hypot(apart[1]);
    let along = (length * length + 0.36 - 0.49) / (2.0 * length);
    let aside = (0.36 - along * along).sqrt();
    let [ux, uy] = apart.map(|part| part / length);
    [
        b[0] + along * ux - aside * uy,
        b[1] + along * uy + aside * ux,
    ]
}

fn values<'k>(found: &'k Kinematics, name: &str) -> &'k [f64] {
    let mut columns = found.columns.iter();
    let column = columns.find(|column| column.name() == name);
    &column.unwrap_or_else(|| panic!("no column {name}")).values
}

#[test]
fn places_are_those_of_two_circles_and_the_jacobian_their_differences() {
    let inputs = vec![
        course(
            "left",
            Some(InputOver::Range { from: 0.2, to: 1.4 }),
            Some(3.0),
        ),
        course("right", Some(InputOver::At(0.5)), None),
    ];
    let found = kinematics_of(&free(), &question(inputs)).unwrap();
    assert!(found.stopped.is_none() && !found.closed && found.warnings.is_empty());
    assert_eq!(found.axis.values.len(), 361);
    let h = 1e-6;
    for (row, &one) in found.axis.values.iter().enumerate().step_by(30) {
        let [x, y] = crossing(one, 0.5);
        approx::assert_abs_diff_eq!(values(&found, "links.rod.C.x")[row], x, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(values(&found, "links.rod.C.y")[row], y, epsilon = 1e-13);
        let by_left =
            [0, 1].map(|k| (crossing(one + h, 0.5)[k] - crossing(one - h, 0.5)[k]) / (2.0 * h));
        let by_right = (crossing(one, 0.5 + h)[0] - crossing(one, 0.5 - h)[0]) / (2.0 * h);
        let left = values(&found, "x.first_transfer.left")[row];
        approx::assert_relative_eq!(left, by_left[0], max_relative = 1e-8);
        let right = values(&found, "x.first_transfer.right")[row];
        approx::assert_relative_eq!(right, by_right, max_relative = 1e-8);
        let speed = values(&found, "x.speed")[row];
        approx::assert_relative_eq!(speed, 3.0 * left, max_relative = 1e-12);
        let bend = 1e-4;
        let second =
            (crossing(one + bend, 0.5)[0] - 2.0 * x + crossing(one - bend, 0.5)[0]) / (bend * bend);
        let acceleration = values(&found, "x.acceleration")[row];
        approx::assert_relative_eq!(acceleration, 9.0 * second, max_relative = 1e-5);
    }
}

#[test]
fn a_way_of_two_inputs_is_straight_and_time_follows_the_drives() {
    let inputs = vec![
        course("left", Some(InputOver::Range { from: 0.0, to: 1.0 }), None),
        course(
            "right",
            Some(InputOver::Range {
                from: 0.5,
                to: -0.5,
            }),
            None,
        ),
    ];
    let found = kinematics_of(&free(), &question(inputs)).unwrap();
    assert_eq!((found.axis.name, found.axis.unit), ("path", ""));
    let half = found.axis.values.len() / 2;
    approx::assert_abs_diff_eq!(
        values(&found, "left.displacement")[half],
        0.5,
        epsilon = 1e-15
    );
    approx::assert_abs_diff_eq!(
        values(&found, "right.displacement")[half],
        0.0,
        epsilon = 1e-15
    );
    // The first input that moves has speed 1, the other follows the way.
    assert_eq!(values(&found, "right.speed")[half], -1.0);

    let driven = model(r#", "object": "one""#, r#", "object": "other""#);
    let found = kinematics_of(&driven, &question(Vec::new())).unwrap();
    assert_eq!((found.axis.name, found.axis.unit), ("time", "s"));
    for (row, &time) in found.axis.values.iter().enumerate() {
        let [x, _] = crossing(0.4 + 2.0 * time, -time);
        approx::assert_abs_diff_eq!(values(&found, "x.displacement")[row], x, epsilon = 1e-13);
    }
}

/// How far the left crank goes follows from the greatest distance of the outer pins.
#[test]
fn an_input_goes_as_far_as_the_rods_reach() {
    let inputs = vec![course("left", Some(InputOver::Free), None)];
    let found = kinematics_of(&free(), &question(inputs)).unwrap();
    let apart = |one: f64| {
        let x = 0.8 + 0.25 * 0.6f64.cos() - 0.3 * one.cos();
        x.hypot(0.25 * 0.6f64.sin() - 0.3 * one.sin())
    };
    assert_eq!(found.limits.len(), 2);
    for limit in &found.limits {
        approx::assert_abs_diff_eq!(apart(limit.at), 1.3, epsilon = 1e-12);
        assert!(limit.cause.contains("dyad RRR"), "{}", limit.cause);
    }
    let beyond = vec![course(
        "left",
        Some(InputOver::Range { from: 1.0, to: PI }),
        None,
    )];
    let found = kinematics_of(&free(), &question(beyond)).unwrap();
    let stopped = found.stopped.expect("it stops");
    approx::assert_abs_diff_eq!(apart(stopped.at), 1.3, epsilon = 1e-12);
}

#[test]
fn singular_curves_stand_in_the_document_and_satisfy_the_determinant() {
    let inputs = vec![course(
        "left",
        Some(InputOver::Range { from: 0.0, to: 1.0 }),
        None,
    )];
    let found = kinematics_of(&free(), &question(inputs)).unwrap();
    let told = document("five-bar", "", &found);
    let curves = told["singular_positions"]["curves"]
        .as_array()
        .expect("curves");
    let mut points = 0;
    for curve in curves {
        for point in curve["points"].as_array().expect("points") {
            let [one, two] = [0, 1].map(|k| point[k].as_f64().expect("a number"));
            let x = 0.8 + 0.25 * two.cos() - 0.3 * one.cos();
            let square = x * x + (0.25 * two.sin() - 0.3 * one.sin()).powi(2);
            let cos = (0.49 + 0.36 - square) / (2.0 * 0.7 * 0.6);
            // sin² of the angle between both rods: the determinant of the loop, squared.
            approx::assert_abs_diff_eq!(1.0 - cos * cos, 0.0, epsilon = 1e-9);
            points += 1;
        }
    }
    assert!(points > 100, "{points}");
    let source = dam::report::findings::Source::scene("", "");
    let text = findings("five-bar", &found, source).text(Some(120));
    assert!(text.contains("Singular positions"), "{text}");
    assert!(
        rows(&found)
            .csv()
            .starts_with("input coordinate [rad],left.displacement [rad]")
    );
}

#[test]
fn the_grid_has_every_position_that_can_be_assembled() {
    let found = kinematics_of(&free(), &question(Vec::new())).unwrap();
    let grid = found.grid.expect("a grid");
    let [left, right] = [0, 1].map(|k| &grid.axes[k].2);
    assert_eq!(grid.frames.len(), left.len() * right.len());
    for (row, frame) in grid.frames.iter().enumerate() {
        let (one, two) = (left[row % left.len()], right[row / left.len()]);
        let [x, y] = crossing(one, two);
        let rod = frame[2];
        assert_eq!(x.is_nan(), rod[0].is_nan(), "{one} {two}");
        if !x.is_nan() {
            approx::assert_abs_diff_eq!(rod[0] + 0.7 * rod[2], x, epsilon = 1e-9);
            approx::assert_abs_diff_eq!(rod[1] + 0.7 * rod[3], y, epsilon = 1e-9);
        }
    }
    assert!((left[left.len() - 1] - left[0] - TAU).abs() < 1e-9 || !found.closed);
}

#[test]
fn what_cannot_be_answered_is_said() {
    let model = free();
    let refused = |question: Question| kinematics_of(&model, &question).unwrap_err();
    let range = Some(InputOver::Range { from: 0.0, to: 1.0 });
    let cases = [
        (
            question(vec![course("none", range, None)]),
            "one of left, right",
        ),
        (
            question(vec![
                course("left", range, None),
                course("left", None, None),
            ]),
            "named twice",
        ),
        (
            question(vec![
                course("left", range, None),
                course("right", Some(InputOver::Free), None),
            ]),
            "each needs a range",
        ),
        (
            question(vec![course("left", Some(InputOver::At(PI)), None)]),
            "cannot be assembled",
        ),
        (
            Question {
                speed: Some(1.0),
                ..Question::default()
            },
            "name the input of this speed",
        ),
        (
            Question {
                over: Some(Over::Time { to: 1.0 }),
                ..Question::default()
            },
            "dam run",
        ),
    ];
    for (question, part) in cases {
        let words = refused(question);
        assert!(words.contains(part), "{words}");
    }
}
