//! Kinematics and forces of linkages.

use super::Asked;
use crate::answer::{Columns, Told};
use dam::model::Coordinate;
use dam::report::findings::Findings;
use dam::report::{forces as forces_report, kinematics as kinematics_report};
use dam::studies::forces::{Course, ForceChoice, ForceStudy};
use dam::studies::kinematics::{
    InputCourse, InputOver, Kinematics, Over, Question, even_motion, linkage_of, several_of,
};
use dam::studies::rigid::Rigid;
use dam::{Error, Mechanism, Scene};
use pyo3::prelude::*;
use serde_json::Value;
use std::sync::Arc;

/// Most positions of a study.
const MOST: usize = 1_000_000;

/// Name of an input; where it goes, if that is said: nowhere in particular, to a place, from and
/// to; its speed; its acceleration.
type InputWords = (String, Option<Vec<f64>>, Option<f64>, Option<f64>);

/// What is asked of a linkage, as Python says it.
#[derive(Debug, FromPyObject)]
pub(crate) struct LinkageCourse {
    #[pyo3(item)]
    object: Option<String>,
    #[pyo3(item)]
    over: Option<String>,
    #[pyo3(item)]
    from_to: Option<(f64, f64)>,
    #[pyo3(item)]
    positions: usize,
    #[pyo3(item)]
    speed: Option<f64>,
    #[pyo3(item)]
    acceleration: Option<f64>,
    #[pyo3(item)]
    inputs: Vec<InputWords>,
}

impl LinkageCourse {
    /// The question.
    ///
    /// # Errors
    /// Numbers that are none, a course that is none.
    pub(crate) fn question(self) -> Result<Question, Error> {
        let wrong = |what: String| Error::from(vec![dam::fault::Fault::new("", what, "")]);
        let numbers = self.speed.iter().chain(&self.acceleration);
        let ends = self.from_to.iter().flat_map(|(from, to)| [from, to]);
        if !numbers.chain(ends).all(|x| x.is_finite()) {
            let what = "speeds, accelerations and places are finite numbers";
            return Err(wrong(what.to_owned()));
        }
        if !(1..=MOST).contains(&self.positions) {
            return Err(wrong(format!("between 1 and {MOST} positions")));
        }
        let over = match (self.over.as_deref(), self.from_to) {
            (None, None) => None,
            (Some("turn"), None) => Some(Over::Turn),
            (Some("range"), Some((from, to))) => Some(Over::Range { from, to }),
            (Some("time"), Some((_, to))) => Some(Over::Time { to }),
            _ => return Err(wrong("over what: a turn, a range or a time".to_owned())),
        };
        let input = |(name, over, speed, acceleration): InputWords| {
            let over = match over.as_deref() {
                None => None,
                Some([]) => Some(InputOver::Free),
                Some([at]) => Some(InputOver::At(*at)),
                Some([from, to]) => Some(InputOver::Range {
                    from: *from,
                    to: *to,
                }),
                Some(_) => {
                    return Err(wrong(format!(
                        "the input `{name}` has a place, or two ends"
                    )));
                }
            };
            Ok(InputCourse {
                name,
                over,
                speed,
                acceleration,
            })
        };
        let inputs: Result<Vec<_>, Error> = self.inputs.into_iter().map(input).collect();
        Ok(Question {
            object: self.object,
            over,
            positions: self.positions,
            speed: self.speed,
            acceleration: self.acceleration,
            inputs: inputs?,
            ..Question::default()
        })
    }
}

/// How a linkage moves.
pub(crate) struct Moved {
    asked: Asked,
    found: Kinematics,
}

/// How a linkage of a scene moves.
///
/// # Errors
/// Everything that is wrong with the scene; what cannot be answered.
pub(crate) fn kinematics(scene: Arc<Scene>, question: &Question) -> Result<Moved, Error> {
    let ready = Mechanism::of(scene.decode()?)?;
    let found = ready.kinematics(question)?;
    let asked = Asked { scene, ready };
    Ok(Moved { asked, found })
}

impl Moved {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&kinematics_report::rows(&self.found))
    }

    fn label(&self) -> Option<Rigid> {
        Rigid::label(self.asked.ready.model(), &["dam run"])
    }
}

impl Told for Moved {
    fn document(&self) -> Result<Value, Error> {
        let (name, hash) = (self.asked.name(), self.asked.hash());
        let mut document = kinematics_report::document(name, hash, &self.found);
        let label = self.label();
        self.tell(|findings| findings.judge(&mut document, label.as_ref()))?;
        Ok(document)
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let (name, source) = (self.asked.name(), self.asked.source());
        let mut findings = kinematics_report::findings(name, &self.found, source);
        let what = "positions, speeds and accelerations are";
        findings.label(self.label().as_ref(), what);
        Ok(to(&findings))
    }
}

/// What a linkage carries.
pub(crate) struct Carried {
    asked: Asked,
    object: String,
    motion: String,
    warnings: Vec<String>,
    found: ForceStudy,
}

/// Which forces a linkage of a scene carries.
///
/// # Errors
/// Everything that is wrong with the scene; what cannot be answered.
pub(crate) fn forces(
    scene: Arc<Scene>,
    question: &Question,
    choice: &ForceChoice,
) -> Result<Carried, Error> {
    let ready = Mechanism::of(scene.decode()?)?;
    let found = ready.forces_with(question, choice)?;
    let model = ready.model();
    let fault = |what| Error::from(vec![dam::fault::Fault::new("", what, "")]);
    let id = question.object.as_deref();
    let (part, motion) = match (several_of(model, id), &found.several) {
        (Some(body), Some(several)) => (&model.objects[body.object], several.motion.clone()),
        _ => {
            let part = &model.objects[linkage_of(model, id).map_err(fault)?.object];
            (part, of_one(part.coordinate, &found))
        }
    };
    let (object, warnings) = (part.id.clone(), found.warnings());
    Ok(Carried {
        asked: Asked { scene, ready },
        object,
        motion,
        warnings,
        found,
    })
}

/// Motion of the one input, in words.
fn of_one(input: Coordinate, found: &ForceStudy) -> String {
    let unit = match input {
        Coordinate::Turning => "rad",
        Coordinate::Sliding => "m",
    };
    match &found.course {
        Course::Instants { .. } => "motion of the scene's drive".to_owned(),
        Course::Even {
            speed,
            acceleration,
            ..
        } => even_motion([*speed, *acceleration], unit),
    }
}

impl Carried {
    pub(crate) fn columns(&self) -> Columns {
        super::columns(&forces_report::rows(&self.found))
    }

    /// Loads over time come from a run.
    fn label(&self) -> Option<Rigid> {
        let label = Rigid::label(self.asked.ready.model(), &["dam run"]);
        label.filter(|_| !self.found.course.has_loads())
    }

    fn report(&self) -> forces_report::ForcesReport<'_> {
        forces_report::ForcesReport {
            study: &self.found,
            warnings: &self.warnings,
            massless: None,
            object: &self.object,
            motion: &self.motion,
            name: self.asked.name(),
            hash: self.asked.hash(),
        }
    }
}

impl Told for Carried {
    fn document(&self) -> Result<Value, Error> {
        let mut document = forces_report::document(&self.report());
        let label = self.label();
        self.tell(|findings| findings.judge(&mut document, label.as_ref()))?;
        Ok(document)
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        let mut findings = forces_report::findings(&self.report(), self.asked.source());
        findings.label(self.label().as_ref(), "the forces are");
        Ok(to(&findings))
    }
}
