//! The window of steady figures.

use crate::dynamics::model::{Coordinate, Model, NodeMotion};
use crate::kinematics::motion::DriveMotion;
use crate::units::shown;

/// Whole cycles that a run must have before its last one is taken for steady.
const CYCLES_BEFORE_STEADY: f64 = 3.0;

/// Digits of times in messages.
const DIGITS: usize = 7;

/// The window `[from, to]` (s) of a run over [0, `duration`]: the one asked
/// for, else the last whole cycle (counted from t = 0) of the drive when the
/// run has at least three.
///
/// # Errors
/// Why there is none, in words.
pub fn choose_window(
    model: &Model,
    duration: f64,
    asked: Option<(f64, f64)>,
) -> Result<[f64; 2], String> {
    choose_window_of(drive_cycle(model), duration, asked)
}

/// The same where the drive's cycle is known already.
///
/// # Errors
/// Why there is none, in words.
pub fn choose_window_of(
    cycle: Result<f64, String>,
    duration: f64,
    asked: Option<(f64, f64)>,
) -> Result<[f64; 2], String> {
    if let Some((from, to)) = asked {
        let place = match (from, to) {
            _ if 0.0 <= from && from < to && to <= duration => return Ok([from, to]),
            _ if 0.0 <= from && from < to && from >= duration => "lies beyond",
            _ if 0.0 <= from && from < to => "reaches beyond",
            _ => "is none before",
        };
        let [from, to, duration] = [from, to, duration].map(|time| shown(time, DIGITS));
        return Err(format!(
            "the window from {from} to {to} s {place} the end of the run at {duration} s"
        ));
    }
    last_cycle(duration, cycle?)
}

/// The last whole cycle `[from, to]` (s) of a run over [0, `duration`] that
/// has at least three.
fn last_cycle(duration: f64, cycle: f64) -> Result<[f64; 2], String> {
    // A duration meant as a whole number of cycles may fall short by rounding.
    let cycles = (duration / cycle * (1.0 + 1e-12)).floor();
    if cycles < CYCLES_BEFORE_STEADY {
        let [duration, cycle] = [duration, cycle].map(|time| shown(time, DIGITS));
        return Err(format!(
            "the run of {duration} s has fewer than three whole cycles of the drive ({cycle} s each)"
        ));
    }
    Ok([(cycles - 1.0) * cycle, (cycles * cycle).min(duration)])
}

/// Time of one turn of the drive (s), when its speed is prescribed and constant.
///
/// # Errors
/// Why there is none, in words.
pub fn drive_cycle(model: &Model) -> Result<f64, String> {
    let mut cycle = None;
    for object in model.objects.iter().filter(|part| part.is_drive()) {
        let NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } = &model.nodes[object.nodes[0]].motion
        else {
            return Err(format!("the speed of drive {} is not constant", object.id));
        };
        if *speed == 0.0 {
            continue; // held
        }
        if object.coordinate == Coordinate::Sliding {
            return Err(format!("drive {} slides and has no turns", object.id));
        }
        let own = std::f64::consts::TAU / speed.abs();
        match cycle {
            Some(other) if other != own => {
                return Err("the drives turn at different speeds".to_owned());
            }
            _ => cycle = Some(own),
        }
    }
    cycle
        .filter(|length| length.is_finite())
        .ok_or_else(|| "there is no drive that turns".to_owned())
}

#[cfg(test)]
mod tests {
    use super::choose_window;
    use crate::dynamics::model::{Model, Node, NodeMotion, ObjectPart, PartInput};
    use crate::kinematics::motion::DriveMotion;
    use std::f64::consts::TAU;

    fn drives(speeds: &[f64]) -> Model {
        let mut model = Model::default();
        for (index, &speed) in speeds.iter().enumerate() {
            model.nodes.push(Node {
                inertia: 0.0,
                motion: NodeMotion::Prescribed {
                    motion: DriveMotion::Constant { speed, angle: 0.0 },
                    track: None,
                },
            });
            model.objects.push(ObjectPart {
                id: format!("drive{index}"),
                kind: "drive",
                coordinate: crate::dynamics::model::Coordinate::Turning,
                nodes: vec![index],
                inputs: PartInput::behind_one_driver(None),
                combination: None,
                driven_end: None,
                links: Vec::new(),
                contact: None,
                rigid_pair: None,
                pressing: None,
            });
        }
        model
    }

    #[test]
    fn the_last_whole_cycle_is_taken_when_there_are_three() {
        let model = drives(&[TAU * 10.0]);
        let window = choose_window(&model, 0.5, None).unwrap();
        approx::assert_abs_diff_eq!(window[0], 0.4, epsilon = 1e-15);
        assert_eq!(window[1], 0.5);
        let window = choose_window(&model, 0.35, None).unwrap();
        approx::assert_abs_diff_eq!(window[0], 0.2, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(window[1], 0.3, epsilon = 1e-15);
    }

    #[test]
    fn without_a_window_the_reason_is_given() {
        let reason =
            |speeds: &[f64], duration| choose_window(&drives(speeds), duration, None).unwrap_err();
        assert!(reason(&[TAU * 10.0], 0.2).contains("fewer than three"));
        assert!(reason(&[1.0, 2.0], 100.0).contains("different speeds"));
        assert!(reason(&[0.0], 1.0).contains("no drive that turns"));
        assert!(reason(&[], 1.0).contains("no drive that turns"));
    }

    #[test]
    fn a_window_asked_for_must_lie_within_the_run() {
        let model = drives(&[TAU]);
        assert_eq!(choose_window(&model, 1.0, Some((0.2, 0.9))), Ok([0.2, 0.9]));
        assert!(choose_window(&model, 1.0, Some((0.2, 1.1))).is_err());
        assert!(choose_window(&model, 1.0, Some((f64::NAN, 0.5))).is_err());
    }
}
