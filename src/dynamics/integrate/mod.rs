//! Integration of switching systems: one contract, several methods, one way of
//! finding switches.
//!
//! A method produces accepted steps; [`integrate`] makes of each the same kind
//! of continuous output, finds on it the earliest switch (none is skipped),
//! cuts the step there, and begins the method anew from the located state.
//!
//! The modes (which flank of a pair is engaged, which piece of a law is in force) are constant
//! within a step, so that the right-hand side is smooth there and a little beyond. The
//! polynomials of a step are in Bernstein form and counted from the signal's value at the
//! start, so that a great angle costs a short step no digits. Nothing here knows a system:
//! `System` implements the contract `Dynamics`.
//!
//! A listener that looks only at the ends of steps, or at sparse samples, says so
//! (`Sink::reads_within_steps`). Without a guard to watch, nothing is then evaluated that nobody
//! reads.

mod auto;
mod changing;
mod continuous;
#[cfg(feature = "diffsol")]
mod diffsol_adapter;
mod dynamics;
mod evaluator;
mod given_motion;
mod jacobian;
mod locate;
mod ode_solvers_adapter;
mod outcome;
mod pace;
mod radau;
mod rosenbrock;
mod run;
mod singularities;
mod stopping;
mod taylor;
#[cfg(test)]
mod tests;

pub use crate::math::narrow::Narrow;
pub use auto::{MethodChoice, Situation, Vibration, choose, fastest_rate};
pub use changing::{Cause, Change, Reserve};
pub use dynamics::{
    Dynamics, EventFunction, Guard, Impact, Modes, PhysicalStop, Probe, Singularity, UndecidedGuard,
};
pub use taylor::degree as series_degree;

pub use outcome::{Limits, Method, Outcome, Settings, Sink, Statistics, Stop, SwitchEvent};

use crate::units::shown;
use changing::ChangeTracker;
use evaluator::Evaluator;
use run::Run;

/// Finest tolerance: below it the rounding of double precision would be taken
/// for an error of the method.
pub const FINEST_TOLERANCE: f64 = 1e-14;

/// Why a method of diffsol cannot be run by this build.
#[cfg(not(feature = "diffsol"))]
const WITHOUT_DIFFSOL: &str = "this build of dam has no diffsol: build it with --features diffsol";

/// Why exact propagation cannot be integrated with.
const EXACT_IS_NO_INTEGRATION: &str = "it propagates whole scenes and integrates nothing";

/// Integrates a system from (`start`, `y0`, `modes`) to `end` into a sink.
///
/// `modes` are those just after `start`; breaks in time at `start` itself have
/// been passed. Ends exactly at `end`, or earlier for the reason given in the
/// outcome; what was computed up to then has reached the sink. A system without
/// coordinates is followed in equal steps, whatever the method. Nothing panics:
/// a bad setting is a [`Stop::Method`], a state that is not a number a
/// [`Stop::NotFinite`]. The same input gives the same calls of the sink, bit by
/// bit, unless a wall-clock limit or an interrupt ends the run.
#[allow(clippy::too_many_arguments)] // the parts of a run, each of another owner
pub fn integrate<D: Dynamics>(
    dynamics: &D,
    start: f64,
    end: f64,
    y0: &[f64],
    modes: &Modes,
    settings: &Settings,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    integrate_changing(
        dynamics,
        start,
        end,
        y0,
        modes,
        (settings, &[]),
        limits,
        sink,
    )
    .0
}

/// [`integrate`] with methods in reserve: the method is changed where the motion becomes
/// stiff, or where its step falls below what the clock resolves. Returns the changes too.
#[allow(clippy::too_many_arguments)] // the parts of a run, each of another owner
pub fn integrate_changing<D: Dynamics>(
    dynamics: &D,
    start: f64,
    end: f64,
    y0: &[f64],
    modes: &Modes,
    (settings, reserve): (&Settings, &[Reserve]),
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> (Outcome, Vec<Change>) {
    let evaluator = Evaluator::new(dynamics, modes);
    let mut run = Run::new(&evaluator, settings, limits, sink);
    run.changing = ChangeTracker::new(reserve);
    run.singularities.end = end;
    if y0.len() != 2 * dynamics.coordinates() {
        let reason = format!("the initial state has {} entries", y0.len());
        run.end_before_start(start, reason);
    } else {
        run.start(start, y0);
        if let Some(reason) = refusal(start, end, settings) {
            run.end_before_start(start, reason);
        }
    }
    while run.stop.is_none() && run.from.time < end {
        let next = dynamics.next_break(run.from.time, &evaluator.modes.borrow());
        run.target = if next > run.from.time {
            next.min(end)
        } else {
            end
        };
        run.narrow_down();
        run.end_leg_before_edge();
        let rest = run.target - run.from.time;
        // Over less before the very end a polynomial would tell no speeds.
        let roundings = if run.target == end { 4096.0 } else { 16.0 };
        let clock = run.from.time.abs().max(run.target.abs());
        // A break of a formula beside zero is no shorter a time than the clock of the run tells.
        if rest <= f64::EPSILON * (roundings * clock).max(end - start) {
            run.skip_to_target();
        } else {
            match run.settings.method {
                _ if y0.is_empty() => given_motion::follow_leg(&mut run),
                Method::Rk4 | Method::Dopri5 | Method::Dop853 => {
                    ode_solvers_adapter::follow_leg(&mut run)
                }
                Method::Taylor => taylor::follow_leg(&mut run),
                Method::Rodas5p => rosenbrock::follow_leg(&mut run),
                Method::Radau => radau::follow_leg(&mut run),
                #[cfg(feature = "diffsol")]
                Method::Bdf | Method::TrBdf2 | Method::Esdirk34 => {
                    diffsol_adapter::follow_leg(&mut run)
                }
                Method::Exact => {
                    let (time, reason) = (run.from.time, EXACT_IS_NO_INTEGRATION.to_owned());
                    run.end_before_start(time, reason);
                }
                #[cfg(not(feature = "diffsol"))]
                Method::Bdf | Method::TrBdf2 | Method::Esdirk34 => {
                    let (time, reason) = (run.from.time, WITHOUT_DIFFSOL.to_owned());
                    run.end_before_start(time, reason);
                }
            }
        }
        run.change_method();
        if run.stop.is_none() && run.from.time == next && next < end {
            run.pass_break();
        }
    }
    let statistics = Statistics {
        steps: run.steps,
        rejected: run.rejected,
        evaluations: evaluator.evaluations(),
        switches: run.switches,
    };
    let outcome = Outcome {
        time: run.from.time,
        stop: run.stop.unwrap_or(Stop::Complete),
        statistics,
    };
    (outcome, run.changing.changes)
}

/// Why settings cannot be run with.
fn refusal(start: f64, end: f64, settings: &Settings) -> Option<String> {
    if !(start.is_finite() && end.is_finite()) {
        return Some(format!("no run from {start} s to {end} s"));
    }
    if !(settings.tolerance >= FINEST_TOLERANCE && settings.tolerance < 1.0) {
        return Some(format!(
            "the tolerance {} is not between {} and 1",
            shown(settings.tolerance, 6),
            shown(FINEST_TOLERANCE, 1)
        ));
    }
    match settings.step {
        Some(step) if !(step > 0.0 && step.is_finite()) => {
            Some(format!("the step {step} s is not greater than zero"))
        }
        None if settings.method == Method::Rk4 => {
            Some("a method of fixed step needs a step".to_owned())
        }
        _ => None,
    }
}
