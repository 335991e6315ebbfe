//! Cams of the machine with their followers, to scale.

use super::Machine;
use super::object_path::{ObjectPath, Picture};
use crate::dynamics::model::ObjectPart;
use crate::kinematics::cam::{DiscCam, Guide};
use crate::report::cam::{Follower, bodies, drawing, drawn, view};
use crate::report::html::player::PartDisplacement;

/// The picture of a follower whose cam is known, `columns` being the coordinates of
/// the cam and of the follower.
pub(super) fn picture(
    machine: &Machine<'_>,
    part: &ObjectPart,
    way: &ObjectPath,
    columns: [usize; 2],
    elastic: bool,
) -> Option<Picture> {
    let (_, cam) = machine.cams.iter().find(|(id, _)| *id == part.id)?;
    let lever = machine.model.nodes[*part.nodes.last()?].motion.law()?.lever;
    let curves = drawn(cam);
    let view = view(cam, &curves);
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
    let mut all = bodies(cam, &view, columns[0], &follower(shown)).to_vec();
    if elastic {
        let [_, law] = bodies(cam, &view, columns[0], &follower(PartDisplacement::Law));
        all.push(law);
    }
    let start = follower(shown).factor * way.start - follower(shown).base;
    Some(Picture {
        drawn: drawing(
            cam,
            &curves,
            &view,
            cam.motion().range().0,
            Some(start).filter(|_| elastic),
        ),
        size: view.size,
        bodies: all,
        pixels: pixels(cam, view.scale) / lever.abs(),
    })
}

/// Length of a unit of outward displacement (pixels): of a turning follower at its tip.
fn pixels(cam: &DiscCam, scale: f64) -> f64 {
    match cam.geometry().guide {
        Guide::Translating { .. } => scale,
        Guide::Turning { arm, .. } => scale * arm,
    }
}
