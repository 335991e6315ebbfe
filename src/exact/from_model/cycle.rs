//! A cycle that repeats for ever: its pieces are made once.

use super::prescribed::PrescribedMotion;
use super::rhythm::Rhythm;
use crate::exact::law::product;
use std::sync::OnceLock;

/// Most pieces kept of a cycle; what needs more is made as it is reached.
const MOST: usize = 4096;

/// A polynomial on an interval of time.
pub(super) trait Piece: Copy {
    /// When it begins and ends (s).
    fn interval(&self) -> (f64, f64);

    /// The same polynomial with another end.
    fn ending(self, end: f64) -> Self;

    /// False for what could not be made.
    fn is_made(&self) -> bool;
}

/// The pieces of a cycle.
#[derive(Debug)]
pub(super) struct Cycle<P> {
    /// Time at which the first cycle begins (s).
    from: f64,
    /// Length of a cycle (s).
    period: f64,
    /// What the motion gains in it.
    advance: f64,
    /// Pieces of the first cycle, from its beginning; empty: too many to keep.
    pieces: OnceLock<Vec<P>>,
}

/// A piece of a later cycle.
pub(super) struct Place<P> {
    /// The piece of the first cycle.
    pub(super) piece: P,
    /// Where it begins in the later one: the sum of both numbers (s).
    pub(super) start: (f64, f64),
    /// Where it ends (s).
    pub(super) end: f64,
    /// What the motion has gained meanwhile.
    pub(super) gained: f64,
}

impl<P: Piece> Cycle<P> {
    /// Of a motion that repeats; `None`: it does not.
    pub(super) fn of(course: &PrescribedMotion) -> Option<Self> {
        match course.rhythm() {
            Rhythm::Periodic(period, advance) => Some(Self {
                from: course.settling_time(),
                period,
                advance,
                pieces: OnceLock::new(),
            }),
            Rhythm::Uniform(_) | Rhythm::None => None,
        }
    }

    /// Longest piece that shows that the motion does not repeat within it (s).
    pub(super) fn longest_piece(&self) -> f64 {
        0.5 * self.period
    }

    /// The piece in force at `time`, the first cycle made by `fresh`, which takes a time
    /// and the greatest length; `None`: it is to be made by itself.
    pub(super) fn at(&self, time: f64, fresh: impl Fn(f64, f64) -> P) -> Option<Place<P>> {
        if time < self.from {
            return None;
        }
        let pieces = self.pieces.get_or_init(|| self.pieces_of_cycle(fresh));
        let turn = ((time - self.from) / self.period).floor();
        // Rounding may put an instant into the cycle beside it.
        [turn - 1.0, turn, turn + 1.0]
            .into_iter()
            .find_map(|turn| self.piece_at_time(pieces, turn, time))
    }

    fn piece_at_time(&self, pieces: &[P], turn: f64, time: f64) -> Option<Place<P>> {
        let at = |place: f64| shifted(place, turn, self.period);
        let count = pieces.partition_point(|piece| at(piece.interval().0).0 <= time);
        let piece = *pieces.get(count.checked_sub(1)?)?;
        let (start, end) = piece.interval();
        let end = at(end).0;
        (time < end).then(|| Place {
            piece,
            start: at(start),
            end,
            gained: turn * self.advance,
        })
    }

    fn pieces_of_cycle(&self, fresh: impl Fn(f64, f64) -> P) -> Vec<P> {
        let end = self.from + self.period;
        let mut pieces: Vec<P> = Vec::new();
        let (mut time, mut last) = (self.from, f64::INFINITY);
        while time < end {
            let rest = end - time;
            let made = fresh(time, rest.min(self.longest_piece()).min(4.0 * last));
            if pieces.len() >= MOST || !made.is_made() {
                return Vec::new();
            }
            let own = made.interval().1;
            last = own - time;
            // A remainder below the clock's resolution is no piece.
            let done = end - own <= 64.0 * f64::EPSILON * end.abs();
            time = if done { end } else { own };
            pieces.push(made.ending(time));
        }
        pieces
    }
}

/// time + turn·period in double-double: (sum, rounding error).
fn shifted(time: f64, turn: f64, period: f64) -> (f64, f64) {
    let (whole, rest) = product(turn, period);
    let sum = whole + time;
    let part = sum - whole;
    let error = (whole - (sum - part)) + (time - part);
    (sum, error + rest)
}
