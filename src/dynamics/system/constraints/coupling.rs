//! Inertia forces on nodes that constraints move.

use super::Chains;
use crate::dynamics::system::frozen::{Frozen, Step};
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::linear::dense;
use crate::math::quantity::Quantity;

/// Room for the inertia forces on constrained nodes, C of them over k nodes.
#[derive(Clone, Debug)]
pub(in crate::dynamics::system) struct Coupling<N> {
    /// Tᵣ: motion of each such node over that of each node before it (C × k).
    shares: Vec<N>,
    /// The linear system, row by row (C × C), and its right side and solution (C).
    matrix: Vec<N>,
    forces: Vec<N>,
    exchanged: Vec<usize>,
}

impl<N: Quantity> Coupling<N> {
    pub(in crate::dynamics::system) fn new(frozen: &Frozen) -> Self {
        // All of them are heavy where chains are taken for rigid.
        let count = frozen.constraints.len();
        let zero = N::from(0.0);
        Self {
            shares: vec![zero; count * frozen.inertia.len()],
            matrix: vec![zero; count * count],
            forces: vec![zero; count],
            exchanged: vec![0; count],
        }
    }
}

impl<N> Coupling<N> {
    /// No room: while it is in use.
    const EMPTY: Self = Self {
        shares: Vec::new(),
        matrix: Vec::new(),
        forces: Vec::new(),
        exchanged: Vec::new(),
    };
}

impl Frozen {
    /// Takes the inertia forces of constrained nodes into the forces, the accelerations
    /// without them known. True when there are any: then the accelerations are to be
    /// formed anew.
    pub(in crate::dynamics::system) fn couple_inertia_forces<N: Quantity>(
        &self,
        extent: Extent,
        chains: Chains,
        work: &mut Work<N>,
    ) -> bool {
        let nodes = self.inertia.len();
        let list = |number: usize| match chains {
            Chains::Free => self.heavy[number],
            Chains::Rigid => number,
        };
        let count = match chains {
            Chains::Free => self.heavy.len(),
            Chains::Rigid => self.constraints.len(),
        };
        if count == 0 {
            return false;
        }
        let mut coupling = std::mem::replace(&mut work.coupling, Coupling::EMPTY);
        let Coupling {
            shares,
            matrix,
            forces,
            exchanged,
        } = &mut coupling;
        let (shares, matrix, forces, exchanged) = (
            &mut shares[..count * nodes],
            &mut matrix[..count * count],
            &mut forces[..count],
            &mut exchanged[..count],
        );
        for (number, row) in shares.chunks_exact_mut(nodes).enumerate() {
            self.shares_of(list(number), extent, chains, work, row);
        }
        for i in 0..count {
            let node = self.constraints[list(i)].node;
            let mass = work.mass[node];
            for j in 0..count {
                let (one, other) = (&shares[i * nodes..], &shares[j * nodes..]);
                let sum = self.mobility(extent, chains, one, other, work);
                // J·(Σ TᵢTⱼ/M) + 1: an inertia of zero makes no force.
                let own = N::from(if i == j { 1.0 } else { 0.0 });
                matrix[i * count + j] = mass * sum + own;
            }
            forces[i] = mass * work.acceleration[node];
        }
        // The matrix is 1 + J·S with S symmetric and positive: none of its pivots vanishes,
        // unless it is no number.
        if dense::factorise(matrix, exchanged).is_regular() {
            dense::solve(matrix, exchanged, forces, 1);
        } else {
            forces.fill(N::from(f64::NAN));
        }
        for (number, &force) in forces.iter().enumerate() {
            let row = &shares[number * nodes..(number + 1) * nodes];
            let own = self.constraints[list(number)].node;
            for (node, &share) in row.iter().enumerate() {
                if node != own {
                    work.force[node] -= force * share;
                }
            }
        }
        work.coupling = coupling;
        true
    }

    /// ∂φ/∂φ of a constrained node over every node that it follows rigidly, up to those
    /// whose motion is free or given.
    fn shares_of<N: Quantity>(
        &self,
        index: usize,
        extent: Extent,
        chains: Chains,
        work: &Work<N>,
        shares: &mut [N],
    ) {
        let node = self.constraints[index].node;
        self.shares_of_node(node, extent, chains, work, shares);
    }

    /// ∂φ/∂φ of any node, likewise.
    pub(in crate::dynamics::system) fn shares_of_node<N: Quantity>(
        &self,
        node: usize,
        extent: Extent,
        chains: Chains,
        work: &Work<N>,
        shares: &mut [N],
    ) {
        shares.fill(N::from(0.0));
        shares[node] = N::from(1.0);
        for step in self.steps_of(extent).iter().rev() {
            match *step {
                Step::Prescribed(_) | Step::Rotor(_) => {}
                Step::Rigid(index) => {
                    let rigid = self.rigids[index];
                    let share = shares[rigid.node] * work.laws[rigid.law].first;
                    shares[self.laws[rigid.law].driver] += share;
                }
                Step::Constrained(index) => {
                    let constrained = &self.constraints[index];
                    let share = shares[constrained.node];
                    let first = &work.constraints[index].first;
                    for (&driver, &first) in constrained.drivers.iter().zip(first) {
                        shares[driver] += share * first;
                    }
                }
                Step::Chain(index) if chains == Chains::Rigid || self.is_held(index, work) => {
                    let chain = &self.chains[index];
                    let first = work.laws[chain.law].first;
                    for node in chain.nodes() {
                        let share = shares[node] * first;
                        shares[self.laws[chain.law].driver] += share;
                    }
                }
                Step::Chain(_) => {}
            }
        }
    }

    /// Σ TᵣSᵣ/Mᵣ over the free nodes.
    fn mobility<N: Quantity>(
        &self,
        extent: Extent,
        chains: Chains,
        one: &[N],
        other: &[N],
        work: &Work<N>,
    ) -> N {
        let mut sum = N::from(0.0);
        for step in self.steps_of(extent) {
            match *step {
                Step::Rotor(rotor) => {
                    let node = rotor.node;
                    sum += one[node] * other[node] / work.mass[node];
                }
                Step::Chain(index) if chains == Chains::Free && !self.is_held(index, work) => {
                    let chain = &self.chains[index];
                    // (Nothing hangs on a massless point.)
                    for node in chain.nodes().skip(chain.points()) {
                        if self.is_grounded(node, work) {
                            continue;
                        }
                        sum += one[node] * other[node] / work.mass[node];
                    }
                }
                _ => {}
            }
        }
        sum
    }
}
