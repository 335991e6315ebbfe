//! Cells that are propagated exactly and without a recorder: some tens of
//! microseconds each, where a recorded run takes milliseconds.

use super::cell::{Cell, mark, share};
use super::figure::{quick_read, quick_scale};
use super::judge::{Evidence, judge};
use super::rigid::RigidMotion;
use super::study::Study;
use super::verdict::Verdict;
use crate::analysis::RunSettings;
use crate::analysis::exact::{Quick, QuickRun, whole};
use crate::analysis::spread::{CHANGE, DETERMINED, changed_loads};
use crate::fault::Fault;
use crate::integrate::Method;
use crate::model::{Closure, ObjectPart};
use crate::record::{ObjectFigures, drive_cycle};
use crate::system::System;

/// Samples in a cycle where the last cycles are looked at.
const SAMPLES: f64 = 256.0;

/// Most samples of a run.
const MOST_SAMPLES: f64 = 1e6;

/// Works out a cell by exact propagation; `None` when the system or the figure
/// asks for a recorded run.
///
/// # Errors
/// The system has no start.
pub(super) fn answer(
    study: &Study<'_>,
    system: &System,
    settings: &RunSettings,
    rigid: &RigidMotion,
) -> Option<Result<Cell, Vec<Fault>>> {
    let (object, name) = qualifies(study, system, settings)?;
    let run = match propagate(system, settings, 0)? {
        Ok(run) => run,
        Err(faults) => return Some(Err(faults)),
    };
    if let Some(cell) = failed(&run, settings) {
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
        steady: &mut |object| steady(system, settings, object, cycle?),
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
        mark(
            &mut cell,
            moves(system, settings, object, name, value, scale),
            DETERMINED,
        );
    }
    Some(Ok(cell))
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

/// Runs the system; `None` when it cannot be propagated exactly as a whole.
fn propagate(
    system: &System,
    settings: &RunSettings,
    samples: usize,
) -> Option<Result<QuickRun, Vec<Fault>>> {
    let parts = whole(system).ok()?;
    let initial = match system.initial_state() {
        Ok(initial) => initial,
        Err(faults) => return Some(Err(faults)),
    };
    let quick = Quick::of(system, &parts, &initial.y).with_window(settings.window);
    // Modes that cannot be separated: a general method does not need them.
    let run = quick.run(settings.duration, samples, true, settings.max_switches);
    run.ok().map(Ok)
}

/// The cell of a run that did not come to its end.
fn failed(run: &QuickRun, settings: &RunSettings) -> Option<Cell> {
    (!run.complete).then(|| {
        let cause = format!(
            "exact gave up at {:.6e} s: more than {} switches",
            run.time, settings.max_switches
        );
        Cell::without_value(Verdict::NumericalFailure, cause)
    })
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

/// Greatest |δ| over the last whole cycle but one and over the last, from
/// samples; run again for it, since few cells ask.
fn steady(system: &System, settings: &RunSettings, object: usize, cycle: f64) -> Option<[f64; 2]> {
    let end = settings.duration;
    let samples = (end / cycle * SAMPLES).ceil().clamp(SAMPLES, MOST_SAMPLES);
    let run = propagate(system, settings, samples as usize)?.ok()?;
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

/// How far the figure moves when loads and gaps change by [`CHANGE`], as a share
/// of `scale`; infinite when it is gone.
fn moves(
    system: &System,
    settings: &RunSettings,
    object: usize,
    name: &str,
    value: f64,
    scale: f64,
) -> f64 {
    let changed = changed_loads(system.model().clone(), 1.0 + CHANGE);
    let changed = System::new(changed);
    let run = changed
        .ok()
        .and_then(|changed| propagate(&changed, settings, 0)?.ok());
    let nothing = ObjectFigures::default();
    let other = run.filter(|run| run.complete).and_then(|run| {
        let all = figures(&run, system.model().objects.len(), &nothing);
        quick_read(all[object], name)
    });
    other.map_or(f64::INFINITY, |other| share(other - value, scale))
}
