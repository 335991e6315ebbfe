//! The least speed at which an elastic follower cannot stay on its cam.

use crate::ask::lift_off_speed;
use crate::cli::args::CamArgs;
use crate::cli::asker::Asker;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::studies::cam::{CamForce, ElasticContact, SpeedSearch};
use crate::studies::law::LiftOff;
use std::f64::consts::TAU;

/// Speeds that a search tries, about.
const SOME: usize = 70;

/// The search from the speed of the cam on.
pub(super) fn search_of(
    ready: &Ready,
    id: &str,
    force: Option<&CamForce<'_>>,
) -> Result<SpeedSearch, Failure> {
    SpeedSearch::new(ready.model(), id, force)
        .map_err(|what| Failure::Other(format!("--lift-off: {what}")))
}

/// The result is a speed of the cam (rad/s). `None`: interrupted.
pub(super) fn search(
    (args, asker): (&CamArgs, &dyn Asker),
    ready: &Ready,
    search: &SpeedSearch,
) -> Result<Option<LiftOff>, Failure> {
    let mut tried = 0;
    let found = lift_off_speed(ready, search, asker.budget(), &mut |cam_speed| {
        let text = format!("cam at {cam_speed:.6} rad/s");
        asker.report_progress(tried, SOME, &text);
        tried += 1;
        if !args.scene.quiet {
            console::print_message(&text);
        }
    });
    Ok(found?)
}

/// A note if the follower bounces on from the start of its scene although it could stay on its cam.
pub(super) fn note_on_start(
    contact: &ElasticContact<'_>,
    search: &SpeedSearch,
    found: LiftOff,
) -> Option<String> {
    let LiftOff::At(lift_off) = found else {
        return None;
    };
    let speed = contact.bounces_below(search, lift_off)?;
    Some(format!(
        "from the start of the scene the follower bounces on at {:.1} rpm, where it could stay on \
         its cam: the lift-off speed holds for a follower in contact",
        speed * 60.0 / TAU
    ))
}
