//! What no clock of double precision can resolve.

use super::defined::undefined;
use super::settings::RunSettings;
use crate::dynamics::model::{Coordinate, Model, NodeMotion};
use crate::fault::Fault;
use crate::kinematics::motion::DriveMotion;
use crate::units::shown;
use std::f64::consts::TAU;

/// Turns after which an angle has no digits left for its place in the turn.
const MOST_TURNS: f64 = 1e12;
/// Roundings of the clock that a step must be.
const ROUNDINGS: f64 = 16.0;
/// Digits of times in messages.
const DIGITS: usize = 3;

/// Turns of a drive in a time; infinite or none where its angle is no number.
fn drive_turns(motion: &DriveMotion, time: f64) -> f64 {
    let breaks = motion.breaks();
    let at = |time: f64| motion.jet(breaks.segment_at(time, 1.0), time).value;
    (at(time) - at(0.0)).abs() / TAU
}

/// Why a model cannot be followed over the time of its run: a function of the time without a
/// value ([`undefined`]), or what no clock resolves ([`unresolved`]). Empty: it can be.
pub fn not_followable(model: &Model, settings: &RunSettings) -> Vec<Fault> {
    match undefined(model, settings.duration) {
        faults if faults.is_empty() => unresolved(model, settings),
        faults => faults,
    }
}

/// Faults of a run that no clock resolves: a duration in which drives turn so often that
/// their angle has no digits left for the turn, a step that is less than the rounding of
/// the time.
pub fn unresolved(model: &Model, settings: &RunSettings) -> Vec<Fault> {
    let duration = settings.duration;
    let mut faults = Vec::new();
    for part in model.objects.iter().filter(|part| part.is_drive()) {
        let NodeMotion::Prescribed { motion, .. } = &model.nodes[part.nodes[0]].motion else {
            continue;
        };
        let beyond = |time: f64| !(drive_turns(motion, time) <= MOST_TURNS);
        if part.coordinate != Coordinate::Turning || !beyond(duration) {
            continue;
        }
        let mut least = duration;
        while beyond(least) && least > 0.0 {
            least *= 0.5;
        }
        let (id, long) = (&part.id, shown(duration, DIGITS));
        let message = format!(
            "in {long} s `{id}` turns more than 10¹² times: an angle of 16 digits has none left \
             for its place in the turn, and no step could follow it"
        );
        let hint = format!("less: {} s, say", shown(least, DIGITS));
        faults.push(Fault::new("run.duration", message, hint));
    }
    let rounding = ROUNDINGS * f64::EPSILON * duration;
    if let Some(step) = settings.step.filter(|&step| step < rounding) {
        let [step, long, least] = [step, duration, rounding].map(|time| shown(time, DIGITS));
        let message = format!(
            "a step of {step} s is below what a clock of 16 digits resolves after {long} s"
        );
        let hint = format!("at least {least} s, or a shorter `duration`");
        faults.push(Fault::new("run.step", message, hint));
    }
    faults
}
