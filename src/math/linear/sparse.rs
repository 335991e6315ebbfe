//! A sparse linear system of fixed pattern: ordered and analysed once, then
//! factorised and solved any number of times without allocation.
//!
//! Pivots stay on the diagonal, as the matrices here are κ²·I − κ·J_v − J_u with
//! κ growing as the step shrinks: a pivot that has all but vanished asks for a
//! shorter step. The order of elimination is that of least degree, at equal
//! degree the last coordinate first: along a tree from its leaves, where nothing
//! fills in, so that the cost is linear in the number of masses.

use super::Entry;
use std::collections::BTreeSet;

/// A pivot below this share of the greatest entry of its row has cancelled.
const SMALLEST_PIVOT: f64 = 1e-12;

/// Rows of column indices, one row for each unknown, the diagonal among them.
pub(crate) type Rows = Vec<Vec<usize>>;

/// The factors L·U of a matrix of fixed pattern.
#[derive(Debug)]
pub(crate) struct SparseLu<E> {
    /// The unknown eliminated at each place.
    order: Vec<usize>,
    /// Beginning of each row in `columns` and `values`, by place; one more at the end.
    starts: Vec<usize>,
    /// Columns by place, ascending in each row.
    columns: Vec<usize>,
    /// Place of each row's diagonal entry.
    diagonal: Vec<usize>,
    /// Factors: L without its unit diagonal, then U with the reciprocals of its
    /// diagonal.
    values: Vec<E>,
    /// For every entry of the matrix, row by row of its pattern: its index in `values`.
    targets: Vec<usize>,
    /// Working memory of one row or one right-hand side, by place.
    row: Vec<E>,
}

impl<E: Entry> SparseLu<E> {
    /// Orders and analyses a pattern; every row contains its diagonal.
    pub(crate) fn new(pattern: &Rows) -> Self {
        let order = least_degree(pattern);
        let count = order.len();
        let mut place = vec![0; count];
        for (position, &unknown) in order.iter().enumerate() {
            place[unknown] = position;
        }
        let (mut starts, mut columns, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        for (position, &unknown) in order.iter().enumerate() {
            let mut row: BTreeSet<usize> = pattern[unknown].iter().map(|&c| place[c]).collect();
            row.insert(position);
            let mut next = row.first().copied();
            while let Some(pivot) = next.filter(|&pivot| pivot < position) {
                let above = diagonal[pivot] + 1..starts[pivot + 1];
                row.extend(&columns[above]);
                next = row.range(pivot + 1..).next().copied();
            }
            diagonal.push(starts[position] + row.range(..position).count());
            columns.extend(row);
            starts.push(columns.len());
        }
        let mut targets = Vec::new();
        for (unknown, row) in pattern.iter().enumerate() {
            let start = starts[place[unknown]];
            let end = starts[place[unknown] + 1];
            for &column in row {
                let found = columns[start..end].binary_search(&place[column]);
                targets.push(start + found.expect("the pattern is part of its factors"));
            }
        }
        Self {
            values: vec![E::ZERO; columns.len()],
            row: vec![E::ZERO; count],
            order,
            starts,
            columns,
            diagonal,
            targets,
        }
    }

    /// Factorises the matrix with the given entries, in the order of the
    /// pattern's rows. False when a pivot has vanished or is not a number.
    pub(crate) fn factorise(&mut self, entries: impl Iterator<Item = E>) -> bool {
        self.values.fill(E::ZERO);
        for (&target, entry) in self.targets.iter().zip(entries) {
            self.values[target] = self.values[target].plus(entry);
        }
        for position in 0..self.order.len() {
            let (start, end) = (self.starts[position], self.starts[position + 1]);
            let mut largest = E::ZERO;
            let here = self.columns[start..end]
                .iter()
                .zip(&self.values[start..end]);
            for (&column, &value) in here {
                largest = value.greatest(largest);
                self.row[column] = value;
            }
            for &pivot in &self.columns[start..self.diagonal[position]] {
                let diagonal = self.diagonal[pivot];
                let factor = self.row[pivot].times(self.values[diagonal]);
                self.row[pivot] = factor;
                let above = diagonal + 1..self.starts[pivot + 1];
                let above = self.columns[above.clone()].iter().zip(&self.values[above]);
                for (&column, &value) in above {
                    self.row[column] = self.row[column].less_product(factor, value);
                }
            }
            let here = self.columns[start..end].iter();
            for (&column, value) in here.zip(&mut self.values[start..end]) {
                *value = self.row[column];
            }
            let pivot = self.row[position];
            if !pivot.exceeds_share(SMALLEST_PIVOT, largest) {
                return false;
            }
            self.values[self.diagonal[position]] = pivot.reciprocal();
        }
        true
    }

    /// Solves for one right-hand side, in place.
    pub(crate) fn solve(&mut self, unknowns: &mut [E]) {
        let count = self.order.len();
        for position in 0..count {
            let lower = self.starts[position]..self.diagonal[position];
            let lower = self.columns[lower.clone()].iter().zip(&self.values[lower]);
            let mut rest = unknowns[self.order[position]];
            for (&column, &value) in lower {
                rest = rest.less_product(value, self.row[column]);
            }
            self.row[position] = rest;
        }
        for position in (0..count).rev() {
            let diagonal = self.diagonal[position];
            let upper = diagonal + 1..self.starts[position + 1];
            let upper = self.columns[upper.clone()].iter().zip(&self.values[upper]);
            let mut rest = self.row[position];
            for (&column, &value) in upper {
                rest = rest.less_product(value, self.row[column]);
            }
            let value = rest.times(self.values[diagonal]);
            self.row[position] = value;
            unknowns[self.order[position]] = value;
        }
    }

    /// Multiplications of one factorisation and of one solution.
    #[cfg(test)]
    pub(crate) fn operations(&self) -> [usize; 2] {
        let mut factorisation = 0;
        for position in 0..self.order.len() {
            for index in self.starts[position]..self.diagonal[position] {
                let pivot = self.columns[index];
                factorisation += self.starts[pivot + 1] - self.diagonal[pivot];
            }
        }
        [factorisation, self.columns.len()]
    }
}

/// Order of elimination by least degree in the pattern made symmetric; at equal
/// degree the last unknown first.
fn least_degree(pattern: &Rows) -> Vec<usize> {
    let count = pattern.len();
    let mut neighbours = vec![BTreeSet::new(); count];
    for (row, columns) in pattern.iter().enumerate() {
        for &column in columns.iter().filter(|&&column| column != row) {
            neighbours[row].insert(column);
            neighbours[column].insert(row);
        }
    }
    let key = |degree: usize, unknown: usize| (degree, count - unknown);
    let mut queue: BTreeSet<(usize, usize)> = (0..count)
        .map(|unknown| key(neighbours[unknown].len(), unknown))
        .collect();
    let mut order = Vec::with_capacity(count);
    while let Some((_, rest)) = queue.pop_first() {
        let unknown = count - rest;
        order.push(unknown);
        let around = std::mem::take(&mut neighbours[unknown]);
        for &one in &around {
            let before = neighbours[one].len();
            neighbours[one].remove(&unknown);
            // Rows that are full already are the many of a dense pattern.
            if neighbours[one].len() + 1 < queue.len() {
                neighbours[one].extend(around.iter().filter(|&&other| other != one));
            }
            queue.remove(&key(before, one));
            queue.insert(key(neighbours[one].len(), one));
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Entries of a well-conditioned matrix of a pattern, deterministic.
    fn entries(pattern: &Rows) -> Vec<f64> {
        let wave = |row: usize, column: usize| ((row * 31 + column * 17) as f64).sin();
        let rows = pattern.iter().enumerate();
        rows.flat_map(|(row, columns)| {
            columns.iter().map(move |&column| match row == column {
                true => 4.0 + columns.len() as f64,
                false => wave(row, column),
            })
        })
        .collect()
    }

    /// A chain behind a rotor: tridiagonal with full columns 0 and 1.
    fn arrow(count: usize) -> Rows {
        (0..count)
            .map(|row| {
                let near = row.saturating_sub(1)..(row + 2).min(count);
                let row: BTreeSet<usize> = near.chain([0, 1.min(count - 1)]).collect();
                row.into_iter().collect()
            })
            .collect()
    }

    fn full(count: usize) -> Rows {
        vec![(0..count).collect(); count]
    }

    /// Every third unknown hangs on unknown 0, the others on the one before.
    fn tree(count: usize) -> Rows {
        let mut rows: Vec<BTreeSet<usize>> = (0..count).map(|row| BTreeSet::from([row])).collect();
        for row in 1..count {
            let parent = if row % 3 == 0 { 0 } else { row - 1 };
            rows[row].insert(parent);
            rows[parent].insert(row);
        }
        rows.into_iter()
            .map(|row| row.into_iter().collect())
            .collect()
    }

    #[test]
    fn solutions_agree_with_a_dense_solver() {
        for pattern in [arrow(1), arrow(2), arrow(9), full(6), tree(20)] {
            let (count, entries) = (pattern.len(), entries(&pattern));
            let mut dense = DMatrix::zeros(count, count);
            let mut next = entries.iter();
            for (row, columns) in pattern.iter().enumerate() {
                for &column in columns {
                    dense[(row, column)] = *next.next().unwrap();
                }
            }
            let right = DVector::from_fn(count, |row, _| (row as f64 + 0.3).cos());
            let expected = dense.lu().solve(&right).unwrap();
            let mut lu = SparseLu::<f64>::new(&pattern);
            // Twice: the second time over what the first has left.
            for _ in 0..2 {
                assert!(lu.factorise(entries.iter().copied()));
                let mut found: Vec<f64> = right.iter().copied().collect();
                lu.solve(&mut found);
                for (a, b) in found.iter().zip(expected.iter()) {
                    approx::assert_abs_diff_eq!(a, b, epsilon = 1e-13);
                }
            }
        }
    }

    #[test]
    fn a_pivot_that_cancels_or_is_no_number_is_refused() {
        let mut lu = SparseLu::<f64>::new(&full(2));
        assert!(!lu.factorise([1.0, 2.0, 2.0, 4.0].into_iter()));
        assert!(!lu.factorise([1.0, f64::NAN, 2.0, 5.0].into_iter()));
        assert!(lu.factorise([1.0, 2.0, 2.0, 5.0].into_iter()));
    }

    #[test]
    fn trees_and_chains_behind_a_rotor_do_not_fill_and_cost_in_proportion() {
        for make in [arrow, tree] {
            let [small, great] = [make(10), make(1000)].map(|pattern| {
                let lu = SparseLu::<f64>::new(&pattern);
                let entries: usize = pattern.iter().map(Vec::len).sum();
                assert!(
                    lu.columns.len() <= entries,
                    "{} {entries}",
                    lu.columns.len()
                );
                lu.operations()
            });
            for (small, great) in small.into_iter().zip(great) {
                assert!(great <= 150 * small, "{small} {great}");
            }
        }
    }
}
