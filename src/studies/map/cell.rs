//! One point of a map.

use super::ends::failure_verdict;
use super::figure::{figure_of_object, read, scale_of_figure};
use super::judge::{self, Begun, Evidence, judge};
use super::rigid::RigidMotion;
use super::scenes::{MotionCache, Scenes};
use super::study::Study;
use super::verdict::Verdict;
use crate::dynamics::audit::{SEED, draw};
use crate::dynamics::integrate::Method;
use crate::dynamics::record::{Quantity, Record, drive_cycle};
use crate::dynamics::system::System;
use crate::exact::{KeptLaws, RequestedFigures};
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::TypedScene;
use crate::studies::demand::Demand;
use crate::studies::run::{Motion, motion};
use crate::studies::spread::{CHANGE, with_scaled_loads};
use crate::studies::{Control, RunSettings, lookup};
use crate::units::shown;
use std::cell::RefCell;

/// Most steps of the run of one cell: where a general method would crawl, a
/// map says so and goes on.
pub const MOST_STEPS: u64 = 20_000_000;

/// Samples in a cycle where the last cycles of an exact motion are looked at.
const SAMPLES: f64 = 256.0;

/// Most samples of such a run.
const MOST_SAMPLES: f64 = 1e6;

/// Factor on the tolerance of a general method below which a difference may be
/// its own: an accepted step here, a rejected one there.
const OWN_NOISE: f64 = 10.0;

/// Cell: a point of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The figure; `None` when there is none: the run stopped, failed or never
    /// began, or the figure is null. Never a number that is not finite.
    pub value: Option<f64>,
    /// The verdict.
    pub verdict: Verdict,
    /// Cause of the verdict in words.
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
                Ok((system, settings)) => cell_of_system(
                    (study, is_checked_sample(panel, cell)),
                    (scene, &system),
                    &settings,
                    kept,
                    control,
                ),
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

/// True of the cells of a map whose equations of motion are checked: one of so many, drawn by
/// the seed of the check, and the first of all.
fn is_checked_sample(panel: usize, cell: usize) -> bool {
    const ONE_OF: u64 = 16;
    cell == 0 || draw(SEED ^ ((panel as u64) << 32) ^ cell as u64).is_multiple_of(ONE_OF)
}

/// The cell of a system; `None` when interrupted.
fn cell_of_system(
    (study, checked): (&Study<'_>, bool),
    (scene, system): (&TypedScene, &System),
    settings: &RunSettings,
    kept: &mut MotionCache,
    control: &Control<'_>,
) -> Option<Cell> {
    let rigid = kept.rigid_motion(system.model(), settings.duration);
    if let Some(samples) = &kept.samples {
        system.take_samples(samples.clone());
    }
    let task = Task {
        study,
        scene,
        system,
        settings,
        laws: &kept.exact,
        control,
        checked,
    };
    let found = task.answer(&rigid);
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

/// Task of a cell: what is run, and what is asked of it.
#[derive(Clone, Copy)]
struct Task<'t> {
    study: &'t Study<'t>,
    scene: &'t TypedScene,
    system: &'t System,
    settings: &'t RunSettings,
    /// Laws of motion that are known from cells before.
    laws: &'t RefCell<KeptLaws>,
    control: &'t Control<'t>,
    /// True: the equations of motion are checked.
    checked: bool,
}

impl Task<'_> {
    /// Runs the system and judges what it did; `None` when interrupted.
    fn answer(&self, rigid: &RigidMotion) -> Result<Option<Cell>, Vec<Fault>> {
        let found = self.motion(self.system, self.settings)?;
        if found.outcome.stop.is_from_outside() {
            return Ok(None);
        }
        if let Some(cell) = self.cell_of_failed_run(&found) {
            return Ok(Some(cell));
        }
        let cycle = drive_cycle(self.system.model()).ok();
        let (verdict, mut cause) = judge(&mut Evidence {
            system: self.system,
            figures: found.recorded.figures.iter().collect(),
            rigid,
            cycle,
            time: found.outcome.time,
            steady: &mut |object, begun| self.greatest_in_last_cycle(&found, object, begun, cycle?),
        });
        if found.grazing > 0 {
            cause.push_str("; a contact grazes, its events are not certain");
        }
        // What was interrupted in between may have been judged by half of it.
        if self.control.is_spent() {
            return Ok(None);
        }
        let value = self.value(self.system, &found)?;
        let mut cell = Cell {
            value,
            ..Cell::without_value(verdict, cause)
        };
        if self.study.check_determined
            && let Some(value) = value
        {
            let Some(moved) = self.moves(&found, value)? else {
                return Ok(None);
            };
            note_sensitivity(&mut cell, moved, bound(self.study, &found, self.settings));
        }
        Ok(Some(cell))
    }

    /// Runs a system for the figure of the map and what a mechanism is judged by.
    fn motion(&self, system: &System, settings: &RunSettings) -> Result<Motion, Vec<Fault>> {
        let asked = figure_of_object(&self.study.figure, system.model());
        let all = |object: usize| match asked {
            Some((own, asked)) if own == object => asked,
            _ => RequestedFigures::DEVIATION,
        };
        let demand = Demand {
            figures: asked.is_some().then_some(&all),
            laws: Some(self.laws),
            checked: self.checked,
        };
        motion(system, settings, demand, self.control, &mut [])
    }

    /// The figure of the map: of the run, or of another study of the system.
    fn value(&self, system: &System, found: &Motion) -> Result<Option<f64>, Vec<Fault>> {
        let figure = &self.study.figure;
        let subject = lookup::Subject {
            scene: self.scene,
            system,
            settings: self.settings,
            control: self.control,
        };
        let value = match lookup::figure(figure, subject)? {
            Some(of_study) => of_study.value,
            None => read(figure, self.system.model(), self.settings, found),
        };
        Ok(value.filter(|value| value.is_finite()))
    }

    /// The cell of a run that did not come to its end or is not to be trusted.
    fn cell_of_failed_run(&self, found: &Motion) -> Option<Cell> {
        let (verdict, cause) = failure_verdict(self.system.model(), self.settings, found)?;
        Some(Cell::without_value(verdict, cause))
    }

    /// Greatest |δ| of an object over the cycle before the last and over the last one.
    fn greatest_in_last_cycle(
        &self,
        found: &Motion,
        object: usize,
        begun: Begun,
        cycle: f64,
    ) -> Option<[f64; 2]> {
        let id = &self.system.model().objects[object].id;
        if begun == Begun::AsGiven && !found.recorded.record.times.is_empty() {
            return self.over_last_cycles(found, id, cycle);
        }
        // Run again for it, since few cells ask.
        let on_law;
        let system = match begun {
            Begun::AsGiven => self.system,
            Begun::OnLaw => {
                on_law = System::new(judge::on_law(self.system.model())).ok()?;
                &on_law
            }
        };
        let samples = (self.settings.duration / cycle * SAMPLES).ceil();
        let settings = RunSettings {
            samples: match found.choice.method {
                Method::Exact => samples.clamp(SAMPLES, MOST_SAMPLES) as usize,
                _ => self.settings.samples,
            },
            ..self.settings.clone()
        };
        let demand = Demand {
            laws: Some(self.laws),
            ..Demand::EVERYTHING
        };
        let again = motion(system, &settings, demand, self.control, &mut []).ok()?;
        let good = again.is_complete() && self.cell_of_failed_run(&again).is_none();
        good.then(|| self.over_last_cycles(&again, id, cycle))?
    }

    fn over_last_cycles(&self, found: &Motion, id: &str, cycle: f64) -> Option<[f64; 2]> {
        let window = found.window.as_ref().ok();
        let whole = (found.outcome.time / cycle * (1.0 + 1e-12)).floor() * cycle;
        let end = window.map_or(whole, |[_, to]| *to);
        greatest_in_last_cycle(&found.recorded.record, id, end, cycle)
    }

    /// How far the figure moves when loads and gaps change by [`CHANGE`], as a
    /// share of its scale; infinite when it is gone. `None` when interrupted.
    fn moves(&self, base: &Motion, value: f64) -> Result<Option<f64>, Vec<Fault>> {
        let same_method = RunSettings {
            method: Some(base.choice.method),
            // (Of `auto` finer than the one asked for.)
            tolerance: base.choice.tolerance,
            ..self.settings.clone()
        };
        let changed = with_scaled_loads(self.system.model().clone(), 1.0 + CHANGE);
        let changed = System::new(changed)?;
        let other = self.motion(&changed, &same_method)?;
        if other.outcome.stop.is_from_outside() {
            return Ok(None);
        }
        let scale = match lookup::is_address(&self.study.figure) {
            true => value.abs(),
            false => scale_of_figure(&self.study.figure, self.system.model(), self.settings, base),
        };
        let gone = self.cell_of_failed_run(&other).is_some();
        Ok(Some(match self.value(&changed, &other)? {
            Some(other) if !gone => relative_difference(other - value, scale),
            _ => f64::INFINITY,
        }))
    }
}

/// Greatest |δ| of an object over the cycle before the last one and over that which
/// ends at `end` (s), from the samples.
fn greatest_in_last_cycle(record: &Record, id: &str, end: f64, cycle: f64) -> Option<[f64; 2]> {
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

fn relative_difference(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        // A difference without a scale is beyond every bound.
        (difference / scale).abs()
    }
}

/// The greatest move of a figure that is still determined: one of the last digit
/// asked for, and for a method with steps of a tolerance at least ten times that.
fn bound(study: &Study<'_>, found: &Motion, settings: &RunSettings) -> f64 {
    match found.choice.method {
        Method::Rk4 | Method::Exact => study.precision(),
        _ => study.precision().max(OWN_NOISE * settings.tolerance),
    }
}

/// Notes how far the figure moves, and whether that is too far; the verdict on the
/// mechanism stays.
fn note_sensitivity(cell: &mut Cell, moved: f64, bound: f64) {
    let determined = moved <= bound;
    if !determined {
        let how = match moved.is_finite() {
            true => format!("moves by {moved} of its scale", moved = shown(moved, 2)),
            false => "is gone".to_owned(),
        };
        let not = format!("the result {how} when the loads change by {CHANGE:e}: not determined");
        cell.cause = match cell.cause.as_str() {
            "" => not,
            cause => format!("{cause}; {not}"),
        };
    }
    cell.determined = Some(determined);
    cell.moved = moved.is_finite().then_some(moved);
}
