//! The reactions at each position: size and direction of the force in every joint.

use super::{ForcesReport, value};
use crate::report::findings::{Cell, Section, Table};
use crate::report::quantity::significant;

/// Most positions that are listed.
const MOST_POSITIONS: usize = 37;
/// Most joints side by side.
const ABREAST: usize = 4;

/// A joint: its name, and the columns of the size and direction of its force.
type Joint = (String, [usize; 2]);

/// A table of joints over positions, if these are few.
pub(super) fn reactions_section<'a>(report: &ForcesReport<'_>) -> Section<'a> {
    let study = report.study;
    if study.rows.len() > MOST_POSITIONS || study.solved().next().is_none() {
        return Section::default();
    }
    let columns = study.columns();
    let place = |name: &str| columns.iter().position(|column| column.name == name);
    let joints = columns
        .iter()
        .enumerate()
        .filter_map(|(direction, column)| {
            let name = column.name.strip_suffix(".direction")?;
            let size = place(&format!("{name}.force"))?;
            (!column.indeterminate).then(|| (name.to_owned(), [size, direction]))
        });
    let joints: Vec<Joint> = joints.collect();
    let legend =
        "Force on the second link of each joint, and its direction counterclockwise from x.";
    let mut section = Section::new("Reactions").legend(legend);
    for abreast in joints.chunks(ABREAST) {
        section = section.table(table(report, abreast));
    }
    section
}

fn table(report: &ForcesReport<'_>, joints: &[Joint]) -> Table {
    let heads = joints.iter().map(|(name, _)| format!(">{name}"));
    let axis = format!(">{}", report.axis().name);
    let heads: Vec<String> = std::iter::once(axis).chain(heads).collect();
    let columns = report.study.columns();
    let rows = report.study.rows.iter().map(|row| {
        let cells = joints.iter().map(|(_, own)| {
            let [size, direction] = own.map(|column| columns[column].value(row));
            force(size, direction)
        });
        let place = Cell::from(report.place_text(row.motion.coordinate));
        std::iter::once(place).chain(cells).collect::<Vec<Cell>>()
    });
    Table::new(heads.iter().map(String::as_str)).rows(rows)
}

/// Size and direction; a dash without forces.
fn force(size: Option<f64>, direction: Option<f64>) -> Cell {
    match (size, direction) {
        (Some(force), Some(angle)) => {
            let degrees = significant(angle.to_degrees(), 4);
            Cell::with_note(value(force, "N"), format!("{degrees} deg"))
        }
        (Some(force), None) => Cell::from(value(force, "N")),
        (None, _) => Cell::from("–"),
    }
}
