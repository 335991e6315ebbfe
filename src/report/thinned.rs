//! Records with more samples than a page can hold.

use crate::dynamics::record::{Column, Record};

/// Most samples that a page draws: more than any screen has pixels, of all curves together.
const MOST: usize = 40_000;

/// The record with closeups among its samples, without those that no chart would show apart: of every
/// stretch the first sample stays, and those with the least and the greatest value of each column.
pub(in crate::report) fn drawn(record: &Record) -> Record {
    thinned(record.merged(), MOST)
}

fn thinned(mut record: Record, most: usize) -> Record {
    let samples = record.times.len();
    let stretches = most / (2 * record.columns.len() + 1);
    if samples <= most || stretches == 0 {
        return record;
    }
    let coarse = telling(&record, stretches);
    // Most often the extremes of several columns fall together, and there is room for more.
    let fine = telling(&record, stretches * most / coarse.len());
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
    use super::{MOST, thinned};
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
        let thin = thinned(given.clone(), MOST);
        assert!((MOST / 2..=MOST).contains(&thin.times.len()));
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
}
