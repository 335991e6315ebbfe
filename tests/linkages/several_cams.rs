//! Cams behind several inputs in runs and studies: energies, an eccentric circle as a rod, singular
//! positions in closed form, what is told.

use super::several::{balanced, figure, first_zero, physical, read, result, sound};
use dam::linkage::kinetostatics::Options;
use dam::lower::lower;
use dam::model::Model;
use dam::report::kinematics::document;
use dam::studies::forces::{ZoneKind, multi_input_forces};
use dam::studies::judgement::Judgement;
use dam::studies::kinematics::{
    AskedSeveral, InputCourse, InputOver, Question, kinematics_of, several_of,
};

/// A cam on a crank, and a lever with its roller on the crank of the other input.
const TWO_CRANKS: &str = r#""bar": { "kind": "linkage", "ground": { "O": [0, 0], "P": [0.8, 0.1] },
    "inputs": { "left": { "pair": "O"LEFT }, "right": { "pair": "P"RIGHT } },
    "links": { ROD
        "crank": { "points": { "C": [0.2, 0.03] }, "mass": 1.1, "centre": [0.1, 0.02], "moment": 0.02 },
        "servo": { "points": { "B": [0.15, 0] }, "geometry": { "mass": 1.3 } },
        "lever": { "points": { "R": [0.7, 0] }, "geometry": { "mass": 0.9 } } },
    "pairs": { PINS
        "O": { "revolute": ["ground.O", "crank.origin"] }, "P": { "revolute": ["ground.P", "servo.origin"] },
        "B": { "revolute": ["servo.B", "lever.origin"] } },
    CAM
    "assembly": { "lever": { "angle": 2.8 } },
    "forces": { "spring": { "strut": { "from": "ground.O", "to": "lever.R", "rate": 150, "free_length": 0.4, "damping": 3 } } },
    "gravity": true, "outputs": { "x": { "point": "lever.R" }, "pin": { "pair": "B" } } }"#;

/// An eccentric circle, its pitch circle of 0.3 m.
const CIRCLE: &str = r#""couplings": { "K": { "cam": { "centre": "crank.C", "roller": "lever.R",
    "base_radius": 0.27, "roller_radius": 0.03 } } },"#;
/// Three lobes.
const LOBES: &str = r#""couplings": { "K": { "cam": { "centre": "crank.C", "roller": "lever.R",
    "base_radius": 0.27, "roller_radius": 0.03, "lift": { "sine": { "amplitude": 0.008, "harmonic": 3 } } } } },"#;

fn two_cranks(cam: &str, drives: &str, [left, right]: [&str; 2], duration: f64) -> String {
    let [rod, pins] = match cam {
        "" => [
            r#""rod": { "points": { "R": [0.3, 0] } },"#,
            r#""C": { "revolute": ["crank.C", "rod.origin"] }, "R": { "revolute": ["rod.R", "lever.R"] },"#,
        ],
        _ => ["", ""],
    };
    let parts = [
        ("LEFT", left),
        ("RIGHT", right),
        ("ROD", rod),
        ("PINS", pins),
        ("CAM", cam),
    ];
    let bar = parts
        .iter()
        .fold(TWO_CRANKS.to_owned(), |text, (name, part)| {
            text.replace(name, part)
        });
    format!(
        r#"{{ "dam": 1, "name": "two cranks", "objects": {{ {drives} {bar} }},
            "run": {{ "duration": {duration}, "tolerance": 1e-11, "start": "on_law" }} }}"#
    )
}

#[test]
fn cams_keep_the_balance_of_the_energies_whatever_drives_them() {
    let lobes =
        |drives: &str, links: [&str; 2], duration: f64| two_cranks(LOBES, drives, links, duration);
    let addresses = ["bar.left", "bar.right", "bar.x", "bar.pin"];
    balanced(&lobes, &addresses);
}

/// A motor at one crank, the other one free.
#[test]
fn an_eccentric_circle_runs_as_the_rod_that_it_is() {
    let drives = r#""motor": { "kind": "drive", "motor": { "inertia": 0.05, "angle": 1.1, "speed": 2, "torque": { "constant": 2 } } },"#;
    let links = [r#", "object": "motor""#, r#", "start": 0.6"#];
    let [cam, rod] = [CIRCLE, ""].map(|cam| result(&two_cranks(cam, drives, links, 0.14), &[]));
    sound("cam", &cam);
    for address in ["bar.left", "bar.right", "bar.x", "bar.pin"] {
        for kind in ["displacement", "speed"] {
            let address = format!("{address}.final.{kind}");
            let [one, other] = [&cam, &rod].map(|run| figure(run, &address));
            approx::assert_relative_eq!(one, other, max_relative = 1e-8, epsilon = 1e-9);
        }
    }
}

/// Distance of the lever's pin from the centre of the circle.
fn apart(one: f64, two: f64) -> f64 {
    let centre = [
        0.2 * one.cos() - 0.03 * one.sin(),
        0.2 * one.sin() + 0.03 * one.cos(),
    ];
    let x = 0.8 + 0.15 * two.cos() - centre[0];
    x.hypot(0.1 + 0.15 * two.sin() - centre[1])
}

#[test]
fn a_run_ends_where_the_lever_points_along_the_normal() {
    let drives = r#""one": { "kind": "drive", "motion": { "speed": "1 rev/s", "angle": 1 } },
        "two": { "kind": "drive", "motion": { "speed": "-0.4 rev/s", "angle": 2.1 } },"#;
    let links = [r#", "object": "one""#, r#", "object": "two""#];
    let found = result(&two_cranks(CIRCLE, drives, links, 4.0), &[]);
    assert!(physical(&found));
    let turn = std::f64::consts::TAU;
    let missing = |t: f64| apart(1.0 + turn * t, 2.1 - 0.4 * turn * t) - 1.0;
    let time = first_zero(missing);
    approx::assert_abs_diff_eq!(found.outcome.time, time, epsilon = 1e-9);
}

fn free(cam: &str) -> Model {
    let links = [r#", "start": "1.1 rad""#, r#", "start": "0.6 rad""#];
    lower(&read(&two_cranks(cam, "", links, 0.5), &[])).expect("a model")
}

fn question(from: f64, to: f64) -> Question {
    let course = |name: &str, over| InputCourse {
        name: name.to_owned(),
        over: Some(over),
        speed: Some(3.0),
        acceleration: None,
    };
    Question {
        inputs: vec![
            course("left", InputOver::Range { from, to }),
            course("right", InputOver::At(0.6)),
        ],
        positions: 40,
        ..Question::default()
    }
}

/// Where lever and normal lie in one line the pitch circle is as far away as both are long.
#[test]
fn singular_curves_of_a_circle_are_those_of_a_rod() {
    let found = kinematics_of(&free(CIRCLE), &question(0.9, 1.3)).expect("kinematics");
    let told = document("two cranks", "", &found);
    let curves = told["singular_positions"]["curves"]
        .as_array()
        .expect("curves");
    let mut points = 0;
    for curve in curves {
        for point in curve["points"].as_array().expect("points") {
            let [one, two] = [0, 1].map(|k| point[k].as_f64().expect("a number"));
            approx::assert_abs_diff_eq!(apart(one, two), 1.0, epsilon = 1e-9);
            points += 1;
        }
    }
    assert!(points > 50, "{points}");
    // None is missing: one curve about what cannot be assembled, and the same a turn further.
    let ends = curves.len();
    assert!(ends <= 4, "{ends}");
}

/// A range that was asked for, and a single position, end the reach as the whole of it does.
#[test]
fn forces_of_several_inputs_at_a_dead_position_have_no_bounds() {
    let model = free(CIRCLE);
    let body = several_of(&model, None).expect("a linkage of several inputs");
    let left = |over: InputOver| {
        let mut question = question(0.9, 1.3);
        question.inputs[0].over = Some(over);
        AskedSeveral::new(&model, body, &question).expect("a question")
    };
    let forces = |over| multi_input_forces(&left(over), Options::default()).expect("a study");
    let whole = forces(InputOver::Free);
    for zone in &whole.zones {
        let end = zone.from;
        let middle = 0.5 * (whole.zones[0].from + whole.zones[1].from);
        // The linkage can still be assembled there.
        let inside = end + 1e-9 * (middle - end);
        let alone = forces(InputOver::At(inside));
        assert_eq!((alone.rows.len(), alone.solved().count()), (1, 0));
        for [from, to] in [[middle, inside], [inside, middle], [middle, end]] {
            let part = forces(InputOver::Range { from, to });
            assert_eq!(part.rows.len() - part.solved().count(), 1);
            let rod = part.extremes.iter().find(|one| one.name == "B.force");
            assert_eq!(rod.expect("extremes").greatest.value, f64::INFINITY);
            assert_eq!(part.judgement(), Judgement::NotInWorkingOrder);
        }
        assert_eq!(alone.judgement(), Judgement::NotInWorkingOrder);
        let beside = forces(InputOver::At(end + 1e-3 * (middle - end)));
        assert_eq!(beside.judgement(), Judgement::InWorkingOrder);
    }
}

#[test]
fn a_lacking_closing_force_is_told() {
    let warned = |cam: &str| {
        let model = free(cam);
        let body = several_of(&model, None).expect("a linkage of several inputs");
        let asked = AskedSeveral::new(&model, body, &question(0.9, 1.3)).expect("a question");
        let study = multi_input_forces(&asked, Options::default()).expect("a study");
        let lacking = |warning: &String| warning.contains("the cam of `K` does not press at");
        study.warnings().iter().any(lacking)
    };
    // The spring and the weight draw the lever down on the circle from above; a hollow one from within.
    assert!(!warned(CIRCLE));
    let hollow = CIRCLE.replace("0.27", "0.33").replace(
        "\"roller_radius\"",
        "\"surface\": \"hollow\", \"roller_radius\"",
    );
    assert!(warned(&hollow));
    let groove = CIRCLE.replace(
        "\"roller_radius\"",
        "\"surface\": \"groove\", \"roller_radius\"",
    );
    assert!(!warned(&groove));
}

/// Nearer and nearer to the end the forces are greater and greater: the greatest tells nothing of the
/// linkage, only how near to the end it was looked.
#[test]
fn forces_at_the_ends_of_the_reach_have_no_bounds() {
    let model = free(CIRCLE);
    let body = several_of(&model, None).expect("a linkage of several inputs");
    let mut question = question(0.9, 1.3);
    question.inputs[0].over = Some(InputOver::Free);
    let asked = AskedSeveral::new(&model, body, &question).expect("a question");
    let study = multi_input_forces(&asked, Options::default()).expect("a study");
    let unbounded: Vec<_> = study.zones.iter().map(|zone| zone.unbounded).collect();
    assert_eq!(unbounded, [[false, true], [true, false]]);
    for zone in &study.zones {
        assert_eq!((zone.kind, zone.from), (ZoneKind::Dead, zone.to));
        approx::assert_abs_diff_eq!(apart(zone.from, 0.6), 1.0, epsilon = 1e-9);
    }
    let solved: Vec<bool> = study.rows.iter().map(|row| row.forces.is_ok()).collect();
    let last = solved.len() - 1;
    assert!((0..=last).all(|row| solved[row] == (row > 0 && row < last)));
    let extremes = |name: &str| {
        let found = study.extremes.iter().find(|one| one.name == name);
        found.expect("extremes").clone()
    };
    let rod = extremes("K.force");
    assert!(rod.least.value.is_infinite() || rod.greatest.value.is_infinite());
    assert_eq!(extremes("B.force").greatest.value, f64::INFINITY);
    assert!(extremes("B.force").least.value.is_finite());
    assert!(study.cycle.is_none());
    // So have speeds, and places do not.
    let found = kinematics_of(&model, &question).expect("kinematics");
    let of = |name: &str| {
        let column = found.columns.iter().position(|one| one.name() == name);
        found.extremes[column.expect("a column")]
    };
    let speed = of("links.lever.angular_speed");
    assert!(speed.least.1.is_infinite() && speed.greatest.1.is_infinite());
    approx::assert_abs_diff_eq!(apart(speed.least.0, 0.6), 1.0, epsilon = 1e-9);
    let angle = of("links.lever.angle");
    assert!(angle.least.1.is_finite() && angle.greatest.1.is_finite());
    // A range within has them all.
    question.inputs[0].over = Some(InputOver::Range { from: 0.9, to: 1.3 });
    let asked = AskedSeveral::new(&model, body, &question).expect("a question");
    let study = multi_input_forces(&asked, Options::default()).expect("a study");
    assert!(study.zones.is_empty() && study.rows.iter().all(|row| row.forces.is_ok()));
}

#[test]
fn undercuts_are_told_and_profiles_refused_with_their_place() {
    let sharp = LOBES.replace(
        "\"amplitude\": 0.008, \"harmonic\": 3",
        "\"amplitude\": 0.01, \"harmonic\": 20",
    );
    let told = free(&sharp).warnings;
    let undercut = |warning: &String| warning.contains("`bar`: the cam of `K` is undercut at");
    assert!(told.iter().any(undercut), "{told:?}");
    let links = [r#", "start": "1.1 rad""#, r#", "start": "0.6 rad""#];
    let open = LOBES.replace("\"harmonic\": 3", "\"harmonic\": 2.5");
    let faults = lower(&read(&two_cranks(&open, "", links, 0.5), &[])).expect_err("a fault");
    assert_eq!(faults[0].path, "bar.couplings.K.cam.lift");
    let message = &faults[0].message;
    assert!(
        message.contains("does not repeat after a turn"),
        "{message}"
    );
}
