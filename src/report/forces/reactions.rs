//! The reactions at each position: size and direction of the force in every joint.

use super::{ForcesReport, value};
use crate::report::findings::{Cell, Section, Table};
use crate::report::quantity::significant;
use crate::studies::forces::{Column, Row};

/// Most positions that are listed.
const MOST_POSITIONS: usize = 37;
/// Most joints side by side.
const ABREAST: usize = 4;

/// A table of joints over positions, if these are few.
pub(super) fn reactions<'a>(report: &ForcesReport<'_>) -> Section<'a> {
    let study = report.study;
    if study.rows.len() > MOST_POSITIONS || study.solved().next().is_none() {
        return Section::default();
    }
    let columns = study.columns();
    let column = |name: String| columns.iter().find(|column| column.name == name);
    let linkage = &study.linkage;
    let pairs = linkage.pairs.iter().map(|pair| pair.name.as_str());
    let names = pairs.chain(linkage.welds.iter().map(|weld| weld.name.as_str()));
    let joints: Vec<(&str, [&Column; 2])> = names
        .filter_map(|name| {
            let size = column(format!("{name}.force"))?;
            let known = [size, column(format!("{name}.direction"))?];
            (!size.indeterminate).then_some((name, known))
        })
        .collect();
    let mut section = Section::new("Reactions").legend(
        "Force on the second link of each joint, and its direction counterclockwise from x.",
    );
    for abreast in joints.chunks(ABREAST) {
        section = section.table(table(report, abreast));
    }
    section
}

fn table(report: &ForcesReport<'_>, joints: &[(&str, [&Column; 2])]) -> Table {
    let axis = report.axis().name;
    let heads = joints.iter().map(|(name, _)| format!(">{name}"));
    let rows = report.study.rows.iter().map(|row| {
        let place = Cell::from(report.place(row.motion.coordinate));
        let cells = joints.iter().map(|(_, columns)| force(row, *columns));
        std::iter::once(place).chain(cells).collect::<Vec<Cell>>()
    });
    let heads: Vec<String> = std::iter::once(format!(">{axis}")).chain(heads).collect();
    Table::new(heads.iter().map(String::as_str)).rows(rows)
}

/// Size and direction; empty without forces.
fn force(row: &Row, [size, direction]: [&Column; 2]) -> Cell {
    match (size.value(row), direction.value(row)) {
        (Some(force), Some(angle)) => {
            let degrees = significant(angle.to_degrees(), 4);
            Cell::with(value(force, "N"), format!("{degrees} deg"))
        }
        (Some(force), None) => Cell::from(value(force, "N")),
        (None, _) => Cell::from("–"),
    }
}
