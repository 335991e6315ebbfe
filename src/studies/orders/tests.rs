//! Against Fourier sums and exact propagation in high precision, and against runs.

use super::law::OrderedLaw;
use super::*;
use crate::Mechanism;
use crate::ask::Scene;
use crate::studies::Control;
use serde_json::Value;
use std::f64::consts::TAU;

fn reference() -> Value {
    let text = std::fs::read_to_string("tests/reference/frequency-response.json").expect("a file");
    let all: Value = serde_json::from_str(&text).expect("JSON");
    all["cam_orders"].clone()
}

fn number(value: &Value) -> f64 {
    value.as_str().expect("digits").parse().expect("a number")
}

fn scene(position: &str, more: &str) -> Mechanism {
    let text = format!(
        r#"{{ "dam": 1, "name": "orders", "run": {{ "duration": "5 s", "tolerance": 1e-11 }}, "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": "600 rpm" }} }},
            "part": {{ "kind": "rocker", "input": "drive", "position": {position},
                "inertia": 0.1, "stiffness": 1e5, "damping_capacity": 0.4, "masses": 2 {more} }} }} }}"#
    );
    let scene = Scene::from_json(&text).expect("JSON");
    Mechanism::of(scene.decode().expect("a scene")).expect("a mechanism")
}

const CAM: &str = r#"{ "cam": { "lift": 0.5, "rise": "120 deg", "dwell": "60 deg",
    "return": "120 deg", "law": "cycloidal" } }"#;

fn ask(ready: &Mechanism, question: &OrdersQuestion) -> OrdersAnswer {
    orders(
        (&ready.system, &ready.settings),
        question,
        &Control::default(),
    )
    .expect("orders")
}

fn few() -> OrdersQuestion {
    OrdersQuestion {
        points: 2,
        highest: 13,
        ..OrdersQuestion::default()
    }
}

#[test]
fn orders_and_the_deviation_of_the_cam_are_those_of_the_reference() {
    let reference = reference();
    let found = ask(&scene(CAM, ""), &few());
    let tree = &found.trees[0];
    assert!(tree.closed_form);
    for expected in reference["orders"].as_array().expect("orders") {
        let k = expected["order"].as_f64().expect("a number");
        let order = tree
            .orders
            .iter()
            .find(|order| order.order == k)
            .expect("it");
        let amplitude = number(&expected["amplitude_of_law"]);
        approx::assert_abs_diff_eq!(order.amplitude, amplitude, epsilon = 1e-15);
        assert_eq!(order.present, amplitude > 1e-20, "{k}");
        let rpm = order.resonances[0] * 60.0 / TAU;
        let expected = number(&expected["resonance_rpm_of_mode_1"]);
        approx::assert_relative_eq!(rpm, expected, max_relative = 1e-10);
    }
    // A rise and a return that mirror each other have odd orders only.
    for order in tree.orders.iter().filter(|order| order.order % 2.0 == 0.0) {
        assert!(!order.present && order.amplitude < 1e-15, "{}", order.order);
    }
    let deviation = tree.deviation.as_ref().expect("periodic");
    let size = number(&reference["greatest_deviation"]);
    approx::assert_abs_diff_eq!(deviation.greatest, size, epsilon = 1e-9 * size);
    let at = number(&reference["at_deg"]);
    approx::assert_abs_diff_eq!(deviation.at.to_degrees(), at, epsilon = 1e-5);
    for (angle, value) in reference["deviation_at"].as_object().expect("angles") {
        let angle: f64 = angle.parse().expect("an angle");
        let own = deviation.course[(2.0 * angle) as usize];
        approx::assert_abs_diff_eq!(own[0].to_degrees(), angle, epsilon = 1e-9);
        approx::assert_abs_diff_eq!(own[1], number(value), epsilon = 1e-9 * size);
    }
}

#[test]
fn the_sum_of_orders_is_the_periodic_motion() {
    let ready = scene(CAM, "");
    let question = OrdersQuestion {
        highest: 4000,
        ..few()
    };
    let tree = &ask(&ready, &question).trees[0];
    let linear = crate::studies::linear::LinearModel::of(&ready.system).expect("linear");
    let (inputs, outputs) = (linear.inputs(), linear.outputs());
    let deviation = tree.deviation.as_ref().expect("periodic");
    for [angle, value] in deviation.course.iter().step_by(41) {
        let part = |order: &Order| {
            let at = order.order * tree.speed / TAU;
            let gain = linear
                .transfer(&inputs[0], &outputs[0], at)
                .expect("no pole");
            let wave = nalgebra::Complex::from_polar(order.amplitude, order.phase);
            (gain * wave * nalgebra::Complex::from_polar(1.0, order.order * angle)).re
        };
        let sum: f64 = tree.orders.iter().rev().map(part).sum();
        approx::assert_abs_diff_eq!(sum, *value, epsilon = 1e-8 * deviation.greatest.abs());
    }
}

#[test]
fn a_run_of_fifty_turns_comes_to_the_same_deviation() {
    let ready = scene(CAM, "");
    let deviation = ask(&ready, &few()).trees[0]
        .deviation
        .clone()
        .expect("periodic");
    let run = ready.run().expect("a run");
    let figures = &run.figures.objects["part"];
    let found = figures.delta_abs;
    // Results of a run are those of its last turn where it is long enough.
    let last = run.record.columns.iter().find(|column| {
        column.object == "part" && column.quantity == crate::dynamics::record::Quantity::Delta
    });
    let last = last.expect("δ").values.last().copied().expect("a value");
    let size = deviation.greatest.abs();
    approx::assert_abs_diff_eq!(last, deviation.course[0][1], epsilon = 1e-8 * size);
    assert!(found >= size * (1.0 - 1e-8), "{found} {size}");
}

#[test]
fn crossings_count_by_their_amplitude() {
    let question = OrdersQuestion {
        speeds: Some([800.0 * TAU / 60.0, 4000.0 * TAU / 60.0]),
        points: 4,
        accuracy: Some(5e-3),
        ..few()
    };
    let tree = &ask(&scene(CAM, ""), &question).trees[0];
    let rpm = |crossing: &Crossing| crossing.speed * 60.0 / TAU;
    let third = tree
        .crossings
        .iter()
        .find(|one| one.order == 3.0 && one.mode == 1);
    let third = third.expect("order 3");
    approx::assert_relative_eq!(rpm(third), 3341.6364474, max_relative = 1e-9);
    assert!(third.marked && third.present);
    // At resonance one order makes nearly all of the motion.
    let [alone, all] = [third.amplitude, third.greatest].map(|own| own.expect("bounded"));
    assert!((alone / all - 1.0).abs() < 0.1, "{alone} {all}");
    for absent in tree
        .crossings
        .iter()
        .filter(|one| one.order % 2.0 == 0.0 || one.order == 9.0)
    {
        assert!(!absent.present && !absent.marked && absent.amplitude == Some(0.0));
    }
    assert!(tree.crossings.iter().any(|one| one.present && !one.marked));
    assert!(
        tree.crossings
            .windows(2)
            .all(|pair| pair[0].speed <= pair[1].speed)
    );
}

#[test]
fn a_sine_has_one_order_and_a_linkage_is_integrated() {
    let sine = r#"{ "sine": { "amplitude": 0.3, "harmonic": 2, "phase": "20 deg" } }"#;
    let tree = &ask(&scene(sine, ""), &few()).trees[0];
    assert_eq!(tree.orders[0].order, 2.0);
    approx::assert_relative_eq!(tree.orders[0].amplitude, 0.3, max_relative = 1e-14);
    // 0.3·sin(2φ + 20°) = 0.3·cos(2φ − 70°).
    approx::assert_relative_eq!(
        tree.orders[0].phase.to_degrees(),
        -70.0,
        max_relative = 1e-12
    );
    assert!(tree.orders[1..].iter().all(|order| !order.present));
    let linkage =
        r#"{ "four_bar": { "crank": 0.1, "coupler": 0.4, "rocker": 0.3, "frame": 0.42 } }"#;
    let ready = scene(linkage, "");
    let tree = &ask(&ready, &few()).trees[0];
    assert!(!tree.closed_form);
    // The law is the sum of its orders.
    let law = OrderedLaw::of(ready.model(), 1).expect("orders");
    let position = ready.model().nodes[1].motion.law().expect("a law");
    let value = |phi: f64| position.lever * position.position.jet(0, phi).value;
    let mean = (0..4096)
        .map(|i| value(TAU * f64::from(i) / 4096.0))
        .sum::<f64>()
        / 4096.0;
    for phi in [0.3, 2.0, 4.4] {
        let part = |k: usize| {
            let wave = nalgebra::Complex::from_polar(1.0, k as f64 * phi);
            2.0 * (law.coefficient(k) * wave).re
        };
        let sum: f64 = (1..60).map(part).sum();
        approx::assert_abs_diff_eq!(mean + sum, value(phi), epsilon = 1e-12);
    }
}

#[test]
fn a_drive_that_turns_backwards_or_from_another_angle_has_the_same_orders() {
    let text = |speed: &str, angle: &str| {
        format!(
            r#"{{ "dam": 1, "name": "orders", "run": {{ "duration": 1 }}, "objects": {{
                "drive": {{ "kind": "drive", "motion": {{ "speed": "{speed}", "angle": "{angle}" }} }},
                "gear": {{ "kind": "shaft", "input": "drive", "position": {{ "ratio": -0.5 }}, "masses": 0, "inertia": 0.01 }},
                "part": {{ "kind": "rocker", "input": "gear", "position": {CAM},
                    "inertia": 0.1, "stiffness": 1e5, "damping_capacity": 0.4, "masses": 2 }} }} }}"#
        )
    };
    for (speed, angle) in [
        ("600 rpm", "0 deg"),
        ("-600 rpm", "0 deg"),
        ("600 rpm", "77 deg"),
    ] {
        let scene = Scene::from_json(&text(speed, angle)).expect("JSON");
        let ready = Mechanism::of(scene.decode().expect("a scene")).expect("a mechanism");
        let question = OrdersQuestion {
            highest: 2000,
            ..few()
        };
        let tree = &ask(&ready, &question).trees[0];
        // The cam turns half as fast as the drive.
        assert_eq!(tree.orders[0].order, 0.5);
        approx::assert_relative_eq!(
            tree.orders[0].amplitude,
            0.2961451765432333,
            max_relative = 1e-12
        );
        let linear = crate::studies::linear::LinearModel::of(&ready.system).expect("linear");
        let (inputs, outputs) = (linear.inputs(), linear.outputs());
        let deviation = tree.deviation.as_ref().expect("periodic");
        let sense = if speed.starts_with('-') { -1.0 } else { 1.0 };
        for [angle, value] in deviation.course.iter().step_by(97) {
            let part = |order: &Order| {
                let at = order.order * tree.speed / TAU;
                let gain = linear
                    .transfer(&inputs[0], &outputs[0], at)
                    .expect("no pole");
                // Backwards in time the order turns the other way.
                let wave = nalgebra::Complex::from_polar(
                    order.amplitude,
                    order.phase + order.order * angle,
                );
                let wave = if sense < 0.0 { wave.conj() } else { wave };
                (gain * wave).re
            };
            let sum: f64 = tree.orders.iter().rev().map(part).sum();
            approx::assert_abs_diff_eq!(sum, *value, epsilon = 1e-7 * deviation.greatest.abs());
        }
    }
}

#[test]
fn what_has_no_orders_is_refused_with_the_reason() {
    let ready = scene(r#"{ "polynomial": { "coefficients": [0, 0.2] } }"#, "");
    let found = orders(
        (&ready.system, &ready.settings),
        &few(),
        &Control::default(),
    );
    let faults = found.unwrap_err();
    assert!(
        faults[0].message.contains("straight line"),
        "{}",
        faults[0].message
    );
    let wrong = OrdersQuestion {
        speeds: Some([5.0, 1.0]),
        highest: 0,
        points: 1,
        accuracy: None,
    };
    let faults = orders(
        (&ready.system, &ready.settings),
        &wrong,
        &Control::default(),
    );
    assert_eq!(faults.unwrap_err().len(), 3);
}
