//! The greatest value of a function that is smooth in pieces.

use super::{Peak, golden};

/// Intervals a piece is searched in at least: a polynomial of the highest degree
/// allowed has far fewer turning points. At most, for what oscillates.
const INTERVALS: usize = 64;
const MOST_INTERVALS: usize = 1 << 14;

/// Intervals for each turning point that is met.
const A_TURN: usize = 8;

/// Steps of golden section: the place to about 1e-8, the value to rounding.
const STEPS: u32 = 60;

/// Differences that count as rounding when two extremes are compared.
const SAME_EXTREME: f64 = 1e-13;

/// The greatest value of a function given by pieces (number, from, to), and
/// the first place where it is reached; one-sided values at the ends of pieces
/// count. Value to rounding, place to about 1e-8 of the piece.
pub(crate) fn greatest(
    pieces: &mut dyn Iterator<Item = (usize, f64, f64)>,
    value: &dyn Fn(usize, f64) -> f64,
) -> Peak {
    let mut best = Peak {
        value: f64::NEG_INFINITY,
        at: 0.0,
    };
    for (piece, from, to) in pieces {
        let at = |x: f64| value(piece, x);
        let count = search_intervals(&at, from, to);
        let place = |i: usize| match i {
            0 => from,
            i if i == count => to,
            i => from + (to - from) * i as f64 / count as f64,
        };
        let samples: Vec<f64> = (0..=count).map(|i| at(place(i))).collect();
        for i in 0..=count {
            best.raise(Peak {
                value: samples[i],
                at: place(i),
            });
            let inner = i > 0 && i < count;
            if inner && samples[i] >= samples[i - 1] && samples[i] >= samples[i + 1] {
                best.raise(golden(&mut |x| at(x), [place(i - 1), place(i + 1)], STEPS));
            }
        }
        // Steep ends: the greatest value may lie within the outer intervals.
        for (a, b) in [(0, 1), (count - 1, count)] {
            best.raise(golden(&mut |x| at(x), [place(a), place(b)], STEPS));
        }
    }
    best
}

/// Intervals that a piece is to be searched in: so many that there are several to
/// each turning point. The places looked at are spread unevenly, so that no
/// oscillation passes for a slow one by keeping step with them.
fn search_intervals(at: &dyn Fn(f64) -> f64, from: f64, to: f64) -> usize {
    let mut count = INTERVALS;
    while count < MOST_INTERVALS {
        let place = |i: usize| {
            let even = i as f64 / count as f64;
            let uneven = even + 0.07 * (std::f64::consts::PI * even).sin().powi(2);
            from + (to - from) * uneven
        };
        let samples: Vec<f64> = (0..=count).map(|i| at(place(i))).collect();
        if A_TURN * turning_points(&samples) <= count {
            break;
        }
        count *= 2;
    }
    count
}

/// Number of turning points among samples, those of rounding left out.
fn turning_points(samples: &[f64]) -> usize {
    let size = samples.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let (mut last, mut count) = (0.0, 0);
    for pair in samples.windows(2) {
        let change = pair[1] - pair[0];
        if change.abs() > SAME_EXTREME * size {
            count += usize::from(change * last < 0.0);
            last = change;
        }
    }
    count
}

impl Peak {
    /// Takes the greater one; of equal ones the first stays.
    fn raise(&mut self, other: Self) {
        let floor = SAME_EXTREME * self.value.abs().max(SAME_EXTREME);
        if !self.value.is_finite() || other.value > self.value + floor {
            *self = other;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::greatest;

    #[test]
    fn the_greatest_value_is_found_inside_and_at_ends() {
        let pieces = [(0, 0.0, 1.0), (1, 1.0, 3.0)];
        let inside = greatest(&mut pieces.into_iter(), &|piece, x| match piece {
            0 => x,
            _ => 2.0 - (x - 1.234) * (x - 1.234),
        });
        approx::assert_relative_eq!(inside.value, 2.0, max_relative = 1e-14);
        approx::assert_abs_diff_eq!(inside.at, 1.234, epsilon = 1e-7);
        let at_end = greatest(&mut pieces.into_iter(), &|piece, x| {
            if piece == 0 { x } else { -x }
        });
        assert_eq!((at_end.value, at_end.at), (1.0, 1.0));
    }

    #[test]
    fn the_intervals_follow_the_harmonic() {
        // Harmonics that keep step with 64, 128, … intervals among them.
        for harmonic in [1.0, 31.0, 64.0, 192.0, 200.0, 256.0, 1024.0] {
            // A wave under a slow rise: its last crest is the greatest, and comes late.
            let (turn, rise) = (std::f64::consts::TAU * harmonic, 1e-3);
            let value = |x: f64| rise * x + (turn * x - 0.75 * std::f64::consts::TAU).cos();
            let found = greatest(&mut [(0, 0.0, 1.0)].into_iter(), &|_, x| value(x));
            let late = (rise / turn).asin() / turn;
            let crest = 1.0 - 0.25 / harmonic + late;
            approx::assert_relative_eq!(found.value, value(crest), max_relative = 1e-13);
            approx::assert_abs_diff_eq!(found.at, crest, epsilon = 1e-7);
        }
    }
}
