//! One run: the motion of a mechanism and its figures.

use super::document::{document, summary, warnings_of};
use super::exact::follow_beside;
use super::method::{Choice, choose_general, choose_method};
use super::plausible;
use super::settings::{Control, RunSettings};
use super::warning::Warning;
use crate::fault::Fault;
use crate::integrate::{Dynamics, Limits, Method, Outcome, Settings, Sink, Stop, integrate};
use crate::record::{
    EnergyAudit, Figures, Record, Recorded, Recorder, RecorderSettings, Tee, choose_window,
    drive_cycle,
};
use crate::system::{InitialState, System};

/// What a run leaves.
#[derive(Clone, Debug)]
pub struct RunResult {
    /// Samples, switches, separations.
    pub record: Record,
    /// The figures.
    pub figures: Figures,
    /// How it ended.
    pub outcome: Outcome,
    /// The method used.
    pub method: Method,
    /// The tolerance it was given: with `auto` finer than the one asked for.
    pub tolerance: f64,
    /// The energy balance.
    pub audit: EnergyAudit,
    /// What the user should know; also, as text, in the figures.
    pub warnings: Vec<Warning>,
}

impl RunResult {
    /// True when the run reached its end.
    pub fn is_complete(&self) -> bool {
        self.outcome.stop == Stop::Complete
    }

    /// False when the numbers themselves are in doubt: the energies do not
    /// balance, a number was not finite, or the method gave up. A mechanism that
    /// lifts off or reaches a dead position has perfectly good figures.
    pub fn is_trusted(&self) -> bool {
        let gave_up = matches!(
            self.outcome.stop,
            Stop::NotFinite { .. }
                | Stop::StepFloor { .. }
                | Stop::TooManySwitches { .. }
                | Stop::TooManySteps { .. }
                | Stop::Method { .. }
        );
        !gave_up && !self.warnings.iter().any(Warning::spoils_figures)
    }
}

/// Runs a system from its start and works out its figures. `sinks` listen
/// beside the recorder.
///
/// Where the choice of the method is left to the program and exact propagation
/// gives up on the way, or its energies do not balance, the run is made anew
/// by a general method; the sinks then hear of a second start.
///
/// # Errors
/// The start cannot be found: no static balance, a position out of reach, …;
/// `exact` is asked for and cannot be used.
pub fn run(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
) -> Result<RunResult, Vec<Fault>> {
    let choice = choose_method(system, settings)?;
    let result = attempt(system, settings, control, sinks, &choice)?;
    if settings.method.is_some() || choice.parts.is_none() || !gave_out(&result) {
        return Ok(result);
    }
    let general = choose_general(system, settings, &why_not(&result));
    attempt(system, settings, control, sinks, &general)
}

/// True when the numbers of an exact run are not to be had, or in doubt.
fn gave_out(result: &RunResult) -> bool {
    match result.outcome.stop {
        Stop::Complete | Stop::Method { .. } | Stop::NotFinite { .. } => !result.is_trusted(),
        _ => false,
    }
}

fn why_not(result: &RunResult) -> String {
    match &result.outcome.stop {
        Stop::Method { reason, .. } => {
            format!(
                "exact propagation gave up at t = {} s ({reason})",
                result.outcome.time
            )
        }
        Stop::NotFinite { what } => format!(
            "exact propagation met what is no finite number at t = {} s ({what})",
            result.outcome.time
        ),
        _ => "the energies of exact propagation do not balance".to_owned(),
    }
}

/// One run by a method.
fn attempt(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
    choice: &Choice,
) -> Result<RunResult, Vec<Fault>> {
    let initial = system.initial_state()?;
    let window = choose_window(system.model(), settings.duration, settings.window);
    let mut recorder = Recorder::new(
        system,
        RecorderSettings {
            duration: settings.duration,
            samples: settings.samples,
            switch_rows: settings.switch_rows,
            window: window.as_ref().ok().copied(),
            long_steps: matches!(choice.method, Method::Taylor | Method::Radau),
            tolerance: settings.tolerance,
        },
    );
    let mut all: Vec<&mut dyn Sink> = vec![&mut recorder];
    for sink in sinks.iter_mut() {
        all.push(*sink);
    }
    let plan = Settings {
        method: choice.method,
        tolerance: choice.tolerance,
        step: settings.step,
    };
    let limits = control.limits(settings);
    let sink: &mut dyn Sink = &mut Tee(&mut all);
    let duration = settings.duration;
    let outcome = match &choice.parts {
        Some(parts) => match &choice.rest {
            Some(rest) => {
                let own = |initial: &InitialState, sink: &mut dyn Sink| {
                    follow(&rest.system, initial, duration, &plan, &limits, sink)
                };
                let both = (parts, rest);
                follow_beside(system, both, &initial, duration, &limits, sink, own)
            }
            None => super::exact::follow(system, parts, &initial, duration, &limits, sink),
        },
        None => follow(system, &initial, duration, &plan, &limits, sink),
    };
    let mut recorded = recorder.finish();
    let outcome = stopped_at_failure(outcome, &mut recorded);
    let run = summary(settings, &outcome, choice, &recorded, window);
    let known_before = system.model().warnings.iter().cloned();
    let mut warnings: Vec<Warning> = known_before
        .chain(initial.warnings)
        .map(Warning::Start)
        .collect();
    if outcome.stop == Stop::Complete {
        let unused = plausible::warnings_after(system.model(), &recorded.record);
        warnings.extend(unused.into_iter().map(Warning::Meaning));
    }
    warnings.extend(warnings_of(system.model(), settings, &recorded, &run));
    let figures = document(system.model(), settings, &recorded.figures, run, &warnings);
    Ok(RunResult {
        record: recorded.record,
        figures,
        outcome,
        method: choice.method,
        tolerance: choice.tolerance,
        audit: recorded.audit,
        warnings,
    })
}

/// A run ends where its forces stop being numbers, though its motion goes on:
/// of a given motion they are only looked at. A mechanism that stops by itself,
/// or a method that gave up, has its own reason.
fn stopped_at_failure(outcome: Outcome, recorded: &mut Recorded) -> Outcome {
    let Some(failure) = &recorded.failure else {
        return outcome;
    };
    if failure.time == 0.0 && !matches!(outcome.stop, Stop::Physical(_)) {
        // The motion at the start is known, what it takes is not.
        for figures in &mut recorded.figures {
            (figures.peak_acceleration, figures.peak_reaction) = (f64::NAN, f64::NAN);
        }
    }
    match outcome.stop {
        Stop::Complete
        | Stop::WallClock { .. }
        | Stop::Interrupted
        | Stop::TooManySteps { .. }
        | Stop::TooManySwitches { .. } => Outcome {
            time: failure.time,
            stop: Stop::NotFinite {
                what: failure.what.clone(),
            },
            ..outcome
        },
        _ => outcome,
    }
}

/// Steps in a turn of the drive where every motion is given: continuous output of
/// order 6 is then exact to rounding for smooth laws.
const STEPS_IN_CYCLE: f64 = 256.0;
/// Steps in such a run at least.
const STEPS_IN_RUN: f64 = 1024.0;

/// Integrates; follows the drives, finely enough, when there is nothing to integrate.
fn follow(
    system: &System,
    initial: &InitialState,
    duration: f64,
    plan: &Settings,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    let mut plan = plan.clone();
    if system.coordinates() == 0 {
        let cycle = drive_cycle(system.model()).map_or(f64::INFINITY, |c| c / STEPS_IN_CYCLE);
        let greatest = cycle.min(duration / STEPS_IN_RUN);
        plan.step = Some(plan.step.map_or(greatest, |step| step.min(greatest)));
    }
    let InitialState { y, modes, .. } = initial;
    integrate(system, 0.0, duration, y, modes, &plan, limits, sink)
}
