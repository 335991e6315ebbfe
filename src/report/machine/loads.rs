//! Loads of the machine as arrows: the sum of the loads on an object's output over the record.

use super::whole::Whole;
use crate::dynamics::model::{Coordinate, Model, NodeIndex, ObjectPart};
use crate::dynamics::record::{Quantity, Record};
use crate::report::html::player::{Arrows, ForceArrow};
use crate::report::plot::Plots;
use crate::report::quantity::with_unit;
use std::collections::{BTreeMap, BTreeSet};

/// Length of the longest arrow of a load (pixels).
const LONGEST: f64 = 64.0;
/// Digits of the force of an arrow.
const DIGITS: usize = 6;

/// Displacement and speed of the nodes that the record has, over its rows.
struct Motions<'a>(BTreeMap<NodeIndex, [&'a [f64]; 2]>);

impl<'a> Motions<'a> {
    fn of(model: &Model, record: &'a Record) -> Self {
        let own = |part: &ObjectPart| {
            let column = |quantity| Some(&record.column(&part.id, quantity)?.values[..]);
            let both = [column(Quantity::Displacement)?, column(Quantity::Speed)?];
            Some((*part.nodes.last()?, both))
        };
        Self(model.objects.iter().filter_map(own).collect())
    }

    fn at(&self, node: NodeIndex, row: usize) -> Option<(f64, f64)> {
        let [displacement, speed] = self.0.get(&node)?;
        Some((*displacement.get(row)?, *speed.get(row)?))
    }

    /// The sum of the loads on the output of an object at every row; `None`: there are none, or
    /// one is not known.
    fn loads(&self, model: &Model, part: &ObjectPart, record: &Record) -> Option<Vec<f64>> {
        let node = *part.nodes.last()?;
        let loads = || {
            let own = model.loads.iter().filter(move |load| load.node == node);
            // (What dry friction holds at rest, the motion does not tell.)
            own.filter(|load| !load.law.is_stop() && load.law.dry_friction().is_none())
        };
        loads().next()?;
        let rows = record.times.iter().enumerate();
        rows.map(|(row, &time)| {
            let motion = |node| self.at(node, row);
            let forces = loads().map(|load| load.force(time, motion, &model.tracks));
            forces.sum::<Option<f64>>()
        })
        .collect()
    }
}

/// The loads on what stations show, each to a scale of its own; `None` where none is known.
pub(super) fn arrows(
    model: &Model,
    whole: &Whole<'_>,
    record: &Record,
    plots: &mut Plots,
) -> Option<Arrows> {
    let motions = Motions::of(model, record);
    let (mut on, mut named, mut shown) = (Vec::new(), Vec::new(), BTreeSet::new());
    let placed = whole.placed_stations().collect::<Vec<_>>();
    // What has a picture of its own is not shown on what it drives.
    let own = |id: &str| placed.iter().any(|(station, ..)| station.id == id);
    for &(station, first, origin) in &placed {
        for (id, grip) in &station.picture.grips {
            let Some(part) = model.objects.iter().find(|part| part.id == *id) else {
                continue;
            };
            if (*id != station.id && own(id)) || shown.contains(id) {
                continue;
            }
            let Some((force, greatest)) = force(&motions, (model, part), record, plots) else {
                continue;
            };
            shown.insert(id.clone());
            on.push(ForceArrow {
                body: first + grip.part,
                origin,
                at: grip.at,
                by: grip.along.map(|share| share * LONGEST / greatest),
                fixed: grip.fixed,
                column: force,
            });
            named.push(format!("{id} {}", with_unit(greatest, unit(part), 4)));
        }
    }
    (!on.is_empty()).then(|| Arrows {
        name: "loads".to_owned(),
        caption: format!("loads, longest {}", named.join(", ")),
        greatest: None,
        shown: true,
        arrows: Vec::new(),
        on,
    })
}

/// The column of the loads on the output of an object, and their greatest size; `None`: there are
/// none.
fn force(
    motions: &Motions<'_>,
    (model, part): (&Model, &ObjectPart),
    record: &Record,
    plots: &mut Plots,
) -> Option<(usize, f64)> {
    let forces = motions.loads(model, part, record)?;
    let finite = forces.iter().filter(|force| force.is_finite());
    let greatest = finite.fold(0.0, |most: f64, force| most.max(force.abs()));
    (greatest > 0.0).then(|| (plots.column(&forces, DIGITS), greatest))
}

/// SI unit of the forces that act along the coordinate of an object.
fn unit(part: &ObjectPart) -> &'static str {
    match part.coordinate {
        Coordinate::Turning => "N m",
        Coordinate::Sliding => "N",
    }
}

/// The lines of the arrows, which the player places.
pub(super) fn layer(arrows: &Arrows) -> String {
    let line = "<line marker-end=\"url(#load-head)\" visibility=\"hidden\"/>";
    format!(
        "<defs><marker id=\"load-head\" class=\"head a3\" viewBox=\"0 0 10 10\" refX=\"8.5\" refY=\"5\" \
         markerWidth=\"7\" markerHeight=\"7\" orient=\"auto-start-reverse\"><path d=\"M0 0.8L10 5L0 9.2z\"/>\
         </marker></defs>\n<g class=\"arrows a3\" data-set=\"0\">{}</g>\n",
        line.repeat(arrows.on.len())
    )
}
