//! Laws against published figures.

use super::{run_up, same, stroke};
use crate::kinematics::motion::law::{LawName, Trapezoid};
use serde_json::Value;
use std::f64::consts::PI;

/// Figures computed elsewhere with 34 digits; see tests/reference/README.md.
const REFERENCE: &str = include_str!("../../../../../tests/reference/motion-laws.json");

fn reference() -> Value {
    serde_json::from_str(REFERENCE).unwrap()
}

fn number(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap()
}

#[test]
fn the_family_has_the_constants_of_the_reference() {
    let reference = reference();
    let rows = reference["family_constants"].as_array().unwrap();
    assert_eq!(rows.len(), 11);
    for row in rows {
        let (s1, s2) = (number(row, "s1"), number(row, "s2"));
        let closed = Trapezoid::new(s1, s2).unwrap();
        let (product, at) = closed.greatest_product();
        let constants = run_up(s1, s2).constants();
        for (name, closed, found) in [
            ("theta1_max", closed.greatest_speed(), constants.speed.value),
            (
                "theta2_max",
                closed.greatest_acceleration(),
                constants.acceleration.value,
            ),
            ("product_max", product, constants.torque.value),
            ("tau_product_max", at, constants.torque.at),
            ("tau_star", closed.centre(), constants.centre),
            ("sigma", closed.filling(), constants.filling),
        ] {
            same(closed, number(row, name), name);
            same(found, number(row, name), name);
        }
    }
}

#[test]
fn the_family_has_the_samples_of_the_reference() {
    let reference = reference();
    let laws = reference["family_samples"].as_array().unwrap();
    let mut samples = 0;
    for row in laws {
        let law = run_up(number(row, "s1"), number(row, "s2"));
        for sample in row["rows"].as_array().unwrap() {
            let jet = law.at(number(sample, "tau"));
            same(jet.value, number(sample, "theta"), "θ");
            same(jet.first, number(sample, "theta1"), "θ′");
            // Derivatives that pass through zero are compared with their size.
            let scale = 1e-12 * law.constants().acceleration.value;
            let second = (jet.second - number(sample, "theta2")).abs();
            assert!(second <= scale, "θ″: {second}");
            let third = (jet.third - number(sample, "theta3")).abs();
            assert!(
                third <= 1e-12 * law.constants().jerk.value.max(1.0),
                "θ‴: {third}"
            );
            samples += 1;
        }
    }
    assert!(samples > 100);
}

#[test]
fn full_strokes_have_the_published_constants() {
    // R. Norton, Cam Design and Manufacturing Handbook, and recomputed.
    let known = [
        (LawName::Parabolic, 2.0, 4.0, 0.0, 8.0),
        (
            LawName::Harmonic,
            PI / 2.0,
            PI * PI / 2.0,
            PI.powi(3) / 2.0,
            3.87578,
        ),
        (LawName::Cycloidal, 2.0, 2.0 * PI, 4.0 * PI * PI, 8.16210),
        (
            LawName::ModifiedTrapezoid,
            2.0,
            8.0 * PI / (PI + 2.0),
            61.4260,
            8.08998,
        ),
        (
            LawName::ModifiedSine,
            4.0 * PI / (PI + 4.0),
            4.0 * PI * PI / (PI + 4.0),
            69.4664,
            5.45775,
        ),
        (
            LawName::Polynomial345,
            1.875,
            10.0 / 3f64.sqrt(),
            60.0,
            6.69427,
        ),
        (
            LawName::Polynomial4567,
            35.0 / 16.0,
            84.0 * 5f64.sqrt() / 25.0,
            52.5,
            10.7502,
        ),
    ];
    for (name, speed, acceleration, jerk, torque) in known {
        let found = stroke(name).constants();
        same(found.speed.value, speed, name.name());
        same(found.acceleration.value, acceleration, name.name());
        same(-found.deceleration.value, acceleration, name.name());
        // The figures printed have six digits.
        approx::assert_relative_eq!(found.jerk.value, jerk, max_relative = 5e-6);
        approx::assert_relative_eq!(found.torque_factor, torque, max_relative = 5e-6);
        approx::assert_abs_diff_eq!(found.speed.at, 0.5, epsilon = 1e-9);
    }
    // Modified constant velocity with the middle half uniform: with G of the
    // modified sine, V = 2G/(1 + G) and A = 2πV (tables: 1.28 and 8.01).
    let found = stroke(LawName::ModifiedConstantVelocity).constants();
    let speed = 8.0 * PI / (5.0 * PI + 4.0);
    same(found.speed.value, speed, "V");
    same(found.acceleration.value, 2.0 * PI * speed, "A");
    assert_eq!(found.speed.at, 0.25);
}
