//! ode_solvers on the chain. It locates no switches: the force branches in the
//! right-hand side. Two things about version 0.6.2 are worked around: the
//! nodes c₁₂ and c₁₃ of `Dop853` are zero, so that time is carried as a state;
//! and its last sample, at the end itself, is wrong and is left out.

use crate::chain::Chain;
use crate::solution::Solution;
use ode_solvers::dop853::Dop853;
use ode_solvers::dopri5::Dopri5;
use ode_solvers::{OutputType, SVector, System};

/// The methods.
pub(crate) const METHODS: [&str; 2] = ["dop853", "dopri5"];

/// The chain with time as its last state.
struct Equations<'a>(&'a Chain);

impl<const N: usize> System<f64, SVector<f64, N>> for Equations<'_> {
    fn system(&self, _: f64, y: &SVector<f64, N>, dy: &mut SVector<f64, N>) {
        let (y, dy) = (y.as_slice(), dy.as_mut_slice());
        let (states, time) = (&y[..N - 1], y[N - 1]);
        let engaged = self.0.holds(states);
        self.0.derivatives(engaged, time, states, &mut dy[..N - 1]);
        dy[N - 1] = 1.0;
    }
}

/// Solves for all samples but the last.
///
/// # Errors
/// What the solver says, or a number of masses that is not built.
pub(crate) fn solve(
    chain: &Chain,
    method: &str,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    match chain.masses {
        1 => run::<3>(chain, method, tolerance, samples),
        2 => run::<5>(chain, method, tolerance, samples),
        10 => run::<21>(chain, method, tolerance, samples),
        other => Err(format!("{other} masses are not built")),
    }
}

fn run<const N: usize>(
    chain: &Chain,
    method: &str,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    let (end, interval) = (chain.duration, chain.duration / samples as f64);
    let start = SVector::<f64, N>::zeros();
    let keep = |states: &[SVector<f64, N>], steps: u32| Solution {
        samples: states[1..]
            .iter()
            .take(samples - 1)
            .map(|y| chain.delta(&y.as_slice()[..N - 1]))
            .collect(),
        steps: u64::from(steps),
        ..Solution::default()
    };
    // Safety factor and bounds of the step control are the crate's own defaults.
    macro_rules! solve {
        ($Solver:ident, $beta:expr, $shrink:expr, $grow:expr) => {{
            let equations = Equations(chain);
            let mut solver = $Solver::from_param(
                equations,
                0.0,
                end,
                interval,
                start,
                tolerance,
                tolerance,
                0.9,
                $beta,
                $shrink,
                $grow,
                end,
                0.0,
                u32::MAX,
                u32::MAX,
                OutputType::Dense,
            );
            let counts = solver.integrate().map_err(|error| error.to_string())?;
            Ok(keep(solver.y_out(), counts.accepted_steps))
        }};
    }
    match method {
        "dop853" => solve!(Dop853, 0.0, 0.333, 6.0),
        "dopri5" => solve!(Dopri5, 0.04, 0.2, 10.0),
        other => Err(format!("no method {other}")),
    }
}
