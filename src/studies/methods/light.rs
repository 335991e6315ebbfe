//! The lightest run that answers the question: samples of the deviations and
//! the times of the switches, nothing else. This is what is timed.

use crate::budget::Instant;
use crate::dynamics::integrate::{
    Dynamics, Method, Modes, Outcome, Settings, Sink, Stop, SwitchEvent, integrate,
};
use crate::dynamics::system::{InitialState, System};
use crate::exact::RequestedFigures;
use crate::fault::Fault;
use crate::math::polynomial::Step;
use crate::studies::demand::Demand;
use crate::studies::run::motion;
use crate::studies::{Control, RunSettings, exact};

/// Track of an object: the coordinate that is followed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Track {
    /// Index of the object in the model.
    pub(super) object: usize,
    /// Coordinate in the state: δ of an elastic object, the displacement of a rotor.
    pub(super) coordinate: usize,
}

/// Tracks of a system: δ of every elastic object, or, where nothing is elastic, the
/// displacement of every rotor.
pub(super) fn tracks(system: &System) -> Vec<Track> {
    let objects = system.model().objects.iter().enumerate();
    let all: Vec<(bool, Track)> = objects
        .filter_map(|(index, _)| {
            let track = Track {
                object: index,
                coordinate: system.last_coordinate(index)?,
            };
            Some((system.first_coordinate(index).is_some(), track))
        })
        .collect();
    let elastic = all.iter().any(|(elastic, _)| *elastic);
    let wanted = all.into_iter().filter(|entry| entry.0 == elastic);
    wanted.map(|(_, track)| track).collect()
}

/// Trace of a light run: samples of its tracks and its switches.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Trace {
    /// Samples of every track at equal intervals, from t = 0 as far as the run went.
    pub(super) samples: Vec<Vec<f64>>,
    /// Greatest |value| of every track, at samples and at the ends of steps.
    pub(super) greatest: Vec<f64>,
    /// Times of the switches of pairs (s).
    pub(super) switches: Vec<f64>,
    /// Longest step (s).
    pub(super) longest_step: f64,
}

impl Trace {
    /// Of a run that never began.
    pub(super) const EMPTY: Self = Self {
        samples: Vec::new(),
        greatest: Vec::new(),
        switches: Vec::new(),
        longest_step: 0.0,
    };
}

/// Listens to a run and keeps a [`Trace`].
struct Listener<'r> {
    system: &'r System,
    tracks: &'r [Track],
    duration: f64,
    intervals: usize,
    next: usize,
    trace: Trace,
}

impl<'r> Listener<'r> {
    fn new(system: &'r System, tracks: &'r [Track], settings: &RunSettings) -> Self {
        let room = || Vec::with_capacity(settings.samples + 1);
        Self {
            system,
            tracks,
            duration: settings.duration,
            intervals: settings.samples.max(1),
            next: 0,
            trace: Trace {
                samples: tracks.iter().map(|_| room()).collect(),
                greatest: vec![0.0; tracks.len()],
                ..Trace::default()
            },
        }
    }

    fn next_sample_time(&self) -> f64 {
        self.duration * (self.next as f64 / self.intervals as f64)
    }

    fn sample_tracks(&mut self, step: &Step<'_>, s: f64, keep: bool) {
        for (index, track) in self.tracks.iter().enumerate() {
            let value = step.value(track.coordinate, s).0;
            let greatest = &mut self.trace.greatest[index];
            // A value that is no number must not be forgotten.
            if value.abs() > *greatest || value.is_nan() {
                *greatest = value.abs();
            }
            if keep {
                self.trace.samples[index].push(value);
            }
        }
    }
}

impl Sink for Listener<'_> {
    fn start(&mut self, _time: f64, y: &[f64], _modes: &Modes) {
        for (index, track) in self.tracks.iter().enumerate() {
            let value = y[track.coordinate];
            self.trace.samples[index].push(value);
            self.trace.greatest[index] = value.abs();
        }
        self.next = 1;
    }

    fn step(&mut self, step: &Step<'_>, _modes: &Modes) {
        self.trace.longest_step = self.trace.longest_step.max(step.length);
        while self.reads_within_steps(step.end_time()) {
            let s = (self.next_sample_time() - step.start) / step.length;
            self.sample_tracks(step, s.clamp(0.0, step.end), true);
            self.next += 1;
        }
        self.sample_tracks(step, step.end, false);
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        let pair = event.watch.filter(|w| self.system.is_pair(w.component));
        if pair.is_some() {
            self.trace.switches.push(event.time);
        }
    }

    fn reads_within_steps(&self, until: f64) -> bool {
        // The last sample must not be lost to rounding of the clock.
        let until = until + 1e-9 * self.duration / self.intervals as f64;
        self.next <= self.intervals && self.next_sample_time() <= until
    }
}

/// A run and how long it took.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TimedRun {
    /// Trace that it left.
    pub(super) trace: Trace,
    /// Outcome: how it ended.
    pub(super) outcome: Outcome,
    /// Wall-clock time (s).
    pub(super) seconds: f64,
}

/// Runs a system from its start with the method, tolerance and step of
/// `settings`, timed from the system ready to all samples and switch times.
///
/// # Errors
/// Why the method cannot be used on this system, or with these settings.
pub(super) fn light_run(
    system: &System,
    tracks: &[Track],
    initial: &InitialState,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<TimedRun, String> {
    let method = settings.method.ok_or("no method was named")?;
    if method == Method::Exact {
        return exact_run(system, tracks, initial, settings, control);
    }
    let plan = Settings {
        method,
        tolerance: settings.tolerance,
        step: settings.step,
    };
    let limits = control.limits(settings);
    let begun = Instant::now();
    let mut listener = Listener::new(system, tracks, settings);
    let outcome = integrate(
        system,
        0.0,
        settings.duration,
        &initial.y,
        &initial.modes,
        &plan,
        &limits,
        &mut listener,
    );
    let seconds = begun.elapsed().as_secs_f64();
    match outcome.stop {
        Stop::Method { reason, .. } if outcome.statistics.steps == 0 && outcome.time == 0.0 => {
            Err(reason)
        }
        _ => Ok(TimedRun {
            trace: listener.trace,
            outcome,
            seconds,
        }),
    }
}

/// Light run by exact propagation, its preparation from the system included.
fn exact_run(
    system: &System,
    tracks: &[Track],
    initial: &InitialState,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<TimedRun, String> {
    let begun = Instant::now();
    let parts = exact::exact_parts(system).map_err(|faults| reasons(&faults))?;
    let samples = settings.samples.max(1);
    let (limits, end) = (control.limits(settings), settings.duration);
    let deviations = exact::deviations(system, &parts, initial, (end, samples), &limits);
    let outcome = deviations.outcome;
    if let Stop::Method { reason, .. } = outcome.stop {
        return Err(reason);
    }
    let seconds = begun.elapsed().as_secs_f64();
    // Others look at the ends of their steps too; here there are none, and
    // samples may lie beside the greatest deviation.
    let extremes = (outcome.stop == Stop::Complete).then(|| {
        let demand = Demand {
            figures: Some(&|_| RequestedFigures::DEVIATION),
            laws: None,
            checked: false,
        };
        let settings = RunSettings {
            method: Some(Method::Exact),
            ..settings.clone()
        };
        motion(system, &settings, demand, control, &mut []).ok()
    });
    let extremes = extremes.flatten();
    let mut trace = Trace {
        switches: deviations.switches,
        ..Trace::EMPTY
    };
    for track in tracks {
        let own = deviations.samples.iter().find(|own| own.0 == track.object);
        // The sample at t = 0 is the start.
        let mut samples = vec![initial.y[track.coordinate]];
        samples.extend(own.into_iter().flat_map(|own| &own.1));
        let between = extremes.as_ref().map_or(0.0, |run| {
            let figures = &run.recorded.figures[track.object];
            figures.delta_max.max(-figures.delta_min)
        });
        let greatest = samples.iter().fold(between, |a: f64, b| a.max(b.abs()));
        trace.greatest.push(greatest);
        trace.samples.push(samples);
    }
    Ok(TimedRun {
        trace,
        outcome,
        seconds,
    })
}

/// Every reason against a method, in one line.
fn reasons(faults: &[Fault]) -> String {
    let said: Vec<&str> = faults
        .iter()
        .map(|fault| {
            let message = fault.message.as_str();
            message
                .strip_prefix("`exact` cannot be used: ")
                .unwrap_or(message)
        })
        .collect();
    said.join("; ")
}

/// Median; of an even number the mean of the middle two; 0 of nothing.
pub(super) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    match sorted.len() {
        0 => 0.0,
        count if count % 2 == 1 => sorted[count / 2],
        count => 0.5 * (sorted[count / 2 - 1] + sorted[count / 2]),
    }
}
