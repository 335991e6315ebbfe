//! The linear equations of a scene: of its elastic objects, or of its machine.

use super::machine::{has_motor, linearise_machine};
use super::model::LinearModel;
use super::modes::TreeModes;
use super::state_space::{Linearisation, StateSpace};
use crate::dynamics::system::System;
use crate::fault::Fault;

/// Most masses whose matrices are written: they grow with the square of their number.
const MOST_MASSES: usize = 400;

/// Linearises the elastic objects of a system behind prescribed drives, or a machine in the
/// steady turning of its motor.
///
/// # Errors
/// No object has linear equations; there are too many masses; modes cannot be found.
pub fn linearise(system: &System) -> Result<Linearisation, Vec<Fault>> {
    if has_motor(system.model()) {
        return linearise_machine(system);
    }
    let model = LinearModel::of(system)?;
    let masses = model.masses();
    if masses > MOST_MASSES {
        let message =
            format!("{masses} masses are more than matrices are written of: {MOST_MASSES}");
        return Err(vec![Fault::new(
            "",
            message,
            "give the objects fewer `masses`",
        )]);
    }
    Ok(Linearisation {
        case: "chain behind a prescribed drive",
        validity: validity(&model),
        operating_point: Vec::new(),
        state_space: StateSpace::of(&model),
        modes: TreeModes::of(&model)?,
        eigenvalues: Vec::new(),
        left_out: model.left_out,
    }
    .with_eigenvalues())
}

/// When the equations of a model hold.
fn validity(model: &LinearModel) -> String {
    let objects = model.trees.iter().flat_map(|tree| &tree.objects);
    let open: Vec<&str> = objects
        .filter(|object| object.opens.is_some())
        .map(|object| object.id.as_str())
        .collect();
    match open.is_empty() {
        true => "valid for motions in which no contact separates".to_owned(),
        false => format!(
            "valid only while the contact of {} is closed",
            open.join(", ")
        ),
    }
}
