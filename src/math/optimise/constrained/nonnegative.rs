//! Least squares with unknowns that are not negative (Lawson & Hanson 1974, chapter 23).

use nalgebra::{DMatrix, DVector};

/// Share of the greatest entry below which a slope of the residual counts as none.
const NOTHING: f64 = 1e-12;

/// The unknowns x ≥ 0 with the least |A·x − b|. Columns that hardly count stay zero.
pub(super) fn nonnegative(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let count = a.ncols();
    let mut x = DVector::zeros(count);
    let mut free = vec![false; count];
    let size = a.amax() * b.amax().max(f64::MIN_POSITIVE);
    for _ in 0..3 * count {
        let slopes = a.transpose() * (b - a * &x);
        let bound = (0..count).filter(|&at| !free[at] && slopes[at] > NOTHING * size);
        let Some(best) = bound.max_by(|&one, &other| slopes[one].total_cmp(&slopes[other])) else {
            break;
        };
        free[best] = true;
        while let Some(found) = of_free(a, b, &free) {
            if (0..count).all(|at| !free[at] || found[at] > 0.0) {
                x = found;
                break;
            }
            // As far towards it as no unknown becomes negative.
            let shares = (0..count)
                .filter(|&at| free[at] && found[at] <= 0.0)
                .map(|at| x[at] / (x[at] - found[at]).max(f64::MIN_POSITIVE));
            let share = shares.fold(1.0, f64::min);
            x = &x + (found - &x) * share;
            let before = free.iter().filter(|free| **free).count();
            for at in 0..count {
                if free[at] && x[at] <= 1e-15 {
                    (free[at], x[at]) = (false, 0.0);
                }
            }
            if free.iter().filter(|free| **free).count() == before {
                break;
            }
        }
    }
    x
}

/// Least squares in the unknowns that are free; the others are zero.
fn of_free(a: &DMatrix<f64>, b: &DVector<f64>, free: &[bool]) -> Option<DVector<f64>> {
    let columns: Vec<usize> = (0..free.len()).filter(|&at| free[at]).collect();
    if columns.is_empty() {
        return None;
    }
    let part = a.select_columns(&columns);
    let found = part.svd(true, true).solve(b, 1e-13).ok()?;
    let mut all = DVector::zeros(free.len());
    for (at, value) in columns.into_iter().zip(found.iter()) {
        all[at] = *value;
    }
    Some(all)
}
