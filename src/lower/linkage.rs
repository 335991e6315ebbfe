//! Linkages: an input node that carries the whole, and a node for each output.

use super::Lowering;
use super::reach::{DEAD, place, range};
use crate::linkage::kinetostatics::Kinetostatics;
use crate::linkage::spec::{PairKind, PairSpec};
use crate::linkage::{Cause, Linkage, Reach};
use crate::model::{Closure, DampingLaw, Law, LinkageBody, Node, NodeMotion, Pair};
use crate::object::spec::DrivenLinkage;
use crate::position::{LinkageOutput, Position, linkage_reach};
use std::sync::Arc;

impl Lowering<'_> {
    /// Lowers a linkage: its structure is found here, and everything that is
    /// wrong with it.
    pub(super) fn linkage(&mut self, id: &str, spec: &DrivenLinkage) {
        let position = Position::new(&spec.position);
        let linkage = Linkage::new(spec.linkage.clone());
        let (position, linkage) = match (position, linkage) {
            (Ok(position), Ok(linkage)) => (position, Arc::new(linkage)),
            (position, linkage) => {
                if let Err(faults) = position {
                    self.faults.absorb(&format!("{id}.position"), faults);
                }
                if let Err(faults) = linkage {
                    self.faults.absorb(id, faults);
                }
                return;
            }
        };
        // Nothing to say about an object whose driver has faults itself.
        let Some(input) = self.scene.objects[id].input.as_deref() else {
            return;
        };
        let Some(&driver) = self.outputs.get(input) else {
            return;
        };
        if self.note_course(id, input, &position, 1.0).is_none() {
            return;
        }
        let law = Law {
            driver,
            position: position.clone(),
            lever: 1.0,
            track: None,
        };
        self.within_reach(id, input, &position, &linkage);
        for remark in linkage.remarks() {
            self.model.warnings.push(format!("`{id}`: {remark}"));
        }
        let friction = match spec.joint_friction {
            true => self.joint_friction(id, &linkage),
            false => None,
        };
        let node = self.add_rigid(id, law);
        let mut outputs = Vec::new();
        for (output, loads) in spec.loads.iter().enumerate() {
            let Some(carrier) = self.linkage_output(id, node, &linkage, output) else {
                continue;
            };
            let name = format!("{id}.{}", spec.linkage.outputs[output].name);
            for load in loads {
                self.load(&name, load, &[carrier], node);
            }
            outputs.push(carrier);
        }
        let object = self.indices[id];
        self.model.linkages.push(LinkageBody {
            node,
            linkage,
            outputs,
            friction,
            object,
        });
    }

    /// The reactions that friction follows from; `None` where no pair rubs.
    fn joint_friction(&mut self, id: &str, linkage: &Linkage) -> Option<Arc<Kinetostatics>> {
        let kinetostatics = match Kinetostatics::new(linkage.spec()) {
            Ok(kinetostatics) => kinetostatics,
            Err(faults) => {
                self.faults.absorb(id, faults);
                return None;
            }
        };
        for pair in linkage.spec().pairs.iter().filter(|pair| is_bare(pair)) {
            self.model.warnings.push(format!(
                "pin `{}` of `{id}` has a coefficient of friction and no `diameter`: it makes no \
                 moment",
                pair.name
            ));
        }
        if !kinetostatics.has_friction() {
            self.model.warnings.push(format!(
                "`joint_friction` of `{id}` does nothing: none of its pairs has friction"
            ));
            return None;
        }
        Some(Arc::new(kinetostatics))
    }

    fn linkage_output(
        &mut self,
        id: &str,
        driver: usize,
        linkage: &Arc<Linkage>,
        output: usize,
    ) -> Option<usize> {
        let position = Position::Linkage(LinkageOutput::new(linkage, output));
        let name = format!("{id}.{}", linkage.spec().outputs[output].name);
        self.note_course(&name, id, &position, 1.0)?;
        let law = Law {
            driver,
            position,
            lever: 1.0,
            track: None,
        };
        Some(self.add_rigid(&name, law))
    }

    fn add_rigid(&mut self, id: &str, law: Law) -> usize {
        self.model.objects[self.indices[id]].rigid_pair = Some(Pair {
            closure: Closure::Bilateral,
            gap: 0.0,
            opens: 1.0,
            law: DampingLaw::KelvinVoigt,
        });
        let motion = NodeMotion::Rigid { law };
        self.add_output(
            id,
            Node {
                inertia: 0.0,
                motion,
            },
        )
    }

    /// Checks that a linkage can be assembled at the start, and ends the run at
    /// its dead positions.
    fn within_reach(&mut self, id: &str, input: &str, position: &Position, linkage: &Linkage) {
        let (Some(start), Some(phi)) = (self.start_of(id), self.start_of(input)) else {
            return;
        };
        let Some(reach) = linkage_reach(linkage) else {
            return;
        };
        let own = self.model.objects[self.indices[id]].coordinate;
        if !(reach.0 < start && start < reach.1) {
            let message = format!(
                "it cannot be assembled at the start, with `{input}` at {}: its input coordinate \
                 would be {}",
                place(phi, self.model.objects[self.indices[input]].coordinate),
                place(start, own)
            );
            let hint = format!(
                "that must lie {}; start `{input}` elsewhere, or give another `assembly`",
                range(reach, own)
            );
            self.faults.add(format!("{id}.start"), message, &hint);
            return;
        }
        let jet = position.jet(0, 0.0);
        let ends = [reach.0, reach.1].map(|q| (q - jet.value) / jet.first);
        let of_driver = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        self.limit(id, input, of_driver, &ends_in_words(linkage));
    }
}

/// What is at the ends of a linkage's reach.
fn ends_in_words(linkage: &Linkage) -> String {
    let Reach::Interval { lower, upper } = linkage.range().reach else {
        return DEAD.to_owned();
    };
    let [one, other] = [lower, upper].map(|end| match end.cause {
        Cause::DeadPosition { .. } => DEAD,
        Cause::Travel => "at the end of its travel",
        Cause::Unexplored => "where it was not followed further",
    });
    if one == other {
        one.to_owned()
    } else {
        format!("{one} or {other}")
    }
}

/// A pin with a coefficient of friction that acts on no radius.
fn is_bare(pair: &PairSpec) -> bool {
    matches!(pair.kind, PairKind::Revolute { diameter } if diameter == 0.0) && pair.friction > 0.0
}
