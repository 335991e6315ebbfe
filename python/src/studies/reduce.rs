//! The smallest scene.

use super::{Asked, in_time};
use crate::answer::Told;
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::report::diagram::Diagram;
use dam::report::findings::{Findings, Source};
use dam::report::reduce::{document, findings};
use dam::studies::reduce::Reduction;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// A scene made smaller.
pub(crate) struct Reduced {
    asked: Asked,
    found: Reduction,
}

/// The smallest scene that gives figures within their accuracy.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn ask(scene: Arc<Scene>, watch: &Watch) -> Result<Reduced, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = in_time(scene.reduce_within(&budget)?, "the search", watch)?;
    let asked = Asked { scene, ready };
    Ok(Reduced { asked, found })
}

impl Reduced {
    /// The scene that is left.
    pub(crate) fn scene(&self) -> Scene {
        Scene::of(self.found.document.clone())
    }

    /// Whether its figures are within their accuracy.
    pub(crate) fn holds(&self) -> bool {
        self.found.holds()
    }
}

impl Told for Reduced {
    fn document(&self) -> Result<Value, Error> {
        Ok(document(&self.found))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        // (What was given stands for one mass where the level is open.)
        let reduced = Mechanism::of(self.scene().decode()?)?;
        let diagram = Diagram::of(reduced.model());
        let source = Source::scene(self.found.document.text(), self.asked.hash());
        Ok(to(&findings(&self.found, &diagram, source)))
    }
}
