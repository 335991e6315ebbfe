//! Small dense systems of equations, factorised in place.

/// Factorises the n × n matrix (by rows) with partial pivoting; returns its
/// determinant, zero where it is singular.
pub(crate) fn factorise(matrix: &mut [f64], pivots: &mut [usize]) -> f64 {
    let n = pivots.len();
    let mut determinant = 1.0;
    for column in 0..n {
        let mut best = column;
        for row in column + 1..n {
            if matrix[row * n + column].abs() > matrix[best * n + column].abs() {
                best = row;
            }
        }
        pivots[column] = best;
        let pivot = matrix[best * n + column];
        if !(pivot.abs() > 0.0) {
            return 0.0;
        }
        if best != column {
            determinant = -determinant;
            for k in 0..n {
                matrix.swap(column * n + k, best * n + k);
            }
        }
        determinant *= pivot;
        let (above, below) = matrix.split_at_mut((column + 1) * n);
        let top = &above[column * n..];
        for row in below.chunks_exact_mut(n) {
            let factor = row[column] / pivot;
            row[column] = factor;
            if factor != 0.0 {
                for k in column + 1..n {
                    row[k] -= factor * top[k];
                }
            }
        }
    }
    determinant
}

/// Solves for the right side in place, with the factors of [`factorise`].
pub(crate) fn solve(matrix: &[f64], pivots: &[usize], right: &mut [f64]) {
    let n = pivots.len();
    for (row, &pivot) in pivots.iter().enumerate() {
        right.swap(row, pivot);
    }
    for row in 1..n {
        for k in 0..row {
            right[row] -= matrix[row * n + k] * right[k];
        }
    }
    for row in (0..n).rev() {
        for k in row + 1..n {
            right[row] -= matrix[row * n + k] * right[k];
        }
        right[row] /= matrix[row * n + row];
    }
}

#[cfg(test)]
mod tests {
    use super::{factorise, solve};

    #[test]
    fn systems_that_need_pivots_are_solved() {
        // Rows in an order that has zeros on the diagonal.
        let matrix = [
            0.0, 2.0, 1.0, 0.0, //
            1.0, 0.0, 0.0, 3.0, //
            4.0, 1.0, 0.0, 0.0, //
            0.0, 0.0, 2.0, 1.0,
        ];
        let wanted = [1.0, -2.0, 3.0, 0.5];
        let mut right: Vec<f64> = (0..4)
            .map(|row| (0..4).map(|k| matrix[row * 4 + k] * wanted[k]).sum())
            .collect();
        let (mut factors, mut pivots) = (matrix, [0; 4]);
        let determinant = factorise(&mut factors, &mut pivots);
        solve(&factors, &pivots, &mut right);
        for (found, wanted) in right.iter().zip(wanted) {
            approx::assert_relative_eq!(*found, wanted, max_relative = 1e-14);
        }
        // By cofactors along the third row: 4·det[2 1 0; 0 0 3; 0 2 1] − 1·det[0 1 0; 1 0 3; 0 2 1].
        approx::assert_relative_eq!(determinant, 4.0 * -12.0 + 1.0, max_relative = 1e-14);
    }

    #[test]
    fn a_singular_matrix_has_no_determinant() {
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        assert_eq!(factorise(&mut matrix, &mut [0; 2]), 0.0);
    }
}
