//! What happens over a period, against other ways to it.

use super::scenes::scene;
use dam::exact::{Parts, Request};
use dam::studies::steady::{Answer, OverPeriod, PeriodicAnswer, steady_motion};
use dam::system::System;
use std::f64::consts::TAU;

fn periodic(name: &str, set: &[&str]) -> (System, PeriodicAnswer) {
    let (system, settings, spec) = scene(name, set);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Periodic(answer) => (system, *answer),
        Answer::Rigid(_) => panic!("{name} is elastic"),
    }
}

fn found(answer: &PeriodicAnswer) -> &OverPeriod {
    let missing = answer.over_period_missing.as_deref().unwrap_or_default();
    answer
        .over_period
        .as_ref()
        .unwrap_or_else(|| panic!("{missing}"))
}

#[test]
fn work_extremes_and_impacts_are_those_of_the_motion_in_closed_form() {
    for (name, object) in [
        ("valve_train/lift_off", "valve"),
        ("rocker/two_masses", "rocker"),
    ] {
        let (system, answer) = periodic(name, &[]);
        let found = found(&answer);
        assert!(
            answer.is_trusted() && found.checks.len() == 3,
            "{:?}",
            found.checks
        );
        let parts = Parts::of(&system);
        let tree = &parts.trees[0];
        let request = Request {
            figures: true,
            audit: true,
            ..Request::new(answer.turn, 0)
        };
        let run = tree.tree(&answer.state).run(&request).unwrap();
        // Instants of the events.
        let times: Vec<f64> = run.switches.iter().map(|switch| switch.time).collect();
        assert!(times.len() >= 4, "{times:?}");
        assert_eq!(found.events.len(), times.len());
        for (event, switch) in found.events.iter().zip(&run.switches) {
            approx::assert_abs_diff_eq!(event.time, switch.time, epsilon = 1e-10 * answer.turn);
            approx::assert_relative_eq!(event.speed, switch.speed.abs(), max_relative = 1e-7);
            let what = match switch.after.engaged() {
                true => "closes",
                false => "opens",
            };
            assert_eq!((event.what, event.object.as_str()), (what, object));
        }
        // Extremes.
        let own = found.objects.iter().find(|own| own.id == object).unwrap();
        let (figures, near) = (&run.figures[0], 1e-8);
        approx::assert_relative_eq!(own.delta_max, figures.delta_max, max_relative = near);
        approx::assert_relative_eq!(own.delta_min, figures.delta_min, max_relative = near);
        approx::assert_relative_eq!(own.peak_speed, figures.peak_speed, max_relative = near);
        approx::assert_relative_eq!(
            own.peak_reaction,
            figures.peak_reaction,
            max_relative = near
        );
        assert!(own.max_contact_force.is_some_and(|force| force > 0.0));
        // Work: what a period loses the drive puts in, and the loads are a constant force.
        let audit = run.audit.unwrap();
        let [drive] = &found.drives[..] else {
            panic!("{:?}", found.drives);
        };
        assert!(drive.work > 0.0);
        approx::assert_relative_eq!(drive.work, audit.drives, max_relative = near);
        approx::assert_relative_eq!(drive.work, found.works.dissipated, max_relative = near);
        approx::assert_relative_eq!(
            drive.mean_power * answer.turn,
            drive.work,
            max_relative = 1e-12
        );
    }
}

/// M = 800 N·m·(1 − ω/ω₀): over a turn ∮M dφ = 800 N·m·(2π − ∮ω dφ/ω₀), where the mean of ω over
/// the angle is that of tests/reference/steady.py.
#[test]
fn the_work_of_a_motor_is_that_of_its_law() {
    let (_, answer) = periodic("steady/press_elastic", &[]);
    let found = found(&answer);
    assert!(answer.is_trusted());
    let expected = 800.0 * TAU * (1.0 - 34.489_524_730_01 / (160.0 / 3.0));
    let [drive] = &found.drives[..] else {
        panic!("{:?}", found.drives);
    };
    approx::assert_relative_eq!(drive.work, expected, max_relative = 1e-8);
    // It covers the losses and the blow.
    assert_eq!(found.works.drives, 0.0);
    approx::assert_relative_eq!(
        found.works.loads,
        found.works.dissipated,
        max_relative = 1e-7
    );
    assert!(found.works.dissipated > 0.0 && found.works.dissipated < drive.work);
}

/// A mass on an undamped spring: its multipliers are exp(±i·ω₀·T).
#[test]
fn errors_of_multipliers_cover_what_they_are_off_by() {
    let (system, answer) = periodic("indexing/residual_vibration", &[]);
    let part = &answer.parts[0];
    let parts = Parts::of(&system);
    let mass = &parts.trees[0].problem().masses[0];
    let angle = (mass.stiffness / mass.inertia).sqrt() * part.period;
    for one in &part.multipliers {
        let off = (one.re - angle.cos()).hypot(one.im.abs() - angle.sin().abs());
        assert!(off <= one.error && one.error < 1e-9, "{one:?}: {off:e}");
    }
}
