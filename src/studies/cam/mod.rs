//! The cam of an object in a scene: its profile, its checks, its sizes, and the
//! force that keeps the follower on it.

mod closing_spring;
mod contact;
mod elastic;
mod force;
mod lift_off;
mod reduction;
mod result;
mod speed_search;

pub use closing_spring::preload_unit;
pub use contact::{CONTACT_RESULTS, contact_result};
pub use elastic::{ElasticContact, Missing, SteadyForce};
pub use force::{CamForce, ElasticFigures, ForceFigures, Reserve, SpringAnswer};
pub use result::{Answer, CamFigures, FaceFigures, Question, Radii, figures};
pub use speed_search::SpeedSearch;

use crate::dynamics::model::{Closure, Model};
use crate::fault::{Fault, Faults};
use crate::frontend::scene::TypedScene;
use crate::kinematics::cam::DiscCam;

/// Ids of the objects of a scene that tell of their cam, ascending.
pub fn objects_with_cam(scene: &TypedScene) -> Vec<&str> {
    let objects = scene.objects.iter();
    let with = objects.filter(|(_, object)| object.object.cam().is_some());
    with.map(|(id, _)| id.as_str()).collect()
}

/// The cams of a scene that can be, by the id of their follower: what is to be drawn
/// of them. Why another cannot, [`disc_cam`] says.
pub fn disc_cams(scene: &TypedScene, model: &Model) -> Vec<(String, DiscCam)> {
    let cam = |id: &str| Some((id.to_owned(), disc_cam(scene, model, id).ok()?));
    objects_with_cam(scene)
        .into_iter()
        .filter_map(cam)
        .collect()
}

/// The cam of an object.
///
/// # Errors
/// There is no such object or it tells of no cam; the cam cannot be; the pair
/// opens towards the cam. Paths are those of the scene.
pub fn disc_cam(scene: &TypedScene, model: &Model, id: &str) -> Result<DiscCam, Vec<Fault>> {
    let mut faults = Faults::default();
    let object = scene.objects.get(id);
    let geometry = object.and_then(|object| object.object.cam());
    let (Some(object), Some(geometry)) = (object, geometry) else {
        let with = objects_with_cam(scene);
        let message = match object {
            None => format!("there is no object `{id}`"),
            Some(_) => format!("`{id}` does not describe its cam"),
        };
        let hint = match with.is_empty() {
            true => {
                "no object of the scene has the property `cam`: give it to a cam follower or rocker"
                    .to_owned()
            }
            false => format!("these do: {}", with.join(", ")),
        };
        return Err(vec![Fault::new(id, message, hint)]);
    };
    let part = model.objects.iter().find(|part| part.id == id);
    let node = part.and_then(|part| part.nodes.first());
    let law = node.and_then(|&node| model.nodes[node].motion.law());
    let Some(position) = law.map(|law| &law.position) else {
        return Err(vec![Fault::new(id, "it follows no law", "")]);
    };
    if let Some(chain) = object.object.chain() {
        let away = chain.pair.opens * chain.lever.signum() * geometry.outward;
        let wanted = match geometry.surface {
            crate::kinematics::cam::Surface::Hollow => -1.0,
            _ => 1.0,
        };
        if chain.pair.closure == Closure::Force && away != wanted {
            let message = "the contact separates towards the cam, which is in the way";
            let hint = "turn `pair.opens` or `cam.positive` round";
            faults.add("cam.positive", message, hint);
        }
    }
    match DiscCam::new(position, geometry) {
        Ok(cam) => match faults.check() {
            Ok(()) => Ok(cam),
            Err(found) => Err(prefixed(id, found)),
        },
        Err(found) => {
            faults.absorb("", found);
            Err(prefixed(id, faults.check().err().unwrap_or_default()))
        }
    }
}

fn prefixed(id: &str, found: Vec<Fault>) -> Vec<Fault> {
    found
        .into_iter()
        .map(|fault| Fault {
            path: format!("{id}.{}", fault.path.trim_start_matches('.')),
            ..fault
        })
        .collect()
}
