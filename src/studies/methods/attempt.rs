//! One point of the chart on its way: a method at one setting, run and timed.

use super::light::{TimedRun, Track, light_run, median};
use super::setting::Setting;
use crate::dynamics::integrate::{Method, Stop};
use crate::dynamics::record::Figures;
use crate::dynamics::system::{InitialState, System};
use crate::studies::run::run;
use crate::studies::{Control, RunSettings};
use std::time::Duration;

/// The recorded run may take this many times the limit of the light one.
const RECORDED_TAKES: u32 = 5;

/// No point is repeated for longer than this (s): long runs vary little.
const MOST_REPEATING: f64 = 1.0;

/// So many steps more than the length of the step asks for are no chatter.
const FEW: f64 = 1000.0;

/// Problem to be run: a system from its start.
#[derive(Clone, Copy)]
pub(super) struct Problem<'p> {
    pub(super) system: &'p System,
    pub(super) initial: &'p InitialState,
    pub(super) tracks: &'p [Track],
    pub(super) settings: &'p RunSettings,
}

/// Effort with which a point is measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort<'c> {
    /// Timed runs of a point at most.
    pub(super) repeats: usize,
    /// Longest time of a point (s).
    pub(super) limit: Duration,
    /// Control: what may end it from outside.
    pub(super) control: Control<'c>,
}

/// A point before it is judged.
#[derive(Clone, Debug)]
pub(super) struct Attempt {
    pub(super) method: Method,
    pub(super) setting: Setting,
    /// The first timed run; `None` when the method was refused before it.
    pub(super) timed: Option<TimedRun>,
    /// Why the method cannot be used at all.
    pub(super) refused: Option<String>,
    /// Wall-clock times of all repetitions (s).
    pub(super) seconds: Vec<f64>,
    /// Figures of a full recorded run.
    pub(super) figures: Option<Figures>,
}

impl Attempt {
    /// Runs a method at a setting, repeatedly for its time and once more for
    /// its figures.
    pub(super) fn new(
        problem: &Problem<'_>,
        method: Method,
        setting: Setting,
        effort: &Effort<'_>,
    ) -> Self {
        let mut attempt = Self::light(problem, method, setting, effort);
        if attempt.has_ended_well() {
            attempt.repeat(problem, effort);
            attempt.record(problem, effort);
        }
        attempt
    }

    /// Attempts a point without repetitions, where its time does not matter.
    pub(super) fn untimed(
        problem: &Problem<'_>,
        method: Method,
        setting: Setting,
        effort: &Effort<'_>,
    ) -> Self {
        let mut attempt = Self::light(problem, method, setting, effort);
        if attempt.has_ended_well() {
            attempt.record(problem, effort);
        }
        attempt
    }

    /// Runs once more with the recorder, for the figures.
    fn record(&mut self, problem: &Problem<'_>, effort: &Effort<'_>) {
        let control = effort.control.within(effort.limit * RECORDED_TAKES);
        let settings = problem.settings_at_point(self.method, self.setting);
        let recorded = run(problem.system, &settings, &control, &mut []);
        self.figures = recorded
            .ok()
            .filter(|result| has_ended_well(&result.outcome.stop))
            .map(|result| result.figures);
    }

    /// Attempts a point without repetitions and figures.
    pub(super) fn light(
        problem: &Problem<'_>,
        method: Method,
        setting: Setting,
        effort: &Effort<'_>,
    ) -> Self {
        let settings = problem.settings_at_point(method, setting);
        let control = effort.control.within(effort.limit);
        let run = light_run(
            problem.system,
            problem.tracks,
            problem.initial,
            &settings,
            &control,
        );
        let (timed, refused) = match run {
            Ok(timed) => (Some(timed), None),
            Err(reason) => (None, Some(reason)),
        };
        Self {
            method,
            setting,
            seconds: timed.iter().map(|timed| timed.seconds).collect(),
            timed,
            refused,
            figures: None,
        }
    }

    fn repeat(&mut self, problem: &Problem<'_>, effort: &Effort<'_>) {
        let settings = problem.settings_at_point(self.method, self.setting);
        let limit = effort.limit.as_secs_f64().min(MOST_REPEATING);
        while self.seconds.len() < effort.repeats && self.seconds.iter().sum::<f64>() < limit {
            let control = effort.control.within(effort.limit * 2);
            let again = light_run(
                problem.system,
                problem.tracks,
                problem.initial,
                &settings,
                &control,
            );
            match again {
                Ok(timed) if has_ended_well(&timed.outcome.stop) => {
                    self.seconds.push(timed.seconds);
                }
                _ => return,
            }
        }
    }

    /// True when the run reached its end or a place where the mechanism itself ends.
    pub(super) fn has_ended_well(&self) -> bool {
        let stop = self.timed.as_ref().map(|timed| &timed.outcome.stop);
        stop.is_some_and(has_ended_well)
    }

    /// True when the user ended it.
    pub(super) fn was_interrupted(&self) -> bool {
        let stop = self.timed.as_ref().map(|timed| &timed.outcome.stop);
        stop == Some(&Stop::Interrupted)
    }

    /// True when it took longer than it may.
    pub(super) fn is_out_of_time(&self) -> bool {
        let stop = self.timed.as_ref().map(|timed| &timed.outcome.stop);
        matches!(
            stop,
            Some(Stop::WallClock { .. } | Stop::TooManySteps { .. })
        )
    }

    /// True when a finer setting cannot help: refused, or out of time. A fixed
    /// step whose time went into chatter says nothing of a finer one.
    pub(super) fn ends_ladder(&self) -> bool {
        let chatters = |step: f64| {
            let outcome = self.timed.as_ref().map(|timed| &timed.outcome);
            outcome.is_some_and(|o| o.statistics.steps as f64 > 2.0 * o.time / step + FEW)
        };
        self.refused.is_some()
            || self.is_out_of_time() && !self.setting.step().is_some_and(chatters)
    }

    /// Median of the measured times (s).
    pub(super) fn median_seconds(&self) -> Option<f64> {
        (!self.seconds.is_empty()).then(|| median(&self.seconds))
    }
}

impl Problem<'_> {
    /// The settings of a run at a point.
    pub(super) fn settings_at_point(&self, method: Method, setting: Setting) -> RunSettings {
        RunSettings {
            method: Some(method),
            tolerance: setting.tolerance().unwrap_or(self.settings.tolerance),
            step: setting.step().or(self.settings.step),
            ..self.settings.clone()
        }
    }
}

fn has_ended_well(stop: &Stop) -> bool {
    matches!(stop, Stop::Complete | Stop::Physical(_))
}
