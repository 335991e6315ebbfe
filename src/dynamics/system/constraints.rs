//! Constraints with several drivers in the equations of motion.
//!
//! A constrained node moves as φ = G(φ₁, …, φₖ). Forward it is one step among the
//! others; backward a force on it loads driver i with F·∂G/∂φᵢ. Inertia on it couples
//! the free coordinates that it follows: with Tᵣ = ∂φ/∂φᵣ for each of these *roots*, the
//! inertia force λ = J·φ̈ satisfies (1/J + Σ Tᵣ²/Mᵣ)·λ = φ̈₀, where φ̈₀ is the acceleration
//! without it and Mᵣ the inertia of the roots (Woodbury's formula: the mass matrix is
//! diagonal but for a term of rank one for each such node). Several of them make a small
//! linear system. It is solved in between two passes of accelerations, so that nothing
//! is left out, and scenes without inertia on constrained nodes do nothing of it.

use super::frozen::{Frozen, Step};
use super::multi::MultiPlace;
use super::passes::{Extent, Work};
use crate::kinematics::constraint::{Constraint, ConstraintJet};
use crate::math::linear::dense;
use crate::math::quantity::Quantity;

/// A node with several drivers.
#[derive(Clone, Debug)]
pub(super) struct Constrained {
    /// Internal index of the node.
    pub(super) node: usize,
    /// The driving nodes.
    pub(super) drivers: Vec<usize>,
    /// G.
    pub(super) constraint: Constraint,
    /// True when inertia is on it: its own or that of what follows it rigidly.
    pub(super) heavy: bool,
    /// What it is of a linkage of several inputs, from which it is then read off.
    pub(super) multi: Option<MultiPlace>,
}

impl Constrained {
    /// Driver and ratio of each term of a linear constraint; none of any other.
    pub(super) fn terms(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let ratios = match &self.constraint {
            Constraint::Linear { ratios, .. } => &ratios[..],
            Constraint::Custom(_) => &[],
        };
        self.drivers.iter().copied().zip(ratios.iter().copied())
    }

    /// Σ ratio·value of a linear constraint.
    pub(super) fn sum(&self, value: impl Fn(usize) -> f64) -> f64 {
        self.terms()
            .map(|(driver, ratio)| ratio * value(driver))
            .sum()
    }

    /// φ of a linear constraint where all drivers are at zero.
    pub(super) fn offset(&self) -> f64 {
        match self.constraint {
            Constraint::Linear { offset, .. } => offset,
            Constraint::Custom(_) => 0.0,
        }
    }
}

/// A constraint at an instant, and room for evaluating it.
#[derive(Clone, Debug)]
pub(super) struct ConstraintValues<N> {
    /// ∂G/∂φᵢ.
    pub(super) first: Vec<N>,
    /// Σ ∂²G/∂φᵢ∂φⱼ·φ̇ᵢ·φ̇ⱼ, the part of the acceleration that needs no φ̈.
    pub(super) bias: N,
    places: Vec<f64>,
    jet: ConstraintJet,
}

/// Room for the inertia forces on constrained nodes, C of them over k nodes.
#[derive(Clone, Debug)]
pub(super) struct Coupling<N> {
    /// Tᵣ: motion of each such node over that of each node before it (C × k).
    shares: Vec<N>,
    /// The linear system, row by row (C × C), and its right side and solution (C).
    matrix: Vec<N>,
    forces: Vec<N>,
    exchanged: Vec<usize>,
}

impl<N: Quantity> ConstraintValues<N> {
    pub(super) fn new(constrained: &Constrained) -> Self {
        let count = constrained.drivers.len();
        // Linear ones, of hundreds of modes as it may be, need no room for k³ derivatives.
        let curved = match constrained.constraint {
            Constraint::Linear { .. } => 0,
            Constraint::Custom(_) => count,
        };
        Self {
            first: vec![N::from(0.0); count],
            bias: N::from(0.0),
            places: vec![0.0; count],
            jet: ConstraintJet::new(curved),
        }
    }

    /// Value and rate of G; the rest stays here.
    fn evaluate(&mut self, constrained: &Constrained, displacement: &[N], speed: &[N]) -> [N; 2] {
        let drivers = &constrained.drivers;
        let count = drivers.len();
        if let Constraint::Linear { ratios, offset } = &constrained.constraint {
            let (mut value, mut rate) = (N::from(*offset), N::from(0.0));
            for (index, (&driver, &ratio)) in drivers.iter().zip(ratios).enumerate() {
                value += displacement[driver].scale(ratio);
                rate += speed[driver].scale(ratio);
                self.first[index] = N::from(ratio);
            }
            return [value, rate];
        }
        for (place, &driver) in self.places.iter_mut().zip(drivers) {
            *place = displacement[driver].value();
        }
        constrained.constraint.jet(&self.places, &mut self.jet);
        // A number with the derivatives that follow from its partial ones.
        let number = |value: f64, partial: &[f64]| {
            let mut sum = N::from(value);
            for (&driver, &by) in drivers.iter().zip(partial) {
                let phi = displacement[driver];
                sum += (phi - N::from(phi.value())).scale(by);
            }
            sum
        };
        let jet = &self.jet;
        let value = number(jet.value, &jet.first);
        let (mut rate, mut bias) = (N::from(0.0), N::from(0.0));
        for i in 0..count {
            let row = &jet.second[i * count..(i + 1) * count];
            self.first[i] = number(jet.first[i], row);
            rate += self.first[i] * speed[drivers[i]];
            for j in 0..count {
                let at = (i * count + j) * count;
                let second = number(row[j], &jet.third[at..at + count]);
                bias += second * speed[drivers[i]] * speed[drivers[j]];
            }
        }
        self.bias = bias;
        [value, rate]
    }
}

impl ConstraintValues<f64> {
    /// φ, φ̇ and φ̈ of the constrained node from those of all nodes before it.
    pub(super) fn sample(&mut self, constrained: &Constrained, motion: &[[f64; 3]]) -> [f64; 3] {
        let part = |which: usize| motion.iter().map(|at| at[which]).collect::<Vec<f64>>();
        let [value, rate] = self.evaluate(constrained, &part(0), &part(1));
        let accelerations = constrained.drivers.iter().zip(&self.first);
        let sum = accelerations.map(|(&driver, first)| first * motion[driver][2]);
        [value, rate, self.bias + sum.sum::<f64>()]
    }
}

impl<N: Quantity> Coupling<N> {
    pub(super) fn new(frozen: &Frozen) -> Self {
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

/// Assumption about the elastic chains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Chains {
    /// Masses move freely.
    Free,
    /// Masses follow their laws like rigid bodies.
    Rigid,
}

impl Frozen {
    /// Displacement and speed of a constrained node, those of its drivers known.
    pub(super) fn constrain<N: Quantity>(&self, index: usize, work: &mut Work<N>) {
        let constrained = &self.constraints[index];
        if let Some(place) = constrained.multi {
            return self.follow_multi(place, index, work);
        }
        let values = &mut work.constraints[index];
        let [value, rate] = values.evaluate(constrained, &work.displacement, &work.speed);
        work.displacement[constrained.node] = value;
        work.speed[constrained.node] = rate;
    }

    /// Acceleration of a constrained node, those of its drivers known.
    pub(super) fn constrained_acceleration<N: Quantity>(&self, index: usize, work: &Work<N>) -> N {
        let values = &work.constraints[index];
        let drivers = self.constraints[index].drivers.iter().zip(&values.first);
        let mut sum = values.bias;
        for (&driver, &first) in drivers {
            sum += first * work.acceleration[driver];
        }
        sum
    }

    /// Loads the drivers of a constrained node with a force on it.
    pub(super) fn load_drivers<N: Quantity>(&self, index: usize, force: N, work: &mut Work<N>) {
        let drivers = &self.constraints[index].drivers;
        for (&driver, &first) in drivers.iter().zip(&work.constraints[index].first) {
            work.force[driver] += force * first;
        }
    }

    /// Rigid nodes, and bodies that a rigid contact holds, hand inertia and forces to their
    /// drivers, constrained nodes their forces alone, the last driven first.
    pub(super) fn reduce_steps<N: Quantity>(&self, extent: Extent, work: &mut Work<N>) {
        self.own_masses(extent, work);
        for step in self.steps_of(extent).iter().rev() {
            match *step {
                Step::Prescribed(_) | Step::Rotor(_) => {}
                Step::Chain(index) => {
                    let chain = &self.chains[index];
                    if chain.contact.holds(work.pair_modes[index]) {
                        self.reduce_node(chain.law, chain.first_node, work);
                    }
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[index];
                    self.reduce_node(rigid.law, rigid.node, work);
                }
                Step::Constrained(index) => {
                    let force = work.force[self.constraints[index].node];
                    self.load_drivers(index, force, work);
                }
            }
        }
    }

    /// Takes the inertia forces of constrained nodes into the forces, the accelerations
    /// without them known. True when there are any: then the accelerations are to be
    /// formed anew.
    pub(super) fn couple<N: Quantity>(
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
    pub(super) fn shares_of_node<N: Quantity>(
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
                    for node in self.chains[index].nodes() {
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

    /// True when the motion of a node hangs on a constrained node with inertia or moves a
    /// linkage of several inputs, or the other way round: joint friction is not found there.
    pub(super) fn is_coupled(&self, root: usize) -> bool {
        let mut inputs = self.multi.iter().flat_map(|multi| &multi.nodes);
        if inputs.any(|&node| node == root || self.roots(node).contains(&root)) {
            return true;
        }
        self.heavy.iter().any(|&index| {
            let constrained = &self.constraints[index];
            constrained.node == root || self.roots(constrained.node).contains(&root)
        })
    }

    /// The nodes of free or given motion that a node follows rigidly.
    pub(super) fn roots(&self, node: usize) -> Vec<usize> {
        let (mut roots, mut open) = (Vec::new(), vec![node]);
        while let Some(node) = open.pop() {
            let rigid = self.rigids.iter().find(|rigid| rigid.node == node);
            let several = self.constraints.iter().find(|c| c.node == node);
            match (rigid, several) {
                (Some(rigid), _) => open.push(self.laws[rigid.law].driver),
                (None, Some(constrained)) => open.extend(&constrained.drivers),
                (None, None) if !roots.contains(&node) => roots.push(node),
                (None, None) => {}
            }
        }
        roots
    }

    /// Marks the constrained nodes that inertia is on.
    pub(super) fn mark_heavy(&mut self) {
        let mut inertia: Vec<bool> = self.inertia.iter().map(|&inertia| inertia > 0.0).collect();
        for linkage in &self.linkages {
            inertia[linkage.node] = true;
        }
        self.heavy.clear();
        for step in self.steps.iter().rev() {
            match *step {
                Step::Rigid(index) => {
                    let rigid = self.rigids[index];
                    let driver = self.laws[rigid.law].driver;
                    inertia[driver] |= inertia[rigid.node];
                }
                Step::Chain(index) if self.chains[index].contact.restitution().is_some() => {
                    inertia[self.laws[self.chains[index].law].driver] = true;
                }
                Step::Constrained(index) => {
                    let constrained = &mut self.constraints[index];
                    constrained.heavy = inertia[constrained.node];
                    if constrained.heavy {
                        self.heavy.push(index);
                    }
                }
                _ => {}
            }
        }
        self.heavy.reverse();
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
