//! The scene of a cam at other speeds of its drive.

use super::force::{CamForce, cam_speed};
use crate::dynamics::model::{Closure, Model, NodeMotion};
use crate::kinematics::motion::DriveMotion;

/// A search over the speed of the drive behind a cam.
#[derive(Clone, Debug, PartialEq)]
pub struct SpeedSearch {
    /// Index of the follower in the model.
    pub object: usize,
    /// Speed of the cam from which the search goes (rad/s), > 0.
    pub start: f64,
    /// Node of the drive.
    node: usize,
    /// The scene's own speed of the drive (rad/s).
    speed: f64,
    /// The scene's own ratio from drive to cam: another speed scales both.
    ratio: f64,
}

impl SpeedSearch {
    /// For the object `id` under `force`, which has the speed to begin with.
    ///
    /// # Errors
    /// In words: why no speed is searched for.
    pub fn new(model: &Model, id: &str, force: Option<&CamForce<'_>>) -> Result<Self, String> {
        let object = model.objects.iter().position(|part| part.id == id);
        let object = object.ok_or("there is no such object")?;
        Self::from_speed(model, object, force.map(CamForce::speed))
    }

    /// For an object (index in the model) from the speed of its scene on.
    ///
    /// # Errors
    /// As of [`Self::new`].
    pub fn of_scene(model: &Model, object: usize) -> Result<Self, String> {
        Self::from_speed(model, object, cam_speed(model, object))
    }

    fn from_speed(model: &Model, object: usize, start: Option<f64>) -> Result<Self, String> {
        let pair = model.pair(&model.objects[object]);
        if pair.map(|pair| pair.closure) != Some(Closure::Force) {
            return Err("only a pair that is closed by force lifts off".into());
        }
        let mut root = object;
        while let Some(driver) = model.objects[root].driver() {
            root = driver;
        }
        let drive = &model.objects[root];
        if !drive.is_drive() {
            let several = format!("`{}` has several inputs, not one drive", drive.id);
            return Err(several);
        }
        let speed = match &model.nodes[drive.nodes[0]].motion {
            NodeMotion::Prescribed {
                motion: DriveMotion::Constant { speed, .. },
                ..
            } if *speed != 0.0 => *speed,
            _ => return Err(format!("give the drive `{}` a constant speed", drive.id)),
        };
        let start = start.ok_or("the speed of the cam is not known")?;
        Ok(Self {
            object,
            start: start.abs(),
            node: drive.nodes[0],
            speed,
            ratio: cam_speed(model, object).map_or(1.0, |own| (own / speed).abs()),
        })
    }

    /// The model with the drive at the speed that gives the cam this one (rad/s).
    pub fn model_at(&self, model: &Model, cam_speed: f64) -> Model {
        let mut changed = model.clone();
        let motion = &mut changed.nodes[self.node].motion;
        if let NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } = motion
        {
            *speed = self.drive_speed(cam_speed) * self.speed.signum();
        }
        // (What the scene states of this drive no longer holds.)
        changed.stated.drives.remove(&self.node);
        changed
    }

    /// Magnitude of the speed of the drive that gives the cam this one (rad/s).
    pub fn drive_speed(&self, cam_speed: f64) -> f64 {
        cam_speed / self.ratio
    }
}
