//! Flywheels against textbooks and against the steady motion itself.

use super::machines::{machine, number, question, reference};
use dam::steady::{FunctionKind, Mean, Profile, Question, find_steady_motion, flywheel};
use std::f64::consts::TAU;

#[test]
fn flywheels_of_a_textbook() {
    // R. S. Khurmi, J. K. Gupta, Theory of Machines, examples 16.1 and 16.3.
    let turns = TAU / 60.0;
    let (inertia, energy, speed) = (6500.0 * 1.8 * 1.8, 56e3, 120.0 * turns);
    let at = &mut |_: usize, phi: f64| [inertia, 0.5 * energy * phi.sin()];
    let profile = Profile::new(TAU, &[], FunctionKind::Work, at).unwrap();
    let question = Question {
        mean: Mean::Midrange,
        ..Question::new(speed)
    };
    let motion = find_steady_motion(&profile, &question).unwrap();
    let rpm = |speed: f64| (speed / turns).round();
    assert_eq!(rpm(motion.figures.greatest_speed.value), 121.0);
    assert_eq!(rpm(motion.figures.least_speed.value), 119.0);
    // 300 kW at 90 rpm, 10 % of the work of a turn as fluctuation, δ = 1 %, k = 2 m.
    let speed = 90.0 * turns;
    let fluctuation = 0.1 * 300e3 * TAU / speed;
    let found = flywheel::by_energy(fluctuation, 0.01, speed);
    assert_eq!((found / 4.0).round(), 5629.0);
    let at = &mut |_: usize, phi: f64| [1e-3, 0.5 * fluctuation * phi.sin()];
    let profile = Profile::new(TAU, &[], FunctionKind::Work, at).unwrap();
    let question = Question::new(speed);
    let (wheel, _) = flywheel::size_flywheel(&profile, &question, 0.01).unwrap();
    assert!(wheel.fluctuation_without.is_none());
    assert!((wheel.inertia / 4.0 - 5629.0).abs() < 1.0, "{wheel:?}");
}

#[test]
fn the_flywheel_of_the_press_is_exact_and_tangents_are_for_their_own_mean() {
    let file = reference();
    let case = &file["cases"][3];
    let profile = machine(case).profile().unwrap();
    for (mean, exact) in [(Mean::Midrange, true), (Mean::Time, false)] {
        let question = question(case, mean);
        let (wheel, motion) = flywheel::size_flywheel(&profile, &question, 0.1).unwrap();
        approx::assert_relative_eq!(wheel.fluctuation_with, 0.1, max_relative = 1e-9);
        approx::assert_relative_eq!(motion.figures.fluctuation, 0.1, max_relative = 1e-9);
        let expected = number(&case["continuous"][mean.name()]["delta"]);
        approx::assert_relative_eq!(
            wheel.fluctuation_without.unwrap(),
            expected,
            max_relative = 1e-9
        );
        let tangents = &wheel.approximations[2];
        let error = tangents.error.unwrap();
        assert_eq!(error.abs() < 1e-9, exact, "{mean:?}: {error:e}");
        println!("{mean:?}: {wheel:?}");
        let (none, _) = flywheel::size_flywheel(&profile, &question, 1.0).unwrap();
        assert_eq!(none.inertia, 0.0);
    }
    for bad in [0.0, -1.0, 2.0, f64::NAN] {
        assert!(flywheel::size_flywheel(&profile, &question(case, Mean::Time), bad).is_err());
    }
}
