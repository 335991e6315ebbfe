//! The speed at which an elastic follower leaves its cam, by runs.

use crate::cli::args::CamArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::{Input, Ready};
use crate::cli::interrupt;
use crate::studies::cam::{CamForce, SpeedSearch, Steady, steady_contact};
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
    let search = SpeedSearch::new(model, id, force)
        .map_err(|what| Failure::Other(format!("--lift-off: {what}")))?;
    let opens = |cam_speed: f64| -> Result<bool, Ended> {
        let (address, tried) = search.setting(cam_speed);
        if !args.scene.quiet {
            console::talk(&format!("run at {cam_speed:.6} rad/s of the cam"));
        }
        let one = input.prepare(&[format!("{address}={tried}")])?;
        let control = interrupt::budget();
        let found = steady_contact(&one.system, search.object, &one.settings, control)
            .map_err(|faults| one.reading.places.diagnose(&faults))?;
        match found {
            Steady::Closed => Ok(false),
            Steady::Opens => Ok(true),
            Steady::Interrupted => Err(Ended::Interrupted),
        }
    };
    match lift_off(search.start, opens) {
        Ok(found) => Ok(Some(found)),
        Err(Ended::Interrupted) => Ok(None),
        Err(Ended::Failed(failure)) => Err(failure),
    }
}
