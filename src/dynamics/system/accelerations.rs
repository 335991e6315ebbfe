//! The last pass of the equations of motion: the links' forces and the accelerations.

use super::frozen::{Chain, Frozen, Step};
use super::links::LinkForces;
use super::passes::{Extent, Work};
use crate::math::quantity::Quantity;

impl Frozen {
    /// Accelerations, drivers before driven; u¨ into `out` (n).
    #[inline]
    pub(super) fn accelerate<N: Quantity>(
        &self,
        state: &[N],
        extent: Extent,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        for step in self.steps_of(extent) {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    let mass = if self.rigids.is_empty() {
                        N::from(self.inertia[rotor.node])
                    } else {
                        work.mass[rotor.node]
                    };
                    let acceleration = work.force[rotor.node] / mass;
                    work.acceleration[rotor.node] = acceleration;
                    out[rotor.coordinate] = acceleration;
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = self.law_acceleration(chain.law, work);
                    let reaction = work.reaction[*index];
                    let mode = work.pair_modes[*index];
                    self.accelerate_chain(chain, state, ([base, reaction], mode), work, out);
                }
                Step::Constrained(index) => {
                    let node = self.constraints[*index].node;
                    work.acceleration[node] = self.constrained_acceleration(*index, work);
                }
            }
        }
    }

    /// Accelerations of the nodes from u¨ of the coordinates, as far as
    /// somebody looks at them; needs [`Frozen::motion`] done.
    pub(super) fn known_accelerations<N: Quantity>(&self, deviations: &[N], work: &mut Work<N>) {
        for step in &self.coupled {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    work.acceleration[rotor.node] = deviations[rotor.coordinate];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = self.law_acceleration(chain.law, work);
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        work.acceleration[node] = deviations[coordinate] + base;
                    }
                }
                Step::Constrained(index) => {
                    let node = self.constraints[*index].node;
                    work.acceleration[node] = self.constrained_acceleration(*index, work);
                }
            }
        }
    }

    /// U′·φ̈ + U″·φ̇² of a law, its driver's acceleration known.
    #[inline(always)]
    pub(super) fn law_acceleration<N: Quantity>(&self, law: usize, work: &Work<N>) -> N {
        let values = &work.laws[law];
        values.first * work.acceleration[self.laws[law].driver] + values.bias
    }

    /// u¨ of a chain's masses, from the acceleration `base` that its law asks
    /// for and F of the link that holds the pair, in the mode of that.
    #[inline(always)]
    fn accelerate_chain<N: Quantity>(
        &self,
        chain: &Chain,
        state: &[N],
        ([base, reaction], mode): ([N; 2], i64),
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        let (u, v) = self.deviations(chain, state);
        let skip = chain.points();
        let links = LinkForces {
            u: &u[skip..],
            v: &v[skip..],
            stiffness: &self.stiffness[chain.coordinates()][skip..],
            damping: &self.damping[chain.coordinates()][skip..],
            reaction,
        };
        let out = &mut out[chain.coordinates()];
        let inverse = &self.inverse_inertia[chain.coordinates()][skip..];
        let other = &work.force[chain.nodes()][skip..];
        if chain.carries {
            let mass = &work.mass[chain.nodes()][skip..];
            links.each(&mut out[skip..], |m, out, force| {
                *out = (other[m] + force) / mass[m] - base
            });
        } else {
            links.each(&mut out[skip..], |m, out, force| {
                *out = (other[m] + force).scale(inverse[m]) - base;
            });
        }
        if chain.point {
            out[0] = self.point_acceleration(chain, mode, (u, v), out[1]);
        }
        let acceleration = &mut work.acceleration[chain.nodes()];
        for (acceleration, &deviation) in acceleration.iter_mut().zip(out.iter()) {
            *acceleration = deviation + base;
        }
    }
}
