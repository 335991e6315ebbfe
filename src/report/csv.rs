//! Tables as CSV: the samples of a record, the figures of a comparison.

use crate::dynamics::record::Record;
use crate::studies::compare::Table;

/// The record as CSV (RFC 4180, UTF-8): a header `time [s],rocker.displacement [rad],…`
/// and a row a sample. Every number is the shortest that reads back as the same
/// double, so that nothing is lost.
///
/// # Errors
/// The columns are not all as long as the times.
pub fn record_csv(record: &Record) -> Result<String, csv::Error> {
    let header = record
        .columns
        .iter()
        .map(|column| format!("{}.{} [{}]", column.object, column.quantity, column.unit));
    let rows = record.times.iter().enumerate().map(|(row, time)| {
        let values = record
            .columns
            .iter()
            .filter_map(move |column| column.values.get(row).copied());
        std::iter::once(*time).chain(values).map(number)
    });
    write(
        std::iter::once("time [s]".to_owned()).chain(header),
        rows.map(Iterator::collect::<Vec<String>>),
    )
}

/// The table of a comparison as CSV: `figure`, `unit`, then a column of values and one
/// of errors for every run; empty where there is none.
///
/// # Errors
/// Rows of unequal length.
pub fn table_csv(table: &Table) -> Result<String, csv::Error> {
    let head = table.labels.iter().flat_map(|label| {
        [
            format!("{}={label}", table.over),
            format!("error at {}={label}", table.over),
        ]
    });
    let cell = |value: &Option<f64>| value.map(number).unwrap_or_default();
    let rows = table.rows.iter().map(|row| {
        let cells = row.values.iter().zip(&row.errors);
        [row.figure.clone(), row.unit.clone()]
            .into_iter()
            .chain(cells.flat_map(|(value, error)| [cell(value), cell(error)]))
            .collect::<Vec<String>>()
    });
    let first = ["figure", "unit"].map(str::to_owned);
    write(first.into_iter().chain(head), rows)
}

/// A header and rows as CSV.
pub(in crate::report) fn write<R>(
    header: impl Iterator<Item = String>,
    rows: impl Iterator<Item = R>,
) -> Result<String, csv::Error>
where
    R: IntoIterator<Item = String>,
{
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The shortest decimal that reads back as the same double.
pub(in crate::report) fn number(value: f64) -> String {
    let plain = value.to_string();
    let scientific = format!("{value:e}");
    if scientific.len() < plain.len() {
        scientific
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::{number, record_csv, table_csv};
    use crate::dynamics::record::{Column, Record};
    use crate::studies::compare::{Table, TableRow};

    fn record(values: Vec<f64>) -> Record {
        Record {
            times: vec![0.0, 0.1 + 0.2],
            columns: vec![Column {
                object: "rocker".to_owned(),
                quantity: crate::dynamics::record::Quantity::Displacement,
                unit: "rad",
                values,
            }],
            ..Record::default()
        }
    }

    #[test]
    fn header_and_rows_read_back_exactly() {
        let text = record_csv(&record(vec![-6.00249690245187e-5, 1.0 / 3.0])).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("time [s],rocker.displacement [rad]"));
        let last: Vec<f64> = lines
            .nth(1)
            .unwrap()
            .split(',')
            .map(|field| field.parse().unwrap())
            .collect();
        assert_eq!(last, [0.1 + 0.2, 1.0 / 3.0]);
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn a_comparison_has_values_and_errors_side_by_side() {
        let table = Table {
            against_limit: false,
            over: "rocker.masses".to_owned(),
            labels: vec!["1".to_owned(), "2".to_owned()],
            rows: vec![TableRow {
                limit: None,
                figure: "rocker.sigma".to_owned(),
                unit: "rad".to_owned(),
                values: vec![Some(0.5), None],
                errors: vec![Some(-0.25), None],
            }],
        };
        assert_eq!(
            table_csv(&table).unwrap(),
            "figure,unit,rocker.masses=1,error at rocker.masses=1,rocker.masses=2,error at rocker.masses=2\n\
             rocker.sigma,rad,0.5,-0.25,,\n"
        );
    }

    #[test]
    fn a_short_column_is_an_error_and_no_shifted_table() {
        assert!(record_csv(&record(vec![1.0])).is_err());
    }

    #[test]
    fn numbers_are_short_and_exact() {
        for value in [0.0, -6.00249690245187e-5, 1e300, 5e-324, 0.5, 123456.75] {
            assert_eq!(number(value).parse::<f64>().unwrap(), value);
        }
        assert_eq!(number(1e-7), "1e-7");
        assert_eq!(number(0.5), "0.5");
    }
}
