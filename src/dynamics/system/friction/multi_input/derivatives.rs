//! Derivatives of the friction of a linkage of several inputs by all that it depends on.

use super::super::force::{STEP, slope, solver_options};
use super::{Several, SeveralWork};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::Work;
use crate::kinematics::linkage::kinetostatics::{
    ForceWorkspace, Kinetostatics, OutputLoads, Sliding,
};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::math::jet::Jet;
use crate::math::quantity::Quantity;

/// A question that is asked beside the present motion.
struct TrialMotion<'a> {
    solver: &'a Kinetostatics,
    motion: &'a mut MultiMotion,
    forces: &'a mut ForceWorkspace,
    carried: OutputLoads<'a>,
    mobility: &'a [f64],
    sliding: &'a [Sliding],
    inputs: Vec<Jet>,
}

impl TrialMotion<'_> {
    /// T on an input at the motion in `inputs`.
    fn find(&mut self) -> Option<Vec<f64>> {
        self.motion.set_inputs(&self.inputs).ok()?;
        let (solver, forces) = (self.solver, &mut *self.forces);
        solver.set_motion(self.motion, self.carried, forces).ok()?;
        let options = solver_options(false);
        solver
            .solve_friction(self.mobility, self.sliding, &options, forces)
            .ok()?;
        Some(solver.friction_on_inputs(forces).to_vec())
    }

    /// Derivatives of T by a number of one input's motion.
    fn slopes(
        &mut self,
        (here, step): (&[f64], f64),
        number: impl Fn(&mut Self) -> &mut f64,
    ) -> Vec<f64> {
        let at = *number(self);
        let mut look = |value: f64| {
            *number(self) = value;
            let found = self.find();
            *number(self) = at;
            found
        };
        let (above, below) = (look(at + step), look(at - step));
        let of = |k: usize| {
            slope(at, step, here[k], &mut |x: f64| {
                let side = if x > at { &above } else { &below };
                side.as_ref().map(|found| found[k])
            })
        };
        (0..here.len()).map(of).collect()
    }
}

impl Frozen {
    /// Adds the derivatives to the friction found.
    pub(super) fn differentiate<N: Quantity>(
        &self,
        several: &Several,
        own: &mut SeveralWork<N>,
        work: &Work<N>,
    ) {
        let solver = &several.kinetostatics;
        let (inputs, outputs) = (own.free.len(), several.outputs.len());
        let (mut by_free, mut by_loads) = (vec![0.0; inputs * inputs], vec![0.0; inputs * outputs]);
        solver.friction_derivatives(&mut own.forces, &mut by_free, &mut by_loads);
        let here = solver.friction_on_inputs(&own.forces).to_vec();
        let pushed = solver.friction_accelerations(&own.mobility_values, &own.forces);
        let change = |value: N| value - N::from(value.value());
        // What the accelerations without friction and the mobility change by, together.
        for l in 0..inputs {
            let mut moved = change(own.free[l]);
            for (k, force) in here.iter().enumerate() {
                moved += change(own.mobility[l * inputs + k]).scale(*force);
            }
            for k in 0..inputs {
                own.force[k] += moved.scale(by_free[k * inputs + l]);
            }
        }
        for (output, &node) in several.outputs.iter().enumerate() {
            let acceleration =
                solver.output_acceleration_with_friction(output, &own.motion, &pushed);
            let moved = change(work.force[node]) - change(work.mass[node]).scale(acceleration);
            for k in 0..inputs {
                own.force[k] += moved.scale(by_loads[k * outputs + output]);
            }
        }
        let rates = own.inputs.iter();
        let rate = rates.fold(0.0f64, |most, jet| {
            most.max(jet.first.abs()).max(jet.second.abs().sqrt())
        });
        let mut beside = TrialMotion {
            solver,
            motion: &mut own.beside,
            forces: &mut own.forces,
            carried: OutputLoads {
                loads: &own.loads,
                inertias: &own.inertias,
            },
            mobility: &own.mobility_values,
            sliding: &own.sliding,
            inputs: own.inputs.clone(),
        };
        beside.motion.unwrap_angles(own.motion.angles());
        for (l, &node) in self.multi[several.linkage].nodes.iter().enumerate() {
            let step = STEP * solver.input_scale(l);
            let by_place = beside.slopes((&here, step), |own| &mut own.inputs[l].value);
            let by_rate = match rate {
                0.0 => vec![0.0; inputs],
                rate => beside.slopes((&here, STEP * rate), |own| &mut own.inputs[l].first),
            };
            for k in 0..inputs {
                own.force[k] += change(work.displacement[node]).scale(by_place[k]);
                own.force[k] += change(work.speed[node]).scale(by_rate[k]);
            }
        }
    }
}
