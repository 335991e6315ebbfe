//! Exact propagation of whole scenes.

mod clock;
#[cfg(test)]
mod mixed_tests;
mod quick;
#[cfg(test)]
mod tests;

pub use quick::{Quick, QuickObject, QuickRun};

use crate::exact::playback::{Beside, Piece, play, play_beside};
use crate::exact::{KeptLaws, Parts, Rest};
use crate::fault::Fault;
use crate::integrate::{Dynamics, Limits, Outcome, Sink};
use crate::record::drive_cycle;
use crate::system::{InitialState, System};

/// Steps in a turn of the drive at least: objects that are only observed move
/// by laws of their own.
const STEPS_IN_CYCLE: f64 = 64.0;

/// Steps in a run at least.
const STEPS_IN_RUN: f64 = 64.0;

/// The parts of a system, if all of it can be propagated exactly.
///
/// # Errors
/// A fault for every object that stands against it, naming the reason.
pub fn whole(system: &System) -> Result<Parts, Vec<Fault>> {
    whole_with(system, &mut KeptLaws::default())
}

/// The same, with the laws of a system before that moves by the same ones.
///
/// # Errors
/// The same.
pub fn whole_with(system: &System, laws: &mut KeptLaws) -> Result<Parts, Vec<Fault>> {
    let parts = Parts::with_laws(system, laws);
    if parts.is_whole() {
        return Ok(parts);
    }
    let faults: Vec<Fault> = parts
        .refusals
        .iter()
        .map(|refusal| fault(&refusal.object, &refusal.reason))
        .collect();
    if faults.is_empty() {
        return Err(vec![Fault::new(
            "run.method",
            "`exact` cannot be used: nothing is elastic",
            "\"auto\": the motion follows from the drives",
        )]);
    }
    Err(faults)
}

/// The same, with the modes tried that a run may meet.
///
/// # Errors
/// As [`whole`]; or the modes of a tree cannot be separated.
pub(super) fn tried(system: &System) -> Result<Parts, Vec<Fault>> {
    let parts = whole(system)?;
    let still = vec![0.0; 2 * system.coordinates()];
    for part in &parts.trees {
        if let Err(refusal) = part.tree(&still).check() {
            let id = &system.model().objects[part.objects[0]].id;
            return Err(vec![fault(id, &refusal.reason)]);
        }
    }
    Ok(parts)
}

fn fault(object: &str, reason: &str) -> Fault {
    Fault::new(
        "run.method",
        format!("`exact` cannot be used: {object}: {reason}"),
        "\"auto\", or another method",
    )
}

/// A system of which some branches are propagated exactly, and the rest is not.
#[derive(Debug)]
pub struct Mixed {
    /// The branches, and why the rest is not among them.
    pub parts: Parts,
    /// The rest.
    pub rest: Rest,
}

/// Takes a system apart into branches that can be propagated exactly and a
/// rest; `None` where there is no such branch, or nothing but branches.
pub fn mixed(system: &System) -> Option<Mixed> {
    let parts = Parts::of(system).with_sound_trees(system);
    let rest = Rest::of(system, &parts)?;
    Some(Mixed { parts, rest })
}

/// Plays a whole system to `duration` (s).
pub(super) fn follow(
    system: &System,
    parts: &Parts,
    initial: &InitialState,
    duration: f64,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    play(
        system,
        parts,
        initial,
        piece(system, duration),
        limits,
        sink,
    )
}

/// Plays the branches of a system beside its rest, which `integrate` integrates.
pub(super) fn follow_beside(
    system: &System,
    (parts, rest): (&Parts, &Rest),
    initial: &InitialState,
    duration: f64,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
    integrate: impl FnOnce(&InitialState, &mut dyn Sink) -> Outcome,
) -> Outcome {
    let beside = Beside {
        system,
        parts,
        rest,
    };
    let piece = piece(system, duration);
    play_beside(beside, initial, piece, limits, sink, integrate)
}

fn piece(system: &System, duration: f64) -> Piece {
    let cycle = drive_cycle(system.model()).ok();
    let in_cycle = cycle.map_or(f64::INFINITY, |cycle| cycle / STEPS_IN_CYCLE);
    Piece {
        end: duration,
        step: in_cycle.min(duration / STEPS_IN_RUN),
    }
}
