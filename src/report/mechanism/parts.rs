//! The parts of the picture: ground, guides, links, pins, labels.

use super::shape::{self, Block};
use super::view::View;
use super::{Drawing, Placement};
use crate::linkage::spec::{PairKind, PairSpec, PointOf};
use crate::report::quantity::escape;
use crate::report::svg::coordinate;
use std::fmt::Write as _;

/// Half the width of a bar and the radius of a pin (pixels).
const BAR: f64 = 13.0;
const PIN: f64 = 4.2;

/// The picture of one position, between `<svg …>` and `</svg>`.
pub(super) fn picture(drawing: &Drawing<'_>, view: &View, frame: usize) -> String {
    let mut out = String::new();
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
            PairKind::Revolute { .. } => {
                for end in [&pair.on, &pair.link] {
                    if end.link.is_none() {
                        out.push_str(&support(view.pixel(end.at)));
                    }
                }
            }
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
                        rails(span, block_height(pair, view), view.scale, true)
                    );
                } else if pair.link.link.is_none() {
                    out.push_str(&support(view.pixel(pair.link.at)));
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

/// Half the height of a pair's block (m).
fn block_height(pair: &PairSpec, view: &View) -> f64 {
    shape::block(pair, view.extent).map_or(0.0, |block| block.half_height)
}

/// Two rails along the x axis, in pixels, hatched outside when they are fixed.
fn rails([from, to]: [f64; 2], half_height: f64, scale: f64, fixed: bool) -> String {
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
fn travel(drawing: &Drawing<'_>, index: usize, extent: f64) -> [f64; 2] {
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

/// Both ends of a guide's rails in the frame of the ground, at every position:
/// none for a guide of the ground.
pub(super) fn rail_ends(
    drawing: &Drawing<'_>,
    index: usize,
    extent: f64,
) -> impl Iterator<Item = [f64; 2]> {
    let pair = &drawing.spec.pairs[index];
    let moving = pair.on.link.zip(match pair.kind {
        PairKind::Sliding { direction, .. } => Some(direction),
        PairKind::Revolute { .. } => None,
    });
    let ends = moving.map(|(link, direction)| {
        let span = travel(drawing, index, extent);
        (link, span.map(|along| on_axis(pair, direction, along)))
    });
    ends.into_iter().flat_map(|(link, ends)| {
        let frames = drawing.frames.iter();
        frames.flat_map(move |frame| ends.map(|end| frame[link].point(end)))
    })
}

/// A place on a guide's axis, in the frame of the guide's link.
fn on_axis(pair: &PairSpec, direction: f64, along: f64) -> [f64; 2] {
    let [x, y] = pair.on.at;
    [x + along * direction.cos(), y + along * direction.sin()]
}

/// The line that joins a guide's rails to the nearest place of their link, such
/// as its pivot; none where one lies between the rails.
fn stem(drawing: &Drawing<'_>, index: usize, [from, to]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let pair = &drawing.spec.pairs[index];
    let (PairKind::Sliding { direction, .. }, Some(link)) = (pair.kind, pair.on.link) else {
        return None;
    };
    let foot = |[x, y]: [f64; 2]| {
        let (dx, dy) = (x - pair.on.at[0], y - pair.on.at[1]);
        let along = dx * direction.cos() + dy * direction.sin();
        on_axis(pair, direction, along.clamp(from, to))
    };
    let lines = shape::places(drawing.spec, link).into_iter();
    let lines = lines.map(|place| [place, foot(place)]);
    let length = |[a, b]: &[[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let shortest = lines.min_by(|a, b| length(a).total_cmp(&length(b)))?;
    (length(&shortest) > 1e-9 * (to - from).abs()).then_some(shortest)
}

/// A point in the frame of the ground.
fn place(frame: &[Placement], point: &PointOf) -> [f64; 2] {
    match point.link {
        Some(link) => frame[link].point(point.at),
        None => point.at,
    }
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
    let mut out = String::new();
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
            if let Some([from, to]) = stem(drawing, index, span) {
                let d = format!("M{}L{}", pixel(from), pixel(to));
                out.push_str(&bar(&d));
            }
            let _ = write!(
                out,
                "<g class=\"rail\" transform=\"translate({}) rotate({})\">{}</g>",
                pixel(pair.on.at),
                coordinate(-direction.to_degrees()),
                rails(span, block_height(pair, view), view.scale, false)
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
    for pair in &drawing.spec.pairs {
        if !matches!(pair.kind, PairKind::Revolute { .. }) {
            continue;
        }
        let end = match pair.link.link {
            Some(_) => &pair.link,
            None => &pair.on,
        };
        let at = frame.map_or(end.at, |frame| place(frame, end));
        let [x, y] = view.pixel(at);
        let on = end.link.map_or(String::from("-1"), |link| link.to_string());
        let _ = writeln!(
            out,
            "<g class=\"pin\" data-on=\"{on}\" data-at=\"{} {}\" transform=\"translate({} {})\">\
             <circle r=\"{PIN}\"/><text x=\"8\" y=\"-8\">{}</text></g>",
            coordinate(end.at[0] * view.scale),
            coordinate(-end.at[1] * view.scale),
            coordinate(x),
            coordinate(y),
            escape(&pair.name)
        );
    }
    out
}
