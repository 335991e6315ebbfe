//! What an output is: its rates, its link, and forces that act on it.

use super::Kinetostatics;
use super::external::{Wrench, point_of};
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::spec::OutputKind;

impl ForceWorkspace {
    /// Sets the forces that act on the outputs from outside (of what hangs on
    /// them), along each output's displacement (N·m or N), for all positions
    /// solved from now on. Outputs beyond the list have none.
    pub fn set_output_loads(&mut self, loads: &[f64]) {
        self.output_loads.fill(0.0);
        for (own, load) in self.output_loads.iter_mut().zip(loads) {
            *own = *load;
        }
    }
}

impl Kinetostatics {
    /// Adds the forces on the outputs to P.
    pub(super) fn apply_output_loads(&self, w: &mut ForceWorkspace) {
        for rows in &mut w.carried {
            rows.clear();
        }
        for output in 0..self.spec.outputs.len() {
            w.output_forces[output] = 0.0;
            let load = w.output_loads[output];
            if load != 0.0 {
                w.output_forces[output] = load * self.output_rates(output, w)[0];
                for wrench in self.on_output(output, load, w).into_iter().flatten() {
                    self.add_wrench(&wrench, w);
                }
            }
        }
    }

    /// Lets an inertia move with every output; without this none does. Positions
    /// and forces are there already.
    pub(super) fn carry_outputs(&self, w: &mut ForceWorkspace) {
        if w.output_inertias.iter().all(|&inertia| inertia == 0.0) {
            return;
        }
        let mut carried = std::mem::take(&mut w.carried);
        for rows in &mut carried {
            rows.resize(self.equations_count(), 0.0);
        }
        for output in 0..self.spec.outputs.len() {
            let inertia = w.output_inertias[output];
            let rates = self.output_rates(output, w);
            for (rows, rate) in carried.iter_mut().zip(rates) {
                self.each_output_row(output, inertia * rate, w, |row, value| rows[row] += value);
            }
        }
        w.carried = carried;
    }

    /// Rows of a force along an output.
    pub(super) fn each_output_row(
        &self,
        output: usize,
        load: f64,
        w: &ForceWorkspace,
        mut add: impl FnMut(usize, f64),
    ) {
        for wrench in self.on_output(output, load, w).into_iter().flatten() {
            self.each_row_of(&wrench, &w.centres, &mut add);
        }
    }

    /// A force along an output as wrenches on its links.
    fn on_output(&self, output: usize, load: f64, w: &ForceWorkspace) -> [Option<Wrench>; 2] {
        match self.spec.outputs[output].kind {
            OutputKind::Angle { link } => [Some(Wrench::couple(Some(link), load)), None],
            OutputKind::Point { point, direction } => {
                let (sin, cos) = direction.sin_cos();
                let at = point_of(&w.links, &point);
                let force = [load * cos, load * sin];
                [Some(Wrench::force(point.link, at, force)), None]
            }
            OutputKind::Pair { pair: index } => {
                let pair = &self.spec.pairs[index];
                let on = |link: Option<usize>, load: f64| match pair.slides() {
                    false => Wrench::couple(link, load),
                    true => {
                        let at = point_of(&w.links, &pair.link);
                        let force = w.pairs[index].tangent.map(|part| load * part);
                        Wrench::force(link, at, force)
                    }
                };
                [
                    Some(on(pair.link.link, load)),
                    Some(on(pair.on.link, -load)),
                ]
            }
        }
    }

    /// First and second derivative of an output's displacement.
    pub(super) fn output_rates(&self, output: usize, w: &ForceWorkspace) -> [f64; 2] {
        match self.spec.outputs[output].kind {
            OutputKind::Angle { link } => [w.links[link].first[2], w.links[link].second[2]],
            OutputKind::Point { point, direction } => {
                let at = point_of(&w.links, &point);
                let (sin, cos) = direction.sin_cos();
                let along = |v: [f64; 2]| v[0] * cos + v[1] * sin;
                [along(at.first), along(at.second)]
            }
            OutputKind::Pair { pair } => {
                let rates = w.pairs[pair].rates;
                [rates[0], rates[1]]
            }
        }
    }

    /// The link that an output looks at from the ground.
    pub(super) fn output_link(&self, output: usize) -> Option<usize> {
        match self.spec.outputs[output].kind {
            OutputKind::Angle { link } => Some(link),
            OutputKind::Point { point, .. } => point.link,
            OutputKind::Pair { pair } => {
                let pair = &self.spec.pairs[pair];
                pair.link.link.filter(|_| pair.on.link.is_none())
            }
        }
    }

    /// Size of an output's ratio that is of the order of one.
    pub(super) fn output_scale(&self, output: usize) -> f64 {
        let turns = match self.spec.outputs[output].kind {
            OutputKind::Angle { .. } => true,
            OutputKind::Point { .. } => false,
            OutputKind::Pair { pair } => !self.spec.pairs[pair].slides(),
        };
        let driver = self.units[self.spec.driver];
        if turns { driver / self.length } else { driver }
    }
}
