//! Extremes and sign changes of smooth functions over the pieces of a turn.

use super::motion::{FollowerMotion, Piece};
use crate::number::{Dual, Number};
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

/// Zero of a continuous function between two places where its signs differ,
/// to rounding.
pub(crate) fn root(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let (mut low, mut high) = (from, to);
    let (mut at_low, mut at_high) = (f(low), f(high));
    for round in 0..200 {
        if at_low == 0.0 {
            return low;
        }
        if at_high == 0.0 {
            return high;
        }
        let middle = 0.5 * (low + high);
        if middle <= low.min(high) || middle >= low.max(high) {
            break;
        }
        // Every second round halves; the others try the secant.
        let secant = (low * at_high - high * at_low) / (at_high - at_low);
        let inside = secant > low.min(high) && secant < low.max(high);
        let x = if round % 2 == 0 && inside {
            secant
        } else {
            middle
        };
        let y = f(x);
        if (y < 0.0) == (at_low < 0.0) {
            (low, at_low) = (x, y);
        } else {
            (high, at_high) = (x, y);
        }
    }
    if at_low.abs() <= at_high.abs() {
        low
    } else {
        high
    }
}

/// Least and greatest value over a turn; of equal ones the first.
pub(crate) fn extremes(motion: &FollowerMotion, f: impl Fn(&Piece, Dual) -> Dual) -> [At; 2] {
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
pub(crate) fn negative(motion: &FollowerMotion, f: impl Fn(&Piece, Dual) -> Dual) -> Vec<[f64; 2]> {
    let list = nodes(motion, &f);
    let mut found: Vec<[f64; 2]> = Vec::new();
    for pair in list.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let zero = |low: f64, high: f64| {
            let piece = &motion.pieces()[a.piece];
            root(|phi| f(piece, Dual::new(phi, 0.0)).value, low, high)
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

fn nodes(motion: &FollowerMotion, f: impl Fn(&Piece, Dual) -> Dual) -> Vec<Node> {
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
            let (low, high) = (piece.place(step - 1), piece.place(step));
            let after = at(high);
            if before.derivative * after.derivative < 0.0 {
                let phi = root(|phi| at(phi).derivative, low, high);
                put(phi, at(phi).value);
            }
            put(high, after.value);
            before = after;
        }
    }
    list
}
