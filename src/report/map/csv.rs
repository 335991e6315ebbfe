//! A map as a table, one row a cell.

use crate::analysis::map::{MapResult, Study};

/// The cells of all panels: panel (counted from 1), the values of the
/// parameters, value, verdict, cause, how far the figure moves under a tiny
/// change of the loads, and the margin of the rigid mechanism. What is not
/// known is left empty; cells that were not worked out are left out.
///
/// # Errors
/// Those of the writer; none in memory.
pub fn map_csv(study: &Study<'_>, result: &MapResult) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head = |axis: &crate::analysis::axis::Axis| match axis.unit.as_str() {
        "" => axis.path.clone(),
        unit => format!("{} [{unit}]", axis.path),
    };
    let mut names = vec!["panel".to_owned(), head(&study.x)];
    names.extend(study.y.as_ref().map(head));
    names.push(match study.unit {
        "" => study.figure.clone(),
        unit => format!("{} [{unit}]", study.figure),
    });
    names.extend(["verdict", "cause", "moved", "rigid_margin"].map(str::to_owned));
    writer.write_record(&names)?;
    let number = |value: Option<f64>| value.map(|value| format!("{value:?}")).unwrap_or_default();
    for (panel, cells) in result.panels.iter().enumerate() {
        for (index, cell) in cells.iter().enumerate() {
            let Some(cell) = cell else { continue };
            let (x, y) = study.place(index);
            let mut row = vec![(panel + 1).to_string(), number(Some(x))];
            row.extend(y.map(|y| number(Some(y))));
            row.push(number(cell.value));
            row.push(cell.verdict.name().to_owned());
            row.push(cell.cause.clone());
            row.extend([number(cell.moved), number(cell.rigid_margin)]);
            writer.write_record(&row)?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
