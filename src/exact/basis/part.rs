//! The connected parts that open pairs cut the tree into.

use super::{Lane, NoBasis, Rigid, ZERO};
use crate::exact::cluster;
use crate::exact::pencil::{C, Node, Pencil};
use crate::exact::problem::{PairState, TreeProblem};

/// A connected part: its pencil and which masses it holds.
pub(super) struct Part {
    pencil: Pencil,
    members: Vec<usize>,
}

/// Cuts the tree at open pairs.
pub(super) fn cut_at_open_pairs(problem: &TreeProblem, states: &[PairState]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let mut place: Vec<(usize, usize)> = Vec::new();
    for (i, mass) in problem.masses.iter().enumerate() {
        let engaged = mass.pair.flanks().1 == 0 || states[i].engaged();
        if engaged && mass.restitution.is_some() {
            // It is held, and has no motion of its own.
            place.push((usize::MAX, 0));
            continue;
        }
        let host = mass.parent.filter(|_| engaged).map(|p| place[p]);
        let on = if engaged { 1.0 } else { 0.0 };
        let node = Node {
            inertia: mass.inertia,
            parent: host.map(|(_, local)| local),
            lever: mass.lever,
            stiffness: mass.stiffness * on,
            damping: mass.damping * on,
            ground_stiffness: mass.ground_stiffness,
            ground_damping: mass.ground_damping,
        };
        match host {
            Some((part, _)) => {
                place.push((part, parts[part].members.len()));
                parts[part].members.push(i);
                parts[part].pencil.nodes.push(node);
            }
            None => {
                place.push((parts.len(), 0));
                parts.push(Part {
                    pencil: Pencil { nodes: vec![node] },
                    members: vec![i],
                });
            }
        }
    }
    parts
}

impl Part {
    fn distribute(&self, n: usize, local: impl Fn(usize) -> C) -> Vec<C> {
        let mut out = vec![ZERO; n];
        for (k, &i) in self.members.iter().enumerate() {
            out[i] = local(k);
        }
        out
    }

    pub(super) fn modes(&self, n: usize, lanes: &mut Vec<Lane>) -> Result<(), NoBasis> {
        let pencil = &self.pencil;
        if pencil.nodes.len() == 1 && pencil.floats() && !pencil.has_damped_rigid_motion() {
            return Ok(());
        }
        let mut values = pencil
            .eigenvalues()
            .map_err(|_| NoBasis("the natural frequencies could not be separated".into()))?;
        if pencil.floats() && pencil.has_damped_rigid_motion() {
            values.insert(0, ZERO);
        }
        let own = cluster::lanes(pencil, &values).map_err(NoBasis)?;
        if self.members.len() == n {
            // It is all of the tree, in the same order.
            lanes.extend(own);
            return Ok(());
        }
        for lane in own {
            let spread = |local: &[C]| self.distribute(n, |k| local[k]);
            lanes.push(Lane {
                row_q: spread(&lane.row_q),
                row_v: spread(&lane.row_v),
                row_f: spread(&lane.row_f),
                shape: spread(&lane.shape),
                ..lane
            });
        }
        Ok(())
    }

    pub(super) fn rigid(&self, n: usize) -> Option<Rigid> {
        if !self.pencil.floats() || self.pencil.has_damped_rigid_motion() {
            return None;
        }
        let local = self.pencil.rigid_shape();
        let total: f64 = self
            .pencil
            .nodes
            .iter()
            .zip(&local)
            .map(|(node, x)| node.inertia * x * x)
            .sum();
        let mut out = Rigid {
            shape: vec![0.0; n],
            row: vec![0.0; n],
            row_f: vec![0.0; n],
            push: Vec::new(),
        };
        for (k, &i) in self.members.iter().enumerate() {
            out.shape[i] = local[k];
            out.row[i] = local[k] * self.pencil.nodes[k].inertia / total;
            out.row_f[i] = local[k] / total;
        }
        Some(out)
    }
}
