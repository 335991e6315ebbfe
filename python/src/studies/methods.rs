//! Methods of integration beside each other.

use super::{Asked, interrupted, plain};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::report::diagram::Diagram;
use dam::report::findings::Findings;
use dam::report::methods::findings;
use dam::studies::methods::{Plan, Study};
use dam::{Error, Scene};
use serde_json::Value;

/// A study of methods.
pub(crate) struct Studied {
    asked: Asked,
    found: Study,
}

/// Speed against accuracy of the methods of a plan; `accuracy`: default the tolerance of the
/// scene.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn ask(
    scene: Scene,
    accuracy: Option<f64>,
    plan: impl FnOnce(&mut Plan),
    watch: &Watch,
) -> Result<Studied, Error> {
    let ready = scene.prepare_within(&watch.budget())?;
    let mut asked = Plan::new(accuracy.unwrap_or(ready.settings.tolerance));
    plan(&mut asked);
    let found = ready.methods(&asked, &watch.budget(), &mut |now| {
        watch.at(now.done as f64 / now.total.max(1) as f64);
    })?;
    if !found.complete {
        return Err(interrupted("the study"));
    }
    let asked = Asked { scene, ready };
    Ok(Studied { asked, found })
}

impl Studied {
    /// A row a point.
    pub(crate) fn columns(&self) -> Columns {
        let points = || self.found.methods.iter().flat_map(|line| &line.points);
        let column = |name: &str, unit: &str, of: &dyn Fn(&Value) -> Option<f64>| {
            let values = points().map(|point| of(&plain(point).unwrap_or_default()));
            let values = values.map(|value| value.unwrap_or(f64::NAN)).collect();
            (name.to_owned(), unit.to_owned(), values)
        };
        let number = |name: &'static str| move |point: &Value| point[name].as_f64();
        Columns(vec![
            column("tolerance", "", &number("tolerance")),
            column("step", "s", &number("step")),
            column("error", "", &number("error")),
            column("seconds", "s", &number("seconds")),
            column("evaluations", "", &number("evaluations")),
        ])
    }
}

impl Told for Studied {
    fn document(&self) -> Result<Value, Error> {
        plain(&self.found)
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let diagram = Diagram::of(self.asked.ready.model());
        Ok(to(&findings(&self.found, &diagram, self.asked.source())))
    }
}
