//! The graph of a mechanism: objects, joined by their ports.
//!
//! Objects are nodes (of petgraph), and connections are edges from an output port to an input
//! port: φ and φ̇ go along an edge, the reaction goes back. The order, circles, inputs that
//! lead nowhere, and what drives what in the model follow from it.

use crate::dynamics::model::Coordinate;
use crate::frontend::object::{Object, object_of};
use petgraph::Direction::{Incoming, Outgoing};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, EdgeIndex, NodeIndex};
use petgraph::visit::EdgeRef;
use std::collections::{BTreeMap, BTreeSet};

/// Objects as nodes, in the order of their ids; connections as edges from the driver
/// to the driven. An object may drive several others, or one of them twice.
#[derive(Clone, Debug, Default)]
pub struct MechanismGraph<'a> {
    graph: DiGraph<Vertex<'a>, Edge<'a>>,
    by_id: BTreeMap<&'a str, NodeIndex>,
    dangling: Vec<DanglingInput<'a>>,
}

/// An object in the graph.
#[derive(Clone, Copy, Debug)]
pub struct Vertex<'a> {
    /// Id of the object.
    pub id: &'a str,
    /// The object; `None`: one that could not be read.
    pub object: Option<&'a dyn Object>,
}

/// A connection: displacement and speed go along it, the reaction goes back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge<'a> {
    /// Address of the output that is connected to, as a scene names it: `press`,
    /// `press.ram`.
    pub output: &'a str,
    /// Name of the input port of the driven object.
    pub input: &'a str,
    /// Whether the output turns or slides; `None`: not known.
    pub coordinate: Option<Coordinate>,
}

/// An input that names no object, or an output that an object has not.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DanglingInput<'a> {
    /// Id of the object whose input it is.
    pub id: &'a str,
    /// Name of the input port.
    pub input: &'a str,
    /// Address of the output that the input names.
    pub output: &'a str,
}

/// An object for the graph: its id, itself, and for each of its connections the input
/// port and the output that it hangs on.
pub type Entry<'a> = (&'a str, Option<&'a dyn Object>, Vec<(&'a str, &'a str)>);

impl<'a> MechanismGraph<'a> {
    /// From objects and their connections; those that lead nowhere are kept apart.
    pub fn new(objects: impl IntoIterator<Item = Entry<'a>>) -> Self {
        let entries: BTreeMap<&str, _> = objects
            .into_iter()
            .map(|(id, object, inputs)| (id, (object, inputs)))
            .collect();
        let mut this = Self::default();
        for (id, (object, _)) in &entries {
            let vertex = Vertex {
                id,
                object: *object,
            };
            this.by_id.insert(id, this.graph.add_node(vertex));
        }
        for (id, (_, inputs)) in &entries {
            for (input, output) in inputs {
                this.connect(id, input, output);
            }
        }
        this
    }

    fn connect(&mut self, id: &'a str, input: &'a str, output: &'a str) {
        let driver = self.by_id.get(object_of(output)).copied();
        let coordinate = driver.map(|driver| self.output_of(driver, output));
        match (driver, coordinate) {
            (Some(driver), Some(Some(coordinate))) => {
                let joint = Edge {
                    output,
                    input,
                    coordinate,
                };
                self.graph.add_edge(driver, self.by_id[id], joint);
            }
            _ => self.dangling.push(DanglingInput { id, input, output }),
        }
    }

    /// Whether an output of an object turns or slides, as far as that is known;
    /// `None`: it has no such output.
    fn output_of(&self, driver: NodeIndex, output: &str) -> Option<Option<Coordinate>> {
        let name = output
            .split_once('.')
            .map_or(crate::frontend::object::OWN, |parts| parts.1);
        let Some(object) = self.graph[driver].object else {
            return Some(None);
        };
        let ports = object.ports().outputs;
        let port = match name {
            crate::frontend::object::OWN => ports.into_iter().next(),
            _ => ports.into_iter().skip(1).find(|port| port.name == name),
        };
        port.map(|port| port.coordinate)
    }

    /// The objects, in the order of their ids.
    pub fn objects(&self) -> impl Iterator<Item = &Vertex<'a>> {
        self.graph.node_weights()
    }

    /// The connections of an object's inputs, in their order, each with the driver's
    /// id.
    pub fn inputs(&self, id: &str) -> Vec<(&'a str, &Edge<'a>)> {
        let Some(&node) = self.by_id.get(id) else {
            return Vec::new();
        };
        let edges = self.graph.edges_directed(node, Incoming);
        let mut edges: Vec<EdgeIndex> = edges.map(|edge| edge.id()).collect();
        edges.sort();
        let ends = edges.into_iter().filter_map(|edge| {
            let (driver, _) = self.graph.edge_endpoints(edge)?;
            Some((self.graph[driver].id, &self.graph[edge]))
        });
        ends.collect()
    }

    /// Inputs that lead nowhere, in the order of the objects' ids.
    pub fn dangling(&self) -> &[DanglingInput<'a>] {
        &self.dangling
    }

    /// All ids, every driver before what it drives, otherwise in the order of the ids.
    ///
    /// # Errors
    /// The ids of objects in and behind cycles.
    pub fn order(&self) -> Result<Vec<&'a str>, Vec<&'a str>> {
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
            order.push(self.graph[node].id);
            for driven in self.graph.neighbors_directed(node, Outgoing) {
                waiting[driven.index()] -= 1;
                if waiting[driven.index()] == 0 {
                    ready.insert(driven);
                }
            }
        }
        if order.len() == self.graph.node_count() {
            return Ok(order);
        }
        let left = self.graph.node_indices();
        let left = left.filter(|node| waiting[node.index()] > 0);
        Err(left.map(|node| self.graph[node].id).collect())
    }

    /// Every cycle, as ids along the motion, beginning with the least id.
    pub fn cycles(&self) -> Vec<Vec<&'a str>> {
        let mut cycles: Vec<Vec<&str>> = tarjan_scc(&self.graph)
            .into_iter()
            .filter_map(|group| self.cycle_within(&group))
            .collect();
        cycles.sort();
        cycles
    }

    /// A cycle within a strongly connected group of nodes.
    fn cycle_within(&self, group: &[NodeIndex]) -> Option<Vec<&'a str>> {
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
                .map(|node| self.graph[*node].id)
                .collect(),
        )
    }

    /// Ids of the objects that an object drives, in order.
    pub fn driven_by(&self, id: &str) -> Vec<&'a str> {
        let Some(node) = self.by_id.get(id) else {
            return Vec::new();
        };
        let driven: BTreeSet<NodeIndex> = self.graph.neighbors_directed(*node, Outgoing).collect();
        driven.into_iter().map(|node| self.graph[node].id).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{DanglingInput, Entry, MechanismGraph};

    fn entry(id: &'static str, drivers: &[&'static str]) -> Entry<'static> {
        let ports = ["input", "other"];
        let inputs = ports.iter().zip(drivers);
        (
            id,
            None,
            inputs.map(|(port, driver)| (*port, *driver)).collect(),
        )
    }

    #[test]
    fn drivers_come_before_driven() {
        let graph = MechanismGraph::new([
            entry("a", &["z"]),
            entry("z", &[]),
            entry("b", &["z"]),
            entry("c", &["a"]),
        ]);
        assert_eq!(graph.order(), Ok(vec!["z", "a", "b", "c"]));
        assert_eq!(graph.driven_by("z"), ["a", "b"]);
        assert!(graph.cycles().is_empty());
    }

    #[test]
    fn an_object_with_two_inputs_comes_after_both_drivers() {
        let graph = MechanismGraph::new([
            entry("a", &["z", "y"]),
            entry("b", &["y", "y"]),
            entry("y", &[]),
            entry("z", &["nobody"]),
        ]);
        assert_eq!(graph.order(), Ok(vec!["y", "b", "z", "a"]));
        let inputs = graph.inputs("a");
        let named: Vec<_> = inputs
            .iter()
            .map(|(id, joint)| (*id, joint.input))
            .collect();
        assert_eq!(named, [("z", "input"), ("y", "other")]);
        assert_eq!(graph.inputs("b").len(), 2);
        assert_eq!(
            graph.dangling(),
            [DanglingInput {
                id: "z",
                input: "input",
                output: "nobody"
            }]
        );
    }

    #[test]
    fn cycles_are_named_along_the_motion() {
        let graph = MechanismGraph::new([
            entry("a", &["c"]),
            entry("b", &["a"]),
            entry("c", &["b"]),
            entry("d", &["c"]),
            entry("e", &["e"]),
        ]);
        assert_eq!(graph.order(), Err(vec!["a", "b", "c", "d", "e"]));
        assert_eq!(graph.cycles(), [vec!["a", "b", "c"], vec!["e"]]);
    }
}
