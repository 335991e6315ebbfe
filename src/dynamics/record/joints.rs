//! Friction in the joints of one linkage: what it takes, and when it holds.

use super::figures::JointFigures;
use super::peaks::WEIGHTS;
use crate::dynamics::integrate::{Modes, SwitchEvent};
use crate::dynamics::system::StickSlip;

/// Follows the joints of one linkage through a run.
#[derive(Clone, Debug)]
pub(crate) struct JointTracker {
    /// Index of the object.
    pub(super) object: usize,
    /// Component of the modes that says whether it is held; `None`: its motion is
    /// given.
    component: Option<usize>,
    /// Since when it is held (s).
    held: Option<f64>,
    figures: JointFigures,
}

impl JointTracker {
    pub(super) fn new(object: usize, component: Option<usize>) -> Self {
        Self {
            object,
            component,
            held: None,
            figures: JointFigures::default(),
        }
    }

    fn is_held(&self, modes: &Modes) -> bool {
        self.component
            .is_some_and(|component| StickSlip::of(modes.0[component]) == StickSlip::Stuck)
    }

    pub(super) fn start(&mut self, time: f64, modes: &Modes) {
        self.held = self.is_held(modes).then_some(time);
    }

    /// Power lost at place `index` of [`super::peaks::PLACES`] in a step of `span`
    /// seconds.
    pub(super) fn add(&mut self, index: usize, span: f64, loss: f64) {
        self.figures.friction_loss += WEIGHTS[index] * span * loss;
    }

    pub(super) fn switch(&mut self, event: &SwitchEvent<'_>) {
        let own = event.watch.map(|watch| watch.component) == self.component;
        let before = self.is_held(event.before);
        let after = self.is_held(event.after);
        // (Of several inputs single pairs stop, and all of them only where friction holds them.)
        if self.component.is_some() && !before && (own || after) {
            self.figures.standstills += 1;
        }
        match (before, after) {
            (false, true) => self.held = Some(event.time),
            (true, false) => self.release(event.time),
            _ => {}
        }
    }

    fn release(&mut self, time: f64) {
        if let Some(since) = self.held.take() {
            self.figures.time_at_rest += time - since;
        }
    }

    /// The figures when the run has ended at `time`.
    pub(super) fn finish(mut self, time: f64) -> JointFigures {
        self.release(time);
        self.figures
    }
}
