//! The speed at which an elastic follower leaves its cam, by runs.

use crate::ask::lift_off_by_runs;
use crate::cli::args::CamArgs;
use crate::cli::asker::Asker;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::{Input, Ready};
use crate::studies::cam::{CamForce, SpeedSearch};
use crate::studies::law::LiftOff;

/// Runs that a search takes, about.
const SOME: usize = 20;

/// Searches from the cam's speed on; the result is a speed of the cam (rad/s).
/// `None`: interrupted.
pub(super) fn search(
    (args, asker): (&CamArgs, &dyn Asker),
    input: &Input<'_>,
    ready: &Ready,
    id: &str,
    force: Option<&CamForce<'_>>,
) -> Result<Option<LiftOff>, Failure> {
    let search = SpeedSearch::new(ready.model(), id, force)
        .map_err(|what| Failure::Other(format!("--lift-off: {what}")))?;
    let mut runs = 0;
    lift_off_by_runs(&search, asker.budget(), |setting, cam_speed| {
        asker.report_progress(
            runs,
            SOME,
            &format!("run at {cam_speed:.4} rad/s of the cam"),
        );
        runs += 1;
        if !args.scene.quiet {
            console::print_message(&format!("run at {cam_speed:.6} rad/s of the cam"));
        }
        input.prepare(&[setting])
    })
}
