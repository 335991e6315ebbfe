//! The files of `dam law …`: document, table, picture, page.

use super::PICTURE;
use crate::cli::args::scene::OutArgs;
use crate::cli::failure::Failure;
use crate::cli::output::{self, OutputFolder, ResultFile};
use crate::report::law::LawPage;
use serde_json::Value;

const FILES: [&str; 4] = ["law.json", "law.csv", "law.svg", "report.html"];

/// Results that are written where a folder is asked for.
pub(super) struct Results<'a> {
    /// The JSON document.
    pub(super) document: &'a Value,
    /// The table.
    pub(super) csv: String,
    /// The page.
    pub(super) page: LawPage<'a>,
}

/// Writes the files, if a folder was asked for, and shows the answer.
pub(super) fn deliver(
    args: &OutArgs,
    quiet: bool,
    results: &Results<'_>,
    show: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let page = &results.page;
    let folder = OutputFolder::asked(args, page.title, &FILES)?;
    let files = || {
        let picture = page.charts.first();
        let picture = picture.map_or(String::new(), |chart| chart.svg(PICTURE.0, PICTURE.1));
        Ok(vec![
            ResultFile::new(FILES[0], format!("{:#}\n", results.document)),
            ResultFile::new(FILES[1], results.csv.as_str()),
            ResultFile::new(FILES[2], picture),
            ResultFile::new(FILES[3], page.html()),
        ])
    };
    output::deliver(folder.as_ref(), "law", page.hash, files, show)?;
    if let Some(folder) = folder.filter(|_| !quiet) {
        folder.tell_report();
    }
    Ok(())
}
