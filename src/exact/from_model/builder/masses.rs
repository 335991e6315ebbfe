//! Masses of a chain behind a law or behind masses.

use super::super::MassPlace;
use super::{Builder, MovedNode, Role, tree_pair};
use crate::dynamics::laws::contact::law_of_link;
use crate::dynamics::model::{LinkBase, Loss};
use crate::exact::{TreeMass, TreeObject};

impl Builder<'_> {
    /// Adds the masses of a chain behind `base`, or behind the law itself.
    pub(super) fn masses(&mut self, object: usize, tree: usize, base: Option<MovedNode>) {
        let part = &self.model.objects[object];
        if part.contact.is_some_and(|contact| contact.point.is_some()) {
            let reason = "the point between its contact and its damped link 1 is massless: a \
                          state of first order, where exact propagation knows masses only";
            self.trees[tree].objects.push(object);
            self.note_refusal(object, reason);
            return;
        }
        let first = self.trees[tree].problem.masses.len();
        let coordinate = self.system.first_coordinate(object).unwrap_or(0);
        for (m, (&node, &link)) in part.nodes.iter().zip(&part.links).enumerate() {
            let link = &self.model.links[link];
            let problem = &mut self.trees[tree].problem;
            let mut mass = TreeMass::new(
                self.model.nodes[node].inertia,
                (m > 0).then(|| first + m - 1),
                link.stiffness,
                link.damping,
            );
            if let Some(base) = base {
                let driver = &problem.masses[base.mass];
                mass.ratio = base.ratio * driver.ratio;
                mass.offset = base.ratio * driver.offset + base.offset;
                if m == 0 {
                    (mass.parent, mass.lever) = (Some(base.mass), base.ratio);
                }
            }
            let mut linear = true;
            if let LinkBase::Law { pair } = &link.base {
                (mass.pair, linear) = tree_pair(pair);
                mass.restitution = pair.form.restitution();
            }
            problem.masses.push(mass);
            problem.displacement.push(0.0);
            problem.speed.push(0.0);
            self.trees[tree].masses.push(MassPlace {
                coordinate: coordinate + m,
                base: base.map(|base| (base.mass, base.ratio)),
            });
            self.roles[node] = Role::Moved(MovedNode {
                tree,
                mass: first + m,
                ratio: 1.0,
                offset: 0.0,
            });
            if !linear {
                self.spoiled[tree] = true;
                let own = part.contact.map(|own| own.law.declaration());
                let own = own.unwrap_or(law_of_link(Loss::FactorOfDamper));
                self.note_refusal(
                    object,
                    format!("its contact force is not linear ({})", own.name),
                );
            }
        }
        let added = &mut self.trees[tree];
        let last = added.problem.masses.len() - 1;
        let place = |&(node, share): &(usize, f64)| {
            let mass = part.nodes.iter().position(|&own| own == node)?;
            Some((first + mass, share))
        };
        let output = match self.model.reduction_of(object) {
            Some(reduced) => reduced.modes.iter().filter_map(place).collect(),
            None => vec![(last, 1.0)],
        };
        added.problem.objects.push(TreeObject {
            first,
            output,
            driver: base.map(|base| (base.mass, base.ratio)),
        });
        added.objects.push(object);
        if let Some(component) = self.system.pair_component(object) {
            added.pairs.push((first, component));
        }
    }
}
