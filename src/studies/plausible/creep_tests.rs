//! Creep read off samples whose speeds are closed forms.

use super::law::{Friction, Motion};
use super::longest_creep;
use crate::dynamics::record::CreepFigures;
use approx::assert_relative_eq;

const WIDTH: f64 = 1e-3;
const LIMIT: f64 = 5.0;

/// The longest creep of a speed over time, of 1000 samples up to `end`.
fn found(end: f64, speed: impl Fn(f64) -> f64) -> Option<CreepFigures> {
    let times: Vec<f64> = (0..=1000).map(|k| end * f64::from(k) / 1000.0).collect();
    let speed: Vec<f64> = times.iter().map(|t| speed(*t)).collect();
    let motion = Motion::of(&times, speed.into(), Vec::new());
    let friction = Friction::Stated {
        force: LIMIT,
        width: WIDTH,
    };
    longest_creep(&friction, &motion, |_| true)
}

/// Slides from 3 rad/s at −0.5 rad/s² to 6 s, then is held under 4 N·m.
fn slides_and_creeps(time: f64) -> f64 {
    let creep = WIDTH * 0.8f64.atanh();
    (3.0 - 0.5 * time).max(creep)
}

#[test]
fn a_body_under_four_of_five_newtons_creeps() {
    let creep = found(10.0, slides_and_creeps).expect("a creep");
    assert_relative_eq!(creep.speed, 1.098_612e-3, max_relative = 1e-6);
    assert_relative_eq!(creep.force, 4.0, max_relative = 1e-12);
    assert_eq!(creep.limit, LIMIT);
    assert!((creep.from - 6.0).abs() < 0.02 && creep.until == 10.0);
}

#[test]
fn a_body_that_passes_standstill_does_not_creep() {
    assert_eq!(found(10.0, |t| 3.0 - 0.5 * t), None);
    assert_eq!(found(1.0, |t| 4e-3 * (1.0 - 2.0 * t)), None);
}

#[test]
fn a_body_that_bears_nothing_rests() {
    assert_eq!(found(10.0, |_| 0.0), None);
}
