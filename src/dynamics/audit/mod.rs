//! The check of a run that shares nothing with what it was computed by.
//!
//! In every run instants and switches are drawn at random ([`sampler`]) and states are kept
//! there. Afterwards the motions and forces of the scene are evaluated at these states by
//! laws that are written a second time ([`crate::dynamics::stated`], [`mechanics`],
//! [`contact`]), and the equations of motion are put to the test ([`judge`]): over a short
//! time a momentum changes by the integral of the forces; contacts press and do not pull;
//! at a switch ([`turns`]) nothing jumps but what an impact lets jump; laws are continuous
//! ([`joints`]), and sums of modes move by the speed that is shown ([`sums`]).
//!
//! A defect is measured by the terms of its own equation that are there, and bounded by the
//! tolerance and the rounding of these terms.

mod check;
mod contact;
mod joints;
mod judge;
mod mechanics;
mod sampler;
mod sums;
mod turns;

pub use check::EquationCheck;
pub(crate) use judge::{AuditScope, fastest_rate};
pub(crate) use sampler::{DrawnInstants, InstantSampler, SEED, draw};

use crate::dynamics::system::System;
use judge::Judge;

/// Checks what was drawn in a run.
///
/// `peaks`: of every object part the greatest speed, acceleration and reaction of the whole
/// run, by which defects are measured too: what was looked at may have died away.
pub(crate) fn check(
    system: &System,
    looks: &DrawnInstants,
    asked: AuditScope,
    peaks: &[[f64; 3]],
) -> EquationCheck {
    if looks.looks.is_empty() && looks.turns.is_empty() {
        return EquationCheck::default();
    }
    // What a method resolves is found by a thousand samples of the laws. A closed form knows
    // the motion to rounding, and hardly ever needs it.
    let found = judged(system, looks, asked, peaks, !asked.closed);
    match asked.closed && !found.is_kept() {
        true => judged(system, looks, asked, peaks, true),
        false => found,
    }
}

/// The check, with or without what the methods resolve in its scales.
fn judged(
    system: &System,
    looks: &DrawnInstants,
    asked: AuditScope,
    peaks: &[[f64; 3]],
    resolved: bool,
) -> EquationCheck {
    let mut judge = Judge::new(system, asked);
    judge.see_peaks(peaks);
    judge.judge_instants(looks, resolved);
    judge.judge_joints();
    judge.judge_end(looks);
    for turn in &looks.turns {
        turns::judge(&mut judge, turn);
    }
    judge.finish(looks)
}
