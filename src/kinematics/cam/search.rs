//! Extremes and sign changes of smooth functions over the pieces of a turn.

use super::motion::{FollowerMotion, Piece, intervals_per_piece};
use crate::math::number::{Dual, Number};
use crate::math::optimise::golden;
use crate::math::order::Total;
use crate::math::roots::root;
use serde::Serialize;

/// A value and the cam's angle where it is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct At {
    /// The value.
    pub value: f64,
    /// The cam's angle φ (rad).
    pub phi: f64,
}

/// A point of a function: an end of a piece, a point of the search, or a place
/// where the derivative is zero. Between neighbours of one piece the function
/// is monotone.
#[derive(Clone, Copy, Debug)]
struct Node {
    piece: usize,
    at: At,
}

/// Local maxima among samples that are looked at more closely.
const CLOSELY: usize = 12;
/// Steps of golden section around each.
const STEPS: u32 = 60;

/// The greatest value of a function over pieces, of which samples (φ, value),
/// both ends among them, are given: the greatest local maxima of the samples
/// are improved by golden section. Value to rounding, place to about 1e-8.
pub(crate) fn refined(samples: &[Vec<(f64, f64)>], f: &dyn Fn(usize, f64) -> f64) -> At {
    let mut tops: Vec<(usize, usize)> = Vec::new();
    for (piece, samples) in samples.iter().enumerate() {
        let value = |index: usize| samples[index].1;
        let last = samples.len().saturating_sub(1);
        tops.extend((0..samples.len()).filter_map(|index| {
            // (Of equal neighbours, as over a dwell, the first stands for all.)
            let before = index == 0 || value(index) > value(index - 1);
            let after = index == last || value(index) >= value(index + 1);
            (before && after).then_some((piece, index))
        }));
    }
    let sample = |&(piece, index): &(usize, usize)| samples[piece][index];
    // Stable, so that of equal ones the first stays first.
    tops.sort_by_cached_key(|top| Total(-sample(top).1));
    let mut best: Option<At> = None;
    let mut take = |value: f64, phi: f64| {
        let slack = 1e-13 * value.abs();
        if best.is_none_or(|old| value > old.value + slack) {
            best = Some(At { value, phi });
        }
    };
    for top in tops.iter().take(CLOSELY) {
        let (phi, value) = sample(top);
        take(value, phi);
        let around = &samples[top.0];
        let low = around[top.1.saturating_sub(1)].0;
        let high = around[(top.1 + 1).min(around.len() - 1)].0;
        let peak = golden(&mut |phi| f(top.0, phi), [low, high], STEPS);
        take(peak.value, peak.at);
    }
    best.unwrap_or_default()
}

/// The greatest value of a function over stretches on which it is smooth.
pub(crate) fn greatest_over(pieces: &[[f64; 2]], f: &dyn Fn(usize, f64) -> f64) -> At {
    let samples: Vec<Vec<(f64, f64)>> = (pieces.iter().enumerate())
        .map(|(index, &ends)| {
            let places = evenly_spaced(ends, intervals_per_piece(pieces.len()));
            places.map(|phi| (phi, f(index, phi))).collect()
        })
        .collect();
    refined(&samples, f)
}

/// Equal steps between two ends, both of them exactly.
pub(crate) fn evenly_spaced([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |step| match step == count {
        true => to,
        false => from + (to - from) * step as f64 / count as f64,
    })
}

/// The greatest value of a function of the cam's angle that need not be smooth.
pub(crate) fn greatest(motion: &FollowerMotion, f: &dyn Fn(&Piece, f64) -> f64) -> At {
    let pieces = motion.pieces();
    let sampled = |piece: &Piece| {
        let places = (0..=piece.intervals).map(|step| piece.search_place(step));
        places.map(|phi| (phi, f(piece, phi))).collect()
    };
    let samples: Vec<Vec<(f64, f64)>> = pieces.iter().map(sampled).collect();
    refined(&samples, &|piece, phi| f(&pieces[piece], phi))
}

/// Least and greatest value over a turn; of equal ones the first.
pub(crate) fn extremes(motion: &FollowerMotion, f: &dyn Fn(&Piece, Dual) -> Dual) -> [At; 2] {
    let (mut least, mut greatest) = (None::<At>, None::<At>);
    for node in nodes(motion, f) {
        // Differences of rounding do not move the place.
        let slack = 1e-14 * node.at.value.abs();
        if least.is_none_or(|old| node.at.value < old.value - slack) {
            least = Some(node.at);
        }
        if greatest.is_none_or(|old| node.at.value > old.value + slack) {
            greatest = Some(node.at);
        }
    }
    [least.unwrap_or_default(), greatest.unwrap_or_default()]
}

/// Intervals of φ in which a function is negative, ends to rounding; the parts
/// on both sides of a joint are joined, and of a closed turn also those on both
/// sides of its beginning (which then ends beyond the turn).
pub(crate) fn negative(motion: &FollowerMotion, f: &dyn Fn(&Piece, Dual) -> Dual) -> Vec<[f64; 2]> {
    let list = nodes(motion, f);
    let mut found: Vec<[f64; 2]> = Vec::new();
    for pair in list.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let zero = |low: f64, high: f64| {
            let piece = &motion.pieces()[a.piece];
            root(&|phi| f(piece, Dual::new(phi, 0.0)).value, low, high)
        };
        let interval = match (a.piece == b.piece, a.at.value < 0.0, b.at.value < 0.0) {
            (false, ..) | (_, false, false) => continue,
            (_, true, true) => [a.at.phi, b.at.phi],
            (_, true, false) => [a.at.phi, zero(a.at.phi, b.at.phi)],
            (_, false, true) => [zero(a.at.phi, b.at.phi), b.at.phi],
        };
        match found.last_mut() {
            Some(last) if interval[0] <= last[1] => last[1] = interval[1],
            _ => found.push(interval),
        }
    }
    join_ends(motion, &mut found);
    found
}

/// Joins the last interval with the first of a closed turn.
fn join_ends(motion: &FollowerMotion, found: &mut Vec<[f64; 2]>) {
    let (from, to) = motion.range();
    let (Some(first), Some(last)) = (found.first().copied(), found.last().copied()) else {
        return;
    };
    if motion.is_closed() && found.len() > 1 && first[0] == from && last[1] == to {
        let index = found.len() - 1;
        found[index][1] = to + (first[1] - from);
        found.remove(0);
    }
}

fn nodes(motion: &FollowerMotion, f: &dyn Fn(&Piece, Dual) -> Dual) -> Vec<Node> {
    let mut list = Vec::new();
    for (index, piece) in motion.pieces().iter().enumerate() {
        let at = |phi: f64| f(piece, Dual::new(phi, 1.0));
        let mut put = |phi: f64, value: f64| {
            let at = At { value, phi };
            list.push(Node { piece: index, at });
        };
        let mut before = at(piece.from);
        put(piece.from, before.value());
        for step in 1..=piece.intervals {
            let (low, high) = (piece.search_place(step - 1), piece.search_place(step));
            let after = at(high);
            if before.derivative * after.derivative < 0.0 {
                let phi = root(&|phi| at(phi).derivative, low, high);
                put(phi, at(phi).value);
            }
            put(high, after.value);
            before = after;
        }
    }
    list
}
