//! Tests of whole runs: orders, switches, ends, limits, references.

mod ends;
mod orders;
pub(super) mod problems;
mod reference;
mod switches;
mod traps;

use super::*;
use crate::budget::Budget;
use crate::math::polynomial::Step;

/// A sink that keeps what the tests ask for.
#[derive(Default)]
pub(super) struct Keeper {
    /// Last state.
    pub(super) y: Vec<f64>,
    /// End times of the steps.
    pub(super) ends: Vec<f64>,
    /// Time and component of every switch; `None` for a break.
    pub(super) switches: Vec<(f64, Option<usize>)>,
    /// (time, first coordinate) at eleven places of every step.
    pub(super) samples: Vec<(f64, f64)>,
    /// Greatest difference of the first coordinate where two steps meet.
    pub(super) gap: f64,
}

impl Keeper {
    pub(super) fn times(&self) -> Vec<f64> {
        self.switches.iter().map(|switch| switch.0).collect()
    }
}

impl Sink for Keeper {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.y = y.to_vec();
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        assert!(step.length > 0.0 && step.end > 0.0 && step.end <= 1.0);
        let mut y = self.y.clone();
        step.state(0.0, &mut y);
        self.gap = self.gap.max((y[0] - self.y[0]).abs());
        for k in 0..=10 {
            let s = step.end * f64::from(k) / 10.0;
            step.state(s, &mut self.y);
            self.samples.push((step.time(s), self.y[0]));
        }
        self.ends.push(step.end_time());
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        let component = event.watch.map(|watch| watch.component);
        self.switches.push((event.time, component));
        self.y.copy_from_slice(event.y);
    }
}

pub(super) const FREE: Limits<'static> = Limits {
    switches: 1_000_000,
    steps: 100_000_000,
    budget: Budget::FREE,
};

pub(super) fn settings(method: Method, tolerance: f64, step: Option<f64>) -> Settings {
    Settings {
        method,
        tolerance,
        step,
    }
}

/// Settings for a test of something else: every method with a tolerance or
/// step that suits it.
pub(super) fn ordinary(method: Method, step: f64) -> Settings {
    settings(method, 1e-6, (method == Method::Rk4).then_some(step))
}

/// Runs from t = 0 without limits.
pub(super) fn run<D: Dynamics>(
    dynamics: &D,
    end: f64,
    y0: &[f64],
    modes: &[i64],
    settings: &Settings,
) -> (Outcome, Keeper) {
    let mut keeper = Keeper::default();
    let modes = Modes(modes.to_vec());
    let outcome = integrate(dynamics, 0.0, end, y0, &modes, settings, &FREE, &mut keeper);
    (outcome, keeper)
}
