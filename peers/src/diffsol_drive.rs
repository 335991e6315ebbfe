//! A run of diffsol, whatever the problem: its own location of roots, at each of
//! which the pair changes its state, and its own interpolation.

use crate::solution::Solution;
use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeEquations, OdeSolverMethod, OdeSolverStopReason,
};
use std::cell::Cell;

pub(crate) type Matrix = NalgebraMat<f64>;
pub(crate) type Lu = NalgebraLU<f64>;

/// The methods.
pub(crate) const METHODS: [&str; 4] = ["tsit45", "bdf", "tr_bdf2", "esdirk34"];

/// Steps, and switches, after which a run is given up.
const MOST_STEPS: u64 = 20_000_000;
const MOST_SWITCHES: usize = 1_000_000;

/// With its own bound of 50 in all, the implicit methods stop after some switches.
pub(crate) const MOST_FAILURES: usize = 1_000_000;

/// A run of one solver.
pub(crate) struct Drive<'a> {
    /// End of the run (s).
    pub(crate) end: f64,
    /// Number of samples; 0: max|δ| instead.
    pub(crate) samples: usize,
    /// State of the pair, which the equations look at.
    pub(crate) engaged: &'a Cell<bool>,
    /// δ and its rate in a state.
    pub(crate) delta: &'a dyn Fn(&[f64]) -> [f64; 2],
}

/// Runs a problem by the method of a name.
macro_rules! run_by_name {
    ($drive:expr, $problem:expr, $method:expr) => {{
        use $crate::diffsol_drive::{Lu, text};
        match $method {
            "tsit45" => $drive.run(&mut $problem.tsit45().map_err(text)?),
            "bdf" => $drive.run(&mut $problem.bdf::<Lu>().map_err(text)?),
            "tr_bdf2" => $drive.run(&mut $problem.tr_bdf2::<Lu>().map_err(text)?),
            "esdirk34" => $drive.run(&mut $problem.esdirk34::<Lu>().map_err(text)?),
            other => Err(format!("no method {other}")),
        }
    }};
}
pub(crate) use run_by_name;

impl Drive<'_> {
    /// Runs a solver to the end.
    ///
    /// # Errors
    /// What the solver says, or that it takes too many steps or switches.
    pub(crate) fn run<'p, E, S>(&self, solver: &mut S) -> Result<Solution, String>
    where
        E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'p,
        S: OdeSolverMethod<'p, E>,
    {
        let end = self.end;
        let mut switches = 0;
        let mut solution = Solution {
            samples: Vec::with_capacity(self.samples),
            ..Solution::default()
        };
        let mut between = solver.state().y.clone();
        let mut before = [0.0; 3];
        solver.set_stop_time(end).map_err(text)?;
        loop {
            let reason = solver.step().map_err(text)?;
            solution.steps += 1;
            if solution.steps > MOST_STEPS || switches > MOST_SWITCHES {
                return Err("too many steps or switches".to_owned());
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
                let [delta, _] = (self.delta)(between.batch_as_slice(0));
                solution.samples.push(delta);
            }
            if let OdeSolverStopReason::RootFound(time, _) = reason {
                solver.state_mut_back(time).map_err(text)?;
                self.engaged.set(!self.engaged.get());
                switches += 1;
                solver.apply_reset().map_err(text)?;
                if time < end {
                    solver.set_stop_time(end).map_err(text)?;
                }
            }
            if self.samples == 0 {
                let state = solver.state();
                let [delta, rate] = (self.delta)(state.y.batch_as_slice(0));
                let now = [state.t, delta, rate];
                solution.delta_max = solution.delta_max.max(greatest(before, now));
                before = now;
            }
            if reason == OdeSolverStopReason::TstopReached {
                solution.switches = Some(switches);
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

pub(crate) fn text(error: DiffsolError) -> String {
    error.to_string()
}
