//! Objects that are reduced to vibration modes: what their output is the sum of. Behind a
//! contact element these are masses of a chain, which have no frequencies of their own.

use super::units;
use crate::dynamics::model::{ModalReduction, Model};
use crate::report::findings::Table;
use crate::report::quantity::significant;

/// For every object that is reduced: the share of each mode's deviation that its output
/// gets, the mode's natural frequency with the driven end held, and what the modes that
/// are left out give way by.
pub(super) fn table(model: &Model) -> Table {
    let chains = model.reduced.iter().all(|reduced| reduced.output.is_some());
    let mut names = vec!["object", "part", ">share of the output"];
    // A chain has nothing to say there.
    if !chains {
        names.extend([">rad/s", "besides"]);
    }
    let columns = names.len();
    let mut table = Table::new(names);
    let mut push = |mut row: Vec<String>| {
        row.truncate(columns);
        table.push(row);
    };
    for reduced in &model.reduced {
        let object = &model.objects[reduced.object];
        for mode in modes(model, reduced) {
            let frequency = mode.frequency.map(|frequency| significant(frequency, 6));
            push(vec![
                object.id.clone(),
                mode.name,
                significant(mode.share, 6),
                frequency.unwrap_or_default(),
                String::new(),
            ]);
        }
        if reduced.under_acceleration != 0.0 {
            push(vec![
                object.id.clone(),
                "the others".to_owned(),
                String::new(),
                String::new(),
                static_correction(reduced, units(object.coordinate).displacement),
            ]);
        }
    }
    table
}

/// A mode of a reduced object, or a mass of the chain that it is reduced to.
pub(crate) struct Summand {
    /// Address.
    pub(crate) id: String,
    /// Name within the object.
    name: String,
    /// Share of its deviation that the output gets.
    pub(crate) share: f64,
    /// Natural frequency of a mode (rad/s).
    pub(crate) frequency: Option<f64>,
}

/// What the output of a reduced object is the sum of.
pub(crate) fn modes(model: &Model, reduced: &ModalReduction) -> impl Iterator<Item = Summand> {
    reduced
        .modes
        .iter()
        .enumerate()
        .filter_map(|(place, &(node, share))| {
            if reduced.output.is_some() {
                return Some(Summand {
                    id: model.objects[reduced.object].id.clone(),
                    name: format!("mass {}", place + 1),
                    share,
                    frequency: None,
                });
            }
            let mut parts = model.objects.iter();
            let part = parts.find(|part| part.nodes.contains(&node))?;
            let stiffness = model.links[*part.links.first()?].stiffness;
            let name = part.id.rsplit('.').next().unwrap_or(&part.id);
            Some(Summand {
                id: part.id.clone(),
                name: name.to_owned(),
                share,
                frequency: Some((stiffness / model.nodes[node].inertia).sqrt()),
            })
        })
}

/// The static correction.
fn static_correction(reduced: &ModalReduction, unit: &str) -> String {
    let correction = significant(reduced.under_acceleration, 6);
    let mut text = format!("−{correction} s²·φ̈ of the driven end");
    if reduced.offset != 0.0 {
        let sign = if reduced.offset < 0.0 { "−" } else { "+" };
        let size = significant(reduced.offset.abs(), 6);
        text.push_str(&format!(" {sign} {size} {unit} under the loads"));
    }
    text
}
