//! New numbers of what is kept of a model.

use crate::dynamics::model::{
    Law, Link, LinkBase, LinkageBody, Load, ModalReduction, Node, NodeMotion, ObjectPart,
};

/// New numbers of what is kept.
#[derive(Default)]
pub(super) struct Numbers {
    pub(super) nodes: Vec<Option<usize>>,
    pub(super) tracks: Vec<Option<usize>>,
    pub(super) links: Vec<Option<usize>>,
}

impl Numbers {
    pub(super) fn renumbered_reduction(
        &self,
        reduced: &ModalReduction,
        kept: &[usize],
    ) -> Option<ModalReduction> {
        let mut copy = reduced.clone();
        copy.object = kept.iter().position(|&own| own == copy.object)?;
        let nodes = copy.modes.iter_mut().map(|(node, _)| node);
        for node in nodes.chain(&mut copy.output) {
            *node = self.nodes[*node]?;
        }
        Some(copy)
    }

    pub(super) fn node(&self, node: &Node) -> Option<Node> {
        let motion = match &node.motion {
            NodeMotion::Prescribed { motion, track } => NodeMotion::Prescribed {
                motion: motion.clone(),
                track: self.track(*track)?,
            },
            rotor @ NodeMotion::Rotor { .. } => rotor.clone(),
            NodeMotion::Mass { law } => NodeMotion::Mass {
                law: self.law(law)?,
            },
            NodeMotion::Rigid { law } => NodeMotion::Rigid {
                law: self.law(law)?,
            },
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => NodeMotion::Constrained {
                drivers: (drivers.iter())
                    .map(|&driver| self.nodes[driver])
                    .collect::<Option<_>>()?,
                constraint: constraint.clone(),
            },
        };
        Some(Node { motion, ..*node })
    }

    fn track(&self, track: Option<usize>) -> Option<Option<usize>> {
        match track {
            Some(track) => self.tracks[track].map(Some),
            None => Some(None),
        }
    }

    fn law(&self, law: &Law) -> Option<Law> {
        Some(Law {
            driver: self.nodes[law.driver]?,
            track: self.track(law.track)?,
            ..law.clone()
        })
    }

    pub(super) fn link(&self, link: &Link) -> Option<Link> {
        let base = match &link.base {
            LinkBase::Mass(node) => LinkBase::Mass(self.nodes[*node]?),
            law => law.clone(),
        };
        let mass = self.nodes[link.mass]?;
        Some(Link {
            mass,
            base,
            ..*link
        })
    }

    pub(super) fn load(&self, load: &Load) -> Option<Load> {
        let node = self.nodes[load.node]?;
        let law = load.law.clone();
        Some(Load {
            node,
            name: load.name.clone(),
            law: law.renumbered(&self.tracks, &self.nodes, node)?,
        })
    }

    pub(super) fn linkage(&self, body: &LinkageBody, kept: &[usize]) -> Option<LinkageBody> {
        let mut copy = body.clone();
        copy.node = self.nodes[body.node]?;
        for output in &mut copy.outputs {
            *output = self.nodes[*output]?;
        }
        copy.object = kept.iter().position(|&own| own == body.object)?;
        Some(copy)
    }

    pub(super) fn object(&self, part: &ObjectPart, kept: &[usize]) -> Option<ObjectPart> {
        let mut copy = part.clone();
        let ends = copy.combination.iter_mut().chain(&mut copy.driven_end);
        for node in copy.nodes.iter_mut().chain(ends) {
            *node = self.nodes[*node]?;
        }
        for link in &mut copy.links {
            *link = self.links[*link]?;
        }
        if let Some(contact) = &mut copy.contact {
            contact.link = self.links[contact.link]?;
            if let Some(point) = &mut contact.point {
                *point = self.nodes[*point]?;
            }
        }
        for input in &mut copy.inputs {
            input.driver = kept.iter().position(|&own| own == input.driver)?;
        }
        Some(copy)
    }
}
