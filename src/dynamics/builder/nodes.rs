//! The single steps: nodes, laws, links, outputs.

use super::assembly_range::DEAD;
use super::{ChainParameters, InputConnection, ModelBuilder, NodeEntry, Place};
use crate::dynamics::model::{
    Coordinate, DRIVEN_END, Law, Link, LinkBase, Load, LoadLaw, Node, NodeIndex, NodeMotion,
    ObjectPart, Pair, TrackSource,
};
use crate::dynamics::trajectory::instant;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;

impl ModelBuilder {
    /// A node whose motion is given over time.
    pub fn add_prescribed_node(&mut self, at: &Place, motion: DriveMotion) -> NodeIndex {
        let track = self.track(
            TrackSource::Time,
            (motion.breaks(), motion.repeats()),
            at.object,
        );
        let start = instant(&motion, 0.0).value;
        let node = Node {
            inertia: 0.0,
            motion: NodeMotion::Prescribed { motion, track },
        };
        self.add_node(at.object, node, start)
    }

    /// A rotor: its displacement is a coordinate. Inertia (kg·m² or kg), displacement
    /// and speed at t = 0.
    pub fn rotor(&mut self, at: &Place, inertia: f64, angle: f64, speed: f64) -> NodeIndex {
        let node = Node {
            inertia,
            motion: NodeMotion::Rotor { angle, speed },
        };
        self.add_node(at.object, node, angle)
    }

    /// The law lever·U over the displacement of what an input hangs on, with the
    /// track of its break points. `property`: where the position function stands.
    ///
    /// The position function must exist where the driver starts; where its reach
    /// ends, the run stops, and a warning says when the drive's motion leads there.
    /// `None`: it cannot be assembled, which is noted as a fault.
    pub fn law(
        &mut self,
        at: &Place,
        property: &str,
        driver: &InputConnection,
        position: Position,
        lever: f64,
    ) -> Option<Law> {
        let source = TrackSource::Node(driver.node);
        let breaks = position.breaks();
        let repeats = breaks.period.is_some();
        let track = self.track(source, (breaks, repeats), at.object);
        match position.reach_from(self.start_of(driver.node)) {
            Ok(None) => {}
            Ok(Some(reach)) => self.limit_driver(at, driver.node, reach, DEAD),
            Err(outside) => {
                self.refuse_start(at, property, driver.node, &outside);
                return None;
            }
        }
        Some(Law {
            driver: driver.node,
            position,
            lever,
            track,
        })
    }

    /// The node on which several inputs are combined: φ = G(φ₁, …, φₖ), the drivers in
    /// the order of the connections. What hangs on it loads driver i with F·∂G/∂φᵢ.
    /// It belongs to the object, whose law follows it ([`InputConnection::node`]).
    pub fn combine(
        &mut self,
        at: &Place,
        inputs: &[&InputConnection],
        constraint: Constraint,
    ) -> InputConnection {
        let drivers: Vec<NodeIndex> = inputs.iter().map(|input| input.node).collect();
        let start = self.combined(&drivers, &constraint);
        let motion = NodeMotion::Constrained {
            drivers,
            constraint,
        };
        self.model.nodes.push(Node {
            inertia: 0.0,
            motion,
        });
        let node = self.model.nodes.len() - 1;
        let object = &mut self.model.objects[at.object];
        object.combination = Some(node);
        let coordinate = object.coordinate;
        self.known.push(NodeEntry {
            part: at.object,
            start,
        });
        InputConnection {
            port: String::new(),
            output: at.id.clone(),
            coordinate,
            node,
        }
    }

    /// A node that follows a law exactly, with an inertia (kg·m² or kg) of its own;
    /// the object's pair says whether the driver can pull as well as push.
    pub fn rigid(&mut self, at: &Place, law: Law, inertia: f64, pair: Pair) -> NodeIndex {
        self.add_rigid(at.object, law, inertia, pair)
    }

    /// A chain of masses behind a law: link 1 with the pair, then mass 1, and so on.
    pub fn masses(
        &mut self,
        at: &Place,
        law: &Law,
        parameters: &ChainParameters,
        pair: Pair,
    ) -> Vec<NodeIndex> {
        self.masses_on(at, law, parameters, LinkBase::Law { pair })
    }

    /// A chain of masses behind a law, link 1 on `first`.
    pub(super) fn masses_on(
        &mut self,
        at: &Place,
        law: &Law,
        parameters: &ChainParameters,
        first: LinkBase,
    ) -> Vec<NodeIndex> {
        let start = self.displacement_at_start(law);
        let mut nodes: Vec<NodeIndex> = Vec::with_capacity(parameters.inertias.len());
        for (index, &inertia) in parameters.inertias.iter().enumerate() {
            let motion = NodeMotion::Mass { law: law.clone() };
            let mass = self.add_node(at.object, Node { inertia, motion }, start);
            let base = match nodes.last() {
                None => first.clone(),
                Some(&node) => LinkBase::Mass(node),
            };
            self.model.links.push(Link {
                mass,
                base,
                stiffness: parameters.stiffnesses[index],
                damping: parameters.dampings[index],
            });
            let link = self.model.links.len() - 1;
            self.model.objects[at.object].links.push(link);
            nodes.push(mass);
        }
        nodes
    }

    /// A further output of the object, one that its ports name: a node without
    /// inertia that follows a law, usually over a node of the object itself.
    pub fn output(&mut self, at: &Place, name: &str, law: Law) -> Option<NodeIndex> {
        let part = *self.indices.get(&format!("{}.{name}", at.id))?;
        Some(self.add_rigid(part, law, 0.0, Pair::default()))
    }

    /// A force or moment on a node, positive towards positive displacement, addressed
    /// as `object.loads.name`.
    pub fn force(&mut self, at: &Place, node: NodeIndex, name: &str, law: LoadLaw) {
        let name = at.path(&format!("loads.{name}"));
        self.model.loads.push(Load { node, name, law });
    }

    /// A node of an object that is none of its masses.
    pub(super) fn add_point(&mut self, at: &Place, law: &Law, node: Node) -> NodeIndex {
        let start = self.displacement_at_start(law);
        self.model.nodes.push(node);
        self.known.push(NodeEntry {
            part: at.object,
            start,
        });
        self.model.nodes.len() - 1
    }

    /// A node that follows a law exactly, of an object or of an output.
    pub(super) fn add_rigid(
        &mut self,
        part: usize,
        law: Law,
        inertia: f64,
        pair: Pair,
    ) -> NodeIndex {
        self.model.objects[part].rigid_pair = Some(pair);
        let start = self.displacement_at_start(&law);
        let motion = NodeMotion::Rigid { law };
        self.add_node(part, Node { inertia, motion }, start)
    }

    /// Adds a node to an object or an output of one, with its displacement at t = 0; it is the output until another
    /// one is added.
    pub(super) fn add_node(&mut self, part: usize, node: Node, start: f64) -> NodeIndex {
        self.model.nodes.push(node);
        let index = self.model.nodes.len() - 1;
        let object = &mut self.model.objects[part];
        let mass = object.nodes.len();
        object.nodes.push(index);
        let given = self.explicit.get(&object.id);
        let given = given.and_then(|masses| masses.get(mass)).copied();
        self.outputs.insert(object.id.clone(), index);
        self.known.push(NodeEntry {
            part,
            start: given.unwrap_or(start),
        });
        index
    }

    /// A part of an object, driven as the object is.
    pub(super) fn add_part(&mut self, at: &Place, name: &str, kind: &'static str) -> usize {
        let own = &self.model.objects[at.object];
        let part = ObjectPart {
            id: at.path(name),
            kind,
            coordinate: own.coordinate,
            inputs: own.inputs.clone(),
            combination: own.combination,
            ..ObjectPart::default()
        };
        let index = self.model.objects.len();
        self.indices.insert(part.id.clone(), index);
        self.model.objects.push(part);
        index
    }

    /// The node of the inertia at the driven end of an elastic object, behind the law
    /// that its masses follow: the part that it is, and the node.
    pub(super) fn driven_end(&mut self, at: &Place, law: &Law, inertia: f64) -> (usize, NodeIndex) {
        let part = self.add_part(at, DRIVEN_END, DRIVEN_END);
        let node = self.add_rigid(part, law.clone(), inertia, Pair::default());
        self.model.objects[at.object].driven_end = Some(node);
        (part, node)
    }

    /// Id and coordinate of what a node belongs to.
    pub(super) fn owner(&self, node: NodeIndex) -> (&str, Coordinate) {
        let part = &self.model.objects[self.known[node].part];
        (&part.id, part.coordinate)
    }
}
