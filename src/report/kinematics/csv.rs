//! All rows as a table.

use crate::report::csv::{number, write};
use crate::studies::kinematics::Kinematics;

/// A row a position; angles continuous and in radians, everything in SI; empty where
/// a quantity grows beyond all numbers.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn kinematics_csv(found: &Kinematics) -> Result<String, csv::Error> {
    let axis = format!("{} [{}]", found.axis.name, found.axis.unit);
    let names = found.columns.iter();
    let names = names.map(|column| format!("{} [{}]", column.name(), column.unit));
    let rows = found.axis.values.iter().enumerate().map(|(row, place)| {
        let values = found.columns.iter().map(move |column| column.values[row]);
        let cell = |value: f64| match value.is_finite() {
            true => number(value),
            false => String::new(),
        };
        std::iter::once(*place).chain(values).map(cell)
    });
    write(
        std::iter::once(axis).chain(names),
        rows.map(Iterator::collect::<Vec<String>>),
    )
}
