//! The state at which an integration ends.

use crate::dynamics::integrate::{Modes, Sink, SwitchEvent};
use crate::math::polynomial::Step;

/// Keeps the last state and counts switches.
#[derive(Clone, Debug, Default)]
pub(super) struct Last {
    /// [u, u̇].
    pub(super) y: Vec<f64>,
    /// Switches so far.
    pub(super) switches: u64,
}

/// Steps shorter than this share of the time change no speed.
pub(super) const LEFT_OVER: f64 = 1e-11;

impl Sink for Last {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.y = y.to_vec();
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        let n = self.y.len() / 2;
        let speeds = self.y[n..].to_vec();
        step.state(step.end, &mut self.y);
        // A speed is the slope over the step: of one that a switch next to the
        // end has left over nothing but rounding remains.
        if step.end * step.length < LEFT_OVER * step.end_time() {
            self.y[n..].copy_from_slice(&speeds);
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.y.copy_from_slice(event.y);
        self.switches += 1;
    }

    fn reads_within_steps(&self, _: f64) -> bool {
        false
    }
}

/// Keeps the displacements at equal steps.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    step: f64,
    next: usize,
    y: Vec<f64>,
    /// Columns, one a coordinate.
    pub(super) columns: Vec<Vec<f64>>,
}

impl Grid {
    pub(super) fn new(step: f64, coordinates: usize) -> Self {
        Self {
            step,
            next: 1,
            y: vec![0.0; 2 * coordinates],
            columns: vec![Vec::new(); coordinates],
        }
    }
}

impl Sink for Grid {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        while self.reads_within_steps(step.end_time()) {
            let time = self.next as f64 * self.step;
            let s = ((time - step.start) / step.length).clamp(0.0, step.end);
            step.state(s, &mut self.y);
            for (column, value) in self.columns.iter_mut().zip(&self.y) {
                column.push(*value);
            }
            self.next += 1;
        }
    }

    fn switch(&mut self, _: &SwitchEvent<'_>) {}

    fn reads_within_steps(&self, until: f64) -> bool {
        self.next as f64 * self.step <= until * (1.0 + 1e-12)
    }
}
