//! One run: the motion of a mechanism and its figures.

use super::choice::Choice;
use super::demand::Demand;
use super::document::{document, summary, warnings_of};
use super::exact;
use super::judgement::Judgement;
use super::method::{choose_method, choose_next, fixed_step};
use super::plausible;
use super::settings::{Control, RunSettings};
use super::warning::Warning;
use crate::dynamics::audit::{self, EquationCheck};
use crate::dynamics::integrate::{
    Change, Dynamics, Limits, Method, Outcome, Reserve, Settings, Sink, Stop, integrate_changing,
};
use crate::dynamics::model::{SpanFigure, UNTIL};
use crate::dynamics::record::{
    EnergyAudit, Figures, Record, Recorder, RecorderSettings, RunRecord, RunSummary, SpanExtreme,
    StudyFigure, Tee, check_confirmed_peaks, choose_window, drive_cycle,
};
use crate::dynamics::system::{InitialState, System};
use crate::fault::Fault;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Result of a run.
#[derive(Clone, Debug)]
pub struct RunResult {
    /// Samples, switches, separations.
    pub record: Record,
    /// The figures.
    pub figures: Figures,
    /// Outcome: how it ended.
    pub outcome: Outcome,
    /// The method used.
    pub method: Method,
    /// The tolerance it was given: with `auto` finer than the one asked for.
    pub tolerance: f64,
    /// The energy balance.
    pub audit: EnergyAudit,
    /// The check of its equations of motion, by another way than the one it was computed by.
    pub equations: EquationCheck,
    /// Warnings to the user; also, as text, in the figures.
    pub warnings: Vec<Warning>,
}

impl RunResult {
    /// True when the run reached its end.
    pub fn is_complete(&self) -> bool {
        self.outcome.stop == Stop::Complete
    }

    /// The verdict, with which headline, tables and exit status speak.
    pub fn judgement(&self) -> Judgement {
        Judgement::of(&self.figures)
    }

    /// False when the numbers themselves are in doubt: the energies do not
    /// balance, a number was not finite, or the method gave up. A mechanism that
    /// lifts off or reaches a dead-centre position has perfectly good figures.
    pub fn is_trusted(&self) -> bool {
        self.judgement() != Judgement::NotToBeTrusted
    }
}

/// Runs a system from its start and works out its figures. `sinks` listen
/// beside the recorder.
///
/// Where the choice of the method is left to the program and exact propagation
/// gives up on the way, or the energies do not balance, the run is made anew
/// by another method; the sinks then hear of a second start.
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
    let settings = &settings.with_effective_tolerance();
    let motion = motion(system, settings, Demand::EVERYTHING, control, sinks)?;
    let Motion {
        recorded,
        outcome,
        choice,
        window,
        ..
    } = motion;
    let run = RunSummary {
        equations: motion.equations.clone(),
        ..summary(settings, &outcome, &choice, &recorded, window)
    };
    let known_before = system.model().warnings.iter().cloned();
    let mut warnings: Vec<Warning> = known_before
        .chain(motion.warnings)
        .map(Warning::Start)
        .collect();
    warnings.extend(Warning::of_equations(&motion.equations));
    if outcome.stop == Stop::Complete {
        let unused = plausible::warnings_after(system.model(), &recorded.record);
        warnings.extend(unused.into_iter().map(Warning::Meaning));
    }
    if let (Method::Rk4, Some(step), true) =
        (choice.method, settings.step, system.coordinates() > 0)
    {
        warnings.extend(fixed_step(system, settings, step));
    }
    warnings.extend(warnings_of(system.model(), settings, &recorded, &run));
    let mut figures = document(system.model(), settings, &recorded.figures, run, &warnings);
    add_spans(&mut figures, &settings.spans, &recorded.spans);
    Ok(RunResult {
        record: recorded.record,
        figures,
        outcome,
        method: choice.method,
        tolerance: choice.tolerance,
        audit: recorded.audit,
        equations: motion.equations,
        warnings,
    })
}

/// Adds what was found within parts of the motion, of figures that the whole motion has.
fn add_spans(
    figures: &mut Figures,
    wanted: &[SpanFigure],
    found: &BTreeMap<String, Option<SpanExtreme>>,
) {
    for one in wanted {
        let value = found.get(&one.address).copied().flatten();
        let value = value.map(|extreme| extreme.value);
        let found = StudyFigure {
            value: value.filter(|_| figures.value(&one.figure).is_ok()),
            unit: figures.unit(&one.figure),
        };
        figures.studies.insert(one.address.clone(), found);
    }
}

/// Times that a prescribed motion is followed anew, each time by so many times the steps.
const MOST_REFINEMENTS: u32 = 3;
const REFINEMENT: f64 = 4.0;

/// A motion and what was found of it.
pub(super) struct Motion {
    /// Samples, figures, audit.
    pub(super) recorded: RunRecord,
    /// Outcome: how it ended.
    pub(super) outcome: Outcome,
    /// Choice of method by which it was found.
    pub(super) choice: Choice,
    /// The window of steady figures.
    pub(super) window: Result<[f64; 2], String>,
    /// Warnings about its start.
    pub(super) warnings: Vec<String>,
    /// The check of its equations of motion.
    pub(super) equations: EquationCheck,
    /// Steps of the search for switches over which a pair could not be told from its
    /// flank.
    pub(super) grazing: u64,
}

impl Motion {
    /// True when it came to its end.
    pub(super) fn is_complete(&self) -> bool {
        self.outcome.stop == Stop::Complete
    }

    /// Why its numbers are not to be had, or in doubt, where another method may do better.
    pub(super) fn reason_for_doubt(&self, settings: &RunSettings) -> Option<String> {
        match &self.choice.parts {
            Some(_) => self.doubt_of_exact(settings),
            None => {
                let name = &self.choice.name;
                if !self.is_complete() {
                    return None; // its reserve has been used
                }
                if !self.equations.is_kept() {
                    let equations = &self.equations;
                    return Some(format!(
                        "the equations of motion are not kept by {name}: {equations}"
                    ));
                }
                let unbalanced = !self.balances(settings);
                unbalanced.then(|| format!("the energies of {name} do not balance"))
            }
        }
    }

    fn balances(&self, settings: &RunSettings) -> bool {
        self.recorded.audit.error() <= EnergyAudit::bound(settings.tolerance)
    }

    fn doubt_of_exact(&self, settings: &RunSettings) -> Option<String> {
        match &self.outcome.stop {
            Stop::Method { reason, .. } => Some(format!(
                "exact propagation gave up at t = {} s ({reason})",
                self.outcome.time
            )),
            Stop::NotFinite { what } => Some(format!(
                "exact propagation met what is no finite number at t = {} s ({what})",
                self.outcome.time
            )),
            Stop::Complete if !self.equations.is_kept() => Some(format!(
                "the equations of motion are not kept by exact propagation: {}",
                self.equations
            )),
            Stop::Complete if !self.balances(settings) => {
                Some("the energies of exact propagation do not balance".to_owned())
            }
            _ => None,
        }
    }
}

/// Runs a system from its start for what is wanted of its motion; see [`run`].
///
/// # Errors
/// Those of [`run`].
pub(super) fn motion(
    system: &System,
    settings: &RunSettings,
    demand: Demand<'_>,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
) -> Result<Motion, Vec<Fault>> {
    if system.model().conditions.is_empty() && settings.spans.is_empty() {
        return whole_motion(system, settings, demand, control, sinks);
    }
    // Times are looked for where all is told.
    let demand = Demand {
        figures: None,
        ..demand
    };
    let found = whole_motion(system, settings, demand, control, sinks)?;
    let met = found.recorded.first_times.get(UNTIL).copied().flatten();
    let Some(time) = met.filter(|_| !found.outcome.stop.is_from_outside()) else {
        return Ok(found);
    };
    if time <= 0.0 {
        let message = "the condition holds at t = 0 already: there is no run";
        let hint =
            "a condition that is false at the start, or one with a time: `phi > 0.3 && t > 0.1`";
        return Err(vec![Fault::new("run.until.condition", message, hint)]);
    }
    let since = found.recorded.undetermined_times.get(UNTIL).copied();
    let shorter = ending_at(settings, time);
    let mut found = whole_motion(system, &shorter, demand, control, sinks)?;
    let recorded = &mut found.recorded;
    recorded.first_times.insert(UNTIL.to_owned(), Some(time));
    let since = since.map(|since| (UNTIL.to_owned(), since));
    recorded.undetermined_times.extend(since);
    Ok(found)
}

/// The settings of a run that ends at a time.
fn ending_at(settings: &RunSettings, time: f64) -> RunSettings {
    RunSettings {
        duration: time,
        step: settings.step.map(|step| step.min(time)),
        ..settings.clone()
    }
}

/// The settings of the run up to the time at which the condition of its scene ends it.
///
/// # Errors
/// Those of [`run`].
pub(super) fn settings_until_condition(
    system: &System,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<RunSettings, Vec<Fault>> {
    if !system
        .model()
        .conditions
        .iter()
        .any(|one| one.name == UNTIL)
    {
        return Ok(settings.clone());
    }
    let found = motion(system, settings, Demand::EVERYTHING, control, &mut [])?;
    let met = found.recorded.first_times.get(UNTIL).copied().flatten();
    Ok(met.map_or_else(|| settings.clone(), |time| ending_at(settings, time)))
}

/// The motion up to the end of its duration.
fn whole_motion(
    system: &System,
    settings: &RunSettings,
    demand: Demand<'_>,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
) -> Result<Motion, Vec<Fault>> {
    let choice = choose_method(system, settings, &demand)?;
    let mut tried = Vec::new();
    let mut found = run_by_method(system, settings, &demand, control, sinks, choice)?;
    let whole = Demand {
        figures: None,
        ..demand
    };
    // Of a motion that the drives prescribe nothing is off but the works, which are summed
    // over its steps.
    let mut finer = settings.clone();
    for _ in 0..MOST_REFINEMENTS {
        let known = system.coordinates() == 0 && found.is_complete();
        if !known || found.balances(settings) {
            break;
        }
        let steps = REFINEMENT * found.outcome.statistics.steps.max(1) as f64;
        finer.step = Some(settings.duration / steps);
        let choice = choose_method(system, &finer, &demand)?;
        found = run_by_method(system, &finer, &demand, control, sinks, choice)?;
    }
    while settings.method.is_none()
        && let Some(why) = found.reason_for_doubt(settings)
    {
        if found.choice.parts.is_none() {
            tried.push(found.choice.method);
        }
        let Some(next) = choose_next(system, settings, &why, &tried) else {
            break;
        };
        found = run_by_method(system, settings, &whole, control, sinks, next)?;
    }
    Ok(found)
}

/// Runs once by a method.
fn run_by_method(
    system: &System,
    settings: &RunSettings,
    demand: &Demand<'_>,
    control: &Control<'_>,
    sinks: &mut [&mut dyn Sink],
    choice: Choice,
) -> Result<Motion, Vec<Fault>> {
    let figures = demand.figures;
    let whole = choice.parts.is_some() && choice.rest.is_none();
    let initial = match whole {
        true => system.initial_place()?,
        false => system.initial_state()?,
    };
    let window = choose_window(system.model(), settings.duration, settings.window);
    let light = whole && figures.is_some();
    let recording = RecorderSettings {
        duration: settings.duration,
        samples: if light { 0 } else { settings.samples },
        listing: !light,
        switch_rows: settings.switch_rows && !light,
        masses: settings.masses && !light,
        closeups: settings.closeups && !light,
        window: window.as_ref().ok().copied(),
        long_steps: matches!(choice.method, Method::Taylor | Method::Radau)
            || !choice.reserve.is_empty(),
        implicit: matches!(choice.method, Method::Radau | Method::Rodas5p)
            || !choice.reserve.is_empty(),
        tolerance: settings.tolerance,
        spans: settings.spans.clone(),
        checked: demand.checked,
    };
    let plan = Settings {
        method: choice.method,
        tolerance: choice.tolerance,
        step: settings.step,
    };
    let limits = control.limits(settings);
    let duration = settings.duration;
    let mut choice = choice;
    let changed = RefCell::new(Vec::new());
    let reserve = choice.reserve.clone();
    let plan = &(plan, reserve.as_slice());
    let found = match (&choice.parts, &choice.rest) {
        (Some(parts), Some(rest)) => {
            let own = |initial: &InitialState, sink: &mut dyn Sink| {
                let (outcome, changes) =
                    integrate_by_plan(&rest.system, initial, duration, plan, &limits, sink);
                changed.replace(changes);
                outcome
            };
            let (both, sink) = ((parts, rest), &mut Tee(sinks));
            exact::propagate_with_remainder(system, both, &initial, recording, &limits, sink, own)
        }
        (Some(parts), None) => {
            let sink = &mut Tee(sinks);
            exact::run_whole_system(system, parts, &initial, recording, &limits, figures, sink)
        }
        (None, _) => {
            let mut recorder = Recorder::new(system, recording);
            let mut all: Vec<&mut dyn Sink> = vec![&mut recorder];
            for sink in sinks.iter_mut() {
                all.push(*sink);
            }
            let sink = &mut Tee(&mut all);
            let (outcome, changes) =
                integrate_by_plan(system, &initial, duration, plan, &limits, sink);
            changed.replace(changes);
            exact::MotionFindings {
                recorded: recorder.finish(),
                outcome,
                grazing: 0,
            }
        }
    };
    choice.describe_changes(&changed.into_inner());
    let mut recorded = found.recorded;
    for object in 0..recorded.figures.len() {
        recorded.figures[object].creep = plausible::creep(system.model(), &recorded.record, object);
    }
    let figures = recorded.figures.iter();
    let peaks: Vec<[f64; 3]> = figures
        .map(|own| [own.peak_speed, own.peak_acceleration, own.peak_reaction])
        .collect();
    let asked = audit::AuditScope {
        tolerance: settings.tolerance,
        recorded: !light,
        closed: whole,
    };
    let mut equations = audit::check(system, &recorded.looks, asked, &peaks);
    if !light {
        check_confirmed_peaks(&mut equations, &recorded, system.model(), asked.bound());
    }
    Ok(Motion {
        equations,
        outcome: stopped_at_failure(found.outcome, &mut recorded),
        recorded,
        choice,
        window,
        warnings: initial.warnings,
        grazing: found.grazing,
    })
}

/// A run ends where its forces stop being numbers, though its motion goes on:
/// of a given motion they are only looked at. A mechanism that stops by itself,
/// or a method that gave up, has its own reason.
fn stopped_at_failure(outcome: Outcome, recorded: &mut RunRecord) -> Outcome {
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
/// Steps in such a run at least …
const STEPS_IN_RUN: f64 = 1024.0;
/// … unless a turn would have more than these: laws bend no faster in a short run.
const MOST_STEPS_IN_CYCLE: f64 = 16384.0;

/// Integrates; follows the drives, finely enough, when there is nothing to integrate.
fn integrate_by_plan(
    system: &System,
    initial: &InitialState,
    duration: f64,
    (plan, reserve): &(Settings, &[Reserve]),
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> (Outcome, Vec<Change>) {
    let mut plan = plan.clone();
    if system.coordinates() == 0 {
        let cycle = drive_cycle(system.model()).ok();
        let [longest, shortest] = match cycle {
            Some(cycle) => [cycle / STEPS_IN_CYCLE, cycle / MOST_STEPS_IN_CYCLE],
            None => [f64::INFINITY, 0.0],
        };
        let greatest = longest.min(duration / STEPS_IN_RUN).max(shortest);
        plan.step = Some(plan.step.map_or(greatest, |step| step.min(greatest)));
    }
    let InitialState { y, modes, .. } = initial;
    let plan = (&plan, *reserve);
    integrate_changing(system, 0.0, duration, y, modes, plan, limits, sink)
}
