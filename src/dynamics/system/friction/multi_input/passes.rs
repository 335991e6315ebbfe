//! Friction of a linkage of several inputs within an evaluation: where the accelerations of the
//! roots without it are known.

use super::super::force::solver_options;
use super::super::{Obstacle, StickSlip};
use super::{Several, SeveralWork};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::multi::Dense;
use crate::dynamics::system::passes::Work;
use crate::kinematics::linkage::kinetostatics::{ForceFailure, OutputLoads, Sliding};
use crate::math::jet::Jet;
use crate::math::linear::dense;
use crate::math::quantity::Quantity;

impl Several {
    /// What every pair does by the modes, into `sliding`; false where nothing rubs.
    pub(super) fn read_modes(&self, modes: &[i64], sliding: &mut [Sliding]) -> bool {
        let mut rubs = false;
        for (pair, state) in self.pairs.iter().zip(self.states(modes)) {
            sliding[pair.pair] = match state {
                StickSlip::Unset => Sliding::Idle,
                StickSlip::Stuck => Sliding::Held,
                StickSlip::Forward | StickSlip::Backward => Sliding::Slides(state.sense()),
            };
            rubs |= state != StickSlip::Unset;
        }
        rubs
    }
}

impl Frozen {
    /// Finds the friction of a linkage of several inputs, the accelerations of the roots
    /// without it being in `dense`, and adds what it does to these. Its forces on the inputs
    /// stay in `work`.
    pub(in crate::dynamics::system) fn apply_multi_input_friction<N: Quantity>(
        &self,
        dense: &mut Dense<N>,
        modes: &[i64],
        work: &mut Work<N>,
    ) {
        let Some(several) = &self.several else {
            return;
        };
        let Some(mut own) = work.several.take() else {
            return;
        };
        own.force.fill(N::from(0.0));
        own.failure = None;
        let rubs = several.read_modes(modes, &mut own.sliding);
        if work.multi[several.linkage].assembled {
            self.read_coupling(several, dense, &mut own);
            self.set_frictionless_motion(several, &mut own, work);
            if rubs && own.failure.is_none() {
                self.find_friction(several, &mut own, work);
            }
        }
        let count = own.force.len();
        for (k, response) in own
            .response
            .chunks_exact(self.roots.len().max(1))
            .enumerate()
        {
            if k < count {
                for (right, part) in dense.right.iter_mut().zip(response) {
                    *right += *part * own.force[k];
                }
            }
        }
        work.several = Some(own);
    }

    /// Accelerations of the inputs without friction, and what forces on them do.
    fn read_coupling<N: Quantity>(
        &self,
        several: &Several,
        dense: &mut Dense<N>,
        own: &mut SeveralWork<N>,
    ) {
        let (nodes, roots, inputs) = (self.inertia.len(), self.roots.len(), own.free.len());
        for k in 0..inputs {
            let carrier = several.first + k;
            let shares = &dense.shares[carrier * nodes..(carrier + 1) * nodes];
            let mut free = dense.forces[carrier];
            let response = &mut own.response[k * roots..(k + 1) * roots];
            for (r, root) in self.roots.iter().enumerate() {
                free += shares[root.node] * dense.right[r];
                response[r] = shares[root.node];
            }
            own.free[k] = free;
            dense::solve_symmetric(&dense.matrix[..roots * roots], response);
        }
        for k in 0..inputs {
            let carrier = several.first + k;
            let shares = &dense.shares[carrier * nodes..(carrier + 1) * nodes];
            for l in 0..inputs {
                let mut sum = N::from(0.0);
                for (r, root) in self.roots.iter().enumerate() {
                    sum += shares[root.node] * own.response[l * roots + r];
                }
                own.mobility[k * inputs + l] = sum;
                own.mobility_values[k * inputs + l] = sum.value();
            }
        }
    }

    /// Takes the motion without friction over into the equations of the links.
    fn set_frictionless_motion<N: Quantity>(
        &self,
        several: &Several,
        own: &mut SeveralWork<N>,
        work: &Work<N>,
    ) {
        for (k, &node) in several.outputs.iter().enumerate() {
            own.loads[k] = work.force[node].value();
            own.inertias[k] = work.mass[node].value();
        }
        let nodes = &self.multi[several.linkage].nodes;
        let jet = |(k, &node): (usize, &usize)| Jet {
            value: work.displacement[node].value(),
            first: work.speed[node].value(),
            second: own.free[k].value(),
            ..Jet::default()
        };
        own.inputs.clear();
        own.inputs.extend(nodes.iter().enumerate().map(jet));
        let finite = own.free.iter().all(|free| free.value().is_finite());
        if !finite || own.motion.set_inputs(&own.inputs).is_err() {
            own.failure = Some(Obstacle::Failed(ForceFailure::NotFinite));
            return own.force.fill(N::from(f64::NAN));
        }
        let carried = OutputLoads {
            loads: &own.loads,
            inertias: &own.inertias,
        };
        let solver = &several.kinetostatics;
        if let Err(failure) = solver.set_motion(&own.motion, carried, &mut own.forces) {
            own.failure = Some(Obstacle::Failed(failure));
            own.force.fill(N::from(f64::NAN));
        }
    }

    /// T where the pairs do what the modes say.
    fn find_friction<N: Quantity>(
        &self,
        several: &Several,
        own: &mut SeveralWork<N>,
        work: &Work<N>,
    ) {
        let solver = &several.kinetostatics;
        let found = solver.solve_friction(
            &own.mobility_values,
            &own.sliding,
            &solver_options(false),
            &mut own.forces,
        );
        if let Err(failure) = found {
            own.failure = Some(Obstacle::Failed(failure));
            return own.force.fill(N::from(f64::NAN));
        }
        let forces = solver.friction_on_inputs(&own.forces);
        for (own, force) in own.force.iter_mut().zip(forces) {
            *own = N::from(*force);
        }
        if N::DERIVATIVES > 2 {
            self.differentiate(several, own, work);
        }
    }

    /// Adds the force of friction on the inputs to the inertia forces of the carriers.
    pub(in crate::dynamics::system) fn take_off_friction<N: Quantity>(
        &self,
        forces: &mut [N],
        work: &Work<N>,
    ) {
        if let (Some(several), Some(own)) = (&self.several, &work.several) {
            for (force, friction) in forces[several.first..].iter_mut().zip(&own.force) {
                *force -= *friction;
            }
        }
    }

    /// Power lost to the friction of the linkage of several inputs (W).
    pub(in crate::dynamics::system) fn multi_input_friction_loss(
        &self,
        work: &Work<f64>,
    ) -> Option<(usize, f64)> {
        let (several, own) = (self.several.as_ref()?, work.several.as_ref()?);
        let nodes = &self.multi[several.linkage].nodes;
        let parts = nodes.iter().zip(&own.force);
        let power: f64 = parts.map(|(&node, force)| force * work.speed[node]).sum();
        Some((several.object, 0.0 - power))
    }
}
