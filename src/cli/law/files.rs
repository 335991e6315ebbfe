//! The files of `dam law …`: document, table, picture, page.

use super::PICTURE;
use super::args::Form;
use crate::cli::args::scene::OutArgs;
use crate::cli::console;
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

impl Results<'_> {
    /// The first chart as a picture.
    fn picture(&self) -> String {
        let picture = self.page.charts.first();
        picture.map_or(String::new(), |chart| chart.svg(PICTURE.0, PICTURE.1))
    }

    /// Shows the answer: as JSON if that is asked for, otherwise in a form.
    fn show(&self, (json, form): (bool, Form)) -> Result<(), Failure> {
        match (json, form) {
            (true, _) => console::json(self.document),
            (_, Form::Text) => console::text(self.page.text),
            (_, Form::Csv) => console::data(&self.csv),
            (_, Form::Svg) => console::data(&self.picture()),
        }
    }
}

/// Writes the files, if a folder was asked for, and shows the answer: as JSON (`true`) or
/// in a form.
pub(super) fn deliver(
    args: &OutArgs,
    quiet: bool,
    results: &Results<'_>,
    shown: (bool, Form),
) -> Result<(), Failure> {
    let page = &results.page;
    let folder = OutputFolder::asked(args, page.title, &FILES)?;
    let files = || {
        Ok(vec![
            ResultFile::new(FILES[0], format!("{:#}\n", results.document)),
            ResultFile::new(FILES[1], results.csv.as_str()),
            ResultFile::new(FILES[2], results.picture()),
            ResultFile::new(FILES[3], page.html()),
        ])
    };
    let show = || results.show(shown);
    output::deliver(folder.as_ref(), "law", page.hash, files, show)?;
    if let Some(folder) = folder.filter(|_| !quiet) {
        folder.tell_report();
    }
    Ok(())
}
