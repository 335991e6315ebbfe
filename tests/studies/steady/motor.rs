//! Moments that depend on speed: the cycle map and its fixed point.

use super::machines::{Worst, contact, number, reference, slider_crank};
use dam::steady::Refusal;
use dam::steady::cycle_map::{self, Load};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

#[test]
fn a_press_with_a_motor_settles_on_the_reference_and_the_energy_mass_method_agrees() {
    let file = reference();
    let case = &file["extension"][0];
    let data = &case["data"];
    let crank = slider_crank(data);
    let get = |value: &Value| -> f64 { value.as_str().unwrap().parse().unwrap() };
    let (stall, slope) = (get(&case["motor"]["M0"]), get(&case["motor"]["k"]));
    let force = get(&data["force"]);
    let at = |piece: usize, phi: f64, speed: f64| {
        let [inertia, _, first] = crank(phi);
        let punching = if piece == 1 { force * first } else { 0.0 };
        Load {
            inertia,
            moment: stall - slope * speed - punching,
            moment_by_speed: -slope,
            ..Load::default()
        }
    };
    let machine = cycle_map::Machine {
        cycle: TAU,
        breaks: vec![contact(data)],
        kinks: vec![],
        at: &at,
    };
    let regime = machine.regime().unwrap();
    let mut worst = Worst::default();
    worst.see("mean", regime.mean_speed, number(&case["mean_time"]), 1e-9);
    worst.see("period", regime.period, number(&case["period"]), 1e-9);
    worst.see("ω(0)", regime.speed, number(&case["omega_at_phi0"]), 1e-9);
    let multiplier = number(&case["cycle_multiplier"]);
    worst.see("multiplier", regime.multiplier, multiplier, 1e-9);
    assert!(regime.attracts && regime.others.is_empty());
    let motion = machine.motion(&regime).unwrap();
    for (row, expected) in motion
        .rows(24)
        .iter()
        .zip(case["profile"].as_array().unwrap())
    {
        worst.see("ω(φ)", row.speed, number(&expected["omega"]), 1e-9);
    }
    println!(
        "motor: worst {:.1e} ({}), {} cycles",
        worst.0, worst.1, regime.cycles
    );
    // The multiplier against a difference of the map.
    let step = 1e-4 * regime.energy;
    let shifted = |by: f64| machine.cycle(regime.energy + by).unwrap().energy;
    let difference = (shifted(step) - shifted(-step)) / (2.0 * step);
    approx::assert_relative_eq!(regime.multiplier, difference, max_relative = 1e-7);
}

#[test]
fn a_stalling_motor_is_told_with_its_position() {
    // Too weak for a load from π on; without one it would run.
    let at = |piece: usize, _: f64, speed: f64| Load {
        inertia: 0.1,
        moment: 10.0 - 0.1 * speed - if piece == 1 { 200.0 } else { 0.0 },
        moment_by_speed: -0.1,
        ..Load::default()
    };
    let machine = cycle_map::Machine {
        cycle: TAU,
        breaks: vec![PI, PI + 0.25],
        kinks: vec![],
        at: &at,
    };
    // From 5 rad/s: T(π) by the closed form is too small for the load.
    let refusal = machine.cycle(0.5 * 0.1 * 25.0).unwrap_err();
    let Refusal::Stalls { position, speed } = refusal else {
        panic!("{refusal:?}");
    };
    assert!((PI..PI + 0.25).contains(&position), "{position}");
    approx::assert_relative_eq!(speed, 5.0, max_relative = 1e-12);
}

#[test]
fn a_characteristic_with_corners_is_followed_across_them() {
    // Torque over speed: 20 up to 40 rad/s, falling to 0 at 60; load 10 + 8·sin φ.
    let torque = |speed: f64| match speed {
        s if s <= 40.0 => (20.0, 0.0),
        s if s <= 60.0 => (60.0 - s, -1.0),
        _ => (0.0, 0.0),
    };
    let at = |_: usize, phi: f64, speed: f64| Load {
        inertia: 0.02,
        moment: torque(speed).0 - 14.0 - 13.0 * phi.sin(),
        moment_by_speed: torque(speed).1,
        ..Load::default()
    };
    let machine = |kinks: Vec<f64>| cycle_map::Machine {
        cycle: TAU,
        breaks: vec![],
        kinks,
        at: &at,
    };
    let with = machine(vec![40.0, 60.0]).regime().unwrap();
    let without = machine(vec![]).regime().unwrap();
    assert!(with.attracts && with.miss < 1e-11, "{with:?}");
    approx::assert_relative_eq!(with.mean_speed, without.mean_speed, max_relative = 1e-9);
    approx::assert_relative_eq!(with.multiplier, without.multiplier, max_relative = 1e-6);
}
