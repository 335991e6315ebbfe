//! A map as rows, one a cell.

use crate::report::csv::{Field, Rows};
use crate::studies::map::{Cell, MapResult, Study};

/// The cells of all panels: panel (counted from 1), of several panels what each
/// differs in, the values of the parameters, value, verdict, cause, how far the figure moves under a tiny
/// change of the loads, and the margin of the rigid mechanism. What is not
/// known is left empty; cells that were not worked out are left out.
pub fn map_rows(study: &Study<'_>, result: &MapResult) -> Rows {
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
    let row = |panel: usize, index: usize, cell: &Cell| {
        let (x, y) = study.parameters_at_cell(index);
        let mut row: Vec<Field> = vec![(panel + 1).to_string().into()];
        row.extend(several.then(|| study.panels.panels[panel].label.as_str().into()));
        row.push(x.into());
        row.extend(y.map(Field::from));
        row.extend([
            cell.value.into(),
            cell.verdict.name().into(),
            cell.cause.as_str().into(),
        ]);
        let determined = cell.determined.map(|yes| yes.to_string());
        row.push(determined.unwrap_or_default().into());
        row.extend([cell.moved, cell.rigid_margin].map(Field::from));
        row
    };
    let panels = result.panels.iter().enumerate();
    let rows = panels.flat_map(|(panel, cells)| {
        let known = cells.iter().enumerate();
        known.filter_map(move |(index, cell)| Some(row(panel, index, cell.as_ref()?)))
    });
    Rows::new(names, rows)
}
