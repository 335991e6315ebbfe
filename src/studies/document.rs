//! The document of figures that a run gives, and what there is to say of it.

use super::choice::Choice;
use super::plausible::may_creep;
use super::settings::RunSettings;
use super::warning::Warning;
use crate::dynamics::integrate::{Outcome, Stop};
use crate::dynamics::model::{Closure, Coordinate, LinkBase, Model, ObjectPart};
use crate::dynamics::record::{
    CreepFigures, EnergyAudit, EquationCheck, Figures, ImpactFigures, JointFigures, ObjectFigures,
    PairFigures, PressingFigures, RunRecord, RunSummary, StopFigures, Units, acceleration_rounding,
    drive_cycle,
};
use crate::units::shown;

/// Switches of an undamped contact from which on its figures are called undetermined.
const MANY_SWITCHES: usize = 10;

/// Summary of a run.
pub(super) fn summary(
    settings: &RunSettings,
    outcome: &Outcome,
    choice: &Choice,
    recorded: &RunRecord,
    window: Result<[f64; 2], String>,
) -> RunSummary {
    let complete = outcome.stop == Stop::Complete;
    let window = window.and_then(|[from, to]| {
        if complete || outcome.time >= to {
            Ok([from, to])
        } else {
            Err(format!(
                "the run stopped at {} s, before the window ends at {} s",
                shown(outcome.time, 7),
                shown(to, 7)
            ))
        }
    });
    let stopped = (!complete).then(|| stop_in_words(&outcome.stop));
    RunSummary {
        method: choice.name.clone(),
        why: choice.why.clone(),
        tolerance: settings.tolerance,
        tolerance_why: settings.of_accuracy.as_ref().map(|found| found.why.clone()),
        time: outcome.time,
        complete,
        stopped: stopped.as_ref().map(|(name, _)| (*name).to_owned()),
        stopped_because: stopped.map(|(_, words)| words),
        steps: outcome.statistics.steps,
        rejected: outcome.statistics.rejected,
        evaluations: outcome.statistics.evaluations,
        switches: outcome.statistics.switches,
        energy_error: recorded.audit.error(),
        equations: EquationCheck::default(),
        first_times: recorded.first_times.clone(),
        undetermined_times: recorded.undetermined_times.clone(),
        window: window.as_ref().ok().copied(),
        window_missing: window.err(),
    }
}

/// Short name and words for a run that did not reach its end.
pub(super) fn stop_in_words(stop: &Stop) -> (&'static str, String) {
    match stop {
        Stop::Complete => ("complete", "the end time was reached".to_owned()),
        Stop::Physical(stop) => (stop.name, stop.message.clone()),
        Stop::NotFinite { what } => ("not_finite", format!("{what} is no longer a finite number")),
        Stop::StepFloor { step } => (
            "step_floor",
            format!(
                "the step that the tolerance needs, {} s, is below what the clock resolves",
                shown(*step, 3)
            ),
        ),
        Stop::TooManySwitches { bound } => (
            "too_many_switches",
            format!("more than {bound} events; raise run.max_switches if they are meant"),
        ),
        Stop::TooManySteps { bound } => ("too_many_steps", format!("more than {bound} steps")),
        Stop::WallClock { limit } => (
            "wall_clock",
            format!("the time limit of {} s was reached", limit.as_secs_f64()),
        ),
        Stop::Interrupted => ("interrupted", "interrupted".to_owned()),
        Stop::Method { method, reason } => ("method", format!("{method}: {reason}")),
    }
}

/// The first of what puts the numbers of a run in doubt.
pub(super) fn spoiling(recorded: &RunRecord, settings: &RunSettings) -> Option<Warning> {
    if recorded.failure.is_some() || !recorded.audit.error().is_finite() {
        return Some(Warning::NotFinite);
    }
    out_of_balance(recorded, settings)
}

fn out_of_balance(recorded: &RunRecord, settings: &RunSettings) -> Option<Warning> {
    let error = recorded.audit.error();
    let bound = EnergyAudit::bound(settings.tolerance);
    (error > bound).then_some(Warning::EnergyAudit { error, bound })
}

/// Warnings beside the figures.
pub(super) fn warnings_of(
    model: &Model,
    settings: &RunSettings,
    recorded: &RunRecord,
    run: &RunSummary,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    // What locks at the very start has no accelerations there, and says so.
    let locks = run.time == 0.0 && run.stopped.as_deref() == Some("self_locking");
    let spoiling = spoiling(recorded, settings);
    warnings.extend(spoiling.filter(|warning| !(locks && *warning == Warning::NotFinite)));
    warnings.extend(out_of_balance(recorded, settings));
    warnings.dedup();
    let has_pair = recorded
        .figures
        .iter()
        .any(|figures| figures.pair.is_some());
    if let (true, Some(reason)) = (has_pair, &run.window_missing) {
        warnings.push(Warning::WindowMissing {
            reason: reason.clone(),
            longer: settings.window.is_some() || drive_cycle(model).is_ok(),
        });
    }
    for &(object, margin, time) in recorded.margins.iter().filter(|entry| entry.1 < 0.0) {
        let part = &model.objects[object];
        warnings.push(Warning::WouldLiftOff {
            object: part.id.clone(),
            margin,
            unit: units(part.coordinate).force,
            time,
        });
    }
    warnings.extend(undetermined_times(recorded));
    for object in 0..model.objects.len() {
        warnings.extend(rounded_acceleration(model, object, recorded));
        warnings.extend(pair_warnings(model, object, recorded, run.time));
        let part = &model.objects[object];
        warnings.extend(recorded.figures[object].creep.map(|creep| Warning::Creeps {
            object: part.id.clone(),
            creep,
            units: units(part.coordinate),
        }));
    }
    warnings
}

/// Warnings that results of a run are not determined. Of a peak acceleration that was not
/// looked for nothing is said.
pub(super) fn doubts<'d>(
    model: &'d Model,
    recorded: &'d RunRecord,
) -> impl Iterator<Item = Warning> + 'd {
    let of_object = move |object: usize| {
        let sought = recorded.figures[object].peak_acceleration > 0.0;
        let rounded = sought.then(|| rounded_acceleration(model, object, recorded));
        let of_pair = pair_warnings(model, object, recorded, f64::INFINITY).into_iter();
        rounded.flatten().into_iter().chain(of_pair)
    };
    let of_objects = (0..model.objects.len()).flat_map(of_object);
    let all = undetermined_times(recorded).chain(of_objects);
    all.filter(Warning::leaves_open)
}

fn undetermined_times(recorded: &RunRecord) -> impl Iterator<Item = Warning> + '_ {
    let undetermined = recorded.undetermined_times.iter();
    undetermined.map(|(name, since)| Warning::FirstTimeUndetermined {
        name: name.clone(),
        since: *since,
        found: recorded.first_times.get(name).copied().flatten(),
    })
}

/// An acceleration of which rounding may be more than this share is said to be rounded.
const ROUNDED: f64 = 0.01;

fn rounded_acceleration(model: &Model, object: usize, recorded: &RunRecord) -> Option<Warning> {
    let (part, own) = (&model.objects[object], &recorded.figures[object]);
    let rounding = acceleration_rounding(model, object, own);
    (rounding > ROUNDED * own.peak_acceleration).then(|| Warning::RoundedAcceleration {
        object: part.id.clone(),
        rounding,
        peak: own.peak_acceleration,
        force: own.peak_reaction,
        units: units(part.coordinate),
    })
}

/// How often a pair that has just switched switches again at the same instant, to
/// rounding, and when first. (One that falls through a gap takes longer than that.)
fn returns(switch_times: &[f64]) -> Option<(usize, f64)> {
    let same = |pair: &&[f64]| pair[1] - pair[0] <= 2.0 * f64::EPSILON * pair[1];
    let mut returned = switch_times.windows(2).filter(same).map(|pair| pair[0]);
    let first = returned.next()?;
    Some((1 + returned.count(), first))
}

fn pair_warnings(model: &Model, object: usize, recorded: &RunRecord, time: f64) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let part = &model.objects[object];
    if let Some(stop) = &recorded.figures[object].stop
        && let Some((returns, time)) = returns(&stop.switch_times)
    {
        warnings.push(Warning::SwitchesUndetermined {
            object: part.id.clone(),
            returns,
            time,
        });
    }
    let Some(pair) = &recorded.figures[object].pair else {
        return warnings;
    };
    if pair.separated_time > 0.0 {
        warnings.push(Warning::Opens {
            object: part.id.clone(),
            separations: pair.separations,
            separated_time: pair.separated_time,
            share: pair.separated_time / time,
            judged: pair.in_working_order.is_some(),
        });
    }
    // Without a gap a pair goes from flank to flank at one instant, and rightly.
    let of_pair = model.pair(part);
    let through = of_pair.is_some_and(|pair| pair.closure == Closure::Form && pair.gap == 0.0);
    if let (false, Some((returns, time))) = (through, returns(&pair.switch_times)) {
        warnings.push(Warning::SwitchesUndetermined {
            object: part.id.clone(),
            returns,
            time,
        });
    }
    if is_undamped(model, part) && pair.switch_times.len() >= MANY_SWITCHES {
        warnings.push(Warning::Undetermined {
            object: part.id.clone(),
            switches: pair.switch_times.len(),
        });
    }
    warnings
}

/// The document of a run.
pub(super) fn document(
    model: &Model,
    settings: &RunSettings,
    figures: &[ObjectFigures],
    run: RunSummary,
    warnings: &[Warning],
) -> Figures {
    let figured = model.objects.iter().zip(figures);
    let reported = || figured.clone().filter(|(part, _)| part.is_reported());
    Figures {
        dam: 1,
        scene: settings.scene.clone(),
        hash: settings.hash.clone(),
        units: reported()
            .map(|(part, _)| (part.id.clone(), units(part.coordinate)))
            .collect(),
        objects: reported()
            .map(|(part, figures)| (part.id.clone(), figures.clone()))
            .collect(),
        run,
        studies: std::collections::BTreeMap::new(),
        warnings: warnings.iter().map(ToString::to_string).collect(),
    }
}

/// The document of a run that has not begun: every figure that a run of this
/// model will have, at zero.
pub(super) fn blank(model: &Model) -> Figures {
    let figures: Vec<ObjectFigures> = (model.objects.iter().enumerate())
        .map(|(index, part)| ObjectFigures {
            stop: model.stop(index).map(|stop| StopFigures {
                impacts: stop.law.is_rigid().then(ImpactFigures::default),
                ..StopFigures::default()
            }),
            pair: can_open(model, part).then(|| PairFigures {
                margin: part.rigid_pair.map(|_| 0.0),
                max_indentation: part.indented().map(|_| 0.0),
                impacts: part.strikes().map(|_| ImpactFigures::default()),
                ..PairFigures::default()
            }),
            pressing: part.pressing.as_ref().map(|_| PressingFigures::default()),
            creep: may_creep(model, index).then(CreepFigures::default),
            joints: has_active_friction(model, part).then(JointFigures::default),
            ..ObjectFigures::default()
        })
        .collect();
    let settings = RunSettings::new(0.0);
    let conditions = model.conditions.iter();
    let run = RunSummary {
        first_times: conditions.map(|one| (one.name.clone(), None)).collect(),
        ..RunSummary::default()
    };
    document(model, &settings, &figures, run, &[])
}

/// True when the friction of the object's joints acts on the motion, or dry friction on it.
fn has_active_friction(model: &Model, part: &ObjectPart) -> bool {
    let mut dry = (model.loads.iter()).filter(|load| load.law.dry_friction().is_some());
    if dry.any(|load| part.nodes.contains(&model.owner_of_load(load))) {
        return true;
    }
    let of_one = model.linkages.iter();
    let of_one = of_one.map(|body| (body.node, &body.friction));
    let of_several = model.multi_linkages.iter();
    let of_several = of_several.map(|body| (body.node, &body.friction));
    let mut all = of_one.chain(of_several);
    let friction = all.find(|(node, _)| part.nodes.contains(node));
    let friction = friction.and_then(|(_, friction)| friction.as_ref());
    friction.is_some_and(|kinetostatics| kinetostatics.has_friction())
}

/// True when the object's pair can open, or, of a rigid object, would open if it could.
pub(super) fn can_open(model: &Model, part: &ObjectPart) -> bool {
    let elastic = model.elastic_pair(part);
    let elastic = elastic.is_some_and(|pair| pair.closure != Closure::Bilateral);
    let rigid = part
        .rigid_pair
        .is_some_and(|pair| pair.closure == Closure::Force);
    elastic || rigid
}

/// True when nothing takes energy out of the object's links and contact.
fn is_undamped(model: &Model, part: &ObjectPart) -> bool {
    let contact = part.contact.map(|contact| contact.link);
    part.links.iter().copied().chain(contact).all(|link| {
        let link = &model.links[link];
        let lossy_contact = matches!(&link.base,
            LinkBase::Law { pair } if !pair.form.is_lossless());
        link.damping == 0.0 && !lossy_contact
    })
}

/// Units of an object's figures.
pub(super) fn units(coordinate: Coordinate) -> Units {
    let [displacement, force] = coordinate.units();
    Units {
        displacement,
        force,
    }
}
