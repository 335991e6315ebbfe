//! ode_solvers on the press: no switches are located, the pair's state is
//! decided in the right-hand side. For the workarounds see the chain's file.

use super::scene::Press;
use crate::solution::Solution;
use dam::integrate::Dynamics;
use dam::integrate::Modes;
use dam::system::Scratch;
use ode_solvers::dop853::Dop853;
use ode_solvers::dopri5::Dopri5;
use ode_solvers::{DVector, OutputType, System};
use std::cell::RefCell;

/// The press with time as its last state, in units of the scales.
struct Equations<'a> {
    press: &'a Press,
    modes: [Modes; 2],
    work: RefCell<(Scratch, [Vec<f64>; 2])>,
}

impl System<f64, DVector<f64>> for Equations<'_> {
    fn system(&self, _: f64, z: &DVector<f64>, dz: &mut DVector<f64>) {
        let (scratch, [y, dy]) = &mut *self.work.borrow_mut();
        let (system, count) = (&self.press.system, y.len());
        let scales = system.scales();
        for (index, scale) in scales.iter().enumerate() {
            y[index] = z[index] * scale;
        }
        let modes = &self.modes[usize::from(self.press.pressing(y) > 0.0)];
        system.derivatives(z[count], y, modes, scratch, dy);
        for (index, scale) in scales.iter().enumerate() {
            dz[index] = dy[index] / scale;
        }
        dz[count] = 1.0;
    }
}

/// Solves for all samples of δ but the last.
///
/// # Errors
/// What the solver says.
pub(crate) fn solve(
    press: &Press,
    method: &str,
    tolerance: f64,
    samples: usize,
) -> Result<Solution, String> {
    let (end, count) = (press.duration, press.unknowns());
    let scales = press.system.scales();
    let equations = Equations {
        press,
        modes: [press.modes_with(false), press.modes_with(true)],
        work: RefCell::new((press.system.scratch(), [(); 2].map(|()| vec![0.0; count]))),
    };
    let scaled = press.start.iter().zip(scales).map(|(y, scale)| y / scale);
    let start = DVector::from_iterator(count + 1, scaled.chain([0.0]));
    let keep = |states: &[DVector<f64>], steps: u32| Solution {
        samples: states[1..]
            .iter()
            .take(samples - 1)
            .map(|z| z[press.delta] * scales[press.delta])
            .collect(),
        steps: u64::from(steps),
        ..Solution::default()
    };
    let interval = end / samples as f64;
    macro_rules! solve {
        ($Solver:ident, $beta:expr, $shrink:expr, $grow:expr) => {{
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
                1e-8,
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
