//! Tests of whole runs.

use super::problems::{Oscillator, Rocker, period};
use super::*;
use crate::polynomial::Step;

/// Keeps the last state and the switch times.
#[derive(Default)]
pub(super) struct Keeper {
    pub(super) y: Vec<f64>,
    pub(super) times: Vec<f64>,
    pub(super) ends: Vec<f64>,
}

impl Sink for Keeper {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.y = y.to_vec();
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        step.state(step.end, &mut self.y);
        self.ends.push(step.end_time());
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.times.push(event.time);
        self.y.copy_from_slice(event.y);
    }
}

pub(super) const FREE: Limits<'static> = Limits {
    switches: 1_000_000,
    steps: 100_000_000,
    wall_clock: None,
    interrupt: None,
};

fn settings(method: Method, tolerance: f64, step: Option<f64>) -> Settings {
    Settings {
        method,
        tolerance,
        step,
    }
}

#[test]
fn probe() {
    let system = Oscillator::free(2.0);
    for method in [Method::Bdf, Method::TrBdf2, Method::Esdirk34] {
        for k in 3..=8 {
            let tolerance = 10f64.powi(-k);
            let step = (method == Method::Rk4).then(|| 0.2 * 0.5f64.powi(k - 4));
            let mut keeper = Keeper::default();
            let end = 5.3 * period(2.0);
            let outcome = integrate(
                &system,
                0.0,
                end,
                &[1.0, 0.0],
                &Modes::default(),
                &settings(method, tolerance, step),
                &FREE,
                &mut keeper,
            );
            let error = (keeper.y[0] - (2.0 * end).cos()).abs();
            println!("{method} {tolerance:e} err {error:.2e} {outcome:?}");
        }
    }
}

#[test]
fn probe_rocker() {
    for masses in [1, 2] {
        for method in [Method::Bdf, Method::TrBdf2, Method::Esdirk34] {
            for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8] {
                let system = Rocker::published(masses, 0.4);
                let (y, modes) = system.static_start();
                let mut keeper = Keeper::default();
                let begun = std::time::Instant::now();
                let outcome = integrate(
                    &system,
                    0.0,
                    0.5,
                    &y,
                    &modes,
                    &settings(method, tolerance, None),
                    &FREE,
                    &mut keeper,
                );
                let reference = [-6.00249690245187e-05, -6.00232442465282e-05][masses - 1];
                let first: [&[f64]; 2] = [
                    &[
                        0.0209322348537,
                        0.0372733871517,
                        0.0375891575529,
                        0.0414417973759,
                    ],
                    &[
                        0.0209319661193,
                        0.0372729356335,
                        0.0375724836487,
                        0.0413280485618,
                    ],
                ];
                let dt: Vec<f64> = first[masses - 1]
                    .iter()
                    .zip(&keeper.times)
                    .map(|(a, b)| a - b)
                    .collect();
                println!(
                    "{masses} {method} {tolerance:e} err {:.2e} {} {dt:?} {:?} {:?}",
                    (system.last(0.5, &keeper.y)[0] - reference) / 7.5e-3,
                    keeper.times.len(),
                    outcome,
                    begun.elapsed()
                );
            }
        }
    }
}
