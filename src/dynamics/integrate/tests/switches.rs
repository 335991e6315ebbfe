//! Switches: none lost, none twice, each where it belongs.

use super::problems::{Bouncing, Follow, Thrown};
use super::*;

fn close(found: &[f64], expected: &[f64], within: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= within, "{a} instead of {b}");
    }
}

/// The mass is above the level from 0.45 to 0.55 s: both crossings within one
/// step of 1 s, which is exact for every method of order two.
#[test]
fn two_crossings_within_one_step_are_both_found() {
    let gravity = 8.0;
    let level = 4.0 * 0.45 - 4.0 * 0.45 * 0.45;
    let system = Thrown::new(gravity, level);
    for method in Method::available() {
        let (outcome, keeper) = run(&system, 1.0, &[0.0, 4.0], &[0], &ordinary(method, 1.0));
        assert_eq!(outcome.stop, Stop::Complete);
        assert_eq!(outcome.statistics.switches, 2);
        let loose = matches!(method, Method::Bdf | Method::TrBdf2 | Method::Esdirk34);
        close(
            &keeper.times(),
            &[0.45, 0.55],
            if loose { 1e-5 } else { 1e-13 },
        );
        assert!((keeper.y[0]).abs() < if loose { 1e-5 } else { 1e-13 });
    }
}

#[test]
fn grazing_a_level_is_no_crossing_and_just_passing_it_is_two() {
    for (above, count) in [(1e-9, 0), (-1e-9, 2)] {
        let system = Thrown::new(8.0, 1.0 + above);
        for method in [Method::Rk4, Method::Dopri5, Method::Dop853] {
            let (outcome, keeper) = run(&system, 1.0, &[0.0, 4.0], &[0], &ordinary(method, 0.37));
            assert_eq!(outcome.statistics.switches, count, "{method}");
            if count == 2 {
                let half: f64 = (1e-9f64 / 4.0).sqrt();
                close(&keeper.times(), &[0.5 - half, 0.5 + half], 1e-10);
            }
        }
    }
    let exactly = Thrown::new(8.0, 1.0);
    let (outcome, _) = run(
        &exactly,
        1.0,
        &[0.0, 4.0],
        &[0],
        &ordinary(Method::Rk4, 0.25),
    );
    assert_eq!(outcome.statistics.switches, 0, "touching is not passing");
}

#[test]
fn a_switch_at_the_end_of_a_step_or_of_the_run_is_found_once() {
    // u = t: the level ½ is reached exactly at the end of the second step.
    let system = Thrown::new(0.0, 0.5);
    let fixed = settings(Method::Rk4, 1e-6, Some(0.25));
    for end in [0.5, 1.0] {
        let (outcome, keeper) = run(&system, end, &[0.0, 1.0], &[0], &fixed);
        assert_eq!(outcome.statistics.switches, 1, "end {end}");
        assert_eq!(keeper.times(), [0.5]);
        assert_eq!(outcome.time, end);
    }
}

#[test]
fn a_switch_just_after_the_start_is_found() {
    let system = Thrown::new(0.0, 1e-12);
    for method in Method::available() {
        let (_, keeper) = run(&system, 1.0, &[0.0, 1.0], &[0], &ordinary(method, 0.5));
        close(&keeper.times(), &[1e-12], 1e-16);
    }
}

#[test]
fn a_guard_violated_from_the_start_switches_at_the_start() {
    let system = Thrown::new(0.0, 0.5);
    let (_, keeper) = run(
        &system,
        1.0,
        &[2.0, 0.0],
        &[0],
        &ordinary(Method::Dopri5, 0.5),
    );
    assert_eq!(keeper.times(), [0.0]);
    assert!(keeper.ends.iter().all(|&end| end > 0.0), "no empty steps");
}

#[test]
fn a_switch_that_brings_another_makes_both_at_one_instant() {
    let system = Thrown {
        follow: Follow::Second,
        ..Thrown::new(0.0, 0.3)
    };
    for method in Method::available() {
        let (_, keeper) = run(&system, 1.0, &[0.0, 1.0], &[0, 0], &ordinary(method, 0.5));
        let components: Vec<_> = keeper.switches.iter().map(|s| s.1).collect();
        assert_eq!(components, [Some(0), Some(1)], "{method}");
        assert_eq!(keeper.switches[0].0, keeper.switches[1].0);
    }
}

#[test]
fn switching_to_and_fro_for_ever_ends_the_run_with_a_word() {
    let system = Thrown {
        follow: Follow::Back,
        ..Thrown::new(0.0, 0.3)
    };
    for method in Method::available() {
        let (outcome, _) = run(&system, 1.0, &[0.0, 1.0], &[0], &ordinary(method, 0.5));
        assert!(
            matches!(&outcome.stop, Stop::Method { reason, .. } if reason.contains("to and fro")),
            "{method}: {:?}",
            outcome.stop
        );
        assert!((outcome.time - 0.3).abs() < 1e-6);
    }
}

/// A mass that falls on a spring again and again: every switch in closed form.
#[test]
fn switch_times_of_a_bouncing_mass_agree_with_the_closed_form() {
    let system = Bouncing::new(1, 9.81, 2e3);
    let expected = system.switch_times(0.02, 1.0);
    assert!(expected.len() > 12);
    for (method, tolerance, within) in [
        (Method::Dopri5, 1e-12, 1e-11),
        (Method::Dop853, 1e-12, 1e-11),
        (Method::Dop853, 1e-9, 1e-8),
        (Method::Bdf, 1e-8, 1e-5),
        (Method::Esdirk34, 1e-8, 1e-5),
        (Method::TrBdf2, 1e-8, 1e-4),
    ] {
        if !method.is_available() {
            continue;
        }
        let (outcome, keeper) = run(
            &system,
            1.0,
            &[0.02, 0.0],
            &[0],
            &settings(method, tolerance, None),
        );
        assert_eq!(outcome.stop, Stop::Complete);
        close(&keeper.times(), &expected, within);
    }
}

/// Two equal masses dropped together: each switch comes twice at one time, the
/// lower component first although the event_functions are listed the other way round.
#[test]
fn simultaneous_switches_come_in_order_of_component() {
    let system = Bouncing::new(2, 9.81, 2e3);
    let expected = system.switch_times(0.02, 0.4);
    for method in [Method::Dopri5, Method::Dop853] {
        let (_, keeper) = run(
            &system,
            0.4,
            &[0.02, 0.02, 0.0, 0.0],
            &[0, 0],
            &settings(method, 1e-12, None),
        );
        assert_eq!(keeper.switches.len(), 2 * expected.len());
        for (pair, time) in keeper.switches.chunks(2).zip(&expected) {
            assert_eq!((pair[0].1, pair[1].1), (Some(0), Some(1)), "{method}");
            assert!((pair[0].0 - time).abs() < 1e-11);
            assert!((pair[1].0 - pair[0].0).abs() < 1e-15);
        }
    }
}

/// Energy without damping: 0.02·9.81 per unit mass at the top of every flight.
#[test]
fn bouncing_without_damping_keeps_its_energy() {
    let system = Bouncing::new(1, 9.81, 2e3);
    let tight = settings(Method::Dop853, 1e-11, None);
    let (_, keeper) = run(&system, 2.0, &[0.02, 0.0], &[0], &tight);
    let [u, v] = [keeper.y[0], keeper.y[1]];
    let elastic = 0.5 * (2e3 * u.min(0.0)).powi(2);
    let energy = 0.5 * v * v + 9.81 * u + elastic;
    approx::assert_relative_eq!(energy, 9.81 * 0.02, max_relative = 1e-9);
}
