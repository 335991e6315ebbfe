//! Tables for other programs, as CSV.

use crate::dynamics::record::Record;
use crate::studies::compare::FigureTable;

/// A table for other programs: a head, and rows of as many fields.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    head: Vec<String>,
    rows: Vec<Vec<Field>>,
}

/// Field of a row; empty where there is no value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Field(String);

impl From<f64> for Field {
    /// The shortest decimal that reads back as the same double; nothing of what is not finite.
    fn from(value: f64) -> Self {
        Self(match value.is_finite() {
            true => number(value),
            false => String::new(),
        })
    }
}

impl From<Option<f64>> for Field {
    fn from(value: Option<f64>) -> Self {
        value.map(Self::from).unwrap_or_default()
    }
}

impl From<String> for Field {
    fn from(words: String) -> Self {
        Self(words)
    }
}

impl From<&str> for Field {
    fn from(words: &str) -> Self {
        Self(words.to_owned())
    }
}

impl Rows {
    /// A table of the fields of its rows, one for each name of the head.
    pub fn new<R>(
        head: impl IntoIterator<Item = impl Into<String>>,
        rows: impl IntoIterator<Item = R>,
    ) -> Self
    where
        R: IntoIterator,
        R::Item: Into<Field>,
    {
        let row = |row: R| row.into_iter().map(Into::into).collect();
        Self {
            head: head.into_iter().map(Into::into).collect(),
            rows: rows.into_iter().map(row).collect(),
        }
    }

    /// Names of the columns.
    pub fn head(&self) -> &[String] {
        &self.head
    }

    /// The numbers of a column, those that are no number as NaN; `None` where there are
    /// words in it. They are what the CSV holds: the shortest decimals read back.
    pub fn numbers(&self, column: usize) -> Option<Vec<f64>> {
        let number = |row: &Vec<Field>| match row.get(column)?.0.as_str() {
            "" => Some(f64::NAN),
            text => text.parse().ok(),
        };
        self.rows.iter().map(number).collect()
    }

    /// The table as CSV (RFC 4180, UTF-8).
    pub fn csv(&self) -> String {
        let head = line(self.head.iter().map(String::as_str));
        let rows = self.rows.iter();
        let rows = rows.map(|row| line(row.iter().map(|field| field.0.as_str())));
        std::iter::once(head).chain(rows).collect()
    }
}

/// Fields between commas, in quotation marks where they hold what would end them.
fn line<'f>(fields: impl Iterator<Item = &'f str>) -> String {
    let quoted = |field: &'f str| match field.contains(['"', ',', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_owned(),
    };
    fields.map(quoted).collect::<Vec<_>>().join(",") + "\n"
}

/// The record: a header `time [s],rocker.displacement [rad],…` and a row a sample, so that
/// nothing is lost.
///
/// # Errors
/// The columns are not all as long as the times.
pub fn record_csv(record: &Record) -> Result<String, String> {
    let header = record
        .columns
        .iter()
        .map(|column| format!("{}.{} [{}]", column.object, column.quantity, column.unit));
    let count = record.times.len();
    if let Some(column) = record.columns.iter().find(|one| one.values.len() != count) {
        let (name, found) = (&column.object, column.values.len());
        return Err(format!("{name}: {found} values at {count} instants"));
    }
    let rows = record.times.iter().enumerate().map(|(row, time)| {
        let values = record.columns.iter().map(move |column| column.values[row]);
        std::iter::once(*time).chain(values).map(Sample)
    });
    Ok(Rows::new(std::iter::once("time [s]".to_owned()).chain(header), rows).csv())
}

/// A value of a record, that shows what is not finite as well.
struct Sample(f64);

impl From<Sample> for Field {
    fn from(sample: Sample) -> Self {
        Self(number(sample.0))
    }
}

/// The table of a comparison: `figure`, `unit`, then a column of values and one of errors for
/// every run; empty where there is none.
pub fn table_csv(table: &FigureTable) -> String {
    let head = table.labels.iter().flat_map(|label| {
        [
            format!("{}={label}", table.over),
            format!("error at {}={label}", table.over),
        ]
    });
    let rows = table.rows.iter().map(|row| {
        let cells = row.values.iter().zip(&row.errors);
        let cells = cells.flat_map(|(value, error)| [Field::from(*value), Field::from(*error)]);
        let first = [row.figure.as_str(), row.unit.as_str()].map(Field::from);
        first.into_iter().chain(cells).collect::<Vec<Field>>()
    });
    let first = ["figure", "unit"].map(str::to_owned);
    Rows::new(first.into_iter().chain(head), rows).csv()
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
    use crate::studies::compare::{FigureTable, TableRow};

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
    fn columns_of_numbers_are_taken_back_exactly() {
        let rows = [("a", Some(0.1 + 0.2)), ("b", None)];
        let rows = rows.map(|(name, value)| [super::Field::from(name), value.into()]);
        let table = super::Rows::new(["name", "value"], rows);
        assert_eq!(table.head(), ["name", "value"]);
        assert_eq!(table.numbers(0), None);
        let numbers = table.numbers(1).unwrap();
        assert_eq!(numbers[0], 0.1 + 0.2);
        assert!(numbers[1].is_nan());
    }

    #[test]
    fn a_comparison_has_values_and_errors_side_by_side() {
        let table = FigureTable {
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
            table_csv(&table),
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
