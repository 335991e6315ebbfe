//! Verdicts on runs that ended in every way.

use super::super::light::{TimedRun, Trace};
use super::super::setting::Setting;
use super::{Attempt, Verdict, axis, judge, switches};
use crate::dynamics::integrate::{Method, Outcome, Statistics, Stop};

/// A run that ended so, after these switches (s).
fn attempt(stop: Stop, switches: Vec<f64>) -> Attempt {
    Attempt {
        method: Method::Dop853,
        setting: Setting::Tolerance(1e-6),
        timed: Some(TimedRun {
            trace: Trace {
                switches,
                ..Trace::EMPTY
            },
            outcome: Outcome {
                time: 0.25,
                stop,
                statistics: Statistics::default(),
            },
            seconds: 1.0,
        }),
        refused: None,
        seconds: Vec::new(),
        figures: None,
    }
}

fn gives_up(reason: &str, switches: Vec<f64>) -> (Verdict, String) {
    let (method, reason) = (Method::Dop853, reason.to_owned());
    let attempt = attempt(Stop::Method { method, reason }, switches);
    let judged = judge(&attempt, None, 1e-6, None);
    (judged.verdict, judged.cause)
}

#[test]
fn switches_that_accumulate_at_an_instant_are_chatter() {
    // A ball that loses a third of its speed at every bounce comes to rest at
    // 0.25 s; in double precision the last bounces are at one instant.
    let mut times: Vec<f64> = (0..80)
        .map(|k| 0.25 - 0.2 * (2.0f64 / 3.0).powi(k))
        .collect();
    times.resize(130, 0.25);
    let reason = "component 0 changes to and fro 64 times at t = 0.25 s without moving on";
    let (verdict, cause) = gives_up(reason, times.clone());
    assert_eq!((verdict, cause.as_str()), (Verdict::Chatter, reason));
    // The same number of switches, each later than the one before, is none.
    times.truncate(80);
    let (verdict, cause) = gives_up("no step is short enough", times);
    assert_eq!(verdict, Verdict::GaveUp);
    assert_eq!(cause, "no step is short enough (at t = 0.25 s)");
}

#[test]
fn a_method_that_gives_up_is_neither_unstable_nor_refused() {
    let what = "wheel: speed".to_owned();
    let judged = judge(
        &attempt(Stop::NotFinite { what }, Vec::new()),
        None,
        1e-6,
        None,
    );
    assert_eq!(judged.verdict, Verdict::GaveUp);
    assert_eq!(
        judged.cause,
        "wheel: speed is no longer a finite number at t = 0.25 s"
    );
    assert_eq!(
        gives_up("the iteration does not converge", Vec::new()).0,
        Verdict::GaveUp
    );
}

#[test]
fn counts_of_switches_are_told_apart() {
    let verdict = |found, truth| switches(found, truth).map(|judged| judged.0);
    assert_eq!(verdict(130, 130), None);
    assert_eq!(verdict(128, 130), Some(Verdict::SwitchesMissed));
    assert_eq!(verdict(132, 130), Some(Verdict::SwitchesMissed));
    assert_eq!(verdict(300, 130), Some(Verdict::Chatter));
    assert_eq!(verdict(30, 2), Some(Verdict::Chatter));
    assert_eq!(verdict(10, 0), Some(Verdict::SwitchesMissed));
}

#[test]
fn eigenvalues_lie_somewhere() {
    assert_eq!(axis([-1e-9, 1.0]), "on the imaginary axis");
    assert_eq!(axis([-1.0, 0.0]), "on the real axis");
    assert_eq!(axis([-1.0, 1.0]), "in the direction of λ");
}
