//! Guides: their rails as far as the block travels, and what carries them.

use super::shape;
use super::{Drawing, Placement};
use crate::kinematics::linkage::spec::{PairKind, PairSpec, PointOf};
use crate::report::plot::coordinate;
use std::fmt::Write as _;

/// Half the height (m) of the block of a prismatic joint in a drawing of a mechanism of this
/// extent (m); 0 for other joints.
pub(super) fn block_half_height(pair: &PairSpec, extent: f64) -> f64 {
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
        let at = |point: &PointOf| point_in_ground(frame, point);
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
            let put = move |link: Option<usize>, at| point_in_ground(frame, &PointOf { link, at });
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
pub(super) fn bar_to_rails(
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
pub(super) fn line_across_rails(along: f64, half_height: f64) -> String {
    let (x, h) = (coordinate(along), half_height + 1.5);
    format!("<path d=\"M{x} {}V{}\"/>", coordinate(-h), coordinate(h))
}

/// A point in the frame of the ground.
pub(super) fn point_in_ground(frame: &[Placement], point: &PointOf) -> [f64; 2] {
    match point.link {
        Some(link) => frame[link].point(point.at),
        None => point.at,
    }
}
