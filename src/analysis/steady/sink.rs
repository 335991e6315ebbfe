//! The state at which an integration ends.

use crate::integrate::{Modes, Sink, SwitchEvent};
use crate::polynomial::Step;

/// Keeps the last state and counts switches.
#[derive(Clone, Debug, Default)]
pub(super) struct Last {
    /// [u, u̇].
    pub(super) y: Vec<f64>,
    /// Switches so far.
    pub(super) switches: u64,
}

impl Sink for Last {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.y = y.to_vec();
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        step.state(step.end, &mut self.y);
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.y.copy_from_slice(event.y);
        self.switches += 1;
    }
}
