//! Linkages: an input node that carries the whole, and a node for each output.

use super::assembly_range::{DEAD, displacement_text, range};
use super::spec::DrivenLinkage;
use super::{InputConnection, ModelBuilder, Place};
use crate::dynamics::model::{Law, LinkageBody, NodeIndex, Pair, TrackSource};
use crate::dynamics::stated::StatedPosition;
use crate::fault::Fault;
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::kinematics::linkage::multi::proposal;
use crate::kinematics::linkage::multi::spec::{InputCoordinate, InputSpec, MultiSpec};
use crate::kinematics::linkage::spec::{LinkageSpec, PairSpec};
use crate::kinematics::linkage::{Cause, Linkage, Reach};
use crate::kinematics::position::{LinkageOutput, Position, linkage_reach};
use std::sync::Arc;

impl ModelBuilder {
    /// Lowers a linkage behind what an input hangs on (`None` where that has faults
    /// of its own): its structure is found here, and everything that is wrong with it.
    pub fn linkage(&mut self, at: &Place, input: Option<&InputConnection>, spec: &DrivenLinkage) {
        let position = Position::new(&spec.position);
        let linkage = Linkage::new(spec.linkage.clone());
        let (position, linkage) = match (position, linkage) {
            (Ok(position), Ok(linkage)) => (position, Arc::new(linkage)),
            (position, linkage) => {
                if let Err(faults) = position {
                    self.faults(at, "position", faults);
                }
                if let Err(faults) = linkage {
                    let faults = proposed(&spec.linkage, faults);
                    self.faults(at, "", faults);
                }
                return;
            }
        };
        let Some(input) = input else {
            return;
        };
        let law = |driver, position| Law {
            driver,
            position,
            lever: 1.0,
            track: None,
        };
        let node = self.rigid(at, law(input.node, position.clone()), 0.0, Pair::default());
        let stated = Arc::new(StatedPosition::new(&spec.position));
        self.model.stated.positions.insert(node, stated);
        self.within_reach(at, node, input, &position, &linkage);
        for remark in linkage.remarks() {
            self.warn(format!("`{}`: {remark}", at.id));
        }
        let friction = match spec.joint_friction {
            true => self.joint_friction(at, &linkage),
            false => None,
        };
        let mut outputs = Vec::new();
        for (index, (output, loads)) in spec.linkage.outputs.iter().zip(&spec.loads).enumerate() {
            let position = Position::Linkage(LinkageOutput::new(&linkage, index));
            let Some(carrier) = self.output(at, &output.name, law(node, position)) else {
                continue;
            };
            for load in loads {
                let path = at.path(&format!("outputs.{}.loads.{}", output.name, load.name));
                self.load_at(path, at.object, load, &[carrier], node);
            }
            outputs.push(carrier);
        }
        // Steps end at the points of tables, so that none is passed over.
        for force in &spec.linkage.forces {
            if let Some(breaks) = force.law.breaks() {
                self.track(TrackSource::Node(node), (breaks, false), at.object);
            }
        }
        self.model.linkages.push(LinkageBody {
            node,
            linkage,
            outputs,
            friction,
            object: at.object,
        });
    }

    /// The reactions that friction follows from; `None` where no pair rubs.
    fn joint_friction(&mut self, at: &Place, linkage: &Linkage) -> Option<Arc<Kinetostatics>> {
        let made = Kinetostatics::new(linkage.spec());
        let kinetostatics = self.kinetostatics_with_friction(at, linkage.spec(), made)?;
        match kinetostatics.friction_left_open(linkage) {
            None => Some(Arc::new(kinetostatics)),
            Some(fault) => {
                self.faults(at, "", vec![fault]);
                None
            }
        }
    }

    /// The kinetostatics of a linkage whose pairs are to have friction; `None` where none has.
    pub(super) fn kinetostatics_with_friction(
        &mut self,
        at: &Place,
        spec: &LinkageSpec,
        made: Result<Kinetostatics, Vec<Fault>>,
    ) -> Option<Kinetostatics> {
        let kinetostatics = match made {
            Ok(kinetostatics) => kinetostatics,
            Err(faults) => {
                self.faults(at, "", faults);
                return None;
            }
        };
        for pair in spec.pairs.iter().filter(|pair| is_bare(pair)) {
            self.warn(format!(
                "pin `{}` of `{}` has a coefficient of friction and no `diameter`: it makes no \
                 moment",
                pair.name, at.id
            ));
        }
        if !kinetostatics.has_friction() {
            self.warn(format!(
                "`joint_friction` of `{}` does nothing: none of its pairs has friction",
                at.id
            ));
            return None;
        }
        Some(kinetostatics)
    }

    /// Checks that a linkage can be assembled at the start, and ends the run at
    /// its dead-centre positions.
    fn within_reach(
        &mut self,
        at: &Place,
        node: NodeIndex,
        input: &InputConnection,
        position: &Position,
        linkage: &Linkage,
    ) {
        let (start, phi) = (self.start_of(node), self.start_of(input.node));
        let Some(reach) = linkage_reach(linkage) else {
            return;
        };
        let own = self.owner(node).1;
        if !(reach.0 < start && start < reach.1) {
            let driver = &input.output;
            let message = format!(
                "it cannot be assembled at the start, with `{driver}` at {}: its input coordinate \
                 would be {}",
                displacement_text(phi, input.coordinate),
                displacement_text(start, own)
            );
            let hint = format!(
                "that must lie {}; start `{driver}` elsewhere, or give another `assembly`",
                range(reach, own)
            );
            self.fault(at, "start", message, &hint);
            return;
        }
        let jet = position.jet(0, 0.0);
        let ends = [reach.0, reach.1].map(|q| (q - jet.value) / jet.first);
        let of_driver = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        self.limit_driver(at, input.node, of_driver, &ends_in_words(linkage));
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
    pair.kind.diameter() == Some(0.0) && pair.friction > 0.0
}

/// Adds to what is said of a mobility above one the inputs that the linkage could have.
fn proposed(linkage: &LinkageSpec, mut faults: Vec<Fault>) -> Vec<Fault> {
    let Some(driver) = linkage.pairs.get(linkage.driver) else {
        return faults;
    };
    let spec = MultiSpec {
        linkage: linkage.clone(),
        inputs: vec![InputSpec {
            name: driver.name.clone(),
            coordinate: InputCoordinate::Pair(linkage.driver),
            start: linkage.start,
        }],
    };
    let count = faults.iter_mut().find(|fault| fault.path == "pairs");
    if let Some((fault, others)) = count.zip(proposal(&spec)) {
        fault.hint.push_str(&format!(
            r#"; it would do with "inputs": {{ "{0}": {{ "pair": "{0}", "object": "…" }}, {others} }}, the `object` being what is its `input`"#,
            driver.name
        ));
    }
    faults
}
