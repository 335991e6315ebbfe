//! The speed at which an elastic follower leaves its cam, by runs.

use crate::cli::args::CamArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::{Input, Ready};
use crate::cli::interrupt;
use crate::dynamics::model::{Closure, Model, NodeMotion};
use crate::kinematics::motion::DriveMotion;
use crate::studies::cam::{CamForce, Steady, steady_contact};
use crate::studies::law::{LiftOff, lift_off};

/// Why a search ended early.
enum Ended {
    Interrupted,
    Failed(Failure),
}

impl<F: Into<Failure>> From<F> for Ended {
    fn from(failure: F) -> Self {
        Self::Failed(failure.into())
    }
}

/// Searches from the cam's speed on; the result is a speed of the cam (rad/s).
/// `None`: interrupted.
pub(super) fn search(
    args: &CamArgs,
    input: &Input,
    ready: &Ready,
    id: &str,
    force: Option<&CamForce<'_>>,
) -> Result<Option<LiftOff>, Failure> {
    let model = ready.system.model();
    let refuse = |what: &str| Err(Failure::Other(format!("--lift-off: {what}")));
    let Some(object) = model.objects.iter().position(|part| part.id == id) else {
        return refuse("there is no such object");
    };
    if closure(model, object) != Some(Closure::Force) {
        return refuse("only a pair that is closed by force lifts off");
    }
    let mut root = object;
    while let Some(driver) = model.objects[root].driver() {
        root = driver;
    }
    let drive = &model.objects[root];
    if !drive.is_drive() {
        return refuse(&format!("`{}` has several inputs, not one drive", drive.id));
    }
    let speed = match &model.nodes[drive.nodes[0]].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } if *speed != 0.0 => *speed,
        _ => return refuse(&format!("give the drive `{}` a constant speed", drive.id)),
    };
    let Some(force) = force else {
        return refuse("the speed of the cam is not known");
    };
    // The scene's own ratio from drive to cam: another --speed scales both.
    let scene_force = CamForce::new(model, object, force.cam(), None);
    let ratio = scene_force.map_or(1.0, |scene| scene.speed() / speed);
    let opens = |cam_speed: f64| -> Result<bool, Ended> {
        let tried = cam_speed / ratio.abs() * speed.signum();
        if !args.scene.quiet {
            console::talk(&format!("run at {cam_speed:.6} rad/s of the cam"));
        }
        let one = input.prepare(&[format!("{}.motion.speed={tried}", drive.id)])?;
        let found = steady_contact(&one.system, object, &one.settings, interrupt::budget())
            .map_err(|faults| one.reading.places.diagnose(&faults))?;
        match found {
            Steady::Closed => Ok(false),
            Steady::Opens => Ok(true),
            Steady::Interrupted => Err(Ended::Interrupted),
        }
    };
    match lift_off(force.speed().abs(), opens) {
        Ok(found) => Ok(Some(found)),
        Err(Ended::Interrupted) => Ok(None),
        Err(Ended::Failed(failure)) => Err(failure),
    }
}

fn closure(model: &Model, object: usize) -> Option<Closure> {
    let pair = model.pair(&model.objects[object]);
    pair.map(|pair| pair.closure)
}
