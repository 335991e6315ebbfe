//! diffsol on the press: the right-hand side and its derivative from the system.

use super::scene::Press;
use crate::diffsol_drive::{Drive, MOST_FAILURES, Matrix, run_by_name, text};
use crate::solution::Solution;
use dam::integrate::Dynamics;
use diffsol::OdeBuilder;
use std::cell::{Cell, RefCell};

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
    problem.ode_options.max_nonlinear_solver_failures = MOST_FAILURES;
    let (delta, rate) = (press.delta, count / 2 + press.delta);
    let drive = Drive {
        end: press.duration,
        samples,
        engaged: &engaged,
        delta: &|z| [delta, rate].map(|index| z[index] * scales[index]),
    };
    run_by_name!(drive, problem, method)
}
