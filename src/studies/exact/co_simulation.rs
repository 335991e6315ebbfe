//! Trees followed beside an integration of the rest of a system.
//!
//! What hangs on a prescribed drive on separate branches is separate: the trees know
//! nothing of the rest, nor it of them. The rest is integrated as a system of its own;
//! after each of its steps the trees are followed to its end, and both are put into one
//! record.

use super::MotionFindings;
use super::combined_record::CombinedRecord;
use crate::dynamics::integrate::{Modes, Outcome, Sink, Statistics, SwitchEvent};
use crate::exact::Rest;
use crate::exact::event_loop::{EventLoop, RemainderStep};
use crate::math::polynomial::Step;

/// Listens to the rest and follows the trees.
pub(super) struct CoSimulation<'a> {
    rest: &'a Rest,
    walk: EventLoop<'a>,
    joint: CombinedRecord<'a>,
    /// State and modes of the whole where the walk stands.
    y: Vec<f64>,
    modes: Modes,
}

impl<'a> CoSimulation<'a> {
    pub(super) fn new(rest: &'a Rest, walk: EventLoop<'a>, joint: CombinedRecord<'a>) -> Self {
        let (y, modes) = (walk.state().to_vec(), walk.modes().clone());
        Self {
            rest,
            walk,
            joint,
            y,
            modes,
        }
    }

    /// The whole, where the integration of the rest has ended.
    pub(super) fn finish(mut self, own: Outcome) -> MotionFindings {
        let walked = self.walk.outcome();
        self.walk.report_cut_phases(&mut self.joint);
        let (time, stop) = match self.walk.has_stopped() {
            true => (walked.time, walked.stop),
            false => (own.time, own.stop),
        };
        let grazing = self.walk.grazing();
        let place = (&self.y[..], &self.modes);
        let recorded = self
            .joint
            .finish(self.walk.time(), place, self.walk.branches());
        MotionFindings {
            recorded,
            outcome: Outcome {
                time,
                stop,
                statistics: Statistics {
                    steps: own.statistics.steps + walked.statistics.steps,
                    rejected: own.statistics.rejected,
                    evaluations: own.statistics.evaluations + walked.statistics.evaluations,
                    switches: walked.statistics.switches,
                },
            },
            grazing,
        }
    }
}

impl Sink for CoSimulation<'_> {
    fn start(&mut self, _time: f64, y: &[f64], modes: &Modes) {
        self.joint.start_integrated(y, modes);
        self.walk.begin_phases(&mut self.joint);
        self.modes = self.walk.modes().clone();
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if self.walk.has_stopped() || self.joint.failure().is_some() {
            return;
        }
        let given = RemainderStep {
            step,
            coordinates: &self.rest.coordinates,
        };
        self.walk
            .advance_to(step.end_time(), Some(&given), &mut self.joint);
        let reached = (self.walk.time() - step.start) / step.length;
        let reached = Step {
            end: reached.min(step.end),
            ..*step
        };
        self.joint.step(&reached, modes);
        self.y
            .copy_from_slice(self.walk.current_state(Some(&given)).0);
        self.modes.0.copy_from_slice(&self.walk.modes().0);
        self.joint.passes(self.walk.time(), self.walk.switches());
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        if self.walk.has_stopped() {
            return;
        }
        self.joint.switch_integrated(event);
        let changes = event.before.0.iter().zip(&event.after.0);
        let n = self.y.len() / 2;
        let own = event.y.len() / 2;
        for (number, &coordinate) in self.rest.coordinates.iter().enumerate() {
            self.y[coordinate] = event.y[number];
            self.y[n + coordinate] = event.y[own + number];
        }
        for (&component, (before, &after)) in self.rest.components.iter().zip(changes) {
            if *before != after {
                self.walk
                    .take_change((component, after), &self.y, &mut self.joint);
            }
        }
        self.modes.0.copy_from_slice(&self.walk.modes().0);
    }
}
