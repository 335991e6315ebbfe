//! One point of a map.

use super::figure::read;
use super::judge::{Begun, Evidence, judge, on_law};
use super::quick;
use super::rigid::RigidMotion;
use super::scenes::{Kept, Scenes};
use super::study::Study;
use super::verdict::Verdict;
use crate::analysis::run::{RunResult, run};
use crate::analysis::spread::{CHANGE, changed_loads};
use crate::analysis::{Control, RunSettings, Warning};
use crate::fault::Fault;
use crate::integrate::{Method, Stop};
use crate::lower::lower;
use crate::record::{Quantity, Record, drive_cycle};
use crate::scene::TypedScene;
use crate::system::System;

/// Most steps of the run of one cell: where a general method would crawl, a
/// map says so and goes on.
pub const MOST_STEPS: u64 = 20_000_000;

/// Factor on the tolerance of a general method below which a difference may be
/// its own: an accepted step here, a rejected one there.
const OWN_NOISE: f64 = 10.0;

/// One point of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The figure; `None` when there is none: the run stopped, failed or never
    /// began, or the figure is null. Never a number that is not finite.
    pub value: Option<f64>,
    /// The verdict.
    pub verdict: Verdict,
    /// Its cause in words.
    pub cause: String,
    /// How far the figure moves when all loads and gaps change by one part in
    /// 10¹⁰, as a share of its scale; `None`: not asked, no value, or the figure is
    /// gone then.
    pub moved: Option<f64>,
    /// Whether the figure is known to the digits asked for ([`Question::digits`]):
    /// it moves by no more than one of the last; `None`: not asked, or no value.
    ///
    /// [`Question::digits`]: super::Question::digits
    pub determined: Option<bool>,
    /// Least force of the force-closed pairs of the rigid mechanism: see
    /// [`RigidMotion::margin`].
    pub rigid_margin: Option<f64>,
}

impl Cell {
    pub(super) fn without_value(verdict: Verdict, cause: String) -> Self {
        Self {
            value: None,
            verdict,
            cause,
            moved: None,
            determined: None,
            rigid_margin: None,
        }
    }
}

/// Works out one cell; `None` when interrupted.
pub(super) fn evaluate(
    study: &Study<'_>,
    scenes: &mut Scenes<'_>,
    (panel, cell): (usize, usize),
    control: &Control<'_>,
) -> Option<Cell> {
    scenes.show(panel, cell, |scene| {
        let refused = |cause: String| Some(Cell::without_value(Verdict::Refused, cause));
        match scene {
            Ok((scene, kept)) => match prepare(scene) {
                Ok((system, settings)) => judged(study, &system, &settings, kept, control),
                Err(faults) => refused(in_words(&faults)),
            },
            Err(diagnostics) => {
                let errors = diagnostics.items.iter();
                let first = errors.map(|item| item.message.as_str()).next();
                refused(first.unwrap_or("the scene is wrong").to_owned())
            }
        }
    })
}

/// The cell of a system; `None` when interrupted.
fn judged(
    study: &Study<'_>,
    system: &System,
    settings: &RunSettings,
    kept: &mut Kept,
    control: &Control<'_>,
) -> Option<Cell> {
    let rigid = kept.rigid_motion(system.model(), settings.duration);
    if let Some(samples) = &kept.samples {
        system.take_samples(samples.clone());
    }
    let exact = quick::answer(study, system, settings, (&rigid, &kept.exact), control);
    let found = match exact {
        Some(found) => found,
        None => answer(study, system, settings, &rigid, control),
    };
    if kept.samples.is_none() {
        kept.samples = system.samples_of_laws();
    }
    let cell = match found {
        Ok(cell) => cell?,
        Err(faults) => Cell::without_value(Verdict::Refused, in_words(&faults)),
    };
    Some(Cell {
        rigid_margin: rigid.margin,
        ..cell
    })
}

/// A system and how to run it within a map.
fn prepare(scene: &TypedScene) -> Result<(System, RunSettings), Vec<Fault>> {
    let system = System::new(lower(scene)?)?;
    let mut settings = RunSettings::of(scene).map_err(|fault| vec![fault])?;
    settings.max_steps = settings.max_steps.min(MOST_STEPS);
    settings.switch_rows = false;
    Ok((system, settings))
}

fn in_words(faults: &[Fault]) -> String {
    let Some(first) = faults.first() else {
        return "the scene is wrong".to_owned();
    };
    match first.path.is_empty() {
        true => first.message.clone(),
        false => format!("{}: {}", first.path, first.message),
    }
}

/// Runs the system and judges what it did; `None` when interrupted.
fn answer(
    study: &Study<'_>,
    system: &System,
    settings: &RunSettings,
    rigid: &RigidMotion,
    control: &Control<'_>,
) -> Result<Option<Cell>, Vec<Fault>> {
    let result = run(system, settings, control, &mut [])?;
    if result.outcome.stop.is_from_outside() {
        return Ok(None);
    }
    if let Some(cell) = failed(&result) {
        return Ok(Some(cell));
    }
    let cycle = drive_cycle(system.model()).ok();
    let record = &result.record;
    let window = result.figures.run.window;
    let mut again = |object: usize, begun: Begun| {
        let id = &system.model().objects[object].id;
        match begun {
            Begun::AsGiven => steady(record, id, window, cycle),
            Begun::OnLaw => {
                let system = System::new(on_law(system.model())).ok()?;
                let other = run(&system, settings, control, &mut []).ok()?;
                let good = other.is_complete() && failed(&other).is_none();
                good.then(|| steady(&other.record, id, window, cycle))?
            }
        }
    };
    let (verdict, cause) = judge(&mut Evidence {
        system,
        figures: result.figures.objects.values().collect(),
        rigid,
        cycle,
        time: result.outcome.time,
        steady: &mut again,
    });
    // What was interrupted in between may have been judged by half of it.
    if control.is_spent() {
        return Ok(None);
    }
    let value = read(&result.figures, &study.figure).filter(|value| value.is_finite());
    let mut cell = Cell {
        value,
        ..Cell::without_value(verdict, cause)
    };
    if study.check_determined
        && let Some(value) = value
    {
        let Some(moved) = moves(study, system, settings, &result, value, control)? else {
            return Ok(None);
        };
        mark(&mut cell, moved, bound(study, &result, settings));
    }
    Ok(Some(cell))
}

/// The cell of a run that stopped or is not to be trusted.
fn failed(result: &RunResult) -> Option<Cell> {
    let run = &result.figures.run;
    let because = || run.stopped_because.clone().unwrap_or_default();
    if let Stop::Physical(_) = &result.outcome.stop {
        let cause = format!("stops at {:.6e} s: {}", result.outcome.time, because());
        return Some(Cell::without_value(Verdict::Stopped, cause));
    }
    if !result.is_complete() {
        let cause = format!(
            "{} gave up at {:.6e} s: {}",
            run.method,
            result.outcome.time,
            because()
        );
        return Some(Cell::without_value(Verdict::NumericalFailure, cause));
    }
    let spoils = |warning: &&Warning| warning.spoils_figures();
    let warning = result.warnings.iter().find(spoils)?;
    let cause = format!("{}: {warning}", run.method);
    Some(Cell::without_value(Verdict::NumericalFailure, cause))
}

/// Greatest |δ| of an object over the cycle before the window's last and over
/// that last one, from the samples.
fn steady(
    record: &Record,
    id: &str,
    window: Option<[f64; 2]>,
    cycle: Option<f64>,
) -> Option<[f64; 2]> {
    let ([_, end], cycle) = (window?, cycle?);
    let column = record.column(id, Quantity::Delta)?;
    let over = |from: f64, to: f64| {
        let samples = record.times.iter().zip(&column.values);
        samples
            .filter(|&(&time, _)| from <= time && time <= to)
            .map(|(_, value)| value.abs())
            .fold(None, |most: Option<f64>, value| {
                Some(most.map_or(value, |most| most.max(value)))
            })
    };
    Some([
        over(end - 2.0 * cycle, end - cycle)?,
        over(end - cycle, end)?,
    ])
}

/// How far the figure moves when loads and gaps change by [`CHANGE`], as a
/// share of its scale; infinite when it is gone. `None` when interrupted.
fn moves(
    study: &Study<'_>,
    system: &System,
    settings: &RunSettings,
    base: &RunResult,
    value: f64,
    control: &Control<'_>,
) -> Result<Option<f64>, Vec<Fault>> {
    let same_method = RunSettings {
        method: Some(base.method),
        ..settings.clone()
    };
    let changed = changed_loads(system.model().clone(), 1.0 + CHANGE);
    let changed = System::new(changed)?;
    let other = run(&changed, &same_method, control, &mut [])?;
    if other.outcome.stop.is_from_outside() {
        return Ok(None);
    }
    let scale = base.figures.scale(&study.figure);
    let gone = failed(&other).is_some();
    Ok(Some(match read(&other.figures, &study.figure) {
        Some(other) if !gone => share(other - value, scale),
        _ => f64::INFINITY,
    }))
}

pub(super) fn share(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        // A difference without a scale is beyond every bound.
        (difference / scale).abs()
    }
}

/// The greatest move of a figure that is still determined: one of the last digit
/// asked for, and for a general method at least ten times its tolerance.
fn bound(study: &Study<'_>, result: &RunResult, settings: &RunSettings) -> f64 {
    match result.method {
        Method::Rk4 => study.precision(),
        _ => study.precision().max(OWN_NOISE * settings.tolerance),
    }
}

/// Notes how far the figure moves, and whether that is too far; the verdict on the
/// mechanism stays.
pub(super) fn mark(cell: &mut Cell, moved: f64, bound: f64) {
    let determined = moved <= bound;
    if !determined {
        let how = match moved.is_finite() {
            true => format!("moves by {moved:.1e} of its scale"),
            false => "is gone".to_owned(),
        };
        let not = format!("the figure {how} when the loads change by {CHANGE:e}: not determined");
        cell.cause = match cell.cause.as_str() {
            "" => not,
            cause => format!("{cause}; {not}"),
        };
    }
    cell.determined = Some(determined);
    cell.moved = moved.is_finite().then_some(moved);
}
