//! Least and greatest values, located between the rows.

use super::ask::Asked;
use super::columns;
use super::{Column, Extremes};
use crate::linkage::Workspace;

/// Steps of the golden section: the bracket shrinks by 1e-8, at which values
/// near an extreme differ by rounding only.
const STEPS: usize = 40;
/// (√5 − 1)/2.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Extremes of every column over the places of its rows.
pub(super) fn extremes(asked: &Asked<'_>, places: &[f64], columns: &[Column]) -> Vec<Extremes> {
    let mut seeker = Seeker {
        asked,
        work: asked.linkage.workspace(),
        values: Vec::new(),
    };
    let mut all = Vec::with_capacity(columns.len());
    for (index, column) in columns.iter().enumerate() {
        let mut find = |sign: f64| {
            let best = greatest_row(&column.values, sign);
            best.map_or((f64::NAN, f64::NAN), |row| {
                // Between rows that are not all determined, nothing is looked for.
                if column.undetermined > 0 {
                    return (places[row], column.values[row]);
                }
                let mut at = |place: f64| seeker.at(place, index);
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

struct Seeker<'q, 'a> {
    asked: &'q Asked<'a>,
    work: Workspace,
    values: Vec<f64>,
}

impl Seeker<'_, '_> {
    /// The value of a column at a place.
    fn at(&mut self, place: f64, column: usize) -> f64 {
        let q = self.asked.input_at(place);
        if self
            .asked
            .linkage
            .solve(q.value, 3, &mut self.work)
            .is_err()
        {
            return f64::NAN;
        }
        columns::values(self.asked, &self.work, q, &mut self.values);
        self.values[column]
    }
}

/// The extreme of sign·value next to a row, between its neighbours, by golden
/// section.
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
    let (mut low, mut high) = (places[before], *after);
    let mut best = found;
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut worth = inner.map(|place| sign * at(place));
    for _ in 0..STEPS {
        for (place, worth) in inner.iter().zip(worth) {
            if worth > sign * best.1 {
                best = (*place, sign * worth);
            }
        }
        if worth[0] > worth[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            worth = [sign * at(inner[0]), worth[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            worth = [worth[1], sign * at(inner[1])];
        }
    }
    best
}
