//! Sequential quadratic programming: the method is that of the crate `basin`.

use super::Problem;
#[cfg(not(target_family = "wasm"))]
use super::adapter::Adapter;
#[cfg(not(target_family = "wasm"))]
use basin::{Executor, SelectedFirstOrderState, Slsqp, State, TerminationCode};

/// How the method ended, in its own opinion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SqpEnd {
    /// No step promises anything.
    Converged,
    /// No step does better, or its equations have no solution.
    Stalled,
    /// There are no values or slopes where it started.
    NoValues,
}

/// Goes from a place to the least value near it, until a step promises less than `accuracy`, for
/// `iterations` steps at most.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn sqp(
    problem: &dyn Problem,
    start: &[f64],
    accuracy: f64,
    iterations: u64,
) -> (Vec<f64>, SqpEnd) {
    let adapter = Adapter::new(problem);
    let start: Vec<f64> = start.iter().map(|x| x.clamp(0.0, 1.0)).collect();
    if adapter.values(&start).is_none() || adapter.slopes(&start).is_none() {
        return (start, SqpEnd::NoValues);
    }
    let method = Slsqp::new().with_absolute_accuracy_tolerance(accuracy);
    let state = SelectedFirstOrderState::new(start.clone());
    let executor = Executor::new(adapter, method, state).max_iter(iterations);
    match executor.run_with_solver() {
        Ok(result) => {
            let end = match result.report.code() {
                TerminationCode::SolverConverged => SqpEnd::Converged,
                _ => SqpEnd::Stalled,
            };
            (result.state.param().clone(), end)
        }
        Err(_) => (start, SqpEnd::Stalled),
    }
}

/// The crate asks for a clock, which a browser tab does not have: nothing is looked for there.
#[cfg(target_family = "wasm")]
pub(crate) fn sqp(
    problem: &dyn Problem,
    start: &[f64],
    _accuracy: f64,
    _iterations: u64,
) -> (Vec<f64>, SqpEnd) {
    match problem.values(start) {
        Some(_) => (start.to_vec(), SqpEnd::Stalled),
        None => (start.to_vec(), SqpEnd::NoValues),
    }
}
