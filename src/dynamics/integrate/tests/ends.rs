//! How runs end: on time, at breaks, by limits, by faults.

use super::problems::{Collapsing, Ending, Oscillator, Stepped, Swinging, Thrown};
use super::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

#[test]
fn every_method_lands_exactly_on_the_end_and_gives_the_same_results_twice() {
    let system = Oscillator::free(3.0);
    for method in Method::available() {
        for end in [1.0, 0.3 + 1e-13, 7.7] {
            let once = || run(&system, end, &[1.0, 0.0], &[], &ordinary(method, 0.03));
            let ((first, a), (second, b)) = (once(), once());
            assert_eq!(first.stop, Stop::Complete);
            assert_eq!(first.time, end, "{method}");
            assert!((a.ends.last().unwrap() - end).abs() <= f64::EPSILON * end);
            assert_eq!(first, second);
            assert_eq!(a.y, b.y);
            assert_eq!(a.samples, b.samples);
        }
    }
}

#[test]
fn a_run_that_does_not_start_at_zero_and_a_run_of_no_length() {
    let system = Oscillator::free(3.0);
    for method in Method::available() {
        let at = |start: f64, end: f64| {
            let mut keeper = Keeper::default();
            let outcome = integrate(
                &system,
                start,
                end,
                &[1.0, 0.0],
                &Modes::default(),
                &ordinary(method, 0.01),
                &FREE,
                &mut keeper,
            );
            (outcome, keeper)
        };
        let (outcome, keeper) = at(1e3, 1e3 + 1.0);
        assert_eq!(
            (outcome.stop, outcome.time),
            (Stop::Complete, 1e3 + 1.0),
            "{method}"
        );
        assert!((keeper.y[0] - 3.0f64.cos()).abs() < 1e-3, "{method}");
        let (outcome, keeper) = at(2.0, 2.0);
        assert_eq!((outcome.stop, outcome.time), (Stop::Complete, 2.0));
        assert!(keeper.ends.is_empty());
    }
}

#[test]
fn breaks_in_time_end_a_step_exactly_and_are_told_to_the_sink() {
    let system = Stepped {
        breaks: vec![0.1, 0.25, 0.25 + 1e-9, 0.7],
        accelerations: vec![1.0, -3.0, 1e6, 2.0, 0.5],
        scales: [1.0, 1.0],
    };
    for method in Method::available() {
        let (outcome, keeper) = run(&system, 1.0, &[0.0, 0.0], &[0], &ordinary(method, 0.05));
        assert_eq!(outcome.stop, Stop::Complete);
        assert_eq!(keeper.times(), system.breaks, "{method}");
        assert!(keeper.switches.iter().all(|s| s.1.is_none()));
        assert_eq!(outcome.statistics.switches, 0);
        let loose = matches!(method, Method::Bdf | Method::TrBdf2 | Method::Esdirk34);
        let error = (keeper.y[0] - system.exact(1.0)[0]).abs();
        assert!(
            error < if loose { 1e-4 } else { 1e-13 },
            "{method}: {error:e}"
        );
    }
}

/// Greatest error of the speed over the last step, relative.
#[derive(Default)]
struct LastSpeeds {
    /// Time and speed at the start of the leg, acceleration over it.
    leg: [f64; 3],
    worst: f64,
}

impl Sink for LastSpeeds {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        let [start, speed, acceleration] = self.leg;
        let mut y = [0.0; 2];
        for k in 0..=10 {
            let s = step.end * f64::from(k) / 10.0;
            step.state(s, &mut y);
            let expected = speed + acceleration * (step.start - start + s * step.length);
            self.worst = self.worst.max((y[1] / expected - 1.0).abs());
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.leg = [event.time, event.y[1], -3.0];
        self.worst = 0.0;
    }
}

#[test]
fn a_short_last_step_from_a_great_angle_keeps_its_speeds() {
    for rest in [1e-12, 1e-11, 1e-9, 1e-7, 1e-5] {
        let system = Stepped {
            breaks: vec![0.7],
            accelerations: vec![20.0, -3.0],
            scales: [1.0, 1.0],
        };
        for method in Method::available() {
            let (mut sink, modes) = (LastSpeeds::default(), Modes(vec![0]));
            let settings = ordinary(method, 0.05);
            let y0 = [1e4, 60.0];
            let end = 0.7 + rest;
            let outcome = integrate(&system, 0.0, end, &y0, &modes, &settings, &FREE, &mut sink);
            assert_eq!(outcome.stop, Stop::Complete);
            let loose = matches!(method, Method::Bdf | Method::TrBdf2 | Method::Esdirk34);
            let bound = if loose { 1e-6 } else { 1e-12 };
            assert!(sink.worst < bound, "{method}, {rest:e}: {:e}", sink.worst);
        }
    }
}

#[test]
fn a_signal_that_is_no_coordinate_stops_the_mechanism_where_it_should() {
    // u = sin t: u² rises above ¾ at t = π/3.
    let system = Swinging {
        damping: 0.0,
        limit: 0.75,
    };
    for method in Method::available() {
        let (outcome, _) = run(&system, 6.0, &[0.0, 1.0], &[0], &ordinary(method, 0.01));
        let expected = std::f64::consts::FRAC_PI_3;
        assert!(
            matches!(&outcome.stop, Stop::Physical(stop) if stop.name == "dead_position"),
            "{method}: {outcome:?}"
        );
        let within = if method == Method::TrBdf2 { 2e-3 } else { 1e-4 };
        assert!(
            (outcome.time - expected).abs() < within,
            "{method} {outcome:?}"
        );
    }
}

#[test]
fn not_a_number_ends_every_method_with_the_name_of_the_entry() {
    let system = Ending {
        end: 1.0,
        scales: [1.0, 1.0],
    };
    for method in Method::available() {
        let (outcome, keeper) = run(&system, 2.0, &[0.0, 0.0], &[], &ordinary(method, 0.01));
        let what = "mass 1: speed".to_owned();
        assert_eq!(outcome.stop, Stop::NotFinite { what }, "{method}");
        assert!(
            outcome.time > 0.9 && outcome.time <= 1.0,
            "{method}: {}",
            outcome.time
        );
        assert!(keeper.y.iter().all(|entry| entry.is_finite()));
    }
}

#[test]
fn a_start_that_is_no_number_ends_at_once() {
    let system = Oscillator::free(1.0);
    for method in Method::available() {
        for bad in [f64::NAN, f64::INFINITY] {
            let (outcome, _) = run(&system, 1.0, &[0.0, bad], &[], &ordinary(method, 0.01));
            assert!(matches!(outcome.stop, Stop::NotFinite { .. }), "{method}");
            assert_eq!(outcome.statistics.steps, 0);
        }
    }
}

fn limited(method: Method, limits: &Limits<'_>) -> Outcome {
    let mut keeper = Keeper::default();
    let system = Thrown::new(0.0, 0.5);
    integrate(
        &system,
        0.0,
        1.0,
        &[0.0, 1.0],
        &Modes(vec![0]),
        &settings(method, 1e-6, Some(0.01)),
        limits,
        &mut keeper,
    )
}

#[test]
fn limits_end_every_method_and_keep_what_was_computed() {
    let raised = AtomicBool::new(true);
    for method in Method::available() {
        let budget = Budget::interrupted_by(&raised);
        let outcome = limited(method, &Limits { budget, ..FREE });
        assert_eq!(outcome.stop, Stop::Interrupted, "{method}");
        assert!(outcome.time < 0.1);
        let outcome = limited(method, &Limits { steps: 20, ..FREE });
        assert_eq!(outcome.stop, Stop::TooManySteps { bound: 20 });
        assert_eq!(outcome.statistics.steps, 20);
        let outcome = limited(
            method,
            &Limits {
                switches: 0,
                ..FREE
            },
        );
        assert_eq!(outcome.stop, Stop::TooManySwitches { bound: 0 });
        assert!((outcome.time - 0.5).abs() < 1e-9);
        let limit = Duration::ZERO;
        let budget = Budget::FREE.within(limit);
        let outcome = limited(method, &Limits { budget, ..FREE });
        assert_eq!(outcome.stop, Stop::WallClock { limit });
    }
    raised.store(false, Ordering::Relaxed);
    let budget = Budget::interrupted_by(&raised);
    let outcome = limited(Method::Dopri5, &Limits { budget, ..FREE });
    assert_eq!(outcome.stop, Stop::Complete);
}

/// u = (1 − t)⁻²: the step has to follow the distance to t = 1.
#[test]
fn a_motion_that_collapses_ends_at_the_step_floor_or_beyond_all_numbers() {
    let system = Collapsing { scales: [1.0, 1.0] };
    for method in Method::available() {
        if method == Method::Rk4 {
            continue; // its step is fixed
        }
        let (outcome, _) = run(&system, 2.0, &[1.0, 2.0], &[], &ordinary(method, 0.01));
        assert!(
            !matches!(outcome.stop, Stop::Complete | Stop::TooManySteps { .. }),
            "{method}: {outcome:?}"
        );
        assert!((outcome.time - 1.0).abs() < 1e-3, "{method}: {outcome:?}");
        if matches!(method, Method::Dopri5 | Method::Dop853) {
            assert!(matches!(outcome.stop, Stop::StepFloor { step } if step < 1e-14));
        }
    }
}

#[test]
fn settings_that_make_no_sense_are_refused_with_a_reason() {
    let system = Oscillator::free(1.0);
    let stop =
        |end: f64, y0: &[f64], settings: &Settings| run(&system, end, y0, &[], settings).0.stop;
    let y0 = [1.0, 0.0];
    for (end, y0, bad, word) in [
        (1.0, &y0[..], settings(Method::Rk4, 1e-6, None), "step"),
        (1.0, &y0[..], settings(Method::Rk4, 1e-6, Some(0.0)), "step"),
        (
            1.0,
            &y0[..],
            settings(Method::Dopri5, 1e-6, Some(f64::NAN)),
            "step",
        ),
        (
            1.0,
            &y0[..],
            settings(Method::Dopri5, 1e-15, None),
            "tolerance",
        ),
        (
            1.0,
            &y0[..],
            settings(Method::Radau, f64::NAN, None),
            "tolerance",
        ),
        (
            f64::INFINITY,
            &y0[..],
            settings(Method::Radau, 1e-6, None),
            "inf",
        ),
        (
            1.0,
            &y0[..1],
            settings(Method::Dopri5, 1e-6, None),
            "entries",
        ),
    ] {
        let stop = stop(end, y0, &bad);
        assert!(
            matches!(&stop, Stop::Method { reason, .. } if reason.contains(word)),
            "{stop:?}"
        );
    }
    let tiny = settings(Method::Rk4, 1e-6, Some(1e-300));
    assert!(matches!(stop(1.0, &y0, &tiny), Stop::StepFloor { .. }));
}

/// Looks between the ends of steps up to a time, and then at the ends alone.
struct Until {
    time: f64,
    y: Vec<f64>,
}

impl Sink for Until {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.y = y.to_vec();
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        step.state(step.end, &mut self.y);
    }

    fn switch(&mut self, _: &SwitchEvent<'_>) {}

    fn reads_within_steps(&self, until: f64) -> bool {
        until <= self.time
    }
}

#[test]
fn where_nobody_looks_between_the_ends_of_steps_nothing_is_evaluated_there() {
    let system = Oscillator::free(30.0);
    let settings = settings(Method::Dop853, 1e-9, None);
    let run = |time: f64| {
        let mut sink = Until {
            time,
            y: Vec::new(),
        };
        let (y, modes) = ([1.0, 0.0], Modes::default());
        let outcome = integrate(&system, 0.0, 1.0, &y, &modes, &settings, &FREE, &mut sink);
        (outcome.statistics, sink.y)
    };
    let ((all, at_end), (some, _), (none, alike)) = (run(1.0), run(0.5), run(0.0));
    assert_eq!((all.steps, all.rejected), (none.steps, none.rejected));
    assert_eq!(all.evaluations, none.evaluations + 4 * all.steps);
    assert!(none.evaluations < some.evaluations && some.evaluations < all.evaluations);
    for (one, other) in at_end.iter().zip(&alike) {
        approx::assert_abs_diff_eq!(*one, *other, epsilon = 1e-11);
    }
}
