//! Long steps in pieces.
//!
//! Power series take steps of a whole oscillation and more, collocation of high
//! order steps of half of one. Quadratures and the
//! search for extremes look at a step at a few places: they want pieces within
//! which a motion bends once. How many those are, [`super::smoothness`] tells.

use crate::math::polynomial::{Step, divide};

/// Degree above which a continuous output is that of collocation of high order.
const SHORT: usize = 5;
/// Degree above which it is that of a power series.
const LONG: usize = 9;
/// Degree above which its steps are longer still.
const LONGER: usize = 14;

/// Most pieces for an output of a degree.
pub(super) fn max_pieces(degree: usize) -> usize {
    match degree {
        0..=SHORT => 1,
        6..=LONG => 3,
        10..=LONGER => 4,
        _ => 8,
    }
}

/// Cuts steps into pieces; keeps its buffers.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    /// Coefficients of the piece.
    left: Vec<f64>,
    /// Coefficients of what comes after it.
    rest: Vec<f64>,
}

impl Pieces {
    /// Calls `each` with `count` pieces of equal length, up to the step's end.
    pub(super) fn for_each_piece(
        &mut self,
        step: &Step<'_>,
        count: usize,
        mut each: impl FnMut(&Step<'_>),
    ) {
        if count == 1 {
            return each(step);
        }
        let width = step.degree + 1;
        self.left.resize(step.coefficients.len(), 0.0);
        self.rest.clear();
        self.rest.extend_from_slice(step.coefficients);
        let mut from = 0.0;
        for piece in 1..=count {
            let to = step.end * piece as f64 / count as f64;
            let share = (to - from) / (1.0 - from);
            let rows = self.left.chunks_exact_mut(width);
            for (left, rest) in rows.zip(self.rest.chunks_exact_mut(width)) {
                divide(left, rest, share);
            }
            each(&Step {
                start: step.time(from),
                length: (to - from) * step.length,
                end: 1.0,
                coefficients: &self.left,
                ..*step
            });
            from = to;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_the_step_again() {
        let wave = |k: usize| ((3 * k * k) as f64).sin();
        let coefficients: Vec<f64> = (0..2 * 13).map(wave).collect();
        let step = Step {
            start: 2.0,
            length: 0.5,
            end: 0.9,
            coordinates: 2,
            degree: 12,
            bases: &[3.0, -1.0],
            coefficients: &coefficients,
        };
        let (mut next, mut number) = (2.0, 0);
        Pieces::default().for_each_piece(&step, 4, |piece| {
            approx::assert_abs_diff_eq!(piece.start, next, epsilon = 1e-15);
            for k in 0..=5 {
                let s = f64::from(k) / 5.0;
                let whole = (piece.time(s) - 2.0) / 0.5;
                for signal in 0..2 {
                    let found = piece.value(signal, s);
                    let expected = step.value(signal, whole);
                    approx::assert_abs_diff_eq!(found.0, expected.0, epsilon = 1e-13);
                    approx::assert_abs_diff_eq!(found.1, expected.1, epsilon = 1e-11);
                }
            }
            next = piece.end_time();
            number += 1;
        });
        approx::assert_abs_diff_eq!(next, 2.45, epsilon = 1e-15);
        assert_eq!(
            (number, max_pieces(5), max_pieces(9), max_pieces(24)),
            (4, 1, 3, 8)
        );
    }
}
