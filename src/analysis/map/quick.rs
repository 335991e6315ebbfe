//! Cells that are propagated exactly and without a recorder: some tens of
//! microseconds each, where a recorded run takes milliseconds.
//!
//! Checked of such a cell is that its run came to the end within its limits,
//! every state and the figure finite, and that no pair grazed (else the cause
//! says so); unless told not to, that the figure hardly moves with the loads.
//! The balance of its energies is not: the motion is a closed form between
//! switches, with no step whose error it could show. A run of the same scene,
//! `dam run`, adds them up.

use super::cell::{Cell, mark, share};
use super::figure::{quick_needs, quick_read, quick_scale};
use super::judge::{Begun, Evidence, judge, on_law};
use super::rigid::RigidMotion;
use super::study::Study;
use super::verdict::Verdict;
use crate::analysis::exact::{Quick, QuickRun, whole_with};
use crate::analysis::spread::{CHANGE, changed_loads};
use crate::analysis::{Control, RunSettings};
use crate::exact::{Asked, KeptLaws};
use crate::fault::Fault;
use crate::integrate::{Method, Stop};
use crate::model::{Closure, ObjectPart};
use crate::record::{ObjectFigures, drive_cycle};
use crate::system::System;
use std::cell::RefCell;

/// Samples in a cycle where the last cycles are looked at.
const SAMPLES: f64 = 256.0;

/// Most samples of a run.
const MOST_SAMPLES: f64 = 1e6;

/// Works out a cell by exact propagation; `None` when the system or the figure
/// asks for a recorded run. No cell in the answer: interrupted.
///
/// # Errors
/// The system has no start.
pub(super) fn answer(
    study: &Study<'_>,
    system: &System,
    settings: &RunSettings,
    (rigid, laws): (&RigidMotion, &RefCell<KeptLaws>),
    control: &Control<'_>,
) -> Option<Result<Option<Cell>, Vec<Fault>>> {
    let (object, name) = qualifies(study, system, settings)?;
    let task = Task {
        system,
        settings,
        control,
        laws,
        figure: (object, name),
    };
    let run = match task.propagate(0)? {
        Ok(run) => run,
        Err(faults) => return Some(Err(faults)),
    };
    if let Some(cell) = failed(&run) {
        return Some(Ok(cell));
    }
    let nothing = ObjectFigures::default();
    let figures = figures(&run, system.model().objects.len(), &nothing);
    let cycle = drive_cycle(system.model()).ok();
    let (verdict, mut cause) = judge(&mut Evidence {
        system,
        figures: figures.clone(),
        rigid,
        cycle,
        time: run.time,
        steady: &mut |object, begun| task.steady(object, begun, cycle?),
    });
    if run.grazing > 0 {
        cause.push_str("; a pair grazes, its switches are not certain");
    }
    let value = quick_read(figures[object], name).filter(|value| value.is_finite());
    let mut cell = Cell {
        value,
        ..Cell::without_value(verdict, cause)
    };
    if study.check_determined
        && let Some(value) = value
    {
        let scale = quick_scale(figures[object], name, run.time);
        match task.moves(value, scale) {
            Some(moved) => mark(&mut cell, moved, study.precision()),
            None => return Some(Ok(None)),
        }
    }
    // What was interrupted in between may have been judged by half of it.
    let interrupted = control.is_spent();
    Some(Ok((!interrupted).then_some(cell)))
}

/// The object and the figure asked for, if exact propagation without a recorder
/// gives them.
fn qualifies<'s>(
    study: &'s Study<'_>,
    system: &System,
    settings: &RunSettings,
) -> Option<(usize, &'s str)> {
    if !matches!(settings.method, None | Some(Method::Exact)) {
        return None;
    }
    let (id, name) = study.figure.split_once('.')?;
    let objects = &system.model().objects;
    let object = objects.iter().position(|part| part.id == id)?;
    // The margin of a rigid pair is known to a recorder only.
    let rigid = |part: &ObjectPart| {
        let pair = part.rigid_pair;
        pair.is_some_and(|pair| pair.closure == Closure::Force)
    };
    if objects[object].links.is_empty() || objects.iter().any(rigid) {
        return None;
    }
    let known = ObjectFigures {
        pair: Some(Default::default()),
        ..ObjectFigures::default()
    };
    quick_read(&known, name).map(|_| (object, name))
}

/// What is run, and what is asked of it.
struct Task<'t> {
    system: &'t System,
    settings: &'t RunSettings,
    control: &'t Control<'t>,
    /// Laws of motion that are known from cells before.
    laws: &'t RefCell<KeptLaws>,
    /// Object and name of the figure.
    figure: (usize, &'t str),
}

impl Task<'_> {
    /// Runs the system; `None` when it cannot be propagated exactly as a whole.
    fn propagate(&self, samples: usize) -> Option<Result<QuickRun, Vec<Fault>>> {
        let parts = whole_with(self.system, &mut self.laws.borrow_mut()).ok()?;
        let place = match self.system.initial_place() {
            Ok(place) => place,
            Err(faults) => return Some(Err(faults)),
        };
        let settings = self.settings;
        let quick = Quick::of(self.system, &parts, &place).with_window(settings.window);
        let limits = self.control.limits(settings);
        // Modes that cannot be separated: a general method does not need them.
        let run = quick.run(
            settings.duration,
            samples,
            Some(&|o| self.asked(o)),
            &limits,
        );
        run.ok().map(Ok)
    }

    /// The figures wanted of an object: the one asked for, and the extremes
    /// of δ, by which a mechanism is judged.
    fn asked(&self, object: usize) -> Asked {
        match object == self.figure.0 {
            true => quick_needs(self.figure.1),
            false => Asked::DEVIATION,
        }
    }

    /// Greatest |δ| over the last whole cycle but one and over the last, from
    /// samples; run again for it, since few cells ask.
    fn steady(&self, object: usize, begun: Begun, cycle: f64) -> Option<[f64; 2]> {
        if begun == Begun::OnLaw {
            let system = System::new(on_law(self.system.model())).ok()?;
            let task = Task {
                system: &system,
                ..*self
            };
            return task.steady(object, Begun::AsGiven, cycle);
        }
        let end = self.settings.duration;
        let samples = (end / cycle * SAMPLES).ceil().clamp(SAMPLES, MOST_SAMPLES);
        let run = self.propagate(samples as usize)?.ok()?;
        let found = run.objects.iter().find(|found| found.object == object)?;
        let last = (end / cycle * (1.0 + 1e-12)).floor() * cycle;
        let over = |from: f64, to: f64| {
            let timed = found.delta.iter().enumerate();
            timed
                .map(|(index, delta)| (end * (index + 1) as f64 / samples, delta.abs()))
                .filter(|&(time, _)| from <= time && time <= to)
                .map(|(_, delta)| delta)
                .reduce(f64::max)
        };
        Some([
            over(last - 2.0 * cycle, last - cycle)?,
            over(last - cycle, last)?,
        ])
    }

    /// How far the figure moves when loads and gaps change by [`CHANGE`], as a
    /// share of `scale`; infinite when it is gone. `None`: interrupted.
    fn moves(&self, value: f64, scale: f64) -> Option<f64> {
        let model = self.system.model();
        let changed = System::new(changed_loads(model.clone(), 1.0 + CHANGE)).ok();
        let run = changed.and_then(|changed| {
            let task = Task {
                system: &changed,
                ..*self
            };
            task.propagate(0)?.ok()
        });
        if run.as_ref().is_some_and(|run| run.stop.is_from_outside()) {
            return None;
        }
        let nothing = ObjectFigures::default();
        let other = run.filter(QuickRun::is_complete).and_then(|run| {
            let all = figures(&run, model.objects.len(), &nothing);
            quick_read(all[self.figure.0], self.figure.1)
        });
        Some(other.map_or(f64::INFINITY, |other| share(other - value, scale)))
    }
}

/// The cell of a run that did not come to its end; none when it was interrupted.
fn failed(run: &QuickRun) -> Option<Option<Cell>> {
    let why = match &run.stop {
        Stop::Complete => return None,
        Stop::Interrupted | Stop::WallClock { .. } => return Some(None),
        Stop::TooManySwitches { bound } => format!("more than {bound} switches"),
        Stop::TooManySteps { bound } => {
            format!("more than {bound} steps in the search for switches")
        }
        other => format!("{other:?}"),
    };
    let cause = format!(
        "exact gave up at {:.6e} s: {why}; no other method was tried",
        run.time
    );
    Some(Some(Cell::without_value(Verdict::NumericalFailure, cause)))
}

/// Figures of all objects of the model, `nothing` for those without any.
fn figures<'r>(
    run: &'r QuickRun,
    objects: usize,
    nothing: &'r ObjectFigures,
) -> Vec<&'r ObjectFigures> {
    let mut all = vec![nothing; objects];
    for object in &run.objects {
        if let Some(figures) = &object.figures {
            all[object.object] = figures;
        }
    }
    all
}
