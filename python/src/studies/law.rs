//! Laws of motion: by themselves, and as an object of a scene follows them.

use super::{Asked, interrupted};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::{LawComparison, LawQuestion, StrokeQuestion, Synthesis};
use dam::motion::Law;
use dam::object::law::{AnyLaw, any_law, run_up_law};
use dam::report::findings::Findings;
use dam::report::law::{
    LawRow, StrokeExtras, comparison_findings, comparison_rows, cycle_findings, cycle_rows,
    law_findings, law_rows, stroke_findings, stroke_rows,
};
use dam::studies::law::Figure;
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// A law by itself.
pub(crate) struct Shown {
    law: Law,
    row: LawRow,
    samples: usize,
}

/// A law by its name, or JSON as in a scene.
///
/// # Errors
/// There is no such law; everything wrong with its numbers.
pub(crate) fn ask(law: &str, run_up: bool, samples: usize) -> Result<Shown, Error> {
    let spec = match run_up {
        true => AnyLaw::RunUp(run_up_law(law)?),
        false => any_law(law)?,
    };
    let law = spec.read_law()?;
    let row = LawRow::of(&spec, &law);
    Ok(Shown { law, row, samples })
}

impl Shown {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&law_rows(&self.law, self.samples))
    }
}

impl Told for Shown {
    fn document(&self) -> Result<Value, Error> {
        Ok(self.row.document(&self.law))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        Ok(to(&law_findings(&self.row, &self.law)))
    }
}

/// What an object of a scene follows.
pub(crate) struct Followed {
    asked: Asked,
    object: String,
}

/// The whole cycle of what an object follows.
///
/// # Errors
/// Everything that is wrong with the scene; the object follows no law.
pub(crate) fn cycle(
    scene: Arc<Scene>,
    object: String,
    samples: usize,
) -> Result<(Followed, Columns), Error> {
    let ready = Mechanism::of(scene.decode()?)?;
    let found = ready.law_cycle(&object)?;
    let rows = cycle_rows(found.position, found.lever, found.units, samples);
    let columns = super::columns(&rows);
    let asked = Asked { scene, ready };
    Ok((Followed { asked, object }, columns))
}

impl Told for Followed {
    fn document(&self) -> Result<Value, Error> {
        let found = self.asked.ready.law_cycle(&self.object)?;
        Ok(found.document(self.asked.name()))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let found = self.asked.ready.law_cycle(&self.object)?;
        let followed = (found.position, found.lever);
        let source = self.asked.source();
        let (name, id) = (self.asked.name(), found.object);
        Ok(to(&cycle_findings(
            name,
            id,
            followed,
            &found.figures,
            found.units,
            source,
        )))
    }
}

/// Laws compared in a scene.
pub(crate) struct Compared {
    asked: Asked,
    at: String,
    by: Figure,
    found: LawComparison,
}

/// Compares laws at a place of a scene.
///
/// # Errors
/// There is no such figure; what is wrong with the question or with the scene.
pub(crate) fn compare(
    scene: Arc<Scene>,
    question: &LawQuestion,
    by: &str,
    watch: &Watch,
) -> Result<Compared, Error> {
    let known = Figure::ALL.into_iter().filter(|one| !one.is_constant());
    let by = known.clone().find(|one| one.name() == by).ok_or_else(|| {
        let names: Vec<&str> = known.map(Figure::name).collect();
        let message = format!("laws are ranked by {}, not by `{by}`", names.join(", "));
        Error::from(vec![dam::fault::Fault::new("", message, "")])
    })?;
    let found = scene.compare_laws(question, &watch.budget())?;
    if !found.complete {
        return Err(interrupted("the comparison"));
    }
    let ready = Mechanism::of(scene.decode()?)?;
    Ok(Compared {
        asked: Asked { scene, ready },
        at: question.at.clone(),
        by,
        found,
    })
}

impl Compared {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&comparison_rows(&self.found.laws))
    }
}

impl Told for Compared {
    fn document(&self) -> Result<Value, Error> {
        Ok(self.found.document(self.by))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let (name, source) = (self.asked.name(), self.asked.source());
        let (laws, trusted) = (&self.found.laws, self.found.trusted);
        let findings = comparison_findings(name, &self.at, laws, self.by, trusted, source);
        Ok(to(&findings))
    }
}

/// A stroke that was worked out.
pub(crate) struct Worked(Synthesis);

/// Works a stroke out.
///
/// # Errors
/// What is wrong with the question.
pub(crate) fn stroke(question: &StrokeQuestion) -> Result<Worked, Error> {
    question.answer().map(Worked)
}

impl Worked {
    pub(crate) fn columns(&self, samples: usize) -> Columns {
        super::columns(&stroke_rows(&self.0.stroke, self.0.unit, samples))
    }
}

impl Told for Worked {
    fn document(&self) -> Result<Value, Error> {
        Ok(self.0.document())
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let extras = StrokeExtras {
            against_none: self.0.against_none(),
            criterion: self.0.criterion(),
        };
        let (words, stroke) = (self.0.words(), &self.0.stroke);
        Ok(to(&stroke_findings(&words, stroke, self.0.unit, extras)))
    }
}
