//! The best values of several variables.

use super::{Asked, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::{ModelAssessment, OptimizeQuestion};
use dam::report::findings::Findings;
use dam::report::optimize::findings;
use dam::studies::optimize::Optimization;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// The best values of several variables of a scene.
pub(crate) struct FoundOptimum {
    asked: Asked,
    found: Optimization,
}

/// Finds the best values.
///
/// # Errors
/// Everything that is wrong with the scene or with the question.
pub(crate) fn ask(
    scene: Arc<Scene>,
    question: &OptimizeQuestion,
    watch: &Watch,
) -> Result<FoundOptimum, Error> {
    let budget = watch.budget();
    let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Never, &budget)?;
    let found = scene.optimize(question, &budget)?;
    if !found.complete {
        return Err(interrupted("the search"));
    }
    let asked = Asked { scene, ready };
    Ok(FoundOptimum { asked, found })
}

impl FoundOptimum {
    /// Whether there is an optimum that stands.
    pub(crate) fn is_answered(&self) -> bool {
        self.found.is_answered()
    }

    /// The text of the scene with the best values; `None`: there are none.
    pub(crate) fn scene_text(&self) -> Option<String> {
        let text = &self.found.scene_text;
        (!text.is_empty()).then(|| text.clone())
    }

    /// Where the starts ended: the variables and the goal.
    pub(crate) fn columns(&self) -> Columns {
        let starts = &self.found.starts;
        let column = |value: &dyn Fn(usize) -> Option<f64>| {
            (0..starts.len())
                .map(|at| value(at).unwrap_or(f64::NAN))
                .collect::<Vec<f64>>()
        };
        let variables = self.found.variables.iter().enumerate();
        let mut all: Vec<(String, String, Vec<f64>)> = variables
            .map(|(own, variable)| {
                let values = column(&|at| starts[at].to.as_ref().map(|to| to[own]));
                (variable.path.clone(), variable.unit.clone(), values)
            })
            .collect();
        let goal = &self.found.goal;
        if !goal.is_parameter {
            let values = column(&|at| starts[at].goal);
            all.push((goal.of.clone(), goal.unit.clone(), values));
        }
        Columns(all)
    }
}

impl Told for FoundOptimum {
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
