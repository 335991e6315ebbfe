//! What the elastic modes answer to a harmonic of the law.

use super::{Lane, Rigid, ZERO};
use crate::exact::pencil::C;
use crate::exact::problem::TreeProblem;
use crate::exact::resonance::is_near_resonance;

/// Force on mass i of a law Re(z): f = Re(F z) with L̇ = iΩL.
pub(super) fn law_force(problem: &TreeProblem, i: usize, lambda: C) -> C {
    let mass = &problem.masses[i];
    -(lambda * lambda * mass.inertia + lambda * mass.ground_damping + mass.ground_stiffness)
        * mass.ratio
}

/// Response of the elastic modes to a unit harmonic of the law; the rigid
/// motion of floating parts is kept apart, and F is freed of it first, so that
/// base acceleration, which moves a floating part rigidly, leaves the elastic
/// modes at rest. `None` at resonance.
pub(super) fn response(
    problem: &TreeProblem,
    lanes: &[Lane],
    rigid: &[Rigid],
    omega: f64,
) -> Option<Vec<C>> {
    let n = problem.masses.len();
    let drive = C::new(0.0, omega);
    let mut force: Vec<C> = (0..n).map(|i| law_force(problem, i, drive)).collect();
    for part in rigid {
        let push: C = (0..n).map(|i| force[i] * part.row_f[i]).sum();
        for (i, f) in force.iter_mut().enumerate() {
            *f -= push * (problem.masses[i].inertia * part.shape[i]);
        }
    }
    let mut out = vec![ZERO; n];
    for lane in lanes {
        let (mut own, mut mirrored) = (ZERO, ZERO);
        for (r, f) in lane.row_f.iter().zip(&force) {
            own += r * f;
            mirrored += r.conj() * f;
        }
        if own != ZERO && is_near_resonance(lane.lambda, omega) {
            return None;
        }
        let off = |lambda: C, push: C| {
            if push == ZERO {
                ZERO
            } else {
                push / (drive - lambda)
            }
        };
        if lane.lambda.im == 0.0 {
            let a = off(lane.lambda, own);
            for (sum, shape) in out.iter_mut().zip(&lane.shape) {
                *sum += shape * a;
            }
        } else {
            let a = off(lane.lambda, own) * 0.5;
            let b = off(lane.lambda.conj(), mirrored) * 0.5;
            for (sum, shape) in out.iter_mut().zip(&lane.shape) {
                *sum += shape * a + shape.conj() * b;
            }
        }
    }
    Some(out)
}
