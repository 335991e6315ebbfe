//! Linear equations, frequency responses and orders.

use super::{Asked, in_time};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::report::findings::Findings;
use dam::report::linear::{
    equations_document, equations_findings, response_document, response_findings, response_rows,
};
use dam::report::orders::{crossing_rows, orders_document, orders_findings};
use dam::studies::linear::{FrequencyResponse, Linearisation, ResponseQuestion};
use dam::studies::orders::{OrdersAnswer, OrdersQuestion};
use dam::{Error, Scene};
use serde_json::Value;
use std::sync::Arc;

/// Linear equations of a scene.
pub(crate) struct Linear {
    asked: Asked,
    found: Linearisation,
}

/// The linear equations of a scene.
///
/// # Errors
/// Everything that is wrong with the scene; why it has none.
pub(crate) fn linearise(scene: Arc<Scene>, watch: &Watch) -> Result<Linear, Error> {
    let ready = scene.prepare_judging(ModelAssessment::Needed, &watch.budget())?;
    let found = in_time(ready.linearise()?, "the study", watch)?;
    let asked = Asked { scene, ready };
    Ok(Linear { asked, found })
}

impl Told for Linear {
    fn document(&self) -> Result<Value, Error> {
        let (name, hash) = (self.asked.name(), self.asked.hash());
        written(equations_document(name, hash, &self.found))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let source = self.asked.source();
        Ok(to(&equations_findings(
            self.asked.name(),
            &self.found,
            source,
        )))
    }
}

/// A response over the frequency.
pub(crate) struct Response {
    asked: Asked,
    found: FrequencyResponse,
}

/// The response of a scene over the frequency.
///
/// # Errors
/// Everything that is wrong with the scene or the question.
pub(crate) fn response(
    scene: Arc<Scene>,
    question: &ResponseQuestion,
    watch: &Watch,
) -> Result<Response, Error> {
    let mut ready = scene.prepare_judging(ModelAssessment::Needed, &watch.budget())?;
    let found = in_time(ready.response(question)?, "the study", watch)?;
    let asked = Asked { scene, ready };
    Ok(Response { asked, found })
}

impl Response {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&response_rows(&self.found))
    }
}

impl Told for Response {
    fn document(&self) -> Result<Value, Error> {
        let (name, hash) = (self.asked.name(), self.asked.hash());
        written(response_document(name, hash, &self.found))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let source = self.asked.source();
        Ok(to(&response_findings(
            self.asked.name(),
            &self.found,
            source,
        )))
    }
}

/// Orders of a scene.
pub(crate) struct Orders {
    asked: Asked,
    found: OrdersAnswer,
}

/// The orders of a scene and their resonances.
///
/// # Errors
/// Everything that is wrong with the scene or the question.
pub(crate) fn orders(
    scene: Arc<Scene>,
    question: &OrdersQuestion,
    watch: &Watch,
) -> Result<Orders, Error> {
    let ready = scene.prepare_judging(ModelAssessment::Needed, &watch.budget())?;
    let found = ready.orders_within(question, &watch.budget())?;
    let found = in_time(found, "the study", watch)?;
    let asked = Asked { scene, ready };
    Ok(Orders { asked, found })
}

impl Orders {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&crossing_rows(&self.found))
    }
}

impl Told for Orders {
    fn document(&self) -> Result<Value, Error> {
        let (name, hash) = (self.asked.name(), self.asked.hash());
        written(orders_document(name, hash, &self.found))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let source = self.asked.source();
        Ok(to(&orders_findings(self.asked.name(), &self.found, source)))
    }
}

/// A document, or why it cannot be written.
fn written(document: serde_json::Result<Value>) -> Result<Value, Error> {
    document.map_err(|error| vec![dam::fault::Fault::new("", error.to_string(), "")].into())
}
