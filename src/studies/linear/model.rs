//! The trees of a system as linear equations, with the names of their objects.

use crate::dynamics::model::ObjectPart;
use crate::dynamics::system::System;
use crate::exact::{LinearTree, Part, Parts, TreePair};
use crate::fault::Fault;
use serde::Serialize;

/// Linear equations of all trees of a system that have some.
#[derive(Clone, Debug)]
pub struct LinearModel {
    pub(super) trees: Vec<NamedTree>,
    /// Objects without such equations.
    pub left_out: Vec<LeftOut>,
}

/// An object that is left out, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Id of the object.
    pub object: String,
    /// The reason.
    pub reason: String,
}

/// A tree behind one law with the names of its parts.
#[derive(Clone, Debug)]
pub(super) struct NamedTree {
    pub(super) equations: LinearTree,
    pub(super) objects: Vec<NamedObject>,
}

/// An elastic object of a tree.
#[derive(Clone, Debug)]
pub(super) struct NamedObject {
    pub(super) id: String,
    /// SI units of displacement and force.
    pub(super) units: [&'static str; 2],
    /// Its masses in the tree.
    pub(super) masses: std::ops::Range<usize>,
    /// Mass that drives it, with U′ between them; `None`: the law.
    pub(super) driver: Option<(usize, f64)>,
    /// Side towards which a force-closed contact separates (±1).
    pub(super) opens: Option<f64>,
    /// Inertia at its driven end, which follows the law (kg·m² or kg).
    pub(super) driven_end: f64,
}

impl LinearModel {
    /// The linear equations of the elastic objects behind prescribed drives.
    ///
    /// # Errors
    /// No object has such equations: every reason at its object.
    pub fn of(system: &System) -> Result<Self, Vec<Fault>> {
        let parts = Parts::of(system);
        let left_out = |object: &str, reason: &str| LeftOut {
            object: object.to_owned(),
            reason: reason.to_owned(),
        };
        let refused = parts.refusals.iter();
        let mut all = Self {
            trees: Vec::new(),
            left_out: refused
                .map(|one| left_out(&one.object, &one.reason))
                .collect(),
        };
        for part in &parts.trees {
            match reason_against(system, part) {
                None => all.trees.push(NamedTree::of(system, part)),
                Some((object, reason)) => {
                    let own = left_out(object, reason);
                    if !all.left_out.contains(&own) {
                        all.left_out.push(own);
                    }
                }
            }
        }
        match all.trees.is_empty() {
            true => Err(all.faults()),
            false => Ok(all),
        }
    }

    /// Why there are no equations at all.
    fn faults(self) -> Vec<Fault> {
        if self.left_out.is_empty() {
            let message = "the scene has no elastic object behind a prescribed drive, so nothing \
                           vibrates";
            let hint = "give an object `masses`, a stiffness and an inertia";
            return vec![Fault::new("", message, hint)];
        }
        let fault = |one: LeftOut| {
            let message = format!("`{}` has no linear equations: {}", one.object, one.reason);
            let hint = "elastic objects with `masses` behind a prescribed drive have them; `dam steady` \
                        finds the multipliers of other periodic motions";
            Fault::new(one.object, message, hint)
        };
        self.left_out.into_iter().map(fault).collect()
    }

    /// Number of masses of all trees.
    pub fn masses(&self) -> usize {
        self.trees.iter().map(|tree| tree.equations.masses()).sum()
    }

    /// Ids of the objects whose laws move its trees.
    pub fn laws(&self) -> impl Iterator<Item = &str> {
        self.trees.iter().map(|tree| tree.law().id.as_str())
    }

    /// Ids of its elastic objects.
    pub fn objects(&self) -> impl Iterator<Item = &str> {
        let objects = self.trees.iter().flat_map(|tree| &tree.objects);
        objects.map(|object| object.id.as_str())
    }
}

/// The object of a tree that stands against linear equations, with the reason.
fn reason_against<'s>(system: &'s System, part: &Part) -> Option<(&'s str, &'static str)> {
    let model = system.model();
    for &object in &part.objects {
        let own = &model.objects[object];
        if own.is_inner() || model.reduction_of(object).is_some() {
            let owner = own.id.split('.').next().unwrap_or(&own.id);
            let reason = "it is reduced to vibration modes; give it `masses` in place of `modes`";
            return Some((owner, reason));
        }
        if own.strikes().is_some() {
            return Some((&own.id, "its contact is rigid, so that it has impacts"));
        }
    }
    None
}

impl NamedTree {
    fn of(system: &System, part: &Part) -> Self {
        let model = system.model();
        let problem = part.problem();
        let ends = problem.objects.iter().skip(1).map(|object| object.first);
        let ends = ends.chain([problem.masses.len()]);
        let each = part.objects.iter().zip(&problem.objects).zip(ends);
        let named = each.map(|((&index, tree), end)| {
            let object: &ObjectPart = &model.objects[index];
            let opens = match problem.masses[tree.first].pair {
                TreePair::Force { opens } => Some(opens),
                TreePair::Bilateral | TreePair::Form { .. } => None,
            };
            let driven_end = object.driven_end.map(|node| model.nodes[node].inertia);
            NamedObject {
                id: object.id.clone(),
                units: object.coordinate.units(),
                masses: tree.first..end,
                driver: tree.driver,
                opens,
                driven_end: driven_end.unwrap_or(0.0),
            }
        });
        Self {
            objects: named.collect(),
            equations: LinearTree::of(problem),
        }
    }

    /// Id of the object whose law moves the tree.
    pub(super) fn law(&self) -> &NamedObject {
        &self.objects[0]
    }

    /// The object at whose output shapes are 1: the last.
    pub(super) fn last(&self) -> &NamedObject {
        &self.objects[self.objects.len() - 1]
    }
}

impl NamedObject {
    /// The mass that is its output.
    pub(super) fn output(&self) -> usize {
        self.masses.end - 1
    }
}
