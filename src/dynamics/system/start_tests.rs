//! Tests of the state at t = 0.

use super::testing::*;
use super::testing_random::*;
use super::{InitialState, System};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::laws::LawInstance;
use crate::dynamics::model::*;
use crate::kinematics::position::Position;
use std::f64::consts::PI;

fn started(model: Model) -> InitialState {
    System::new(model).unwrap().initial_state().unwrap()
}

fn form(gap: f64) -> Pair {
    Pair {
        gap,
        ..pair(Closure::Form)
    }
}

const FORCE: Closure = Closure::Force;

/// A chain behind a shaft at constant speed: the law has no acceleration.
fn steady_chain(masses: usize, psi: f64, moment: f64, pair: Pair, start: Start) -> Model {
    let mut model = Model {
        start,
        ..Model::default()
    };
    let drive = add_drive(&mut model, 3.0, 0.2);
    let body = Body {
        position: Position::Ratio {
            ratio: 0.5,
            offset: 0.0,
        },
        ..rocker_body(masses, psi, pair)
    };
    let body = add_body(&mut model, drive, &body);
    add_load(
        &mut model,
        body,
        masses - 1,
        "end",
        LoadLaw::constant(moment),
    );
    model
}

#[test]
fn the_static_rocker_rests_on_its_lower_flank() {
    for masses in [1, 2, 10] {
        let start = started(rocker(masses, 0.4, -600.0, pair(FORCE), Start::Static));
        assert_eq!(start.modes.0, [-1]);
        for m in 0..masses {
            let deflection = -600.0 * (m + 1) as f64 / (masses as f64 * 1e7);
            approx::assert_relative_eq!(start.y[m], deflection, max_relative = 1e-14);
            assert_eq!(start.y[masses + m], 0.0);
        }
        // The law is straight at φ = 0: no inertia load is left out.
        assert!(start.warnings.is_empty(), "{:?}", start.warnings);
    }
}

#[test]
fn on_its_law_a_short_chain_closes_and_a_long_one_opens() {
    // The law falls behind as A·Ω³t³/6 > 0; the moment on mass n reaches mass 1
    // at order 2n undamped, n + 1 damped.
    let cases = [
        (1, 0.0, -1),
        (1, 0.4, -1),
        (2, 0.0, 0),
        (2, 0.4, -1),
        (3, 0.4, 0),
        (10, 0.0, 0),
        (10, 0.4, 0),
    ];
    for (masses, psi, mode) in cases {
        let start = started(rocker(masses, psi, -600.0, pair(FORCE), Start::OnLaw));
        assert_eq!(start.modes.0, [mode], "{masses} masses, ψ = {psi}");
        assert!(start.y.iter().all(|&entry| entry == 0.0));
    }
}

#[test]
fn on_a_law_without_acceleration_the_wave_of_the_load_decides() {
    for masses in [1, 2, 3, 10] {
        for (psi, moment, mode) in [
            (0.0, -5.0, -1),
            (0.4, -5.0, -1),
            (0.0, 5.0, 0),
            (0.4, 5.0, 0),
        ] {
            let model = steady_chain(masses, psi, moment, pair(FORCE), Start::OnLaw);
            assert_eq!(started(model).modes.0, [mode]);
            let turned = Pair {
                opens: -1.0,
                ..pair(FORCE)
            };
            let model = steady_chain(masses, psi, -moment, turned, Start::OnLaw);
            assert_eq!(started(model).modes.0, [-mode]);
            // A groove without play is on one flank or the other.
            let model = steady_chain(masses, psi, moment, form(0.0), Start::OnLaw);
            assert_eq!(started(model).modes.0, [moment.signum() as i64]);
        }
    }
}

#[test]
fn a_form_pair_rests_on_the_flank_that_its_load_presses() {
    let gap = 1e-3;
    for moment in [-600.0, 600.0f64] {
        let start = started(steady_chain(1, 0.4, moment, form(gap), Start::Static));
        assert_eq!(start.modes.0, [moment.signum() as i64]);
        let x = moment.signum() * (gap / 2.0 + 600.0 / 1e7);
        approx::assert_relative_eq!(start.y[0], x, max_relative = 1e-14);
    }
    // Nothing on it: the middle of the gap, open.
    let start = started(steady_chain(2, 0.4, 0.0, form(gap), Start::Static));
    assert_eq!((start.modes.0, start.y), (vec![0], vec![0.0; 4]));
    // Loads that cancel, one on each mass: open, but the chain is strained.
    let mut model = steady_chain(2, 0.4, 0.3, form(gap), Start::Static);
    add_load(&mut model, 1, 0, "counter", LoadLaw::constant(-0.1));
    add_load(&mut model, 1, 0, "counter", LoadLaw::constant(-0.2));
    let start = started(model);
    assert_eq!((start.modes.0[0], start.y[0]), (0, 0.0));
    approx::assert_relative_eq!(start.y[1], 0.3 / 2e7, max_relative = 1e-12);
}

#[test]
fn a_load_that_pulls_a_force_pair_open_is_named() {
    let mut model = rocker(2, 0.4, 600.0, pair(FORCE), Start::Static);
    add_load(&mut model, 1, 1, "light", LoadLaw::constant(-10.0));
    let faults = System::new(model).unwrap().initial_state().unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].path, "body1.loads.closing");
    assert!(
        faults[0].message.contains("no static balance"),
        "{}",
        faults[0].message
    );
}

#[test]
fn inertia_that_a_static_start_leaves_out_is_warned_of() {
    let mut model = rocker(2, 0.4, -900.0, pair(FORCE), Start::Static);
    model.nodes[0].motion = NodeMotion::Prescribed {
        motion: crate::kinematics::motion::DriveMotion::Constant {
            speed: 20.0 * PI,
            angle: PI / 2.0,
        },
        track: None,
    };
    let start = started(model.clone());
    assert_eq!(start.warnings.len(), 1);
    assert!(
        start.warnings[0].contains("620.13 N m"),
        "{}",
        start.warnings[0]
    );
    // With it, the pair carries 900 − 620 N·m; with 600 it would be pulled open.
    model.start = Start::Kinetostatic;
    let start = started(model.clone());
    let force = -900.0 + 0.1 * PI / 2.0 * (20.0 * PI).powi(2);
    approx::assert_relative_eq!(start.y[0], force / 2e7, max_relative = 1e-12);
    model.loads[0].law = LoadLaw::constant(-600.0);
    let faults = System::new(model).unwrap().initial_state().unwrap_err();
    assert!(
        faults[0].message.contains("inertia load"),
        "{}",
        faults[0].message
    );
}

#[test]
fn the_kinetostatic_start_is_quiet() {
    for angle in [0.3, 1.2, 4.0] {
        let mut model = Model::default();
        let drive = add_drive(&mut model, 20.0, angle);
        let first = add_body(
            &mut model,
            drive,
            &rocker_body(3, 0.0, pair(Closure::Bilateral)),
        );
        let second = add_body(&mut model, first, &rocker_body(2, 0.0, form(1e-4)));
        add_load(&mut model, second, 1, "spring", LoadLaw::spring(1e4, 5e4));
        let system = System::new(model.clone()).unwrap();
        let start = system.initial_state().unwrap();
        let mut dy = vec![0.0; start.y.len()];
        system.derivatives(0.0, &start.y, &start.modes, &mut system.scratch(), &mut dy);
        // Speeds are those of the balance a little later, less a little earlier.
        let n = system.coordinates();
        let at = |time: f64| {
            let mut model = model.clone();
            model.nodes[0].motion = NodeMotion::Prescribed {
                motion: crate::kinematics::motion::DriveMotion::Constant {
                    speed: 20.0,
                    angle: angle + 20.0 * time,
                },
                track: None,
            };
            started(model).y
        };
        let step = 1e-6;
        let (after, before) = (at(step), at(-step));
        // On the law alone the accelerations left would be some 10⁵ rad/s².
        for i in 0..n {
            let difference = (after[i] - before[i]) / (2.0 * step);
            approx::assert_relative_eq!(
                start.y[n + i],
                difference,
                max_relative = 1e-5,
                epsilon = 1e-9
            );
            assert!(dy[n + i].abs() < 30.0, "{}", dy[n + i]);
        }
    }
}

#[test]
fn a_motor_driven_start_takes_the_motors_acceleration_into_account() {
    let mut model = Model::default();
    let motor = add_rotor(&mut model, 2.0, 0.4, 10.0);
    let body = Body {
        inertias: vec![0.05, 0.1],
        ..rocker_body(2, 0.0, pair(Closure::Bilateral))
    };
    add_body(&mut model, motor, &body);
    let torque = LawInstance::linear_motor(500.0, 100.0).law();
    add_load(&mut model, motor, 0, "torque", torque);
    let system = System::new(model).unwrap();
    let start = system.initial_state().unwrap();
    // Rigid: (J_r + J·U′²)·φ̈ = T − J·U′·U″·φ̇².
    let amplitude = PI / 2.0;
    let (u1, u2) = (amplitude * 0.4f64.cos(), -amplitude * 0.4f64.sin());
    let acceleration = (450.0 - 0.15 * u1 * u2 * 100.0) / (2.0 + 0.15 * u1 * u1);
    let force = -0.15 * (u2 * 100.0 + u1 * acceleration);
    assert_eq!((start.y[0], start.y[3]), (0.4, 10.0));
    approx::assert_relative_eq!(start.y[1], force / 2e7, max_relative = 1e-5);
    let mut dy = vec![0.0; 6];
    system.derivatives(0.0, &start.y, &start.modes, &mut system.scratch(), &mut dy);
    approx::assert_relative_eq!(dy[3], acceleration, max_relative = 1e-3);
    assert!(dy[4].abs() < 1.0 && dy[5].abs() < 1.0, "{dy:?}");
}

#[test]
fn a_motor_at_rest_on_an_edge_leaves_it_by_its_torque() {
    for (torque, segment) in [(3.0, 1), (-3.0, 0)] {
        let mut model = Model::default();
        let motor = add_rotor(&mut model, 1.0, 0.0, 0.0);
        let position = Position::Custom(std::sync::Arc::new(TwoPieces));
        let body = Body {
            position,
            ..rocker_body(1, 0.4, pair(Closure::Bilateral))
        };
        add_body(&mut model, motor, &body);
        add_load(&mut model, motor, 0, "torque", LoadLaw::constant(torque));
        assert_eq!(started(model).modes.0, [segment]);
    }
}

#[test]
fn explicit_starts_are_absolute() {
    let mut model = rocker(2, 0.4, -600.0, pair(FORCE), Start::Static);
    let follower = add_body(&mut model, 1, &rocker_body(1, 0.4, pair(FORCE)));
    model.start = Start::Explicit(vec![
        ExplicitStart {
            object: follower,
            displacement: vec![0.7],
            speed: vec![-2.0],
        },
        ExplicitStart {
            object: 1,
            displacement: vec![-1e-4, 0.5],
            speed: vec![100.0, 90.0],
        },
    ]);
    let system = System::new(model.clone()).unwrap();
    let start = system.initial_state().unwrap();
    let mut out = vec![super::ObjectState::default(); 3];
    system.observe(0.0, &start.y, &start.modes, &mut system.scratch(), &mut out);
    approx::assert_relative_eq!(out[follower].displacement, 0.7, max_relative = 1e-14);
    approx::assert_relative_eq!(out[follower].speed, -2.0, max_relative = 1e-12);
    approx::assert_relative_eq!(out[1].displacement, 0.5, max_relative = 1e-14);
    approx::assert_relative_eq!(out[1].speed, 90.0, max_relative = 1e-14);
    // x < 0 but parting fast enough that the damper would pull: open.
    approx::assert_relative_eq!(start.y[0], -1e-4, max_relative = 1e-12);
    let wrong = |displacement: Vec<f64>, speed: Vec<f64>, object| {
        let mut model = model.clone();
        model.start = Start::Explicit(vec![ExplicitStart {
            object,
            displacement,
            speed,
        }]);
        System::new(model).unwrap().initial_state().unwrap_err()
    };
    assert!(
        wrong(vec![0.1], vec![0.1], 1)[0]
            .message
            .contains("for 2 masses")
    );
    assert!(
        wrong(vec![f64::NAN], vec![0.1], 2)[0]
            .message
            .contains("not finite")
    );
    assert!(
        wrong(vec![0.1], vec![0.1], 0)[0]
            .message
            .contains("no state of its own")
    );
}

#[test]
fn an_explicit_start_at_contact_is_decided_by_its_speed() {
    let beginning = |excess: f64| {
        let mut model = rocker(1, 0.4, -600.0, pair(FORCE), Start::Static);
        model.start = Start::Explicit(vec![ExplicitStart {
            object: 1,
            displacement: vec![0.0],
            speed: vec![PI / 2.0 * 20.0 * PI + excess],
        }]);
        started(model).modes.0[0]
    };
    assert_eq!((beginning(1e-3), beginning(-1e-3)), (0, -1));
    // On the law up to rounding: the load decides.
    assert_eq!((beginning(1e-15), beginning(-1e-15)), (-1, -1));
}

#[test]
fn hunt_crossley_finds_its_constant_from_the_static_penetration() {
    let form = ContactForm::Proportional(Loss::FactorOfDamper);
    let contact = Pair {
        form,
        ..pair(FORCE)
    };
    let system = System::new(rocker(1, 0.4, -600.0, contact, Start::Static)).unwrap();
    let damping = rocker_body(1, 0.4, contact).dampings[0];
    let kappa = system.frozen.chains[0].contact.kappa.unwrap();
    approx::assert_relative_eq!(kappa, damping / 600.0, max_relative = 1e-12);
    let faults = System::new(rocker(1, 0.4, 0.0, contact, Start::Static)).unwrap_err();
    assert_eq!(faults[0].path, "body1.pair.kappa");
}

#[test]
fn random_mechanisms_start_or_say_why_not() {
    let mut random = Random(9);
    let mut count = 0;
    for round in 0..200 {
        let mut model = random_model(&mut random);
        model.start = [Start::Kinetostatic, Start::Static, Start::OnLaw][round % 3].clone();
        let system = System::new(model).unwrap();
        match system.initial_state() {
            Ok(start) => {
                count += 1;
                assert!(start.y.iter().all(|entry| entry.is_finite()));
                let mut event_functions = Vec::new();
                system.event_functions(&start.modes, &mut event_functions);
            }
            Err(faults) => assert!(faults.iter().all(|fault| !fault.message.is_empty())),
        }
    }
    assert!(count > 100, "{count}");
}
