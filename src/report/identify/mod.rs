//! Numbers of a scene from records, as data.

mod charts;
mod findings;
mod words;

pub use findings::findings;

use crate::report::csv::{Field, Rows};
use crate::studies::identify::Identification;

/// One row a time of a signal.
pub fn rows(found: &Identification) -> Rows {
    let heads = [
        "record", "signal", "t [s]", "measured", "fit", "residual", "unit",
    ];
    let each = found.signals.iter().flat_map(|one| {
        let rows = one.times.iter().zip(&one.measured).zip(&one.residuals);
        rows.map(move |((time, measured), residual)| {
            let residual = one.weight() * residual;
            let cells: [Field; 7] = [
                one.record.as_str().into(),
                one.address.as_str().into(),
                (*time).into(),
                (*measured).into(),
                (*measured + residual).into(),
                residual.into(),
                one.unit.as_str().into(),
            ];
            cells
        })
    });
    Rows::new(heads, each)
}
