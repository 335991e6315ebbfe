//! Derivatives of a motion by its numbers, carried exactly through its events.
//!
//! A motion that has been propagated exactly is gone through once more, from event to event, with
//! numbers that carry derivatives by the parameters ([`Duals`]). Between two events it is its
//! power series, whose first left-out term is below rounding: the equations of the derivatives,
//!
//! d/dt y_p = (∂f_r/∂y)·y_p + ∂f_r/∂p,
//!
//! are solved in closed form along with the motion itself. At an event g(t, y, p) = 0 the instant
//! is a number with derivatives too,
//!
//! τ_p = −(∇g·y_p + ∂g/∂p)/ġ,
//!
//! and the state is taken there, at the instant that moves. Going on from it with the equations of
//! the next phase gives y_p⁺ = y_p⁻ + (f⁻ − f⁺)·τ_p at fixed time, and with a jump R of the state
//! R_y·y_p⁻ + R_p + (R_y·f⁻ + R_t − f⁺)·τ_p, without either being written down: both are the rule
//! of products.
//!
//! # What it takes
//!
//! Trees under loads that are constant or tables over time, whatever law they follow ([`LawTable`]).
//! Rigid pairs as long as no impact comes to rest.
//!
//! # Limits
//!
//! The sequence of events is that of the motion. Derivatives hold on the side of the parameters on
//! which it stays the same; [`TreeResults::near`] tells how far that is, to first order. Where two events
//! coincide the sequence depends on the side, which [`TreeResults::coincident`] names.
//!
//! # Sources
//!
//! Saltation matrices of piecewise smooth systems: Aizerman and Gantmakher 1958; Leine and
//! Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004, ch. 7.

mod expansion;
mod extremes;
mod law;
mod numbers;
mod results;
#[cfg(test)]
mod tests;
mod validity;
mod walk;

pub(crate) use extremes::Greatest;
pub(crate) use law::LawTable;
pub(crate) use numbers::{flat_numbers, have_one_form};
pub(crate) use results::{ObjectResults, PairResults};
pub(crate) use validity::Touch;
pub(crate) use walk::{EventTimes, TreeResults, Unfollowed};

use super::{ExactRun, TreeProblem};
use crate::math::number::Duals;
use numbers::TreeNumbers;

/// The numbers of a motion by K parameters.
pub(crate) struct Question<'q, const K: usize> {
    /// The tree.
    pub(crate) problem: &'q TreeProblem,
    /// Its law, where that is known in pieces alone.
    pub(crate) table: Option<&'q LawTable>,
    /// Its motion.
    pub(crate) run: &'q ExactRun,
    /// Derivatives of the numbers of the tree, in the order of [`flat_numbers`].
    pub(crate) derivatives: &'q [[f64; K]],
    /// End of the motion (s).
    pub(crate) end: Duals<K>,
    /// Whether the instants of events move with the parameters.
    pub(crate) events: EventTimes,
    /// Clearances that are zero for an instant: their flanks are taken to be dipped into.
    pub(crate) touches: &'q [Touch],
}

/// Results of a motion with their derivatives by K parameters. `goes_on` is asked now and then.
///
/// # Errors
/// The tree is of a kind that is not followed; the motion does not meet the events that it met
/// before; it was not to go on.
pub(crate) fn results<const K: usize>(
    question: &Question<'_, K>,
    goes_on: &dyn Fn() -> bool,
) -> Result<TreeResults<Duals<K>>, Unfollowed> {
    let mut all = question.derivatives.iter();
    let numbers = TreeNumbers::read((question.problem, question.table), &mut |value, _| Duals {
        value,
        derivatives: all.next().copied().unwrap_or([0.0; K]),
    })
    .map_err(|refusal| Unfollowed::Kind(refusal.reason))?;
    let Question {
        run,
        end,
        events,
        touches,
        ..
    } = *question;
    walk::follow(&numbers, run, (end, events, touches), goes_on)
}
