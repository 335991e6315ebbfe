//! Is the solution the only one? A proof where friction is moderate, a search
//! where it is strong.

use super::friction::{Law, Term};
use super::iteration::{Convergence, Method};
use super::workspace::ForceWorkspace;
use crate::math::order::Total;

/// Sweeps of the power iteration in [`ForceWorkspace::is_contraction`].
const SWEEPS: usize = 6;
/// Guides whose corners' signs are tried in all combinations.
const GUIDES: usize = 3;
/// Random directions to start from, for each τ.
const DIRECTIONS: usize = 4;
/// Sizes of the starts, in greatest reactions without friction.
const SIZES: [f64; 4] = [0.3, 2.0, 12.0, 300.0];
/// Two solutions closer than this part of the scale are one.
const SAME_SOLUTION: f64 = 1e-7;

impl ForceWorkspace {
    /// True if τ ↦ f(F₀ − K·τ) is proved to be a contraction: the solution
    /// then exists and is the only one.
    ///
    /// The change of every τ is bounded by a matrix of magnitudes C times the
    /// changes of all τ; C contracts in some norm if C·v < v for a positive
    /// vector v (Collatz, Wielandt), which a power iteration provides.
    pub(super) fn is_contraction(&mut self) -> bool {
        let [bounds, weights] = &mut self.scratch;
        let m = self.columns;
        bounds.clear();
        bounds.resize(m * m, 0.0);
        let width = 1 + m;
        for term in &self.terms {
            let first = &self.right[term.unknown * width + 1..][..m];
            let second = &self.right[(term.unknown + 1) * width + 1..][..m];
            for b in 0..m {
                let (x, y) = (first[b], second[b]);
                match term.law {
                    Law::Pin(factor) => {
                        bounds[term.column * m + b] = factor.abs() * (x * x + y * y).sqrt();
                    }
                    Law::Guide([along, couple]) => {
                        bounds[term.column * m + b] = along.abs() * (x.abs() + y.abs());
                        bounds[(term.column + 1) * m + b] = couple.abs() * (x + y).abs();
                    }
                    // Beside it normal forces change their signs by anything.
                    Law::HeldGuide { .. } => bounds[term.column * m + b] = f64::INFINITY,
                }
            }
        }
        weights.clear();
        weights.resize(m, 1.0);
        for _ in 0..SWEEPS {
            let mut greatest = 0.0f64;
            let mut ratio = 0.0f64;
            self.next.clear();
            for row in bounds.chunks_exact(m) {
                let sum: f64 = row.iter().zip(weights.iter()).map(|(c, v)| c * v).sum();
                let of = weights[self.next.len()];
                ratio = if sum / of <= ratio { ratio } else { sum / of };
                greatest = greatest.max(sum);
                self.next.push(sum);
            }
            if ratio < 1.0 {
                return true;
            }
            for (weight, sum) in weights.iter_mut().zip(&self.next) {
                *weight = sum / greatest + 1e-3;
            }
        }
        false
    }

    /// Looks for all solutions, from all signs of the corners and from far
    /// away; each as its τ. True: there are no others, since without friction of pins the
    /// signs of the corners leave one system of linear equations each. Allocates: meant for
    /// the few positions where the proof fails.
    pub(super) fn search(&mut self, course: &mut Convergence) -> (Vec<Vec<f64>>, bool) {
        let mut found: Vec<Vec<f64>> = Vec::new();
        self.without_friction();
        let scale = self.greatest_magnitude();
        let free = self.guides();
        let is_guide = |term: &Term| matches!(term.law, Law::Guide(_));
        let mut complete = free <= GUIDES && self.terms.iter().all(is_guide);
        for pattern in 0..1usize << (2 * free.min(GUIDES)) {
            self.without_friction();
            complete &= self.follow_signs(pattern, course);
            self.find_by_newton(course, &mut found);
        }
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..DIRECTIONS * self.columns {
            for size in SIZES {
                // Friction of random reactions: its signs are right.
                for unknown in &mut self.unknowns {
                    *unknown = scale * size * next_random(&mut state);
                }
                self.update_friction();
                self.friction.copy_from_slice(&self.next);
                self.find_by_newton(course, &mut found);
            }
        }
        found.sort_by_cached_key(|friction| Total(greatest_magnitude(friction)));
        (found, complete)
    }

    /// Number of guides with friction whose corners may press on either side.
    fn guides(&self) -> usize {
        let is_guide = |term: &&Term| matches!(term.law, Law::Guide(_)) && term.pressed.is_none();
        self.terms.iter().filter(is_guide).count()
    }

    /// Newton's method from the present τ; keeps what it finds, if it is new.
    fn find_by_newton(&mut self, course: &mut Convergence, found: &mut Vec<Vec<f64>>) {
        course.method = Method::Search;
        if !self.newton(course) {
            return;
        }
        let near = SAME_SOLUTION * self.greatest_magnitude();
        let known = found.iter().any(|other| {
            let pairs = other.iter().zip(&self.friction);
            pairs.fold(0.0f64, |most, (a, b)| most.max((a - b).abs())) <= near
        });
        if !known {
            found.push(self.friction.clone());
        }
    }

    /// Friction of the guides for given signs of their corners' forces, pins
    /// left without friction: the start that belongs to these signs. False: it is not
    /// determined.
    fn follow_signs(&mut self, pattern: usize, course: &mut Convergence) -> bool {
        course.iterations += 1;
        let m = self.columns;
        self.small.clear(m);
        let mut guide = 0;
        for index in 0..self.terms.len() {
            let term = self.terms[index];
            for which in 0..term.width() {
                self.small
                    .add(term.column + which, term.column + which, 1.0);
            }
            let Law::Guide([along, couple]) = term.law else {
                self.next[term.column] = 0.0;
                continue;
            };
            let sign = |corner: usize| {
                if pattern >> (2 * guide + corner) & 1 == 1 {
                    -1.0
                } else {
                    1.0
                }
            };
            let [p, q] = term.pressed.unwrap_or([sign(0), sign(1)]);
            let rows = [[along * p, along * q], [couple, couple]];
            guide += usize::from(term.pressed.is_none());
            for (which, [p, q]) in rows.into_iter().enumerate() {
                let row = term.column + which;
                let [f, g] = [0, 1].map(|k| self.right[(term.unknown + k) * (1 + m)]);
                self.next[row] = -(p * f + q * g);
                for column in 0..m {
                    let [x, y] = [0, 1].map(|k| self.k(term.unknown + k, column));
                    self.small.add(row, column, -(p * x + q * y));
                }
            }
        }
        let determined = self.small.factorise();
        if determined {
            self.small.solve(&mut self.next, 1);
            self.friction.copy_from_slice(&self.next);
        }
        determined
    }
}

/// Greatest magnitude.
fn greatest_magnitude(tau: &[f64]) -> f64 {
    tau.iter()
        .fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A number between −1 and 1, the same in every run (xorshift).
fn next_random(state: &mut u64) -> f64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    (*state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}
