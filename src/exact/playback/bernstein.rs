//! The polynomials of a step from derivatives at its ends.

use super::branch::Branch;
use super::given::Given;
use crate::exact::MOST_ORDERS;
use crate::integrate::Dynamics;
use crate::polynomial::{Step, gain, raise};
use crate::system::System;

/// Degree of the trees' polynomials: eight derivatives at either end.
pub(super) const DEGREE: usize = 2 * MOST_ORDERS - 1;

/// Derivatives at one end, of coordinates and extra signals.
#[derive(Clone, Debug, Default)]
struct End {
    coordinates: Vec<[f64; MOST_ORDERS]>,
    extra: Vec<[f64; 3]>,
}

/// Builder of the continuous output of a step.
#[derive(Clone, Debug)]
pub(super) struct Output {
    count: usize,
    degree: usize,
    left: End,
    right: End,
    /// Extra signals at the instant last looked at.
    extra: Vec<[f64; 3]>,
    start: f64,
    length: f64,
    bases: Vec<f64>,
    coefficients: Vec<f64>,
}

impl Output {
    pub(super) fn new(system: &System) -> Self {
        let (count, signals) = (system.coordinates(), system.signals());
        let end = End {
            coordinates: vec![[0.0; MOST_ORDERS]; count],
            extra: vec![[0.0; 3]; signals - count],
        };
        Self {
            count,
            degree: DEGREE,
            extra: end.extra.clone(),
            left: end.clone(),
            right: end,
            start: 0.0,
            length: 1.0,
            bases: vec![0.0; signals],
            coefficients: vec![0.0; signals * (DEGREE + 1)],
        }
    }

    /// Where the extra signals go.
    pub(super) fn extra(&mut self) -> &mut [[f64; 3]] {
        &mut self.extra
    }

    /// Takes the instant that the branches have looked at as the left end.
    pub(super) fn take_left(&mut self, branches: &[Branch<'_>]) {
        take(&mut self.left, branches);
        self.left.extra.copy_from_slice(&self.extra);
    }

    /// The same for the right end, and makes the polynomials from `from` to
    /// `to`: of the trees, and of what is `given` beside them.
    pub(super) fn take_right(
        &mut self,
        branches: &[Branch<'_>],
        (from, to): (f64, f64),
        given: Option<&Given<'_>>,
    ) {
        take(&mut self.right, branches);
        self.right.extra.copy_from_slice(&self.extra);
        (self.start, self.length) = (from, to - from);
        self.degree = given.map_or(DEGREE, |given| given.step.degree.max(DEGREE));
        let width = self.degree + 1;
        let signals = self.count + self.extra.len();
        self.coefficients.resize(signals * width, 0.0);
        let rows = self.coefficients.chunks_exact_mut(width);
        let ends = self.left.coordinates.iter().zip(&self.right.coordinates);
        for ((row, base), (left, right)) in rows.zip(&mut self.bases).zip(ends) {
            *base = left[0];
            hermite(&mut row[..=DEGREE], left, right, self.length);
            raise(row, DEGREE);
        }
        if let Some(given) = given {
            for (number, &coordinate) in given.coordinates.iter().enumerate() {
                let row = &mut self.coefficients[coordinate * width..][..width];
                given.part(number, (from, to), row);
                self.bases[coordinate] = given.step.bases[number];
            }
        }
        let rows = self.coefficients.chunks_exact_mut(width).skip(self.count);
        let rows = rows.zip(&mut self.bases[self.count..]);
        let ends = self.left.extra.iter().zip(&self.right.extra);
        for ((row, base), (left, right)) in rows.zip(ends) {
            *base = left[0];
            hermite(&mut row[..6], left, right, self.length);
            raise(row, 5);
        }
    }

    /// The right end becomes the left one.
    pub(super) fn move_on(&mut self) {
        std::mem::swap(&mut self.left, &mut self.right);
    }

    /// The step as it stands.
    pub(super) fn step(&self) -> Step<'_> {
        Step {
            start: self.start,
            length: self.length,
            end: 1.0,
            coordinates: self.count,
            degree: self.degree,
            bases: &self.bases,
            coefficients: &self.coefficients,
        }
    }
}

fn take(end: &mut End, branches: &[Branch<'_>]) {
    for branch in branches {
        for (mass, place) in branch.part.masses.iter().enumerate() {
            let out = &mut end.coordinates[place.coordinate];
            for (order, out) in out.iter_mut().enumerate() {
                *out = branch.deviation(mass, order);
            }
        }
    }
}

/// Bernstein's coefficients of the polynomial with given derivatives at both
/// ends of an interval of length h, less the value at the left: b_i = Σ_k C(i, k)·(d − k)!/d!·hᵏ·f⁽ᵏ⁾ from
/// the left, mirrored from the right.
fn hermite(out: &mut [f64], left: &[f64], right: &[f64], h: f64) {
    let degree = out.len() - 1;
    let orders = left.len();
    let mut scaled = [[0.0; MOST_ORDERS]; 2];
    let mut factor = 1.0;
    for k in 0..orders {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        scaled[0][k] = factor * left[k];
        scaled[1][k] = sign * factor * right[k];
        factor *= h / (degree - k) as f64;
    }
    scaled[0][0] = 0.0;
    scaled[1][0] = gain(left, right, h);
    for i in 0..orders {
        let mut sums = [0.0; 2];
        let mut choose = 1.0;
        for k in 0..=i {
            sums[0] += choose * scaled[0][k];
            sums[1] += choose * scaled[1][k];
            choose *= (i - k) as f64 / (k + 1) as f64;
        }
        out[i] = sums[0];
        out[degree - i] = sums[1];
    }
}

#[cfg(test)]
mod tests {
    use super::{DEGREE, MOST_ORDERS, hermite};
    use crate::polynomial::evaluate;

    #[test]
    fn a_sine_over_a_radian_and_a_half_is_followed_to_rounding() {
        let (from, h, rate) = (0.3, 0.5, 3.0f64);
        let derivatives = |t: f64| -> [f64; MOST_ORDERS] {
            std::array::from_fn(|k| {
                let turn = k as f64 * std::f64::consts::FRAC_PI_2;
                rate.powi(k as i32) * (rate * t + turn).sin()
            })
        };
        let mut row = [0.0; DEGREE + 1];
        hermite(&mut row, &derivatives(from), &derivatives(from + h), h);
        for i in 0..=20 {
            let s = f64::from(i) / 20.0;
            let (value, slope) = evaluate(&row, s);
            let t = rate * (from + s * h);
            let difference = t.sin() - (rate * from).sin();
            approx::assert_abs_diff_eq!(value, difference, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(slope / h, rate * t.cos(), epsilon = 1e-12);
        }
    }
}
