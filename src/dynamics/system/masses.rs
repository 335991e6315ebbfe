//! What the masses and links of elastic objects are doing.

use super::{Scratch, System};
use crate::dynamics::integrate::Modes;

/// A mass of an elastic object, and the link that holds it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassState {
    /// φ.
    pub displacement: f64,
    /// φ̇.
    pub speed: f64,
    /// Force of the link between this mass and the one before it (of the first mass:
    /// between it and the law), positive where it pulls the mass back.
    pub force: f64,
}

impl System {
    /// Number of masses of an object; 0 of a drive or a rigid one.
    pub fn masses(&self, object: usize) -> usize {
        self.chain(object)
            .map_or(0, |chain| chain.masses - chain.points())
    }

    /// Motions of all masses of all elastic objects, in the order of the objects, in the
    /// state that was observed last ([`Self::observe`]) with the same arguments.
    /// Allocates nothing.
    pub fn observe_masses(
        &self,
        y: &[f64],
        modes: &Modes,
        scratch: &Scratch,
        out: &mut [MassState],
    ) {
        let work = &scratch.work;
        let mut out = out.iter_mut();
        for object in 0..self.places.len() {
            let Some(chain) = self.chain(object) else {
                continue;
            };
            let (u, v) = self.frozen.deviations(chain, y);
            let mode = self.frozen.pair_mode(chain, &modes.0);
            let links = chain.coordinates();
            let (stiffness, damping) = (
                &self.frozen.stiffness[links.clone()],
                &self.frozen.damping[links],
            );
            let first = chain.points();
            for (mass, (node, out)) in (first..).zip(chain.nodes().skip(first).zip(&mut out)) {
                let force = match mass - first {
                    // A massless point hands the force of the contact on.
                    0 => self.frozen.reaction_of_link(chain, mode, u, v),
                    _ => {
                        stiffness[mass] * (u[mass] - u[mass - 1])
                            + damping[mass] * (v[mass] - v[mass - 1])
                    }
                };
                *out = MassState {
                    displacement: work.displacement[node],
                    speed: work.speed[node],
                    force,
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::dynamics::integrate::Dynamics;
    use crate::dynamics::system::{MassState, ObjectState, System};
    use crate::frontend::lower::lower;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};

    const TEN: &[u8] = include_bytes!("../../../scenarios/rocker/ten_masses.json");

    #[test]
    fn masses_move_under_their_links() {
        let document = Document::parse("ten_masses.json", TEN).unwrap();
        let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
        let system = System::new(lower(&reading.scene).unwrap()).unwrap();
        let model = system.model();
        let rocker = model.objects.iter().position(|o| o.id == "rocker").unwrap();
        assert_eq!(system.masses(rocker), 10);
        let start = system.initial_state().unwrap();
        let (mut y, n) = (start.y.clone(), system.coordinates());
        for k in 0..n {
            y[k] += 1e-5 * (k as f64).sin();
            y[n + k] += 0.3 * (2.0 * k as f64).cos();
        }
        let (mut scratch, mut dy) = (system.scratch(), vec![0.0; 2 * n]);
        let mut states = vec![ObjectState::default(); model.objects.len()];
        let mut masses = vec![MassState::default(); 10];
        let (time, modes) = (0.013, &start.modes);
        system.observe(time, &y, modes, &mut scratch, &mut states);
        system.observe_masses(&y, modes, &scratch, &mut masses);
        assert_eq!(masses[9].displacement, states[rocker].displacement);
        assert_eq!(masses[9].speed, states[rocker].speed);
        assert_eq!(masses[0].force, states[rocker].reaction);
        // J·φ̈ of an inner mass is what its two links leave over.
        system.derivatives(time, &y, modes, &mut scratch, &mut dy);
        let law = |h: f64| {
            let mut later = scratch.clone();
            let mut states = masses.clone();
            let mut all = vec![ObjectState::default(); model.objects.len()];
            system.observe(time + h, &y, modes, &mut later, &mut all);
            system.observe_masses(&y, modes, &later, &mut states);
            states[4].displacement
        };
        let h = 1e-5;
        let law = (law(h) - 2.0 * law(0.0) + law(-h)) / (h * h);
        let inertia = model.nodes[model.objects[rocker].nodes[4]].inertia;
        let acceleration = dy[n + 4] + law;
        let left = masses[5].force - masses[4].force;
        approx::assert_relative_eq!(inertia * acceleration, left, max_relative = 1e-4);
    }
}
