//! `dam law compare`: laws ranked by constants and by what a scene makes of them.

use super::args::{CompareArgs, Form, RankBy};
use super::{deliver, told};
use crate::cli::failure::Failure;
use crate::cli::input::{Input, Ready};
use crate::cli::interrupt;
use crate::cli::run::run_with_progress;
use crate::cli::status::Status;
use crate::dynamics::model::{Model, NodeMotion};
use crate::frontend::object::law::stroke_law;
use crate::kinematics::motion::{DriveMotion, Law, LawName};
use crate::report::findings::Source;
use crate::report::law::{comparison_findings, comparison_rows};
use crate::studies::RunSettings;
use crate::studies::law::{ComparedLaw, Figure, LawResponse, lift_off, response};
use serde_json::json;
use std::f64::consts::TAU;

/// Fewest samples of a run: residual vibration is taken from them.
const SAMPLES: usize = 20_000;

/// Fewest cycles of a run, so that the last one can be taken for steady.
const CYCLES: f64 = 4.0;

/// Most laws of one comparison.
const MOST: usize = 30;

pub(super) fn command(args: &CompareArgs) -> Result<Status, Failure> {
    let names = laws(args)?;
    let input = Input::load(&args.scene)?;
    let mut keeping = None;
    let (mut compared, mut trusted, mut interrupted) = (Vec::new(), true, false);
    for name in &names {
        let one = Comparison {
            input: &input,
            args,
            law: format!("{}={}", args.at, quoted(name)),
        };
        let spec = stroke_law(name)?;
        let law = Law::of_stroke(&spec).map_err(|faults| told(&faults, ""))?;
        match one.response()? {
            Some((found, sound)) => {
                keeping.get_or_insert_with(interrupt::keep);
                trusted &= sound;
                compared.push(ComparedLaw {
                    name: spec.words(),
                    constants: law.constants(),
                    response: found,
                });
            }
            None => {
                interrupted = true;
                break;
            }
        }
    }
    let by = figure(args.by);
    let document = {
        let places: serde_json::Map<String, serde_json::Value> = Figure::ALL
            .into_iter()
            .map(|figure| (figure.name().to_owned(), json!(figure.ranks(&compared))))
            .collect();
        json!({ "dam": 1, "by": by.name(), "laws": compared, "places": places })
    };
    let ready = input.prepare(&[])?;
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let source = Source::scene(input.text(), hash);
    let found = comparison_findings(name, &args.at, &compared, by, trusted, source);
    let rows = comparison_rows(&compared);
    let form = if args.csv { Form::Csv } else { Form::Text };
    let shown = (args.scene.json, form);
    deliver(
        (&args.out, args.scene.quiet),
        (&found, document),
        &rows,
        shown,
    )?;
    Ok(match (interrupted, trusted) {
        (true, _) => interrupt::status(),
        (false, true) => Status::Answered,
        (false, false) => Status::NotTrusted,
    })
}

/// The laws asked for, or all named ones.
fn laws(args: &CompareArgs) -> Result<Vec<String>, Failure> {
    let names: Vec<String> = match args.law.as_slice() {
        [] => LawName::ALL.map(|name| name.name().to_owned()).to_vec(),
        given => given.to_vec(),
    };
    if names.len() < 2 || names.len() > MOST {
        let message = format!(
            "between 2 and {MOST} laws are compared, found {}",
            names.len()
        );
        return Err(Failure::Other(message));
    }
    Ok(names)
}

/// A law as the value of an override.
fn quoted(law: &str) -> String {
    let text = law.trim();
    match (text.strip_prefix("scca:"), text.starts_with('{')) {
        (Some(numbers), _) => match numbers.split_once(',') {
            Some((b, d)) => format!("{{\"scca\": {{\"b\": {b}, \"d\": {d}}}}}"),
            None => text.to_owned(),
        },
        (None, true) => text.to_owned(),
        (None, false) => json!(text).to_string(),
    }
}

fn figure(by: RankBy) -> Figure {
    match by {
        RankBy::Residual => Figure::Residual,
        RankBy::Deviation => Figure::Deviation,
        RankBy::ContactForce => Figure::ContactForce,
        RankBy::DriverTorque => Figure::DriverTorque,
        RankBy::LiftOff => Figure::LiftOff,
    }
}

/// Comparison of laws: one law in the scene.
struct Comparison<'a> {
    input: &'a Input,
    args: &'a CompareArgs,
    law: String,
}

impl Comparison<'_> {
    /// The response, and whether its numbers are to be trusted; `None`: interrupted.
    fn response(&self) -> Result<Option<(LawResponse, bool)>, Failure> {
        let ready = self.input.prepare(std::slice::from_ref(&self.law))?;
        let (object, drive, speed) = self.place(ready.system.model())?;
        let settings = settings(&ready, speed, SAMPLES);
        let quiet = self.args.scene.quiet;
        let result = run_with_progress(&ready, &settings, interrupt::budget(), quiet)?;
        if result.outcome.stop.is_from_outside() {
            return Ok(None);
        }
        if !result.is_complete() {
            let why = result.figures.run.stopped_because.clone();
            let why = why.unwrap_or_else(|| "no reason given".to_owned());
            return Err(Failure::Other(format!(
                "{}: the run stopped: {why}",
                self.law
            )));
        }
        let mut found = response(ready.system.model(), object, &result)?;
        let has_pair = found.separations.is_some();
        if self.args.lift_off && has_pair {
            let search = lift_off(speed.abs(), |tried| {
                self.opens(&drive, object, tried * speed.signum())
            });
            match search {
                Ok(edge) => found.lift_off = Some(edge),
                Err(Ended::Interrupted) => return Ok(None),
                Err(Ended::Failed(failure)) => return Err(failure),
            }
        }
        Ok(Some((found, result.is_trusted())))
    }

    /// Whether the pair opens in the steady window at a speed of the drive.
    fn opens(&self, drive: &str, object: usize, speed: f64) -> Result<bool, Ended> {
        let overrides = [self.law.clone(), format!("{drive}.motion.speed={speed}")];
        let ready = self.input.prepare(&overrides)?;
        let settings = settings(&ready, speed, 100);
        let result = run_with_progress(&ready, &settings, interrupt::budget(), true)?;
        if result.outcome.stop.is_from_outside() {
            return Err(Ended::Interrupted);
        }
        let id = &ready.system.model().objects[object].id;
        let figures = result.figures.objects.get(id);
        let pair = figures.and_then(|figures| figures.pair.as_ref());
        // A run that gave up (chatter, too many switches) is no working order.
        let works = pair.and_then(|pair| pair.in_working_order);
        Ok(!works.unwrap_or(false))
    }

    /// The object whose law is exchanged, the drive at its root, and its speed (rad/s).
    fn place(&self, model: &Model) -> Result<(usize, String, f64), Failure> {
        let id = self.args.at.split('.').next().unwrap_or("");
        let index = model.objects.iter().position(|part| part.id == id);
        let object = index.ok_or_else(|| {
            let message = format!("--at {}: there is no object `{id}`", self.args.at);
            Failure::Other(message)
        })?;
        let mut root = object;
        while let Some(driver) = model.objects[root].driver() {
            root = driver;
        }
        let part = &model.objects[root];
        if !part.is_drive() {
            let message = format!(
                "laws are compared behind one drive: `{}` has several inputs",
                part.id
            );
            return Err(Failure::Other(message));
        }
        match &model.nodes[part.nodes[0]].motion {
            NodeMotion::Prescribed {
                motion: DriveMotion::Constant { speed, .. },
                ..
            } if *speed != 0.0 => Ok((object, part.id.clone(), *speed)),
            _ => Err(Failure::Other(format!(
                "laws are compared in steady motion: give the drive `{}` a constant speed",
                part.id
            ))),
        }
    }
}

/// The scene's settings over enough whole cycles with enough samples.
fn settings(ready: &Ready, speed: f64, samples: usize) -> RunSettings {
    let cycle = TAU / speed.abs();
    let asked = (ready.settings.duration / cycle * (1.0 - 1e-12)).ceil();
    RunSettings {
        duration: cycle * asked.clamp(CYCLES, 1000.0),
        samples: ready.settings.samples.max(samples),
        window: None,
        of_accuracy: None,
        ..ready.settings.clone()
    }
}

/// Why a search for lift-off ended early.
enum Ended {
    Interrupted,
    Failed(Failure),
}

impl From<Failure> for Ended {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}
