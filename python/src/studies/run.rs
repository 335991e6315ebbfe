//! Runs.

use super::{Asked, in_time, interrupted, plain};
use crate::answer::{Figure, Table, Told};
use crate::work::Watch;
use dam::ask::ModelAssessment;
use dam::integrate::{Modes, Sink, SwitchEvent};
use dam::polynomial::Step;
use dam::report::abscissa::Abscissa;
use dam::report::accuracy;
use dam::report::diagram::Diagram;
use dam::report::findings::Findings;
use dam::report::machine::Machine;
use dam::report::run::{RunReport, findings};
use dam::report::verdict::{Verdict, verdict};
use dam::studies::cam::disc_cams;
use dam::studies::judgement::RunDocument;
use dam::studies::run::{RunResult, run};
use dam::studies::spread::{Spread, repeat_with_changes};
use dam::{Error, Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;
use std::time::Instant;

/// A run with all that was asked.
pub(crate) struct Run {
    asked: Asked,
    result: RunResult,
    spread: Option<Spread>,
}

/// Runs a scene. `spread`: whether it is run again with tiny changes of what should not matter.
///
/// # Errors
/// Everything that is wrong with it.
pub(crate) fn ask(scene: Arc<Scene>, spread: bool, watch: &Watch) -> Result<Run, Error> {
    let budget = watch.budget();
    let mut ready = Mechanism::of_within(scene.decode()?, ModelAssessment::Asked, &budget)?;
    let result = within(&ready, watch, (0.0, 1.0))?;
    let spread = match spread {
        true => Some(in_time(
            repeated(&mut ready, &result, watch)?,
            "the runs",
            watch,
        )?),
        false => None,
    };
    let asked = Asked { scene, ready };
    Ok(Run {
        asked,
        result,
        spread,
    })
}

fn repeated(ready: &mut Mechanism, result: &RunResult, watch: &Watch) -> Result<Spread, Error> {
    let budget = watch.budget();
    let found = repeat_with_changes(&ready.system, &ready.settings, result, &budget);
    let found = found.map_err(|faults| Error::from(ready.reading.places.diagnose(&faults)))?;
    let certificate = ready.certificate.take();
    ready.certificate = certificate.map(|known| known.with_spread(&found));
    Ok(found)
}

/// Least time (s) of so many runs, from the scene to its figures and columns.
///
/// # Errors
/// As of [`ask`].
pub(crate) fn least_time(scene: &Scene, repeats: usize, watch: &Watch) -> Result<f64, Error> {
    let mut least = f64::INFINITY;
    for _ in 0..repeats {
        let begun = Instant::now();
        let found = scene.run()?;
        least = least.min(begun.elapsed().as_secs_f64());
        drop(found);
        if watch.budget().is_interrupted() {
            return Err(interrupted("the runs"));
        }
    }
    Ok(least)
}

/// A run that is told of, as a part `from` … `to` of the whole.
pub(crate) fn within(
    ready: &Mechanism,
    watch: &Watch,
    (from, to): (f64, f64),
) -> Result<RunResult, Error> {
    let mut teller = Teller {
        watch,
        from,
        scale: (to - from) / ready.settings.duration,
    };
    let sinks: &mut [&mut dyn Sink] = &mut [&mut teller];
    let found = run(&ready.system, &ready.settings, &watch.budget(), sinks);
    let mut result = found.map_err(|faults| Error::from(ready.reading.places.diagnose(&faults)))?;
    result.figures.warnings.extend(ready.shortfalls());
    match watch.budget().is_interrupted() {
        true => Err(interrupted("the run")),
        false => Ok(result),
    }
}

/// Says how far a run is.
struct Teller<'w> {
    watch: &'w Watch,
    from: f64,
    scale: f64,
}

impl Sink for Teller<'_> {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _modes: &Modes) {
        self.watch.at(self.from + self.scale * step.end_time());
    }

    fn switch(&mut self, _event: &SwitchEvent<'_>) {}

    fn passes(&mut self, time: f64, _switches: u64) {
        self.watch.at(self.from + self.scale * time);
    }

    fn reads_within_steps(&self, _until: f64) -> bool {
        false
    }
}

impl Run {
    /// What each column of the record is of: object and quantity.
    pub(crate) fn is_trusted(&self) -> bool {
        self.result.is_trusted()
    }
}

impl Table for Run {
    fn heads(&self) -> Vec<(String, String)> {
        let columns = self.result.record.columns.iter();
        let heads = columns.map(|column| {
            let name = format!("{}.{}", column.object, column.quantity);
            (name, column.unit.to_owned())
        });
        let time = ("time".to_owned(), "s".to_owned());
        std::iter::once(time).chain(heads).collect()
    }

    fn values(&self, index: usize) -> &[f64] {
        let record = &self.result.record;
        match index.checked_sub(1) {
            None => &record.times,
            Some(index) => &record.columns[index].values,
        }
    }
}

impl Told for Run {
    fn document(&self) -> Result<Value, Error> {
        let mut document = plain(&RunDocument::of(&self.result.figures))?;
        if let Some(certificate) = &self.asked.ready.certificate {
            accuracy::add_to(&mut document, certificate);
        }
        if let Some(spread) = &self.spread {
            document["spread"] = plain(spread)?;
        }
        Ok(document)
    }

    /// The verdict in words and what it says: results have names of their own.
    fn answer(&self) -> Result<Option<Verdict>, Error> {
        let judged = verdict(&self.result.figures);
        Ok(Some(Verdict {
            headline: judged.headline.words("."),
            ..judged
        }))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let model = self.asked.ready.model();
        let cams = disc_cams(self.asked.ready.scene(), model);
        let report = RunReport {
            over: &Abscissa::Time,
            figures: &self.result.figures,
            record: &self.result.record,
            diagram: &Diagram::of(model),
            machine: Some(Machine { model, cams: &cams }),
            certificate: self.asked.ready.certificate.as_ref(),
            spread: self.spread.as_ref(),
        };
        let mut found = findings(&report, self.asked.source());
        let mut warnings = self.asked.ready.reading.warnings.lines();
        warnings.append(&mut found.warnings);
        found.warnings = warnings;
        Ok(to(&found))
    }

    fn figures(&self) -> Vec<Figure> {
        super::figures(&self.result.figures, self.asked.ready.certificate.as_ref())
    }
}
