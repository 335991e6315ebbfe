//! The order in which objects are shown.

use crate::dynamics::model::{Model, PartInput};

/// Indices of the objects, each after its drivers; among equals by their order. The sum that
/// is the output of an object is shown with the object.
pub(super) fn drivers_first(model: &Model) -> Vec<usize> {
    let mut order: Vec<usize> = Vec::with_capacity(model.objects.len());
    let roots = (0..model.objects.len()).filter(|&o| model.objects[o].is_drive());
    order.extend(roots);
    let mut next = 0;
    while next < order.len() {
        let driver = order[next];
        let placed = |input: &PartInput| order.contains(&input.driver);
        let driven = |&o: &usize| {
            let object = &model.objects[o];
            let waits = object.is_driven_by(driver) && !order.contains(&o);
            object.is_reported() && waits && object.inputs.iter().all(placed)
        };
        let followers: Vec<usize> = (0..model.objects.len()).filter(driven).collect();
        order.extend(followers);
        next += 1;
    }
    order
}
