//! Outlines of links, in their own frames (m).

use super::Placement;
use crate::kinematics::linkage::couplings::{Outline, outlines};
use crate::kinematics::linkage::spec::{LinkageSpec, PairKind, PairSpec};
use crate::math::order::Total;

/// The distinct places of a link where something is: named points, pins, the
/// reference points of blocks and guides.
pub(super) fn places(spec: &LinkageSpec, link: usize) -> Vec<[f64; 2]> {
    let named = spec.links[link].points.iter().map(|point| point.at);
    let paired = spec.pairs.iter().flat_map(|pair| [&pair.on, &pair.link]);
    let welded = spec.welds.iter().flat_map(|weld| [&weld.on, &weld.link]);
    let paired = paired
        .chain(welded)
        .filter(|end| end.link == Some(link))
        .map(|end| end.at);
    let mut places: Vec<[f64; 2]> = Vec::new();
    for place in named.chain(paired) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    places
}

/// The corners of the convex hull of a link's places, counterclockwise; one or
/// two where it has no area.
pub(super) fn corners(spec: &LinkageSpec, link: usize) -> Vec<[f64; 2]> {
    hull(places(spec, link))
}

/// The convex hull (Andrew's monotone chain).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by_cached_key(|point| point.map(Total));
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while chain.len() >= 2
                && turn(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut whole = half(&mut points.iter().copied());
    whole.extend(half(&mut points.iter().rev().copied()));
    whole
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A block: its reference point and axis in the frame of its link, its ends
/// along the axis and half its height (m).
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// Reference point on link j.
    pub(super) at: [f64; 2],
    /// Angle of the guide's direction in the frame of link j (rad).
    pub(super) angle: f64,
    /// Ends along the guide, the lower first.
    pub(super) ends: [f64; 2],
    /// Half the height.
    pub(super) half_height: f64,
}

impl Block {
    /// Corners of the block, in the frame of its link.
    pub(super) fn outline(&self) -> [[f64; 2]; 4] {
        let (sin, cos) = self.angle.sin_cos();
        let [low, high] = self.ends;
        let h = self.half_height;
        [[low, -h], [high, -h], [high, h], [low, h]].map(|[x, y]| {
            [
                self.at[0] + cos * x - sin * y,
                self.at[1] + sin * x + cos * y,
            ]
        })
    }
}

/// The block of a sliding pair; where the scene gives no size, one that can be
/// seen in a mechanism of this extent.
pub(super) fn block(pair: &PairSpec, extent: f64) -> Option<Block> {
    let PairKind::Sliding {
        angle,
        corners,
        half_height,
        ..
    } = pair.kind
    else {
        return None;
    };
    let [b1, b2] = corners;
    let sized = b1 - b2 > 1e-3 * extent;
    let ends = if sized {
        [b2, b1]
    } else {
        [-0.035 * extent, 0.035 * extent]
    };
    Some(Block {
        at: pair.link.at,
        angle: -angle,
        ends,
        half_height: if half_height > 1e-3 * extent {
            half_height
        } else {
            0.02 * extent
        },
    })
}

/// Corners of a square about every pitch circle and roller, the ends of all lines and the points of
/// all flanks, at a position (m).
pub(super) fn outline_corners(spec: &LinkageSpec, frame: &[Placement]) -> Vec<[f64; 2]> {
    let placed = |link: Option<usize>, at: [f64; 2]| match link {
        Some(link) => frame.get(link).map_or(at, |placement| placement.point(at)),
        None => at,
    };
    let taken = |outline: Outline| match outline {
        Outline::Circle(link, centre, radius) | Outline::Roller(link, centre, radius) => {
            let [x, y] = placed(link, centre);
            vec![[x - radius, y - radius], [x + radius, y + radius]]
        }
        Outline::Line(link, ends) => ends.map(|end| placed(link, end)).to_vec(),
        Outline::Flank(link, points) => points.into_iter().map(|at| placed(link, at)).collect(),
    };
    outlines(spec).into_iter().flat_map(taken).collect()
}
