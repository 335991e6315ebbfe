//! Nodes on which inputs are combined, and sums of modes.

use super::{Builder, Role};
use crate::dynamics::model::NodeMotion;
use crate::exact::from_model::prescribed::PrescribedMotion;
use crate::kinematics::constraint::Constraint;

impl<'m> Builder<'m> {
    /// What the node is on which an object's inputs are combined.
    pub(super) fn combine(&mut self, object: usize, node: usize) {
        let NodeMotion::Constrained {
            drivers,
            constraint,
        } = &self.model.nodes[node].motion
        else {
            return;
        };
        let mut courses = Vec::with_capacity(drivers.len());
        let roles: Vec<Role<'m>> = drivers.iter().map(|&d| self.roles[d].clone()).collect();
        for role in &roles {
            match role {
                Role::Prescribed(course, _) => courses.push(course.clone()),
                // Said of the driver already.
                Role::Unfit => return,
                Role::Moved(_) => {}
            }
        }
        if let Some(reduced) = self.reduced_object_of(object) {
            return self.sum_of_modes(object, reduced, &roles);
        }
        let reason = if courses.len() < drivers.len() {
            "one of its inputs moves elastically"
        } else {
            match constraint {
                Constraint::Linear { ratios, offset } => {
                    let terms = ratios.iter().copied().zip(courses).collect();
                    let sum = PrescribedMotion::sum(terms, *offset);
                    self.roles[node] = Role::Prescribed(sum, Vec::new());
                    return;
                }
                Constraint::Custom(_) => "its inputs are combined by no linear function",
            }
        };
        for role in &roles {
            if let Role::Moved(moved) = role {
                self.spoiled[moved.tree] = true;
            }
        }
        self.note_refusal(object, reason);
    }

    /// The reduced object of which a part is the sum of the modes.
    fn reduced_object_of(&self, sum: usize) -> Option<usize> {
        let nodes = &self.model.objects[sum].nodes;
        let mut all = self.model.reduced.iter();
        let own = all.find(|one| {
            one.object == sum || one.output.is_some_and(|output| nodes.contains(&output))
        });
        own.map(|own| own.object)
    }

    /// An object that is reduced to modes is looked at, if nothing else sees it: its
    /// modes are trees.
    fn sum_of_modes(&mut self, sum: usize, object: usize, roles: &[Role<'_>]) {
        let part = &self.model.objects[sum];
        let mut others = self.model.objects.iter().filter(|other| !other.is_inner());
        let followed = others.any(|other| other.is_driven_by(object));
        let mut loads = self.model.loads.iter();
        let reason = if followed {
            "what it drives couples the modes that it is reduced to"
        } else if loads.any(|load| part.nodes.contains(&load.node)) {
            "a load that depends on its motion couples the modes that it is reduced to"
        } else {
            return;
        };
        for role in roles {
            self.refuse_behind(object, role, reason);
        }
        let first = self.refusals.len() - roles.len();
        self.refusals.truncate(first + 1);
    }
}
