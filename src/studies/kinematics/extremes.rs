//! Least and greatest values, located between the rows.

use super::{Column, Extremes};
use crate::math::optimise::{Peak, brent};
use crate::studies::endless::unbounded;

/// Part of the bracket to which an extreme is located: values nearer to it differ by rounding
/// only.
const LOCATED: f64 = 1e-9;

/// A dead-centre position at which the rows end, with the values of all columns ever nearer to it; not
/// a number where they are not determined.
pub(super) struct Edge {
    pub(super) at: f64,
    pub(super) rows: [Vec<f64>; 4],
}

impl Edge {
    /// True where sign times a column grows without bound.
    pub(super) fn is_endless(&self, column: usize, sign: f64) -> bool {
        unbounded(&self.rows.each_ref().map(|row| sign * row[column]))
    }
}

/// Extremes of every column over the places of its rows; `at`: the value of a column at a
/// place beside a row.
pub(super) fn extremes(
    places: &[f64],
    columns: &[Column],
    edges: &[Edge],
    at: &mut dyn FnMut(f64, usize, usize) -> f64,
) -> Vec<Extremes> {
    let mut all = Vec::with_capacity(columns.len());
    for (index, column) in columns.iter().enumerate() {
        let mut find = |sign: f64| {
            let mut ends = edges.iter();
            if let Some(edge) = ends.find(|edge| edge.is_endless(index, sign)) {
                return (edge.at, sign * f64::INFINITY);
            }
            let best = greatest_row(&column.values, sign);
            best.map_or((f64::NAN, f64::NAN), |row| {
                // Between rows that are not all determined, nothing is looked for.
                if column.undetermined > 0 || is_level(column) {
                    return (places[row], column.values[row]);
                }
                let mut at = |place: f64| at(place, row, index);
                located(places, &column.values, row, sign, &mut at)
            })
        };
        all.push(Extremes {
            least: find(-1.0),
            greatest: find(1.0),
        });
    }
    all
}

/// True for a column in which nothing changes but rounding.
fn is_level(column: &Column) -> bool {
    let ends = column
        .values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
            [low.min(v), high.max(v)]
        });
    ends[1] - ends[0] <= column.error
}

/// The first row at which sign·value is greatest.
pub(super) fn greatest_row(values: &[f64], sign: f64) -> Option<usize> {
    let mut best: Option<usize> = None;
    for (row, value) in values.iter().enumerate() {
        let better = best.is_none_or(|best| sign * value > sign * values[best]);
        if value.is_finite() && better {
            best = Some(row);
        }
    }
    best
}

/// The extreme of sign·value next to a row, between its neighbours, by Brent's method.
pub(super) fn located(
    places: &[f64],
    values: &[f64],
    row: usize,
    sign: f64,
    at: &mut dyn FnMut(f64) -> f64,
) -> (f64, f64) {
    let found = (places[row], values[row]);
    let (Some(before), Some(after)) = (row.checked_sub(1), places.get(row + 1)) else {
        return found;
    };
    let flat = |other: f64| (other - found.1).abs() <= 1e-13 * found.1.abs();
    if flat(values[before]) && flat(values[row + 1]) {
        return found;
    }
    let ends = [places[before].min(*after), places[before].max(*after)];
    let mut worth = |place: f64| {
        let value = sign * at(place);
        if value.is_nan() {
            f64::NEG_INFINITY
        } else {
            value
        }
    };
    let start = Peak {
        value: sign * found.1,
        at: found.0,
    };
    let best = brent(start, ends, LOCATED, &mut worth);
    (best.at, sign * best.value)
}

#[cfg(test)]
mod tests {
    use super::located;

    #[test]
    fn extremes_between_rows_are_located_in_few_evaluations() {
        type Case = (fn(f64) -> f64, f64);
        let cases: [Case; 3] = [
            (|x| -(x - 0.3) * (x - 0.3), 0.3),
            (|x| (x - 0.2).cos() + 0.1 * x, 0.2 + 0.1f64.asin()),
            // With a kink nothing but sections help.
            (|x| -(x - 0.37).abs(), 0.37),
        ];
        for (f, wanted) in cases {
            for sign in [1.0, -1.0] {
                let places = [-1.0, 0.0, 1.0];
                let values = places.map(|x| sign * f(x));
                let mut count = 0;
                let mut at = |x: f64| {
                    count += 1;
                    sign * f(x)
                };
                let (place, value) = located(&places, &values, 1, sign, &mut at);
                assert!((place - wanted).abs() < 3e-8, "{place} {wanted}");
                assert!((sign * value - f(wanted)).abs() < 3e-8);
                assert!(count <= 60);
            }
        }
        let mut count = 0;
        let places = [1.0, 0.0, -1.0];
        let mut smooth = |x: f64| {
            count += 1;
            (x - 0.2).cos()
        };
        let values = places.map(|x: f64| (x - 0.2).cos());
        let (place, _) = located(&places, &values, 1, 1.0, &mut smooth);
        assert!((place - 0.2).abs() < 3e-8, "downwards too: {place}");
        assert!(count <= 25, "{count} evaluations");
    }
}
