//! Whether a written function of time has a finite value all through a run.

use super::written::WrittenMotion;
use crate::math::expression::Interval;

/// Places at which each piece is looked at.
const PLACES: usize = 256;
/// Most pieces that are looked at.
const PIECES: usize = 2000;
/// Stretches that are bounded, all in all.
const STRETCHES: usize = 20_000;
/// Share of its size, or of the run, to which a place is told.
const NARROW: f64 = 1e-13;
/// Share of the run within which one pole is looked for.
const SHORT: f64 = 1e-5;
/// Narrow stretches between a place and where its surroundings are looked at: close to it …
const NEAR: f64 = 32.0;
/// … and so many times farther away.
const AWAY: f64 = 1e4;
/// From away to near, what has a pole grows by more than this.
const GROWS: f64 = 30.0;

impl WrittenMotion {
    /// The first time up to `end` at which it has no finite value; `None`: none is found.
    pub fn undefined(&self, end: f64) -> Option<f64> {
        let breaks = self.breaks();
        let (mut from, mut left) = (0.0, STRETCHES);
        for _ in 0..PIECES {
            let segment = breaks.segment_at(from, 1.0);
            let to = breaks.edges(segment).1.min(end);
            let piece = Piece {
                written: self,
                segment,
                edges: [from, to],
                narrow: NARROW * end,
                short: SHORT * end,
                end,
            };
            if let Some(at) = piece
                .hole([from, to])
                .or_else(|| piece.pole([from, to], &mut left))
            {
                return Some(at);
            }
            if !(to < end && to > from) {
                break;
            }
            from = to;
        }
        None
    }
}

/// The function on one of its pieces.
struct Piece<'w> {
    written: &'w WrittenMotion,
    segment: i64,
    /// Where it begins and ends; beyond, its formula need not hold.
    edges: [f64; 2],
    narrow: f64,
    short: f64,
    end: f64,
}

impl Piece<'_> {
    fn at(&self, time: f64) -> f64 {
        self.written.value(self.segment, time)
    }

    fn has_value(&self, time: f64) -> bool {
        self.at(time).is_finite()
    }

    /// Where it begins to have no value, as far as some of the places have none.
    fn hole(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let place = |k: usize| from + (to - from) * k as f64 / PLACES as f64;
        // At the very end of a piece rounding may lie beyond where its formula holds.
        let least = usize::from(from > 0.0);
        let most = PLACES - usize::from(to < self.end);
        let first = (least..=most).find(|&k| !self.has_value(place(k)))?;
        if first == least {
            return Some(from);
        }
        let before = first - 1;
        let [mut low, mut high] = [place(before), place(first)];
        while high - low > self.narrow {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            match self.has_value(middle) {
                true => low = middle,
                false => high = middle,
            }
        }
        Some(high)
    }

    /// The first place towards which it grows without bound: there bounds exclude nothing,
    /// however short the stretch.
    fn pole(&self, [from, to]: [f64; 2], left: &mut usize) -> Option<f64> {
        let mut stretches = vec![[from, to]];
        while let Some([from, to]) = stretches.pop() {
            *left = left.checked_sub(1)?;
            let Interval { low, high } = self.written.bounds(self.segment, from, to);
            if low.is_finite() && high.is_finite() {
                continue;
            }
            if to - from <= self.short {
                if let Some(place) = self.bracket_maximum([from, to]) {
                    return Some(place);
                }
                continue;
            }
            let middle = 0.5 * (from + to);
            if from < middle && middle < to {
                stretches.push([middle, to]);
                stretches.push([from, middle]);
            }
        }
        None
    }

    /// The place in a short stretch towards which it grows, if it does: half by half to where
    /// the sign changes, else to where it is greater.
    fn bracket_maximum(&self, [mut from, mut to]: [f64; 2]) -> Option<f64> {
        while to - from > self.narrow {
            let middle = 0.5 * (from + to);
            if middle <= from || middle >= to {
                break;
            }
            let [a, m, b] = [from, middle, to].map(|time| self.at(time));
            if !m.is_finite() {
                // At an edge of the piece rounding may lie beyond it.
                let inside = self
                    .edges
                    .iter()
                    .all(|edge| (middle - edge).abs() > self.narrow);
                return (inside || self.grows_towards(middle)).then_some(middle);
            }
            let left = match (a * m < 0.0, m * b < 0.0) {
                (true, false) => true,
                (false, true) => false,
                _ => a.abs() > b.abs(),
            };
            match left {
                true => to = middle,
                false => from = middle,
            }
        }
        let place = 0.5 * (from + to);
        self.grows_towards(place).then_some(place)
    }

    /// Whether it grows towards a place from either side that belongs to the piece.
    fn grows_towards(&self, place: f64) -> bool {
        let [begin, end] = self.edges;
        let near = NEAR * self.narrow;
        [-1.0, 1.0].into_iter().any(|side| {
            let [close, away] = [near, AWAY * near].map(|distance| place + side * distance);
            if away < begin || away > end {
                return false;
            }
            let [close, away] = [close, away].map(|time| self.at(time).abs());
            away > 0.0 && close > GROWS * away
        })
    }
}

#[cfg(test)]
mod tests {
    use super::WrittenMotion;
    use crate::math::expression::{Expression, MOST};

    fn undefined(text: &str, end: f64) -> Option<f64> {
        let expression = Expression::new(text, &["t"]).unwrap();
        let (motion, whole) = WrittenMotion::of(expression.program(), text, 1.0, MOST);
        assert!(whole, "{text}");
        motion.undefined(end)
    }

    #[test]
    fn places_without_a_value_are_found() {
        let pole = std::f64::consts::FRAC_PI_2;
        for (text, end, wanted) in [
            ("1/(t-0.25)", 0.5, 0.25),
            ("1/(t-0.3)", 0.5, 0.3),
            ("5/(t-0.3)^2", 0.5, 0.3),
            ("tan(10*t)", 0.5, 0.1 * pole),
            ("sqrt(0.2-t)", 0.5, 0.2),
            ("log(0.3-t)", 0.5, 0.3),
            ("(0.4-t)^1.5", 0.5, 0.4),
            ("log(t-0.3)", 0.5, 0.0),
            ("t<0.1 ? 1/(t-0.25) : t<0.2 ? 1 : 1/(t-0.25)", 0.5, 0.25),
            ("acos(2*t)", 1.0, 0.5),
            ("exp(2000*t)", 1.0, 0.354_891_356_446_692),
            ("t<0.3 ? 1/(t-0.3) : 2", 0.5, 0.3),
            ("t<0.3 ? 2 : (t-0.3)^-0.5", 0.5, 0.3),
            ("abs(t-0.3)^-0.5", 0.5, 0.3),
        ] {
            let found = undefined(text, end).unwrap_or_else(|| panic!("{text}: no place"));
            assert!((found - wanted).abs() < 1e-9, "{text}: {found}");
        }
    }

    #[test]
    fn what_has_values_all_through_the_run_is_taken() {
        for (text, end) in [
            ("1/(t-0.25)", 0.2),
            ("tan(10*t)", 0.157),
            ("sqrt(t)", 1.0),
            ("sqrt(t*t-2*t+1)", 3.0),
            ("sqrt(abs(t-0.3))", 1.0),
            ("abs(t-0.3)^0.01", 1.0),
            ("t<0.3 ? sqrt(0.3-t) : sqrt(t-0.3)", 1.0),
            ("t<0.2 ? 1/(0.25-t) : 7", 1.0),
            ("sin(20*t)/(2+cos(31*t))", 100.0),
            ("1/(1e-6+(t-0.4)^2)", 1.0),
            ("exp(-1/(t+1e-3))", 1.0),
            ("tanh(1e4*(t-0.5))", 1.0),
            ("(t%0.1)^0.5", 10.0),
        ] {
            assert_eq!(undefined(text, end), None, "{text}");
        }
    }
}
