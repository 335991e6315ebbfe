//! Steady motions.

use super::{Asked, in_time, plain};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::report::findings::Findings;
use dam::report::steady::{
    SteadyReport, periodic_findings, periodic_rows, rigid_findings, rigid_rows,
};
use dam::steady::Row;
use dam::studies::steady::{Answer, ROWS, RigidAnswer};
use dam::{Error, Scene};
use serde_json::{Value, json};
use std::sync::Arc;

/// A steady motion.
pub(crate) struct Steady {
    asked: Asked,
    found: Answer,
}

/// The steady motion that a scene's `steady` block asks for.
///
/// # Errors
/// Everything that is wrong with the scene; why there is no steady motion.
pub(crate) fn ask(scene: Arc<Scene>, watch: &Watch) -> Result<Steady, Error> {
    let ready = scene.prepare_judging(ModelAssessment::Needed, &watch.budget())?;
    let found = ready.steady_within(&watch.budget())?;
    let found = in_time(found, "the search", watch)?;
    let asked = Asked { scene, ready };
    Ok(Steady { asked, found })
}

impl Steady {
    pub(crate) fn columns(&self) -> Columns {
        let rows = match &self.found {
            Answer::Rigid(found) => self.shown(found, &found.motion.rows(ROWS), rigid_rows),
            Answer::Periodic(found) => periodic_rows(found),
        };
        super::columns(&rows)
    }

    fn shown<T>(
        &self,
        found: &RigidAnswer,
        rows: &[Row],
        to: impl FnOnce(&SteadyReport<'_>) -> T,
    ) -> T {
        to(&SteadyReport {
            title: self.asked.name(),
            cycle: found.cycle,
            figures: &found.figures,
            rows,
            regime: found.regime.as_ref(),
            flywheel: found.flywheel.as_ref(),
            agreement: Some(&found.agreement),
            halving: None,
        })
    }
}

impl Told for Steady {
    fn document(&self) -> Result<Value, Error> {
        let mut document = plain(&self.found)?;
        document["dam"] = json!(1);
        document["scene"] = json!(self.asked.name());
        document["hash"] = json!(self.asked.hash());
        let label = self.found.label(self.asked.ready.model());
        self.tell(|findings| findings.judge(&mut document, label.as_ref()))?;
        Ok(document)
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let source = self.asked.source();
        let label = self.found.label(self.asked.ready.model());
        let labelled = |mut findings: Findings<'_>| {
            findings.label(label.as_ref(), "the steady motion is");
            findings.leave_open(self.found.unjudged(self.asked.ready.model()));
            to(&findings)
        };
        Ok(match &self.found {
            Answer::Rigid(found) => self.shown(found, &found.motion.rows(ROWS), |shown| {
                labelled(rigid_findings(shown, source))
            }),
            Answer::Periodic(found) => {
                labelled(periodic_findings(self.asked.name(), found, source))
            }
        })
    }
}
