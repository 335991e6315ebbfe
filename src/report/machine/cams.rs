//! Cams of the machine with their followers, to scale.

use super::Machine;
use super::object_path::{Grip, ObjectPath, Picture};
use crate::dynamics::model::ObjectPart;
use crate::kinematics::cam::{DiscCam, Guide};
use crate::report::cam::{
    Follower, curves_to_draw, drawing, ends, marks, moving_bodies, view_within,
};
use crate::report::html::player::{Body, PartDisplacement};

/// The picture of a follower whose cam is known, `columns` being the coordinates of
/// the cam and of the follower, of at most so many pixels a metre.
pub(super) fn picture(
    machine: &Machine<'_>,
    part: &ObjectPart,
    way: &ObjectPath,
    (driver_id, driver): (&str, &ObjectPath),
    (columns, elastic, most): ([usize; 2], bool, f64),
) -> Option<Picture> {
    let (_, cam) = machine.cams.iter().find(|(id, _)| *id == part.id)?;
    let lever = machine.model.nodes[*part.nodes.last()?].motion.law()?.lever;
    let curves = curves_to_draw(cam);
    let view = view_within(cam, &curves, most);
    let outward = cam.geometry().outward;
    let follower = |shown: PartDisplacement| Follower {
        column: columns[1],
        factor: outward / lever,
        base: outward * cam.motion().innermost(),
        shown,
    };
    let shown = if elastic {
        PartDisplacement::Magnified
    } else {
        PartDisplacement::True
    };
    let mut all = moving_bodies(cam, &view, columns[0], &follower(shown)).to_vec();
    if elastic {
        let [_, law] = moving_bodies(cam, &view, columns[0], &follower(PartDisplacement::Law));
        all.push(law);
    }
    let start = follower(shown).factor * way.start - follower(shown).base;
    let parts = drawing(
        cam,
        &curves,
        &view,
        cam.motion().range().0,
        Some(start).filter(|_| elastic),
    );
    let [inlet, outlet, tip] = ends(cam, &view);
    let follower = load_points_on_body(&all[1], [outlet, tip]).map(|grip| (part.id.clone(), grip));
    let radius = view.scale * cam.geometry().base_radius;
    let turned = on_cam(&all[0], radius).map(|grip| (driver_id.to_owned(), grip));
    Some(Picture {
        drawn: parts + &marks(cam, &view, driver.forward),
        size: view.size,
        bodies: all,
        pixels: pixels(cam, view.scale) / lever.abs(),
        inlets: vec![inlet],
        outlet,
        outlets: Vec::new(),
        scale: Some(view.scale),
        shows_driver: true,
        grips: follower.into_iter().chain(turned).collect(),
    })
}

/// Where loads act on the follower, its second part: on a sliding one at its far end, on a turning
/// one at its tip, square to its arm.
fn load_points_on_body(follower: &Body, [end, tip]: [[f64; 2]; 2]) -> Option<Grip> {
    let (at, along) = match *follower {
        Body::Slide { by, .. } => (end, by),
        Body::Turn { at, sense, .. } => {
            let [x, y] = [tip[0] - at[0], tip[1] - at[1]];
            ([x, y], [sense.signum() * y, -sense.signum() * x])
        }
        Body::Rows { .. } | Body::Over { .. } => return None,
    };
    let size = along[0].hypot(along[1]);
    (size > 0.0).then(|| Grip {
        part: 1,
        at,
        along: along.map(|part| part / size),
        fixed: false,
    })
}

/// Where the moment on the cam acts, its first part: on its base circle, square to the radius.
fn on_cam(cam: &Body, radius: f64) -> Option<Grip> {
    match *cam {
        Body::Turn { sense, .. } => Some(Grip {
            part: 0,
            at: [radius, 0.0],
            along: [0.0, -sense.signum()],
            fixed: false,
        }),
        Body::Slide { .. } | Body::Rows { .. } | Body::Over { .. } => None,
    }
}

/// Length of a unit of outward displacement (pixels): of a turning follower at its tip.
fn pixels(cam: &DiscCam, scale: f64) -> f64 {
    match cam.geometry().guide {
        Guide::Translating { .. } => scale,
        Guide::Turning { arm, .. } => scale * arm,
    }
}
