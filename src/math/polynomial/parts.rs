//! Parts of polynomials in Bernstein form, by de Casteljau's scheme.

/// Coefficients of the part before a share of the interval into `left`; those
/// of the part after it stay in `rest`. Both of the same degree.
pub fn divide(left: &mut [f64], rest: &mut [f64], share: f64) {
    let degree = rest.len() - 1;
    for (level, left) in left.iter_mut().enumerate() {
        *left = rest[0];
        for k in 0..degree - level {
            rest[k] += share * (rest[k + 1] - rest[k]);
        }
    }
}

/// The same in the middle, where a mean is one operation less and exact for
/// coefficients of opposite signs.
pub fn halve(left: &mut [f64], rest: &mut [f64]) {
    let degree = rest.len() - 1;
    for (level, left) in left.iter_mut().enumerate() {
        *left = rest[0];
        for k in 0..degree - level {
            rest[k] = 0.5 * (rest[k] + rest[k + 1]);
        }
    }
}

/// Raises a polynomial, the first `from` + 1 coefficients of the row, to the
/// degree of the whole row.
pub fn raise(row: &mut [f64], from: usize) {
    for degree in from..row.len() - 1 {
        let last = row[degree];
        for i in (1..=degree).rev() {
            let share = i as f64 / (degree + 1) as f64;
            row[i] = share * row[i - 1] + (1.0 - share) * row[i];
        }
        row[degree + 1] = last;
    }
}

#[cfg(test)]
mod tests {
    use super::{divide, halve, raise};
    use crate::math::polynomial::evaluate;

    const ROW: [f64; 6] = [1.0, -2.0, 0.5, 3.0, 0.0, 4.0];

    #[test]
    fn parts_are_the_polynomial_again() {
        let share = 0.3;
        let (mut left, mut rest) = ([0.0; 6], ROW);
        divide(&mut left, &mut rest, share);
        for s in [0.0, 0.2, 0.7, 1.0] {
            let before = evaluate(&ROW, share * s).0;
            let after = evaluate(&ROW, share + (1.0 - share) * s).0;
            approx::assert_abs_diff_eq!(evaluate(&left, s).0, before, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(evaluate(&rest, s).0, after, epsilon = 1e-14);
        }
        let (mut first, mut second) = ([0.0; 6], ROW);
        halve(&mut first, &mut second);
        let (mut left, mut rest) = ([0.0; 6], ROW);
        divide(&mut left, &mut rest, 0.5);
        for (a, b) in first.iter().chain(&second).zip(left.iter().chain(&rest)) {
            approx::assert_abs_diff_eq!(a, b, epsilon = 1e-15);
        }
    }

    #[test]
    fn a_raised_polynomial_is_the_same() {
        let mut row = [0.0; 16];
        row[..6].copy_from_slice(&ROW);
        raise(&mut row, 5);
        for s in [0.0, 0.2, 0.7, 1.0] {
            let expected = evaluate(&ROW, s).0;
            approx::assert_abs_diff_eq!(evaluate(&row, s).0, expected, epsilon = 1e-14);
        }
    }
}
