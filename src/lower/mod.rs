//! From objects to the model.

use crate::fault::Fault;
use crate::model::Model;
use crate::scene::Scene;

/// Lowers a scene's objects to a model.
///
/// # Errors
/// Every fault found, with the property it lies in.
pub fn lower(_scene: &Scene) -> Result<Model, Vec<Fault>> {
    todo!()
}
