//! Dense systems of equations in memory that is kept: one factorisation, many
//! right sides.
//!
//! The matrices of kinetostatics are small (3 rows a link) and mostly zeros;
//! zeros are passed over.

use super::dense;

/// A square matrix and, after [`Factors::factorise`], its factors P·A = L·U.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factors {
    size: usize,
    /// Row after row.
    values: Vec<f64>,
    /// Row exchanged with row k in step k.
    exchanged: Vec<usize>,
    /// Greatest sum of the magnitudes of a column of A.
    norm: f64,
    /// Least pivot over greatest.
    pivots: f64,
}

impl Factors {
    /// Room for matrices of up to `size` rows.
    pub(crate) fn with_room(size: usize) -> Self {
        Self {
            size,
            values: vec![0.0; size * size],
            exchanged: vec![0; size],
            norm: 0.0,
            pivots: 0.0,
        }
    }

    /// Makes it the zero matrix of `size` rows.
    pub(crate) fn clear(&mut self, size: usize) {
        self.size = size;
        self.values.clear();
        self.values.resize(size * size, 0.0);
        self.exchanged.clear();
        self.exchanged.resize(size, 0);
    }

    /// Adds to an entry.
    #[inline]
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.values[row * self.size + column] += value;
    }

    /// Columns that the first `rows` rows can do without: those that elimination with the greatest
    /// pivot of all leaves over. The last `kept` columns are not among them.
    pub(crate) fn spare_columns(&self, rows: usize, kept: usize) -> Vec<usize> {
        let (size, mut left) = (self.size, self.values[..rows * self.size].to_vec());
        let mut spare: Vec<usize> = (0..size).collect();
        let mut open: Vec<usize> = (0..rows).collect();
        for step in 0..rows {
            // Those that are kept are taken first.
            let wanted = match step < kept {
                true => size - kept + step..size - kept + step + 1,
                false => 0..size,
            };
            let columns = spare.iter().filter(|column| wanted.contains(column));
            let places = columns.flat_map(|&column| open.iter().map(move |&row| (row, column)));
            let value = |&(row, column): &(usize, usize)| left[row * size + column].abs();
            let Some(pivot) = places.max_by(|a, b| value(a).total_cmp(&value(b))) else {
                break;
            };
            let (row, column) = pivot;
            open.retain(|&other| other != row);
            spare.retain(|&other| other != column);
            let taken: Vec<f64> = left[row * size..(row + 1) * size].to_vec();
            for &other in &open {
                let factor = left[other * size + column] / taken[column];
                if factor != 0.0 && factor.is_finite() {
                    let own = &mut left[other * size..(other + 1) * size];
                    own.iter_mut()
                        .zip(&taken)
                        .for_each(|(own, taken)| *own -= factor * taken);
                }
            }
        }
        spare
    }

    /// Factorises the matrix in place; false if it is singular or not finite.
    pub(crate) fn factorise(&mut self) -> bool {
        self.norm = self.greatest_column();
        let found = dense::factorise(&mut self.values, &mut self.exchanged);
        self.pivots = found.ratio;
        found.is_regular() && self.values.iter().all(|value| value.is_finite())
    }

    /// Greatest sum of the magnitudes of a column.
    fn greatest_column(&self) -> f64 {
        (0..self.size).fold(0.0, |most: f64, column| {
            let sum = self.values[column..]
                .iter()
                .step_by(self.size)
                .map(|value| value.abs())
                .sum();
            most.max(sum)
        })
    }

    /// Least pivot over greatest: a quick hint at how near to singular the
    /// matrix is; [`Self::condition`] is the measure.
    pub(crate) fn pivots(&self) -> f64 {
        self.pivots
    }

    /// Solves A·X = R for `width` right sides lying row after row in `right`.
    pub(crate) fn solve(&self, right: &mut [f64], width: usize) {
        dense::solve(&self.values, &self.exchanged, right, width);
    }

    /// Solves Aᵀ·x = r in place.
    pub(crate) fn solve_transposed(&self, x: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            x[k] /= self.values[k * n + k];
            let known = x[k];
            for j in k + 1..n {
                x[j] -= self.values[k * n + j] * known;
            }
        }
        for k in (1..n).rev() {
            let known = x[k];
            for j in 0..k {
                x[j] -= self.values[k * n + j] * known;
            }
        }
        for k in (0..n).rev() {
            x.swap(k, self.exchanged[k]);
        }
    }

    /// Condition number ‖A‖·‖A⁻¹‖ in the norm of the greatest column, the
    /// second factor as Hager estimates it (W. W. Hager, "Condition estimates",
    /// SIAM J. Sci. Stat. Comput. 5 (1984)): never above the true number, and
    /// seldom below a third of it. `x` and `y` are memory.
    pub(crate) fn condition(&self, x: &mut Vec<f64>, y: &mut Vec<f64>) -> f64 {
        let n = self.size;
        x.clear();
        x.resize(n, 1.0 / n as f64);
        let mut estimate = 0.0f64;
        for _ in 0..5 {
            self.solve(x, 1);
            estimate = estimate.max(x.iter().map(|value| value.abs()).sum());
            y.clear();
            y.extend(x.iter().map(|value| value.signum()));
            self.solve_transposed(y);
            let greatest = (0..n).fold(
                0,
                |best, i| {
                    if y[i].abs() > y[best].abs() { i } else { best }
                },
            );
            x.iter_mut().for_each(|value| *value = 0.0);
            x[greatest] = 1.0;
        }
        estimate * self.norm
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;

    /// A matrix of small integers with zeros in it, the same in every run.
    fn matrix(size: usize, seed: u64) -> (Factors, Vec<f64>) {
        let mut factors = Factors::default();
        factors.clear(size);
        let mut state = seed;
        let mut values = vec![0.0; size * size];
        for row in 0..size {
            for column in 0..size {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(99);
                let value = ((state >> 33) % 11) as f64 - 5.0;
                let value = if (state >> 50).is_multiple_of(2) {
                    0.0
                } else {
                    value
                };
                let value = value + if (row + 1) % size == column { 7.0 } else { 0.0 };
                factors.add(row, column, value);
                values[row * size + column] = value;
            }
        }
        (factors, values)
    }

    #[test]
    fn systems_and_transposed_systems_are_solved() {
        for size in [1, 2, 5, 9, 21] {
            let (mut factors, a) = matrix(size, size as u64);
            assert!(factors.factorise());
            let wanted: Vec<f64> = (0..2 * size).map(|k| (k as f64).sin()).collect();
            let mut right = vec![0.0; 2 * size];
            let mut transposed = vec![0.0; size];
            for row in 0..size {
                for column in 0..size {
                    let value = a[row * size + column];
                    for which in 0..2 {
                        right[2 * row + which] += value * wanted[2 * column + which];
                    }
                    transposed[column] += value * wanted[row];
                }
            }
            factors.solve(&mut right, 2);
            factors.solve_transposed(&mut transposed);
            for k in 0..2 * size {
                assert!((right[k] - wanted[k]).abs() < 1e-11, "{size} {k}");
            }
            for k in 0..size {
                assert!((transposed[k] - wanted[k]).abs() < 1e-11, "{size} {k}");
            }
        }
    }

    #[test]
    fn columns_that_are_not_needed_are_spared() {
        // x0 and x1 are tied to each other, x2 stands alone.
        let mut factors = Factors::default();
        factors.clear(3);
        for (row, column, value) in [(0, 0, 1.0), (0, 1, 3.0), (1, 2, 1e-3)] {
            factors.add(row, column, value);
        }
        assert_eq!(factors.spare_columns(2, 0), [0]);
        assert_eq!(factors.spare_columns(2, 1), [0]);
    }

    #[test]
    fn the_condition_number_is_estimated() {
        let size = 9;
        let (mut factors, a) = matrix(size, 4);
        let column_sum = |values: &dyn Fn(usize, usize) -> f64| {
            let sums = (0..size).map(|c| (0..size).map(|r| values(r, c).abs()).sum::<f64>());
            sums.fold(0.0, f64::max)
        };
        let norm = column_sum(&|r, c| a[r * size + c]);
        assert!(factors.factorise());
        let mut inverse = vec![0.0; size * size];
        (0..size).for_each(|k| inverse[k * size + k] = 1.0);
        factors.solve(&mut inverse, size);
        let exact = norm * column_sum(&|r, c| inverse[r * size + c]);
        let found = factors.condition(&mut Vec::new(), &mut Vec::new());
        assert!(
            found <= exact * (1.0 + 1e-12) && found > 0.3 * exact,
            "{found} {exact}"
        );
    }

    #[test]
    fn singular_matrices_are_recognised() {
        let mut factors = Factors::default();
        factors.clear(2);
        for (row, column, value) in [(0, 0, 1.0), (0, 1, 2.0), (1, 0, 2.0), (1, 1, 4.0)] {
            factors.add(row, column, value);
        }
        assert!(!factors.factorise());
        factors.clear(1);
        factors.add(0, 0, f64::NAN);
        assert!(!factors.factorise());
    }
}
