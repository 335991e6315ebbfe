//! Objects that are reduced to vibration modes: what their output is the sum of.

use super::units;
use crate::dynamics::model::{Model, ObjectPart, Reduced};
use crate::report::findings::Table;
use crate::report::quantity::significant;

/// For every object that is reduced: the share of each mode's deviation that its output
/// gets, the mode's natural frequency with the driven end held, and what the modes that
/// are left out give way by.
pub(super) fn table(model: &Model) -> Table {
    let mut table = Table::new([
        "object",
        "part",
        ">share of the output",
        ">rad/s",
        "besides",
    ]);
    for reduced in &model.reduced {
        let object = &model.objects[reduced.object];
        for (part, share, frequency) in modes(model, reduced) {
            let name = part.id.rsplit('.').next().unwrap_or(&part.id);
            table.push(vec![
                object.id.clone(),
                name.to_owned(),
                significant(share, 6),
                significant(frequency, 6),
                String::new(),
            ]);
        }
        if reduced.under_acceleration != 0.0 {
            table.push(vec![
                object.id.clone(),
                "the others".to_owned(),
                String::new(),
                String::new(),
                besides(reduced, units(object.coordinate).displacement),
            ]);
        }
    }
    table
}

/// The parts that an object's modes are, with their shares and natural frequencies.
pub(crate) fn modes<'m>(
    model: &'m Model,
    reduced: &'m Reduced,
) -> impl Iterator<Item = (&'m ObjectPart, f64, f64)> + 'm {
    reduced.modes.iter().filter_map(|&(node, share)| {
        let part = model
            .objects
            .iter()
            .find(|part| part.nodes.contains(&node))?;
        let stiffness = model.links[*part.links.first()?].stiffness;
        Some((part, share, (stiffness / model.nodes[node].inertia).sqrt()))
    })
}

/// The static correction.
fn besides(reduced: &Reduced, unit: &str) -> String {
    let correction = significant(reduced.under_acceleration, 6);
    let mut text = format!("−{correction} s²·φ̈ of the driven end");
    if reduced.offset != 0.0 {
        let sign = if reduced.offset < 0.0 { "−" } else { "+" };
        let size = significant(reduced.offset.abs(), 6);
        text.push_str(&format!(" {sign} {size} {unit} under the loads"));
    }
    text
}
