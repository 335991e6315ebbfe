//! diffsol on the press: its own location of roots, its own interpolation, the
//! right-hand side and its derivative from the system.

use super::scene::Press;
use crate::solution::Solution;
use dam::integrate::Dynamics;
use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations, OdeSolverMethod,
    OdeSolverStopReason,
};
use std::cell::{Cell, RefCell};

type Matrix = NalgebraMat<f64>;
type Lu = NalgebraLU<f64>;

/// Solves for `samples` samples of δ. The unknowns are in units of their scales.
///
/// # Errors
/// What the solver says.
pub(crate) fn solve(
    press: &Press,
    method: &str,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    let (system, count) = (&press.system, press.unknowns());
    let scales = system.scales();
    let engaged = Cell::new(true);
    let modes = [press.modes_with(false), press.modes_with(true)];
    let work = RefCell::new((system.scratch(), [(); 3].map(|()| vec![0.0; count])));
    let scaled = |from: &[f64], to: &mut [f64], back: bool| {
        for ((to, from), scale) in to.iter_mut().zip(from).zip(scales) {
            *to = if back { from / scale } else { from * scale };
        }
    };
    let start = press.start.clone();
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(tolerance)
        .atol(vec![tolerance; count])
        .h0(1e-8)
        .rhs_implicit(
            |z: &[f64], _: &[f64], time: f64, dz: &mut [f64]| {
                let (scratch, [y, dy, _]) = &mut *work.borrow_mut();
                scaled(z, y, false);
                system.derivatives(time, y, &modes[usize::from(engaged.get())], scratch, dy);
                scaled(dy, dz, true);
            },
            |z: &[f64], _: &[f64], time: f64, direction: &[f64], out: &mut [f64]| {
                let (scratch, [y, along, product]) = &mut *work.borrow_mut();
                scaled(z, y, false);
                scaled(direction, along, false);
                let modes = &modes[usize::from(engaged.get())];
                system.tangent(time, y, modes, along, scratch, product);
                scaled(product, out, true);
            },
        )
        .init(
            |_: &[f64], _: f64, z: &mut [f64]| scaled(&start, z, true),
            count,
        )
        .root(
            |z: &[f64], _: &[f64], _: f64, root: &mut [f64]| {
                let (_, [y, _, _]) = &mut *work.borrow_mut();
                scaled(z, y, false);
                root[0] = press.pressing(y) / scales[press.watches[0].guards[0].signal];
            },
            1,
        )
        .reset(|z: &[f64], _: &[f64], _: f64, out: &mut [f64]| out.copy_from_slice(z))
        .build()
        .map_err(text)?;
    problem.ode_options.max_nonlinear_solver_failures = 1_000_000;
    let drive = Drive {
        press,
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

struct Drive<'a> {
    press: &'a Press,
    engaged: &'a Cell<bool>,
    samples: usize,
}

impl Drive<'_> {
    fn run<'p, E, S>(&self, solver: &mut S) -> Result<Solution, String>
    where
        E: OdeEquations<T = f64, V = NalgebraVec<f64>> + 'p,
        S: OdeSolverMethod<'p, E>,
    {
        let (delta, end) = (self.press.delta, self.press.duration);
        let scale = self.press.system.scales()[delta];
        let mut solution = Solution {
            switches: Some(0),
            ..Solution::default()
        };
        let mut between = solver.state().y.clone();
        solver.set_stop_time(end).map_err(text)?;
        loop {
            let reason = solver.step().map_err(text)?;
            solution.steps += 1;
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
                    .push(between.batch_as_slice(0)[delta] * scale);
            }
            if let OdeSolverStopReason::RootFound(time, _) = reason {
                solver.state_mut_back(time).map_err(text)?;
                self.engaged.set(!self.engaged.get());
                solution.switches = solution.switches.map(|count| count + 1);
                if solution.switches > Some(10_000) {
                    return Err("too many switches".to_owned());
                }
                solver.apply_reset().map_err(text)?;
                if time < end {
                    solver.set_stop_time(end).map_err(text)?;
                }
            }
            if reason == OdeSolverStopReason::TstopReached {
                return Ok(solution);
            }
        }
    }
}

fn text(error: DiffsolError) -> String {
    error.to_string()
}
