//! The springs that close a contact, as loads of the model.

use crate::dynamics::model::Model;

/// Unit of the preload of the spring that closes the contact of an object (index in the model): of
/// the object itself, or of the one object behind it that has springs.
pub fn preload_unit(model: &Model, object: usize) -> &'static str {
    let mut members = vec![object];
    let mut known = 0;
    while known < members.len() {
        let driven = model.objects.iter().enumerate().filter(|(_, part)| {
            (part.inputs.iter()).any(|input| members[known..].contains(&input.driver))
        });
        let driven: Vec<usize> = driven.map(|(index, _)| index).collect();
        known = members.len();
        members.extend(
            driven
                .into_iter()
                .filter(|one| !members.contains(one))
                .collect::<Vec<_>>(),
        );
    }
    let has_spring = |&&index: &&usize| {
        let nodes = &model.objects[index].nodes;
        (model.loads.iter())
            .any(|load| nodes.contains(&load.node) && load.law.as_spring().is_some())
    };
    let with: Vec<usize> = members.iter().filter(has_spring).copied().collect();
    let owner = match with.as_slice() {
        [only] => *only,
        _ => object,
    };
    model.objects[owner].coordinate.units()[1]
}

/// The springs on a follower.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ClosingLoads {
    /// Indices of the loads in the model.
    loads: Vec<usize>,
    /// Sense in which the pair opens.
    opens: f64,
    /// Their preload, positive where it closes the contact (N or N·m).
    pub(super) preload: f64,
    /// The most by which the contact force grows with the preload.
    pub(super) most_leverage: f64,
}

impl ClosingLoads {
    /// The springs on one mass of the object itself (index in the model).
    ///
    /// # Errors
    /// In words: there are none, or they act on several masses.
    pub(super) fn of(model: &Model, object: usize) -> Result<Self, String> {
        let part = &model.objects[object];
        let loads = model.loads.iter().enumerate();
        let springs = loads.filter_map(|(index, load)| {
            let spring = load.law.as_spring()?;
            let is_own = part.nodes.contains(&load.node);
            is_own.then_some((index, load.node, spring.force))
        });
        let springs: Vec<(usize, usize, f64)> = springs.collect();
        let Some(&(_, node, _)) = springs.first() else {
            return Err(
                "it has no closing spring of its own: the preload that it needs is known only if \
                 all objects are rigid"
                    .to_owned(),
            );
        };
        if springs.iter().any(|(_, other, _)| *other != node) {
            return Err("its springs act on several masses".to_owned());
        }
        let opens = model.pair(part).map_or(1.0, |pair| pair.opens);
        Ok(Self {
            loads: springs.iter().map(|(index, ..)| *index).collect(),
            opens,
            preload: springs.iter().map(|(.., force)| -opens * force).sum(),
            most_leverage: 1.0,
        })
    }

    /// The model with another preload of the springs, which the first of them supplies.
    pub(super) fn model_with(&self, model: &Model, preload: f64) -> Model {
        let mut changed = model.clone();
        let Some(&first) = self.loads.first() else {
            return changed;
        };
        let force = -self.opens * (preload - self.preload);
        changed.loads[first].law = model.loads[first].law.spring_with(force);
        // (What the scene states of this load no longer holds.)
        changed.stated.loads.remove(&first);
        changed
    }
}
