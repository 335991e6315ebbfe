//! Small dense systems of equations, factorised in place: of numbers, or of numbers with
//! derivatives.

use crate::math::number::Number;

/// Pivots of a factorisation: what they tell of its matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pivots {
    /// The determinant, 0 where the matrix is singular or not finite.
    pub(crate) determinant: f64,
    /// Least pivot over greatest; 0 where there are not all of them.
    pub(crate) ratio: f64,
}

impl Pivots {
    /// True where all pivots are finite and none is zero.
    pub(crate) fn is_regular(&self) -> bool {
        self.ratio > 0.0
    }
}

/// Factorises an n × n matrix, given by rows, to P·A = L·U; rows are exchanged for the
/// greatest pivot, `exchanged` holds which in each step. Zeros are passed over. Where a
/// pivot is zero or not finite nothing may be solved with what is left.
pub(crate) fn factorise<N: Number>(matrix: &mut [N], exchanged: &mut [usize]) -> Pivots {
    let n = exchanged.len();
    let (mut least, mut greatest, mut determinant) = (f64::INFINITY, 0.0f64, 1.0);
    for k in 0..n {
        let size = |row: usize| matrix[row * n + k].value().abs();
        let best = (k..n).fold(k, |best, row| match size(row) > size(best) {
            true => row,
            false => best,
        });
        exchanged[k] = best;
        let pivot = matrix[best * n + k].value();
        if !(pivot.is_finite() && pivot != 0.0) {
            return Pivots {
                determinant: 0.0,
                ratio: 0.0,
            };
        }
        least = least.min(pivot.abs());
        greatest = greatest.max(pivot.abs());
        determinant *= if best == k { pivot } else { -pivot };
        eliminate(matrix, n, k, best);
    }
    Pivots {
        determinant,
        ratio: if n == 0 { 1.0 } else { least / greatest },
    }
}

/// Step k of the elimination.
#[inline]
fn eliminate<N: Number>(matrix: &mut [N], n: usize, k: usize, best: usize) {
    if best != k {
        let (upper, lower) = matrix.split_at_mut(best * n);
        upper[k * n..(k + 1) * n].swap_with_slice(&mut lower[..n]);
    }
    let (upper, lower) = matrix.split_at_mut((k + 1) * n);
    let top = &upper[k * n..];
    let inverse = N::from(1.0) / top[k];
    for row in lower.chunks_exact_mut(n) {
        if !row[k].vanishes() {
            let factor = row[k] * inverse;
            row[k] = factor;
            subtract(&mut row[k + 1..], factor, &top[k + 1..]);
        }
    }
}

/// Solves A·X = R in place for `width` right sides lying row after row in `right`, with
/// the factors of [`factorise`].
pub(crate) fn solve<N: Number>(factors: &[N], exchanged: &[usize], right: &mut [N], width: usize) {
    let n = exchanged.len();
    for (k, &other) in exchanged.iter().enumerate() {
        if other != k {
            let (upper, lower) = right.split_at_mut(other * width);
            upper[k * width..(k + 1) * width].swap_with_slice(&mut lower[..width]);
        }
    }
    if width == 1 {
        return solve_one(factors, right);
    }
    for i in 1..n {
        let (known, rest) = right.split_at_mut(i * width);
        for k in 0..i {
            let factor = factors[i * n + k];
            if !factor.vanishes() {
                subtract(&mut rest[..width], factor, &known[k * width..]);
            }
        }
    }
    for i in (0..n).rev() {
        let (upper, known) = right.split_at_mut((i + 1) * width);
        let row = &mut upper[i * width..];
        for k in i + 1..n {
            let factor = factors[i * n + k];
            if !factor.vanishes() {
                subtract(row, factor, &known[(k - i - 1) * width..]);
            }
        }
        let inverse = N::from(1.0) / factors[i * n + i];
        row.iter_mut().for_each(|value| *value = *value * inverse);
    }
}

/// One right side, its rows exchanged already.
fn solve_one<N: Number>(factors: &[N], right: &mut [N]) {
    let n = right.len();
    for row in 1..n {
        for k in 0..row {
            let known = right[k];
            right[row] -= factors[row * n + k] * known;
        }
    }
    for row in (0..n).rev() {
        for k in row + 1..n {
            let known = right[k];
            right[row] -= factors[row * n + k] * known;
        }
        right[row] = right[row] / factors[row * n + row];
    }
}

/// row −= factor·above.
#[inline(always)]
fn subtract<N: Number>(row: &mut [N], factor: N, above: &[N]) {
    for (value, &above) in row.iter_mut().zip(above) {
        *value -= factor * above;
    }
}

/// Factorises a symmetric positive n × n matrix, given by rows of which the lower triangle
/// is looked at, to L·D·Lᵀ: L (with ones) below the diagonal, 1/D on it. No roots are taken
/// and no rows exchanged. Returns the least pivot over the entry that it began as: where it
/// is not well above rounding, the matrix is not positive, and what is solved with it means
/// nothing.
pub(crate) fn factorise_symmetric<N: Number>(matrix: &mut [N], n: usize) -> f64 {
    let mut least = f64::INFINITY;
    for i in 0..n {
        let (before, rest) = matrix.split_at_mut(i * n);
        let row = &mut rest[..n];
        for j in 0..i {
            let mut sum = row[j];
            for (&own, &other) in row[..j].iter().zip(&before[j * n..]) {
                sum -= own * other;
            }
            row[j] = sum;
        }
        let mut pivot = row[i];
        let size = pivot.value().abs();
        for (j, entry) in row[..i].iter_mut().enumerate() {
            let factor = *entry * before[j * n + j];
            pivot -= factor * *entry;
            *entry = factor;
        }
        row[i] = N::from(1.0) / pivot;
        // Not a number counts as zero.
        let ratio = pivot.value() / size;
        least = least.min(if ratio.is_finite() { ratio } else { 0.0 });
    }
    least
}

/// Solves A·x = r in place with the factors of [`factorise_symmetric`].
pub(crate) fn solve_symmetric<N: Number>(factors: &[N], right: &mut [N]) {
    let n = right.len();
    for i in 1..n {
        let (known, rest) = right.split_at_mut(i);
        for (&factor, &value) in factors[i * n..i * n + i].iter().zip(known.iter()) {
            rest[0] -= factor * value;
        }
    }
    for (i, value) in right.iter_mut().enumerate() {
        *value = *value * factors[i * n + i];
    }
    for i in (1..n).rev() {
        let (rest, known) = right.split_at_mut(i);
        for (value, &factor) in rest.iter_mut().zip(&factors[i * n..i * n + i]) {
            *value -= factor * known[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{factorise, factorise_symmetric, solve, solve_symmetric};
    use crate::math::number::Dual;

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
        let determinant = factorise(&mut factors, &mut pivots).determinant;
        solve(&factors, &pivots, &mut right, 1);
        for (found, wanted) in right.iter().zip(wanted) {
            approx::assert_relative_eq!(*found, wanted, max_relative = 1e-14);
        }
        // By cofactors along the third row: 4·det[2 1 0; 0 0 3; 0 2 1] − 1·det[0 1 0; 1 0 3; 0 2 1].
        approx::assert_relative_eq!(determinant, 4.0 * -12.0 + 1.0, max_relative = 1e-14);
    }

    #[test]
    fn a_symmetric_matrix_needs_its_lower_triangle_alone() {
        // B·Bᵀ with B = [2 0 0 0; 1 3 0 0; −1 2 1 0; 0.5 0 −2 4]; above the diagonal nothing.
        let matrix = [
            4.0, 9.0, 9.0, 9.0, //
            2.0, 10.0, 9.0, 9.0, //
            -2.0, 5.0, 6.0, 9.0, //
            1.0, 0.5, -2.5, 20.25,
        ];
        let wanted = [1.0, -2.0, 3.0, 0.5];
        let entry = |i: usize, k: usize| matrix[i.max(k) * 4 + i.min(k)];
        let mut right = [0, 1, 2, 3].map(|i| (0..4).map(|k| entry(i, k) * wanted[k]).sum());
        let mut factors = matrix;
        // Pivots 4, 9, 1, 16 of the entries 4, 10, 6, 20.25.
        let least = factorise_symmetric(&mut factors, 4);
        approx::assert_relative_eq!(least, 1.0 / 6.0, max_relative = 1e-14);
        solve_symmetric(&factors, &mut right);
        for (found, wanted) in right.iter().zip(wanted) {
            approx::assert_relative_eq!(*found, wanted, max_relative = 1e-13);
        }
        assert!(factorise_symmetric(&mut [1.0, 0.0, 2.0, 4.0], 2) <= 0.0);
        assert_eq!(factorise_symmetric(&mut [0.0], 1), 0.0);
    }

    #[test]
    fn a_singular_matrix_has_no_determinant() {
        let mut matrix = [1.0, 2.0, 2.0, 4.0];
        let found = factorise(&mut matrix, &mut [0; 2]);
        assert!(!found.is_regular() && found.determinant == 0.0);
    }

    #[test]
    fn several_right_sides_are_solved_at_once() {
        let matrix = [0.0, 2.0, 1.0, 3.0, 1.0, 0.0, 1.0, 0.0, 4.0];
        let (mut factors, mut exchanged) = (matrix, [0; 3]);
        assert!(factorise(&mut factors, &mut exchanged).is_regular());
        let columns = [[1.0, 2.0, 3.0], [-4.0, 0.5, 0.0]];
        let mut both: Vec<f64> = (0..3)
            .flat_map(|i| [columns[0][i], columns[1][i]])
            .collect();
        solve(&factors, &exchanged, &mut both, 2);
        for (k, column) in columns.into_iter().enumerate() {
            let mut one = column;
            solve(&factors, &exchanged, &mut one, 1);
            for (i, expected) in column.into_iter().enumerate() {
                let product: f64 = (0..3).map(|j| matrix[3 * i + j] * one[j]).sum();
                approx::assert_relative_eq!(product, expected, epsilon = 1e-14);
                approx::assert_relative_eq!(both[2 * i + k], one[i], epsilon = 1e-14);
            }
        }
    }

    #[test]
    fn derivatives_are_carried_through_zeros_too() {
        // [p 1; 1 p]·x = [1; 0]: x = [p; −1]/(p² − 1); at p = 0 the derivative is [−1; 0].
        let p = Dual::new(0.0, 1.0);
        let number = |value: f64| Dual::new(value, 0.0);
        let mut matrix = [p, number(1.0), number(1.0), p];
        let mut right = [number(1.0), number(0.0)];
        let mut exchanged = [0; 2];
        assert!(factorise(&mut matrix, &mut exchanged).is_regular());
        solve(&matrix, &exchanged, &mut right, 1);
        assert_eq!(right.map(|x| x.value), [0.0, 1.0]);
        assert_eq!(right.map(|x| x.derivative), [-1.0, 0.0]);
    }
}
