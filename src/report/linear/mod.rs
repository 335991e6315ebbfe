//! Linear equations and responses to frequencies, as findings, documents, tables and scripts.

mod equations;
mod response;
mod scripts;

pub use equations::{equations_document, equations_findings};
pub use response::{response_document, response_findings, response_rows};
pub use scripts::{MATLAB, PYTHON};

use crate::report::findings::Table;
use crate::studies::linear::LeftOut;

/// Objects that have no linear equations, with the reason.
fn left_out_table(left_out: &[LeftOut]) -> Table {
    let rows = left_out
        .iter()
        .map(|one| vec![one.object.as_str(), one.reason.as_str()]);
    Table::new(["object", "~reason"]).rows(rows)
}
