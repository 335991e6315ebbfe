//! The implicit methods of `diffsol`, and what has to be known about that crate
//! (version 0.18). Nothing of its nalgebra leaves this file.
//!
//! The methods are `bdf`, `tr_bdf2` and `esdirk34`, with the feature `diffsol`.
//!
//! * It reckons rounding of the clock from its absolute value: the solver's
//!   time starts at zero with every leg.
//! * Its least step is an absolute 1e-13 s: it is set from the clock.
//! * It counts failures of Newton's method over its whole life and gives up at
//!   50: there is a new solver for every leg, and the bound is raised.
//! * It keeps the Jacobian after a state has been changed from outside: another
//!   reason for a new solver for every leg.
//! * It has no greatest step: a stop time is set ahead of every step instead.
//! * BDF starts every leg at order 1: its first step is always estimated anew.
//! * The derivative it keeps is not the right-hand side at the end of the step
//!   but what its formula makes of it: that is evaluated here.

use super::pace::SHARE_OF_OTHERS;
use super::run::{Run, Verdict};
use super::{Dynamics, Method, Stop};
use diffsol::error::OdeSolverError;
use diffsol::{
    DiffsolError, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverState, OdeSolverStopReason,
};
use std::cell::RefCell;

type Matrix = NalgebraMat<f64>;
type Vector = NalgebraVec<f64>;
type Lu = NalgebraLU<f64>;

/// Takes the run as far towards its target as one leg goes: to the target or
/// to a switch.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    if let Err(error) = try_leg(run) {
        end_by_error(run, &error);
    }
}

fn try_leg<D: Dynamics>(run: &mut Run<'_, D>) -> Result<(), DiffsolError> {
    let (evaluator, method) = (run.evaluator, run.settings.method);
    let (scales, start) = (evaluator.dynamics.scales(), run.from.time);
    let first = match method {
        Method::Bdf => run.estimated_length(1),
        Method::TrBdf2 => run.first_length(2),
        _ => run.first_length(4),
    };
    let tolerance = SHARE_OF_OTHERS * run.tolerance();
    let initial: Vec<f64> = run.from.y.iter().zip(scales).map(|(y, s)| y / s).collect();
    let count = initial.len();
    let work = RefCell::new([vec![0.0; count], vec![0.0; count], vec![0.0; count]]);
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol(vec![tolerance; count])
        .h0(first)
        .rhs_implicit(
            |z: &[f64], _: &[f64], time: f64, dz: &mut [f64]| {
                let [y, dy, _] = &mut *work.borrow_mut();
                unscale(z, scales, y);
                evaluator.derivatives(start + time, y, dy);
                rescale(dy, scales, dz);
            },
            |z: &[f64], _: &[f64], time: f64, direction: &[f64], out: &mut [f64]| {
                let [y, unscaled, product] = &mut *work.borrow_mut();
                unscale(z, scales, y);
                unscale(direction, scales, unscaled);
                evaluator.tangent(start + time, y, unscaled, product);
                rescale(product, scales, out);
            },
        )
        .init(
            move |_: &[f64], _: f64, z: &mut [f64]| z.copy_from_slice(&initial),
            count,
        )
        .build()?;
    problem.ode_options.max_nonlinear_solver_failures = 1_000_000;
    let clock = f64::EPSILON * start.abs().max(run.target.abs());
    problem.ode_options.min_timestep = clock;
    match method {
        Method::Bdf => {
            let state = OdeSolverState::new_without_initialise(&problem)?;
            step_to_end_of_leg(&mut problem.bdf_solver::<Lu>(state)?, run)
        }
        Method::TrBdf2 => {
            let state = OdeSolverState::new_without_initialise(&problem)?;
            step_to_end_of_leg(&mut problem.tr_bdf2_solver::<Lu>(state)?, run)
        }
        _ => {
            let state = OdeSolverState::new_without_initialise(&problem)?;
            step_to_end_of_leg(&mut problem.esdirk34_solver::<Lu>(state)?, run)
        }
    }
}

/// Steps until something ends the leg.
fn step_to_end_of_leg<'p, E, S, D>(solver: &mut S, run: &mut Run<'_, D>) -> Result<(), DiffsolError>
where
    E: OdeEquations<T = f64, V = Vector> + 'p,
    S: OdeSolverMethod<'p, E>,
    D: Dynamics,
{
    let scales = run.evaluator.dynamics.scales();
    let (start, target) = (run.from.time, run.target);
    let count = scales.len();
    let [mut y, mut dy, mut middle] = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
    let mut between = solver.state().y.clone();
    let longest = run.longest_step();
    solver.set_stop_time(target - start)?;
    let result = loop {
        let before = solver.state().t;
        if longest < target - start - before {
            solver.set_stop_time(before + longest)?;
        } else if longest.is_finite() {
            solver.set_stop_time(target - start)?;
        }
        let reason = match solver.step() {
            Ok(reason) => reason,
            Err(error) => break Err(error),
        };
        let state = solver.state();
        for index in 0..count {
            y[index] = state.y[index] * scales[index];
        }
        let now = state.t;
        let landed = reason == OdeSolverStopReason::TstopReached
            && (target - start - now) <= 1e-3 * (now - before);
        solver.interpolate_inplace(0.5 * (before + now), &mut between)?;
        for index in 0..count {
            middle[index] = between[index] * scales[index];
        }
        let time = if landed { target } else { start + now };
        run.evaluator.derivatives(time, &y, &mut dy);
        let verdict = run.accept_step(time, &y, &dy, Some(&middle));
        if landed || verdict != Verdict::Continue {
            break Ok(());
        }
    };
    let counts = solver.get_statistics();
    let failed = counts.number_of_error_test_failures + counts.number_of_nonlinear_solver_fails;
    run.rejected += failed as u64;
    result
}

/// What a solver's error means for the run.
fn end_by_error<D: Dynamics>(run: &mut Run<'_, D>, error: &DiffsolError) {
    let method = run.settings.method;
    let floor = 4.0 * f64::EPSILON * run.from.time.abs().max(run.target.abs());
    match error {
        DiffsolError::OdeSolverError(OdeSolverError::StepSizeTooSmall { .. }) => {
            run.end_at_floor(floor);
        }
        other => {
            let reason = other.to_string();
            run.end_with_reason(Stop::Method { method, reason });
        }
    }
}

fn unscale(z: &[f64], scales: &[f64], y: &mut [f64]) {
    for ((y, z), scale) in y.iter_mut().zip(z).zip(scales) {
        *y = z * scale;
    }
}

fn rescale(y: &[f64], scales: &[f64], z: &mut [f64]) {
    for ((z, y), scale) in z.iter_mut().zip(y).zip(scales) {
        *z = y / scale;
    }
}
