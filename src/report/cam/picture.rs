//! The cam with its follower as a drawing: stand-alone, and with groups that the
//! player of a page turns and moves.

use super::NamedCurve;
use super::view::number_text;
use super::view::{Mover, View, mover_of_cam, parts_of_cam, rim_radius, view};
use crate::kinematics::cam::{Contact, DiscCam, Guide, Surface};
use crate::report::html::player::{Body, PartDisplacement};
use crate::report::mechanism::marks::{scale_bar, turning_arrow};
use crate::report::plot::document;
use crate::report::quantity::{escape, with_unit};
use std::fmt::Write as _;

const STYLE: &str = "\
.cam-body{fill:var(--box-drive);stroke:var(--series-0);stroke-width:1.8;stroke-linejoin:round;fill-rule:evenodd}\
.cam-open{fill:none;stroke:var(--series-0);stroke-width:1.8}\
.cam-pitch{fill:none;stroke:var(--ink-soft);stroke-width:1;stroke-dasharray:6 4}\
.cam-base{fill:none;stroke:var(--faint);stroke-width:1;stroke-dasharray:2 4}\
.cam-mark{fill:none;stroke:var(--series-0);stroke-width:1.4}\
.cam-axis{fill:var(--paper);stroke:var(--ink);stroke-width:1.4}\
.cam-line{fill:none;stroke:var(--faint);stroke-width:1;stroke-dasharray:10 4 2 4}\
.follower{fill:var(--mechanism-back);stroke:var(--series-1);stroke-width:1.8;stroke-linejoin:round}\
.follower-arm{fill:none;stroke:var(--series-1);stroke-width:7;stroke-linecap:round;stroke-opacity:.75}\
.follower-pin{fill:var(--paper);stroke:var(--series-1);stroke-width:1.6}\
.dim path{fill:none;stroke:var(--ink-soft);stroke-width:1}\
.dim .barb{fill:var(--ink-soft);stroke:none}\
.dim text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;fill:var(--ink-soft);paint-order:stroke;stroke:var(--paper);stroke-width:3px;stroke-linejoin:round}\
.sense path{fill:none;stroke:var(--accent);stroke-width:1.8}\
.sense .barb{fill:var(--accent);stroke:none}";

/// Chord tolerance of drawn curves, of the prime circle: a tenth of a pixel.
const FINE: f64 = 3e-4;

/// The curves as they are drawn: no finer than can be seen.
pub(in crate::report) fn curves_to_draw(cam: &DiscCam) -> Vec<NamedCurve> {
    super::curves(cam, FINE * cam.geometry().prime_radius(), None).unwrap_or_default()
}

/// The drawing at φ (rad) as a complete SVG document on white ground.
pub fn picture(title: &str, cam: &DiscCam, phi: f64) -> String {
    let curves = curves_to_draw(cam);
    let view = view(cam, &curves);
    let body = drawing(cam, &curves, &view, phi, None) + &marks(cam, &view, true);
    let [width, height] = view.size;
    let bar = scale_bar(view.scale, [14.0, height + 2.0]);
    document("cam", [width, height + 16.0], title, STYLE, &(body + &bar))
}

/// The cam at φ as part 0 of a picture and its follower as part 1; with `beside`, an
/// outward displacement, the follower stands there, and once more, pale, as part 2.
pub(in crate::report) fn drawing(
    cam: &DiscCam,
    curves: &[NamedCurve],
    view: &View,
    phi: f64,
    beside: Option<f64>,
) -> String {
    let mover = mover_of_cam(cam, view);
    let (piece, at) = cam.motion().piece_at(phi);
    let lift = cam.motion().jet(piece, at).value;
    let part = |class: &str, link: usize, transform: String, place: [f64; 2], drawn: String| {
        format!(
            "<g{class} data-link=\"{link}\" transform=\"{transform}\">{}\n{drawn}</g></g>\n",
            group_at_pixel(place)
        )
    };
    let behind = |class: &str, link: usize, lift: f64| {
        let transform = follower_transform(&mover, lift);
        part(class, link, transform, mover.about, follower(cam, view))
    };
    let turned = rotation_attribute(mover.axis, mover.cam * phi);
    let mut out = part("", 0, turned, mover.axis, draw_cam_body(cam, curves, view));
    let [x, y] = mover.axis.map(number_text);
    let base = circle(
        "cam-base",
        mover.axis,
        view.scale * cam.geometry().base_radius,
    );
    let axis = circle("cam-axis", mover.axis, 6.0);
    let cross = format!("<path class=\"cam-mark\" d=\"M{x} {y}m-9 0h18m-9 -9v18\"/>");
    let _ = writeln!(out, "{base}\n{axis}{cross}");
    if let Some(law) = beside {
        out += &behind(" class=\"law\"", 2, law);
    }
    out += &behind("", 1, beside.unwrap_or(lift));
    if let Guide::Turning { .. } = cam.geometry().guide {
        let _ = writeln!(out, "{}", circle("follower-pin", mover.about, 6.0));
    }
    out
}

/// Dimensions in the picture, base circle and centre distance or offset, and the sense in which
/// the cam turns while φ grows (`forward`) or falls.
pub(in crate::report) fn marks(cam: &DiscCam, view: &View, forward: bool) -> String {
    let geometry = cam.geometry();
    let axis = view.origin;
    let mut out = String::new();
    // The base circle: a radius to the side on which no follower is.
    let parts = parts_of_cam(cam);
    let away = (-parts.tip[1]).atan2(-parts.tip[0]) - 0.5;
    let rim = [away.cos(), away.sin()].map(|part| geometry.base_radius * part);
    out.push_str(&dimension(
        [axis, view.point(rim)],
        [false, true],
        &format!("r = {}", with_unit(geometry.base_radius, "m", 4)),
    ));
    match geometry.guide {
        Guide::Turning {
            centre_distance, ..
        } => out.push_str(&dimension(
            [axis, view.point(parts.end)],
            [true, true],
            &format!("a = {}", with_unit(centre_distance, "m", 4)),
        )),
        Guide::Translating { offset } if offset != 0.0 => {
            // From the axis square to the follower's line.
            let [x, y] = parts.outward;
            let along = parts.tip[0] * x + parts.tip[1] * y;
            let foot = [parts.tip[0] - along * x, parts.tip[1] - along * y];
            let text = format!("e = {}", with_unit(offset, "m", 4));
            out.push_str(&dimension([axis, view.point(foot)], [true, true], &text));
        }
        Guide::Translating { .. } => {}
    }
    let radius = (0.42 * view.scale * geometry.base_radius).clamp(14.0, 40.0);
    let counterclockwise = (geometry.sense > 0.0) == forward;
    out + &turning_arrow(axis, radius, counterclockwise)
}

/// The pixels of the cam's axis, of the follower's axis or far end, and of its tip where it is
/// innermost.
pub(in crate::report) fn ends(cam: &DiscCam, view: &View) -> [[f64; 2]; 3] {
    let parts = parts_of_cam(cam);
    [view.origin, view.point(parts.end), view.point(parts.tip)]
}

/// Place of the text along a dimension line.
const TEXT: f64 = 0.66;

/// A dimension line between two pixels, with heads at chosen ends and its text beside it.
fn dimension([from, to]: [[f64; 2]; 2], heads: [bool; 2], text: &str) -> String {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let size = dx.hypot(dy);
    if !(size > 1.0) {
        return String::new();
    }
    let [ux, uy] = [dx / size, dy / size];
    let head = |[x, y]: [f64; 2], way: f64| {
        let back = |side: f64| {
            let (x, y) = (
                x - 8.0 * way * ux - side * uy,
                y - 8.0 * way * uy + side * ux,
            );
            format!("{} {}", number_text(x), number_text(y))
        };
        format!(
            "<path class=\"barb\" d=\"M{} {}L{}L{}z\"/>",
            number_text(x),
            number_text(y),
            back(2.6),
            back(-2.6)
        )
    };
    let ends = [(from, -1.0), (to, 1.0)].into_iter().zip(heads);
    let heads: String = ends
        .filter(|(_, shown)| *shown)
        .map(|((end, way), _)| head(end, way))
        .collect();
    format!(
        "<g class=\"dim\"><path d=\"M{} {}L{} {}\"/>{heads}<text text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text></g>\n",
        number_text(from[0]),
        number_text(from[1]),
        number_text(to[0]),
        number_text(to[1]),
        number_text(from[0] + TEXT * dx),
        number_text(from[1] + TEXT * dy - 5.0),
        escape(text),
    )
}

fn circle(class: &str, place: [f64; 2], radius: f64) -> String {
    let [x, y] = place.map(number_text);
    let r = number_text(radius);
    format!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>")
}

/// Opens a group whose own origin is a pixel of the picture.
fn group_at_pixel(place: [f64; 2]) -> String {
    let [x, y] = place.map(|value| number_text(-value));
    format!("<g transform=\"translate({x} {y})\">")
}

/// A turn about a pixel, by degrees clockwise.
fn rotation_attribute(place: [f64; 2], degrees: f64) -> String {
    let [x, y] = place.map(number_text);
    format!("translate({x} {y}) rotate({})", number_text(degrees))
}

fn follower_transform(mover: &Mover, lift: f64) -> String {
    let [x, y] = [0, 1].map(|axis| mover.about[axis] + mover.shift[axis] * lift);
    rotation_attribute([x, y], mover.turn * lift)
}

/// How the player moves cam and follower: the cam by the coordinate `cam_angle`
/// (rad), the follower by the outward displacement factor · coordinate − base.
pub(in crate::report) fn moving_bodies(
    cam: &DiscCam,
    view: &View,
    cam_angle: usize,
    follower: &Follower,
) -> [Body; 2] {
    let mover = mover_of_cam(cam, view);
    let Follower {
        column,
        factor,
        base,
        shown,
    } = *follower;
    // On the screen degrees count clockwise.
    let counterclockwise = |degrees: f64| -degrees.to_radians();
    let cam_body = Body::Turn {
        column: cam_angle,
        at: mover.axis,
        sense: counterclockwise(mover.cam),
        offset: 0.0,
        shown: PartDisplacement::True,
    };
    let turn = counterclockwise(mover.turn);
    let follower_body = match cam.geometry().guide {
        Guide::Turning { .. } => Body::Turn {
            column,
            at: mover.about,
            sense: turn * factor,
            offset: -turn * base,
            shown,
        },
        Guide::Translating { .. } => Body::Slide {
            column,
            at: [0, 1].map(|axis| mover.about[axis] - mover.shift[axis] * base),
            by: mover.shift.map(|shift| shift * factor),
            shown,
        },
    };
    [cam_body, follower_body]
}

/// Motion of a follower on a picture.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct Follower {
    /// The coordinate.
    pub(in crate::report) column: usize,
    /// Outward displacement by unit of the coordinate.
    pub(in crate::report) factor: f64,
    /// Offset of the coordinate, so that it is 0 where the follower is innermost.
    pub(in crate::report) base: f64,
    /// Displacement that is shown.
    pub(in crate::report) shown: PartDisplacement,
}

/// The cam's body in its own frame.
fn draw_cam_body(cam: &DiscCam, curves: &[NamedCurve], view: &View) -> String {
    let path = |name: &str| {
        let curve = curves.iter().find(|curve| curve.name == name)?;
        let mut text = String::new();
        for (index, &point) in curve.polygon.points.iter().enumerate() {
            let command = if index == 0 { 'M' } else { 'L' };
            let _ = write!(text, "{command}{}", view.text(point));
        }
        if curve.polygon.closed {
            text.push('z');
        }
        Some(text)
    };
    let mut out = String::new();
    let closed = cam.motion().is_closed();
    let class = if closed { "cam-body" } else { "cam-open" };
    let rim = rim(cam, curves, view);
    let profile = path("profile").unwrap_or_default();
    let body = match cam.geometry().surface {
        Surface::Disc => profile,
        Surface::Hollow => format!("{rim}{profile}"),
        Surface::Groove => {
            let (inner, outer) = (path("inner_flank"), path("outer_flank"));
            format!(
                "{rim}{}{}",
                outer.unwrap_or_default(),
                inner.unwrap_or_default()
            )
        }
    };
    let _ = writeln!(out, "<path class=\"{class}\" d=\"{body}\"/>");
    if let Some(pitch) = path("pitch") {
        let _ = writeln!(out, "<path class=\"cam-pitch\" d=\"{pitch}\"/>");
    }
    // A mark that shows how far the cam has turned.
    let direction = [
        cam.geometry().direction.cos(),
        cam.geometry().direction.sin(),
    ];
    let mark = direction.map(|part| 0.62 * cam.geometry().base_radius * part);
    let _ = writeln!(out, "{}", circle("cam-mark", view.point(mark), 4.0));
    out
}

fn rim(cam: &DiscCam, curves: &[NamedCurve], view: &View) -> String {
    let radius = view.scale * rim_radius(cam, curves);
    let [x, y] = view.origin;
    format!(
        "M{} {}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 {} 0z",
        number_text(x - radius),
        number_text(y),
        number_text(2.0 * radius),
        number_text(-2.0 * radius),
        r = number_text(radius)
    )
}

/// The follower where it is innermost.
fn follower(cam: &DiscCam, view: &View) -> String {
    let parts = parts_of_cam(cam);
    let mut out = String::new();
    let arm_end = match parts.face {
        Some([_, far]) if matches!(cam.geometry().guide, Guide::Turning { .. }) => far,
        _ => parts.tip,
    };
    let line = |class: &str, from: [f64; 2], to: [f64; 2], more: &str| {
        let (from, to) = (view.text(from), view.text(to));
        format!("<path class=\"{class}\" d=\"M{from}L{to}\"{more}/>")
    };
    let start = match (cam.geometry().guide, parts.face) {
        (Guide::Turning { .. }, Some([near, _])) => {
            out += &line("follower-arm", parts.end, near, "");
            near
        }
        _ => parts.end,
    };
    let _ = writeln!(out, "{}", line("follower-arm", start, arm_end, ""));
    let tip = view.point(parts.tip);
    let end = match (cam.geometry().contact, parts.face) {
        (Contact::Roller { radius }, _) => {
            circle("follower", tip, view.scale * radius) + &circle("follower-pin", tip, 2.5)
        }
        (Contact::KnifeEdge, _) => circle("follower", tip, 1.5),
        (Contact::Flat { .. }, Some([a, b])) => line("follower", a, b, " stroke-width=\"4\""),
        (Contact::Flat { .. }, None) => return out,
    };
    let _ = writeln!(out, "{end}");
    out
}

/// The style of the drawing, for pages.
pub(in crate::report) fn style() -> &'static str {
    STYLE
}
