//! Exact propagation of whole scenes.

mod clock;
mod quick;
#[cfg(test)]
mod tests;

pub use quick::{Quick, QuickObject, QuickRun};

use crate::exact::Parts;
use crate::exact::playback::{Piece, play};
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
    let parts = Parts::of(system);
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

/// Plays a whole system to `duration` (s).
pub(super) fn follow(
    system: &System,
    parts: &Parts,
    initial: &InitialState,
    duration: f64,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    let cycle = drive_cycle(system.model()).ok();
    let in_cycle = cycle.map_or(f64::INFINITY, |cycle| cycle / STEPS_IN_CYCLE);
    let piece = Piece {
        end: duration,
        step: in_cycle.min(duration / STEPS_IN_RUN),
    };
    play(system, parts, initial, piece, limits, sink)
}
