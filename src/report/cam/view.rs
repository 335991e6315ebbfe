//! Where things stand on the drawing of a cam, and how they move.

use super::NamedCurve;

use crate::kinematics::cam::{Contact, DiscCam, Guide, Surface};
use std::f64::consts::PI;

/// Width and height of the drawing (pixels).
const SIZE: f64 = 560.0;
const MARGIN: f64 = 24.0;

/// Scale and place of the drawing: pixels from the machine's metres.
pub(in crate::report) struct View {
    pub(in crate::report) scale: f64,
    pub(in crate::report) origin: [f64; 2],
    /// Width and height (pixels).
    pub(in crate::report) size: [f64; 2],
}

impl View {
    pub(super) fn point(&self, p: [f64; 2]) -> [f64; 2] {
        [
            self.origin[0] + self.scale * p[0],
            self.origin[1] - self.scale * p[1],
        ]
    }

    pub(super) fn text(&self, p: [f64; 2]) -> String {
        let [x, y] = self.point(p);
        format!("{} {}", number_text(x), number_text(y))
    }
}

/// Parts that move with the follower, where it is innermost, in the machine's frame.
pub(super) struct Parts {
    /// Centre of the roller, edge, or the face's foot on the follower's line.
    pub(super) tip: [f64; 2],
    /// Ends of a flat face.
    pub(super) face: Option<[[f64; 2]; 2]>,
    /// The follower's axis (turning) or the far end of its stem.
    pub(super) end: [f64; 2],
    /// Unit vector of outward motion of a translating follower.
    pub(super) outward: [f64; 2],
}

/// Motion of cam and follower on the picture.
pub(super) struct Mover {
    /// Pixels by metre of outward displacement (translating), else zero.
    pub(super) shift: [f64; 2],
    /// Degrees on the screen by radian of outward displacement.
    pub(super) turn: f64,
    /// Pixel about which it turns.
    pub(super) about: [f64; 2],
    /// Degrees on the screen by radian of the cam.
    pub(super) cam: f64,
    /// The cam's axis on the screen.
    pub(super) axis: [f64; 2],
}

/// Of a cam on a picture.
pub(super) fn mover_of_cam(cam: &DiscCam, view: &View) -> Mover {
    let geometry = cam.geometry();
    let (shift, turn, about) = match geometry.guide {
        Guide::Translating { .. } => {
            let outward = parts_of_cam(cam).outward;
            (
                [view.scale * outward[0], -view.scale * outward[1]],
                0.0,
                [0.0; 2],
            )
        }
        Guide::Turning { against, .. } => {
            let turn = geometry.sense * against * 180.0 / PI;
            ([0.0; 2], turn, view.point(parts_of_cam(cam).end))
        }
    };
    Mover {
        shift,
        turn,
        about,
        cam: -geometry.sense * 180.0 / PI,
        axis: view.origin,
    }
}

/// Greatest distance of a working curve from the axis (m).
fn greatest_distance(cam: &DiscCam, curves: &[NamedCurve]) -> f64 {
    let names = ["profile", "inner_flank", "outer_flank"];
    let shown = curves
        .iter()
        .filter(|curve| names.contains(&curve.name.as_str()));
    let points = shown.flat_map(|curve| &curve.polygon.points);
    let far = points.map(|point| point[0].hypot(point[1]));
    far.fold(cam.geometry().base_radius, f64::max)
}

/// Radius of the rim of a hollow or grooved cam (m); of a disc its reach.
pub(super) fn rim_radius(cam: &DiscCam, curves: &[NamedCurve]) -> f64 {
    let reach = greatest_distance(cam, curves);
    match cam.geometry().surface {
        Surface::Disc => reach,
        Surface::Hollow | Surface::Groove => reach + 0.12 * reach,
    }
}

pub(super) fn parts_of_cam(cam: &DiscCam) -> Parts {
    let geometry = cam.geometry();
    let pose = cam.innermost();
    let size = geometry.prime_radius();
    let along =
        |p: [f64; 2], d: [f64; 2], length: f64| [p[0] + length * d[0], p[1] + length * d[1]];
    let face = cam.needed_width().map(|needed| {
        let [least, most] = cam.face();
        match geometry.guide {
            Guide::Translating { .. } => {
                let width = match geometry.contact {
                    Contact::Flat {
                        width: Some(width), ..
                    } => width,
                    _ => 1.08 * needed,
                };
                [-0.5 * width, 0.5 * width].map(|place| along(pose.point, pose.along, place))
            }
            Guide::Turning { .. } => {
                let room = 0.06 * (most.value - least.value) + 0.04 * most.value;
                [least.value - room, most.value + room]
                    .map(|place| along(pose.point, pose.along, place))
            }
        }
    });
    let end = match geometry.guide {
        Guide::Translating { .. } => along(pose.point, pose.outward, 0.9 * size),
        Guide::Turning { .. } => pose.axis,
    };
    Parts {
        tip: pose.point,
        face,
        end,
        outward: pose.outward,
    }
}

/// A view that shows the cam at every angle, and the follower in and out.
pub(in crate::report) fn view(cam: &DiscCam, curves: &[NamedCurve]) -> View {
    view_within(cam, curves, f64::INFINITY)
}

/// Such a view of at most so many pixels a metre.
pub(in crate::report) fn view_within(cam: &DiscCam, curves: &[NamedCurve], most: f64) -> View {
    let pitch = curves.iter().filter(|curve| curve.name == "pitch");
    let pitch = pitch.flat_map(|curve| &curve.polygon.points);
    let radius = pitch
        .map(|point| point[0].hypot(point[1]))
        .fold(rim_radius(cam, curves), f64::max);
    let (mut low, mut high) = ([-radius; 2], [radius; 2]);
    let parts = parts_of_cam(cam);
    let roller = cam.geometry().roller().unwrap_or(0.0);
    let stroke = cam.motion().stroke();
    let mut shown = vec![parts.tip, parts.end];
    shown.extend(parts.face.into_iter().flatten());
    if let Guide::Translating { .. } = cam.geometry().guide {
        let moved = |p: &[f64; 2]| {
            [
                p[0] + stroke * parts.outward[0],
                p[1] + stroke * parts.outward[1],
            ]
        };
        shown.extend(shown.clone().iter().map(moved));
    } else {
        let turn = -cam.geometry().sense
            * match cam.geometry().guide {
                Guide::Turning { against, .. } => against,
                Guide::Translating { .. } => 0.0,
            };
        let (sin, cos) = (turn * stroke).sin_cos();
        let moved = |p: &[f64; 2]| {
            let (x, y) = (p[0] - parts.end[0], p[1] - parts.end[1]);
            [
                parts.end[0] + x * cos - y * sin,
                parts.end[1] + x * sin + y * cos,
            ]
        };
        shown.extend(shown.clone().iter().map(moved));
    }
    for point in shown {
        for axis in 0..2 {
            low[axis] = low[axis].min(point[axis] - roller);
            high[axis] = high[axis].max(point[axis] + roller);
        }
    }
    let spans = [high[0] - low[0], high[1] - low[1]];
    let scale = ((SIZE - 2.0 * MARGIN) / spans[0].max(spans[1])).min(most);
    View {
        scale,
        origin: [MARGIN - scale * low[0], MARGIN + scale * high[1]],
        size: spans.map(|span| scale * span + 2.0 * MARGIN),
    }
}

pub(super) fn number_text(value: f64) -> String {
    crate::report::plot::coordinate(value)
}
