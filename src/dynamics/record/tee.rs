//! Several listeners to one run.

use crate::dynamics::integrate::{Modes, Sink, SwitchEvent};
use crate::math::polynomial::Step;

/// Passes everything on to each of several sinks, in order.
pub struct Tee<'a, 'b>(pub &'a mut [&'b mut dyn Sink]);

impl Sink for Tee<'_, '_> {
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        for sink in self.0.iter_mut() {
            sink.start(time, y, modes);
        }
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        for sink in self.0.iter_mut() {
            sink.step(step, modes);
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        for sink in self.0.iter_mut() {
            sink.switch(event);
        }
    }

    fn passes(&mut self, time: f64, switches: u64) {
        for sink in self.0.iter_mut() {
            sink.passes(time, switches);
        }
    }

    fn reads_within_steps(&self, until: f64) -> bool {
        self.0.iter().any(|sink| sink.reads_within_steps(until))
    }
}
