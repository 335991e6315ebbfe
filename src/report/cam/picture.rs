//! The cam with its follower as a drawing: stand-alone, and with named groups
//! that the page's script turns and moves.

use super::NamedCurve;
use crate::cam::{Contact, DiscCam, Guide, Surface};
use crate::report::quantity::escape;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// Width and height of the drawing (pixels).
const SIZE: f64 = 560.0;
const MARGIN: f64 = 24.0;

const STYLE: &str = "\
.cam-body{fill:#dfe7f0;stroke:#1d5a9e;stroke-width:1.8;stroke-linejoin:round;fill-rule:evenodd}\
.cam-open{fill:none;stroke:#1d5a9e;stroke-width:1.8}\
.cam-pitch{fill:none;stroke:#7d8893;stroke-width:1;stroke-dasharray:6 4}\
.cam-base{fill:none;stroke:#a9b2bb;stroke-width:1;stroke-dasharray:2 4}\
.cam-mark{fill:none;stroke:#1d5a9e;stroke-width:1.4}\
.cam-axis{fill:#fff;stroke:#17202a;stroke-width:1.4}\
.cam-line{fill:none;stroke:#a9b2bb;stroke-width:1;stroke-dasharray:10 4 2 4}\
.follower{fill:#f6e3d6;stroke:#c04f15;stroke-width:1.8;stroke-linejoin:round}\
.follower-arm{fill:none;stroke:#c04f15;stroke-width:7;stroke-linecap:round;stroke-opacity:.75}\
.follower-pin{fill:#fff;stroke:#c04f15;stroke-width:1.6}";

/// Scale and place of the drawing: pixels from the machine's metres.
pub(super) struct View {
    scale: f64,
    origin: [f64; 2],
    /// Width and height (pixels).
    pub(super) size: [f64; 2],
}

impl View {
    fn point(&self, p: [f64; 2]) -> [f64; 2] {
        [
            self.origin[0] + self.scale * p[0],
            self.origin[1] - self.scale * p[1],
        ]
    }

    fn text(&self, p: [f64; 2]) -> String {
        let [x, y] = self.point(p);
        format!("{} {}", short(x), short(y))
    }
}

/// What moves with the follower, where it is innermost, in the machine's frame.
struct Parts {
    /// Centre of the roller, edge, or the face's foot on the follower's line.
    tip: [f64; 2],
    /// Ends of a flat face.
    face: Option<[[f64; 2]; 2]>,
    /// The follower's axis (turning) or the far end of its stem.
    end: [f64; 2],
    /// Unit vector of outward motion of a translating follower.
    outward: [f64; 2],
}

/// How the page's script moves the follower.
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

/// Chord tolerance of drawn curves, of the prime circle: a tenth of a pixel.
const FINE: f64 = 3e-4;

/// The curves as they are drawn: no finer than can be seen.
pub(super) fn drawn(cam: &DiscCam) -> Vec<NamedCurve> {
    super::curves(cam, FINE * cam.geometry().prime_radius(), None).unwrap_or_default()
}

/// The drawing at φ (rad) as a complete SVG document on white ground.
pub fn picture(title: &str, cam: &DiscCam, phi: f64) -> String {
    let curves = drawn(cam);
    let view = view(cam, &curves);
    let [w, h] = view.size.map(short);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
         height=\"{h}\" role=\"img\" aria-label=\"{}\">\n<style>{STYLE}</style>\n\
         <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n{}</svg>\n",
        escape(title),
        drawing(cam, &curves, &view, phi)
    )
}

/// Cam and follower as groups `cam-turning` and `cam-follower`.
pub(super) fn drawing(cam: &DiscCam, curves: &[NamedCurve], view: &View, phi: f64) -> String {
    let mover = mover(cam, view);
    let (piece, at) = cam.motion().locate(phi);
    let lift = cam.motion().jet(piece, at).value;
    let mut out = String::new();
    let base = cam.geometry().base_radius;
    let [x, y] = mover.axis.map(short);
    let _ = writeln!(
        out,
        "<g id=\"cam-turning\" transform=\"{}\">\n{}</g>",
        cam_transform(&mover, phi),
        body(cam, curves, view)
    );
    let _ = writeln!(
        out,
        "<circle class=\"cam-base\" cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>",
        short(view.scale * base)
    );
    let _ = writeln!(
        out,
        "<circle class=\"cam-axis\" cx=\"{x}\" cy=\"{y}\" r=\"6\"/><path class=\"cam-mark\" d=\"M{x} {y}m-9 0h18m-9 -9v18\"/>"
    );
    let _ = writeln!(
        out,
        "<g id=\"cam-follower\" transform=\"{}\">\n{}</g>",
        follower_transform(&mover, lift),
        follower(cam, view)
    );
    if let Guide::Turning { .. } = cam.geometry().guide {
        let [x, y] = mover.about.map(short);
        let _ = writeln!(
            out,
            "<circle class=\"follower-pin\" cx=\"{x}\" cy=\"{y}\" r=\"6\"/>"
        );
    }
    out
}

fn cam_transform(mover: &Mover, phi: f64) -> String {
    let [x, y] = mover.axis.map(short);
    format!("rotate({} {x} {y})", short(mover.cam * phi))
}

fn follower_transform(mover: &Mover, lift: f64) -> String {
    let [x, y] = mover.about.map(short);
    let [dx, dy] = mover.shift.map(|shift| short(shift * lift));
    format!(
        "translate({dx} {dy}) rotate({} {x} {y})",
        short(mover.turn * lift)
    )
}

/// What the script needs to know.
pub(super) fn mover(cam: &DiscCam, view: &View) -> Mover {
    let geometry = cam.geometry();
    let (shift, turn, about) = match geometry.guide {
        Guide::Translating { .. } => {
            let outward = parts(cam).outward;
            (
                [view.scale * outward[0], -view.scale * outward[1]],
                0.0,
                [0.0; 2],
            )
        }
        Guide::Turning { against, .. } => {
            let turn = geometry.sense * against * 180.0 / PI;
            ([0.0; 2], turn, view.point(parts(cam).end))
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

/// The cam's body in its own frame.
fn body(cam: &DiscCam, curves: &[NamedCurve], view: &View) -> String {
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
    let mark = 0.62 * cam.geometry().base_radius;
    let [x, y] = view.point([mark * direction[0], mark * direction[1]]);
    let _ = writeln!(
        out,
        "<circle class=\"cam-mark\" cx=\"{}\" cy=\"{}\" r=\"4\"/>",
        short(x),
        short(y)
    );
    out
}

/// Greatest distance of a working curve from the axis (m).
fn reach(cam: &DiscCam, curves: &[NamedCurve]) -> f64 {
    let names = ["profile", "inner_flank", "outer_flank"];
    let shown = curves
        .iter()
        .filter(|curve| names.contains(&curve.name.as_str()));
    let points = shown.flat_map(|curve| &curve.polygon.points);
    let far = points.map(|point| point[0].hypot(point[1]));
    far.fold(cam.geometry().base_radius, f64::max)
}

/// Radius of the rim of a hollow or grooved cam (m); of a disc its reach.
fn rim_radius(cam: &DiscCam, curves: &[NamedCurve]) -> f64 {
    let reach = reach(cam, curves);
    match cam.geometry().surface {
        Surface::Disc => reach,
        Surface::Hollow | Surface::Groove => reach + 0.12 * reach,
    }
}

fn rim(cam: &DiscCam, curves: &[NamedCurve], view: &View) -> String {
    let radius = view.scale * rim_radius(cam, curves);
    let [x, y] = view.origin;
    format!(
        "M{} {}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 {} 0z",
        short(x - radius),
        short(y),
        short(2.0 * radius),
        short(-2.0 * radius),
        r = short(radius)
    )
}

/// The follower where it is innermost.
fn follower(cam: &DiscCam, view: &View) -> String {
    let parts = parts(cam);
    let mut out = String::new();
    let arm_end = match parts.face {
        Some([_, far]) if matches!(cam.geometry().guide, Guide::Turning { .. }) => far,
        _ => parts.tip,
    };
    let start = match (cam.geometry().guide, parts.face) {
        (Guide::Turning { .. }, Some([near, _])) => {
            let _ = write!(
                out,
                "<path class=\"follower-arm\" d=\"M{}L{}\"/>",
                view.text(parts.end),
                view.text(near)
            );
            near
        }
        _ => parts.end,
    };
    let _ = writeln!(
        out,
        "<path class=\"follower-arm\" d=\"M{}L{}\"/>",
        view.text(start),
        view.text(arm_end)
    );
    let [x, y] = view.point(parts.tip).map(short);
    match cam.geometry().contact {
        Contact::Roller { radius } => {
            let _ = writeln!(
                out,
                "<circle class=\"follower\" cx=\"{x}\" cy=\"{y}\" r=\"{}\"/>\
                 <circle class=\"follower-pin\" cx=\"{x}\" cy=\"{y}\" r=\"2.5\"/>",
                short(view.scale * radius)
            );
        }
        Contact::KnifeEdge => {
            let _ = writeln!(
                out,
                "<circle class=\"follower\" cx=\"{x}\" cy=\"{y}\" r=\"1.5\"/>"
            );
        }
        Contact::Flat { .. } => {
            if let Some([a, b]) = parts.face {
                let _ = writeln!(
                    out,
                    "<path class=\"follower\" d=\"M{}L{}\" stroke-width=\"4\"/>",
                    view.text(a),
                    view.text(b)
                );
            }
        }
    }
    out
}

fn parts(cam: &DiscCam) -> Parts {
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
pub(super) fn view(cam: &DiscCam, curves: &[NamedCurve]) -> View {
    let pitch = curves.iter().filter(|curve| curve.name == "pitch");
    let pitch = pitch.flat_map(|curve| &curve.polygon.points);
    let radius = pitch
        .map(|point| point[0].hypot(point[1]))
        .fold(rim_radius(cam, curves), f64::max);
    let (mut low, mut high) = ([-radius; 2], [radius; 2]);
    let parts = parts(cam);
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
    let scale = (SIZE - 2.0 * MARGIN) / spans[0].max(spans[1]);
    View {
        scale,
        origin: [MARGIN - scale * low[0], MARGIN + scale * high[1]],
        size: spans.map(|span| scale * span + 2.0 * MARGIN),
    }
}

/// The style of the drawing, for pages.
pub(super) fn style() -> &'static str {
    STYLE
}

fn short(value: f64) -> String {
    crate::report::svg::coordinate(value)
}
