//! Whether modes carry every state to rounding.

use super::{Lane, Rigid};
use crate::exact::problem::TreeProblem;

/// Greatest departure of what the modes make of a unit displacement, or of a unit
/// speed, of each mass from that displacement or speed. The masses are compared by the
/// square roots of their inertias, so that what is small in energy is small here.
///
/// Modes of a long chain that is damped far from proportionally lie almost in one
/// plane: amplitudes are then great numbers that nearly cancel, and digits are
/// lost in their number.
pub(super) fn lost(problem: &TreeProblem, lanes: &[Lane], rigid: &[Rigid]) -> f64 {
    let n = problem.masses.len();
    let root: Vec<f64> = problem.masses.iter().map(|m| m.inertia.sqrt()).collect();
    let mut worst = 0.0f64;
    let (mut place, mut speed) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        place.fill(0.0);
        speed.fill(0.0);
        for lane in lanes {
            let own = lane.shape[i];
            let moving = own * lane.lambda;
            for j in 0..n {
                place[j] += (own * lane.row_q[j]).re;
                speed[j] += (moving * lane.row_v[j]).re;
            }
        }
        for part in rigid {
            for j in 0..n {
                place[j] += part.shape[i] * part.row[j];
                speed[j] += part.shape[i] * part.row[j];
            }
        }
        place[i] -= 1.0;
        speed[i] -= 1.0;
        for j in 0..n {
            let off = place[j].abs().max(speed[j].abs()) * root[i] / root[j];
            // What is not a number is lost.
            if !(off <= worst) {
                worst = off;
            }
        }
    }
    worst
}
