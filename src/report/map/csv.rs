//! A map as a table, one row a cell.

use crate::studies::map::{MapResult, Study};

/// The cells of all panels: panel (counted from 1), of several panels what each
/// differs in, the values of the parameters, value, verdict, cause, how far the figure moves under a tiny
/// change of the loads, and the margin of the rigid mechanism. What is not
/// known is left empty; cells that were not worked out are left out.
///
/// # Errors
/// Those of the writer; none in memory.
pub fn map_csv(study: &Study<'_>, result: &MapResult) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head = |name: &str, unit: &str| match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    };
    let [x_unit, y_unit] = &study.parameter_units;
    let several = study.panels.panels.len() > 1;
    let mut names = vec!["panel".to_owned()];
    names.extend(several.then(|| "settings".to_owned()));
    names.push(head(&study.x.path, x_unit));
    names.extend(study.y.as_ref().map(|y| head(&y.path, y_unit)));
    names.push(head(&study.figure, &study.unit));
    names.extend(["verdict", "cause", "determined", "moved", "rigid_margin"].map(str::to_owned));
    writer.write_record(&names)?;
    let number = |value: Option<f64>| value.map(|value| format!("{value:?}")).unwrap_or_default();
    for (panel, cells) in result.panels.iter().enumerate() {
        for (index, cell) in cells.iter().enumerate() {
            let Some(cell) = cell else { continue };
            let (x, y) = study.place(index);
            let mut row = vec![(panel + 1).to_string()];
            row.extend(several.then(|| study.panels.panels[panel].label.clone()));
            row.push(number(Some(x)));
            row.extend(y.map(|y| number(Some(y))));
            row.push(number(cell.value));
            row.push(cell.verdict.name().to_owned());
            row.push(cell.cause.clone());
            row.push(
                cell.determined
                    .map(|yes| yes.to_string())
                    .unwrap_or_default(),
            );
            row.extend([number(cell.moved), number(cell.rigid_margin)]);
            writer.write_record(&row)?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
