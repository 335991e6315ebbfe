//! Whether what is written as a function of time has a value all through the run.

use crate::dynamics::model::{LoadLaw, Model, NodeMotion};
use crate::fault::Fault;
use crate::kinematics::motion::{DriveMotion, WrittenMotion};
use crate::units::shown;

/// Digits of times in messages.
const DIGITS: usize = 6;

/// Motions and loads over the time alone that have no finite value at some time of the run.
pub fn undefined(model: &Model, duration: f64) -> Vec<Fault> {
    let mut faults = Vec::new();
    for part in model.objects.iter().filter(|part| part.is_drive()) {
        let NodeMotion::Prescribed { motion, .. } = &model.nodes[part.nodes[0]].motion else {
            continue;
        };
        if let DriveMotion::Written(written) = motion {
            faults.extend(fault(written, duration, &format!("{}.motion", part.id)));
        }
    }
    for load in &model.loads {
        let LoadLaw::Written(written) = &load.law else {
            continue;
        };
        if written.nodes().next().is_none() {
            let expression = &written.expression;
            let of_time = WrittenMotion::of_load(expression, written.factor);
            faults.extend(of_time.and_then(|of_time| fault(&of_time, duration, &load.name)));
        }
    }
    faults
}

fn fault(written: &WrittenMotion, duration: f64, path: &str) -> Option<Fault> {
    let at = written.undefined(duration)?;
    Some(Fault::new(
        format!("{path}.expression"),
        format!(
            "\"{}\" has no finite value at t = {} s",
            written.text(),
            shown(at, DIGITS)
        ),
        "a function that is finite all through the run, a condition before that time \
         (`t < … ? … : …`), or a shorter `duration`",
    ))
}
