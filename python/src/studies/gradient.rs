//! Derivatives of results by numbers of a scene.

use super::{Asked, in_time};
use crate::answer::Told;
use crate::work::Watch;
use dam::ask::{GradientQuestion, ModelAssessment};
use dam::report::findings::Findings;
use dam::report::gradient::findings;
use dam::studies::gradient::Gradient;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// Derivatives of results of a scene.
pub(crate) struct Derivatives {
    asked: Asked,
    found: Gradient,
}

/// Finds the derivatives.
///
/// # Errors
/// Everything that is wrong with the scene or with the question.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: &GradientQuestion,
    watch: &Watch,
) -> Result<Derivatives, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = in_time(scene.gradient(question, &budget)?, "the study", watch)?;
    let asked = Asked { scene, ready };
    Ok(Derivatives { asked, found })
}

impl Derivatives {
    /// Whether all derivatives are determined and none failed the check.
    pub(crate) fn is_answered(&self) -> bool {
        self.found.is_answered()
    }
}

impl Told for Derivatives {
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
