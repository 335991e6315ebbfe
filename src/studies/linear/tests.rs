//! Against transfer matrices in 40 digits, the equations of motion and the continuum.

use super::*;
use crate::Mechanism;
use crate::ask::Scene;
use crate::dynamics::integrate::{Dynamics, Modes};
use nalgebra::{Complex, DMatrix, DVector};
use serde_json::Value;
use std::f64::consts::TAU;

type C = Complex<f64>;

fn reference() -> Value {
    let text = std::fs::read_to_string("tests/reference/frequency-response.json").expect("a file");
    serde_json::from_str(&text).expect("JSON")
}

fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("digits in a text");
    text.parse().expect("a number")
}

fn ready(text: &str) -> Mechanism {
    let scene = Scene::from_json(text).expect("JSON");
    Mechanism::of(scene.decode().expect("a scene")).expect("a mechanism")
}

fn ask(
    ready: &mut Mechanism,
    question: &ResponseQuestion,
) -> Result<FrequencyResponse, Vec<crate::fault::Fault>> {
    response((&ready.system, &mut ready.reading.scene), question)
}

/// A scene of one elastic object of the reference.
fn object(case: &Value, more: &str) -> Mechanism {
    ready(&text(
        case,
        &format!(r#""masses": {} {more}"#, case["masses"]),
    ))
}

fn text(case: &Value, level: &str) -> String {
    let [inertia, stiffness, damping] =
        ["inertia", "stiffness", "damping_capacity"].map(|name| number(&case[name]));
    let (kind, position) = match case["kind"].as_str() {
        Some("lever") => (
            "rocker",
            r#""position": { "sine": { "amplitude": "90 deg" } },"#,
        ),
        _ => ("shaft", ""),
    };
    format!(
        r#"{{ "dam": 1, "name": "one", "run": {{ "duration": 0.1 }}, "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": "10 rev/s" }} }},
            "part": {{ "kind": "{kind}", "input": "drive", {position} "inertia": {inertia},
                "stiffness": {stiffness}, "damping_capacity": {damping}, {level} }} }} }}"#
    )
}

/// A lever, two shafts behind a constant ratio, springs and dampers to the ground.
fn train() -> Mechanism {
    ready(
        r#"{ "dam": 1, "name": "train", "run": { "duration": 0.1 }, "objects": {
            "drive": { "kind": "drive", "motion": { "speed": "5 rev/s" } },
            "part": { "kind": "rocker", "input": "drive",
                "position": { "sine": { "amplitude": "20 deg" } }, "inertia": 0.2,
                "stiffness": 3e5, "damping_capacity": 0.3, "masses": 2,
                "pair": { "closure": "force" },
                "loads": { "closing": { "spring": { "rate": 800, "preload": 300 } } } },
            "gear": { "kind": "shaft", "input": "part", "position": { "ratio": -2.5 },
                "inertia": 0.03, "stiffness": 2e4, "damping_capacity": 0.2, "masses": 3,
                "loads": { "drag": { "viscous": 0.7 } } } } }"#,
    )
}

const CASES: [&str; 3] = ["lever_two_masses", "lever_ten_masses", "shaft_three_masses"];

#[test]
fn modes_are_those_of_the_reference() {
    let reference = reference();
    for name in CASES {
        let case = &reference[name];
        let found = linearise(&object(case, "").system).expect("linear");
        let modes = &found.modes[0].modes;
        let expected = case["modes"].as_array().expect("modes");
        assert_eq!(modes.len(), expected.len());
        for (mode, expected) in modes.iter().zip(expected) {
            let close = |own: f64, of: &Value| {
                approx::assert_relative_eq!(own, number(of), max_relative = 1e-10);
            };
            close(mode.frequency, &expected["undamped_Hz"]);
            close(mode.damping_ratio, &expected["damping_ratio"]);
            assert_eq!(mode.overdamped, expected["damped_Hz"] == "overdamped");
            match mode.damped_frequency {
                Some(damped) => close(damped, &expected["damped_Hz"]),
                None => assert!(mode.overdamped),
            }
        }
        assert!(found.modes[0].uncoupled);
        // A rigid object has all of the inertia, and a slow force bends it by 1/c.
        let inertia: f64 = modes.iter().map(|mode| mode.effective_inertia).sum();
        approx::assert_relative_eq!(inertia, number(&case["inertia"]), max_relative = 1e-10);
        let shares: f64 = modes.iter().map(|mode| mode.compliance_share).sum();
        approx::assert_relative_eq!(shares, 1.0, max_relative = 1e-14);
        let compliance = found.modes[0].static_compliance * number(&case["stiffness"]);
        approx::assert_relative_eq!(compliance, 1.0, max_relative = 1e-10);
        // Upper modes of many masses hardly move the output.
        let unit = |mode: &&Mode| mode.shape.last() == Some(&1.0);
        assert!(modes.iter().take(6).all(|mode| unit(&mode)));
        let greatest = |mode: &Mode| mode.shape.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        assert!(
            modes
                .iter()
                .all(|mode| unit(&mode) || greatest(mode) == 1.0)
        );
    }
}

fn close(found: C, expected: C, within: f64, what: &str) {
    let error = (found - expected).norm() / expected.norm();
    assert!(error <= within, "{what}: {found} {expected} {error:e}");
}

#[test]
fn responses_are_those_of_the_reference() {
    let reference = reference();
    for name in CASES {
        let case = &reference[name];
        let mut ready = object(case, "");
        let rows = case["responses"].as_array().expect("rows");
        let question = ResponseQuestion {
            frequencies: rows
                .iter()
                .map(|row| number(&row["frequency_Hz"]))
                .collect(),
            inputs: vec!["part.law".to_owned(), "part.load".to_owned()],
            ..ResponseQuestion::default()
        };
        let found = ask(&mut ready, &question).expect("a response");
        for (key, input, output) in [
            ("delta_by_law", "part.law", "part.delta"),
            ("output_by_law", "part.law", "part.displacement"),
            ("compliance_at_output", "part.load", "part.displacement"),
            ("reaction_by_law", "part.law", "part.reaction"),
        ] {
            let mut pairs = found.pairs.iter();
            let pair = pairs
                .find(|pair| pair.input.name == input && pair.output.name == output)
                .expect("the pair");
            for (place, row) in rows.iter().enumerate() {
                let expected = C::new(number(&row[key]["re"]), number(&row[key]["im"]));
                let own = C::new(
                    pair.re[place].expect("finite"),
                    pair.im[place].expect("finite"),
                );
                close(own, expected, 1e-12, &format!("{name} {key} {place}"));
                approx::assert_relative_eq!(
                    pair.gain[place].expect("finite"),
                    expected.norm(),
                    max_relative = 1e-12
                );
            }
        }
    }
}

/// H by the matrices alone; the law with its derivatives.
fn by_matrices(space: &StateSpace, input: &str, at: f64) -> DVector<C> {
    let s = C::new(0.0, TAU * at);
    let n = space.a.nrows();
    let complex = |matrix: &DMatrix<f64>| matrix.map(C::from);
    let resolvent = (DMatrix::from_diagonal_element(n, n, s) - complex(&space.a)).lu();
    let column = |name: &str| {
        let place = space
            .inputs
            .iter()
            .position(|one| one.name == name)
            .expect("input");
        let b = complex(&space.b).column(place).clone_owned();
        let x = resolvent.solve(&b).expect("no pole");
        complex(&space.c) * x + complex(&space.d).column(place)
    };
    match input.ends_with(".law") {
        true => {
            column(input)
                + column(&format!("{input}_speed")) * s
                + column(&format!("{input}_acceleration")) * (s * s)
        }
        false => column(input),
    }
}

#[test]
fn matrices_answer_as_the_elimination_does() {
    let reference = reference();
    let balanced = r#", "lumping": "balanced", "pair": { "closure": "bilateral" }"#;
    for ready in [
        object(&reference["lever_ten_masses"], ""),
        object(&reference["lever_two_masses"], balanced),
        train(),
    ] {
        let space = linearise(&ready.system).expect("linear").state_space;
        let model = LinearModel::of(&ready.system).expect("linear");
        for input in model.inputs() {
            for at in [7.0, 160.0, 900.0, 3500.0] {
                let expected = by_matrices(&space, &input.signal.name, at);
                let s = C::new(0.0, TAU * at);
                let tree = &model.trees[input.tree].equations;
                let q = input.deviations(tree, s).expect("no pole");
                for (place, output) in model.outputs().iter().enumerate() {
                    let own = model.transfer(&input, output, at).expect("no pole");
                    // (Matrices lose what cancels between the law and the deviations.)
                    let greatest = q.iter().fold(0.0f64, |most, one| most.max(one.norm()));
                    let terms = output.row.terms.iter();
                    let terms = terms.map(|(_, [x, v])| greatest * (x.abs() + (s * v).norm()));
                    let [x, v, a] = output.row.law.map(f64::abs);
                    let law = input.law() * (x + s.norm() * (v + s.norm() * a));
                    let scale = terms.sum::<f64>() + law;
                    let error = (own - expected[place]).norm();
                    let name = &output.signal.name;
                    assert!(
                        error <= 1e-9 * own.norm() + 1e-12 * scale,
                        "{name} {at}: {error:e}"
                    );
                }
            }
        }
    }
}

/// The Jacobian of the equations of motion with all contacts closed, exact by dual numbers.
fn jacobian(ready: &Mechanism) -> DMatrix<f64> {
    let system = &ready.system;
    let n = system.coordinates();
    let y = vec![0.0; 2 * n];
    let modes: Modes = system.initial_state().expect("a start").modes;
    let mut scratch = system.scratch();
    let mut jacobian = DMatrix::zeros(2 * n, 2 * n);
    let (mut direction, mut column) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
    for j in 0..2 * n {
        direction[j] = 1.0;
        system.tangent(0.0, &y, &modes, &direction, &mut scratch, &mut column);
        direction[j] = 0.0;
        jacobian.column_mut(j).copy_from_slice(&column);
    }
    jacobian
}

#[test]
fn the_matrix_is_the_jacobian_of_the_equations_of_motion() {
    let case = &reference()["lever_ten_masses"];
    let ready = object(case, "");
    let found = linearise(&ready.system).expect("linear").state_space.a;
    let expected = jacobian(&ready);
    let scale = expected.amax();
    assert!((found - &expected).amax() < 1e-14 * scale);
    // Behind a mass the system measures from that mass: the same eigenvalues.
    let ready = train();
    let own = linearise(&ready.system).expect("linear").state_space.a;
    let other = jacobian(&ready);
    let sorted = |matrix: DMatrix<f64>| {
        let mut values: Vec<C> = matrix.complex_eigenvalues().iter().copied().collect();
        values.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
        values
    };
    for (own, other) in sorted(own).into_iter().zip(sorted(other)) {
        close(own, other, 1e-8, "eigenvalue");
    }
}

#[test]
fn coupled_dampers_are_said_so_and_poles_are_exact() {
    let ready = train();
    let found = linearise(&ready.system).expect("linear");
    let modes = &found.modes[0];
    assert!(!modes.uncoupled);
    assert_eq!(
        (modes.law.as_str(), modes.output.as_str()),
        ("part", "gear")
    );
    assert!(found.validity.contains("part"));
    let a = &found.state_space.a;
    for pole in &modes.poles {
        let lambda = C::new(pole[0], pole[1]);
        let shifted = a.map(C::from) - DMatrix::from_diagonal_element(a.nrows(), a.nrows(), lambda);
        let least = shifted.singular_values().min();
        assert!(least < 1e-9 * lambda.norm(), "{lambda} {least}");
    }
    // The law moves both objects, the second with the square of its ratio.
    let inertia: f64 = modes.modes.iter().map(|mode| mode.effective_inertia).sum();
    approx::assert_relative_eq!(inertia, 0.2 + 0.03 * 6.25, max_relative = 1e-10);
}

/// Output over law of the uniform lever: u″ = z·s²·u with u = U at s = 0 and u′ = 0 at s = 1 has
/// u(1)/U = 1/g′(1), where g = s + z·s⁵/20 + … is the solution with g(0) = 0 and g′(0) = 1.
fn lever(case: &Value, at: f64) -> C {
    let [inertia, stiffness, damping] =
        ["inertia", "stiffness", "damping_capacity"].map(|name| number(&case[name]));
    let p = C::new(0.0, TAU * at);
    let time = damping / (TAU * (stiffness / inertia).sqrt());
    let z = p * p * 3.0 * inertia / (stiffness * (C::from(1.0) + p * time));
    let (mut coefficient, mut slope) = (C::from(1.0), C::from(1.0));
    for k in (1..400).step_by(4) {
        let next = f64::from(k) + 4.0;
        coefficient = coefficient * z / (next * (next - 1.0));
        slope += coefficient * next;
    }
    slope.inv()
}

#[test]
fn the_error_of_the_model_is_that_against_the_continuum() {
    let case = &reference()["lever_ten_masses"];
    let mut ready = object(case, "");
    let question = ResponseQuestion {
        frequencies: vec![100.0, 500.0, 1500.0, 2500.0, 4000.0, 7000.0],
        outputs: vec!["part.displacement".to_owned()],
        ..ResponseQuestion::default()
    };
    let found = ask(&mut ready, &question).expect("a response");
    assert_eq!(found.judged_by.times, Some(16));
    let pair = &found.pairs[0];
    let error_of = |re: f64, im: f64, at: f64| {
        let exact = lever(case, at);
        (C::new(re, im) - exact).norm() / exact.norm()
    };
    for (place, &at) in found.frequencies.iter().enumerate() {
        let own = pair.error[place].expect("judged");
        let exact = error_of(pair.re[place].unwrap(), pair.im[place].unwrap(), at);
        // The finer model has a sixteenth of the error itself.
        assert!((own - exact).abs() < 0.12 * exact, "{at} {own} {exact}");
    }
    // At the frequency up to which it is right the error is the accuracy.
    let at = pair.right_up_to.expect("somewhere");
    let own = LinearModel::of(&ready.system).expect("linear");
    let (input, outputs) = (&own.inputs()[0], own.outputs());
    let output = outputs
        .iter()
        .find(|one| one.signal == pair.output)
        .expect("output");
    let value = own.transfer(input, output, at).expect("no pole");
    let exact = error_of(value.re, value.im, at);
    assert!((exact - 0.01).abs() < 0.0015, "{at} {exact}");
    assert!(at > 100.0 && at < 1500.0 && !pair.right_everywhere);
}

#[test]
fn peaks_lie_at_the_damped_modes() {
    let case = &reference()["lever_two_masses"];
    let mut ready = object(case, "");
    let question = ResponseQuestion {
        frequencies: vec![10.0, 100.0, 1000.0, 20_000.0],
        outputs: vec!["part.displacement".to_owned()],
        ..ResponseQuestion::default()
    };
    let found = ask(&mut ready, &question).expect("a response");
    let peak = found.pairs[0].peaks[0];
    assert_eq!(peak.mode, Some(1));
    assert!(
        (peak.frequency / 1669.0 - 1.0).abs() < 0.01,
        "{}",
        peak.frequency
    );
    let model = LinearModel::of(&ready.system).expect("linear");
    let (inputs, outputs) = (model.inputs(), model.outputs());
    let gain = |at: f64| {
        model
            .transfer(&inputs[0], &outputs[1], at)
            .expect("no pole")
            .norm()
    };
    let top = gain(peak.frequency);
    approx::assert_relative_eq!(peak.gain.expect("finite"), top, max_relative = 1e-12);
    assert!(top >= gain(peak.frequency * 1.001) && top >= gain(peak.frequency * 0.999));
}

#[test]
fn an_undamped_mode_is_unbounded_at_its_frequency_alone() {
    let mut case = reference()["lever_two_masses"].clone();
    case["damping_capacity"] = "0".into();
    let mut ready = object(&case, "");
    let modes = linearise(&ready.system).expect("linear").modes;
    let at = modes[0].modes[0].frequency;
    let question = ResponseQuestion {
        frequencies: vec![0.0, 0.5 * at, at, 1.5 * at],
        ..ResponseQuestion::default()
    };
    let found = ask(&mut ready, &question).expect("a response");
    for pair in &found.pairs {
        let known: Vec<bool> = pair.gain.iter().map(Option::is_some).collect();
        assert_eq!(known, [true, true, false, true], "{}", pair.output.name);
        assert!(
            pair.peaks
                .iter()
                .any(|peak| peak.gain.is_none() && peak.mode == Some(1))
        );
    }
    assert_eq!(found.warnings.len(), 1);
    assert!(
        found.warnings[0].contains("mode 1"),
        "{}",
        found.warnings[0]
    );
}

#[test]
fn names_and_numbers_are_refused_all_at_once() {
    let mut ready = train();
    let question = ResponseQuestion {
        frequencies: vec![5.0, 1.0],
        inputs: vec!["part.lw".to_owned()],
        outputs: vec!["gear.delt".to_owned()],
        accuracy: Some(-1.0),
    };
    let faults = ask(&mut ready, &question).unwrap_err();
    let said: Vec<String> = faults
        .iter()
        .map(|one| format!("{} {}", one.message, one.hint))
        .collect();
    assert_eq!(faults.len(), 4, "{said:?}");
    assert!(
        said[0].contains("`part.law`") && said[1].contains("`gear.delta`"),
        "{said:?}"
    );
}

#[test]
fn what_has_no_linear_equations_is_refused_with_the_reason() {
    let refused = |text: &str| {
        let scene = std::fs::read_to_string(format!("scenarios/{text}.json")).expect("a scene");
        let faults = LinearModel::of(&ready(&scene).system).unwrap_err();
        faults
            .iter()
            .map(|one| one.message.clone())
            .collect::<Vec<_>>()
            .join("; ")
    };
    assert!(refused("shafts/two_rotors").contains("torque"));
    let scene = std::fs::read_to_string("scenarios/shafts/two_rotors.json").expect("a scene");
    let faults = linearise(&ready(&scene).system).unwrap_err();
    assert!(
        faults[0].message.contains("no steady turning"),
        "{}",
        faults[0].message
    );
    let scene = std::fs::read_to_string("scenarios/rigid/pump.json").expect("a scene");
    let faults = linearise(&ready(&scene).system).unwrap_err();
    assert!(
        faults[0].message.contains("ratio changes"),
        "{}",
        faults[0].message
    );
    let case = &reference()["lever_two_masses"];
    let rigid = ready(&text(case, r#""masses": 0"#));
    let message = LinearModel::of(&rigid.system).unwrap_err()[0]
        .message
        .clone();
    assert!(message.contains("no elastic object"), "{message}");
    let modal = ready(&text(case, r#""modes": 2"#));
    let message = LinearModel::of(&modal.system).unwrap_err()[0]
        .message
        .clone();
    assert!(message.contains("vibration modes"), "{message}");
}

#[test]
fn a_machine_in_steady_turning_has_the_matrices_of_the_reference() {
    let case = &reference()["motor_shaft_load"];
    let [inertia, slope, stiffness, damping, load, viscous, ratio] = [
        "motor_inertia",
        "characteristic_slope",
        "stiffness",
        "damping_capacity",
        "load_inertia",
        "load_viscous",
        "ratio",
    ]
    .map(|name| number(&case[name]));
    let torque = 1500.0;
    let speed = torque / slope;
    let ready = ready(&format!(
        r#"{{ "dam": 1, "name": "motor", "run": {{ "duration": 0.1 }}, "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": {inertia}, "torque": {{
                "linear": {{ "no_load_speed": {speed}, "stall_torque": {torque} }} }} }} }},
            "load": {{ "kind": "shaft", "input": "motor", "position": {{ "ratio": {ratio} }},
                "inertia": {load}, "stiffness": {stiffness}, "damping_capacity": {damping},
                "masses": 1, "loads": {{ "drag": {{ "viscous": {viscous} }} }} }} }} }}"#
    ));
    let found = linearise(&ready.system).expect("linear");
    assert_eq!(found.case, "machine in steady turning");
    let space = &found.state_space;
    let names: Vec<&str> = space.states.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(names, ["load.deviation", "motor.speed", "load.speed"]);
    for (i, row) in case["A"].as_array().expect("rows").iter().enumerate() {
        for (j, entry) in row.as_array().expect("a row").iter().enumerate() {
            let expected = number(entry);
            let own = space.a[(i, j)];
            assert!(
                (own - expected).abs() <= 1e-12 * expected.abs().max(1.0),
                "{i} {j} {own}"
            );
        }
    }
    let column = space
        .inputs
        .iter()
        .position(|one| one.name == "load.load")
        .expect("input");
    for (i, entry) in case["B"].as_array().expect("a column").iter().enumerate() {
        approx::assert_abs_diff_eq!(space.b[(i, column)], number(entry), epsilon = 1e-11);
    }
    // −ζω of the slow one first; the two others are conjugates.
    let expected = case["eigenvalues"].as_array().expect("eigenvalues");
    for (own, of) in found.eigenvalues.iter().zip(expected) {
        approx::assert_relative_eq!(own[0], number(&of[0]), max_relative = 1e-10);
        let im = number(&of[1]).abs();
        approx::assert_abs_diff_eq!(own[1], im, epsilon = 1e-10 * im.max(1.0));
    }
    for row in case["responses"].as_array().expect("rows") {
        let at = number(&row["frequency_Hz"]);
        let all = by_matrices(space, "load.load", at);
        for (key, output) in [
            ("twist", "load.delta"),
            ("motor_speed", "motor.speed"),
            ("load_speed", "load.speed"),
        ] {
            let expected = C::new(number(&row[key][0]), number(&row[key][1]));
            let place = space
                .outputs
                .iter()
                .position(|one| one.name == output)
                .expect("output");
            close(all[place], expected, 1e-10, &format!("{key} {at}"));
        }
    }
    // The torque of the motor holds the drag: 7.5·(200 − ω) = 2·1.2·2·ω.
    let speed = found
        .operating_point
        .iter()
        .find(|one| one.name == "motor.speed")
        .expect("it");
    approx::assert_relative_eq!(speed.value, 1500.0 / (7.5 + 4.8), max_relative = 1e-12);
}
