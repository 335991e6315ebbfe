//! Constraints with several drivers in the equations of motion.
//!
//! A constrained node moves as φ = G(φ₁, …, φₖ). Forward it is one step among the
//! others; backward a force on it loads driver i with F·∂G/∂φᵢ. Inertia on it couples
//! the free coordinates that it follows. With Tᵣ = ∂φ/∂φᵣ for each of these *roots*, the
//! inertia force λ = J·φ̈ satisfies (1/J + Σ Tᵣ²/Mᵣ)·λ = φ̈₀. Here φ̈₀ is the acceleration
//! without it and Mᵣ the inertia of the roots (Woodbury's formula: the mass matrix is
//! diagonal but for a term of rank one for each such node). Several of them make a small
//! linear system. It is solved in between two passes of accelerations, so that nothing
//! is left out, and scenes without inertia on constrained nodes do nothing of it.
//!
//! It holds on dual numbers too.

mod coupling;

use super::frozen::{Frozen, Step};
use super::multi::MultiPlace;
use super::passes::{Extent, Work};
use crate::kinematics::constraint::{Constraint, ConstraintJet};
use crate::math::quantity::Quantity;

/// A node with several drivers.
#[derive(Clone, Debug)]
pub(super) struct ConstrainedNode {
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

impl ConstrainedNode {
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

pub(super) use coupling::Coupling;

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

impl<N: Quantity> ConstraintValues<N> {
    pub(super) fn new(constrained: &ConstrainedNode) -> Self {
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
    fn evaluate(
        &mut self,
        constrained: &ConstrainedNode,
        displacement: &[N],
        speed: &[N],
    ) -> [N; 2] {
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
    pub(super) fn sample(
        &mut self,
        constrained: &ConstrainedNode,
        motion: &[[f64; 3]],
    ) -> [f64; 3] {
        let part = |which: usize| motion.iter().map(|at| at[which]).collect::<Vec<f64>>();
        let [value, rate] = self.evaluate(constrained, &part(0), &part(1));
        let accelerations = constrained.drivers.iter().zip(&self.first);
        let sum = accelerations.map(|(&driver, first)| first * motion[driver][2]);
        [value, rate, self.bias + sum.sum::<f64>()]
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
                    if chain.contact.contact_holds(work.pair_modes[index]) {
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

    /// True when the motion of a node hangs on a constrained node with inertia or moves a
    /// linkage of several inputs, or the other way round: joint friction is not found there.
    pub(super) fn is_coupled(&self, root: usize) -> bool {
        let mut inputs = self.multi.iter().flat_map(|multi| &multi.nodes);
        if inputs.any(|&node| node == root || self.root_nodes(node).contains(&root)) {
            return true;
        }
        self.heavy.iter().any(|&index| {
            let constrained = &self.constraints[index];
            constrained.node == root || self.root_nodes(constrained.node).contains(&root)
        })
    }

    /// The nodes of free or given motion that a node follows rigidly.
    pub(super) fn root_nodes(&self, node: usize) -> Vec<usize> {
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
