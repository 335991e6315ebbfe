//! Eigenvalues of a symmetric matrix whose graph is a forest: by counting.
//!
//! Masses hang on each other as a tree, and so do the entries of their stiffness
//! matrix. Eliminated from the leaves to the roots nothing fills in, and the number
//! of negative pivots of A − σ·I is that of its eigenvalues below σ (Sylvester's law
//! of inertia). Each count takes time in proportion to the order of the matrix; the
//! eigenvalues are halved in from both sides (J. Barth, R. Martin and J. Wilkinson,
//! Calculation of the eigenvalues of a symmetric tridiagonal matrix by the method of
//! bisection, 1967).
//!
//! Eight intervals are halved at a time.

/// A symmetric matrix: every unknown is coupled with unknowns that hang on it and
/// with at most one before it, on which it hangs.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Forest {
    /// The diagonal.
    pub(super) diagonal: Vec<f64>,
    /// The unknown before it that each one hangs on, and the entry that couples them.
    pub(super) parent: Vec<Option<(usize, f64)>>,
}

/// An eigenvalue below this share of the greatest is zero to rounding.
const ZERO_EIGENVALUE: f64 = 1e-16;

/// Shifts whose counts are taken side by side.
const LANES: usize = 8;

impl Forest {
    /// The matrix without entries.
    pub(super) fn new(order: usize) -> Self {
        Self {
            diagonal: vec![0.0; order],
            parent: vec![None; order],
        }
    }

    /// Multiplies row and column i by `factors[i]`.
    pub(super) fn scale(&mut self, factors: &[f64]) {
        for (index, factor) in factors.iter().enumerate() {
            self.diagonal[index] *= factor * factor;
            if let Some((parent, entry)) = &mut self.parent[index] {
                *entry *= factor * factors[*parent];
            }
        }
    }

    /// True when all entries are numbers, and the bounds of the eigenvalues too.
    pub(super) fn is_finite(&self) -> bool {
        let entries = self.parent.iter().flatten().map(|&(_, entry)| entry);
        let mut all = entries
            .chain(self.diagonal.iter().copied())
            .chain(self.bounds());
        all.all(f64::is_finite)
    }

    /// All eigenvalues, ascending, each to its own rounding as far as the elimination
    /// knows it; the entries are finite.
    pub(super) fn eigenvalues(&self) -> Vec<f64> {
        let order = self.diagonal.len();
        let [low, high] = self.bounds();
        let least = ZERO_EIGENVALUE * low.abs().max(high.abs());
        let mut pivots = vec![[0.0; LANES]; order];
        let mut found = vec![0.0; order];
        // Intervals, and which eigenvalues lie in them.
        let mut open = vec![([low, high], 0..order)];
        while !open.is_empty() {
            let halved = open.split_off(open.len().saturating_sub(LANES));
            let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
            let mut shifts = [0.0; LANES];
            for (shift, (interval, _)) in shifts.iter_mut().zip(&halved) {
                *shift = middle(*interval);
            }
            let counts = self.counts(&shifts, &mut pivots);
            for ((ends, numbers), (shift, count)) in
                halved.into_iter().zip(shifts.into_iter().zip(counts))
            {
                // Rounding may disturb the order of counts that are nearly equal.
                let count = count.clamp(numbers.start, numbers.end);
                let halves = [
                    ([ends[0], shift], numbers.start..count),
                    ([shift, ends[1]], count..numbers.end),
                ];
                for (ends, numbers) in halves {
                    let [low, high] = ends;
                    let known = 2.0 * f64::EPSILON * low.abs().max(high.abs()).max(least);
                    // Between neighbouring numbers there is no middle: so it is at zero,
                    // where all entries are, as in a mass that hangs on nothing.
                    let apart = low < middle(ends) && middle(ends) < high;
                    if high - low <= known || !apart {
                        found[numbers].fill(middle(ends));
                    } else if !numbers.is_empty() {
                        open.push((ends, numbers));
                    }
                }
            }
        }
        found
    }

    /// An interval that holds all eigenvalues (Gershgorin's).
    fn bounds(&self) -> [f64; 2] {
        let mut radius = vec![0.0; self.diagonal.len()];
        for (index, parent) in self.parent.iter().enumerate() {
            if let Some((parent, entry)) = parent {
                radius[index] += entry.abs();
                radius[*parent] += entry.abs();
            }
        }
        let each = self.diagonal.iter().zip(&radius);
        let [low, high] = each.fold([0.0f64; 2], |[low, high], (d, r)| {
            [low.min(d - r), high.max(d + r)]
        });
        let margin = 8.0 * f64::EPSILON * low.abs().max(high.abs()) + f64::MIN_POSITIVE;
        [low - margin, high + margin]
    }

    /// Numbers of eigenvalues below each shift.
    fn counts(&self, shifts: &[f64; LANES], pivots: &mut [[f64; LANES]]) -> [usize; LANES] {
        let mut counts = [0; LANES];
        for (pivot, diagonal) in pivots.iter_mut().zip(&self.diagonal) {
            *pivot = shifts.map(|shift| diagonal - shift);
        }
        for index in (0..self.diagonal.len()).rev() {
            let own = pivots[index];
            for (count, pivot) in counts.iter_mut().zip(own) {
                *count += usize::from(pivot < 0.0);
            }
            let Some((parent, entry)) = self.parent[index] else {
                continue;
            };
            let square = entry * entry;
            for (above, pivot) in pivots[parent].iter_mut().zip(own) {
                // A pivot of zero counts as the smallest there is.
                let pivot = if pivot == 0.0 {
                    f64::MIN_POSITIVE
                } else {
                    pivot
                };
                *above -= square / pivot;
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::Forest;
    use nalgebra::{DMatrix, SymmetricEigen};

    fn dense(forest: &Forest) -> DMatrix<f64> {
        let n = forest.diagonal.len();
        let mut matrix = DMatrix::from_fn(n, n, |i, j| match i == j {
            true => forest.diagonal[i],
            false => 0.0,
        });
        for (index, parent) in forest.parent.iter().enumerate() {
            if let Some((parent, entry)) = *parent {
                matrix[(index, parent)] = entry;
                matrix[(parent, index)] = entry;
            }
        }
        matrix
    }

    #[test]
    fn eigenvalues_agree_with_those_of_the_dense_matrix() {
        let wave = |k: usize| (k as f64 * 1.7 + 0.3).sin();
        // A chain, a star, a tree with twins, several roots, one unknown, none.
        let parents: [fn(usize) -> Option<usize>; 4] = [
            |k| k.checked_sub(1),
            |k| (k > 0).then_some(0),
            |k| (k > 0).then(|| (k - 1) / 2),
            |k| (k % 5 != 0).then(|| k - 1),
        ];
        for parent in parents {
            for order in [0, 1, 2, 40] {
                let forest = Forest {
                    diagonal: (0..order).map(|k| 2.0 + 30.0 * wave(k / 2)).collect(),
                    parent: (0..order)
                        .map(|k| parent(k).map(|parent| (parent, wave(7 * k + 1))))
                        .collect(),
                };
                let mut expected: Vec<f64> = match order {
                    0 => Vec::new(),
                    _ => SymmetricEigen::new(dense(&forest))
                        .eigenvalues
                        .as_slice()
                        .to_vec(),
                };
                expected.sort_by(f64::total_cmp);
                let found = forest.eigenvalues();
                assert_eq!(found.len(), expected.len());
                for (a, b) in found.iter().zip(&expected) {
                    approx::assert_abs_diff_eq!(a, b, epsilon = 1e-12);
                }
            }
        }
    }

    #[test]
    fn a_matrix_of_nothing_has_eigenvalues_of_nothing() {
        for order in [1, 2, 9] {
            let found = Forest::new(order).eigenvalues();
            assert!(found.iter().all(|value| value.abs() < 1e-300), "{found:?}");
        }
        // And what is next to nothing is found.
        let mut forest = Forest::new(2);
        forest.diagonal = vec![0.0, 3e-310];
        let found = forest.eigenvalues();
        approx::assert_abs_diff_eq!(found[0], 0.0, epsilon = 1e-320);
        approx::assert_relative_eq!(found[1], 3e-310, max_relative = 1e-10);
    }

    #[test]
    fn a_long_chain_has_the_eigenvalues_of_the_closed_form() {
        // 2 − 2·cos(kπ/(n + 1)).
        let order = 3000;
        let forest = Forest {
            diagonal: vec![2.0; order],
            parent: (0..order)
                .map(|k| k.checked_sub(1).map(|parent| (parent, -1.0)))
                .collect(),
        };
        for (k, found) in forest.eigenvalues().into_iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (order + 1) as f64;
            approx::assert_abs_diff_eq!(found, 2.0 - 2.0 * angle.cos(), epsilon = 1e-13);
        }
    }
}
