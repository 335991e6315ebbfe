//! Continuous output over an accepted step, the same for every method.
//!
//! A quintic through (s, ṡ, s̈) of both ends costs nothing beyond what a method
//! knows anyway; its error is of order h⁶ in the value. Where that is not
//! enough (Dormand–Prince 8, and every step on which a switch is to be
//! located) it is raised: the accelerations that the right-hand side gives at
//! inner points of the polynomial are built in ("bootstrapping": Enright,
//! Jackson, Nørsett and Thomsen, 1986). One point makes degree 6, then three
//! points degree 8, whose error is of order h⁸; a second raise makes it h⁹.

use super::{Dynamics, evaluator::Evaluator};
use crate::math::polynomial::{MAX_DEGREE, Step, gain, rounded_gain};
use nalgebra::DMatrix;

/// Inner point of the first raise.
const MIDDLE: [f64; 1] = [0.5];

/// Inner points of the second raise: the outer two are the zeros of the second
/// derivative of the error term s³(1−s)³·x(x² − β), x = s − ½, whose greatest
/// value over the step is least (β ≈ 0.0495).
const THREE: [f64; 3] = [0.2767, 0.5, 0.7233];

/// Highest degree built from what the right-hand side gives.
const HIGHEST: usize = 5 + THREE.len();

/// One end of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct End {
    pub(super) time: f64,
    /// State, 2n entries.
    pub(super) y: Vec<f64>,
    /// Derivative of the state.
    pub(super) dy: Vec<f64>,
    /// (s, ṡ, s̈) of every signal.
    pub(super) signals: Vec<[f64; 3]>,
}

impl End {
    pub(super) fn new(coordinates: usize, signals: usize) -> Self {
        Self {
            time: 0.0,
            y: vec![0.0; 2 * coordinates],
            dy: vec![0.0; 2 * coordinates],
            signals: vec![[0.0; 3]; signals],
        }
    }

    /// Moves here; `dy` is the derivative at (`time`, `y`).
    pub(super) fn set<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        time: f64,
        y: &[f64],
        dy: &[f64],
    ) {
        self.time = time;
        self.y.copy_from_slice(y);
        self.dy.copy_from_slice(dy);
        evaluator.signals(time, y, dy, &mut self.signals);
    }

    /// The first entry of state or derivative that is not a finite number.
    pub(super) fn not_finite(&self) -> Option<usize> {
        let bad = |entry: &f64| !entry.is_finite();
        let state = self.y.iter().position(bad);
        state.or_else(|| self.dy.iter().position(bad))
    }
}

/// Builder of the continuous output; its buffers are reused for every step.
pub(super) struct Output {
    coordinates: usize,
    degree: usize,
    start: f64,
    length: f64,
    bases: Vec<f64>,
    coefficients: Vec<f64>,
    inner: End,
    accelerations: Vec<[f64; THREE.len()]>,
    one: Raise,
    three: Raise,
}

/// The polynomial of degree 5 + k with given accelerations at k inner points:
/// the k middle coefficients follow from a linear system.
struct Raise {
    points: &'static [f64],
    /// Weights of all coefficients in p″/(d(d−1)) at each point.
    weights: Vec<[f64; HIGHEST + 1]>,
    inverse: DMatrix<f64>,
}

impl Output {
    pub(super) fn new(coordinates: usize, signals: usize) -> Self {
        Self {
            coordinates,
            degree: 5,
            start: 0.0,
            length: 1.0,
            bases: vec![0.0; signals],
            coefficients: vec![0.0; signals * (HIGHEST + 1)],
            inner: End::new(coordinates, signals),
            accelerations: vec![[0.0; THREE.len()]; signals],
            one: Raise::new(&MIDDLE),
            three: Raise::new(&THREE),
        }
    }

    /// The step as it stands, cut off at `end`.
    pub(super) fn step(&self, end: f64) -> Step<'_> {
        let signals = self.accelerations.len();
        Step {
            start: self.start,
            length: self.length,
            end,
            coordinates: self.coordinates,
            degree: self.degree,
            bases: &self.bases,
            coefficients: &self.coefficients[..signals * (self.degree + 1)],
        }
    }

    /// A step between two ends.
    fn begin_step(&mut self, from: &End, to: &End, degree: usize) {
        self.start = from.time;
        self.length = to.time - from.time;
        self.degree = degree;
        for (base, signal) in self.bases.iter_mut().zip(&from.signals) {
            *base = signal[0];
        }
    }

    /// The quintic between two ends.
    pub(super) fn quintic(&mut self, from: &End, to: &End) {
        self.begin_step(from, to, 5);
        self.fill_ends(from, to);
    }

    /// The motion itself: power series of all signals of a degree, over a time of
    /// which the step takes a `share`.
    pub(super) fn series(
        &mut self,
        from: &End,
        to: &End,
        series: &[f64],
        degree: usize,
        share: f64,
    ) {
        self.begin_step(from, to, degree);
        self.coefficients.resize(series.len(), 0.0);
        self.coefficients.copy_from_slice(series);
        // share^k over the binomial (degree over k).
        let mut factors = [1.0; MAX_DEGREE + 1];
        for k in 1..=degree {
            factors[k] = factors[k - 1] * (share * k as f64 / (degree + 1 - k) as f64);
        }
        let rows = self.coefficients.chunks_exact_mut(degree + 1);
        for (row, (a, b)) in rows.zip(from.signals.iter().zip(&to.signals)) {
            for (c, factor) in row.iter_mut().zip(&factors) {
                *c *= factor;
            }
            // Summed up to Bernstein coefficients.
            row[0] = 0.0;
            for level in 1..=degree {
                for k in (level..=degree).rev() {
                    row[k] += row[k - 1];
                }
            }
            row[degree] = rounded_gain(row[degree], a[0], b[0]);
            // Over a short step the rounding of displacements would drown the speed.
            row[degree - 1] = row[degree] - self.length / degree as f64 * b[1];
        }
    }

    /// The motion itself: polynomials of a degree in Bernstein form, less the values
    /// at the start.
    pub(super) fn bernstein(&mut self, from: &End, to: &End, coefficients: &[f64], degree: usize) {
        self.begin_step(from, to, degree);
        let most = self.coefficients.len().max(coefficients.len());
        self.coefficients.resize(most, 0.0);
        self.coefficients[..coefficients.len()].copy_from_slice(coefficients);
        let rows = self.coefficients.chunks_exact_mut(degree + 1);
        for (row, (a, b)) in rows.zip(from.signals.iter().zip(&to.signals)) {
            row[0] = 0.0;
            row[degree] = rounded_gain(row[degree], a[0], b[0]);
            row[degree - 1] = row[degree] - self.length / degree as f64 * b[1];
        }
    }

    /// The quintic through (s, ṡ) of both ends and of the middle of the step.
    pub(super) fn through_middle<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        from: &End,
        middle: &[f64],
        to: &End,
    ) {
        self.begin_step(from, to, 5);
        // Accelerations are not asked for: any derivative will do.
        self.inner
            .set(evaluator, self.start + 0.5 * self.length, middle, &to.dy);
        let h = self.length;
        let ends = from.signals.iter().zip(&to.signals);
        let rows = self.coefficients.chunks_exact_mut(6);
        for ((row, (a, b)), m) in rows.zip(ends).zip(&self.inner.signals) {
            let (end, value, slope) = (gain(a, b, h), m[0] - a[0], h * m[1]);
            let (second, fifth) = (0.2 * h * a[1], end - 0.2 * h * b[1]);
            let sum = 0.1 * (32.0 * value - 5.0 * second - 5.0 * fifth - end);
            let difference = 1.6 * slope + 0.5 * (3.0 * second - 3.0 * fifth - end);
            row[0] = 0.0;
            row[1] = second;
            row[2] = 0.5 * (sum - difference);
            row[3] = 0.5 * (sum + difference);
            row[4] = fifth;
            row[5] = end;
        }
    }

    /// Raises the quintic to degree 8 (four evaluations), or improves what was
    /// raised before (three evaluations).
    pub(super) fn raise<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        from: &End,
        to: &End,
    ) {
        if self.degree == 5 {
            self.raise_through(evaluator, from, to, 1);
        }
        self.raise_through(evaluator, from, to, THREE.len());
    }

    fn raise_through<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        from: &End,
        to: &End,
        count: usize,
    ) {
        for k in 0..count {
            let s = self.raise_of(count).points[k];
            self.evaluate_inside(evaluator, s);
            for (list, signal) in self.accelerations.iter_mut().zip(&self.inner.signals) {
                list[k] = signal[2];
            }
        }
        self.degree = 5 + count;
        self.fill_ends(from, to);
        self.fill_middle_coefficients(count);
    }

    fn raise_of(&self, count: usize) -> &Raise {
        if count == 1 { &self.one } else { &self.three }
    }

    fn evaluate_inside<D: Dynamics>(&mut self, evaluator: &Evaluator<'_, D>, s: f64) {
        let mut inner = std::mem::take(&mut self.inner);
        let step = self.step(1.0);
        inner.time = step.time(s);
        step.state(s, &mut inner.y);
        evaluator.derivatives(inner.time, &inner.y, &mut inner.dy);
        evaluator.signals(inner.time, &inner.y, &inner.dy, &mut inner.signals);
        self.inner = inner;
    }

    /// The three coefficients at each end, from value, rate and acceleration.
    fn fill_ends(&mut self, from: &End, to: &End) {
        let (h, degree) = (self.length, self.degree);
        let first = h / degree as f64;
        let second = h * h / (degree * (degree - 1)) as f64;
        let rows = self.coefficients.chunks_exact_mut(degree + 1);
        for (row, (a, b)) in rows.zip(from.signals.iter().zip(&to.signals)) {
            let end = gain(a, b, h);
            row[0] = 0.0;
            row[1] = first * a[1];
            row[2] = 2.0 * first * a[1] + second * a[2];
            row[degree] = end;
            row[degree - 1] = end - first * b[1];
            row[degree - 2] = end - 2.0 * first * b[1] + second * b[2];
            row[3..degree - 2].fill(0.0);
        }
    }

    /// The middle coefficients, from the accelerations at the inner points.
    fn fill_middle_coefficients(&mut self, count: usize) {
        let degree = self.degree;
        let scale = self.length * self.length / (degree * (degree - 1)) as f64;
        let raise = if count == 1 { &self.one } else { &self.three };
        let rows = self.coefficients.chunks_exact_mut(degree + 1);
        for (row, wanted) in rows.zip(&self.accelerations) {
            let mut missing = [0.0; THREE.len()];
            for (k, weights) in raise.weights.iter().enumerate() {
                // The middle coefficients are still zero.
                let known: f64 = row.iter().zip(weights).map(|(c, w)| c * w).sum();
                missing[k] = scale * wanted[k] - known;
            }
            for i in 0..count {
                let sum: f64 = (0..count).map(|k| raise.inverse[(i, k)] * missing[k]).sum();
                row[3 + i] = sum;
            }
        }
    }
}

impl Raise {
    fn new(points: &'static [f64]) -> Self {
        let count = points.len();
        let degree = 5 + count;
        let weights: Vec<[f64; HIGHEST + 1]> = (points.iter())
            .map(|&s| {
                std::array::from_fn(|i| match i <= degree {
                    true => curvature_weight(degree, i, s),
                    false => 0.0,
                })
            })
            .collect();
        let matrix = DMatrix::from_fn(count, count, |k, i| weights[k][3 + i]);
        let inverse = matrix
            .try_inverse()
            .expect("inner points are distinct: the system is regular");
        Self {
            points,
            weights,
            inverse,
        }
    }
}

/// Weight of coefficient i in p″(s)/(d(d−1)): p″ = d(d−1)·Σ Δ²cᵢ·Bᵢ(s), the
/// Bᵢ of degree d − 2.
fn curvature_weight(degree: usize, i: usize, s: f64) -> f64 {
    let basis = |j: isize| {
        let top = degree as isize - 2;
        if j < 0 || j > top {
            return 0.0;
        }
        let binomial: f64 = (0..j).map(|k| (top - k) as f64 / (k + 1) as f64).product();
        binomial * s.powi(j as i32) * (1.0 - s).powi((top - j) as i32)
    };
    let i = i as isize;
    basis(i) - 2.0 * basis(i - 1) + basis(i - 2)
}

#[cfg(test)]
#[path = "continuous_tests.rs"]
mod tests;
