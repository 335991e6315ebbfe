//! A step looked at at several places at once.
//!
//! At every place all signals are weighted sums of their coefficients with the same
//! weights. Of several places these stand side by side, so that a coefficient is read once
//! and counts for all of them.

use super::{MAX_DEGREE, Step, weights};

/// Places that are looked at at once, at most.
pub(crate) const LANES: usize = 8;

/// A number for every place.
type Lanes = [f64; LANES];

/// Bernstein polynomials of a degree at some places, one after the other.
#[derive(Clone, Debug)]
struct Weights {
    degree: usize,
    rows: [Lanes; MAX_DEGREE + 1],
}

impl Weights {
    const NONE: Self = Self {
        degree: usize::MAX,
        rows: [[0.0; LANES]; MAX_DEGREE + 1],
    };

    fn set(&mut self, degree: usize, places: &[f64]) {
        self.degree = degree;
        for (lane, &s) in places.iter().enumerate() {
            let own = weights(degree, s);
            for (row, weight) in self.rows.iter_mut().zip(own) {
                row[lane] = weight;
            }
        }
    }

    fn rows(&self) -> &[Lanes] {
        &self.rows[..=self.degree]
    }
}

/// Places of steps, as shares of what is valid of them.
#[derive(Clone, Debug)]
pub(crate) struct Places {
    shares: Vec<f64>,
    /// Where the steps that the weights are for end.
    end: f64,
    /// The places, 0 ≤ s ≤ `end`.
    at: Vec<f64>,
    of_states: Weights,
    of_accelerations: Weights,
}

impl Places {
    /// At most [`LANES`] places, 0 to 1.
    pub(crate) fn new(shares: &[f64]) -> Self {
        assert!(shares.len() <= LANES, "places side by side");
        Self {
            shares: shares.to_vec(),
            end: f64::NAN,
            at: Vec::new(),
            of_states: Weights::NONE,
            of_accelerations: Weights::NONE,
        }
    }

    /// Makes the weights those of a step.
    fn set_step(&mut self, step: &Step<'_>) {
        if self.end != step.end {
            self.end = step.end;
            self.at = self.shares.iter().map(|share| share * step.end).collect();
            (self.of_states.degree, self.of_accelerations.degree) = (usize::MAX, usize::MAX);
        }
    }

    /// The states y = [u, u′] of a step of degree 1 or more at the places, one after the
    /// other.
    pub(crate) fn states(&mut self, step: &Step<'_>, out: &mut [f64]) {
        self.set_step(step);
        if self.of_states.degree != step.degree - 1 {
            self.of_states.set(step.degree - 1, &self.at);
        }
        let (n, rate) = (step.coordinates, step.degree as f64 / step.length);
        for index in 0..n {
            let (mut values, mut slopes) = ([0.0; LANES], [0.0; LANES]);
            let row = step.differences(index);
            for (weights, pair) in self.of_states.rows().iter().zip(row.windows(2)) {
                add(&mut values, weights, pair[0]);
                add(&mut slopes, weights, pair[1] - pair[0]);
            }
            let base = step.bases[index];
            let states = out.chunks_exact_mut(2 * n).zip(&self.at);
            for ((y, s), (value, slope)) in states.zip(values.iter().zip(slopes)) {
                y[index] = base + (value + s * slope);
                y[n + index] = rate * slope;
            }
        }
    }

    /// Second derivatives of the coordinates by the time at the places, one after the
    /// other.
    pub(crate) fn accelerations(&mut self, step: &Step<'_>, out: &mut [f64]) {
        self.set_step(step);
        let (n, degree) = (step.coordinates, step.degree);
        if degree < 2 {
            return out.fill(0.0);
        }
        if self.of_accelerations.degree != degree - 2 {
            self.of_accelerations.set(degree - 2, &self.at);
        }
        let factor = (degree * (degree - 1)) as f64 / (step.length * step.length);
        for index in 0..n {
            let mut bends = [0.0; LANES];
            let threes = step.differences(index).windows(3);
            for (weights, three) in self.of_accelerations.rows().iter().zip(threes) {
                let bend = (three[2] - three[1]) - (three[1] - three[0]);
                add(&mut bends, weights, bend);
            }
            for (second, bend) in out.chunks_exact_mut(n).zip(bends) {
                second[index] = factor * bend;
            }
        }
    }
}

/// Adds a coefficient to the sums of all places.
#[inline(always)]
fn add(sums: &mut Lanes, weights: &Lanes, coefficient: f64) {
    for (sum, weight) in sums.iter_mut().zip(weights) {
        *sum += weight * coefficient;
    }
}

#[cfg(test)]
mod tests {
    use super::{Places, Step};

    const SHARES: [f64; 4] = [0.0, 0.2, 0.7, 1.0];

    /// Steps of all degrees, whole and cut, agree with looks at one place after the other.
    #[test]
    fn all_places_at_once_are_each_of_them() {
        let mut places = Places::new(&SHARES);
        for (degree, end) in [(1, 1.0), (2, 1.0), (5, 1.0), (5, 0.3), (9, 0.3), (24, 1.0)] {
            let wave = |k: usize| ((3 * k * k) as f64).sin();
            let coefficients: Vec<f64> = (0..3 * (degree + 1)).map(wave).collect();
            let step = Step {
                start: 2.0,
                length: 0.5,
                end,
                coordinates: 3,
                degree,
                bases: &[3.0, -1.0, 0.0],
                coefficients: &coefficients,
            };
            let (mut states, mut seconds) = ([0.0; 4 * 6], [0.0; 4 * 3]);
            places.states(&step, &mut states);
            places.accelerations(&step, &mut seconds);
            let (mut y, mut second) = ([0.0; 6], [0.0; 3]);
            for (place, share) in SHARES.iter().enumerate() {
                step.state(share * end, &mut y);
                step.accelerations(share * end, &mut second);
                let (states, seconds) = (&states[6 * place..][..6], &seconds[3 * place..][..3]);
                let found = states.iter().chain(seconds);
                for (found, expected) in found.zip(y.iter().chain(&second)) {
                    approx::assert_relative_eq!(
                        *found,
                        *expected,
                        max_relative = 1e-13,
                        epsilon = 1e-12
                    );
                }
            }
        }
    }
}
