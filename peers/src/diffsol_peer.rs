//! diffsol on the chain.

use crate::chain::Chain;
use crate::diffsol_drive::{Drive, MOST_FAILURES, Matrix, run_by_name, text};
use crate::solution::Solution;
use diffsol::OdeBuilder;
use std::cell::Cell;

pub(crate) use crate::diffsol_drive::METHODS;

/// Solves for `samples` samples, or with 0 for max|δ|.
///
/// # Errors
/// What the solver says, or that it takes too many steps.
pub(crate) fn solve(
    chain: &Chain,
    method: &str,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    let engaged = Cell::new(chain.starts_engaged());
    let count = chain.unknowns();
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol(vec![tolerance; count])
        .h0(chain.first_step())
        .rhs_implicit(
            |y: &[f64], _: &[f64], time: f64, dy: &mut [f64]| {
                chain.derivatives(engaged.get(), time, y, dy);
            },
            |_: &[f64], _: &[f64], _: f64, direction: &[f64], out: &mut [f64]| {
                chain.tangent(engaged.get(), direction, out);
            },
        )
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.fill(0.0), count)
        .root(
            |y: &[f64], _: &[f64], _: f64, root: &mut [f64]| root[0] = chain.contact(y),
            1,
        )
        .reset(|y: &[f64], _: &[f64], _: f64, out: &mut [f64]| out.copy_from_slice(y))
        .build()
        .map_err(text)?;
    problem.ode_options.max_nonlinear_solver_failures = MOST_FAILURES;
    let drive = Drive {
        end: chain.duration,
        samples,
        engaged: &engaged,
        delta: &|y| [chain.delta(y), chain.delta_speed(y)],
    };
    run_by_name!(drive, problem, method)
}
