//! The speed at which an elastic follower leaves its cam, by runs.

use crate::ask::lift_off_by_runs;
use crate::cli::args::CamArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::{Input, Ready};
use crate::cli::interrupt;
use crate::studies::cam::{CamForce, SpeedSearch};
use crate::studies::law::LiftOff;

/// Searches from the cam's speed on; the result is a speed of the cam (rad/s).
/// `None`: interrupted.
pub(super) fn search(
    args: &CamArgs,
    input: &Input,
    ready: &Ready,
    id: &str,
    force: Option<&CamForce<'_>>,
) -> Result<Option<LiftOff>, Failure> {
    let search = SpeedSearch::new(ready.model(), id, force)
        .map_err(|what| Failure::Other(format!("--lift-off: {what}")))?;
    lift_off_by_runs(&search, interrupt::budget(), |setting, cam_speed| {
        if !args.scene.quiet {
            console::talk(&format!("run at {cam_speed:.6} rad/s of the cam"));
        }
        input.prepare(&[setting])
    })
}
