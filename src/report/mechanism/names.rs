//! Names of pins, and the places at which they stand.

use super::Drawing;
use super::guides::point_in_ground;
use crate::kinematics::linkage::spec::{LinkageSpec, PairSpec, PointOf};

/// Where the name of a pin begins, right of it and above (pixels).
pub(super) const NAME: [f64; 2] = [8.0, 8.0];
/// Width of a letter of it, about (pixels).
const LETTER: f64 = 7.0;

/// Every pin in every position (m), and how far its name reaches to the right of
/// it (pixels).
pub(super) fn named_pins<'a>(
    drawing: &'a Drawing<'_>,
) -> impl Iterator<Item = ([f64; 2], f64)> + 'a {
    let pairs = drawing.spec.pairs.iter().enumerate();
    pairs.flat_map(move |(index, pair)| {
        let names = names(drawing.spec, index);
        let room = names.map(|names| NAME[0] + LETTER * names.chars().count() as f64);
        room.into_iter().flat_map(move |room| {
            let end = drawn_end(pair);
            let frames = drawing.frames.iter();
            frames.map(move |frame| (point_in_ground(frame, end), room))
        })
    })
}

/// The end of a pair that its pin is drawn at.
pub(super) fn drawn_end(pair: &PairSpec) -> &PointOf {
    match pair.link.link {
        Some(_) => &pair.link,
        None => &pair.on,
    }
}

/// The names of all pins in the place of this one; `None` unless it is the
/// first of them.
pub(super) fn names(spec: &LinkageSpec, index: usize) -> Option<String> {
    let pairs = &spec.pairs;
    let meet = |one: &PairSpec, other: &PairSpec| {
        let ends = [other.on, other.link];
        !other.slides() && (ends.contains(&one.on) || ends.contains(&one.link))
    };
    if pairs[index].slides() {
        return None;
    }
    // From pin to pin over the points that they share.
    let (mut group, mut seen) = (vec![index], 0);
    while seen < group.len() {
        for other in 0..pairs.len() {
            if !group.contains(&other) && meet(&pairs[group[seen]], &pairs[other]) {
                group.push(other);
            }
        }
        seen += 1;
    }
    group.sort_unstable();
    let names: Vec<&str> = group
        .iter()
        .map(|pair| pairs[*pair].name.as_str())
        .collect();
    (group[0] == index).then(|| names.join(", "))
}

/// The place of a pin between the ground and a link (m), and the link; `None` of other pairs.
pub(super) fn ground_pin(pair: &PairSpec) -> Option<([f64; 2], usize)> {
    let pin = match (pair.on.link, pair.link.link) {
        (None, Some(link)) => (pair.on.at, link),
        (Some(link), None) => (pair.link.at, link),
        _ => return None,
    };
    (!pair.slides()).then_some(pin)
}
