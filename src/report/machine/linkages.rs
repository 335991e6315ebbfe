//! Linkages of the machine: to scale, over their input coordinate.

use super::object_path::{Grip, ObjectPath, Picture, TURNS};
use crate::dynamics::model::{Model, MultiLinkageBody, ObjectPart};
use crate::dynamics::record::{Column, Quantity, Record};
use crate::kinematics::linkage::multi::spec::InputCoordinate;
use crate::kinematics::linkage::{Linkage, Pose};
use crate::report::html::player::{Body, PartDisplacement};
use crate::report::mechanism::{Axis, Drawing, Hold, Placement, View};

/// Places over the reach that is drawn.
const PLACES: usize = 361;

/// The picture of an object that is a linkage, of at most so many pixels a metre; `column` is its
/// input coordinate, `behind` what drives it, and whether in the same sense.
pub(super) fn picture(
    model: &Model,
    part: &ObjectPart,
    (way, behind): (&ObjectPath, Option<(&str, bool)>),
    (column, most): (usize, f64),
) -> Option<Picture> {
    let own = |index: usize| {
        model
            .objects
            .get(index)
            .is_some_and(|object| object.id == part.id)
    };
    let body = model.linkages.iter().find(|body| own(body.object))?;
    let id = |output: &str| format!("{}.{output}", part.id);
    Some(draw_linkage(
        &body.linkage,
        (way, behind),
        (column, most),
        id,
    ))
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
    let view = View::view_of_all_positions(&drawing, most);
    let bodies = (0..spec.links.len()).map(|link| Body::Rows {
        table: drawing.table(&view, link),
    });
    let (outlets, grips) = outputs(&drawing, &view, 0, |name| format!("{}.{name}", part.id));
    let inlets = linkage.inputs().iter().map(|input| match input.coordinate {
        InputCoordinate::Pair(pair) => drawing.inlet(&view, pair),
        _ => [0.0, 0.5 * view.height],
    });
    Some(Picture {
        bodies: bodies.collect(),
        drawn: drawing.draw_parts(&view, 0),
        size: [view.width, view.height],
        // Its links are rigid.
        pixels: 0.0,
        inlets: inlets.collect(),
        outlet: outlets.first().map_or(right_edge(&view), |(_, at)| *at),
        outlets,
        scale: Some(view.scale),
        shows_driver: false,
        grips,
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

/// The linkage that an object's law is the short form of; `behind` is its driver with its
/// path, `column` its coordinate.
pub(super) fn law(
    model: &Model,
    part: &ObjectPart,
    (behind, way): (&str, &ObjectPath),
    (column, most): (usize, f64),
) -> Option<Picture> {
    let law = model.nodes[*part.nodes.last()?].motion.law()?;
    let linkage = Linkage::new(law.position.as_linkage(way.start)?).ok()?;
    // Loads on an elastic object are shown on itself and not on its law.
    let shown = part.links.is_empty();
    let id = |_: &str| {
        if shown {
            part.id.clone()
        } else {
            String::new()
        }
    };
    Some(draw_linkage(
        &linkage,
        (way, Some((behind, true))),
        (column, most),
        id,
    ))
}

/// A linkage over its input; `id`: that of each of its outputs.
fn draw_linkage(
    linkage: &Linkage,
    (way, behind): (&ObjectPath, Option<(&str, bool)>),
    (column, most): (usize, f64),
    id: impl Fn(&str) -> String,
) -> Picture {
    let (from, to, repeats) = drawn_range(linkage, way);
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
    let view = View::view_of_all_positions(&drawing, most);
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
    let (outlets, mut grips) = outputs(&drawing, &view, start, id);
    if let Some((driver, same_sense)) = behind {
        let hold = drawing.hold_of_pair(&view, drawing.spec.driver);
        let turned = if same_sense { 1.0 } else { -1.0 };
        let grip = hold.map(|hold| grip_of_hold(hold, turned));
        grips.extend(grip.map(|grip| (driver.to_owned(), grip)));
    }
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
        drawn: drawing.draw_parts(&view, start) + &sense,
        size: [view.width, view.height],
        // Its links are rigid.
        pixels: 0.0,
        inlets: vec![drawing.inlet(&view, drawing.spec.driver)],
        outlet: outlets.first().map_or(right_edge(&view), |(_, at)| *at),
        outlets,
        scale: Some(view.scale),
        shows_driver: true,
        grips,
    }
}

/// Pixels at which the motion of outputs goes out, and where loads act on them, by their ids.
type Outputs = (Vec<(String, [f64; 2])>, Vec<(String, Grip)>);

fn outputs(
    drawing: &Drawing<'_>,
    view: &View,
    frame: usize,
    id: impl Fn(&str) -> String,
) -> Outputs {
    let all = || drawing.spec.outputs.iter();
    let outlets = all().map(|output| (id(&output.name), drawing.outlet(view, &output.kind, frame)));
    let grips = all().filter_map(|output| {
        let hold = drawing.force_place(view, &output.kind)?;
        Some((id(&output.name), grip_of_hold(hold, 1.0)))
    });
    (outlets.collect(), grips.collect())
}

/// The grip of a hold on a link, with its sense or turned round.
fn grip_of_hold(hold: Hold, sense: f64) -> Grip {
    Grip {
        part: hold.link,
        at: hold.at,
        along: hold.along.map(|part| sense * part),
        fixed: hold.fixed,
    }
}

/// The middle of the right edge.
fn right_edge(view: &View) -> [f64; 2] {
    [view.width, 0.5 * view.height]
}

/// A period of the input where the run goes through all of it, else as far as it goes.
fn drawn_range(linkage: &Linkage, way: &ObjectPath) -> (f64, f64, bool) {
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
