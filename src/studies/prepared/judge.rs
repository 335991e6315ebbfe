//! From the figures of a run to the verdict on the mechanism, with its cause.

use super::rigid::RigidMotion;
use super::verdict::{NEAR_HARMONIC, RESONANCE, STEADY, THROWN_OFF, Verdict};
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::model::{Model, Start};
use crate::dynamics::record::{ObjectFigures, PairFigures};
use crate::dynamics::system::{Regime, System};
use crate::studies::document::units;
use crate::studies::judgement::Judgement;
use crate::units::shown;
use std::f64::consts::TAU;

/// Evidence that a verdict rests on.
pub(super) struct Evidence<'a> {
    /// The system.
    pub(super) system: &'a System,
    /// Figures of every object, in the order of the model's objects.
    pub(super) figures: Vec<&'a ObjectFigures>,
    /// The rigid mechanism.
    pub(super) rigid: &'a RigidMotion,
    /// Time of one turn of the drive (s), when that is constant.
    pub(super) cycle: Option<f64>,
    /// Simulated time (s).
    pub(super) time: f64,
    /// Greatest |δ| of an object over the last whole cycle but one and over
    /// the last; `None` without them.
    pub(super) steady: &'a mut dyn FnMut(usize, Begun) -> Option<[f64; 2]>,
}

/// Start of a motion that is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Begun {
    /// As the scene says.
    AsGiven,
    /// On the law: what it then reaches, the drive has built up.
    OnLaw,
}

/// The verdict on a mechanism whose run is complete and to be trusted.
pub(super) fn judge(evidence: &mut Evidence<'_>) -> (Verdict, String) {
    let objects = evidence.system.model().objects.len();
    // The worst of the objects speaks for the mechanism.
    let opened = (0..objects)
        .filter_map(|object| separation_verdict(evidence, object))
        .max_by_key(|(verdict, _)| severity(*verdict));
    let whole = Judgement::of_objects(reported(evidence.system.model(), &evidence.figures));
    if let Some(found) = opened.filter(|(verdict, _)| verdict.judgement() == Some(whole)) {
        return found;
    }
    if whole == Judgement::NotJudged {
        return match (0..objects).find_map(|object| creep_cause(evidence, object)) {
            Some(cause) => (Verdict::CreepNotJudged, cause),
            None => {
                let cause = "no loss of contact; there is no window in which to see whether it \
                             goes on";
                (Verdict::NotJudged, cause.to_owned())
            }
        };
    }
    if let Some(cause) = (0..objects).find_map(|object| resonates(evidence, object)) {
        return (Verdict::Resonance, cause);
    }
    let cause = match evidence.rigid.margin {
        Some(margin) => format!(
            "no loss of contact; rigid, the least contact force is {margin}",
            margin = shown(margin, 7)
        ),
        None => "no loss of contact".to_owned(),
    };
    (Verdict::InWorkingOrder, cause)
}

/// The figures of the objects by which a run is judged: the inner parts of modes are none.
pub(super) fn reported<'f>(
    model: &Model,
    figures: &[&'f ObjectFigures],
) -> impl Iterator<Item = &'f ObjectFigures> {
    let all = model.objects.iter().zip(figures);
    all.filter(|(part, _)| part.is_reported())
        .map(|(_, figures)| *figures)
}

/// Where regularised friction lets an object creep.
fn creep_cause(evidence: &Evidence<'_>, object: usize) -> Option<String> {
    let creep = evidence.figures[object].creep?;
    let part = &evidence.system.model().objects[object];
    let units = units(part.coordinate);
    Some(format!(
        "{} creeps at {} {}/s under {} {} of friction; it would rest",
        part.id,
        shown(creep.speed, 4),
        units.displacement,
        shown(creep.force, 4),
        units.force
    ))
}

fn severity(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::ThrownOff => 4,
        Verdict::LiftOff => 3,
        Verdict::LiftOffNotJudged => 2,
        Verdict::LiftOffDiesAway => 1,
        Verdict::InWorkingOrder
        | Verdict::NotJudged
        | Verdict::CreepNotJudged
        | Verdict::Resonance
        | Verdict::Stopped
        | Verdict::NotFinished
        | Verdict::NumericalFailure
        | Verdict::Refused => 0,
    }
}

/// The verdict on an object whose pair opens at some time.
fn separation_verdict(evidence: &Evidence<'_>, object: usize) -> Option<(Verdict, String)> {
    let figures = evidence.figures[object];
    let pair = figures.pair.as_ref()?;
    let id = &evidence.system.model().objects[object].id;
    if let Some(margin) = pair.margin.filter(|&margin| margin < 0.0) {
        let cause = format!(
            "rigid {id} would lift off: its pair would have to pull with {}",
            shown(-margin, 7)
        );
        return Some((Verdict::LiftOff, cause));
    }
    if pair.separations == 0 && pair.separated_time <= 0.0 {
        return None;
    }
    let greatest = greatest(figures);
    let amplitude = evidence.rigid.amplitude[object];
    let thrown = amplitude.filter(|&amplitude| greatest > THROWN_OFF * amplitude);
    let leaves = thrown.map(|amplitude| {
        let times = greatest / amplitude;
        format!("deviates from its law by {times:.3} times the law's amplitude")
    });
    let mut how = in_words(evidence, pair);
    let judgement = Judgement::of_pair(pair);
    if let Some(leaves) = leaves {
        if judgement == Judgement::NotInWorkingOrder {
            return Some((Verdict::ThrownOff, format!("{id} {leaves}")));
        }
        how = format!("{leaves} and {how}");
    }
    Some(match judgement {
        Judgement::NotInWorkingOrder => (Verdict::LiftOff, format!("{id} {how}")),
        Judgement::InWorkingOrder => {
            let last = pair.switch_times.last().copied().unwrap_or(0.0);
            let cause = format!("{id} {how}, not after {last} s", last = shown(last, 7));
            (Verdict::LiftOffDiesAway, cause)
        }
        Judgement::NotJudged | Judgement::NotToBeTrusted => {
            let cause =
                format!("{id} {how}; there is no window in which to see whether it goes on");
            (Verdict::LiftOffNotJudged, cause)
        }
    })
}

/// How often and how long a pair opens, and in how many cycles.
fn in_words(evidence: &Evidence<'_>, pair: &PairFigures) -> String {
    let mut text = format!(
        "separates {} times, for {} s at most",
        pair.separations,
        shown(pair.longest_separation, 5)
    );
    if let Some(cycle) = evidence.cycle {
        // A run meant as whole cycles may fall short by rounding.
        let all = (evidence.time / cycle * (1.0 + 1e-12)).floor();
        let mut cycles: Vec<u64> = (pair.switch_times.iter())
            .map(|time| (time / cycle) as u64)
            .filter(|&cycle| (cycle as f64) < all)
            .collect();
        cycles.dedup();
        text.push_str(&format!(
            ", with events in {} of {all} cycles",
            cycles.len()
        ));
    }
    text
}

fn greatest(figures: &ObjectFigures) -> f64 {
    figures.delta_abs
}

/// Why an object that stays engaged is in resonance; `None`: it is not.
fn resonates(evidence: &mut Evidence<'_>, object: usize) -> Option<String> {
    let system = evidence.system;
    let cycle = evidence.cycle?;
    // Asked first, since it costs nothing: the whole run holds the last cycle.
    let greatest = greatest(evidence.figures[object]);
    if greatest < RESONANCE * system.least_deflection(object) {
        return None;
    }
    // δ*: see `System::scales`.
    let quasi_static = system.scales()[system.first_coordinate(object)?];
    if greatest < RESONANCE * quasi_static {
        return None;
    }
    let large = |[before, last]: &[f64; 2]| {
        *last >= RESONANCE * quasi_static && *last >= (1.0 - STEADY) * before
    };
    let [before, last] = (evidence.steady)(object, Begun::AsGiven).filter(large)?;
    let (frequency, harmonic, ratio) = nearest_harmonic(system, TAU / cycle)?;
    if (1.0 - ratio * ratio).abs() * NEAR_HARMONIC > 1.0 {
        return None;
    }
    // A start of one's own may be a free vibration as large as one likes, which
    // without damping goes on for ever beside any drive.
    if matches!(system.model().start, Start::Explicit(_)) {
        (evidence.steady)(object, Begun::OnLaw).filter(large)?;
    }
    Some(format!(
        "{}: {:.3} times the quasi-static deflection in the last cycle, {:.3} times in the one \
         before; harmonic {harmonic} of the drive is at {ratio:.4} of the natural frequency \
         {frequency} rad/s",
        id(system.model(), object),
        last / quasi_static,
        before / quasi_static,
        frequency = shown(frequency, 7)
    ))
}

/// The model from a start on its law.
pub(super) fn on_law(model: &Model) -> Model {
    Model {
        start: Start::OnLaw,
        ..model.clone()
    }
}

fn id(model: &Model, object: usize) -> &str {
    &model.objects[object].id
}

/// The natural frequency that lies nearest to a harmonic of `drive` (rad/s), in
/// ratio, with the number of the harmonic and kΩ/ω.
fn nearest_harmonic(system: &System, drive: f64) -> Option<(f64, u64, f64)> {
    let frequencies = system.natural_frequencies(Regime::Engaged).into_iter();
    let candidates = frequencies
        .filter(|&frequency| frequency > 0.0)
        .map(|frequency| {
            let harmonic = (frequency / drive).round().max(1.0);
            let ratio = harmonic * drive / frequency;
            (frequency, harmonic as u64, ratio)
        });
    candidates.min_by(|a, b| (a.2 - 1.0).abs().total_cmp(&(b.2 - 1.0).abs()))
}
