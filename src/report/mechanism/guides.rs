//! Guides: their rails as far as the block travels, and what carries them; where a linkage is
//! driven and where its outputs are: on guides and pins.

use super::names::ground_pin;
use super::shape;
use super::view::View;
use super::{Drawing, Placement};
use crate::kinematics::linkage::spec::{OutputKind, PairKind, PairSpec, PointOf};
use crate::report::plot::coordinate;
use std::fmt::Write as _;

/// Half the height of a pair's block (m).
pub(super) fn block_height(pair: &PairSpec, extent: f64) -> f64 {
    shape::block(pair, extent).map_or(0.0, |block| block.half_height)
}

/// Two rails along the x axis, in pixels, hatched outside when they are fixed.
pub(super) fn rails([from, to]: [f64; 2], half_height: f64, scale: f64, fixed: bool) -> String {
    let (from, to, h) = (from * scale, to * scale, half_height * scale);
    let mut out = String::new();
    for side in [-1.0, 1.0] {
        let y = side * (h + 1.5);
        let _ = write!(
            out,
            "<path d=\"M{} {}H{}\"/>",
            coordinate(from),
            coordinate(y),
            coordinate(to)
        );
        let mut x = from + 6.0;
        while fixed && x < to {
            let _ = write!(
                out,
                "<path class=\"hatch\" d=\"M{} {}l-5 {}\"/>",
                coordinate(x),
                coordinate(y),
                coordinate(side * 6.0)
            );
            x += 9.0;
        }
    }
    out
}

/// What a sliding pair's block covers of its guide over all positions (m).
pub(super) fn travel(drawing: &Drawing<'_>, index: usize, extent: f64) -> [f64; 2] {
    let pair = &drawing.spec.pairs[index];
    let (PairKind::Sliding { direction, .. }, Some(block)) =
        (pair.kind, shape::block(pair, extent))
    else {
        return [0.0, 0.0];
    };
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    for frame in &drawing.frames {
        let at = |point: &PointOf| place(frame, point);
        let guide = pair.on.link.map_or(Placement::GROUND, |link| frame[link]);
        let (a, b) = (at(&pair.on), at(&pair.link));
        let [c, s] = guide.turn;
        let (x, y) = (direction.cos(), direction.sin());
        let along = (b[0] - a[0]) * (c * x - s * y) + (b[1] - a[1]) * (s * x + c * y);
        span = [span[0].min(along), span[1].max(along)];
    }
    if span[0] > span[1] {
        span = [0.0, 0.0];
    }
    let room = 0.02 * extent;
    [
        span[0] + block.ends[0] - room,
        span[1] + block.ends[1] + room,
    ]
}

/// The corners of a guide's rails and of its block in the frame of the ground, at
/// every position.
pub(super) fn outline(
    drawing: &Drawing<'_>,
    index: usize,
    extent: f64,
) -> impl Iterator<Item = [f64; 2]> {
    let pair = &drawing.spec.pairs[index];
    let sliding = match pair.kind {
        PairKind::Sliding { direction, .. } => Some(direction),
        _ => None,
    };
    let parts = sliding.zip(shape::block(pair, extent));
    let parts = parts.map(|(direction, block)| {
        let [from, to] =
            travel(drawing, index, extent).map(|along| on_axis(pair, direction, along));
        let h = block.half_height;
        let across = [-h * direction.sin(), h * direction.cos()];
        let beside = |[x, y]: [f64; 2], side: f64| [x + side * across[0], y + side * across[1]];
        let rails = [(from, -1.0), (from, 1.0), (to, -1.0), (to, 1.0)];
        let rails = rails.map(|(end, side)| beside(end, side));
        (rails, block.outline())
    });
    parts.into_iter().flat_map(move |(rails, block)| {
        let frames = drawing.frames.iter();
        frames.flat_map(move |frame| {
            let put = move |link: Option<usize>, at| place(frame, &PointOf { link, at });
            let rails = rails.map(|at| put(pair.on.link, at));
            rails
                .into_iter()
                .chain(block.map(|at| put(pair.link.link, at)))
        })
    })
}

/// A place on a guide's axis, in the frame of the guide's link.
pub(super) fn on_axis(pair: &PairSpec, direction: f64, along: f64) -> [f64; 2] {
    let [x, y] = pair.on.at;
    [x + along * direction.cos(), y + along * direction.sin()]
}

/// The nearest place of a guide's link from which a bar leads to its rails, such
/// as its pivot, and where along the guide it meets them; none where the link
/// itself lies between the rails or beside them.
pub(super) fn stem(
    drawing: &Drawing<'_>,
    index: usize,
    [from, to]: [f64; 2],
) -> Option<([f64; 2], f64)> {
    let pair = &drawing.spec.pairs[index];
    let (PairKind::Sliding { direction, .. }, Some(link)) = (pair.kind, pair.on.link) else {
        return None;
    };
    let project = |[x, y]: [f64; 2]| {
        let (dx, dy) = (x - pair.on.at[0], y - pair.on.at[1]);
        dx * direction.cos() + dy * direction.sin()
    };
    let places = shape::places(drawing.spec, link);
    let beside = |place: &[f64; 2]| project(*place) > from;
    let before = |place: &[f64; 2]| project(*place) < to;
    if places.iter().any(beside) && places.iter().any(before) {
        return None;
    }
    let foot = |place: [f64; 2]| (place, project(place).clamp(from, to));
    let length = |(at, along): &([f64; 2], f64)| {
        let end = on_axis(pair, direction, *along);
        (at[0] - end[0]).hypot(at[1] - end[1])
    };
    let bars = places.into_iter().map(foot);
    bars.min_by(|a, b| length(a).total_cmp(&length(b)))
}

/// The line across both rails where a bar meets them, in pixels.
pub(super) fn yoke(along: f64, half_height: f64) -> String {
    let (x, h) = (coordinate(along), half_height + 1.5);
    format!("<path d=\"M{x} {}V{}\"/>", coordinate(-h), coordinate(h))
}

/// A point in the frame of the ground.
pub(super) fn place(frame: &[Placement], point: &PointOf) -> [f64; 2] {
    match point.link {
        Some(link) => frame[link].point(point.at),
        None => point.at,
    }
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
        let pixel = |frame: &Vec<_>| view.pixel(place(frame, &point));
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
    pub(in crate::report) fn hold(&self, view: &View, output: &OutputKind) -> Option<Hold> {
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
