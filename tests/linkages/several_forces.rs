//! Forces of linkages of several inputs, as `dam forces` asks for them: an arm of two links
//! against its equations in closed form.

use dam::linkage::kinetostatics::Options;
use dam::lower::lower;
use dam::model::Model;
use dam::report::findings::Source;
use dam::report::forces::{ForcesReport, document, findings, rows};
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::forces::{ForceStudy, multi_input_forces};
use dam::studies::kinematics::{AskedSeveral, InputCourse, InputOver, Question, several_of};

// Lengths and centres (m), masses (kg), moments of inertia (kg·m²), gravity (m/s²).
const L1: f64 = 0.5;
const C1: f64 = 0.2;
const M1: f64 = 1.5;
const I1: f64 = 0.03;
const C2: f64 = 0.15;
const M2: f64 = 0.8;
const I2: f64 = 0.012;
const G: f64 = 9.80665;

fn arm(friction: &str) -> Model {
    model(&text(friction), !friction.is_empty())
}

fn text(friction: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "arm", "run": {{ "duration": 1 }}, "objects": {{ "arm": {{
            "kind": "linkage", "ground": {{ "O": [0, 0] }},
            "inputs": {{ "shoulder": {{ "pair": "O" }}, "elbow": {{ "pair": "E" }} }},
            "links": {{
                "upper": {{ "points": {{ "E": [{L1}, 0] }}, "mass": {M1}, "centre": [{C1}, 0], "moment": {I1} }},
                "fore": {{ "mass": {M2}, "centre": [{C2}, 0], "moment": {I2} }} }},
            "pairs": {{
                "O": {{ "revolute": ["ground.O", "upper.origin"]{friction} }},
                "E": {{ "revolute": ["upper.E", "fore.origin"]{friction} }} }},
            "gravity": true }} }} }}"#
    )
}

/// The model of a scene, of which a run leaves out the friction or not.
fn model(text: &str, friction: bool) -> Model {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    match document.scene(&BuiltIn, &Overrides::default()) {
        Ok(reading) => {
            // What a run leaves out is told.
            let told = reading
                .warnings
                .render(false)
                .contains("`dam forces` alone");
            assert_eq!(told, friction);
            lower(&reading.scene).expect("a model")
        }
        Err(faults) => panic!("{}", faults.render(false)),
    }
}

const SPEEDS: [f64; 2] = [1.3, -2.1];
const ACCELERATIONS: [f64; 2] = [-4.0, 7.0];

fn question() -> Question {
    let course = |name: &str, k: usize, over| InputCourse {
        name: name.to_owned(),
        over: Some(over),
        speed: Some(SPEEDS[k]),
        acceleration: Some(ACCELERATIONS[k]),
    };
    Question {
        inputs: vec![
            course("shoulder", 0, InputOver::At(0.4)),
            course(
                "elbow",
                1,
                InputOver::Range {
                    from: -2.0,
                    to: 2.0,
                },
            ),
        ],
        positions: 40,
        ..Question::default()
    }
}

fn studied(model: &Model, question: &Question) -> ForceStudy {
    let body = several_of(model, None).expect("a linkage of several inputs");
    let asked = AskedSeveral::new(model, body, question).expect("a question");
    multi_input_forces(&asked, Options::default()).expect("a study")
}

fn column(study: &ForceStudy, name: &str) -> Vec<f64> {
    let column = study
        .columns()
        .into_iter()
        .find(|column| column.name == name);
    let column = column.unwrap_or_else(|| panic!("no column {name}"));
    study
        .rows
        .iter()
        .map(|row| column.value(row).expect("a value"))
        .collect()
}

/// The forearm as a stub without mass and a hand welded to it, all of its mass in the hand: drives as
/// ever, and the weld carries what the hand asks for.
#[test]
fn a_weld_carries_the_hand() {
    const D: f64 = 0.1;
    let whole = studied(&arm(""), &question());
    let hand = format!(
        r#""fore": {{ "points": {{ "W": [{D}, 0] }} }},
           "hand": {{ "mass": {M2}, "centre": [0, {}], "moment": {I2} }} }},"#,
        C2 - D
    );
    let weld = r#""pairs": { "W": { "weld": { "on": "fore.W", "link": "hand.origin", "angle": "-90 deg" } },"#;
    let text = text("");
    let (head, rest) = text.split_once("\"fore\"").expect("a forearm");
    let (_, tail) = rest.split_once("\"pairs\": {").expect("pairs");
    let study = studied(
        &model(&format!("{head}{hand}{weld}{tail}"), false),
        &question(),
    );
    for name in ["drive.shoulder", "drive.elbow", "E.x", "E.y", "O.force"] {
        let (one, other) = (column(&whole, name), column(&study, name));
        for (one, other) in one.iter().zip(&other) {
            approx::assert_abs_diff_eq!(one, other, epsilon = 1e-11);
        }
    }
    let elbow = column(&study, "elbow.displacement");
    let found = ["W.x", "W.y", "W.couple", "E.x", "E.y"].map(|name| column(&study, name));
    let a = ACCELERATIONS[0] + ACCELERATIONS[1];
    for (row, q2) in elbow.iter().enumerate() {
        // The stub hands on the pin's force; the hand turns about its centre of mass.
        let (x, y) = (found[3][row], found[4][row]);
        approx::assert_abs_diff_eq!(found[0][row], x, epsilon = 1e-11);
        approx::assert_abs_diff_eq!(found[1][row], y, epsilon = 1e-11);
        let (sin, cos) = (0.4 + q2).sin_cos();
        let couple = I2 * a + (C2 - D) * (cos * y - sin * x);
        approx::assert_abs_diff_eq!(found[2][row], couple, epsilon = 1e-11);
    }
}

#[test]
fn driving_moments_of_an_arm_are_those_of_its_equations() {
    let study = studied(&arm(""), &question());
    let elbow = column(&study, "elbow.displacement");
    assert_eq!(elbow.len(), 41);
    let found = ["drive.shoulder", "drive.elbow", "E.x", "E.y"].map(|name| column(&study, name));
    let (q1, [v1, v2], [a1, a2]) = (0.4f64, SPEEDS, ACCELERATIONS);
    for (row, &q2) in elbow.iter().enumerate() {
        // Source: R. M. Murray, Z. Li, S. S. Sastry, A Mathematical Introduction to Robotic
        // Manipulation, CRC Press, 1994, example 4.3.
        let cross = M2 * L1 * C2;
        let m11 = I1 + I2 + M1 * C1 * C1 + M2 * (L1 * L1 + C2 * C2) + 2.0 * cross * q2.cos();
        let m22 = I2 + M2 * C2 * C2;
        let m12 = m22 + cross * q2.cos();
        let h = -cross * q2.sin();
        let fore = M2 * C2 * G * (q1 + q2).cos();
        let one = m11 * a1
            + m12 * a2
            + h * (2.0 * v1 * v2 + v2 * v2)
            + (M1 * C1 + M2 * L1) * G * q1.cos()
            + fore;
        let two = m12 * a1 + m22 * a2 - h * v1 * v1 + fore;
        approx::assert_abs_diff_eq!(found[0][row], one, epsilon = 1e-11);
        approx::assert_abs_diff_eq!(found[1][row], two, epsilon = 1e-11);
        // What the forearm's centre is accelerated by.
        let (turned, w, a) = (q1 + q2, v1 + v2, a1 + a2);
        let x = -L1 * (a1 * q1.sin() + v1 * v1 * q1.cos())
            - C2 * (a * turned.sin() + w * w * turned.cos());
        let y = L1 * (a1 * q1.cos() - v1 * v1 * q1.sin())
            + C2 * (a * turned.cos() - w * w * turned.sin());
        approx::assert_abs_diff_eq!(found[2][row], M2 * x, epsilon = 1e-11);
        approx::assert_abs_diff_eq!(found[3][row], M2 * (y + G), epsilon = 1e-11);
    }
    // The speeds are not those of the way: there is no work on it.
    assert!(study.cycle.is_none() && study.warnings().is_empty());
}

#[test]
fn friction_in_pins_adds_its_couples_to_the_driving_moments() {
    let without = studied(&arm(""), &question());
    let with = studied(&arm(r#", "friction": 0.2, "diameter": 0.05"#), &question());
    let both = |name: &str| [column(&without, name), column(&with, name)];
    let [[s0, s1], [e0, e1]] = [both("drive.shoulder"), both("drive.elbow")];
    let [shoulder, elbow] = ["O.force", "E.force"].map(|name| column(&without, name));
    for row in 0..s0.len() {
        // In an open chain friction changes no reaction: μ·(d/2)·R against the sliding.
        approx::assert_abs_diff_eq!(s1[row] - s0[row], 0.005 * shoulder[row], epsilon = 1e-12);
        approx::assert_abs_diff_eq!(e1[row] - e0[row], -0.005 * elbow[row], epsilon = 1e-12);
    }
    assert!(with.worst_balance() < 1e-12);
    let (drive, loss) = (column(&with, "power.drive"), column(&with, "power.loss"));
    let powers = ["power.shoulder", "power.elbow"].map(|name| column(&with, name));
    for row in 0..drive.len() {
        assert!(loss[row] > 0.0);
        approx::assert_abs_diff_eq!(drive[row], powers[0][row] + powers[1][row], epsilon = 1e-12);
    }
}

/// Along a way the work of the drivers lifts and accelerates: between two positions at the
/// same speeds the difference of the energies.
#[test]
fn work_along_a_way_is_the_difference_of_the_energies() {
    let range = |name: &str, from: f64, to: f64| InputCourse {
        name: name.to_owned(),
        over: Some(InputOver::Range { from, to }),
        speed: None,
        acceleration: None,
    };
    let way = Question {
        inputs: vec![range("shoulder", 0.1, 1.2), range("elbow", -0.5, 0.7)],
        positions: 30,
        ..Question::default()
    };
    let study = studied(&arm(""), &way);
    let energy = |q1: f64, q2: f64, [v1, v2]: [f64; 2]| {
        let m22 = I2 + M2 * C2 * C2;
        let cross = M2 * L1 * C2 * q2.cos();
        let m11 = I1 + M1 * C1 * C1 + m22 + M2 * L1 * L1 + 2.0 * cross;
        0.5 * (m11 * v1 * v1 + m22 * v2 * v2)
            + (m22 + cross) * v1 * v2
            + G * ((M1 * C1 + M2 * L1) * q1.sin() + M2 * C2 * (q1 + q2).sin())
    };
    let row = study.rows[0].forces.as_ref().expect("forces");
    // Inputs stand in the order of their names.
    let speeds = [1, 0].map(|k| row.inputs[k].speed);
    approx::assert_relative_eq!(speeds[0] / speeds[1], 1.1 / 1.2, max_relative = 1e-12);
    let wanted = energy(1.2, 0.7, speeds) - energy(0.1, -0.5, speeds);
    let work = study.cycle.as_ref().expect("a course").drive_work;
    approx::assert_relative_eq!(work, wanted, max_relative = 1e-11);
    let report = ForcesReport {
        study: &study,
        warnings: &[],
        massless: None,
        object: "arm",
        motion: "",
        name: "arm",
        hash: "",
    };
    let told = document(&report);
    assert_eq!(told["columns"]["drive.elbow"]["unit"], "N m");
    assert!(rows(&study).csv().starts_with("path,"));
    let text = findings(&report, Source::scene("", "")).text(Some(120));
    assert!(
        text.contains("at elbow from") && text.contains("work of the drivers"),
        "{text}"
    );
    assert_eq!(study.figure("cycle.drive_work"), Some(work));
    assert_eq!(study.figure("cycle.mean_drive"), None);
    assert!(study.figure("drive.shoulder.greatest").is_some());
}
