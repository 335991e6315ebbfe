//! Tables of points: a list in the scene, or two columns of a CSV file beside it.

use super::bounds::Bounds;
use super::csv::{Row, no_folder};
use super::slot::Slot;
use super::wanted::QuantityChoice;
use crate::frontend::diagnostics::{Diagnostic, Place};
use serde_json::json;

/// Most points of a list.
const MOST_POINTS: usize = 100_000;

/// Reads `[[x, y], …]` with x strictly ascending, or `{ "file": "lift.csv" }`.
pub fn read_points(
    mut slot: Slot<'_>,
    x: impl Into<QuantityChoice>,
    y: impl Into<QuantityChoice>,
    least: usize,
) -> Option<Vec<(f64, f64)>> {
    let wanted = [x.into(), y.into()];
    let rows: Vec<Row> = slot.read_in_place(|slot| {
        slot.object_or(
            |slot| slot.defined("table_file", |slot| of_file(slot, wanted, least)),
            |slot| of_list(slot, wanted, least),
        )
    })?;
    let wrong = rows.windows(2).find(|pair| pair[1].0.0 <= pair[0].0.0);
    let Some([before, row]) = wrong else {
        return Some(rows.into_iter().map(|row| row.0).collect());
    };
    let message = format!(
        "the first values must ascend: {} follows {}",
        row.0.0, before.0.0
    );
    let place = row.1.clone();
    let at = rows.iter().position(|one| one.0 == row.0).unwrap_or(0);
    let path = format!("{}[{at}]", slot.path);
    let fault = slot.refuse("not-ascending", message);
    fault.place = Some(place);
    fault.path = path;
    None
}

fn of_list(slot: Slot<'_>, [x, y]: [QuantityChoice; 2], least: usize) -> Option<Vec<Row>> {
    slot.list(least..=MOST_POINTS, |slot| {
        let place = slot.place();
        let point = slot.pair(
            |slot| slot.quantity(x, Bounds::ANY),
            |slot| slot.quantity(y, Bounds::ANY),
        )?;
        Some((point, place))
    })
}

fn of_file(mut slot: Slot<'_>, wanted: [QuantityChoice; 2], least: usize) -> Option<Vec<Row>> {
    let (name, columns) = slot.read_in_place(|slot| {
        slot.record(|fields| {
            let doc = "CSV file in the folder of the scene. Its first line names the columns with \
                       their units: angle [deg], lift [mm].";
            let file = fields.need("file", doc, |slot| slot.text());
            let doc = "Names of the two columns that are meant; needed where there are more.";
            let columns = fields.maybe("columns", doc, |slot| {
                slot.pair(|slot| slot.text(), |slot| slot.text())
            });
            Some((file?, columns?))
        })
    })?;
    let columns = columns.map(|(x, y)| [x, y]);
    let at = slot.node().and_then(|node| node.get("file"));
    let at = at.map_or_else(|| slot.place(), |node| node.place.clone());
    let rows = match slot.reader.files.get(&name) {
        Some(Ok(file)) => file.rows(columns.as_ref(), wanted),
        Some(Err(fault)) => Err(vec![fault.clone()]),
        None => Err(vec![no_folder()]),
    };
    match rows {
        Ok(rows) if rows.len() >= least => {
            *slot.out = json!(rows.iter().map(|row| row.0).collect::<Vec<_>>());
            Some(rows)
        }
        Ok(rows) => {
            let count = rows.len();
            let message =
                format!("the file `{name}` has {count} rows, at least {least} are needed");
            refuse_file(&mut slot, Diagnostic::error("wrong-length", message), &at);
            None
        }
        Err(faults) => {
            faults
                .into_iter()
                .for_each(|fault| refuse_file(&mut slot, fault, &at));
            None
        }
    }
}

/// Notes a fault in a file, with the place where the scene names the file.
fn refuse_file(slot: &mut Slot<'_>, fault: Diagnostic, at: &Place) {
    let fault = match fault.place {
        Some(_) => fault.with_place(at.clone(), "named here"),
        None => fault.at(at.clone()),
    };
    let path = slot.path.clone();
    slot.reader.diagnostics.push(fault.path(path));
}
