//! Linkages of the machine: to scale, over their input coordinate.

use super::object_path::{ObjectPath, Picture, TURNS};
use crate::dynamics::model::{Model, MultiLinkageBody, ObjectPart};
use crate::dynamics::record::{Column, Quantity, Record};
use crate::kinematics::linkage::{Linkage, Pose};
use crate::report::html::player::{Body, PartDisplacement};
use crate::report::mechanism::{Axis, Drawing, Placement, View};

/// Places over the reach that is drawn.
const PLACES: usize = 361;

/// The picture of an object that is a linkage, of at most so many pixels a metre; `column` is its
/// input coordinate.
pub(super) fn picture(
    model: &Model,
    part: &ObjectPart,
    way: &ObjectPath,
    (column, most): (usize, f64),
) -> Option<Picture> {
    let own = |index: usize| {
        model
            .objects
            .get(index)
            .is_some_and(|object| object.id == part.id)
    };
    let body = model.linkages.iter().find(|body| own(body.object))?;
    Some(drawn(&body.linkage, way, column, most))
}

/// The picture of an object that is a linkage of several inputs, over the rows of the record.
pub(super) fn multi_input_picture(
    model: &Model,
    part: &ObjectPart,
    record: &Record,
    most: f64,
) -> Option<Picture> {
    let own = |body: &&MultiLinkageBody| model.objects[body.object].id == part.id;
    let body = model.multi_linkages.iter().find(own)?;
    let linkage = &body.linkage;
    let columns: Vec<&Column> = (linkage.inputs().iter())
        .map(|input| {
            record.column(
                &format!("{}.{}", part.id, input.name),
                Quantity::Displacement,
            )
        })
        .collect::<Option<_>>()?;
    let still = vec![0.0; columns.len()];
    let mut space = linkage.workspace::<f64>();
    let spec = &linkage.spec().linkage;
    let frame = |row: usize| {
        let inputs: Vec<f64> = columns.iter().map(|column| column.values[row]).collect();
        match space.solve(&inputs, &still) {
            Ok(()) => (0..spec.links.len())
                .map(|link| placement(space.pose(link)))
                .collect(),
            Err(_) => vec![NOWHERE; spec.links.len()],
        }
    };
    let drawing = Drawing {
        spec,
        frames: (0..record.times.len()).map(frame).collect(),
        axis: Axis {
            name: String::new(),
            unit: String::new(),
            times: Vec::new(),
            values: record.times.clone(),
            closed: false,
        },
        paths: Vec::new(),
        arrows: Vec::new(),
    };
    let view = View::within(&drawing, most);
    let bodies = (0..spec.links.len()).map(|link| Body::Rows {
        table: drawing.table(&view, link),
    });
    Some(Picture {
        bodies: bodies.collect(),
        drawn: drawing.parts(&view, 0),
        size: [view.width, view.height],
        // Its links are rigid.
        pixels: 0.0,
        inlet: [0.0, 0.5 * view.height],
        outlet: [view.width, 0.5 * view.height],
        scale: Some(view.scale),
        shows_driver: false,
        grip: None,
    })
}

/// A place that is no number.
const NOWHERE: Placement = Placement {
    at: [f64::NAN; 2],
    turn: [1.0, 0.0],
};

fn placement(pose: Pose) -> Placement {
    Placement {
        at: [pose.x, pose.y],
        turn: [pose.cos, pose.sin],
    }
}

/// The linkage that an object's law is the short form of; `way` and `column` are those
/// of its driver.
pub(super) fn law(
    model: &Model,
    part: &ObjectPart,
    way: &ObjectPath,
    (column, most): (usize, f64),
) -> Option<Picture> {
    let law = model.nodes[*part.nodes.last()?].motion.law()?;
    let linkage = Linkage::new(law.position.as_linkage(way.start)?).ok()?;
    Some(drawn(&linkage, way, column, most))
}

fn drawn(linkage: &Linkage, way: &ObjectPath, column: usize, most: f64) -> Picture {
    let (from, to, repeats) = reach(linkage, way);
    let inputs: Vec<f64> = (0..PLACES)
        .map(|place| from + (to - from) * place as f64 / (PLACES - 1) as f64)
        .collect();
    let drawing = Drawing {
        spec: linkage.spec(),
        frames: frames(linkage, &inputs),
        axis: Axis {
            name: String::new(),
            unit: String::new(),
            times: Vec::new(),
            values: inputs,
            closed: repeats,
        },
        paths: Vec::new(),
        arrows: Vec::new(),
    };
    let view = View::within(&drawing, most);
    let share = (way.start - from) / (to - from);
    let share = if repeats {
        share.rem_euclid(1.0)
    } else {
        share.clamp(0.0, 1.0)
    };
    let start = (share * (PLACES - 1) as f64).round() as usize;
    let sense = match way.one_way {
        true => drawing.sense_mark(&view, way.forward, TURNS),
        false => String::new(),
    };
    let [inlet, outlet] = drawing.ends(&view);
    let bodies = (0..linkage.spec().links.len()).map(|link| Body::Over {
        column,
        from,
        to,
        repeats,
        shown: PartDisplacement::True,
        table: drawing.table(&view, link),
    });
    Picture {
        bodies: bodies.collect(),
        drawn: drawing.parts(&view, start) + &sense,
        size: [view.width, view.height],
        // Its links are rigid.
        pixels: 0.0,
        inlet,
        outlet,
        scale: Some(view.scale),
        shows_driver: true,
        grip: None,
    }
}

/// A period of the input where the run goes through all of it, else as far as it goes.
fn reach(linkage: &Linkage, way: &ObjectPath) -> (f64, f64, bool) {
    let [least, greatest] = way.range;
    match linkage.range().period {
        Some(period) if way.travel() >= period.length => (least, least + period.length, true),
        _ if greatest > least => (least, greatest, false),
        // It does not move: any reach will do.
        _ => (least, least + 1.0, false),
    }
}

/// The links at every input; places that are no numbers where they cannot be.
fn frames(linkage: &Linkage, inputs: &[f64]) -> Vec<Vec<Placement>> {
    let mut work = linkage.workspace();
    let links = linkage.spec().links.len();
    let frame = |&input: &f64| match linkage.solve(input, 0, &mut work) {
        Ok(()) => (0..links).map(|link| placement(work.pose(link))).collect(),
        Err(_) => vec![NOWHERE; links],
    };
    inputs.iter().map(frame).collect()
}
