//! The inertia forces of linkages of several inputs and of constrained nodes beside them.

use super::Root;
use crate::dynamics::system::constraints::Chains;
use crate::dynamics::system::frozen::{Frozen, Step};
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::linear::dense;
use crate::math::quantity::Quantity;

/// Room for the equations of the roots: c carriers of inertia over k nodes, r roots.
#[derive(Clone, Debug)]
pub(in crate::dynamics::system) struct Dense<N> {
    /// Motion of each carrier over that of each node before it (c × k).
    pub(in crate::dynamics::system) shares: Vec<N>,
    /// D + TᵀMT (r × r), then its factors.
    pub(in crate::dynamics::system) matrix: Vec<N>,
    /// Right side, then the accelerations (r).
    pub(in crate::dynamics::system) right: Vec<N>,
    /// Inertia forces of the carriers (c).
    pub(in crate::dynamics::system) forces: Vec<N>,
    /// M·T of a block (c).
    product: Vec<N>,
    /// Least pivot of the matrix over what it began as.
    pub(in crate::dynamics::system) positive: f64,
    /// Accelerations of the rotors (n).
    pub(in crate::dynamics::system) rotors: Vec<N>,
}

impl<N: Quantity> Dense<N> {
    pub(in crate::dynamics::system) fn new(frozen: &Frozen) -> Self {
        if frozen.multi.is_empty() {
            return Self::EMPTY;
        }
        let inputs: usize = frozen.multi.iter().map(|multi| multi.nodes.len()).sum();
        let (carriers, roots) = (inputs + frozen.constraints.len(), frozen.roots.len());
        let zero = N::from(0.0);
        Self {
            shares: vec![zero; carriers * frozen.inertia.len()],
            matrix: vec![zero; roots * roots],
            right: vec![zero; roots],
            forces: vec![zero; carriers],
            product: vec![zero; carriers],
            positive: 1.0,
            rotors: vec![zero; frozen.coordinates],
        }
    }
}

impl<N> Dense<N> {
    /// No room: while it is in use, and where there is nothing to couple.
    const EMPTY: Self = Self {
        shares: Vec::new(),
        matrix: Vec::new(),
        right: Vec::new(),
        forces: Vec::new(),
        product: Vec::new(),
        positive: 1.0,
        rotors: Vec::new(),
    };
}

/// A carrier of inertia: an input of a linkage of several, or a constrained node.
#[derive(Clone, Copy, Debug)]
enum Carrier {
    Input(usize),
    Constrained(usize),
}

impl Carrier {
    fn node(self) -> usize {
        match self {
            Self::Input(node) | Self::Constrained(node) => node,
        }
    }
}

impl Frozen {
    /// The roots, once all nodes have their places.
    pub(in crate::dynamics::system) fn find_roots(&mut self) {
        if self.multi.is_empty() {
            return;
        }
        let inputs = self
            .multi
            .iter()
            .flat_map(|multi| multi.nodes.iter().copied());
        let heavy = self.heavy.iter().map(|&index| self.constraints[index].node);
        let nodes: Vec<usize> = inputs.chain(heavy).collect();
        let mut found: Vec<usize> = nodes
            .into_iter()
            .flat_map(|node| self.root_nodes(node))
            .collect();
        let rotor = |node: usize| {
            let mut steps = self.steps.iter();
            steps.any(|step| matches!(step, Step::Rotor(rotor) if rotor.node == node))
        };
        // The accelerations of all rotors are found here.
        found.extend((0..self.inertia.len()).filter(|&node| rotor(node)));
        found.sort_unstable();
        found.dedup();
        let root = |node: usize| {
            let coordinate = self.coordinate[node]?;
            let rotor = rotor(node);
            Some(Root {
                node,
                coordinate,
                rotor,
            })
        };
        self.roots = found.into_iter().filter_map(root).collect();
    }

    fn carriers(&self, chains: Chains) -> impl Iterator<Item = Carrier> + '_ {
        let inputs = self.multi.iter().flat_map(|multi| &multi.nodes);
        let heavy = self
            .heavy
            .iter()
            .copied()
            .filter(move |_| chains == Chains::Free);
        let all = (0..self.constraints.len()).filter(move |_| chains == Chains::Rigid);
        inputs.map(|&node| Carrier::Input(node)).chain(
            heavy
                .chain(all)
                .map(|index| Carrier::Constrained(self.constraints[index].node)),
        )
    }

    /// Takes the inertia forces of the carriers into the forces, the accelerations without
    /// them known (those of rotors zero), and finds the accelerations of the rotors: all
    /// others are then to be formed anew. Friction of joints acts in the modes that are given.
    pub(in crate::dynamics::system) fn couple_densely<N: Quantity>(
        &self,
        extent: Extent,
        chains: Chains,
        modes: Option<&[i64]>,
        work: &mut Work<N>,
    ) {
        let nodes = self.inertia.len();
        let mut dense = std::mem::replace(&mut work.dense, Dense::EMPTY);
        let count = self.carriers(chains).count();
        let rows = dense.shares.chunks_exact_mut(nodes);
        for (carrier, row) in self.carriers(chains).zip(rows) {
            self.shares_of_node(carrier.node(), extent, chains, work, row);
        }
        for (carrier, force) in self.carriers(chains).zip(&mut dense.forces) {
            *force = work.acceleration[carrier.node()];
        }
        let roots = self.roots.len();
        let is_free = |root: &Root| root.rotor || chains == Chains::Free;
        dense.matrix[..roots * roots].fill(N::from(0.0));
        for (r, root) in self.roots.iter().enumerate() {
            let own = match is_free(root) {
                true => work.mass[root.node],
                false => N::from(1.0),
            };
            dense.matrix[r * roots + r] = own;
            dense.right[r] = match root.rotor {
                true => work.force[root.node],
                false => N::from(0.0),
            };
        }
        let mut first = 0;
        let mut add = |dense: &mut Dense<N>, size: usize, mass: &dyn Fn(usize, usize) -> N| {
            let block = first..first + size;
            first += size;
            for (s, other) in self
                .roots
                .iter()
                .enumerate()
                .filter(|(_, root)| is_free(root))
            {
                for i in 0..size {
                    let mut sum = N::from(0.0);
                    for j in 0..size {
                        let share = dense.shares[(block.start + j) * nodes + other.node];
                        sum += mass(i, j) * share;
                    }
                    dense.product[i] = sum;
                }
                for (r, root) in self
                    .roots
                    .iter()
                    .enumerate()
                    .filter(|(_, root)| is_free(root))
                {
                    for i in 0..size {
                        let share = dense.shares[(block.start + i) * nodes + root.node];
                        let part = dense.product[i];
                        dense.matrix[r * roots + s] += share * part;
                    }
                }
            }
            for i in 0..size {
                let mut sum = N::from(0.0);
                for j in 0..size {
                    sum += mass(i, j) * dense.forces[block.start + j];
                }
                for (r, root) in self
                    .roots
                    .iter()
                    .enumerate()
                    .filter(|(_, root)| is_free(root))
                {
                    let share = dense.shares[(block.start + i) * nodes + root.node];
                    dense.right[r] -= share * sum;
                }
            }
        };
        for (multi, own) in self.multi.iter().zip(&work.multi) {
            let size = multi.nodes.len();
            add(&mut dense, size, &|i, j| {
                own.space.reduced.mass[i * size + j]
            });
        }
        for carrier in self.carriers(chains) {
            if let Carrier::Constrained(node) = carrier {
                add(&mut dense, 1, &|_, _| work.mass[node]);
            }
        }
        let matrix = &mut dense.matrix[..roots * roots];
        dense.positive = dense::factorise_symmetric(matrix, roots);
        dense::solve_symmetric(matrix, &mut dense.right[..roots]);
        if let Some(modes) = modes {
            self.apply_multi_input_friction(&mut dense, modes, work);
        }
        // The accelerations of the carriers, then their inertia forces.
        for (number, force) in dense.forces[..count].iter_mut().enumerate() {
            for (r, root) in self
                .roots
                .iter()
                .enumerate()
                .filter(|(_, root)| is_free(root))
            {
                *force += dense.shares[number * nodes + root.node] * dense.right[r];
            }
        }
        let mut first = 0;
        for (multi, own) in self.multi.iter().zip(&work.multi) {
            let size = multi.nodes.len();
            for i in 0..size {
                let mut sum = N::from(0.0);
                for j in 0..size {
                    sum += own.space.reduced.mass[i * size + j] * dense.forces[first + j];
                }
                dense.product[first + i] = sum;
            }
            first += size;
        }
        if modes.is_some() {
            self.take_off_friction(&mut dense.product, work);
        }
        for (number, carrier) in self.carriers(chains).enumerate() {
            let row = &dense.shares[number * nodes..(number + 1) * nodes];
            let (force, own) = match carrier {
                Carrier::Input(_) => (dense.product[number], None),
                Carrier::Constrained(node) => (work.mass[node] * dense.forces[number], Some(node)),
            };
            for (node, &share) in row.iter().enumerate() {
                if Some(node) != own {
                    work.force[node] -= force * share;
                }
            }
        }
        for (r, root) in self.roots.iter().enumerate().filter(|(_, root)| root.rotor) {
            dense.rotors[root.coordinate] = dense.right[r];
        }
        work.dense = dense;
    }

    /// Sets the accelerations of the rotors to zero: those that their forces make are found
    /// with the inertia forces.
    pub(in crate::dynamics::system) fn hold_rotors<N: Quantity>(&self, work: &mut Work<N>) {
        work.dense.rotors.fill(N::from(0.0));
    }
}
