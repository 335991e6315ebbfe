//! The tolerance of results of a scene.

use super::{Asked, columns, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::{ModelAssessment, ToleranceQuestion};
use dam::report::findings::Findings;
use dam::report::tolerance::{findings, rows};
use dam::studies::tolerance::Tolerances;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// The tolerance of results of a scene.
pub(crate) struct FoundTolerances {
    asked: Asked,
    found: Tolerances,
}

/// Finds the tolerances.
///
/// # Errors
/// Everything that is wrong with the scene or with the question.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: &ToleranceQuestion,
    watch: &Watch,
) -> Result<FoundTolerances, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = scene.tolerances(question, &budget)?;
    if !found.complete {
        return Err(interrupted("the study"));
    }
    let asked = Asked { scene, ready };
    Ok(FoundTolerances { asked, found })
}

impl FoundTolerances {
    /// Whether every result has a value in the middle of the tolerances.
    pub(crate) fn is_answered(&self) -> bool {
        self.found.is_answered()
    }

    /// The samples: the numbers and the results.
    pub(crate) fn columns(&self) -> Columns {
        let mut all = columns(&rows(&self.found));
        for (name, unit, _) in &mut all.0 {
            let own = self.found.figures.iter().find(|one| one.figure == *name);
            let known = own.map(|one| &one.unit).or_else(|| {
                let mut dimensions = self.found.dimensions.iter();
                Some(&dimensions.find(|one| one.paths.contains(name))?.unit)
            });
            known.map_or("", String::as_str).clone_into(unit);
        }
        all.0
            .retain(|(name, ..)| name != "verdict" && name != "cause");
        all
    }
}

impl Told for FoundTolerances {
    fn document(&self) -> Result<Value, Error> {
        Ok(self.found.document(self.asked.name()))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        Ok(to(&findings(
            self.asked.name(),
            &self.found,
            self.asked.source(),
        )))
    }
}
