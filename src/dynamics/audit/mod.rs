//! The check of a run that shares nothing with what it was computed by.
//!
//! In every run instants and switches are drawn at random ([`sampler`]) and states are kept
//! there. Afterwards the motions and forces of the scene are evaluated at these states by
//! laws that are written a second time ([`crate::dynamics::stated`], [`mechanics`],
//! [`contact`]), and the equations of motion are put to the test ([`judge`]). Over a short
//! time a momentum changes by the integral of the forces. Contacts press and do not pull.
//! At a switch ([`turns`]) nothing jumps but what an impact lets jump. Laws are continuous
//! ([`joints`]), and sums of modes move by the speed that is shown ([`sums`]).
//!
//! A defect is measured by the terms of its own equation that are there, and bounded by the
//! tolerance and the rounding of these terms.
//!
//! The record is checked too: displacements, speeds, accelerations and contact forces against
//! those of the scene, and the energy and impulse of an impact. By a fixed seed 6 instants, 5
//! stretches or steps and up to 8 events are drawn, for all methods alike. For drives and rigid
//! objects the printed reaction stands in the balance. If a window is too long for the forces,
//! shorter ones are tried. An acceleration is the remainder of forces: behind very stiff links
//! its bound grows by their rounding, and the run states that the peak is not determined.
//!
//! A defect is a share of the greatest terms of its own equation. The bound is 500 tolerances
//! and 1e-7, with the possible error of the state of a step (10 tolerances of momentum and link
//! forces; rounding alone for `exact`). The result is an `EquationCheck` (`run.equations`).
//! Beyond its bound the run is not to be trusted; after `exact`, `auto` takes another method.
//! Maps and prepared scenes check one point in 16, drawn by the seed. `unchecked` names what cannot be checked:
//! forces of linkages of several inputs, friction of joints, plans with very many smooth
//! motions. Of dry friction at rest the force is taken from the run: with it the equations
//! balance, and it is within its limit (`friction`).
//!
//! # Limits
//!
//! An equation defect cannot see:
//!
//! - a wrong start: motions from another state keep the equations too;
//! - inertias, stiffnesses and dampings: they are read from the model, as the body was lowered;
//! - errors that grow over the run: each equation holds to the tolerance, the sum of all errors
//!   may be greater;
//! - what happens between the instants: an event that is missed and leaves no trace, an extreme
//!   that is passed over;
//! - another assembly mode of a linkage: an output of a linkage is its own statement, as are
//!   functions supplied in code;
//! - what both paths share: the reading of the scene, the language of expressions, the formulas
//!   of linkages.
//!
//! `tests/mutants` plants faults in the closed forms, the laws and the events, and names the
//! check that finds each.

mod check;
mod contact;
mod friction;
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
    let found = audit_equations(system, looks, asked, peaks, !asked.closed);
    match asked.closed && !found.is_kept() {
        true => audit_equations(system, looks, asked, peaks, true),
        false => found,
    }
}

/// The check, with or without what the methods resolve in its scales.
fn audit_equations(
    system: &System,
    looks: &DrawnInstants,
    asked: AuditScope,
    peaks: &[[f64; 3]],
    resolved: bool,
) -> EquationCheck {
    let mut judge = Judge::new(system, asked);
    judge.see_peaks(peaks);
    judge.judge_instants(looks, resolved);
    for look in &looks.looks {
        friction::judge(&mut judge, look);
    }
    judge.judge_joints();
    judge.judge_end(looks);
    for turn in &looks.turns {
        turns::judge(&mut judge, turn);
    }
    judge.finish(looks)
}
