//! What happens over a period, against other ways to it.

use super::scenes::{of_text, scene};
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

/// A follower of 1 kg with a rigid contact behind two drives that a differential adds up, and a
/// mass between its law and a rigid stop.
const STRIKING: &str = r#"{ "dam": 1, "name": "striking", "objects": {
    "one": { "kind": "drive", "motion": { "speed": "600 rpm" } },
    "two": { "kind": "drive", "motion": { "speed": "600 rpm" } },
    "sum": { "kind": "differential", "masses": 0, "inertia": 0.01,
        "inputs": { "one": { "object": "one", "ratio": 0.75 }, "two": { "object": "two", "ratio": 0.25 } } },
    "follower": FOLLOWER },
    "run": { "duration": 1 } }"#;
const LIFTED: &str = r#"{ "kind": "cam_follower", "input": "sum", "motion": "sliding", "masses": 0, "inertia": "1 kg",
    "pair": { "closure": "force", "contact": { "restitution": 0.3 } },
    "position": { "sine": { "amplitude": "10 mm", "phase": "-90 deg", "offset": "10 mm" } },
    "loads": { "spring": { "constant": "-30 N" } } }"#;
const STOPPED: &str = r#"{ "kind": "slider", "input": "sum", "masses": 1, "inertia": "1 kg", "stiffness": "40 N/mm",
    "damping_capacity": 0.3, "stops": { "seat": { "at": "19 mm", "side": "+", "contact": { "restitution": 0.4 } } },
    "position": { "sine": { "amplitude": "10 mm", "phase": "-90 deg", "offset": "10 mm" } } }"#;

/// Of an impact of 1 kg at the speed w on what moves on as before, ½·(1 − e²)·w² is lost; of that
/// at which it comes to rest there, all. The drives put it in, each by its share of the speed.
#[test]
fn drives_do_their_work_in_impacts_too() {
    for (follower, restitution, impacts_alone) in [(LIFTED, 0.3, true), (STOPPED, 0.4, false)] {
        let (system, settings, spec) = of_text(&STRIKING.replace("FOLLOWER", follower), &[]);
        let answer = steady_motion(&system, &settings, &spec).unwrap();
        let Answer::Periodic(answer) = answer else {
            panic!("not rigid");
        };
        let found = found(&answer);
        assert!(
            found.checks.iter().all(|check| check.passed()),
            "{:?}",
            found.checks
        );
        let impacts = found.events.iter().filter(|event| event.what == "impact");
        let speeds: Vec<f64> = impacts.map(|event| event.speed).collect();
        assert!(speeds.len() > 10 && speeds[0] > 0.1);
        let lost: f64 = speeds.iter().map(|speed| 0.5 * speed * speed).sum();
        let lost = lost * (1.0 - restitution * restitution);
        // (The last one, at which it comes to rest, is below a micrometre a second.)
        approx::assert_relative_eq!(found.works.impacts, lost, max_relative = 1e-9);
        assert_eq!(found.works.dissipated == 0.0, impacts_alone);
        let [one, two] = &found.drives[..] else {
            panic!("{:?}", found.drives);
        };
        let work = one.work + two.work;
        approx::assert_relative_eq!(work, lost + found.works.dissipated, max_relative = 1e-7);
        approx::assert_relative_eq!(one.work, 3.0 * two.work, max_relative = 1e-9);
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
