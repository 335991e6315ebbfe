//! Expansions of random systems against the equations of motion themselves.

use super::super::System;
use super::super::testing_random::*;
use crate::dynamics::integrate::Dynamics;

/// The expanded motion satisfies u″ = a(t, u, u′) where it is relied on, in
/// any system, state and modes.
#[test]
fn expanded_motions_satisfy_the_equations() {
    const DEGREE: usize = 16;
    let mut random = Random(11);
    let mut expanded = 0;
    for _ in 0..400 {
        let system = System::new(random_model(&mut random)).unwrap();
        let n = system.coordinates();
        if n == 0 || !system.expands() {
            continue;
        }
        let (y, modes) = (
            random_state(&system, &mut random),
            random_modes(&system, &mut random),
        );
        let (time, mut scratch) = (0.3, system.scratch());
        let (mut dy, width) = (vec![0.0; 2 * n], DEGREE + 1);
        system.derivatives(time, &y, &modes, &mut scratch, &mut dy);
        let mut out = vec![0.0; system.signals() * width];
        // A hundredth of what the fastest part of the system does in a radian.
        let rate = crate::dynamics::integrate::fastest_rate(&system, time, &y, &modes);
        let length = 0.02 / rate.max(1.0);
        let way = system.expand(
            [time, length],
            &y,
            &dy,
            &modes,
            DEGREE,
            &mut scratch,
            &mut out,
        );
        assert!(way.is_finite(), "{way}");
        let at = |k: usize, s: f64, derivative: i32| -> f64 {
            let row = &out[k * width..(k + 1) * width];
            let term = |(i, c): (usize, &f64)| {
                let i = i as i32;
                match derivative {
                    0 => c * s.powi(i),
                    1 if i > 0 => f64::from(i) * c * s.powi(i - 1) / length,
                    2 if i > 1 => f64::from(i * (i - 1)) * c * s.powi(i - 2) / length.powi(2),
                    _ => 0.0,
                }
            };
            row.iter().enumerate().map(term).sum()
        };
        for s in [0.0, 0.5, 1.0].map(|share: f64| share / way.max(1.0)) {
            let state: Vec<f64> = (0..n)
                .map(|k| at(k, s, 0))
                .chain((0..n).map(|k| at(k, s, 1)))
                .collect();
            let mut there = vec![0.0; 2 * n];
            system.derivatives(time + s * length, &state, &modes, &mut scratch, &mut there);
            let size = dy[n..]
                .iter()
                .chain(&there[n..])
                .fold(0.0f64, |a, x| a.max(x.abs()));
            for k in 0..n {
                let found = at(k, s, 2);
                let error = (found - there[n + k]).abs();
                assert!(
                    error <= 1e-9 * (1.0 + size),
                    "s {s}: {found} {}",
                    there[n + k]
                );
            }
        }
        expanded += 1;
    }
    assert!(expanded > 150, "{expanded}");
}

/// The pattern holds every entry of the Jacobian, in any state and modes.
#[test]
fn no_entry_of_the_jacobian_is_outside_its_pattern() {
    let mut random = Random(5);
    let mut outside = 0;
    for _ in 0..400 {
        let system = System::new(random_model(&mut random)).unwrap();
        let n = system.coordinates();
        let pattern = system.pattern();
        let (y, modes) = (
            random_state(&system, &mut random),
            random_modes(&system, &mut random),
        );
        let (mut scratch, mut out) = (system.scratch(), vec![0.0; 2 * n]);
        for column in 0..2 * n {
            let mut direction = vec![0.0; 2 * n];
            direction[column] = 1.0;
            system.tangent(0.3, &y, &modes, &direction, &mut scratch, &mut out);
            let size = out[n..].iter().fold(0.0f64, |a, x| a.max(x.abs()));
            for row in 0..n {
                if !pattern[row].contains(&(column % n)) {
                    outside += 1;
                    // What cancels leaves rounding.
                    assert!(out[n + row].abs() <= 1e-12 * size, "{row} {column}");
                }
            }
        }
    }
    assert!(outside > 100, "{outside}");
}
