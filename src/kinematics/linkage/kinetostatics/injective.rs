//! A proof that friction τ = f(F₀ − K·τ) has one solution at most, where the iteration need not
//! be a contraction.
//!
//! Two solutions would differ by a vector that a matrix M = 1 + f′·K takes to zero, each
//! pair's slopes f′ being a mean of those that its law has anywhere. With the signs of a
//! guide's two corners between −1 and 1, with a direction of at most length one of a pin. The
//! determinant is linear in the slopes of each pair by itself. Where it has one sign at all
//! corners of these sets, it is zero nowhere between them.

use super::friction::{Law, Term};
use super::workspace::ForceWorkspace;
use crate::math::linear::dense::{factorise, solve};
use std::f64::consts::TAU;

/// Matrices that are looked at, at most.
const MOST_CORNERS: usize = 512;
/// Corners of the polygon around the directions of a pin.
const POLYGON: usize = 8;
/// Sweeps of the power iteration that bounds what is left.
const SWEEPS: usize = 6;
/// A matrix whose pivots differ by more is taken for singular.
const REGULAR: f64 = 1e-9;

impl ForceWorkspace {
    /// True if it is proved that there is one solution at most. Allocates.
    pub(super) fn is_injective(&self) -> bool {
        let held = |term: &Term| matches!(term.law, Law::HeldGuide { .. });
        if self.terms.iter().any(held) || !self.right.iter().all(|value| value.is_finite()) {
            return false;
        }
        let [looked_at, bounded] = self.split_terms();
        let bounds = self.bounds(&bounded);
        let count: usize = looked_at.iter().map(|(_, corners)| corners.len()).product();
        let mut sign = 0.0;
        (0..count).all(|mut number| {
            let chosen = looked_at.iter().map(|(index, corners)| {
                let own = corners[number % corners.len()];
                number /= corners.len();
                (*index, own)
            });
            let found = regular_sign(self.matrix(chosen), &bounds);
            let agrees = found != 0.0 && found * sign >= 0.0;
            sign = found;
            agrees
        })
    }

    /// The terms whose corners are looked at, with these, and those that are bounded: the
    /// strongest come first.
    fn split_terms(&self) -> [Vec<(usize, Vec<[f64; 2]>)>; 2] {
        let strength = |index: usize| {
            let term = &self.terms[index];
            let factor = match term.law {
                Law::Pin(factor) => factor,
                Law::Guide([along, _]) => along,
                Law::HeldGuide { .. } => f64::INFINITY,
            };
            let size = |column| {
                self.k(term.unknown, column)
                    .hypot(self.k(term.unknown + 1, column))
            };
            factor.abs() * (0..self.columns).map(size).sum::<f64>()
        };
        let mut order: Vec<usize> = (0..self.terms.len()).collect();
        order.sort_by(|&a, &b| strength(b).total_cmp(&strength(a)));
        let (mut looked_at, mut bounded, mut count) = (Vec::new(), Vec::new(), 1);
        for index in order {
            let corners = corners(&self.terms[index]);
            match count * corners.len() <= MOST_CORNERS {
                true => {
                    count *= corners.len();
                    looked_at.push((index, corners));
                }
                false => bounded.push((index, corners)),
            }
        }
        [looked_at, bounded]
    }

    /// The matrix M with the slopes of these terms, without those that follow the reactions of
    /// the others.
    fn matrix(&self, chosen: impl Iterator<Item = (usize, [f64; 2])>) -> Vec<f64> {
        let m = self.columns;
        let mut matrix = vec![0.0; m * m];
        for a in 0..m {
            matrix[a * m + a] = 1.0;
        }
        for term in &self.terms {
            if let Law::Guide([_, couple]) = term.law {
                self.add_row(term, term.column + 1, [-couple, -couple], &mut matrix);
            }
        }
        for (index, [p, q]) in chosen {
            let term = &self.terms[index];
            let (Law::Pin(factor) | Law::Guide([factor, _])) = term.law else {
                continue; // refused before
            };
            self.add_row(term, term.column, [-factor * p, -factor * q], &mut matrix);
        }
        matrix
    }

    /// Adds slopes of a term times its rows of K.
    fn add_row(&self, term: &Term, row: usize, slopes: [f64; 2], matrix: &mut [f64]) {
        let m = self.columns;
        for column in 0..m {
            let [x, y] = [0, 1].map(|k| self.k(term.unknown + k, column));
            matrix[row * m + column] += slopes[0] * x + slopes[1] * y;
        }
    }

    /// Greatest magnitudes that the slopes of these terms add to M.
    fn bounds(&self, terms: &[(usize, Vec<[f64; 2]>)]) -> Vec<f64> {
        let m = self.columns;
        let mut bounds = vec![0.0; m * m];
        for (index, corners) in terms {
            let term = &self.terms[*index];
            for [p, q] in corners {
                let mut own = vec![0.0; m * m];
                let (Law::Pin(factor) | Law::Guide([factor, _])) = term.law else {
                    continue; // refused before
                };
                self.add_row(term, term.column, [factor * p, factor * q], &mut own);
                for (bound, own) in bounds.iter_mut().zip(&own) {
                    *bound = f64::max(*bound, own.abs());
                }
            }
        }
        bounds
    }
}

/// The corners of a set around all directions in which a pair's reactions may press.
fn corners(term: &Term) -> Vec<[f64; 2]> {
    match (term.law, term.pressed) {
        (Law::Pin(_), _) => (0..POLYGON)
            .map(|k| {
                let angle = TAU * k as f64 / POLYGON as f64;
                let radius = 1.0 / (0.5 * TAU / POLYGON as f64).cos();
                [radius * angle.cos(), radius * angle.sin()]
            })
            .collect(),
        (Law::Guide(_), Some(pressed)) => vec![pressed],
        (Law::Guide(_) | Law::HeldGuide { .. }, _) => {
            vec![[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
        }
    }
}

/// The sign of the determinants of a matrix and of all that differ from it by no more than the
/// bounds; 0 where one of them may be singular.
fn regular_sign(mut matrix: Vec<f64>, bounds: &[f64]) -> f64 {
    let m = (bounds.len() as f64).sqrt().round() as usize;
    let mut exchanged = vec![0; m];
    let pivots = factorise(&mut matrix, &mut exchanged);
    if !(pivots.ratio > REGULAR) {
        return 0.0;
    }
    let mut inverse = vec![0.0; m * m];
    (0..m).for_each(|a| inverse[a * m + a] = 1.0);
    solve(&matrix, &exchanged, &mut inverse, m);
    // |M⁻¹|·B contracts if it takes a positive vector below itself (Collatz).
    let product = |matrix: &[f64], vector: &[f64]| -> Vec<f64> {
        let rows = matrix.chunks_exact(m);
        let sum = |row: &[f64]| row.iter().zip(vector).map(|(a, b)| a.abs() * b).sum();
        rows.map(sum).collect()
    };
    let mut vector = vec![1.0; m];
    for _ in 0..SWEEPS {
        let next = product(&inverse, &product(bounds, &vector));
        if next.iter().zip(&vector).all(|(next, now)| next < now) {
            return pivots.determinant.signum();
        }
        let greatest = next.iter().fold(0.0, |most: f64, &value| most.max(value));
        if !greatest.is_finite() {
            break;
        }
        for (own, next) in vector.iter_mut().zip(&next) {
            *own = next / greatest + 1e-3;
        }
    }
    0.0
}
