//! What a scene says that is likely not meant: right in form, without effect or
//! without sense. Every finding is a warning in words, none is a fault.

mod creep;
mod loads;
mod node_path;
mod sizes;

use crate::dynamics::model::{Coordinate, Model, NodeMotion, ObjectPart};
use crate::dynamics::record::{Quantity, Record};
use crate::units::shown;
pub(super) use creep::{creep, may_creep};
use node_path::{Rotors, Stretch, node_paths};

/// What is likely not meant in a model that is to run for `duration` seconds, as
/// far as it can be told beforehand: loads without effect, windows and tables that
/// are never entered, stiffnesses and masses out of proportion, speeds beyond
/// sense. Every object is taken to follow its law.
pub fn warnings(model: &Model, duration: f64) -> Vec<String> {
    let known = node_paths(model, duration, Stretch::Run, Rotors::Unknown);
    let travel = |node: usize| known[node].as_ref().map(|way| way.displacement);
    let mut found = loads::without_effect(model, &travel, duration);
    let motors = behind_motors(model).contains(&true);
    let whole = node_paths(model, duration, Stretch::Whole, Rotors::Unknown);
    let even = motors.then(|| node_paths(model, duration, Stretch::Whole, Rotors::Even));
    found.extend(sizes::out_of_proportion(
        model,
        even.as_deref().unwrap_or(&whole),
    ));
    found.extend(sizes::unable_to_follow(model, &whole));
    found.extend(sizes::beyond_sense(model, &known));
    found
}

/// What only a run can tell, since a motor moves there as its loads let it:
/// windows and tables over its way that were never entered.
pub fn warnings_after(model: &Model, record: &Record) -> Vec<String> {
    let moved_by_motor = behind_motors(model);
    if !moved_by_motor.contains(&true) {
        return Vec::new();
    }
    let travel = |node: usize| match moved_by_motor[node] {
        true => travelled(model, record, node),
        // It has been told of before the run.
        false => None,
    };
    loads::never_entered_over_travel(model, &travel)
}

/// True when [`warnings_after`] or the search for creep looks at the samples of a run.
pub fn needs_samples(model: &Model) -> bool {
    let mut objects = 0..model.objects.len();
    behind_motors(model).contains(&true) || objects.any(|object| may_creep(model, object))
}

/// For every node whether a motor moves it.
fn behind_motors(model: &Model) -> Vec<bool> {
    let mut found: Vec<bool> = Vec::with_capacity(model.nodes.len());
    for node in &model.nodes {
        found.push(match &node.motion {
            NodeMotion::Rotor { .. } => true,
            NodeMotion::Prescribed { .. } => false,
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => found[law.driver],
            NodeMotion::Constrained { drivers, .. } => drivers.iter().any(|&driver| found[driver]),
        });
    }
    found
}

/// Where an object's last mass was, by the samples of a record.
fn travelled(model: &Model, record: &Record, node: usize) -> Option<[f64; 2]> {
    let own = |part: &&ObjectPart| part.nodes.last() == Some(&node);
    let id = &model.objects.iter().find(own)?.id;
    let column = record.column(id, Quantity::Displacement)?;
    let mut extremes = node_path::NOWHERE;
    for &value in &column.values {
        node_path::widen_range(&mut extremes, value);
    }
    (extremes[0] <= extremes[1]).then_some(extremes)
}

/// A displacement for reading: `12.5 deg`, `0.012 m`.
fn displacement_text(displacement: f64, coordinate: Coordinate) -> String {
    let (value, unit) = coordinate.displacement_for_reading(displacement);
    format!("{} {unit}", number_text(value))
}

/// A number of a doubt, to six digits.
fn number_text(value: f64) -> String {
    shown(value, 6)
}
