//! The parts of the picture: ground, guides, links, pins, labels; where motion comes in and goes
//! out, and where forces act.

use super::guides::{
    bar_to_rails, block_half_height, line_across_rails, on_axis, point_in_ground, rails, travel,
};
use super::names::{NAME, drawn_end, ground_pin, names};
use super::shape::{self, Block};
use super::view::View;
use super::{Drawing, Placement, wheels};
use crate::kinematics::linkage::spec::{OutputKind, PairKind, PairSpec, PointOf};
use crate::report::plot::coordinate;
use crate::report::quantity::escape;
use std::fmt::Write as _;

/// Half the width of a bar and the radius of a pin (pixels).
const BAR: f64 = 13.0;
const PIN: f64 = 4.2;

/// The picture of one position, between `<svg …>` and `</svg>`.
pub(super) fn picture(drawing: &Drawing<'_>, view: &View, frame: usize) -> String {
    let mut out = wheels::of_link(drawing, view, None, view.origin);
    out.push_str(&supports(drawing, view));
    let placed = drawing.frames.get(frame);
    // Blocks lie upon what they slide on.
    let layers: [fn(&Drawing<'_>, &View, usize) -> String; 2] = [bars, blocks];
    for part in layers {
        for link in 0..drawing.spec.links.len() {
            let placement = placed.and_then(|frame| frame.get(link));
            let transform = placement.map_or(String::new(), |placement| {
                format!(" transform=\"{}\"", view.transform(placement))
            });
            let drawn = part(drawing, view, link);
            if !drawn.is_empty() {
                let _ = writeln!(
                    out,
                    "<g class=\"link l{}\" data-link=\"{link}\"{transform}><title>{}</title>{drawn}</g>",
                    link % 8,
                    escape(&drawing.spec.links[link].name),
                );
            }
        }
    }
    out.push_str(&paths(drawing, view));
    out.push_str(&pins(drawing, view, placed));
    out
}

fn paths(drawing: &Drawing<'_>, view: &View) -> String {
    let mut out = String::new();
    for (index, path) in drawing.paths.iter().enumerate() {
        let mut d = String::new();
        for point in &path.points {
            let [x, y] = view.pixel(*point);
            if x.is_finite() && y.is_finite() {
                let pen = if d.is_empty() { 'M' } else { 'L' };
                let _ = write!(d, "{pen}{} {}", coordinate(x), coordinate(y));
            }
        }
        if drawing.axis.closed && !d.is_empty() {
            d.push('z');
        }
        let _ = writeln!(
            out,
            "<path class=\"path\" data-path=\"{index}\" d=\"{d}\"><title>{}</title></path>",
            escape(&path.name)
        );
    }
    out
}

/// Pins and guides of the ground.
fn supports(drawing: &Drawing<'_>, view: &View) -> String {
    let mut out = String::new();
    for (index, pair) in drawing.spec.pairs.iter().enumerate() {
        match pair.kind {
            PairKind::Sliding { direction, .. } => {
                if pair.on.link.is_none() {
                    let span = travel(drawing, index, view.extent);
                    let [x, y] = view.pixel(pair.on.at);
                    let _ = writeln!(
                        out,
                        "<g class=\"guide\" transform=\"translate({} {}) rotate({})\">{}</g>",
                        coordinate(x),
                        coordinate(y),
                        coordinate(-direction.to_degrees()),
                        rails(span, block_half_height(pair, view.extent), view.scale, true)
                    );
                } else if pair.link.link.is_none() {
                    out.push_str(&support(view.pixel(pair.link.at)));
                }
            }
            _ => {
                for end in [&pair.on, &pair.link] {
                    if end.link.is_none() {
                        out.push_str(&support(view.pixel(end.at)));
                    }
                }
            }
        }
    }
    out
}

/// The triangle under a fixed pin, hatched.
fn support([x, y]: [f64; 2]) -> String {
    let (x, y) = (coordinate(x), coordinate(y));
    format!(
        "<g class=\"ground\" transform=\"translate({x} {y})\"><path d=\"M0 0L-9 15H9z\"/>\
         <path d=\"M-14 15H14M-11 21l5 -6M-5 21l5 -6M1 21l5 -6M7 21l5 -6\"/></g>\n"
    )
}

/// A link's bar or plate and its guides, in pixels of its own frame.
fn bars(drawing: &Drawing<'_>, view: &View, link: usize) -> String {
    let spec = drawing.spec;
    let pixel = |[x, y]: [f64; 2]| {
        format!(
            "{} {}",
            coordinate(x * view.scale),
            coordinate(-y * view.scale)
        )
    };
    let mut out = wheels::of_link(drawing, view, Some(link), [0.0; 2]);
    let corners = shape::corners(spec, link);
    if corners.len() > 1 {
        let joined: Vec<String> = corners.iter().map(|corner| pixel(*corner)).collect();
        let closing = if corners.len() > 2 { "z" } else { "" };
        let d = format!("M{}{closing}", joined.join("L"));
        out.push_str(&bar(&d));
    }
    for (index, pair) in spec.pairs.iter().enumerate() {
        let PairKind::Sliding { direction, .. } = pair.kind else {
            continue;
        };
        if pair.on.link == Some(link) {
            let span = travel(drawing, index, view.extent);
            let half_height = block_half_height(pair, view.extent);
            let mut rails = rails(span, half_height, view.scale, false);
            if let Some((from, along)) = bar_to_rails(drawing, index, span) {
                let to = on_axis(pair, direction, along);
                out.push_str(&bar(&format!("M{}L{}", pixel(from), pixel(to))));
                rails.push_str(&line_across_rails(
                    along * view.scale,
                    half_height * view.scale,
                ));
            }
            let _ = write!(
                out,
                "<g class=\"rail\" transform=\"translate({}) rotate({})\">{}</g>",
                pixel(pair.on.at),
                coordinate(-direction.to_degrees()),
                rails
            );
        }
    }
    out
}

/// A bar along a path, with its edge.
fn bar(d: &str) -> String {
    format!(
        "<path class=\"edge\" d=\"{d}\" stroke-width=\"{}\"/><path class=\"body\" d=\"{d}\" \
         stroke-width=\"{BAR}\"/>",
        BAR + 2.4
    )
}

/// A link's blocks, in pixels of its own frame.
fn blocks(drawing: &Drawing<'_>, view: &View, link: usize) -> String {
    let pairs = drawing.spec.pairs.iter();
    let own = pairs.filter(|pair| pair.link.link == Some(link));
    let blocks = own.filter_map(|pair| shape::block(pair, view.extent));
    blocks.map(|block| rectangle(&block, view)).collect()
}

fn rectangle(block: &Block, view: &View) -> String {
    let scale = view.scale;
    format!(
        "<rect class=\"block\" transform=\"translate({} {}) rotate({})\" x=\"{}\" y=\"{}\" \
         width=\"{}\" height=\"{}\" rx=\"2\"/>",
        coordinate(block.at[0] * scale),
        coordinate(-block.at[1] * scale),
        coordinate(-block.angle.to_degrees()),
        coordinate(block.ends[0] * scale),
        coordinate(-block.half_height * scale),
        coordinate((block.ends[1] - block.ends[0]) * scale),
        coordinate(2.0 * block.half_height * scale)
    )
}

/// Pins of the revolute pairs with their names, above all links.
fn pins(drawing: &Drawing<'_>, view: &View, frame: Option<&Vec<Placement>>) -> String {
    let mut out = String::new();
    for (index, pair) in drawing.spec.pairs.iter().enumerate() {
        let Some(names) = names(drawing.spec, index) else {
            continue;
        };
        let end = drawn_end(pair);
        let at = frame.map_or(end.at, |frame| point_in_ground(frame, end));
        let [x, y] = view.pixel(at);
        let on = end.link.map_or(String::from("-1"), |link| link.to_string());
        let _ = writeln!(
            out,
            "<g class=\"pin\" data-on=\"{on}\" data-at=\"{} {}\" transform=\"translate({} {})\">\
             <circle r=\"{PIN}\"/><text x=\"{}\" y=\"-{}\">{}</text></g>",
            coordinate(end.at[0] * view.scale),
            coordinate(-end.at[1] * view.scale),
            coordinate(x),
            coordinate(y),
            NAME[0],
            NAME[1],
            escape(&names)
        );
    }
    out
}

/// Arm at which a moment is drawn as a force on a link without a second point (pixels).
const ARM: f64 = 40.0;
/// Places that are less apart than this are one to the eye (pixels).
const APART: f64 = 2.0;

/// Place of a link at which a force on a coordinate is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Hold {
    /// Index of the link.
    pub(in crate::report) link: usize,
    /// The place in the frame of the link (pixels, y downwards).
    pub(in crate::report) at: [f64; 2],
    /// Direction of a positive force or moment, of length 1: in the frame of the link, or of the
    /// ground.
    pub(in crate::report) along: [f64; 2],
    /// True where the direction is that of the ground.
    pub(in crate::report) fixed: bool,
}

impl Drawing<'_> {
    /// The pixel at which a line to what an output drives begins: the place of the output that is
    /// farthest to the right, or the one in a position where no other is.
    pub(in crate::report) fn outlet(
        &self,
        view: &View,
        output: &OutputKind,
        frame: usize,
    ) -> [f64; 2] {
        let point = self.place_of(output);
        let pixel = |frame: &Vec<_>| view.pixel(point_in_ground(frame, &point));
        let places = self.frames.iter().map(pixel);
        let finite = places.filter(|[x, y]| x.is_finite() && y.is_finite());
        let farthest = finite.max_by(|a, b| a[0].total_cmp(&b[0]));
        let own = self.frames.get(frame).map(pixel);
        let own = own.filter(|[x, y]| x.is_finite() && y.is_finite());
        match (own, farthest) {
            (Some(own), Some(farthest)) if farthest[0] - own[0] > APART => farthest,
            (Some(own), _) => own,
            (None, farthest) => farthest.unwrap_or([view.width, 0.5 * view.height]),
        }
    }

    /// The point of a link that an output is about.
    fn place_of(&self, output: &OutputKind) -> PointOf {
        match *output {
            OutputKind::Angle { link } => self.pivot(link),
            OutputKind::Point { point, .. } => point,
            OutputKind::Pair { pair } => moved(&self.spec.pairs[pair]).0,
        }
    }

    /// The pin on which a link turns in the ground, else its origin.
    fn pivot(&self, link: usize) -> PointOf {
        let pairs = self.spec.pairs.iter();
        let mut pins = pairs.filter(|pair| ground_pin(pair).is_some_and(|(_, own)| own == link));
        let origin = PointOf {
            link: Some(link),
            at: [0.0; 2],
        };
        pins.next().map_or(origin, |pair| moved(pair).0)
    }

    /// Where a force on an output is drawn; `None`: on the ground.
    pub(in crate::report) fn force_place(&self, view: &View, output: &OutputKind) -> Option<Hold> {
        match *output {
            OutputKind::Angle { link } => Some(self.moment(view, (link, self.pivot(link).at), 1.0)),
            OutputKind::Point { point, direction } => Some(Hold {
                link: point.link?,
                at: local(view, point.at),
                along: [direction.cos(), -direction.sin()],
                fixed: true,
            }),
            OutputKind::Pair { pair } => self.hold_of_pair(view, pair),
        }
    }

    /// Where a force on the relative coordinate of a pair is drawn; `None`: on the ground.
    pub(in crate::report) fn hold_of_pair(&self, view: &View, pair: usize) -> Option<Hold> {
        let pair = self.spec.pairs.get(pair)?;
        let (end, sense) = moved(pair);
        let link = end.link?;
        let PairKind::Sliding {
            direction, angle, ..
        } = pair.kind
        else {
            return Some(self.moment(view, (link, end.at), sense));
        };
        // The direction of the guide in the frame of the link.
        let turned = if sense > 0.0 { -angle } else { direction };
        Some(Hold {
            link,
            at: local(view, end.at),
            along: [sense * turned.cos(), -sense * turned.sin()],
            fixed: false,
        })
    }

    /// A moment on a link about a point of it: a force at the point farthest from there, square
    /// to its arm.
    fn moment(&self, view: &View, (link, pin): (usize, [f64; 2]), sense: f64) -> Hold {
        let points = self.spec.links[link].points.iter();
        let arms = points.map(|point| [point.at[0] - pin[0], point.at[1] - pin[1]]);
        let arm = arms.max_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        let arm = arm.filter(|[x, y]| x.hypot(*y) * view.scale > APART);
        let [x, y] = arm.unwrap_or([ARM / view.scale, 0.0]);
        let size = x.hypot(y);
        Hold {
            link,
            at: local(view, [pin[0] + x, pin[1] + y]),
            along: [-sense * y / size, -sense * x / size],
            fixed: false,
        }
    }

    /// The pixel at which the motion of a driving pair comes in: its pin in the ground, else the
    /// middle of the left edge.
    pub(in crate::report) fn inlet(&self, view: &View, pair: usize) -> [f64; 2] {
        let pin = self.spec.pairs.get(pair).and_then(ground_pin);
        pin.map_or([0.0, 0.5 * view.height], |(pin, _)| view.pixel(pin))
    }
}

/// A point of a link in its own frame (pixels, y downwards).
fn local(view: &View, [x, y]: [f64; 2]) -> [f64; 2] {
    [x * view.scale, -y * view.scale]
}

/// The end of a pair that moves, and with which sign its coordinate moves it.
fn moved(pair: &PairSpec) -> (PointOf, f64) {
    match pair.link.link {
        Some(_) => (pair.link, 1.0),
        None => (pair.on, -1.0),
    }
}
