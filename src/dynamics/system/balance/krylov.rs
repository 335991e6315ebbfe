//! The step of Newton's method for many coordinates, without a matrix.
//!
//! But for loads that change with the place, the deflections of a chain are sums:
//! the matrix is D, with u_m − u_{m−1} in its rows. What loads add is of a rank as
//! low as their number, so that of D⁻¹·J little else than 1 is left, and GMRES
//! (Y. Saad and M. Schultz, GMRES: a generalized minimal residual algorithm, 1986)
//! ends after about as many products with J as there are such loads. The products
//! are exact derivatives.

use super::{Balance, MANY};
use crate::dynamics::system::frozen::{Frozen, Step};
use crate::dynamics::system::passes::Work;
use crate::math::number::Dual;
use nalgebra::{DMatrix, DVector};

/// Most products with J: the dense matrix takes not many more where they do not do.
const PRODUCTS: usize = 2 * MANY;

/// A residual of this share of the right-hand side is rounding.
const RESIDUAL_ROUNDING: f64 = 1e-14;

/// The greatest share at which a step counts as found.
const FOUND: f64 = 1e-11;

impl Frozen {
    /// Solves (∂miss/∂u)·step = miss; `None` where that does not come to its end soon.
    pub(super) fn krylov_step(
        &self,
        kind: Balance,
        state: &[f64],
        modes: &[i64],
        miss: &[f64],
    ) -> Option<DVector<f64>> {
        let n = self.coordinates;
        let mut work = Work::new(self);
        let mut point: Vec<Dual> = state.iter().map(|&value| Dual::from(value)).collect();
        let mut column = vec![Dual::default(); n];
        let mut product = |direction: &DVector<f64>| {
            for (entry, &derivative) in point.iter_mut().zip(direction) {
                entry.derivative = derivative;
            }
            // A rotor's angle is given.
            self.rotors(|c| point[c].derivative = 0.0);
            self.imbalance(kind, Dual::from(0.0), &point, modes, &mut work, &mut column);
            let mut image = DVector::from_fn(n, |i, _| column[i].derivative);
            self.rotors(|c| image[c] = direction[c]);
            self.sum_up(&mut image);
            image
        };
        let mut right = DVector::from_column_slice(miss);
        self.sum_up(&mut right);
        let step = gmres(&mut product, &right)?;
        let scale = safe_divisor(&right);
        let residual = ((product(&step) - &right) / scale).norm();
        (residual <= FOUND * (right / scale).norm()).then_some(step)
    }

    /// D⁻¹ times a vector, in its place.
    fn sum_up(&self, vector: &mut DVector<f64>) {
        for chain in &self.chains {
            for c in chain.coordinates().skip(1) {
                vector[c] += vector[c - 1];
            }
        }
    }

    fn rotors(&self, mut each: impl FnMut(usize)) {
        for step in &self.steps {
            if let Step::Rotor(rotor) = step {
                each(rotor.coordinate);
            }
        }
    }
}

/// What a vector is divided by so that the square of its length does not overflow.
fn safe_divisor(vector: &DVector<f64>) -> f64 {
    match vector.norm().is_finite() {
        true => 1.0,
        false => vector.amax(),
    }
}

/// x with the least |product(x) − right| among the combinations of the powers of the
/// product, as far as rounding allows. `None`: not within [`PRODUCTS`], or not finite.
fn gmres(
    product: &mut impl FnMut(&DVector<f64>) -> DVector<f64>,
    right: &DVector<f64>,
) -> Option<DVector<f64>> {
    let scale = safe_divisor(right);
    let right = right / scale;
    let size = right.norm();
    if size == 0.0 {
        return Some(right);
    }
    let mut basis = vec![&right / size];
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for count in 1..=PRODUCTS {
        let mut next = product(&basis[count - 1]);
        let whole = next.norm();
        let mut column = vec![0.0; count + 1];
        // Twice, so that rounding leaves the basis orthogonal.
        for _ in 0..2 {
            for (known, entry) in basis.iter().zip(&mut column) {
                let share = known.dot(&next);
                next.axpy(-share, known, 1.0);
                *entry += share;
            }
        }
        let rest = next.norm();
        if !rest.is_finite() {
            return None;
        }
        column[count] = rest;
        rows.push(column);
        let (weights, miss) = least_squares(&rows, size)?;
        let exhausted = rest <= RESIDUAL_ROUNDING * whole;
        if exhausted || miss <= RESIDUAL_ROUNDING * size {
            let mut found = DVector::zeros(right.len());
            for (known, weight) in basis.iter().zip(&weights) {
                found.axpy(*weight, known, 1.0);
            }
            return Some(found * scale);
        }
        basis.push(next / rest);
    }
    None
}

/// The weights y with the least |size·e₁ − H·y|, and that, H given by its columns.
fn least_squares(columns: &[Vec<f64>], size: f64) -> Option<(Vec<f64>, f64)> {
    let count = columns.len();
    let entry = |i: usize, j: usize| columns[j].get(i).copied().unwrap_or(0.0);
    let hessenberg = DMatrix::from_fn(count + 1, count, entry);
    let mut right = DVector::zeros(count + 1);
    right[0] = size;
    let parts = hessenberg.clone().qr();
    let projected = parts.q().transpose() * &right;
    let weights = parts.r().solve_upper_triangular(&projected)?;
    let miss = (right - hessenberg * &weights).norm();
    Some((weights.as_slice().to_vec(), miss))
}

#[cfg(test)]
mod tests {
    use super::gmres;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn the_unit_matrix_with_a_few_changes_is_solved_by_a_few_products() {
        let n = 200;
        let wave = |i: usize, k: usize| ((i * (k + 3)) as f64 * 0.7 + 0.2).sin();
        let right = DVector::from_fn(n, |i, _| wave(i, 9));
        for rank in [0, 1, 5] {
            let mut matrix = DMatrix::identity(n, n);
            for k in 0..rank {
                let (a, b) = (
                    DVector::from_fn(n, |i, _| wave(i, k)),
                    DVector::from_fn(n, |i, _| wave(i, k + 20)),
                );
                matrix += a * b.transpose() * 0.1;
            }
            let mut products = 0;
            let found = gmres(
                &mut |x| {
                    products += 1;
                    &matrix * x
                },
                &right,
            );
            let expected = matrix.clone().lu().solve(&right).unwrap();
            assert!((found.unwrap() - &expected).norm() <= 1e-12 * expected.norm());
            assert!(products <= rank + 2, "{products} for rank {rank}");
            // Numbers whose squares overflow are no others.
            let great = gmres(&mut |x| &matrix * x, &(&right * 1e300)).unwrap();
            assert!((great / 1e300 - &expected).norm() <= 1e-12 * expected.norm());
        }
        // Beyond that there is the dense way.
        let many = DMatrix::from_fn(n, n, wave);
        assert_eq!(gmres(&mut |x| &many * x, &right), None);
        assert_eq!(gmres(&mut |x| x * f64::NAN, &right), None);
    }
}
