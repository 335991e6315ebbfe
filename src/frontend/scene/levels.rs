//! Levels of the elastic objects of a scene.

use super::{SceneObject, StartSpec, TypedScene};
use crate::dynamics::builder::spec::{Level, Uniform};
use std::collections::BTreeMap;

/// A level for each of some objects, by their ids.
pub type Levels = BTreeMap<String, Level>;

/// Levels in words: `rocker 2 modes; shaft rigid`.
pub fn in_words(levels: &Levels) -> String {
    let words: Vec<String> = (levels.iter())
        .map(|(id, level)| format!("{id} {level}"))
        .collect();
    words.join("; ")
}

/// The uniform elastic objects of a scene, which may be given other levels.
#[derive(Clone, Debug)]
pub struct Elastic {
    /// Each with the level that the scene gives it; `None`: open, to be chosen.
    pub objects: BTreeMap<String, (Uniform, Option<Level>)>,
    start: StartSpec,
}

impl TypedScene {
    /// Its uniform elastic objects, as they are now.
    pub fn elastic(&self) -> Elastic {
        let uniform = |(id, one): (&String, &SceneObject)| {
            Some((id.clone(), one.object.chain()?.body.uniform()?))
        };
        Elastic {
            objects: self.objects.iter().filter_map(uniform).collect(),
            start: self.run.start.clone(),
        }
    }

    /// Gives open objects the levels chosen for them.
    pub(super) fn set_levels(&mut self, levels: &Levels) {
        if !levels.is_empty() {
            self.elastic().set(self, levels);
        }
    }
}

impl Elastic {
    /// Ids of the objects whose level is open.
    pub fn open_levels(&self) -> impl Iterator<Item = &String> {
        let open = self.objects.iter().filter(|(_, one)| one.1.is_none());
        open.map(|(id, _)| id)
    }

    /// Gives objects of the scene their levels. A start that is given holds for the whole
    /// body: each of its masses has the one displacement and the one speed.
    pub fn set(&self, scene: &mut TypedScene, levels: &Levels) {
        scene.run.start = self.start.clone();
        for (id, &level) in levels {
            let entry = scene.objects.get_mut(id);
            let chain = entry.and_then(|entry| entry.object.chain_mut());
            if let (Some((uniform, _)), Some(chain)) = (self.objects.get(id), chain) {
                chain.body = uniform.at(level);
                let masses = chain.masses();
                repeat_state_for_masses(&mut scene.run.start, id, masses);
            }
        }
    }
}

/// Gives each mass of an object the state of the whole.
fn repeat_state_for_masses(start: &mut StartSpec, id: &str, masses: usize) {
    let StartSpec::Explicit(states) = start else {
        return;
    };
    let Some((displacement, speed)) = states.get_mut(id) else {
        return;
    };
    if masses == 0 {
        states.remove(id);
        return;
    }
    for values in [displacement, speed] {
        let whole = values.first().copied();
        values.resize(masses, whole.unwrap_or(0.0));
    }
}
