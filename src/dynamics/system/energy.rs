//! Energy kept and lost.

use super::frozen::{Chain, Frozen};
use super::passes::{Extent, Work};
use super::{Energy, Scratch, System};
use crate::dynamics::integrate::Modes;
use crate::math::quantity::Quantity;

impl System {
    /// Kinetic energy of all inertias; elastic energy of links, pairs and stops with
    /// the potential energy of the weights and springs of linkages.
    /// Springs that are loads are not counted: they are in the work of the
    /// loads. Allocates nothing.
    pub fn energy(&self, time: f64, y: &[f64], modes: &Modes, scratch: &mut Scratch) -> Energy {
        let [kinetic, elastic] = self.frozen.energy(time, y, &modes.0, &mut scratch.work);
        Energy { kinetic, elastic }
    }
}

impl Frozen {
    /// Kinetic and elastic energy.
    pub(super) fn energy<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
    ) -> [N; 2] {
        self.motion(time, state, modes, Extent::Full, work);
        self.energy_of(state, work)
    }

    /// Kinetic and potential energy (J) where the motion is known.
    pub(super) fn energy_of<N: Quantity>(&self, state: &[N], work: &Work<N>) -> [N; 2] {
        let (mut kinetic, mut elastic) = (N::from(0.0), N::from(0.0));
        for (&inertia, &speed) in self.inertia.iter().zip(&work.speed) {
            kinetic += (speed * speed).scale(0.5 * inertia);
        }
        for chain in &self.chains {
            let (u, _) = self.deviations(chain, state);
            elastic += chain.contact.stored(u[0]);
            let inner = &self.stiffness[chain.coordinates()][1..];
            for (pair, &stiffness) in u.windows(2).zip(inner) {
                let stretch = pair[1] - pair[0];
                elastic += (stretch * stretch).scale(0.5 * stiffness);
            }
        }
        for stop in &self.stops {
            let x = stop.deformation(work.displacement[stop.node]);
            elastic += stop.contact.stored(x);
        }
        for (index, linkage) in self.linkages.iter().enumerate() {
            let reduced = self.linkage(index, work);
            let speed = work.speed[linkage.node];
            kinetic += (reduced.inertia * speed * speed).scale(0.5);
            elastic += reduced.potential;
        }
        for own in &work.multi {
            let [moving, stored] = match own.assembled {
                true => own.space.energies(),
                false => [N::from(f64::NAN); 2],
            };
            kinetic += moving;
            elastic += stored;
        }
        [kinetic, elastic]
    }

    /// Power lost in a chain's pair and links.
    pub(super) fn dissipated(&self, chain: &Chain, y: &[f64], modes: &Modes) -> f64 {
        let (u, v) = self.deviations(chain, y);
        let first = chain.points();
        let inner = v[first..]
            .windows(2)
            .zip(&self.damping[chain.coordinates()][first + 1..])
            .map(|(pair, damping)| damping * (pair[1] - pair[0]).powi(2));
        let mode = self.pair_mode(chain, &modes.0);
        let rate = self.pair_rate(chain, mode, u, v);
        let contact = chain.contact.dissipated(mode, u[0], rate);
        match chain.point {
            true => {
                let (_, damping) = self.link_behind(chain);
                contact + damping * (v[1] - rate).powi(2) + inner.sum::<f64>()
            }
            false => contact + inner.sum::<f64>(),
        }
    }
}
