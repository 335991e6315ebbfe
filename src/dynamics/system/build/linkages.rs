//! Linkages of the layout, and the friction of their joints.

use super::Builder;
use crate::dynamics::system::linkages::{FrozenLinkage, OutputPlace};
use crate::dynamics::system::multi::{FrozenMulti, MultiPlace, MultiValue};
use std::sync::Arc;

impl Builder<'_> {
    /// Linkages, and which laws are outputs of theirs.
    pub(super) fn place_linkages(&mut self) {
        let frozen = &mut self.frozen;
        for (linkage, body) in self.model.linkages.iter().enumerate() {
            let node = frozen.internal[body.node];
            frozen
                .linkages
                .push(FrozenLinkage::new(node, &body.linkage));
            for (output, &node) in body.outputs.iter().enumerate() {
                let node = frozen.internal[node];
                let rigid = frozen.rigids.iter().find(|rigid| rigid.node == node);
                if let Some(rigid) = rigid {
                    let place = OutputPlace { linkage, output };
                    frozen.laws[rigid.law].output = Some(place);
                }
            }
        }
    }

    /// Linkages of several inputs, and which constrained nodes are theirs.
    pub(super) fn place_multi(&mut self) {
        let frozen = &mut self.frozen;
        for (linkage, body) in self.model.multi_linkages.iter().enumerate() {
            let inputs = body.inputs.iter();
            frozen.multi.push(FrozenMulti {
                nodes: inputs.map(|&node| frozen.internal[node]).collect(),
                linkage: Arc::clone(&body.linkage),
                object: body.object,
                turning: body.friction.is_some(),
            });
            let outputs = body.outputs.iter().enumerate();
            let own = outputs.map(|(output, &node)| (node, MultiValue::Output(output)));
            for (node, value) in own.chain([(body.node, MultiValue::Input)]) {
                let node = frozen.internal[node];
                let mut constraints = frozen.constraints.iter_mut();
                if let Some(one) = constraints.find(|one| one.node == node) {
                    one.multi = Some(MultiPlace { linkage, value });
                }
            }
            for group in 1..body.linkage.structure().groups.len() {
                let value = MultiValue::Distance(group - 1);
                frozen.add_distance(MultiPlace { linkage, value });
            }
        }
    }

    /// Friction in the joints of linkages, with the tracks that it brings along.
    pub(super) fn place_friction(&mut self) {
        for (linkage, body) in self.model.linkages.iter().enumerate() {
            self.frozen.place_friction(linkage, body);
        }
        for (linkage, body) in self.model.multi_linkages.iter().enumerate() {
            if !self.frozen.add_multi_input_friction(linkage, body) {
                self.refuse_second_friction(body.object);
            }
        }
        self.frozen.number_directions();
    }
}
