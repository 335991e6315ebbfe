//! What is known of the motion beside the trees: a step of an integration.

use crate::polynomial::{MAX_DEGREE, Step, divide, evaluate, raise};

/// A step of the coordinates that no tree holds.
pub(super) struct Given<'g> {
    /// The step, in an order of coordinates of its own.
    pub(super) step: &'g Step<'g>,
    /// Where each of its coordinates is in the system.
    pub(super) coordinates: &'g [usize],
}

impl Given<'_> {
    /// Puts state and derivative at an instant into the system's.
    pub(super) fn put(&self, time: f64, y: &mut [f64], dy: &mut [f64]) {
        let (n, length) = (y.len() / 2, self.step.length);
        let s = self.local(time);
        for (number, &coordinate) in self.coordinates.iter().enumerate() {
            let row = self.step.differences(number);
            let (value, rate) = self.step.value(number, s);
            let degree = row.len() - 1;
            let mut slopes = [0.0; MAX_DEGREE];
            for (k, slope) in slopes[..degree].iter_mut().enumerate() {
                *slope = degree as f64 * (row[k + 1] - row[k]);
            }
            let bend = match degree {
                0 => 0.0,
                _ => evaluate(&slopes[..degree], s).1,
            };
            y[coordinate] = value;
            y[n + coordinate] = rate;
            dy[coordinate] = rate;
            dy[n + coordinate] = bend / (length * length);
        }
    }

    /// Bernstein's coefficients of a coordinate, less its base, between two instants
    /// of the step, raised to the degree of the row.
    pub(super) fn part(&self, number: usize, (from, to): (f64, f64), row: &mut [f64]) {
        let own = self.step.differences(number);
        let degree = own.len() - 1;
        let mut whole = [0.0; MAX_DEGREE + 1];
        let mut part = [0.0; MAX_DEGREE + 1];
        let (whole, part) = (&mut whole[..=degree], &mut part[..=degree]);
        whole.copy_from_slice(own);
        let (first, last) = (self.local(from), self.local(to));
        divide(part, whole, last);
        // `part` is now [0, last]; what comes before `from` goes.
        if first > 0.0 {
            divide(whole, part, first / last);
        }
        row[..=degree].copy_from_slice(part);
        raise(row, degree);
    }

    fn local(&self, time: f64) -> f64 {
        let s = (time - self.step.start) / self.step.length;
        s.clamp(0.0, self.step.end)
    }
}

#[cfg(test)]
mod tests {
    use super::Given;
    use crate::polynomial::{Step, evaluate};

    #[test]
    fn a_part_of_a_step_is_the_step_there() {
        let coefficients = [0.0; 4].iter().chain(&[1.0, -2.0, 0.5, 3.0]).copied();
        let coefficients: Vec<f64> = coefficients.collect();
        let step = Step {
            start: 2.0,
            length: 0.5,
            end: 0.9,
            coordinates: 2,
            degree: 3,
            bases: &[0.0; 2],
            coefficients: &coefficients,
        };
        let given = Given {
            step: &step,
            coordinates: &[1, 2],
        };
        let (from, to) = (2.1, 2.3);
        let mut row = [0.0; 9];
        given.part(1, (from, to), &mut row);
        let at = |time: f64| evaluate(step.differences(1), (time - 2.0) / 0.5);
        for share in [0.0, 0.4, 1.0] {
            let time: f64 = from + share * (to - from);
            let (value, slope) = evaluate(&row, share);
            approx::assert_abs_diff_eq!(value, at(time).0, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(slope / (to - from), at(time).1 / 0.5, epsilon = 1e-12);
        }
        let (mut y, mut dy) = ([7.0; 6], [7.0; 6]);
        given.put(2.2, &mut y, &mut dy);
        let h = 1e-5;
        let bend = (at(2.2 + h).1 - at(2.2 - h).1) / 0.5 / (2.0 * h);
        approx::assert_abs_diff_eq!(y[2], at(2.2).0, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(y[5], at(2.2).1 / 0.5, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(dy[5], bend, epsilon = 1e-5 * bend.abs());
        assert_eq!((y[0], y[3], y[1], y[4]), (7.0, 7.0, 0.0, 0.0));
    }
}
