//! Systems with three diagonals, and those that wrap round.

/// Solves a tridiagonal, diagonally dominant system (Thomas).
pub(crate) fn tridiagonal(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    mut right: Vec<f64>,
) -> Vec<f64> {
    let count = diagonal.len();
    let mut factor = vec![0.0; count];
    let mut pivot = diagonal[0];
    right[0] /= pivot;
    for i in 1..count {
        factor[i] = upper[i - 1] / pivot;
        pivot = diagonal[i] - lower[i] * factor[i];
        right[i] = (right[i] - lower[i] * right[i - 1]) / pivot;
    }
    for i in (0..count - 1).rev() {
        right[i] -= factor[i + 1] * right[i + 1];
    }
    right
}

/// Solves a symmetric cyclic system of at least two unknowns, as periodic splines have:
/// row i has `steps[i − 1]`, `diagonal[i]`, `steps[i]`, wrapping round; the wrapped entries are a correction of rank one (Sherman–Morrison).
pub(crate) fn cyclic(steps: &[f64], diagonal: &[f64], right: Vec<f64>) -> Vec<f64> {
    let count = diagonal.len();
    let corner = steps[count - 1];
    let gamma = -diagonal[0];
    let mut changed = diagonal.to_vec();
    changed[0] -= gamma;
    changed[count - 1] -= corner * corner / gamma;
    let mut lower = vec![0.0; count];
    lower[1..].copy_from_slice(&steps[..count - 1]);
    let mut direction = vec![0.0; count];
    direction[0] = gamma;
    direction[count - 1] = corner;
    let solution = tridiagonal(&lower, &changed, steps, right);
    let correction = tridiagonal(&lower, &changed, steps, direction);
    let project = |v: &[f64]| v[0] + corner / gamma * v[count - 1];
    let share = project(&solution) / (1.0 + project(&correction));
    solution
        .iter()
        .zip(&correction)
        .map(|(x, z)| x - share * z)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{cyclic, tridiagonal};

    #[test]
    fn both_agree_with_their_equations() {
        let (lower, upper) = ([0.0, 1.0, -0.5, 0.2], [0.7, -1.0, 0.3, 0.0]);
        let (diagonal, right) = ([3.0, 4.0, -5.0, 2.0], [1.0, -2.0, 0.5, 3.0]);
        let x = tridiagonal(&lower, &diagonal, &upper, right.to_vec());
        for i in 0..4 {
            let before = if i > 0 { lower[i] * x[i - 1] } else { 0.0 };
            let after = if i < 3 { upper[i] * x[i + 1] } else { 0.0 };
            let sum = before + diagonal[i] * x[i] + after;
            approx::assert_relative_eq!(sum, right[i], max_relative = 1e-14);
        }
        let steps = [0.7, 1.0, 0.3, 0.9];
        let x = cyclic(&steps, &[4.0, 5.0, 3.0, 4.0], right.to_vec());
        for (i, diagonal) in [4.0, 5.0, 3.0, 4.0].into_iter().enumerate() {
            let sum =
                steps[(i + 3) % 4] * x[(i + 3) % 4] + diagonal * x[i] + steps[i] * x[(i + 1) % 4];
            approx::assert_relative_eq!(sum, right[i], max_relative = 1e-14);
        }
    }
}
