//! Records with more samples than a page can hold.

use crate::dynamics::record::{Column, Quantity, Record};

/// Most numbers of a page, of all curves together: more than any screen has pixels.
const MOST: usize = 200_000;

/// Samples that a page draws in any case.
const LEAST: usize = 400;

/// Most columns of which a page has charts.
const MOST_COLUMNS: usize = 300;

/// The record of a page: with closeups among its samples, without what no chart would show apart.
#[derive(Debug)]
pub(in crate::report) struct PageRecord {
    pub(in crate::report) record: Record,
    /// Columns that have no chart.
    pub(in crate::report) left_out: usize,
}

/// The record with closeups among its samples. Of every stretch the first sample stays, and those
/// with the least and the greatest value of each column; columns of masses and links are left out
/// where there are very many.
pub(in crate::report) fn record_to_draw(record: &Record) -> PageRecord {
    let mut record = record.with_closeups();
    let left_out = leave_out_columns(&mut record, MOST_COLUMNS);
    let most = (MOST / (record.columns.len() + 1)).max(LEAST);
    PageRecord {
        record: thinned(record, most),
        left_out,
    }
}

/// Leaves out columns beyond so many: first those of masses and links, then all but the
/// displacements and deviations of objects; how many.
fn leave_out_columns(record: &mut Record, most: usize) -> usize {
    let all = record.columns.len();
    if all <= most {
        return 0;
    }
    let rank = |column: &Column| match column.quantity {
        Quantity::Displacement => 0,
        Quantity::Delta => 1,
        Quantity::Speed
        | Quantity::Acceleration
        | Quantity::Reaction
        | Quantity::ContactForce
        | Quantity::ContactPressure => 2,
        Quantity::MassDisplacement(_) | Quantity::MassSpeed(_) | Quantity::LinkForce(_) => 3,
    };
    let mut order: Vec<usize> = (0..all).collect();
    order.sort_by_key(|&index| rank(&record.columns[index]));
    order.truncate(most);
    order.sort_unstable();
    record.columns = order
        .iter()
        .map(|&index| record.columns[index].clone())
        .collect();
    all - most
}

fn thinned(mut record: Record, most: usize) -> Record {
    let samples = record.times.len();
    if samples <= most {
        return record;
    }
    let stretches = (most / (2 * record.columns.len() + 1)).max(1);
    let coarse = telling(&record, stretches);
    // Most often the extremes of several columns fall together, and there is room for more.
    let fine = telling(&record, (stretches * most / coarse.len()).max(1));
    let kept = if fine.len() <= most { fine } else { coarse };
    let rows = |values: &[f64]| kept.iter().map(|&row| values[row]).collect();
    record.times = rows(&record.times);
    let thin = |column: &Column| Column {
        values: rows(&column.values),
        ..column.clone()
    };
    record.columns = record.columns.iter().map(thin).collect();
    record
}

/// The rows that tell each of so many stretches, ascending.
fn telling(record: &Record, stretches: usize) -> Vec<usize> {
    let samples = record.times.len();
    let length = samples.div_ceil(stretches);
    let mut kept = Vec::new();
    for from in (0..samples).step_by(length) {
        let stretch = from..samples.min(from + length);
        kept.extend([from, stretch.end - 1]);
        for column in &record.columns {
            let values = &column.values[stretch.clone()];
            kept.extend(extremes(values).into_iter().flatten().map(|row| from + row));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// The places of the least and of the greatest value; of one that is no number in their place.
fn extremes(values: &[f64]) -> [Option<usize>; 2] {
    let places = || values.iter().copied().enumerate();
    let place = |found: Option<(usize, f64)>| found.map(|(place, _)| place);
    [
        place(places().min_by(|one, other| one.1.total_cmp(&other.1))),
        place(places().max_by(|one, other| one.1.total_cmp(&other.1))),
    ]
}

#[cfg(test)]
mod tests {
    use super::{LEAST, MOST, MOST_COLUMNS, record_to_draw, thinned};
    use crate::dynamics::record::{Column, Quantity, Record};

    fn record(samples: usize) -> Record {
        let wave = |factor: f64| Column {
            object: "lever".to_owned(),
            quantity: Quantity::Displacement,
            unit: "rad",
            values: (0..samples).map(|k| (factor * k as f64).sin()).collect(),
        };
        let mut columns = vec![wave(0.1), wave(0.037)];
        columns[1].values[samples / 3] = 7.0;
        columns[0].values[samples / 2] = f64::NAN;
        Record {
            times: (0..samples).map(|k| k as f64 * 1e-3).collect(),
            columns,
            ..Record::default()
        }
    }

    #[test]
    fn what_fits_stays_as_it_is() {
        let given = record(300);
        assert_eq!(thinned(given.clone(), 400).times, given.times);
    }

    #[test]
    fn peaks_gaps_and_ends_stay() {
        let samples = 200_000;
        let given = record(samples);
        let thin = record_to_draw(&given).record;
        let most = MOST / 3;
        assert!((most / 2..=most).contains(&thin.times.len()));
        assert!(thin.times.is_sorted());
        assert!(
            thin.columns
                .iter()
                .all(|column| column.values.len() == thin.times.len())
        );
        assert_eq!(thin.times.last(), given.times.last());
        assert_eq!(thin.times.first(), given.times.first());
        assert!(thin.columns[1].values.contains(&7.0));
        assert!(thin.columns[0].values.iter().any(|value| value.is_nan()));
    }
    #[test]
    fn a_page_has_a_bounded_number_of_values() {
        let mut given = record(3000);
        for mass in 1..=500 {
            let mut own = given.columns[0].clone();
            own.quantity = Quantity::MassSpeed(mass);
            given.columns.push(own);
        }
        let thin = record_to_draw(&given);
        assert_eq!(thin.left_out, 502 - MOST_COLUMNS);
        assert_eq!(thin.record.columns.len(), MOST_COLUMNS);
        // The object's own columns stay, in their places.
        assert_eq!(thin.record.columns[1].quantity, Quantity::Displacement);
        let rows = thin.record.times.len();
        assert!(
            rows * (MOST_COLUMNS + 1) <= MOST.max(LEAST * (MOST_COLUMNS + 1)),
            "{rows}"
        );
    }
}
