//! The best value of a parameter, and what a scene expects.

use super::{Asked, in_time, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::{FindQuestion, ModelAssessment};
use dam::report::find::findings;
use dam::report::findings::Findings;
use dam::report::requirements::{self, VerifiedScene};
use dam::studies::find::FoundValue;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// The best value of a parameter of a scene.
pub(crate) struct FoundBest {
    asked: Asked,
    found: FoundValue,
}

/// Finds the best value.
///
/// # Errors
/// Everything that is wrong with the scene or with the question.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: &FindQuestion,
    watch: &Watch,
) -> Result<FoundBest, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = scene.find(question, &budget)?;
    if !found.found.complete {
        return Err(interrupted("the search"));
    }
    let asked = Asked { scene, ready };
    Ok(FoundBest { asked, found })
}

impl FoundBest {
    /// Whether there is an answer that nothing unknown could change.
    pub(crate) fn is_answered(&self) -> bool {
        self.found.is_answered()
    }

    /// All places that were looked at: the parameter, the goal, the figures of the conditions.
    pub(crate) fn columns(&self) -> Columns {
        let samples = &self.found.found.samples;
        let column = |value: &dyn Fn(usize) -> Option<f64>| {
            (0..samples.len())
                .map(|at| value(at).unwrap_or(f64::NAN))
                .collect::<Vec<f64>>()
        };
        let axis = &self.found.span.axis;
        let parameter = column(&|at| Some(samples[at].value));
        let mut all = vec![(axis.path.clone(), self.found.unit.clone(), parameter)];
        if let Some(goal) = self.found.goal.as_ref().filter(|goal| !goal.is_parameter) {
            all.push((
                goal.of.clone(),
                goal.unit.clone(),
                column(&|at| samples[at].goal),
            ));
        }
        for (index, one) in self.found.conditions.iter().enumerate() {
            if all.iter().all(|(known, ..)| *known != one.figure) {
                let values = column(&|at| samples[at].figures[index]);
                all.push((one.figure.clone(), one.unit.clone(), values));
            }
        }
        Columns(all)
    }
}

impl Told for FoundBest {
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

/// A scene with what it expects, judged.
pub(crate) struct Requirements(VerifiedScene);

/// Judges what a scene expects.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn verify(scene: &Scene, watch: &Watch) -> Result<Requirements, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Asked, &budget)?;
    let requirements = in_time(ready.verify_within(&budget)?, "the judging", watch)?;
    Ok(Requirements(VerifiedScene {
        file: String::new(),
        scene: ready.scene().name.clone(),
        requirements: Ok(requirements),
    }))
}

impl Requirements {
    /// Whether all requirements hold.
    pub(crate) fn hold(&self) -> bool {
        self.0.holds()
    }

    /// The same as JUnit has it.
    pub(crate) fn junit(&self) -> String {
        requirements::junit(&[requirements::suite(&self.0)])
    }
}

impl Told for Requirements {
    fn document(&self) -> Result<Value, Error> {
        Ok(requirements::document(std::slice::from_ref(&self.0)))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        Ok(to(&requirements::findings(&self.0)))
    }
}
