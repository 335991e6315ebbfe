//! What the arguments of `dam cam` ask.

use crate::cli::args::CamArgs;
use crate::cli::failure::{Failure, refuse_option};
use crate::cli::quantity::option;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, QuantityChoice};
use crate::kinematics::cam::DiscCam;
use crate::kinematics::cam::sizing::PressureLimits;
use crate::studies::cam::{Question, Reserve};
use crate::units::{parse, quantities as q};
use std::f64::consts::FRAC_PI_2;

/// The question, and what the curves are to be like.
pub(super) struct CamRequest {
    pub(super) question: Question,
    /// Speed of the cam (rad/s).
    pub(super) speed: Option<f64>,
    /// Chord tolerance (m).
    pub(super) tolerance: f64,
    /// Radius of a cutter (m).
    pub(super) cutter: Option<f64>,
}

/// Reads the arguments.
pub(super) fn read(args: &CamArgs, cam: &DiscCam) -> Result<CamRequest, Failure> {
    let angle = Bounds {
        lower: Some((0.0, false)),
        upper: Some((FRAC_PI_2, false)),
        not_zero: false,
    };
    let roller = cam.geometry().roller().is_some();
    refuse_option(
        args.roller_factor.is_some() && !roller,
        "--roller-factor has no effect: the follower has a flat face and no roller",
    )?;
    refuse_option(
        args.least_radius.is_some() && roller,
        "--least-radius has no effect: the follower has a roller and no flat face",
    )?;
    let outward = option("--pressure-angle", &args.pressure_angle, q::ANGLE, angle)?;
    let inward = option(
        "--return-pressure-angle",
        &args.return_pressure_angle,
        q::ANGLE,
        angle,
    )?;
    let outward = outward.unwrap_or_else(|| cam.geometry().guide.customary_pressure_angle());
    let length = |name: &str, text: &Option<String>, bounds| option(name, text, q::LENGTH, bounds);
    let least = length("--least-radius", &args.least_radius, Bounds::NOT_NEGATIVE)?;
    let tolerance = Some(args.tolerance.clone());
    let tolerance = length("--tolerance", &tolerance, Bounds::POSITIVE)?;
    Ok(CamRequest {
        question: Question {
            pressure: PressureLimits {
                outward,
                inward: inward.unwrap_or(outward),
            },
            roller_factor: args.roller_factor.unwrap_or(0.7),
            least_radius: least.unwrap_or(0.0),
            reserve: reserve(args.reserve.as_deref().unwrap_or("0.2"))?,
        },
        speed: option("--speed", &args.speed, q::ANGULAR_SPEED, Bounds::NOT_ZERO)?,
        tolerance: tolerance.unwrap_or(1e-6),
        cutter: length("--cutter", &args.cutter, Bounds::POSITIVE)?,
    })
}

/// A share without, a force or moment with unit.
fn reserve(text: &str) -> Result<Reserve, Failure> {
    let forces = QuantityChoice::either(q::FORCE, q::MOMENT);
    let share = text.trim().parse::<f64>().is_ok();
    let wanted = if share || parse(text).is_err() {
        q::NUMBER.into()
    } else {
        forces
    };
    let read = |slot: crate::frontend::read::Slot<'_>| slot.quantity(wanted, Bounds::NOT_NEGATIVE);
    let value = read_argument("--reserve", text, read)?;
    Ok(match share {
        true => Reserve::Share(value),
        false => Reserve::Force(value),
    })
}
