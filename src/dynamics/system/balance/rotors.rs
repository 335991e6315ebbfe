//! Accelerations of what chains that do not bend hand to their rotors, and of linkages of
//! several inputs.

use super::Balance;
use crate::dynamics::system::constraints::Chains;
use crate::dynamics::system::frozen::{Frozen, Step};
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::quantity::Quantity;

impl Frozen {
    /// Adds what linkages of several inputs do on these: without dampers, and at rest
    /// without anything that speeds make; else with the inertia forces of their accelerations.
    pub(super) fn balance_multi<N: Quantity>(&self, kind: Balance, work: &mut Work<N>) {
        if kind == Balance::Static {
            self.solve_at_rest(work);
        }
        self.apply_multi(false, work);
        if kind == Balance::Kinetostatic {
            for (multi, own) in self.multi.iter().zip(&work.multi) {
                let count = multi.nodes.len();
                for (i, &node) in multi.nodes.iter().enumerate() {
                    for (j, &other) in multi.nodes.iter().enumerate() {
                        let mass = own.space.reduced.mass[i * count + j];
                        let load = mass * work.acceleration[other];
                        work.force[node] -= load;
                    }
                }
            }
        }
    }

    /// Accelerations of all nodes when every chain follows its law like a
    /// rigid body; a rotor's from all that hangs on it, rigidly reduced.
    pub(super) fn law_accelerations<N: Quantity>(
        &self,
        time: N,
        modes: &[i64],
        work: &mut Work<N>,
    ) {
        self.apply_loads(time, modes, Extent::Full, work);
        self.own_masses(Extent::Full, work);
        self.reduce_to_rotors(modes, work);
        if !self.multi.is_empty() {
            self.hold_rotors(work);
            self.follow_rotors(modes, work);
            self.couple_densely(Extent::Full, Chains::Rigid, None, work);
            return self.follow_rotors(modes, work);
        }
        self.follow_rotors(modes, work);
        if self.couple_inertia_forces(Extent::Full, Chains::Rigid, work) {
            self.follow_rotors(modes, work);
        }
    }

    /// Hands inertia and forces of all nodes to the rotors, chains like rigid bodies; but
    /// for those that rest on a stop.
    fn reduce_to_rotors<N: Quantity>(&self, modes: &[i64], work: &mut Work<N>) {
        for step in self.steps.iter().rev() {
            match step {
                Step::Prescribed(_) | Step::Rotor(_) => {}
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    self.reduce_node(rigid.law, rigid.node, work);
                }
                Step::Chain(index) if self.lies_on_stop(*index, modes) => {}
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    for node in chain.nodes() {
                        self.reduce_node(chain.law, node, work);
                    }
                }
                Step::Constrained(index) => {
                    let force = work.force[self.constraints[*index].node];
                    self.load_drivers(*index, force, work);
                }
            }
        }
    }

    /// Accelerations of the rotors from what has been handed to them, and of all that
    /// follows.
    fn follow_rotors<N: Quantity>(&self, modes: &[i64], work: &mut Work<N>) {
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    work.acceleration[rotor.node] = match self.multi.is_empty() {
                        true => work.force[rotor.node] / work.mass[rotor.node],
                        false => work.dense.rotors[rotor.coordinate],
                    };
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    work.acceleration[rigid.node] = self.law_acceleration(rigid.law, work);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let base = match self.lies_on_stop(*index, modes) {
                        true => N::from(0.0),
                        false => self.law_acceleration(chain.law, work),
                    };
                    work.acceleration[chain.nodes()].fill(base);
                }
                Step::Constrained(index) => {
                    let node = self.constraints[*index].node;
                    work.acceleration[node] = self.constrained_acceleration(*index, work);
                }
            }
        }
    }
}
