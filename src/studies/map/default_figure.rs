//! The figure that a map shows when none is asked for.

use crate::dynamics::model::Model;

/// The figure of a map when none is asked for: the greatest |δ| of the last elastic
/// object, drivers before what they drive; `None` when nothing is elastic.
pub(super) fn default_figure(model: &Model, order: &[String]) -> Option<String> {
    let elastic = |id: &&String| {
        let part = model.objects.iter().find(|part| part.id == **id);
        part.is_some_and(|part| !part.links.is_empty() || part.driven_end.is_some())
    };
    let last = order.iter().rev().find(elastic)?;
    Some(format!("{last}.delta_abs"))
}

/// Why there is no figure to begin with, and which there are in every cell: those
/// of an object's whole motion, which rigid objects and drives have as well.
pub(super) fn no_elastic_object_message(model: &Model) -> String {
    let driven = model.objects.iter().rev().find(|part| !part.is_drive());
    let id = driven.or(model.objects.last());
    let id = id.map_or("object", |part| part.id.as_str());
    let all = ["peak_speed", "peak_acceleration", "peak_reaction"];
    let all = all.map(|name| format!("{id}.{name}")).join(", ");
    format!(
        "nothing in this scene is elastic at the corners and in the middle of the map: there is \
         no δ to map. Name a result with --figure; every cell has for example {all}"
    )
}
