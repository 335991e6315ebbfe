//! The Jacobian of the accelerations, on its pattern, for the implicit methods.
//!
//! The order of the system is halved: of (κ·I − J)·[k_u; k_v] = [r_u; r_v] with
//! J = [0, I; J_u, J_v] remains (κ²·I − κ·J_v − J_u)·k_u = r_v + κ·r_u − J_v·r_u,
//! and k_v = κ·k_u − r_u.
//!
//! Coordinates whose columns have no row in common are differentiated together:
//! one product of the Jacobian with a vector gives them all (A. Curtis, M. Powell
//! and J. Reid, On the estimation of sparse Jacobian matrices, 1974). The products
//! are exact, so that the grouping costs no accuracy.

use crate::dynamics::integrate::{Dynamics, evaluator::Evaluator};
use crate::math::linear::{Entry, Rows};

/// Products that are asked for at a time.
const AT_A_TIME: usize = 8;

/// ∂a/∂u and ∂a/∂u′ of u″ = a(t, u, u′).
#[derive(Debug)]
pub(crate) struct Jacobian {
    /// Columns of each row, ascending, the diagonal among them.
    pub(crate) pattern: Rows,
    /// ∂a/∂u, row by row of the pattern.
    pub(crate) displacement: Vec<f64>,
    /// ∂a/∂u′, likewise.
    pub(crate) speed: Vec<f64>,
    /// Marks of the diagonal entries, row by row.
    diagonal: Vec<bool>,
    groups: Vec<Group>,
    /// Directions (2n each) and the accelerations' derivatives along them (n each).
    directions: Vec<f64>,
    products: Vec<f64>,
}

/// Columns that are differentiated together.
#[derive(Clone, Debug, Default)]
struct Group {
    columns: Vec<usize>,
    /// Their entries: which, and in which row.
    entries: Vec<[usize; 2]>,
}

impl Jacobian {
    /// Room for the Jacobian of a system.
    pub(crate) fn new<D: Dynamics>(dynamics: &D) -> Self {
        let mut pattern = dynamics.pattern();
        for (row, columns) in pattern.iter_mut().enumerate() {
            columns.push(row);
            columns.sort_unstable();
            columns.dedup();
        }
        let count = pattern.len();
        let group = grouping(&pattern);
        let mut groups = vec![Group::default(); group.iter().max().map_or(0, |most| most + 1)];
        for (column, &of) in group.iter().enumerate() {
            groups[of].columns.push(column);
        }
        let places = pattern.iter().enumerate();
        let places = places.flat_map(|(row, columns)| columns.iter().map(move |&c| (row, c)));
        let mut diagonal = Vec::new();
        for (entry, (row, column)) in places.enumerate() {
            diagonal.push(row == column);
            groups[group[column]].entries.push([entry, row]);
        }
        Self {
            displacement: vec![0.0; diagonal.len()],
            speed: vec![0.0; diagonal.len()],
            diagonal,
            groups,
            directions: vec![0.0; AT_A_TIME * 2 * count],
            products: vec![0.0; AT_A_TIME * count],
            pattern,
        }
    }

    /// Evaluates it at a state.
    pub(crate) fn evaluate<D: Dynamics>(
        &mut self,
        evaluator: &Evaluator<'_, D>,
        time: f64,
        y: &[f64],
    ) {
        let (count, groups) = (self.pattern.len(), self.groups.len());
        let all = 2 * groups;
        for first in (0..all).step_by(AT_A_TIME) {
            let some = first..all.min(first + AT_A_TIME);
            let directions = &mut self.directions[..some.len() * 2 * count];
            directions.fill(0.0);
            for (direction, index) in directions.chunks_exact_mut(2 * count).zip(some.clone()) {
                let half = index / groups * count;
                for column in &self.groups[index % groups].columns {
                    direction[half + column] = 1.0;
                }
            }
            let products = &mut self.products[..some.len() * count];
            evaluator.tangents(time, y, directions, products);
            for (product, index) in products.chunks_exact(count).zip(some) {
                let target =
                    [&mut self.displacement, &mut self.speed][index / groups].as_mut_slice();
                for &[entry, row] in &self.groups[index % groups].entries {
                    target[entry] = product[row];
                }
            }
        }
    }

    /// The entries of κ²·I − κ·J_v − J_u, row by row of the pattern.
    pub(crate) fn shifted<E: Entry>(
        &self,
        kappa: E,
        real: impl Fn(f64) -> E,
    ) -> impl Iterator<Item = E> {
        let square = kappa.times(kappa);
        let known = self.displacement.iter().zip(&self.speed);
        let known = self.diagonal.iter().zip(known);
        known.map(move |(&diagonal, (&stiffness, &damping))| {
            let own = if diagonal { square } else { E::ZERO };
            let rest = own.less_product(kappa, real(damping));
            rest.plus(real(-stiffness))
        })
    }

    /// J_v times a vector, row by row.
    pub(crate) fn damping_times(&self, vector: &[f64]) -> impl Iterator<Item = f64> {
        let mut next = 0;
        self.pattern.iter().map(move |columns| {
            let row = &self.speed[next..next + columns.len()];
            next += columns.len();
            row.iter().zip(columns).map(|(d, &c)| d * vector[c]).sum()
        })
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
