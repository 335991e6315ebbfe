//! Whether what is written as a function of time has a value all through the run.

use crate::dynamics::model::{Load, LoadVariable, Model, NodeIndex, NodeMotion, WrittenLoad};
use crate::fault::Fault;
use crate::kinematics::motion::{DriveMotion, WrittenMotion};
use crate::math::expression::{Expression, MOST};
use crate::units::shown;

/// Digits of times in messages.
const DIGITS: usize = 6;

/// Motions, and loads whose part beside their own motion is a function of the time, that have no finite value at some time of the run.
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
        let Some(written) = load.law.expression_load() else {
            continue;
        };
        let of_time = over_time(model, load, written);
        faults.extend(of_time.and_then(|of_time| fault(&of_time, duration, &load.name)));
    }
    faults
}

/// What of a load does not depend on its own motion, as a function of the time; `None`: it is
/// none, or has too many pieces.
fn over_time(model: &Model, load: &Load, written: &WrittenLoad) -> Option<WrittenMotion> {
    let expression = &written.expression;
    let own = (written.variables.iter().enumerate()).filter(|(index, variable)| {
        let of_own = match variable {
            LoadVariable::Displacement(node) | LoadVariable::Speed(node) => *node == load.node,
            LoadVariable::Time => false,
        };
        of_own && expression.program().reads(*index)
    });
    let own: Vec<usize> = own.map(|(index, _)| index).collect();
    let linear = expression.affine_in(&own)?;
    let lines = written.variables.iter().map(|variable| match *variable {
        LoadVariable::Time => Some([1.0, 0.0]),
        LoadVariable::Displacement(node) => uniform(model, node),
        LoadVariable::Speed(node) => uniform(model, node).map(|[speed, _]| [0.0, speed]),
    });
    let lines: Vec<Option<[f64; 2]>> = lines.collect();
    let function = Expression::along_a_line(&linear.rest, &lines)?;
    let (motion, whole) = WrittenMotion::of(&function, expression.text(), written.factor, MOST);
    whole.then_some(motion)
}

/// Speed, and place at t = 0, of a node that moves uniformly.
fn uniform(model: &Model, node: NodeIndex) -> Option<[f64; 2]> {
    match &model.nodes[node].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, angle },
            ..
        } => Some([*speed, *angle]),
        NodeMotion::Rigid { law } => {
            let [ratio, offset] = law.position.straight_line()?;
            let [speed, place] = uniform(model, law.driver)?;
            Some([
                law.lever * ratio * speed,
                law.lever * (ratio * place + offset),
            ])
        }
        NodeMotion::Prescribed { .. }
        | NodeMotion::Rotor { .. }
        | NodeMotion::Mass { .. }
        | NodeMotion::Constrained { .. } => None,
    }
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
