//! `dam`'s own methods on the press, listened to for samples and switches only.

use super::scene::Press;
use crate::solution::Solution;
use dam::integrate::{Limits, Method, Modes, Settings, Sink, Stop, SwitchEvent, integrate};
use dam::polynomial::Step;
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};

/// Collects δ at equal intervals and counts the switches.
struct Listener {
    coordinate: usize,
    interval: f64,
    samples: Vec<f64>,
    wanted: usize,
    switches: usize,
}

impl Sink for Listener {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        let end = step.end_time();
        while self.samples.len() < self.wanted {
            let time = self.interval * (self.samples.len() + 1) as f64;
            // The last sample is the end itself, up to rounding.
            if time - end >= 1e-9 * self.interval {
                break;
            }
            let place = ((time - step.start) / step.length).min(step.end);
            self.samples.push(step.value(self.coordinate, place).0);
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.switches += usize::from(event.watch.is_some());
    }
}

/// Solves for `samples` samples of δ by a method.
///
/// # Errors
/// The run ends early.
pub(crate) fn solve(
    press: &Press,
    method: Method,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    let mut listener = Listener {
        coordinate: press.delta,
        interval: press.duration / samples as f64,
        samples: Vec::with_capacity(samples),
        wanted: samples,
        switches: 0,
    };
    let settings = Settings {
        method,
        tolerance,
        step: None,
    };
    let limits = Limits {
        switches: 1_000_000,
        steps: 100_000_000,
        budget: dam::budget::Budget::FREE,
    };
    let outcome = integrate(
        &press.system,
        0.0,
        press.duration,
        &press.start,
        &press.modes,
        &settings,
        &limits,
        &mut listener,
    );
    match outcome.stop {
        Stop::Complete => Ok(Solution {
            samples: listener.samples,
            switches: Some(listener.switches),
            steps: outcome.statistics.steps,
            ..Solution::default()
        }),
        stop => Err(format!("{method} ended at {} s: {stop:?}", outcome.time)),
    }
}

/// What `auto` picks at a tolerance.
///
/// # Errors
/// The run cannot be started.
pub(crate) fn choice(press: &Press, tolerance: f64) -> Result<Method, String> {
    let settings = RunSettings {
        tolerance,
        // The choice is made before the first step.
        max_steps: 1,
        ..RunSettings::new(press.duration)
    };
    let result = run(&press.system, &settings, &Control::default(), &mut []);
    result
        .map(|result| result.method)
        .map_err(|faults| format!("{faults:?}"))
}

/// Attempts (accepted and rejected steps) made until `steps` are accepted or
/// the run ends.
pub(crate) fn first_steps(press: &Press, method: Method, tolerance: f64, steps: u64) -> u64 {
    let settings = Settings {
        method,
        tolerance,
        step: None,
    };
    let limits = Limits {
        switches: 1_000_000,
        steps,
        budget: dam::budget::Budget::FREE,
    };
    let mut nothing = Listener {
        coordinate: press.delta,
        interval: press.duration,
        samples: Vec::new(),
        wanted: 0,
        switches: 0,
    };
    let outcome = integrate(
        &press.system,
        0.0,
        press.duration,
        &press.start,
        &press.modes,
        &settings,
        &limits,
        &mut nothing,
    );
    outcome.statistics.steps + outcome.statistics.rejected
}
