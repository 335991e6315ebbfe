//! Contact force, lift-off and springs.

use crate::kinematics::cam::closing::{ClosingSpring, ClosureProblem, Demand, LetsGo};
use std::f64::consts::{PI, TAU};

const TURN: [[f64; 2]; 1] = [[0.0, TAU]];

/// A mass m on an eccentric of e, U = e·(1 − cos φ), damped by b, loaded by f.
fn eccentric(mass: f64, e: f64, damping: f64, load: f64) -> impl Fn(usize, f64) -> Demand {
    move |_, phi: f64| Demand {
        by_square: mass * e * phi.cos(),
        by_speed: damping * e * phi.sin(),
        fixed: load,
        stretch: e * (1.0 - phi.cos()),
        lever: 1.0,
    }
}

#[test]
fn the_follower_of_an_eccentric_jumps_at_52_30_rpm() {
    // m 1 kg, spring 10 N/m, preload 0.2 N, eccentricity 20 mm: ω² = (2ke + P)/(me).
    let demand = eccentric(1.0, 0.02, 0.0, 0.0);
    let closing = ClosureProblem::new(&TURN, &demand);
    let spring = ClosingSpring {
        rate: 10.0,
        preload: 0.2,
    };
    let LetsGo::At(found) = closing.separation_speed(spring, 1.0) else {
        panic!("it jumps");
    };
    approx::assert_relative_eq!(found.value, 30f64.sqrt(), max_relative = 1e-14);
    approx::assert_abs_diff_eq!(found.phi, PI, epsilon = 1e-7);
    let rpm = found.value * 60.0 / TAU;
    assert!((rpm - 52.30).abs() < 0.005, "{rpm}");
    approx::assert_abs_diff_eq!(
        closing.least_force(spring, found.value).value,
        0.0,
        epsilon = 1e-15
    );
    // The spring that keeps contact there is the one it has.
    let preload = closing.preload_for(10.0, found.value, 0.0);
    approx::assert_relative_eq!(preload.value, 0.2, max_relative = 1e-13);
    let rates = closing.rates_for(0.2, found.value, 0.0).unwrap();
    approx::assert_relative_eq!(rates.from, 10.0, max_relative = 1e-11);
    assert_eq!(rates.to, None);
}

#[test]
fn damping_moves_the_jump_to_the_root_of_its_quadratic() {
    let demand = eccentric(2.0, 0.01, 3.0, 1.5);
    let closing = ClosureProblem::new(&TURN, &demand);
    let spring = ClosingSpring {
        rate: 40.0,
        preload: 0.5,
    };
    for sense in [1.0, -1.0] {
        let LetsGo::At(found) = closing.separation_speed(spring, sense) else {
            panic!("it jumps");
        };
        let least = closing.least_force(spring, sense * found.value);
        approx::assert_abs_diff_eq!(least.value, 0.0, epsilon = 1e-13);
        let slower = closing.least_force(spring, sense * found.value * 0.999);
        assert!(slower.value > 0.0);
        // The place moves to where the follower comes back.
        assert!((found.phi - PI) * sense > 0.01, "{found:?}");
    }
}

#[test]
fn what_is_open_at_rest_and_what_never_opens_is_said() {
    let pulled = eccentric(1.0, 0.02, 0.0, -1.0);
    let closing = ClosureProblem::new(&TURN, &pulled);
    let weak = ClosingSpring {
        rate: 0.0,
        preload: 0.75,
    };
    assert!(matches!(closing.separation_speed(weak, 1.0), LetsGo::AtRest(at) if at.value == 0.25));
    let massless = eccentric(0.0, 0.02, 0.0, 1.0);
    let closing = ClosureProblem::new(&TURN, &massless);
    assert_eq!(closing.separation_speed(weak, 1.0), LetsGo::Never);
    let loose = ClosingSpring::default();
    let free = eccentric(1.0, 0.02, 0.0, 0.0);
    let closing = ClosureProblem::new(&TURN, &free);
    assert!(matches!(closing.separation_speed(loose, 1.0), LetsGo::At(at) if at.value == 0.0));
}

#[test]
fn rates_form_an_interval_and_a_hopeless_spring_is_refused() {
    // Stretch of both signs: at φ = 0 too stiff a spring pulls the pair open.
    let demand = |_: usize, phi: f64| Demand {
        by_square: phi.cos(),
        stretch: -phi.cos() + 0.2,
        ..Demand::default()
    };
    let closing = ClosureProblem::new(&TURN, &demand);
    let (speed, preload) = (2.0, 3.0);
    let rates = closing.rates_for(preload, speed, 0.0).unwrap();
    // At φ = π: 1.2·c ≥ 1; at φ = 0: 4 + 3 ≥ 0.8·c; between, P is linear in cos φ.
    approx::assert_relative_eq!(rates.from, 1.0 / 1.2, max_relative = 1e-11);
    approx::assert_relative_eq!(rates.to.unwrap(), 7.0 / 0.8, max_relative = 1e-11);
    let least = |rate| {
        closing
            .least_force(ClosingSpring { rate, preload }, speed)
            .value
    };
    assert!(least(rates.from).abs() < 1e-10 && least(5.0) > 0.0);
    // No stretch where it opens: no rate helps, and the force lacking is said.
    let stiff = |_: usize, phi: f64| Demand {
        by_square: phi.cos(),
        stretch: 1.0 + phi.cos(),
        ..Demand::default()
    };
    let closing = ClosureProblem::new(&TURN, &stiff);
    let none = closing.rates_for(3.0, speed, 0.5).unwrap_err();
    approx::assert_relative_eq!(none.lacking.value, 1.5, max_relative = 1e-9);
    assert!((none.lacking.phi - PI).abs() < 1e-3);
}

#[test]
fn a_long_dwell_hides_no_greater_place() {
    // A spring without preload and ten pieces, most of them at rest at nothing; of one the
    // inertia exceeds the spring by a little near one place, between the samples.
    let pieces: Vec<[f64; 2]> = (0..10)
        .map(|k| [f64::from(k), f64::from(k) + 1.0])
        .collect();
    let demand = |piece: usize, phi: f64| match piece {
        7 => {
            let x = phi - 7.0;
            Demand {
                by_square: -1.0001 * (-((x - 0.4183) / 0.02).powi(2)).exp(),
                stretch: (-((x - 0.4183) / 0.04).powi(2)).exp(),
                ..Demand::default()
            }
        }
        _ => Demand::default(),
    };
    let closing = ClosureProblem::new(&pieces, &demand);
    let rate = 1.0;
    let least = closing.least_force(ClosingSpring { rate, preload: 0.0 }, 1.0);
    approx::assert_relative_eq!(least.value, -1e-4, max_relative = 1e-9);
    approx::assert_abs_diff_eq!(least.phi, 7.4183, epsilon = 1e-6);
}
