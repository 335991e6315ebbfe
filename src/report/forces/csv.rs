//! All positions as a table.

use crate::report::csv::{number, write};
use crate::studies::forces::{ForceStudy, columns};

/// A row a position, everything in SI units, angles in radians; empty where a
/// quantity has no value. χ stands with the name of its convention. The last column says why a position has no forces.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn forces_csv(study: &ForceStudy) -> Result<String, csv::Error> {
    let columns = columns(&study.linkage, study.settings.output);
    let timed = study.rows.iter().any(|row| row.time.is_some());
    let named = columns.iter().map(|column| {
        let name = match column.name.as_str() {
            // Its sign is a convention.
            "chi" => format!("chi ({})", study.settings.convention.name()),
            name => name.to_owned(),
        };
        match column.unit.as_str() {
            "" => name,
            unit => format!("{name} [{unit}]"),
        }
    });
    let coordinate = format!("coordinate [{}]", study.coordinate_unit());
    let header = timed
        .then(|| "time [s]".to_owned())
        .into_iter()
        .chain([coordinate])
        .chain(named)
        .chain(["trouble".to_owned()]);
    let rows = study.rows.iter().map(|row| {
        let cell = |value: Option<f64>| value.map(number).unwrap_or_default();
        let time = timed.then(|| cell(row.time));
        let values = columns.iter().map(|column| cell(column.value(row)));
        let trouble = row.forces.as_ref().err().map(ToString::to_string);
        time.into_iter()
            .chain([number(row.motion.coordinate)])
            .chain(values)
            .chain([trouble.unwrap_or_default()])
            .collect::<Vec<String>>()
    });
    write(header, rows)
}
