//! Results of the contact of a follower by their names: `cam.valve.margin`.
//!
//! If all objects are rigid and the object describes its cam they are those of the closed form,
//! else those of runs, which include the elasticity of the scene.

use super::disc_cam;
use super::elastic::{ElasticContact, Missing};
use super::force::{CamForce, LiftOff, Reserve};
use super::speed_search::SpeedSearch;
use crate::dynamics::model::Closure;
use crate::fault::Fault;
use crate::frontend::scene::TypedScene;
use crate::kinematics::cam::At;
use crate::kinematics::cam::closing::LetsGo;
use crate::studies::rigid::elastic_objects;

/// Names of these results.
pub const CONTACT_RESULTS: [&str; 4] =
    ["margin", "margin_angle", "lift_off_speed", "preload_needed"];

/// A result of the contact by its name; `None`: it was ended from outside.
///
/// # Errors
/// Why it is not known.
pub fn contact_result(
    scene: &TypedScene,
    contact: ElasticContact<'_>,
    name: &str,
) -> Result<Option<f64>, Vec<Fault>> {
    let model = contact.system.model();
    let id = &model.objects[contact.object].id;
    let refused = |why: String| vec![Fault::new(id, why, "")];
    let pair = model.pair(&model.objects[contact.object]);
    let forced = pair.map(|pair| pair.closure) == Some(Closure::Force);
    if !forced {
        return Err(refused(format!(
            "no force closes its contact: it has no `{name}`"
        )));
    }
    let described = scene
        .objects
        .get(id)
        .is_some_and(|one| one.object.cam().is_some());
    if described && elastic_objects(model).is_empty() {
        let cam = disc_cam(scene, model, id)?;
        let force = CamForce::new(model, contact.object, &cam, None).map_err(refused)?;
        return of_closed_form(&force, name).map(Some).map_err(refused);
    }
    match by_runs(contact, name) {
        Ok(value) => Ok(Some(value)),
        Err(Missing::Interrupted) => Ok(None),
        Err(Missing::Refused(faults)) => Err(faults),
    }
}

fn of_margin(margin: At, name: &str) -> f64 {
    match name {
        "margin" => margin.value,
        _ => margin.phi,
    }
}

fn of_closed_form(force: &CamForce<'_>, name: &str) -> Result<f64, String> {
    let found = force.figures(Reserve::Force(0.0));
    match (name, found.lets_go, found.closing) {
        ("lift_off_speed", Some(LetsGo::At(at)), _) => Ok(at.value),
        ("lift_off_speed", Some(LetsGo::AtRest(_)), _) => Ok(0.0),
        ("lift_off_speed", ..) => Err("it stays in contact at any speed".to_owned()),
        ("preload_needed", _, Some(answer)) => Ok(answer.preload.value),
        ("preload_needed", ..) => Err("no spring closes its contact".to_owned()),
        _ => Ok(of_margin(found.margin, name)),
    }
}

fn lift_off(contact: ElasticContact<'_>) -> Result<LiftOff, Missing> {
    let search = SpeedSearch::of_scene(contact.system.model(), contact.object);
    let search = search.map_err(|why| contact.refused(why))?;
    contact.lift_off(&search, &mut |_| ())
}

fn by_runs(contact: ElasticContact<'_>, name: &str) -> Result<f64, Missing> {
    let id = &contact.system.model().objects[contact.object].id;
    let refused = |why: String| Err(Missing::Refused(vec![Fault::new(id, why, "")]));
    match name {
        "lift_off_speed" => match lift_off(contact)? {
            LiftOff::At(speed) => Ok(speed),
            LiftOff::Above(speed) => refused(format!(
                "it stays in contact at all speeds of the cam that were tried, up to {speed} rad/s"
            )),
            LiftOff::Below(speed) => refused(format!(
                "it lifts off at all speeds of the cam that were tried, down to {speed} rad/s"
            )),
        },
        "preload_needed" => contact.preload_needed(),
        _ => Ok(of_margin(contact.force()?.least, name)),
    }
}
