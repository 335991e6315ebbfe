//! One-sided stops of the last mass of an object against the ground.

use super::spec::{BodySpec, ChainSpec, StopSpec};
use super::{ModelBuilder, Place, contact};
use crate::dynamics::model::{Load, LoadLaw, NodeIndex, PartInput, STOP, Stop, StopPart};
use crate::fault::Faults;
use std::collections::BTreeMap;

impl ModelBuilder {
    /// Adds the stops of an object with these masses.
    pub(super) fn stops(&mut self, at: &Place, spec: &ChainSpec, masses: &[NodeIndex]) {
        check(at, spec, &self.indices, &mut self.faults);
        let Some(&node) = masses.last().filter(|_| spec.masses() > 0) else {
            return;
        };
        for own in &spec.stops {
            let stop = Stop {
                at: own.at,
                side: own.side,
                stiffness: own.contact.stiffness,
                law: own.contact.law,
            };
            let part = self.add_part(at, &own.name, STOP);
            self.model.objects[part].nodes.push(node);
            self.model.objects[part].inputs = PartInput::behind_one_driver(Some(at.object));
            self.model.objects[part].combination = None;
            self.add_contact_pressure(part, &own.contact);
            self.model.loads.push(Load {
                node,
                name: at.path(&format!("stops.{}", own.name)),
                law: LoadLaw::Stop(stop),
            });
            self.model.stops.push(StopPart {
                object: at.object,
                part,
                load: self.model.loads.len() - 1,
            });
        }
    }
}

/// The faults of an object's stops, beside the parts that there are.
pub(super) fn check(
    at: &Place,
    spec: &ChainSpec,
    parts: &BTreeMap<String, usize>,
    faults: &mut Faults,
) {
    if spec.stops.is_empty() {
        return;
    }
    if let BodySpec::Modes { .. } = spec.body {
        let message =
            "its modes are those of the object free at its output: a stop would hold it there";
        let hint = "give `masses` in place of `modes`";
        faults.add(at.path("stops"), message, hint);
    }
    if spec.masses() == 0 {
        let message = "nothing between a rigid object's driver and a stop is elastic";
        let hint = "give the object at least one mass, or its pair a `contact`";
        faults.add(at.path("stops"), message, hint);
    }
    for own in &spec.stops {
        check_one(at, own, parts, faults);
    }
    let upper = || spec.stops.iter().filter(|stop| stop.side > 0.0);
    for lower in spec.stops.iter().filter(|stop| stop.side < 0.0) {
        if let Some(upper) = upper().find(|upper| upper.at <= lower.at) {
            let message = format!(
                "the stop `{}` from below, at {}, is not below `{}` from above, at {}: nothing is \
                 left between them",
                lower.name, lower.at, upper.name, upper.at
            );
            let hint = "exchange their sides, or move one of them";
            faults.add(at.path(&format!("stops.{}.at", lower.name)), message, hint);
        }
    }
}

fn check_one(at: &Place, stop: &StopSpec, parts: &BTreeMap<String, usize>, faults: &mut Faults) {
    let property = format!("stops.{}", stop.name);
    let path = |name: &str| at.path(&format!("{property}.{name}"));
    faults.finite(&path("at"), stop.at);
    if stop.side != 1.0 && stop.side != -1.0 {
        let message = format!("{} is no side", stop.side);
        faults.add(at.path(&format!("{property}.side")), message, "give + or -");
    }
    contact::check_numbers(at, &format!("{property}.contact"), &stop.contact, faults);
    if parts.contains_key(&at.path(&stop.name)) {
        let message = format!("`{}` is the name of another part of the object", stop.name);
        faults.add(at.path(&property), message, "give the stop another name");
    }
}
