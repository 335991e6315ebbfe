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
                    let acceleration = if !self.multi.is_empty() {
                        work.dense.rotors[rotor.coordinate]
                    } else if self.rigids.is_empty() && !self.impacts {
                        work.force[rotor.node] / N::from(self.inertia[rotor.node])
                    } else {
                        work.force[rotor.node] / work.mass[rotor.node]
                    };
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
                    let mode = work.pair_modes[*index];
                    if chain.contact.contact_holds(mode) {
                        self.accelerate_held(*index, base, work, out);
                        continue;
                    }
                    let reaction = work.reaction[*index];
                    self.accelerate_chain(chain, state, ([base, reaction], mode), work, out);
                    if self.impacts {
                        self.hold_by_stop(*index, base, work, out);
                    }
                }
                Step::Constrained(index) => {
                    let node = self.constraints[*index].node;
                    work.acceleration[node] = self.constrained_acceleration(*index, work);
                }
            }
        }
    }

    /// A body that a rigid contact holds: it goes with its law, and the contact has the
    /// force that this takes.
    fn accelerate_held<N: Quantity>(
        &self,
        index: usize,
        base: N,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        let chain = &self.chains[index];
        let node = chain.first_node;
        out[chain.first_coordinate] = N::from(0.0);
        work.acceleration[node] = base;
        work.reaction[index] = work.force[node] - work.mass[node] * base;
    }

    /// Holds the last mass of a chain where a rigid stop does.
    fn hold_by_stop<N: Quantity>(&self, index: usize, base: N, work: &mut Work<N>, out: &mut [N]) {
        let chain = &self.chains[index];
        for (number, stop) in self.stops.iter().enumerate() {
            if stop.chain != index || !stop.contact.contact_holds(work.stop_modes[number]) {
                continue;
            }
            let coordinate = chain.first_coordinate + (stop.node - chain.first_node);
            work.stop_reaction[number] = -(work.mass[stop.node] * work.acceleration[stop.node]);
            work.acceleration[stop.node] = N::from(0.0);
            out[coordinate] = -base;
        }
    }

    /// True of a chain that a rigid contact holds on its law, as of the last evaluation.
    pub(super) fn is_held<N>(&self, index: usize, work: &Work<N>) -> bool {
        (self.chains[index].contact).contact_holds(work.pair_modes[index])
    }

    /// True of a mass that a rigid stop holds, as of the last evaluation.
    pub(super) fn is_grounded<N>(&self, node: usize, work: &Work<N>) -> bool {
        let mut stops = self.stops.iter().zip(&work.stop_modes);
        stops.any(|(stop, &mode)| stop.node == node && stop.contact.contact_holds(mode))
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
            links.for_each_mass(&mut out[skip..], |m, out, force| {
                *out = (other[m] + force) / mass[m] - base
            });
        } else {
            links.for_each_mass(&mut out[skip..], |m, out, force| {
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
