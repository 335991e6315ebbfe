//! What a system is not built of.

use super::Builder;
use crate::dynamics::system::friction::Group;
use crate::dynamics::system::passes::{Extent, Work};
use crate::fault::Fault;

/// A mass matrix of which a pivot has lost all digits but so many parts is not positive.
const MASSLESS: f64 = 1e-13;

impl Builder<'_> {
    /// Friction of joints is found from the acceleration of one coordinate.
    pub(super) fn refuse_coupled_friction(&mut self) {
        for group in &self.frozen.groups {
            let combined = (self.frozen.constraints.iter()).any(|one| one.node == group.root);
            if !(combined || self.frozen.is_coupled(group.root)) {
                continue;
            }
            for member in &group.members {
                let id = &self.model.objects[member.object].id;
                self.faults.push(Fault::new(
                    format!("{id}.joint_friction"),
                    "it moves as one with an object that has several inputs and inertia: joint \
                     friction is found for one coordinate alone",
                    "leave `joint_friction` out, or give one of the objects between masses",
                ));
            }
        }
    }

    /// Friction of joints is found for one linkage of several inputs.
    pub(super) fn refuse_second_friction(&mut self, object: usize) {
        let id = &self.model.objects[object].id;
        self.faults.push(Fault::new(
            format!("{id}.joint_friction"),
            "another linkage of several inputs has joint friction too: in a run it is found for \
             one of them",
            "leave `joint_friction` out of one of them, or run them in scenes of their own",
        ));
    }

    /// Reactions of a linkage of several inputs know the forces on its outputs, but not the
    /// inertia forces of what is solved together with it.
    pub(super) fn refuse_passed_on_friction(&mut self) {
        let Some(several) = self.frozen.several.as_ref() else {
            return;
        };
        if self.frozen.passes_inertia_on() {
            let id = &self.model.objects[several.object].id;
            self.faults.push(Fault::new(
                format!("{id}.joint_friction"),
                "one of its outputs moves an object of several inputs: the forces of that on the \
                 joints are not known to their friction",
                "leave `joint_friction` out, or give the object on its output a mass behind a \
                 spring",
            ));
        }
    }

    /// The mass matrix of linkages of several inputs must be positive at the start.
    pub(super) fn refuse_massless(&mut self) {
        let Some(multi) = self.frozen.multi.first() else {
            return;
        };
        let object = multi.object;
        let (mut work, mut modes) = (Work::new(&self.frozen), self.frozen.no_modes());
        let state = self.frozen.law_state();
        self.frozen.locate_tracks(&state, &mut modes);
        let mut out = vec![0.0; self.frozen.coordinates];
        let extent = Extent::Full;
        self.frozen
            .evaluate(0.0, &state, &modes, extent, &mut work, &mut out);
        if work.dense.positive > MASSLESS || self.frozen.unassembled(&work).is_some() {
            return;
        }
        let id = &self.model.objects[object].id;
        self.faults.push(Fault::new(
            format!("{id}.inputs"),
            "the free inputs have a motion that moves no inertia: their speed is not determined",
            "give mass or a moment of inertia to the links that move alone there, or inertia to \
             the motors",
        ));
    }

    /// What rigid contacts are not combined with.
    pub(super) fn refuse_rigid_contacts(&mut self) {
        let frozen = &self.frozen;
        let mut faults = Vec::new();
        for component in 0..frozen.contacts() {
            if !frozen.is_rigid(component) {
                continue;
            }
            let chain = match frozen.pairs.get(component) {
                Some(&chain) => chain,
                None => frozen.stops[component - frozen.pairs.len()].chain,
            };
            let own = &frozen.chains[chain];
            let id = || {
                let nodes = |node: &usize| own.nodes().contains(&frozen.internal[*node]);
                let mut parts = self.model.objects.iter();
                let part = parts.find(|part| part.nodes.iter().any(nodes));
                part.map_or_else(String::new, |part| part.id.clone())
            };
            let mut moving = frozen.root_nodes(frozen.laws[own.law].driver);
            moving.extend(own.nodes());
            let rubbing =
                |group: &&Group| group.coordinate.is_some() && moving.contains(&group.root);
            if frozen.groups.iter().any(|group| rubbing(&group)) {
                faults.push(Fault::new(
                    format!("{}.pair.contact.restitution", id()),
                    "it strikes what moves as one with joints that have friction: what friction \
                     does in an impact is not determined",
                    "leave `joint_friction` out, or give the contact a stiffness",
                ));
            }
            if !frozen.multi.is_empty() && frozen.moves_freely(frozen.laws[own.law].driver) {
                faults.push(Fault::new(
                    format!("{}.pair.contact.restitution", id()),
                    "it strikes an object with a free coordinate beside a linkage of several \
                     inputs: the impulse would pass through the mass matrix of the linkage, which \
                     impacts do not take",
                    "give the contact a stiffness, or prescribe the motion of its driver",
                ));
            }
            let stop = component >= frozen.pairs.len();
            if stop
                && own.contact.restitution().is_some()
                && frozen.moves_freely(frozen.laws[own.law].driver)
            {
                faults.push(Fault::new(
                    format!("{}.stops", id()),
                    "a drive with a free coordinate between a rigid contact and a rigid stop \
                     would be held by both at once",
                    "give the pair or the stop a contact with a stiffness",
                ));
            }
        }
        self.faults.extend(faults);
    }
}
