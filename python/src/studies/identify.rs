//! Numbers of a scene from records of its motion.

use super::{Asked, columns, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::{IdentifyQuestion, ModelAssessment};
use dam::report::findings::Findings;
use dam::report::identify::{findings, rows};
use dam::studies::identify::Identification;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// Numbers of a scene from records of its motion.
pub(crate) struct Identified {
    asked: Asked,
    found: Identification,
}

/// Finds the numbers.
///
/// # Errors
/// Everything that is wrong with the scene, the records or the question.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: &IdentifyQuestion,
    watch: &Watch,
) -> Result<Identified, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = scene.identify(question, &budget)?;
    if !found.complete {
        return Err(interrupted("the fit"));
    }
    let asked = Asked { scene, ready };
    Ok(Identified { asked, found })
}

impl Identified {
    /// Whether every number is determined.
    pub(crate) fn is_answered(&self) -> bool {
        self.found.is_answered()
    }

    /// The text of the scene with the estimates; `None`: not all are determined.
    pub(crate) fn scene_text(&self) -> Option<String> {
        Some(self.found.scene_text.clone()).filter(|text| !text.is_empty())
    }

    /// The records beside their fit, as far as they are numbers: time, measured, fit, residual.
    pub(crate) fn columns(&self) -> Columns {
        columns(&rows(&self.found))
    }
}

impl Told for Identified {
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
