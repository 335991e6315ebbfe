//! Objects, drivers first, to trees.

mod loads;
mod masses;
mod sums;

use super::prescribed::PrescribedMotion;
use super::{Holder, KeptLaws, Part, Parts, law, load};
use crate::dynamics::model::{
    Closure, Law as ModelLaw, Model, NodeMotion, ObjectPart, Pair, STOP, TrackSource,
};
use crate::dynamics::system::System;
use crate::exact::{Law, Refusal, TimeLoad, TreeMass, TreePair, TreeProblem};

/// Role of a node in exact propagation.
#[derive(Clone, Debug)]
enum Role<'m> {
    /// Prescribed: the motion is known by its course and the position functions on the
    /// way.
    Prescribed(PrescribedMotion, Vec<&'m ModelLaw>),
    /// φ = ratio·φ_mass + offset, of a mass of a tree.
    Moved(MovedNode),
    /// Behind something that cannot be propagated exactly.
    Unfit,
}

/// A node that moves with a mass.
#[derive(Clone, Copy, Debug)]
struct MovedNode {
    tree: usize,
    mass: usize,
    ratio: f64,
    offset: f64,
}

struct Builder<'m> {
    laws: &'m mut KeptLaws,
    system: &'m System,
    model: &'m Model,
    roles: Vec<Role<'m>>,
    trees: Vec<Part>,
    /// Trees with an object that stands against exact propagation.
    spoiled: Vec<bool>,
    refusals: Vec<Refusal>,
}

/// Why a load that is dry friction is left to integration.
fn dry_friction_reason(load: &crate::dynamics::model::Load) -> String {
    let name = load.name.rsplit('.').next().unwrap_or(&load.name);
    format!("its load `{name}` is dry friction, which sticks")
}

/// Takes a system apart.
pub(super) fn build(system: &System, laws: &mut KeptLaws) -> Parts {
    let model = system.model();
    let mut builder = Builder {
        laws,
        system,
        model,
        roles: vec![Role::Unfit; model.nodes.len()],
        trees: Vec::new(),
        spoiled: Vec::new(),
        refusals: Vec::new(),
    };
    for body in &model.linkages {
        if body.friction.as_ref().is_some_and(|k| k.has_friction()) {
            let reason = "it has friction in its joints, whose directions and standstills are \
                          found by integration";
            builder.note_refusal(body.object, reason);
        }
    }
    for body in &model.multi_linkages {
        let reason = "it has several inputs, which it couples and loads by its own inertia: what \
                      drives it is integrated with it";
        builder.note_refusal(body.object, reason);
    }
    for load in (model.loads.iter()).filter(|load| load.law.dry_friction().is_some()) {
        let owner = model.owner_of_load(load);
        let mut parts = model.objects.iter();
        if let Some(object) = parts.position(|part| part.nodes.contains(&owner)) {
            builder.note_refusal(object, dry_friction_reason(load));
        }
    }
    if !builder.refusals.is_empty() {
        return builder.finish();
    }
    let mut order: Vec<usize> = (0..model.objects.len()).collect();
    order.sort_by_cached_key(|&object| model.objects[object].nodes[0]);
    for object in order {
        builder.object(object);
    }
    for load in &model.loads {
        builder.load(load);
    }
    builder.check_rigid_pairs();
    builder.refuse_dead_positions();
    builder.check_first_spans();
    builder.finish()
}

impl<'m> Builder<'m> {
    fn note_refusal(&mut self, object: usize, reason: impl Into<String>) {
        let id = &self.model.objects[object].id;
        self.refusals.push(Refusal::new(id, reason));
        for (tree, spoiled) in self.trees.iter().zip(&mut self.spoiled) {
            *spoiled |= tree.objects.contains(&object);
        }
    }

    /// Refuses an object and what it hangs on.
    fn refuse_behind(&mut self, object: usize, role: &Role<'_>, reason: impl Into<String>) {
        if let Role::Moved(moved) = role {
            self.spoiled[moved.tree] = true;
        }
        self.note_refusal(object, reason);
    }

    fn object(&mut self, object: usize) {
        let part = &self.model.objects[object];
        let node = part.nodes[0];
        if part.kind == STOP {
            // A load on a mass that has its place already.
            return;
        }
        if let Some(combination) = part.combination {
            self.combine(object, combination);
        }
        match &self.model.nodes[node].motion {
            NodeMotion::Prescribed { motion, .. } => {
                self.roles[node] = Role::Prescribed(PrescribedMotion::new(motion), Vec::new());
            }
            NodeMotion::Rotor { .. } => self.note_refusal(
                object,
                "it is turned by a torque: its motion is not known beforehand",
            ),
            NodeMotion::Rigid { law } => self.rigid(object, law),
            NodeMotion::Mass { law } => self.chain(object, law),
            NodeMotion::Constrained { .. } => {
                self.note_refusal(object, "it is the sum of its inputs itself");
            }
        }
    }

    /// What drives an object, with its id.
    fn driver(&self, law: &ModelLaw) -> Role<'m> {
        self.roles[law.driver].clone()
    }

    /// The straight line of a law behind an elastic object.
    fn line(&mut self, object: usize, law: &ModelLaw, role: &Role<'_>) -> Option<(f64, f64)> {
        let line = law.position.straight_line();
        let line = line.map(|[r, o]| (law.lever * r, law.lever * o));
        if line.is_none() {
            let driver = self.model.objects[object].driver();
            let driver = driver.map_or("its driver", |driver| &self.model.objects[driver].id);
            let reason = format!(
                "its position function is not a straight line, and `{driver}`, which drives it, \
                 moves elastically"
            );
            self.refuse_behind(object, role, reason);
        }
        line
    }

    /// Where a node stands whose driver moves with a mass.
    fn node_behind_mass(
        &mut self,
        object: usize,
        law: &ModelLaw,
        role: &Role<'_>,
        driver: MovedNode,
    ) -> Option<MovedNode> {
        let (ratio, offset) = self.line(object, law, role)?;
        Some(MovedNode {
            ratio: ratio * driver.ratio,
            offset: ratio * driver.offset + offset,
            ..driver
        })
    }

    fn rigid(&mut self, object: usize, law: &'m ModelLaw) {
        let node = self.model.objects[object].nodes[0];
        let role = self.driver(law);
        self.roles[node] = match &role {
            Role::Unfit => Role::Unfit,
            Role::Prescribed(course, laws) => role_behind_law(course, laws, law),
            Role::Moved(_) if self.model.linkages.iter().any(|body| body.node == node) => {
                let reason = "it is a linkage, whose reduced inertia changes as it moves, behind \
                              an elastic object";
                self.refuse_behind(object, &role, reason);
                return;
            }
            Role::Moved(moved) => {
                let Some(on) = self.node_behind_mass(object, law, &role, *moved) else {
                    return;
                };
                let mass = &mut self.trees[on.tree].problem.masses[on.mass];
                mass.inertia += on.ratio * on.ratio * self.model.nodes[node].inertia;
                Role::Moved(on)
            }
        };
    }

    fn chain(&mut self, object: usize, law: &'m ModelLaw) {
        let role = self.driver(law);
        let (tree, base) = match &role {
            Role::Unfit => return,
            Role::Prescribed(course, laws) => {
                let Role::Prescribed(course, laws) = role_behind_law(course, laws, law) else {
                    return;
                };
                let law = self.laws.law(object, || law::law(&course, &laws));
                self.trees.push(Part {
                    problem: TreeProblem {
                        masses: Vec::new(),
                        law,
                        displacement: Vec::new(),
                        speed: Vec::new(),
                        objects: Vec::new(),
                    },
                    masses: Vec::new(),
                    objects: Vec::new(),
                    pairs: Vec::new(),
                    modes: std::sync::Arc::default(),
                });
                self.spoiled.push(false);
                (self.trees.len() - 1, None)
            }
            Role::Moved(moved) => {
                let Some(on) = self.node_behind_mass(object, law, &role, *moved) else {
                    return;
                };
                (moved.tree, Some(on))
            }
        };
        self.masses(object, tree, base);
    }

    /// What is held by a rigid pair is propagated alone, under loads that are constant.
    fn check_rigid_pairs(&mut self) {
        for tree in 0..self.trees.len() {
            let Part {
                problem, objects, ..
            } = &self.trees[tree];
            let rigid = |mass: &TreeMass| mass.restitution.is_some();
            let Some(own) = problem.masses.iter().position(rigid) else {
                continue;
            };
            let mass = &problem.masses[own];
            let constant = |load: &TimeLoad| matches!(load, TimeLoad::Constant(_));
            let reason = if problem.masses.len() > 1 {
                "its contact is rigid, and another object moves elastically on it or carries it"
            } else if !mass.loads.iter().all(constant) {
                "its contact is rigid, under a load that is not constant"
            } else if mass.ground_damping != 0.0 {
                "its contact is rigid, under a load that depends on its speed"
            } else {
                continue;
            };
            for object in objects.clone() {
                self.note_refusal(object, reason);
            }
            self.spoiled[tree] = true;
        }
    }

    /// Dead positions are looked for by the general methods only.
    fn refuse_dead_positions(&mut self) {
        for track in self.model.tracks.iter().filter(|track| track.stops) {
            if let TrackSource::Node(node) = track.source
                && matches!(self.roles[node], Role::Prescribed(..))
            {
                let reason = "it has dead-centre positions, which a run must search for";
                self.note_refusal(track.object, reason);
            }
        }
    }

    /// Laws in spans must have a first one.
    fn check_first_spans(&mut self) {
        for tree in 0..self.trees.len() {
            if let Law::Spans(source) = &self.trees[tree].problem.law
                && !source.span(0.0).value.is_finite()
            {
                self.spoiled[tree] = true;
                let object = self.trees[tree].objects[0];
                let reason = "the motion that it follows cannot be fitted to rounding";
                self.note_refusal(object, reason);
            }
        }
    }

    fn finish(self) -> Parts {
        let spans = self.roles.iter().filter_map(|role| match role {
            Role::Prescribed(course, laws) if !laws.is_empty() || course.is_sum() => {
                match law::law(course, laws) {
                    Law::Spans(source) => Some(source),
                    Law::Harmonic { .. } => None,
                }
            }
            _ => None,
        });
        let spans = spans.collect();
        let holders = self.holders();
        let sound = self.trees.into_iter().zip(&self.spoiled);
        let course = |role: Role<'_>| match role {
            Role::Prescribed(course, _) => Some(course),
            _ => None,
        };
        Parts {
            trees: sound
                .filter(|(_, spoiled)| !**spoiled)
                .map(|(tree, _)| tree)
                .collect(),
            refusals: self.refusals,
            courses: self.roles.into_iter().map(course).collect(),
            spans,
            holders,
        }
    }

    /// Who moves each object, trees numbered without the spoiled ones.
    fn holders(&self) -> Vec<Holder> {
        let number = |tree: usize| self.spoiled[..tree].iter().filter(|s| !**s).count();
        let holder = |part: &ObjectPart| match &self.roles[part.nodes[0]] {
            Role::Prescribed(..) => Holder::Drive,
            Role::Moved(on) if !self.spoiled[on.tree] => Holder::Tree(number(on.tree)),
            Role::Moved(_) | Role::Unfit => Holder::Other,
        };
        let mut holders: Vec<Holder> = self.model.objects.iter().map(holder).collect();
        // The sum of modes moves with the first of them, be it a part of its own or not.
        for reduced in &self.model.reduced {
            let mode = reduced.modes.first().map(|(node, _)| node);
            let mut parts = self.model.objects.iter();
            let first = mode.and_then(|mode| parts.position(|part| part.nodes.contains(mode)));
            let first = first.map(|first| holders[first]);
            let summed = reduced.output.and_then(|output| {
                let mut parts = self.model.objects.iter();
                parts.position(|part| part.nodes.contains(&output))
            });
            let summed = summed.unwrap_or(reduced.object);
            holders[summed] = first.unwrap_or(holders[summed]);
        }
        holders
    }
}

fn role_behind_law<'m>(
    course: &PrescribedMotion,
    laws: &[&'m ModelLaw],
    law: &'m ModelLaw,
) -> Role<'m> {
    let mut all = laws.to_vec();
    all.push(law);
    Role::Prescribed(course.through_position(&law.position, law.lever), all)
}

/// The pair, and whether its force is linear while it is engaged.
fn tree_pair(pair: &Pair) -> (TreePair, bool) {
    let linear = pair.form.is_linear() || pair.form.restitution().is_some();
    match pair.closure {
        Closure::Bilateral => (TreePair::Bilateral, true),
        Closure::Force => (TreePair::Force { opens: pair.opens }, linear),
        Closure::Form => (TreePair::Form { gap: pair.gap }, linear),
    }
}
