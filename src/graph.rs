//! The object graph: who drives whom.

use petgraph::Direction::{Incoming, Outgoing};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use std::collections::{BTreeMap, BTreeSet};

/// Objects as nodes, in the order of their ids; `input` as edges from the
/// driver to the driven. An object may drive several others.
#[derive(Clone, Debug, Default)]
pub struct MechanismGraph {
    graph: DiGraph<String, ()>,
    by_id: BTreeMap<String, NodeIndex>,
}

impl MechanismGraph {
    /// From the objects' ids, each with the id of its driver. Inputs that name
    /// no object are left out.
    pub fn new<'a>(objects: impl IntoIterator<Item = (&'a str, Option<&'a str>)>) -> Self {
        let inputs: BTreeMap<&str, Option<&str>> = objects.into_iter().collect();
        let mut this = Self::default();
        for id in inputs.keys() {
            let node = this.graph.add_node((*id).to_owned());
            this.by_id.insert((*id).to_owned(), node);
        }
        for (id, input) in &inputs {
            if let Some(driver) = input.and_then(|input| this.by_id.get(input)) {
                this.graph.add_edge(*driver, this.by_id[*id], ());
            }
        }
        this
    }

    /// All ids, every driver before what it drives, otherwise in the order of
    /// the ids; `None` when there is a cycle.
    pub fn order(&self) -> Option<Vec<&str>> {
        let mut waiting: Vec<usize> = self
            .graph
            .node_indices()
            .map(|node| self.graph.neighbors_directed(node, Incoming).count())
            .collect();
        let mut ready: BTreeSet<NodeIndex> = self
            .graph
            .node_indices()
            .filter(|node| waiting[node.index()] == 0)
            .collect();
        let mut order = Vec::with_capacity(waiting.len());
        while let Some(node) = ready.pop_first() {
            order.push(self.graph[node].as_str());
            for driven in self.graph.neighbors_directed(node, Outgoing) {
                waiting[driven.index()] -= 1;
                if waiting[driven.index()] == 0 {
                    ready.insert(driven);
                }
            }
        }
        (order.len() == self.graph.node_count()).then_some(order)
    }

    /// Every cycle, as ids along the motion, beginning with the least id.
    pub fn cycles(&self) -> Vec<Vec<&str>> {
        let mut cycles: Vec<Vec<&str>> = tarjan_scc(&self.graph)
            .into_iter()
            .filter_map(|group| self.cycle_within(&group))
            .collect();
        cycles.sort();
        cycles
    }

    /// A cycle within a strongly connected group of nodes.
    fn cycle_within(&self, group: &[NodeIndex]) -> Option<Vec<&str>> {
        let start = *group.iter().min()?;
        let next = |node| {
            let inside = |other: &NodeIndex| group.contains(other);
            self.graph
                .neighbors_directed(node, Outgoing)
                .filter(inside)
                .min()
        };
        let mut path = vec![start];
        let closing = loop {
            let node = next(*path.last()?)?;
            if let Some(at) = path.iter().position(|seen| *seen == node) {
                break at;
            }
            path.push(node);
        };
        Some(
            path[closing..]
                .iter()
                .map(|node| self.graph[*node].as_str())
                .collect(),
        )
    }

    /// Ids of the objects that an object drives, in order.
    pub fn driven_by(&self, id: &str) -> Vec<&str> {
        let Some(node) = self.by_id.get(id) else {
            return Vec::new();
        };
        let driven: BTreeSet<NodeIndex> = self.graph.neighbors_directed(*node, Outgoing).collect();
        driven
            .into_iter()
            .map(|node| self.graph[node].as_str())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::MechanismGraph;

    #[test]
    fn drivers_come_before_driven() {
        let graph = MechanismGraph::new([
            ("a", Some("z")),
            ("z", None),
            ("b", Some("z")),
            ("c", Some("a")),
        ]);
        assert_eq!(graph.order(), Some(vec!["z", "a", "b", "c"]));
        assert_eq!(graph.driven_by("z"), ["a", "b"]);
        assert!(graph.cycles().is_empty());
    }

    #[test]
    fn cycles_are_named_along_the_motion() {
        let graph = MechanismGraph::new([
            ("a", Some("c")),
            ("b", Some("a")),
            ("c", Some("b")),
            ("d", Some("c")),
            ("e", Some("e")),
        ]);
        assert_eq!(graph.order(), None);
        assert_eq!(graph.cycles(), [vec!["a", "b", "c"], vec!["e"]]);
    }
}
