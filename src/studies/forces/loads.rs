//! Forces on the outputs of a linkage over time: of loads on them, which may be given over
//! time, and of what hangs on them.

use super::ForceStudy;
use crate::dynamics::model::{Load, Model, ObjectPart};
use crate::dynamics::record::Quantity;
use crate::dynamics::system::System;
use crate::studies::kinematics::linkage_of;
use crate::studies::run::run;
use crate::studies::{Control, RunSettings};

/// Tolerance of the run that they are taken from.
const TOLERANCE: f64 = 1e-9;

/// Forces along each output of a linkage (N·m or N) at equal steps from t = 0 to `to`
/// (s), both ends included: those of a run of the scene.
///
/// `None` where nothing acts on an output, and where the run does not come to its end or
/// is not to be trusted.
pub(super) fn over_time(
    model: &Model,
    object: &str,
    to: f64,
    steps: usize,
) -> Option<Vec<Vec<f64>>> {
    let body = linkage_of(model, Some(object)).ok()?;
    let outputs = body.linkage.spec().outputs.iter();
    let ids: Vec<String> = outputs
        .map(|output| format!("{object}.{}", output.name))
        .collect();
    let of_output = |driver: usize| ids.contains(&model.objects[driver].id);
    let hangs = |part: &ObjectPart| (part.inputs.iter()).any(|input| of_output(input.driver));
    let loaded = (model.loads.iter()).any(|load| body.outputs.contains(&load.node));
    if !loaded && !model.objects.iter().any(hangs) {
        return None;
    }
    let settings = RunSettings {
        samples: steps,
        tolerance: TOLERANCE,
        ..RunSettings::new(to)
    };
    let system = System::new(model.clone()).ok()?;
    let result = run(&system, &settings, &Control::FREE, &mut []).ok()?;
    if !result.is_complete() || !result.is_trusted() {
        return None;
    }
    let columns = ids.iter().map(|id| {
        let column = result.record.column(id, Quantity::Reaction)?;
        (column.values.len() == steps + 1).then_some(&column.values)
    });
    let columns = columns.collect::<Option<Vec<_>>>()?;
    let row = |index: usize| columns.iter().map(|column| column[index]).collect();
    Some((0..=steps).map(row).collect())
}

/// What acts on the outputs and is not among the forces of a study, in a sentence.
pub fn loads_left_out(study: &ForceStudy, model: &Model, object: &str) -> Option<String> {
    if study.course.has_loads() {
        return None;
    }
    let behind: Vec<&str> = (loads_on_outputs(model, object).into_iter())
        .filter(|name| !study.acting.iter().any(|own| own == name))
        .collect();
    if behind.is_empty() {
        return None;
    }
    let instead = match study.several {
        None => ": --time includes them, and so does the --record of a run",
        Some(_) => "",
    };
    Some(format!(
        "the forces of what the linkage drives ({}) are not among its loads{instead}",
        behind.join(", ")
    ))
}

/// Objects that the linkage's outputs drive, and the loads on outputs.
fn loads_on_outputs<'m>(model: &'m Model, object: &str) -> Vec<&'m str> {
    let own = |id: &str| {
        id == object
            || id
                .strip_prefix(object)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let driven = |part: &&ObjectPart| {
        !own(&part.id) && (part.inputs.iter()).any(|input| own(&model.objects[input.driver].id))
    };
    let loaded = |load: &&Load| {
        let parts = model.objects.iter();
        let mut parts = parts.filter(|part| own(&part.id));
        parts.any(|part| part.nodes.contains(&load.node))
    };
    let objects = model.objects.iter().filter(driven);
    let loads = model.loads.iter().filter(loaded);
    (objects.map(|part| part.id.as_str()))
        .chain(loads.map(|load| load.name.as_str()))
        .collect()
}
