//! The cam of an object.

use super::{Mechanism, ModelAssessment, Scene};
use crate::Error;
use crate::fault::Fault;
use crate::frontend::diagnostics::Diagnostic;
use crate::kinematics::cam::DiscCam;
use crate::kinematics::cam::sizing::PressureLimits;
use crate::studies::Control;
use crate::studies::cam::{
    CamFigures, CamForce, ElasticContact, Missing, Question, Reserve, SpeedSearch, disc_cam,
    figures, objects_with_cam,
};
use crate::studies::law::LiftOff;
use std::f64::consts::FRAC_PI_2;

/// What is asked of a cam. SI units, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct CamQuestion {
    /// The object that follows it; may be left out where one only tells of its cam.
    pub object: Option<String>,
    /// Speed of the cam (rad/s); default: that of the scene.
    pub speed: Option<f64>,
    /// Greatest pressure angle outwards (rad); default: 30°, of a turning follower 45°.
    pub pressure_angle: Option<f64>,
    /// Greatest pressure angle inwards (rad); default: the same.
    pub return_pressure_angle: Option<f64>,
    /// Greatest radius of the roller by the least radius of curvature of its path.
    pub roller_factor: f64,
    /// Least radius of curvature of a profile under a flat face (m).
    pub least_radius: f64,
    /// What is to be left in contact.
    pub reserve: Reserve,
}

/// What is found of a cam.
#[derive(Clone, Copy, Debug)]
pub struct FoundCam<'a> {
    /// Id of the object that follows it.
    pub object: &'a str,
    /// The cam: motion, geometry, profile.
    pub cam: &'a DiscCam,
    /// Checks, sizes, forces.
    pub figures: &'a CamFigures,
    /// The follower on it; `None`: its speed is not known, or a load is none of its angle.
    pub force: Option<&'a CamForce<'a>>,
}

impl Default for CamQuestion {
    /// As `dam cam` asks without options.
    fn default() -> Self {
        Self {
            object: None,
            speed: None,
            pressure_angle: None,
            return_pressure_angle: None,
            roller_factor: 0.7,
            least_radius: 0.0,
            reserve: Reserve::Share(0.2),
        }
    }
}

impl CamQuestion {
    /// What is wrong with its numbers.
    fn check(&self) -> Result<(), Error> {
        let angle = |angle: &f64| *angle > 0.0 && *angle < FRAC_PI_2;
        let positive = |value: &f64| value.is_finite() && *value > 0.0;
        let not_negative = |value: f64| value.is_finite() && value >= 0.0;
        let reserve = match self.reserve {
            Reserve::Share(value) | Reserve::Force(value) => value,
        };
        let turns = |speed: &f64| speed.is_finite() && *speed != 0.0;
        let checks = [
            (
                "pressure_angle",
                self.pressure_angle.as_ref().is_none_or(angle),
                "between 0 and 90°",
            ),
            (
                "return_pressure_angle",
                self.return_pressure_angle.as_ref().is_none_or(angle),
                "between 0 and 90°",
            ),
            (
                "roller_factor",
                positive(&self.roller_factor),
                "a positive number",
            ),
            (
                "least_radius",
                not_negative(self.least_radius),
                "a length, not negative",
            ),
            (
                "reserve",
                not_negative(reserve),
                "a share or force, not negative",
            ),
            (
                "speed",
                self.speed.as_ref().is_none_or(turns),
                "a speed that is not 0",
            ),
        ];
        match checks.into_iter().find(|(_, holds, _)| !holds) {
            None => Ok(()),
            Some((name, _, wanted)) => {
                let fault = Diagnostic::error("question", format!("`{name}` is to be {wanted}"));
                Err(Error::of(fault.path(name)))
            }
        }
    }
}

/// The least speed of a cam (rad/s) at which its elastic follower cannot stay on it; `None`: it was
/// ended from outside. `report` has each speed before it is tried.
pub(crate) fn lift_off_speed(
    ready: &Mechanism,
    search: &SpeedSearch,
    control: &Control<'_>,
    report: &mut dyn FnMut(f64),
) -> Result<Option<LiftOff>, Error> {
    let contact = ElasticContact {
        system: &ready.system,
        object: search.object,
        settings: &ready.settings,
        control,
    };
    match contact.lift_off(search, report) {
        Ok(found) => Ok(Some(found)),
        Err(Missing::Interrupted) => Ok(None),
        Err(Missing::Refused(faults)) => Err(ready.diagnose(&faults)),
    }
}

/// The speed of the drive (rad/s) at which a follower (index in the model) cannot stay on its cam:
/// `None` if no force closes its contact, within it `None` if it was ended from outside.
pub(super) fn lift_off_of_drive(
    ready: &Mechanism,
    object: usize,
    control: &Control<'_>,
) -> Result<Option<Option<LiftOff>>, Error> {
    let Ok(search) = SpeedSearch::of_scene(ready.model(), object) else {
        return Ok(None);
    };
    let of_cam = lift_off_speed(ready, &search, control, &mut |_| ())?;
    let of_drive = of_cam.map(|found| found.map(|speed| search.drive_speed(speed)));
    Ok(Some(of_drive))
}

impl Scene {
    /// The least speed of a cam (rad/s) at which its elastic follower cannot stay on it, by the
    /// steady motion with closed contact at other speeds of its drive; `None`: it was ended from
    /// outside.
    ///
    /// # Errors
    /// As of [`Mechanism::cam`]; the pair is not closed by force, or no drive of constant
    /// speed is behind it; what is wrong with the scene at a speed that is tried.
    pub fn cam_lift_off(
        &self,
        question: &CamQuestion,
        control: &Control<'_>,
    ) -> Result<Option<LiftOff>, Error> {
        let ready = self.prepare_judging(ModelAssessment::Needed, control)?;
        let search = ready.cam(question, |found| {
            SpeedSearch::new(ready.model(), found.object, found.force)
        })?;
        let search = search.map_err(Error::question)?;
        lift_off_speed(&ready, &search, control, &mut |_| ())
    }
}

impl Mechanism {
    /// The cam of an object: its profile, its checks, its sizes and the force that keeps
    /// the follower on it, shown to `look`.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::CamQuestion;
    ///
    /// let scene = Scene::read("scenarios/cams/flat_tappet.json")?;
    /// let ready = scene.prepare()?;
    /// let stroke = ready.cam(&CamQuestion::default(), |found| found.figures.stroke)?;
    /// assert!(stroke > 0.0);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// No object tells of its cam, or several do; the cam cannot be; the question makes no
    /// sense.
    pub fn cam<T>(
        &self,
        question: &CamQuestion,
        look: impl FnOnce(&FoundCam<'_>) -> T,
    ) -> Result<T, Error> {
        question.check()?;
        let id = self.object_with_cam(question.object.as_deref())?;
        let (scene, model) = (self.scene(), self.model());
        let diagnose = |faults: Vec<Fault>| self.diagnose(&faults);
        let cam = disc_cam(scene, model, &id).map_err(diagnose)?;
        let index = model.objects.iter().position(|part| part.id == id);
        let unknown = || Error::question(format!("there is no object `{id}`"));
        let force = CamForce::new(model, index.ok_or_else(unknown)?, &cam, question.speed);
        let outward = question
            .pressure_angle
            .unwrap_or_else(|| cam.geometry().guide.customary_pressure_angle());
        let asked = Question {
            pressure: PressureLimits {
                outward,
                inward: question.return_pressure_angle.unwrap_or(outward),
            },
            roller_factor: question.roller_factor,
            least_radius: question.least_radius,
            reserve: question.reserve,
        };
        let force_or_why = force.as_ref().map_err(String::as_str);
        let found = figures(&cam, &asked, force_or_why).map_err(diagnose)?;
        Ok(look(&FoundCam {
            object: &id,
            cam: &cam,
            figures: &found,
            force: force.as_ref().ok(),
        }))
    }

    /// The object asked for, or the only one with a cam.
    fn object_with_cam(&self, asked: Option<&str>) -> Result<String, Error> {
        if let Some(id) = asked {
            return Ok(id.to_owned());
        }
        match objects_with_cam(self.scene()).as_slice() {
            [only] => Ok((*only).to_owned()),
            [] => Err(Error::question(
                "no object of the scene describes its cam: give a cam follower or rocker the \
                 property `cam`",
            )),
            several => Err(Error::question(format!(
                "several objects describe their cam: choose one ({})",
                several.join(", ")
            ))),
        }
    }
}
