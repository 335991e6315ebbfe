//! Derivatives of the friction of a linkage of several inputs.

use super::Kinetostatics;
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::multi::MultiMotion;

impl Kinetostatics {
    /// Derivatives of the force found by [`Self::solve_friction`] just before: of each input's by
    /// every acceleration a₀ into `by_accelerations` (m × m), by the force on every output into
    /// `by_loads` (m × outputs).
    ///
    /// By the rest they follow: a change of the mobility is one of a₀ by dG·T, an inertia m on
    /// an output a force −m·φ̈ on it.
    pub fn friction_derivatives(
        &self,
        w: &mut ForceWorkspace,
        by_accelerations: &mut [f64],
        by_loads: &mut [f64],
    ) {
        let (inputs, outputs) = (self.drivers.len(), self.spec.outputs.len());
        w.write_slopes();
        if !w.small.factorise() {
            by_accelerations.fill(f64::NAN);
            by_loads.fill(f64::NAN);
            return;
        }
        let size = self.equations_count();
        let mut out = Vec::with_capacity(inputs);
        for input in 0..inputs {
            let mut rows = w.several.inertia[input * size..(input + 1) * size].to_vec();
            let held = w.several.held.iter();
            let accelerations = held.map(|pair| w.several.rates[pair * inputs + input]);
            let accelerations = accelerations.collect();
            self.respond(&mut rows, accelerations, w, &mut out);
            for (k, value) in out.iter().enumerate() {
                by_accelerations[k * inputs + input] = *value;
            }
        }
        for output in 0..outputs {
            let mut rows = vec![0.0; size];
            self.each_output_row(output, 1.0, w, |row, value| rows[row] -= value);
            self.respond(&mut rows, vec![0.0; w.several.held.len()], w, &mut out);
            for (k, value) in out.iter().enumerate() {
                by_loads[k * outputs + output] = *value;
            }
        }
    }

    /// Change of T when the right sides change by `rows` and the accelerations of the held
    /// pairs by `accelerations`, the friction's signs as they are.
    fn respond(
        &self,
        rows: &mut [f64],
        accelerations: Vec<f64>,
        w: &mut ForceWorkspace,
        out: &mut Vec<f64>,
    ) {
        let size = self.equations_count();
        w.factors.solve(rows, 1);
        let mut multipliers = accelerations;
        self.multipliers(&mut multipliers, w);
        for (share, holding) in multipliers.iter().zip(w.several.holding.chunks_exact(size)) {
            for (value, holding) in rows.iter_mut().zip(holding) {
                *value -= holding * share;
            }
        }
        w.change_of_friction(|row| match row < size {
            true => rows[row],
            false => multipliers[row - size],
        });
        for (index, multiplier) in multipliers.iter_mut().enumerate() {
            for column in 0..w.columns {
                *multiplier -= w.k(size + index, column) * w.next[column];
            }
        }
        self.generalise(&w.next, &multipliers, w, out);
    }

    /// Acceleration of an output in the motion found by [`Self::solve_friction`].
    pub fn output_acceleration_with_friction(
        &self,
        output: usize,
        motion: &MultiMotion,
        pushed: &[f64],
    ) -> f64 {
        let kind = &self.spec.outputs[output].kind;
        let mut rates = vec![0.0; pushed.len()];
        motion.output_transfer(kind, &mut rates);
        let parts = rates.iter().zip(pushed).map(|(rate, pushed)| rate * pushed);
        motion.output(kind).second + parts.sum::<f64>()
    }

    /// Accelerations that the friction found gives to the inputs.
    pub fn friction_accelerations(&self, mobility: &[f64], w: &ForceWorkspace) -> Vec<f64> {
        let rows = mobility.chunks_exact(self.drivers.len());
        let force = &w.several.force;
        rows.map(|row| row.iter().zip(force).map(|(g, t)| g * t).sum())
            .collect()
    }
}
