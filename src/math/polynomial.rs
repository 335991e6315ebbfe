//! Polynomials over a step: the continuous output of every method.
//!
//! Bernstein form on [0, 1]: coefficients bound the values, so that a sign
//! without change proves that there is no root.

mod parts;
mod places;
mod roots;

pub use parts::{divide, halve, raise};
pub(crate) use places::Places;
pub(crate) use roots::sign_changes;
pub use roots::{first_both_positive, first_positive};

/// Continuous output over one accepted step: for every signal a polynomial in
/// s = (t − start)/length, all of the same degree, in Bernstein form.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Time at s = 0 (s).
    pub start: f64,
    /// Time span of s from 0 to 1 (s), > 0.
    pub length: f64,
    /// The step is valid for 0 ≤ s ≤ `end`; below 1 when cut off at a switch.
    pub end: f64,
    /// Number of coordinates n; signals 0 … n−1 are the coordinates.
    pub coordinates: usize,
    /// Degree of the polynomials.
    pub degree: usize,
    /// What the signals are counted from, one number for each signal: near their
    /// values at s = 0, so that over a short step a great value (an angle after many
    /// turns) does not swallow its rate.
    pub bases: &'a [f64],
    /// Bernstein coefficients less the base, `degree + 1` for each signal.
    pub coefficients: &'a [f64],
}

impl<'a> Step<'a> {
    /// Bernstein coefficients of a signal less its base.
    pub fn differences(&self, index: usize) -> &'a [f64] {
        let width = self.degree + 1;
        &self.coefficients[index * width..(index + 1) * width]
    }

    /// Bernstein coefficients of a signal, put into `room`.
    pub fn signal<'r>(&self, index: usize, room: &'r mut Coefficients) -> &'r [f64] {
        let (base, differences) = (self.bases[index], self.differences(index));
        for (value, difference) in room.iter_mut().zip(differences) {
            *value = base + difference;
        }
        &room[..differences.len()]
    }

    /// Value and rate of a signal at s.
    pub fn value(&self, index: usize, s: f64) -> (f64, f64) {
        let (difference, slope) = evaluate(self.differences(index), s);
        (self.bases[index] + difference, slope / self.length)
    }

    /// Second derivatives of the coordinates by the time at 0 ≤ s ≤ 1.
    pub fn accelerations(&self, s: f64, out: &mut [f64]) {
        let degree = self.degree;
        if degree < 2 {
            return out.fill(0.0);
        }
        let weights = weights(degree - 2, s);
        let factor = (degree * (degree - 1)) as f64 / (self.length * self.length);
        for (index, second) in out.iter_mut().enumerate() {
            let threes = self.differences(index).windows(3);
            let bends = threes.map(|three| (three[2] - three[1]) - (three[1] - three[0]));
            let bend: f64 = weights.iter().zip(bends).map(|(w, bend)| w * bend).sum();
            *second = factor * bend;
        }
    }

    /// Time at s.
    pub fn time(&self, s: f64) -> f64 {
        self.start + s * self.length
    }

    /// Time at the (possibly cut) end.
    pub fn end_time(&self) -> f64 {
        self.time(self.end)
    }

    /// The state y = [u, u′] at s.
    pub fn state(&self, s: f64, y: &mut [f64]) {
        if self.degree == 0 || !(0.0..=1.0).contains(&s) {
            let n = self.coordinates;
            for index in 0..n {
                (y[index], y[n + index]) = self.value(index, s);
            }
            return;
        }
        // All signals are weighted sums of their coefficients with the same weights: those
        // of the polynomial between the first and last but one coefficient, and of what the
        // next ones add.
        let weights = weights(self.degree - 1, s);
        let n = self.coordinates;
        let rate = self.degree as f64 / self.length;
        for index in 0..n {
            let (value, slope) = weighted(&weights[..self.degree], self.differences(index));
            y[index] = self.bases[index] + (value + s * slope);
            y[n + index] = rate * slope;
        }
    }
}

/// Sums of a row's coefficients and of their differences, but for the last, by weights.
#[inline]
fn weighted(weights: &[f64], row: &[f64]) -> (f64, f64) {
    // (Four sums each: one would wait for each addition before the next.)
    const LANES: usize = 4;
    let (mut values, mut slopes) = ([0.0; LANES], [0.0; LANES]);
    let (here, next) = (&row[..weights.len()], &row[1..=weights.len()]);
    let fours = weights.chunks_exact(LANES).zip(here.chunks_exact(LANES));
    for ((weights, here), next) in fours.zip(next.chunks_exact(LANES)) {
        for lane in 0..LANES {
            values[lane] += weights[lane] * here[lane];
            slopes[lane] += weights[lane] * (next[lane] - here[lane]);
        }
    }
    let (mut value, mut slope) = (values.iter().sum(), slopes.iter().sum());
    for rest in weights.len() / LANES * LANES..weights.len() {
        value += weights[rest] * here[rest];
        slope += weights[rest] * (next[rest] - here[rest]);
    }
    (value, slope)
}

/// The Bernstein polynomials of a degree at 0 ≤ s ≤ 1.
fn weights(degree: usize, s: f64) -> Coefficients {
    let mut weights = [0.0; MAX_DEGREE + 1];
    let rest = 1.0 - s;
    let mut power = 1.0;
    for k in 0..=degree {
        weights[k] = BINOMIALS[degree][k] * power;
        power *= s;
    }
    power = rest;
    for k in (0..degree).rev() {
        weights[k] *= power;
        power *= rest;
    }
    weights
}

/// Bernstein coefficients, with room for the highest degree.
pub type Coefficients = [f64; MAX_DEGREE + 1];

/// Coefficient `order` of the product of two power series.
#[inline]
pub(crate) fn product(one: &[f64], other: &[f64], order: usize) -> f64 {
    convolution_term(&one[..=order], &other[..=order])
}

/// Σ a_i·b_(n−i) of two lists of one length, in four sums side by side, as the
/// processor would otherwise wait for each to end.
#[inline]
pub(crate) fn convolution_term(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len();
    let b = &b[..count];
    let mut sums = [0.0; 4];
    let whole = count - count % 4;
    for (four, back) in a[..whole].chunks_exact(4).zip(b.rchunks_exact(4)) {
        for i in 0..4 {
            sums[i] += four[i] * back[3 - i];
        }
    }
    for i in whole..count {
        sums[0] += a[i] * b[count - 1 - i];
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}

/// Roundings of its values that the gain of a signal over a step may be off.
const ROUNDINGS: f64 = 4.0;

/// What a signal gains over a step of a `length`, given (s, ṡ, s̈) at its ends: the
/// difference of the values, where rates and accelerations tell it otherwise; where
/// they agree within the rounding of the values, as they tell it. (Over a short
/// step they are right to more digits than the values have left.)
pub(crate) fn gain(from: &[f64], to: &[f64], length: f64) -> f64 {
    let told = length * (0.5 * (from[1] + to[1]) + length / 12.0 * (from[2] - to[2]));
    rounded_gain(told, from[0], to[0])
}

/// What a signal gains between two values: as it is `told`, where that is their
/// difference within their rounding.
pub(crate) fn rounded_gain(told: f64, from: f64, to: f64) -> f64 {
    let difference = to - from;
    if (told - difference).abs() <= ROUNDINGS * f64::EPSILON * (from.abs() + to.abs()) {
        told
    } else {
        difference
    }
}

/// Value and derivative at s of a polynomial in Bernstein form (de Casteljau
/// on a copy of at most [`MAX_DEGREE`] + 1 coefficients; sums of powers of
/// s/(1 − s) for the high degrees of power series).
pub fn evaluate(coefficients: &[f64], s: f64) -> (f64, f64) {
    let degree = coefficients.len() - 1;
    if degree == 0 {
        return (coefficients[0], 0.0);
    }
    if degree > LONG && (0.0..=1.0).contains(&s) {
        return if s <= 0.5 {
            evaluate_long(degree, s, |i| coefficients[i])
        } else {
            let (value, slope) = evaluate_long(degree, 1.0 - s, |i| coefficients[degree - i]);
            (value, -slope)
        };
    }
    let mut work = [0.0; MAX_DEGREE + 1];
    work[..=degree].copy_from_slice(coefficients);
    for level in 1..degree {
        for i in 0..=degree - level {
            work[i] += s * (work[i + 1] - work[i]);
        }
    }
    let slope = work[1] - work[0];
    (work[0] + s * slope, degree as f64 * slope)
}

/// Degree above which the work of de Casteljau's scheme, a square, tells.
const LONG: usize = 9;

/// Value and derivative at 0 ≤ s ≤ ½, by Horner's scheme in q = s/(1 − s) ≤ 1 on
/// the differences from the first coefficient: nothing cancels that is not small.
fn evaluate_long(degree: usize, s: f64, coefficient: impl Fn(usize) -> f64) -> (f64, f64) {
    let q = s / (1.0 - s);
    let first = coefficient(0);
    let (binomials, lower) = (&BINOMIALS[degree], &BINOMIALS[degree - 1]);
    let mut above = coefficient(degree) - first;
    let (mut value, mut slope) = (above, 0.0);
    for i in (0..degree).rev() {
        let here = coefficient(i) - first;
        value = value * q + binomials[i] * here;
        slope = slope * q + lower[i] * (above - here);
        above = here;
    }
    let power = (1.0 - s).powi(degree as i32 - 1);
    (
        first + power * (1.0 - s) * value,
        degree as f64 * power * slope,
    )
}

/// (n over k), which are exact as numbers.
static BINOMIALS: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = binomials();

const fn binomials() -> [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] {
    let mut table = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    table
}

/// Highest degree of a continuous output.
pub const MAX_DEGREE: usize = 24;

#[cfg(test)]
mod tests {
    use super::{MAX_DEGREE, Step, evaluate};

    /// Powers have the Bernstein coefficients (i over k)/(d over k).
    #[test]
    fn high_degrees_agree_with_powers() {
        let binomial = |n: usize, k: usize| -> f64 {
            (0..k).map(|j| (n - j) as f64 / (j + 1) as f64).product()
        };
        for degree in [10, 16, MAX_DEGREE] {
            for power in [1, 2, 7, degree] {
                let coefficients: Vec<f64> = (0..=degree)
                    .map(|i| {
                        if i < power {
                            0.0
                        } else {
                            binomial(i, power) / binomial(degree, power)
                        }
                    })
                    .map(|c| 1e6 + c)
                    .collect();
                for k in 0..=20 {
                    let s = f64::from(k) / 20.0;
                    let (value, slope) = evaluate(&coefficients, s);
                    let power = power as i32;
                    approx::assert_abs_diff_eq!(value - 1e6, s.powi(power), epsilon = 1e-9);
                    let expected = f64::from(power) * s.powi(power - 1);
                    approx::assert_abs_diff_eq!(slope, expected, epsilon = 1e-8);
                }
            }
        }
    }

    #[test]
    fn a_state_is_the_values_and_rates_of_all_signals() {
        for degree in [1, 3, 9, MAX_DEGREE] {
            let wave = |k: usize| ((7 * k * k) as f64).sin();
            let coefficients: Vec<f64> = (0..2 * (degree + 1)).map(wave).collect();
            let step = Step {
                start: 0.0,
                length: 0.25,
                end: 1.0,
                coordinates: 2,
                degree,
                bases: &[100.0, -1.0],
                coefficients: &coefficients,
            };
            for s in [0.0, 1e-9, 0.3, 0.5, 0.9, 1.0] {
                let mut y = [0.0; 4];
                step.state(s, &mut y);
                for signal in 0..2 {
                    let (value, rate) = step.value(signal, s);
                    approx::assert_abs_diff_eq!(y[signal], value, epsilon = 1e-13);
                    approx::assert_abs_diff_eq!(y[2 + signal], rate, epsilon = 1e-11);
                }
            }
        }
    }

    #[test]
    fn a_cubic_in_bernstein_form_has_its_value_and_slope() {
        // s³ − s has Bernstein coefficients 0, −1/3, −2/3, 0.
        let coefficients = [0.0, -1.0 / 3.0, -2.0 / 3.0, 0.0];
        for s in [0.0, 0.3, 1.0, 1.2f64] {
            let (value, slope) = evaluate(&coefficients, s);
            approx::assert_abs_diff_eq!(value, s.powi(3) - s, epsilon = 1e-15);
            approx::assert_abs_diff_eq!(slope, 3.0 * s * s - 1.0, epsilon = 1e-14);
        }
    }
}
