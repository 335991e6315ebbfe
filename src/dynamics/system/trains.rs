//! Rotors with rigid objects of constant ratio on them, nothing elastic anywhere:
//! the equations of motion without the passes.
//!
//! A gear train is one inertia and one constant force on its rotor; of the rest
//! only the loads and linkages on it remain, whose nodes go ratio·φ + offset.

use super::frozen::{Frozen, Step};
use super::passes::{Extent, Work};
use super::written::FrozenExpression;
use crate::math::quantity::Quantity;

/// A rotor and what it carries.
#[derive(Clone, Debug, Default)]
pub(super) struct Train {
    /// Index of the rotor's coordinate.
    coordinate: usize,
    /// Constant inertia of all its nodes, reduced to the rotor.
    inertia: f64,
    /// Constant loads of all its nodes, likewise.
    force: f64,
    /// The nodes that something looks at.
    nodes: Vec<Member>,
    /// Index of each linkage, and the ratio of its node.
    linkages: Vec<(usize, f64)>,
    /// Index of each load that is not constant, and the ratio of its node.
    loads: Vec<(usize, f64)>,
}

/// A node of a train: φ = `ratio`·φ_rotor + `offset`.
#[derive(Clone, Copy, Debug)]
struct Member {
    node: usize,
    offset: f64,
    ratio: f64,
}

/// The trains of a system that consists of nothing else; none of any other.
pub(super) fn trains(frozen: &Frozen) -> Vec<Train> {
    of_trains(frozen).unwrap_or_default()
}

fn of_trains(frozen: &Frozen) -> Option<Vec<Train>> {
    // Friction of joints and at rest is found between forces and accelerations.
    let rubs = !(frozen.groups.is_empty() && frozen.dry.is_empty());
    if rubs || !frozen.chains.is_empty() {
        return None;
    }
    let mut trains: Vec<Train> = Vec::new();
    // Train, ratio and offset of every node.
    let mut places: Vec<Option<(usize, f64, f64)>> = vec![None; frozen.inertia.len()];
    for step in &frozen.coupled {
        let (node, place) = match step {
            Step::Rotor(rotor) => {
                trains.push(Train {
                    coordinate: rotor.coordinate,
                    ..Train::default()
                });
                (rotor.node, (trains.len() - 1, 1.0, 0.0))
            }
            Step::Rigid(index) => {
                let rigid = frozen.rigids[*index];
                let law = &frozen.laws[rigid.law];
                let (train, ratio, offset) = places[law.driver]?;
                let [own, shift] = law.position.constant_ratio()?;
                if law.output.is_some() {
                    return None;
                }
                let (own, shift) = (law.lever * own, law.lever * shift);
                (rigid.node, (train, own * ratio, own * offset + shift))
            }
            Step::Prescribed(_) | Step::Chain(_) | Step::Constrained(_) => return None,
        };
        places[node] = Some(place);
        let train = &mut trains[place.0];
        train.inertia += place.1 * place.1 * frozen.inertia[node];
        train.force += place.1 * frozen.constant_force[node];
    }
    let mut looked_at = Vec::new();
    for (index, linkage) in frozen.linkages.iter().enumerate() {
        let (train, ratio, _) = places[linkage.node]?;
        trains[train].linkages.push((index, ratio));
        looked_at.push(linkage.node);
    }
    for (index, load) in frozen.loads.iter().enumerate() {
        let (train, ratio, _) = places[load.node]?;
        trains[train].loads.push((index, ratio));
        looked_at.push(load.node);
        looked_at.extend(load.argument.as_ref().and_then(|axis| axis.node));
        looked_at.extend(load.written.iter().flat_map(FrozenExpression::nodes));
    }
    looked_at.sort_unstable();
    looked_at.dedup();
    for node in looked_at {
        let (train, ratio, offset) = places[node]?;
        trains[train].nodes.push(Member {
            node,
            offset,
            ratio,
        });
    }
    Some(trains)
}

impl Frozen {
    /// The accelerations of all trains. (Whole within the right-hand side: calls would be an
    /// eighth of its time.)
    #[inline(always)]
    pub(super) fn evaluate_trains<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        let (u, v) = state.split_at(self.coordinates);
        for train in &self.trains {
            let (phi, rate) = (u[train.coordinate], v[train.coordinate]);
            for member in &train.nodes {
                let place = phi.scale(member.ratio) + N::from(member.offset);
                work.displacement[member.node] = place;
                work.speed[member.node] = rate.scale(member.ratio);
            }
        }
        for train in &self.trains {
            let mut inertia = N::from(train.inertia);
            let mut force = N::from(train.force);
            for &(index, ratio) in &train.linkages {
                let [own, forces] = self.inertia_and_force(index, Extent::Needed, work);
                inertia += own.scale(ratio * ratio);
                force += forces.scale(ratio);
            }
            for &(index, ratio) in &train.loads {
                force += self.load(index, time, modes, work).scale(ratio);
            }
            out[train.coordinate] = force / inertia;
        }
    }
}
