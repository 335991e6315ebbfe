//! The listener that turns an integration into a record and figures.

use super::confirmed::ConfirmedPeak;
use super::failure::Failure;

use super::figure_collector::FigureCollector;
use super::log::{Course, Log, Stretch};
use super::settings::RecorderSettings;
use super::spans::SpanExtreme;
use super::tally::Tally;
use super::{ObjectFigures, Record};
use crate::dynamics::audit::DrawnInstants;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{Modes, Sink, SwitchEvent};
use crate::dynamics::system::System;
use crate::math::polynomial::Step;
use std::collections::BTreeMap;

/// Record and figures of a run.
#[derive(Clone, Debug)]
pub struct RunRecord {
    /// Samples, switches, separations.
    pub record: Record,
    /// Figures of every object, in the order of the model's objects.
    pub figures: Vec<ObjectFigures>,
    /// The energy balance.
    pub audit: EnergyAudit,
    /// Rigid force-closed pairs: object, least contact force, when (s).
    pub margins: Vec<(usize, f64, f64)>,
    /// The first force, acceleration or energy that was not a finite number at
    /// a state that was. Nothing from that step on is in the figures, the audit
    /// and the record.
    pub failure: Option<Failure>,
    /// Greatest values that closed forms told, seen a second time.
    pub(crate) confirmed: Vec<ConfirmedPeak>,
    /// States at instants drawn at random, for the check of the run.
    pub(crate) looks: DrawnInstants,
    /// The first time of each condition of the model, by its name; `None`: it did not hold.
    pub first_times: BTreeMap<String, Option<f64>>,
    /// The conditions that may have held earlier, by their names: the time (s) from which on
    /// that is not known.
    pub undetermined_times: BTreeMap<String, f64>,
    /// Greatest and least values within parts of the motion, by address; `None`: the motion was
    /// never within.
    pub spans: BTreeMap<String, Option<SpanExtreme>>,
}

/// Records a run of a system. Its memory is bounded by samples and switches.
pub struct Recorder<'s> {
    log: Log<'s>,
    figured: FigureCollector<'s>,
}

impl<'s> Recorder<'s> {
    /// A recorder for one run of `system` from t = 0.
    pub fn new(system: &'s System, settings: RecorderSettings) -> Self {
        Self {
            figured: FigureCollector::new(system, &settings),
            log: Log::new(system, settings),
        }
    }

    /// Ends the recording: closes open intervals and works out the figures.
    pub fn finish(self) -> RunRecord {
        let gathered = self.figured.finish();
        let (tallies, joints) = (&gathered.tallies, gathered.joints);
        let mut recorded = self
            .log
            .finish(gathered.time, tallies, joints, gathered.audit);
        recorded.failure = gathered.failure.or(recorded.failure);
        recorded
    }

    fn has_failed(&self) -> bool {
        self.figured.failure().is_some() || self.log.failure().is_some()
    }
}

impl Sink for Recorder<'_> {
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        self.log.start(time, y, modes);
        self.figured.start(time, y, modes);
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if self.has_failed() {
            return;
        }
        self.figured.step(step, modes);
        let until = match self.figured.failure() {
            Some(failure) => failure.time,
            None => step.end_time(),
        };
        let stretch = || Stretch {
            span: [step.start, until],
            modes,
            course: Course::Step(step),
        };
        self.log.sample(stretch());
        let tallies = self.figured.tallies().iter();
        self.log
            .keep_rows(tallies.flat_map(Tally::times), stretch());
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        if !self.has_failed() {
            self.figured.switch(event);
            self.log.switch(event);
        }
    }
}
