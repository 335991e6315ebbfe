//! One run: the motion of a mechanism and its figures.

use super::document::{document, summary, warnings_of};
use super::kinematic::{Driven, WithoutIdle, greatest_step};
use super::method::choose_method;
use super::settings::{Control, RunSettings};
use super::warning::Warning;
use crate::fault::Fault;
use crate::integrate::{Dynamics, Limits, Method, Outcome, Settings, Sink, Stop, integrate};
use crate::record::{
    EnergyAudit, Figures, Record, Recorder, RecorderSettings, Tee, choose_window, drive_cycle,
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
/// # Errors
/// The start cannot be found: no static balance, a position out of reach, …;
/// `exact` is asked for and cannot be used.
pub fn run(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
) -> Result<RunResult, Vec<Fault>> {
    let initial = system.initial_state()?;
    let window = choose_window(system.model(), settings.duration, settings.window);
    let choice = choose_method(system, settings)?;
    let mut recorder = Recorder::new(
        system,
        RecorderSettings {
            duration: settings.duration,
            samples: settings.samples,
            switch_rows: settings.switch_rows,
            window: window.as_ref().ok().copied(),
        },
    );
    let mut all: Vec<&mut dyn Sink> = vec![&mut recorder];
    for sink in sinks.iter_mut() {
        all.push(*sink);
    }
    let plan = Settings {
        method: choice.method,
        tolerance: settings.tolerance,
        step: settings.step,
    };
    let limits = control.limits(settings);
    let sink: &mut dyn Sink = &mut Tee(&mut all);
    let duration = settings.duration;
    let outcome = match &choice.parts {
        Some(parts) => super::exact::follow(system, parts, &initial, duration, &limits, sink),
        None => follow(system, &initial, duration, &plan, &limits, sink),
    };
    let recorded = recorder.finish();
    let run = summary(settings, &outcome, &choice, &recorded, window);
    let known_before = system.model().warnings.iter().cloned();
    let mut warnings: Vec<Warning> = known_before
        .chain(initial.warnings)
        .map(Warning::Start)
        .collect();
    warnings.extend(warnings_of(system.model(), settings, &recorded, &run));
    let figures = document(system.model(), settings, &recorded.figures, run, &warnings);
    Ok(RunResult {
        record: recorded.record,
        figures,
        outcome,
        method: choice.method,
        audit: recorded.audit,
        warnings,
    })
}

/// Integrates, or follows the drives when there is nothing to integrate.
fn follow(
    system: &System,
    initial: &InitialState,
    duration: f64,
    plan: &Settings,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    let (driven, modes) = (Driven::new(system), &initial.modes);
    if system.coordinates() > 0 {
        return integrate(
            &driven, 0.0, duration, &initial.y, modes, plan, limits, sink,
        );
    }
    let greatest = greatest_step(duration, drive_cycle(system.model()).ok());
    let plan = Settings {
        step: Some(plan.step.map_or(greatest, |step| step.min(greatest))),
        ..plan.clone()
    };
    let mut sink = WithoutIdle(sink);
    integrate(
        &driven, 0.0, duration, &[0.0; 2], modes, &plan, limits, &mut sink,
    )
}
