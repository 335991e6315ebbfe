//! What a study of rigid bodies leaves out of a scene.

use crate::dynamics::model::{Model, NodeMotion};
use serde::Serialize;

/// The label of a result that was computed without the elasticity of a scene's objects.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rigid {
    /// Elastic objects that were taken for rigid.
    pub without: Vec<String>,
    /// Commands that include their elasticity.
    pub included_by: Vec<&'static str>,
}

impl Rigid {
    /// The label of a result of a model; `None`: nothing in it is elastic.
    pub fn label(model: &Model, included_by: &[&'static str]) -> Option<Self> {
        let without = elastic_objects(model);
        (!without.is_empty()).then(|| Self {
            without,
            included_by: included_by.to_vec(),
        })
    }

    /// In words; `what` was computed so.
    pub fn words(&self, what: &str) -> String {
        let commands = self.included_by.iter().map(|name| format!("`{name}`"));
        let include = match self.included_by.len() {
            1 => "includes",
            _ => "include",
        };
        format!(
            "rigid: {what} computed without the elasticity of {}; {} {include} it",
            self.without.join(", "),
            commands.collect::<Vec<_>>().join(" and ")
        )
    }
}

/// The objects with masses on springs; those of modes are inner parts of theirs.
pub fn elastic_objects(model: &Model) -> Vec<String> {
    let is_mass = |&node: &usize| matches!(model.nodes[node].motion, NodeMotion::Mass { .. });
    let mut found: Vec<String> = Vec::new();
    for part in &model.objects {
        let inner = part.id.rsplit_once('.').filter(|_| !part.is_reported());
        let id = inner.map_or(part.id.as_str(), |(object, _)| object);
        if part.nodes.iter().any(is_mass) && found.iter().all(|known| known != id) {
            found.push(id.to_owned());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Rigid, elastic_objects};
    use crate::ask::Scene;

    #[test]
    fn elastic_objects_are_named_once_at_every_level() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/scenarios/rocker/two_masses.json"
        );
        for (set, named) in [
            ("rocker.masses=2", true),
            ("rocker.masses=5", true),
            ("rocker.masses=0", false),
        ] {
            let scene = Scene::read(path).unwrap();
            let (name, value) = set.split_once('=').unwrap();
            let count: u32 = value.parse().unwrap();
            let scene = scene.set(name, count);
            let mechanism = scene.prepare().unwrap();
            let found = elastic_objects(mechanism.model());
            assert_eq!(
                found,
                ["rocker"].map(str::to_owned)[..usize::from(named)],
                "{set}"
            );
            let label = Rigid::label(mechanism.model(), &["dam run"]);
            let words = label.map(|label| label.words("the forces are"));
            let expected = named.then(|| {
                "rigid: the forces are computed without the elasticity of rocker; `dam run` \
                 includes it"
                    .to_owned()
            });
            assert_eq!(words, expected);
        }
    }
}
