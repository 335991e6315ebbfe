//! The Jacobian of the accelerations, on its pattern.
//!
//! Coordinates whose columns have no row in common are differentiated together:
//! one product of the Jacobian with a vector gives them all (A. Curtis, M. Powell
//! and J. Reid, On the estimation of sparse Jacobian matrices, 1974). The products
//! are exact, so that the grouping costs no accuracy.

use super::sparse::Rows;
use crate::integrate::{Dynamics, evaluator::Evaluator};

/// ∂a/∂u and ∂a/∂u′ of u″ = a(t, u, u′), and ∂a/∂t.
#[derive(Debug)]
pub(super) struct Jacobian {
    /// Columns of each row, ascending, the diagonal among them.
    pub(super) pattern: Rows,
    /// ∂a/∂u, row by row of the pattern.
    pub(super) displacement: Vec<f64>,
    /// ∂a/∂u′, likewise.
    pub(super) speed: Vec<f64>,
    /// ∂a/∂t.
    pub(super) time: Vec<f64>,
    /// The group of each coordinate.
    group: Vec<usize>,
    groups: usize,
    direction: Vec<f64>,
    product: Vec<f64>,
}

impl Jacobian {
    /// Room for the Jacobian of a system.
    pub(super) fn new<D: Dynamics>(dynamics: &D) -> Self {
        let mut pattern = dynamics.pattern();
        for (row, columns) in pattern.iter_mut().enumerate() {
            columns.push(row);
            columns.sort_unstable();
            columns.dedup();
        }
        let count = pattern.len();
        let entries = pattern.iter().map(Vec::len).sum();
        let group = grouping(&pattern);
        Self {
            displacement: vec![0.0; entries],
            speed: vec![0.0; entries],
            time: vec![0.0; count],
            groups: group.iter().max().map_or(0, |greatest| greatest + 1),
            group,
            direction: vec![0.0; 2 * count],
            product: vec![0.0; 2 * count],
            pattern,
        }
    }

    /// Evaluates it at a state.
    pub(super) fn evaluate<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        time: f64,
        y: &[f64],
    ) {
        let count = self.pattern.len();
        for half in 0..2 {
            for group in 0..self.groups {
                for (coordinate, &of) in self.group.iter().enumerate() {
                    self.direction[half * count + coordinate] = f64::from(u8::from(of == group));
                }
                evaluator.tangent(time, y, &self.direction, &mut self.product);
                let entries = [&mut self.displacement, &mut self.speed][half].iter_mut();
                let places = self.pattern.iter().enumerate();
                let places =
                    places.flat_map(|(row, columns)| columns.iter().map(move |c| (row, c)));
                for (entry, (row, &column)) in entries.zip(places) {
                    if self.group[column] == group {
                        *entry = self.product[count + row];
                    }
                }
            }
            self.direction[half * count..(half + 1) * count].fill(0.0);
        }
        evaluator.time_tangent(time, y, &mut self.product);
        self.time.copy_from_slice(&self.product[count..]);
    }
}

/// Groups of columns without a common row: each column into the first group
/// that none of its rows has met.
fn grouping(pattern: &Rows) -> Vec<usize> {
    let count = pattern.len();
    let mut rows_of: Rows = vec![Vec::new(); count];
    for (row, columns) in pattern.iter().enumerate() {
        for &column in columns {
            rows_of[column].push(row);
        }
    }
    let mut met: Vec<Vec<bool>> = vec![Vec::new(); count];
    let mut group = vec![0; count];
    for column in 0..count {
        let taken = |one: usize| {
            let met = |row: &usize| met[*row].get(one).copied().unwrap_or(false);
            rows_of[column].iter().any(met)
        };
        let first = (0..).find(|&one| !taken(one)).unwrap_or(0);
        group[column] = first;
        for &row in &rows_of[column] {
            if met[row].len() <= first {
                met[row].resize(first + 1, false);
            }
            met[row][first] = true;
        }
    }
    group
}

#[cfg(test)]
mod tests {
    use super::grouping;

    #[test]
    fn a_chain_needs_three_groups_and_a_full_pattern_one_for_each_column() {
        let chain: Vec<Vec<usize>> = (0..50usize)
            .map(|row| (row.saturating_sub(1)..(row + 2).min(50)).collect())
            .collect();
        assert_eq!(grouping(&chain).iter().max(), Some(&2));
        let full = vec![(0..7).collect::<Vec<usize>>(); 7];
        assert_eq!(grouping(&full), (0..7).collect::<Vec<_>>());
        for (pattern, group) in [(&chain, grouping(&chain)), (&full, grouping(&full))] {
            for columns in pattern {
                let mut seen: Vec<usize> = columns.iter().map(|&c| group[c]).collect();
                seen.sort_unstable();
                seen.dedup();
                assert_eq!(seen.len(), columns.len());
            }
        }
    }
}
