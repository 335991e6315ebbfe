//! Laws of motion compared at a place of a scene: each takes the other's place, and the scene runs.

use super::cam::lift_off_of_drive;
use super::ended::NoResult;
use super::{Mechanism, ModelAssessment, Scene};
use crate::Error;
use crate::dynamics::model::{Model, NodeMotion};
use crate::frontend::object::law::stroke_law;
use crate::kinematics::motion::law::LawSpec;
use crate::kinematics::motion::{DriveMotion, Law, LawName};
use crate::studies::judgement::Judgement;
use crate::studies::law::{ComparedLaw, Figure, LawResponse, LiftOff, lift_off, response};
use crate::studies::run::RunResult;
use crate::studies::{Control, RunSettings};
use serde_json::{Map, Value, json};
use std::f64::consts::TAU;

/// Fewest samples of a run: residual vibration is taken from them.
const SAMPLES: usize = 20_000;
/// Samples of a run that only tells whether the pair opens.
const FEW: usize = 100;
/// Fewest and most cycles of a run, so that the last one can be taken for steady.
const CYCLES: [f64; 2] = [4.0, 1000.0];
/// Most laws of one comparison.
const MOST: usize = 30;

/// Which laws are compared, and where.
#[derive(Clone, Debug, Default)]
pub struct LawQuestion {
    /// Where the law stands in the scene: `valve.position.cam.law`.
    pub at: String,
    /// The laws: a name, `scca:B,D`, or JSON as in a scene; all named ones, if empty.
    pub laws: Vec<String>,
    /// Whether the speed of the drive at which the pair begins to open is searched for (some
    /// twenty runs a law).
    pub lift_off: bool,
}

/// Laws of motion with what a mechanism makes of them.
#[derive(Clone, Debug)]
pub struct LawComparison {
    /// The laws, in the order in which they were asked for.
    pub laws: Vec<ComparedLaw>,
    /// Whether the numbers of all runs are to be trusted.
    pub trusted: bool,
    /// False where it was ended from outside: the laws until then.
    pub complete: bool,
}

impl LawComparison {
    /// The JSON document. `by`: the figure that the laws are ranked by.
    pub fn document(&self, by: Figure) -> Value {
        let places = Figure::ALL
            .map(|figure| (figure.name().to_owned(), json!(figure.ranks(&self.laws))))
            .into_iter()
            .collect::<Map<_, _>>();
        json!({ "dam": 1, "by": by.name(), "laws": self.laws, "places": places })
    }
}

impl Scene {
    /// Compares laws at a place of the scene: constants, residual vibration, deviation, contact
    /// force, the drive's torque, and the speed of lift-off where it is asked for.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::LawQuestion;
    /// use dam::studies::Control;
    ///
    /// let scene = Scene::read("scenarios/cams/flat_tappet.json")?;
    /// let question = LawQuestion {
    ///     at: "valve.position.cam.law".to_owned(),
    ///     laws: vec!["3-4-5".to_owned(), "modified_sine".to_owned()],
    ///     lift_off: false,
    /// };
    /// let found = scene.compare_laws(&question, &Control::default())?;
    /// assert!(found.laws.iter().all(|law| law.response.contact_force > 0.0));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// A law is none, or too few or too many are given; there is no law at the place; the drive
    /// behind it has no constant speed; what is wrong with the scene, or stops it.
    pub fn compare_laws(
        &self,
        question: &LawQuestion,
        control: &Control<'_>,
    ) -> Result<LawComparison, Error> {
        let prepare = |settings: &[String]| {
            self.with_arguments(settings)
                .prepare_judging(ModelAssessment::Needed, control)
        };
        let run = |ready: &Mechanism, settings: &RunSettings, _| {
            let found = crate::studies::run::run(&ready.system, settings, control, &mut []);
            found.map_err(|faults| ready.diagnose(&faults))
        };
        compare(question, control, prepare, run)
    }
}

/// Compares laws. `prepare`: the scene with further settings made ready; `run`: runs it, `true`
/// where only the opening of the pair is looked for.
///
/// # Errors
/// As of [`Scene::compare_laws`].
pub(crate) fn compare<E: From<Error>>(
    question: &LawQuestion,
    control: &Control<'_>,
    prepare: impl FnMut(&[String]) -> Result<Mechanism, E>,
    run: impl FnMut(&Mechanism, &RunSettings, bool) -> Result<RunResult, E>,
) -> Result<LawComparison, E> {
    let laws = laws(&question.laws)?;
    let mut trial = Trial {
        question,
        control,
        prepare,
        run,
        trusted: true,
    };
    let mut compared = Vec::new();
    for (text, spec) in &laws {
        let law = Law::of_stroke(spec).map_err(Error::from)?;
        let setting = format!("{}={}", question.at, law_as_setting(text));
        match trial.response(&setting) {
            Ok(response) => compared.push(ComparedLaw {
                name: spec.words(),
                constants: law.constants(),
                response,
            }),
            Err(NoResult::Interrupted) => break,
            Err(NoResult::Failed(error)) => return Err(error),
        }
    }
    Ok(LawComparison {
        complete: compared.len() == laws.len(),
        laws: compared,
        trusted: trial.trusted,
    })
}

/// The laws asked for, or all named ones.
fn laws(given: &[String]) -> Result<Vec<(String, LawSpec)>, Error> {
    let names: Vec<String> = match given {
        [] => LawName::ALL.map(|name| name.name().to_owned()).to_vec(),
        given => given.to_vec(),
    };
    if names.len() < 2 || names.len() > MOST {
        return Err(Error::question(format!(
            "between 2 and {MOST} laws are compared, found {}",
            names.len()
        )));
    }
    let read = |name: String| Ok((stroke_law(&name)?, name));
    let read = names.into_iter().map(read);
    read.map(|one| one.map(|(spec, name)| (name, spec)))
        .collect()
}

/// A law as the value of a setting.
fn law_as_setting(law: &str) -> String {
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

/// The scene in which the laws take each other's place.
struct Trial<'a, P, R> {
    question: &'a LawQuestion,
    control: &'a Control<'a>,
    prepare: P,
    run: R,
    trusted: bool,
}

impl<P, R> Trial<'_, P, R> {
    fn response<E: From<Error>>(&mut self, law: &str) -> Result<LawResponse, NoResult<E>>
    where
        P: FnMut(&[String]) -> Result<Mechanism, E>,
        R: FnMut(&Mechanism, &RunSettings, bool) -> Result<RunResult, E>,
    {
        let ready = (self.prepare)(&[law.to_owned()]).map_err(NoResult::Failed)?;
        let (object, drive, speed) = object_drive_and_speed(&self.question.at, ready.model())?;
        let result = self.motion(&ready, speed, SAMPLES)?;
        if !result.is_complete() {
            let why = result.figures.run.stopped_because.clone();
            let why = why.unwrap_or_else(|| "no reason given".to_owned());
            return Err(Error::question(format!("{law}: the run stopped: {why}")).into());
        }
        let found = response(ready.model(), object, &result);
        let mut found = found.map_err(Error::question)?;
        if self.question.lift_off && found.separations.is_some() {
            found.lift_off = Some(match lift_off_of_drive(&ready, object, self.control)? {
                Some(known) => known.ok_or(NoResult::Interrupted)?,
                // (No force closes its contact.)
                None => self.lift_off_by_runs(law, (object, &drive, speed))?,
            });
        }
        self.trusted &= result.is_trusted();
        Ok(found)
    }

    /// The speed of the drive from which the contact opens in the last turns of runs.
    fn lift_off_by_runs<E: From<Error>>(
        &mut self,
        law: &str,
        (object, drive, speed): (usize, &str, f64),
    ) -> Result<LiftOff, NoResult<E>>
    where
        P: FnMut(&[String]) -> Result<Mechanism, E>,
        R: FnMut(&Mechanism, &RunSettings, bool) -> Result<RunResult, E>,
    {
        lift_off(speed.abs(), |tried| {
            let tried = tried * speed.signum();
            let setting = format!("{drive}.motion.speed={tried}");
            let ready = (self.prepare)(&[law.to_owned(), setting]).map_err(NoResult::Failed)?;
            let result = self.motion(&ready, tried, FEW)?;
            let id = &ready.model().objects[object].id;
            let figures = result.figures.objects.get(id);
            let pair = figures.and_then(|figures| figures.pair.as_ref());
            // A run that gave up (chatter, too many switches) is no working order.
            Ok(pair.map(Judgement::of_pair) != Some(Judgement::InWorkingOrder))
        })
    }

    /// A run over enough whole cycles with enough samples.
    fn motion<E: From<Error>>(
        &mut self,
        ready: &Mechanism,
        speed: f64,
        samples: usize,
    ) -> Result<RunResult, NoResult<E>>
    where
        R: FnMut(&Mechanism, &RunSettings, bool) -> Result<RunResult, E>,
    {
        let cycle = TAU / speed.abs();
        let asked = (ready.settings.duration / cycle * (1.0 - 1e-12)).ceil();
        let settings = RunSettings {
            duration: cycle * asked.clamp(CYCLES[0], CYCLES[1]),
            samples: ready.settings.samples.max(samples),
            window: None,
            of_accuracy: None,
            ..ready.settings.clone()
        };
        let result = (self.run)(ready, &settings, samples == FEW).map_err(NoResult::Failed)?;
        match result.outcome.stop.is_from_outside() {
            true => Err(NoResult::Interrupted),
            false => Ok(result),
        }
    }
}

/// The object whose law is exchanged, the drive at its root, and its speed (rad/s).
fn object_drive_and_speed(at: &str, model: &Model) -> Result<(usize, String, f64), Error> {
    let id = at.split('.').next().unwrap_or("");
    let index = model.objects.iter().position(|part| part.id == id);
    let object =
        index.ok_or_else(|| Error::question(format!("{at}: there is no object `{id}`")))?;
    let mut root = object;
    while let Some(driver) = model.objects[root].driver() {
        root = driver;
    }
    let part = &model.objects[root];
    if !part.is_drive() {
        return Err(Error::question(format!(
            "laws are compared behind one drive: `{}` has several inputs",
            part.id
        )));
    }
    match &model.nodes[part.nodes[0]].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } if *speed != 0.0 => Ok((object, part.id.clone(), *speed)),
        _ => Err(Error::question(format!(
            "laws are compared in steady motion: give the drive `{}` a constant speed",
            part.id
        ))),
    }
}
