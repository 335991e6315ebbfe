//! diffsol on the chain: its own location of roots, its own interpolation.

use crate::chain::Chain;
use crate::solution::Solution;
use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverStopReason,
};
use std::cell::Cell;

type Matrix = NalgebraMat<f64>;
type Lu = NalgebraLU<f64>;

/// The methods.
pub(crate) const METHODS: [&str; 4] = ["tsit45", "bdf", "tr_bdf2", "esdirk34"];

/// Steps after which a run is given up.
const MOST_STEPS: u64 = 20_000_000;

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
    // With its own bound of 50 in all, the implicit methods stop after some switches.
    problem.ode_options.max_nonlinear_solver_failures = 1_000_000;
    let drive = Drive {
        chain,
        engaged: &engaged,
        samples,
    };
    match method {
        "tsit45" => drive.run(&mut problem.tsit45().map_err(text)?),
        "bdf" => drive.run(&mut problem.bdf::<Lu>().map_err(text)?),
        "tr_bdf2" => drive.run(&mut problem.tr_bdf2::<Lu>().map_err(text)?),
        "esdirk34" => drive.run(&mut problem.esdirk34::<Lu>().map_err(text)?),
        other => Err(format!("no method {other}")),
    }
}

/// A run of one solver.
struct Drive<'a> {
    chain: &'a Chain,
    engaged: &'a Cell<bool>,
    samples: usize,
}

impl Drive<'_> {
    fn run<'p, E, S>(&self, solver: &mut S) -> Result<Solution, String>
    where
        E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'p,
        S: OdeSolverMethod<'p, E>,
    {
        let (chain, end) = (self.chain, self.chain.duration);
        let mut solution = Solution {
            samples: Vec::with_capacity(self.samples),
            switches: Some(0),
            ..Solution::default()
        };
        let mut between = solver.state().y.clone();
        let mut before = [0.0; 3];
        solver.set_stop_time(end).map_err(text)?;
        loop {
            let reason = solver.step().map_err(text)?;
            solution.steps += 1;
            if solution.steps > MOST_STEPS {
                return Err("too many steps".to_owned());
            }
            let reached = match reason {
                OdeSolverStopReason::RootFound(time, _) => time,
                OdeSolverStopReason::TstopReached => end,
                OdeSolverStopReason::InternalTimestep => solver.state().t,
            };
            while solution.samples.len() < self.samples {
                let time = end * (solution.samples.len() + 1) as f64 / self.samples as f64;
                if time > reached {
                    break;
                }
                let time = time.min(solver.state().t);
                solver
                    .interpolate_inplace(time, &mut between)
                    .map_err(text)?;
                solution
                    .samples
                    .push(chain.delta(between.batch_as_slice(0)));
            }
            if let OdeSolverStopReason::RootFound(time, _) = reason {
                solver.state_mut_back(time).map_err(text)?;
                self.engaged.set(!self.engaged.get());
                solution.switches = solution.switches.map(|count| count + 1);
                solver.apply_reset().map_err(text)?;
                if time < end {
                    solver.set_stop_time(end).map_err(text)?;
                }
            }
            if self.samples == 0 {
                let state = solver.state();
                let y = state.y.batch_as_slice(0);
                let now = [state.t, chain.delta(y), chain.delta_speed(y)];
                solution.delta_max = solution.delta_max.max(greatest(before, now));
                before = now;
            }
            if reason == OdeSolverStopReason::TstopReached {
                return Ok(solution);
            }
        }
    }
}

/// Greatest |δ| of the cubic through two states (time, δ, rate).
fn greatest([t0, q0, v0]: [f64; 3], [t1, q1, v1]: [f64; 3]) -> f64 {
    let ends = q0.abs().max(q1.abs());
    if (v0 > 0.0) == (v1 > 0.0) {
        return ends;
    }
    let length = t1 - t0;
    let linear = v0 * length;
    let square = 3.0 * (q1 - q0) - length * (2.0 * v0 + v1);
    let cube = 2.0 * (q0 - q1) + length * (v0 + v1);
    let discriminant = square * square - 3.0 * cube * linear;
    let root = discriminant.max(0.0).sqrt();
    // Where the slope vanishes, in the two forms that do not divide by zero.
    let larger = -(square + root.copysign(square));
    let places = [linear / larger, larger / (3.0 * cube)];
    let inside = places.into_iter().filter(|s| *s > 0.0 && *s < 1.0);
    let values = inside.map(|s| (q0 + s * (linear + s * (square + s * cube))).abs());
    values.fold(ends, f64::max)
}

fn text(error: DiffsolError) -> String {
    error.to_string()
}
