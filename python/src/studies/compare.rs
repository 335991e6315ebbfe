//! Comparisons.

use super::{Asked, in_time, run};
use crate::answer::{Columns, Figure, Told};
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::read::Node;
use dam::report::abscissa::Abscissa;
use dam::report::compare::{document, findings};
use dam::report::diagram::Diagram;
use dam::report::findings::Findings;
use dam::studies::compare::{Comparison, compare};
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// A comparison with the scene of its first run.
pub(crate) struct Compared {
    first: Asked,
    comparison: Comparison,
}

/// Runs a scene for several values of a parameter.
///
/// # Errors
/// Everything that is wrong with the scene for the first value with which anything is.
pub(crate) fn ask(
    scene: Arc<Scene>,
    address: &str,
    values: Vec<Node>,
    watch: &Watch,
) -> Result<Compared, Error> {
    let labels: Vec<String> = values.iter().map(Node::words).collect();
    let count = values.len() as f64;
    let mut first = None;
    let mut values = values.into_iter().zip(0u32..);
    let comparison = compare(address, &labels, |label| -> Result<_, Error> {
        let (value, at) = values.next().unwrap_or_else(|| (label.into(), 0));
        let scene = Scene::clone(&scene).set(address, value);
        let budget = watch.budget();
        let ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Asked, &budget)?;
        let part = (f64::from(at) / count, f64::from(at + 1) / count);
        let result = in_time(run::within(&ready, watch, part)?, "the comparison", watch)?;
        let scene = Arc::new(scene);
        first.get_or_insert(Asked { scene, ready });
        Ok(result)
    })?;
    let nothing = || dam::fault::Fault::new("", "a comparison needs a value at least", "");
    Ok(Compared {
        first: first.ok_or_else(|| Error::from(vec![nothing()]))?,
        comparison,
    })
}

impl Compared {
    /// A row a run: a column for each figure.
    pub(crate) fn columns(&self) -> Columns {
        let rows = self.comparison.table.rows.iter();
        let column = rows.map(|row| {
            let values = row.values.iter();
            let values = values.map(|value| value.unwrap_or(f64::NAN)).collect();
            (row.figure.clone(), row.unit.clone(), values)
        });
        Columns(column.collect())
    }
}

impl Told for Compared {
    fn document(&self) -> Result<Value, Error> {
        Ok(document(self.first.name(), &self.comparison))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let diagram = Diagram::of(self.first.ready.model());
        let runs = self.comparison.runs.iter();
        let warnings = runs.flat_map(|run| {
            let name = format!("{} = {}", self.comparison.over, run.label);
            let said = run.result.figures.warnings.iter();
            said.map(move |warning| format!("{name}: {warning}"))
        });
        let (name, source) = (self.first.name(), self.first.source());
        let warnings = warnings.collect();
        Ok(to(&findings(
            name,
            (&self.comparison, &Abscissa::Time),
            &diagram,
            warnings,
            source,
        )))
    }

    fn figures(&self) -> Vec<Figure> {
        let last = self.comparison.runs.last();
        last.map_or_else(Vec::new, |run| super::figures(&run.result.figures, None))
    }
}
