//! Methods of integration beside each other.

use super::{Asked, interrupted, plain};
use crate::answer::{Columns, Told};
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::report::diagram::Diagram;
use dam::report::findings::Findings;
use dam::report::methods::{findings, sweep_findings, sweep_rows};
use dam::studies::RunSettings;
use dam::studies::axis::Axis;
use dam::studies::methods::sweep::{Sweep, sweep};
use dam::studies::methods::{Models, Plan, Study, models};
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// A study of methods.
pub(crate) struct Studied {
    asked: Asked,
    found: Study,
}

/// How accurate max|δ| is to be where models are chosen and nothing is said.
const USUAL: f64 = 0.01;

/// Speed against accuracy of the methods of a plan; `accuracy`: default the tolerance of the
/// scene. With `choosing` the least model that is accurate enough (default: 1 %) is studied, beside
/// the errors of all models.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn ask(
    scene: Arc<Scene>,
    accuracy: Option<f64>,
    choosing: bool,
    plan: impl FnOnce(&mut Plan),
    watch: &Watch,
) -> Result<Studied, Error> {
    let (ready, models) = match choosing {
        true => with_model(&scene, accuracy.unwrap_or(USUAL), watch)?,
        false => (
            scene.prepare_judging(ModelAssessment::Needed, &watch.budget())?,
            None,
        ),
    };
    let wanted = match &models {
        Some(models) => models.accuracy_of_methods(),
        None => accuracy.unwrap_or(ready.settings.tolerance),
    };
    let mut asked = Plan::new(wanted);
    plan(&mut asked);
    let mut found = ready.methods(&asked, &watch.budget(), &mut |now| {
        watch.at(now.done as f64 / now.total.max(1) as f64);
    })?;
    if !found.complete {
        return Err(interrupted("the study"));
    }
    if let Some(models) = models {
        found = found.with_models(models);
    }
    let asked = Asked { scene, ready };
    Ok(Studied { asked, found })
}

/// The scene with the least model that is accurate enough, and the errors of all models.
fn with_model(
    scene: &Scene,
    accuracy: f64,
    watch: &Watch,
) -> Result<(Mechanism, Option<Models>), Error> {
    let mut reading = scene.decode()?;
    let places = reading.places.clone();
    let diagnose = |faults: Vec<dam::fault::Fault>| Error::from(places.diagnose(&faults));
    let settings = RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
    let found = models(&mut reading.scene, &settings, accuracy, &watch.budget());
    let found = found.map_err(diagnose)?;
    let ready = Mechanism::of_within(reading, ModelAssessment::Never, &watch.budget())?;
    Ok((ready, Some(found)))
}

/// Most values of an axis: each is a study of its own.
const MOST_VALUES: usize = 1000;

/// A study of methods at every value of a parameter.
pub(crate) struct Swept {
    asked: Asked,
    found: Sweep,
}

/// Studies the methods of a plan at every value of an axis.
///
/// # Errors
/// Everything that is wrong with the scene at any value.
pub(crate) fn over(
    scene: Arc<Scene>,
    axis: &Axis,
    accuracy: Option<f64>,
    plan: impl FnOnce(&mut Plan),
    watch: &Watch,
) -> Result<Swept, Error> {
    let refuse = |what: String| Error::from(vec![dam::fault::Fault::new("", what, "")]);
    axis.check().map_err(refuse)?;
    if axis.count > MOST_VALUES {
        let what = format!("at most {MOST_VALUES} values are taken, each a study of its own");
        return Err(refuse(what));
    }
    let at = |x: f64| -> Result<Mechanism, Error> {
        crate::scene::with_setting(Scene::clone(&scene), &axis.setting(x))?
            .prepare_judging(ModelAssessment::Needed, &watch.budget())
    };
    let ready = at(axis.from)?;
    let mut asked = Plan::new(accuracy.unwrap_or(ready.settings.tolerance));
    plan(&mut asked);
    let found = sweep(
        axis,
        &asked,
        &watch.budget(),
        |x| at(x).map(|one| (one.system, one.settings)),
        |x, mut faults| {
            for fault in &mut faults {
                fault.message = format!("with {}: {}", axis.setting(x), fault.message);
            }
            ready.reading.places.diagnose(&faults).into()
        },
        &mut |index, now| {
            let done = now.done as f64 / now.total.max(1) as f64;
            watch.at((index as f64 + done) / axis.count.max(1) as f64);
        },
    )?;
    if !found.complete {
        return Err(interrupted("the study"));
    }
    let asked = Asked { scene, ready };
    Ok(Swept { asked, found })
}

impl Swept {
    /// A row a point of a value.
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&sweep_rows(&self.found))
    }
}

impl Told for Swept {
    fn document(&self) -> Result<Value, Error> {
        plain(&self.found)
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let diagram = Diagram::of(self.asked.ready.model());
        let (name, source) = (self.asked.name(), self.asked.source());
        Ok(to(&sweep_findings(name, &self.found, &diagram, source)))
    }
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
