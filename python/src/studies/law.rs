//! Laws of motion: by themselves, and as an object of a scene follows them.

use super::Asked;
use crate::answer::{Columns, Told};
use dam::motion::Law;
use dam::object::law::{AnyLaw, any_law, run_up_law};
use dam::report::findings::Findings;
use dam::report::law::{LawRow, cycle_findings, cycle_rows, law_findings, law_rows};
use dam::{Error, Scene};
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
    let law = spec.law()?;
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
    let ready = scene.prepare()?;
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
