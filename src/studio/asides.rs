//! What windows ask besides the answers that follow the text, of a version of it.

use super::answer::is_judged;
use super::gallery;
use super::limits::{FIGURES, JUDGED, RUN};
use super::motion;
use super::starters;
use crate::ask::{Mechanism, ModelAssessment};
use crate::budget::Budget;
use crate::frontend::object::Registry;
use crate::frontend::scene::{
    BuiltIn, Catalogue, Document, LayeredCatalogue, Overrides, Template, schema, schema_of,
};
use crate::report::live;
use crate::studies::offer::offers;
use crate::studies::spread::repeat_with_changes;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A version of a text.
#[derive(Clone, Copy)]
pub(super) struct Aside<'a> {
    pub(super) version: u64,
    pub(super) name: &'a str,
    pub(super) text: &'a str,
    /// What it may copy from.
    pub(super) catalogue: &'a (dyn Catalogue + Sync),
}

/// What a new scene may begin with.
pub(super) fn beginnings() -> Value {
    let templates =
        Template::ALL.map(|one| json!({ "name": one.name(), "meaning": one.meaning() }));
    json!({ "templates": templates, "scenarios": gallery::scenarios() })
}

impl<'a> Aside<'a> {
    fn layered(&self) -> LayeredCatalogue<'a, dyn Catalogue + Sync + 'a, BuiltIn> {
        LayeredCatalogue(self.catalogue, &BuiltIn)
    }

    /// The schema of a scene: what may be written where.
    pub(super) fn schema(&self) -> Value {
        match Document::parse(self.name, self.text.as_bytes()) {
            Ok(document) => json!(schema_of(&document, &self.layered())),
            Err(_) => json!(schema(&Registry::standard())),
        }
    }

    /// What a scene may be made of: kinds, and objects of the catalogue.
    pub(super) fn available_parts(&self) -> Value {
        let registry = Registry::standard();
        let kinds = registry.kinds().iter().map(|kind| {
            let begins = starters::begins(kind.name, None);
            json!({ "kind": kind.name, "meaning": kind.doc, "begins": begins })
        });
        let catalogue = self.layered();
        let mut names = catalogue.names();
        names.sort_unstable();
        names.dedup();
        let objects = names.into_iter().filter_map(|name| {
            let (_, text) = catalogue.lookup(&name)?;
            let object: Value = serde_json::from_str(&text).ok()?;
            let word = |name: &str| object.get(name).and_then(Value::as_str).unwrap_or_default();
            let (kind, meaning) = (word("kind"), word("description"));
            let begins = starters::begins(kind, Some((&name, object.as_object()?)));
            Some(json!({ "from": name, "kind": kind, "meaning": meaning, "begins": begins }))
        });
        json!({ "kinds": kinds.collect::<Vec<_>>(), "objects": objects.collect::<Vec<_>>() })
    }

    /// The dynamic model and the equations; where the levels of objects are open, those of the
    /// levels that are chosen, with their error. `None`: the text is no scene, or none that can
    /// be run.
    pub(super) fn model(&self) -> Option<Value> {
        self.of_mechanism(ModelAssessment::Asked, |mechanism| {
            let [model, equations] = live::model_and_equations(&mechanism.system);
            let accuracy = mechanism.certificate.as_ref().map(live::accuracy);
            json!({ "model": accuracy.unwrap_or_default() + &model, "equations": equations })
        })
    }

    /// Its linkages, to be drawn; those of several inputs at values of the inputs by the object's
    /// id, as JSON. `None` as above.
    pub(super) fn linkages(&self, at: Option<&str>) -> Option<Value> {
        // What cannot be read is of nothing: they are drawn where they are put together.
        let at = at.and_then(|at| serde_json::from_str(at).ok());
        let at: BTreeMap<String, Vec<f64>> = at.unwrap_or_default();
        self.of_mechanism(
            ModelAssessment::Never,
            |mechanism| json!({ "linkages": live::sketches(&mechanism.system, &at) }),
        )
    }

    /// The motion of the object `id` with its curves, where it is made of segments; `faulty`: the
    /// text is no scene.
    pub(super) fn motion(&self, id: &str) -> Value {
        let found = self.motion_of(id);
        let (faulty, motion) = (found.is_none(), found.flatten());
        json!({ "version": self.version, "faulty": faulty, "motion": motion })
    }

    fn motion_of(&self, id: &str) -> Option<Option<Value>> {
        let document = Document::parse(self.name, self.text.as_bytes()).ok()?;
        let reading = document.scene(&self.layered(), &Overrides::none()).ok()?;
        let object = &reading.canonical["objects"][id];
        let by_arm = object.get("lever_arm").is_some();
        let budget = Budget::FREE.within(RUN);
        let mechanism = Mechanism::of_within(reading, ModelAssessment::Never, &budget).ok()?;
        Some(motion::motion(&mechanism, id, by_arm))
    }

    /// The figures of its run that it may expect, with how closely. `None` as above.
    pub(super) fn figures(&self) -> Option<Value> {
        self.of_mechanism(ModelAssessment::Asked, |mechanism| {
            let budget = Budget::FREE.within(FIGURES);
            let Ok(result) = mechanism.run_within(&budget) else {
                return json!({ "figures": [] });
            };
            if budget.is_spent() {
                return json!({ "figures": [], "refused": "the run takes too long to be repeated here" });
            }
            let moved = repeat_with_changes(&mechanism.system, &mechanism.settings, &result, &budget).ok();
            // What was not run to its end says nothing of errors.
            let moved = moved.filter(|_| !budget.is_spent());
            json!({ "figures": offers(&result, mechanism.certificate.as_ref(), moved.as_ref()) })
        })
    }

    fn of_mechanism(
        &self,
        judging: ModelAssessment,
        tell: impl FnOnce(&Mechanism) -> Value,
    ) -> Option<Value> {
        let document = Document::parse(self.name, self.text.as_bytes()).ok()?;
        let catalogue = self.layered();
        let read = || document.scene(&catalogue, &Overrides::none()).ok();
        let reading = read()?;
        let made = |reading, judging, time| {
            Mechanism::of_within(reading, judging, &Budget::FREE.within(time)).ok()
        };
        let judged = match judging {
            ModelAssessment::Never => None,
            _ if !is_judged(&reading.scene) => None,
            _ => made(read()?, judging, JUDGED),
        };
        // What takes too long to judge is told as it stands.
        let mechanism = match judged {
            Some(mechanism) => mechanism,
            None => made(reading, ModelAssessment::Never, RUN)?,
        };
        let mut told = tell(&mechanism);
        told["version"] = json!(self.version);
        Some(told)
    }
}
