//! Tables for other programs, as CSV.

use super::abscissa::Abscissa;
use crate::dynamics::record::Record;
use crate::studies::compare::FigureTable;
use std::fmt::Write as _;

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
    pub fn column_names(&self) -> &[String] {
        &self.head
    }

    /// The numbers of a column, those that are no number as NaN; `None` where there are
    /// words in it. They are what the CSV holds: the shortest decimals read back.
    pub fn numbers_of_column(&self, column: usize) -> Option<Vec<f64>> {
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

/// The head of a column: its name, and its unit if it has one.
pub(in crate::report) fn column_heading(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    }
}

/// The record: a header `time [s],rocker.displacement [rad],…` and a row a sample, so that
/// nothing is lost.
///
/// # Errors
/// The columns are not all as long as the times.
pub fn record_csv(record: &Record, over: &Abscissa) -> Result<String, String> {
    let header = record
        .columns
        .iter()
        .map(|column| format!("{}.{} [{}]", column.object, column.quantity, column.unit));
    let count = record.times.len();
    if let Some(column) = record.columns.iter().find(|one| one.values.len() != count) {
        let (name, found) = (&column.object, column.values.len());
        return Err(format!("{name}: {found} values at {count} instants"));
    }
    let angles = over.angles(record);
    let first = angles.map(|_| "machine_angle [rad]".to_owned());
    let header = first
        .into_iter()
        .chain(["time [s]".to_owned()])
        .chain(header);
    let mut out = line(header.collect::<Vec<_>>().iter().map(String::as_str));
    // There may be hundreds of thousands of rows. What is not finite is shown as well.
    for (row, &time) in record.times.iter().enumerate() {
        if let Some(angles) = angles {
            push_number(&mut out, angles[row]);
            out.push(',');
        }
        push_number(&mut out, time);
        for column in &record.columns {
            out.push(',');
            push_number(&mut out, column.values[row]);
        }
        out.push('\n');
    }
    Ok(out)
}

/// Every switch of every pair, one a row; `unit`: that of the speed of an object.
pub fn switches_csv(record: &Record, unit: impl Fn(&str) -> String) -> String {
    let mut out = line(["time [s]", "object", "switch", "flank", "speed", "unit"].into_iter());
    // There may be hundreds of thousands.
    let (mut last, mut of_last) = ("", String::new());
    for row in &record.switches {
        if row.object != last {
            (last, of_last) = (&row.object, unit(&row.object));
        }
        push_number(&mut out, row.time);
        let _ = write!(out, ",{},{},{},", row.object, row.what, row.flank);
        push_number(&mut out, row.speed);
        let _ = writeln!(out, ",{of_last}");
    }
    out
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
    let mut out = String::new();
    push_number(&mut out, value);
    out
}

/// Writes it: with an exponent where that is shorter.
fn push_number(out: &mut String, value: f64) {
    let begin = out.len();
    let _ = write!(out, "{value:e}");
    let written = &out[begin..];
    let sign = usize::from(written.starts_with('-'));
    let Some((mantissa, exponent)) = written[sign..].split_once('e') else {
        // No number.
        return;
    };
    let Ok(exponent) = exponent.parse::<i32>() else {
        return;
    };
    // Its digits, at most 17, and where the point stands among them.
    let mut digits = [0; 17];
    let mut count = 0;
    for digit in mantissa.bytes().filter(u8::is_ascii_digit).take(17) {
        digits[count] = digit;
        count += 1;
    }
    let point = exponent + 1;
    let before = usize::try_from(point).unwrap_or(0);
    let zeros = usize::try_from(-point).unwrap_or(0);
    let plain = match (before, count > before) {
        (0, _) => 2 + zeros + count,
        (_, true) => count + 1,
        (_, false) => before,
    };
    if written.len() - sign < plain {
        return;
    }
    out.truncate(begin + sign);
    if before == 0 {
        out.push_str("0.");
        out.extend(std::iter::repeat_n('0', zeros));
    }
    for (place, &digit) in digits[..count].iter().enumerate() {
        if place == before && before > 0 {
            out.push('.');
        }
        out.push(char::from(digit));
    }
    out.extend(std::iter::repeat_n('0', before.saturating_sub(count)));
}

#[cfg(test)]
mod tests {
    use super::Abscissa;
    use super::{number, record_csv, switches_csv, table_csv};
    use crate::dynamics::record::{Column, Record, SwitchRow};
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
        let text = record_csv(
            &record(vec![-6.00249690245187e-5, 1.0 / 3.0]),
            &Abscissa::Time,
        )
        .unwrap();
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
        assert_eq!(table.column_names(), ["name", "value"]);
        assert_eq!(table.numbers_of_column(0), None);
        let numbers = table.numbers_of_column(1).unwrap();
        assert_eq!(numbers[0], 0.1 + 0.2);
        assert!(numbers[1].is_nan());
    }

    #[test]
    fn every_switch_is_a_row_with_the_unit_of_its_object() {
        let row = |time: f64, object: &str, what| SwitchRow {
            time,
            object: object.to_owned(),
            what,
            flank: "lower",
            speed: 0.1 + time,
        };
        let switches = vec![row(0.1, "rocker", "opens"), row(0.25, "valve", "closes")];
        let record = Record {
            switches,
            ..Record::default()
        };
        let unit = |object: &str| match object {
            "rocker" => "rad/s".to_owned(),
            other => format!("m/s of {other}"),
        };
        assert_eq!(
            switches_csv(&record, unit),
            "time [s],object,switch,flank,speed,unit\n\
             0.1,rocker,opens,lower,0.2,rad/s\n0.25,valve,closes,lower,0.35,m/s of valve\n"
        );
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
        assert!(record_csv(&record(vec![1.0]), &Abscissa::Time).is_err());
    }

    #[test]
    fn numbers_are_short_and_exact() {
        for value in [0.0, -6.00249690245187e-5, 1e300, 5e-324, 0.5, 123456.75] {
            assert_eq!(number(value).parse::<f64>().unwrap(), value);
        }
        assert_eq!(number(1e-7), "1e-7");
        assert_eq!(number(0.5), "0.5");
    }

    #[test]
    fn a_number_is_the_shorter_of_both_writings() {
        let expected = |value: f64| {
            let (plain, scientific) = (value.to_string(), format!("{value:e}"));
            match scientific.len() < plain.len() {
                true => scientific,
                false => plain,
            }
        };
        let special = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            -f64::INFINITY,
            f64::MAX,
        ];
        for value in special {
            assert_eq!(number(value), expected(value));
        }
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for step in 0..200_000 {
            bits = bits
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            // All sizes; and few digits about 1, where both writings meet.
            let few = (bits >> 40) as f64 * 10_f64.powi(step % 24 - 14);
            for value in [f64::from_bits(bits), -few, few, (few * 8.0).round() / 8.0] {
                assert_eq!(number(value), expected(value));
            }
        }
    }
}
