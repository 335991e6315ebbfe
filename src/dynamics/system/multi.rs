//! Rigid linkages of several inputs, and the mass matrix that couples what moves them.
//!
//! A linkage of several inputs is solved once an evaluation, where its own node, which
//! comes before its outputs, has its turn. On its inputs it has the mass matrix M(q) and the
//! forces Q(q, q̇). With the inertia forces of such linkages and of constrained nodes left out,
//! all accelerations follow as always; a free coordinate without inertia of its own, a *bare*
//! one, has none. The inertia forces then give as many linear equations as there are free
//! coordinates that they act on (the *roots*): (D + TᵀMT)·Δ = F − TᵀM·a⁰. It has the inertia D of the
//! roots themselves, the motion T of the inputs over that of the roots, their accelerations
//! a⁰ so far, the forces F on bare roots, and the accelerations Δ that are missing. It is
//! solved as L·D·Lᵀ. Scenes without such linkages do nothing of it.
//!
//! Each input has a node: a rigid one behind an object, or a rotor without inertia if the input
//! is free. The outputs are constrained nodes. The linkage's own node is the first input once
//! more. The margin of each of its groups from a singular position is a signal
//! (`MultiValue::Distance`); its zero ends a run as a dead-centre position does.

mod couple;
mod direct;

use super::constraints::{ConstrainedNode, ConstraintValues};
use super::frozen::{Frozen, FrozenTrack, Step};
use super::passes::Work;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiWorkspace};
use crate::kinematics::linkage::spec::OutputKind;
use crate::math::number::Dual;
use crate::math::quantity::Quantity;
use std::sync::Arc;

pub(super) use couple::Dense;
pub(super) use direct::{Direct, direct};

/// A linkage of several inputs of the frozen layout.
#[derive(Clone, Debug)]
pub(super) struct FrozenMulti {
    /// Internal indices of the input nodes.
    pub(super) nodes: Vec<usize>,
    /// The linkage.
    pub(super) linkage: Arc<MultiLinkage>,
    /// Index of the object.
    pub(super) object: usize,
    /// True where angles of its pairs are asked for, over whole turns.
    pub(super) turning: bool,
}

impl FrozenMulti {
    fn space<N: Quantity>(&self) -> MultiWorkspace<N> {
        let mut space = self.linkage.workspace();
        if self.turning {
            space.follow_angles();
        }
        space
    }
}

/// What a constrained node is of a linkage of several inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MultiPlace {
    /// Index into [`Frozen::multi`].
    pub(super) linkage: usize,
    /// What of it.
    pub(super) value: MultiValue,
}

/// What a node is of a linkage of several inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MultiValue {
    /// The first input itself; the linkage is solved when it is asked for.
    Input,
    /// An output.
    Output(usize),
    /// How far a group is from a singular position; known only where signals are.
    Distance(usize),
    /// The coordinate of a pair; known only where signals are.
    Pair(usize),
}

/// A free coordinate that inertia forces of linkages of several inputs, or of constrained
/// nodes beside them, act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Root {
    /// Internal index of the node.
    pub(super) node: usize,
    /// Index of the coordinate.
    pub(super) coordinate: usize,
    /// True for a rotor, whose acceleration is found with the others; a mass of a chain has
    /// one of its own.
    pub(super) rotor: bool,
}

/// Working memory of a linkage of several inputs.
#[derive(Clone, Debug)]
pub(super) struct MultiWork<N> {
    pub(super) space: MultiWorkspace<N>,
    inputs: Vec<N>,
    rates: Vec<N>,
    /// Whether it could be assembled at the inputs asked for last.
    pub(super) assembled: bool,
}

impl<N: Quantity> MultiWork<N> {
    pub(super) fn new(multi: &FrozenMulti) -> Self {
        let zero = vec![N::from(0.0); multi.nodes.len()];
        Self {
            space: multi.space(),
            inputs: zero.clone(),
            rates: zero,
            assembled: false,
        }
    }

    /// Solves it at the displacements and speeds of its nodes.
    pub(super) fn solve(&mut self, multi: &FrozenMulti, displacement: &[N], speed: &[N]) {
        for (index, &node) in multi.nodes.iter().enumerate() {
            self.inputs[index] = displacement[node];
            self.rates[index] = speed[node];
        }
        let finite = self.inputs.iter().all(|q| q.value().is_finite());
        self.assembled = finite && self.space.solve(&self.inputs, &self.rates).is_ok();
    }

    /// Coordinate, rate and bias of a pair; its gradient into `first`.
    fn pair(&self, pair: usize, first: &mut [N]) -> [N; 3] {
        let [value, bias] = self.space.output(&OutputKind::Pair { pair }, first);
        [value, self.rate(first), bias]
    }

    /// Rate of what has a gradient.
    fn rate(&self, first: &[N]) -> N {
        let mut rate = N::from(0.0);
        for (&first, &own) in first.iter().zip(&self.rates) {
            rate += first * own;
        }
        rate
    }

    /// Value, rate and bias of an output; its gradient into `first`.
    pub(super) fn output(&self, multi: &FrozenMulti, output: usize, first: &mut [N]) -> [N; 3] {
        if !self.assembled {
            first.fill(N::from(f64::NAN));
            return [N::from(f64::NAN); 3];
        }
        let kind = &multi.linkage.outputs()[output].kind;
        let [value, bias] = self.space.output(kind, first);
        [value, self.rate(first), bias]
    }
}

/// A linkage of several inputs in small motions about a position at rest (m × m each).
pub(super) struct SmallMotion {
    /// Mass matrix.
    pub(super) mass: Vec<f64>,
    /// −∂Q/∂q, its symmetric part: the other belongs to forces that turn with their link.
    pub(super) stiffness: Vec<f64>,
}

impl Frozen {
    /// A linkage of several inputs where its nodes stand in `work`, at rest.
    pub(super) fn small_motion(&self, index: usize, work: &Work<f64>) -> SmallMotion {
        let multi = &self.multi[index];
        let count = multi.nodes.len();
        let mut space = multi.linkage.workspace::<Dual>();
        let (mut mass, mut stiffness) = (vec![f64::NAN; count * count], vec![0.0; count * count]);
        let still = vec![Dual::from(0.0); count];
        for along in 0..count {
            let place = |(index, &node): (usize, &usize)| {
                Dual::new(work.displacement[node], f64::from(u8::from(index == along)))
            };
            let inputs: Vec<Dual> = multi.nodes.iter().enumerate().map(place).collect();
            if space.solve(&inputs, &still).is_err() {
                stiffness.fill(f64::NAN);
                break;
            }
            space.reduce(false);
            for (own, found) in mass.iter_mut().zip(&space.reduced.mass) {
                *own = found.value;
            }
            for (index, force) in space.reduced.force.iter().enumerate() {
                stiffness[index * count + along] -= 0.5 * force.derivative;
                stiffness[along * count + index] -= 0.5 * force.derivative;
            }
        }
        SmallMotion { mass, stiffness }
    }

    /// Displacement and speed of a node that a linkage of several inputs moves; what is
    /// solved for is kept.
    pub(super) fn follow_multi<N: Quantity>(
        &self,
        place: MultiPlace,
        index: usize,
        work: &mut Work<N>,
    ) {
        let multi = &self.multi[place.linkage];
        let ConstraintValues { first, bias, .. } = &mut work.constraints[index];
        let node = self.constraints[index].node;
        let own = &mut work.multi[place.linkage];
        let [value, rate, bent] = match place.value {
            MultiValue::Output(output) => own.output(multi, output, first),
            // (Nothing in the equations looks at it.)
            MultiValue::Distance(_) | MultiValue::Pair(_) => return,
            MultiValue::Input => {
                own.solve(multi, &work.displacement, &work.speed);
                first.fill(N::from(0.0));
                first[0] = N::from(1.0);
                let input = multi.nodes[0];
                [work.displacement[input], work.speed[input], N::from(0.0)]
            }
        };
        *bias = bent;
        work.displacement[node] = value;
        work.speed[node] = rate;
    }

    /// Adds what linkages of several inputs do on their inputs, but for the inertia forces
    /// of these inputs' accelerations; those of dampers only where they are asked for.
    pub(super) fn apply_multi<N: Quantity>(&self, dampers: bool, work: &mut Work<N>) {
        for (multi, own) in self.multi.iter().zip(&mut work.multi) {
            if own.assembled {
                own.space.reduce(dampers);
            }
            for (index, &node) in multi.nodes.iter().enumerate() {
                work.force[node] += match own.assembled {
                    true => own.space.reduced.force[index],
                    false => N::from(f64::NAN),
                };
            }
        }
    }

    /// Solves all linkages of several inputs anew as if they stood still.
    pub(super) fn solve_at_rest<N: Quantity>(&self, work: &mut Work<N>) {
        for (multi, own) in self.multi.iter().zip(&mut work.multi) {
            for (index, &node) in multi.nodes.iter().enumerate() {
                own.inputs[index] = work.displacement[node];
                own.rates[index] = N::from(0.0);
            }
            own.assembled = own.space.solve(&own.inputs, &own.rates).is_ok();
        }
    }

    /// Adds a node that nothing in the equations looks at, and the signal that is its
    /// displacement.
    pub(super) fn add_signal_of(&mut self, place: MultiPlace) -> usize {
        self.add_distance(place);
        self.signal(self.inertia.len() - 1)
    }

    /// Adds a node that nothing in the equations looks at: a distance from a singular position,
    /// or the coordinate of a pair.
    pub(super) fn add_distance(&mut self, place: MultiPlace) {
        let node = self.inertia.len();
        self.inertia.push(0.0);
        self.constant_force.push(0.0);
        self.coordinate.push(None);
        let drivers = self.multi[place.linkage].nodes.clone();
        let constraint = Constraint::Linear {
            ratios: vec![0.0; drivers.len()],
            offset: 0.0,
        };
        self.steps.push(Step::Constrained(self.constraints.len()));
        self.constraints.push(ConstrainedNode {
            node,
            drivers,
            constraint,
            heavy: false,
            multi: Some(place),
        });
    }

    /// The tracks of the distances from singular positions, which end a run.
    pub(super) fn place_distances(&mut self) {
        let of = |one: &ConstrainedNode| match one.multi?.value {
            MultiValue::Distance(_) => Some((one.node, one.multi?.linkage)),
            _ => None,
        };
        let found: Vec<(usize, usize)> = self.constraints.iter().filter_map(of).collect();
        for (node, linkage) in found {
            let signal = self.signal(node);
            self.tracks.push(FrozenTrack {
                node: Some(node),
                signal: Some(signal),
                breaks: Breaks {
                    points: vec![0.0],
                    period: None,
                },
                repeats: false,
                stops: true,
                object: self.multi[linkage].object,
            });
        }
    }

    /// The linkage and the group whose distance from a singular position a node is.
    pub(super) fn distance_of(&self, node: usize) -> Option<(usize, usize)> {
        let own = self.constraints.iter().find(|one| one.node == node)?;
        match own.multi?.value {
            MultiValue::Distance(group) => Some((own.multi?.linkage, group + 1)),
            _ => None,
        }
    }

    /// Displacement, speed and gradient of the nodes that are distances from singular
    /// positions or coordinates of pairs, the linkages solved.
    pub(super) fn find_distances(&self, work: &mut Work<f64>) {
        for (one, values) in self.constraints.iter().zip(&mut work.constraints) {
            let Some(place) = one.multi else { continue };
            let own = &mut work.multi[place.linkage];
            let [value, rate, bend] = match place.value {
                MultiValue::Distance(_) | MultiValue::Pair(_) if !own.assembled => [f64::NAN; 3],
                MultiValue::Distance(group) => {
                    own.space.distance_from_singular(group, &mut values.first)
                }
                MultiValue::Pair(pair) => own.pair(pair, &mut values.first),
                MultiValue::Input | MultiValue::Output(_) => continue,
            };
            values.bias = bend;
            work.displacement[one.node] = value;
            work.speed[one.node] = rate;
        }
    }

    /// A length that a free input moves by, where that is one: the size of its linkage (m).
    pub(super) fn input_length(&self, node: usize) -> Option<f64> {
        self.multi.iter().find_map(|multi| {
            let place = multi.nodes.iter().position(|&own| own == node)?;
            let linkage = &multi.linkage;
            let slides = linkage.inputs()[place]
                .coordinate
                .slides(&linkage.spec().linkage);
            slides.then(|| linkage.typical_length())
        })
    }

    /// φ, φ̇ and φ̈ of a node that a linkage of several inputs moves, from those of all nodes
    /// before it; its gradient is left in `values`.
    pub(super) fn sample_multi(
        &self,
        place: MultiPlace,
        values: &mut ConstraintValues<f64>,
        works: &mut [MultiWork<f64>],
        motion: &[[f64; 3]],
    ) -> [f64; 3] {
        let (multi, own) = (&self.multi[place.linkage], &mut works[place.linkage]);
        let output = match place.value {
            MultiValue::Output(output) => output,
            MultiValue::Distance(_) | MultiValue::Pair(_) => return [f64::NAN; 3],
            MultiValue::Input => usize::MAX,
        };
        if place.value == MultiValue::Input {
            for (index, &node) in multi.nodes.iter().enumerate() {
                (own.inputs[index], own.rates[index]) = (motion[node][0], motion[node][1]);
            }
            let finite = own.inputs.iter().all(|q| q.is_finite());
            own.assembled = finite && own.space.solve(&own.inputs, &own.rates).is_ok();
            values.first.fill(0.0);
            values.first[0] = 1.0;
            return motion[multi.nodes[0]];
        }
        let [value, rate, bias] = own.output(multi, output, &mut values.first);
        let accelerations = multi.nodes.iter().zip(&values.first);
        let sum = accelerations.map(|(&node, first)| first * motion[node][2]);
        [value, rate, bias + sum.sum::<f64>()]
    }

    /// The linkage of several inputs that could not be assembled at the last evaluation: it,
    /// and the group.
    pub(super) fn unassembled(&self, work: &Work<f64>) -> Option<(usize, usize)> {
        let mut all = self.multi.iter().zip(&work.multi);
        let (multi, own) = all.find(|(_, own)| !own.assembled)?;
        let (group, _) = own.space.margin()?;
        Some((multi.object, group))
    }
}
