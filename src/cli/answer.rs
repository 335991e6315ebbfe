//! Findings of a command: shown in one form, and written into a folder in all of them.
//!
//! All studies are shown in this form.

use super::console;
use super::failure::Failure;
use super::output::{self, OutputFolder, ResultFile};
use super::status::Status;
use crate::dynamics::model::{Model, UNTIL};
use crate::report::findings::Findings;
use crate::report::plot::Plot;
use crate::studies::check::Check;
use serde::Serialize;
use serde_json::Value;

/// Name of the page among the files.
pub(crate) const PAGE: &str = "report.html";

/// Findings of a command with the files that hold them.
pub(crate) struct Answer<'a> {
    /// Name of the command.
    pub(crate) command: &'static str,
    /// What was found.
    pub(crate) findings: &'a Findings<'a>,
    /// The same as one JSON document.
    pub(crate) document: Document<'a>,
    /// The files, in their order: names and contents.
    pub(crate) files: Files<'a>,
    /// True: nothing is said on standard error.
    pub(crate) quiet: bool,
}

/// A JSON document, written when it is wanted.
pub(crate) struct Document<'a>(Box<dyn Fn() -> serde_json::Result<String> + 'a>);

impl<'a> Document<'a> {
    /// The document that is made so.
    pub(crate) fn made<D: Serialize>(make: impl Fn() -> D + 'a) -> Self {
        Self(Box::new(move || serde_json::to_string_pretty(&make())))
    }

    fn text(&self) -> Result<String, Failure> {
        let text = (self.0)().map_err(|error| error.to_string())?;
        Ok(text + "\n")
    }
}

impl From<Value> for Document<'_> {
    fn from(document: Value) -> Self {
        Self(Box::new(move || serde_json::to_string_pretty(&document)))
    }
}

/// A document with what is doubtful about it.
#[derive(Serialize)]
pub(crate) struct DocumentWithWarnings<'a, D> {
    #[serde(flatten)]
    pub(crate) document: D,
    pub(crate) warnings: &'a [String],
}

/// Content of a file.
pub(crate) enum Content<'a> {
    /// The JSON document.
    Document,
    /// The page.
    Page,
    /// A table or a picture, made when it is wanted.
    Made(Box<dyn Fn() -> String + 'a>),
}

impl<'a> Content<'a> {
    /// A table or a picture.
    pub(crate) fn made(make: impl Fn() -> String + 'a) -> Self {
        Self::Made(Box::new(make))
    }
}

/// The files of an answer by their names, in this order.
pub(crate) type Files<'a> = Vec<(String, Content<'a>)>;

/// Files of these names with these contents.
pub(crate) fn files<'a, const N: usize>(names: [&str; N], contents: [Content<'a>; N]) -> Files<'a> {
    names.map(str::to_owned).into_iter().zip(contents).collect()
}

/// Adds a warning to the findings and to the document.
pub(crate) fn add_warning(
    findings: &mut Findings<'_>,
    document: &mut Value,
    warning: Option<String>,
) {
    let Some(warning) = warning else { return };
    match &mut document["warnings"] {
        Value::Array(warnings) => warnings.push(warning.as_str().into()),
        none => *none = Value::from(vec![warning.as_str()]),
    }
    findings.warnings.push(warning);
}

/// What a study that is no run says of a condition that ends runs.
pub(crate) fn ignores_until(model: &Model) -> Option<String> {
    let ends = model.conditions.iter().any(|one| one.name == UNTIL);
    ends.then(|| "`run.until` has no effect here: it ends `dam run` alone".to_owned())
}

/// Form in which an answer is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum AnswerForm {
    /// As one JSON document.
    Json,
    /// As text.
    Text,
    /// As the content of the file of this name.
    File(&'static str),
    /// As this table or picture, that no file holds.
    Made(String),
}

impl AnswerForm {
    /// JSON where it is asked for, else the given form.
    pub(crate) fn json_or(json: bool, form: Self) -> Self {
        if json { Self::Json } else { form }
    }
}

impl Answer<'_> {
    /// Writes the files where a folder was asked for, shows the answer, and says what is doubtful
    /// and where the page is.
    pub(crate) fn deliver(
        &self,
        folder: Option<&OutputFolder>,
        shown: AnswerForm,
    ) -> Result<(), Failure> {
        let file = |(name, content): &(String, Content<'_>)| {
            Ok(ResultFile::new(name.as_str(), self.content(content)?))
        };
        let files = || self.files.iter().map(file).collect();
        let hash = self.findings.source.hash;
        output::deliver(folder, self.command, hash, files, || self.show(shown))?;
        if self.quiet {
            return Ok(());
        }
        for warning in &self.findings.warnings {
            console::print_message(&format!("warning: {warning}"));
        }
        if let Some(folder) = folder {
            folder.print_report_path();
        }
        Ok(())
    }

    /// The status by the checks that the findings show.
    pub(crate) fn status(&self) -> Status {
        match self.findings.checks().all(Check::passed) {
            true => Status::Answered,
            false => Status::NotTrusted,
        }
    }

    /// Names of the files.
    #[cfg(feature = "live")]
    pub(crate) fn names(&self) -> Vec<&str> {
        self.files.iter().map(|(name, _)| name.as_str()).collect()
    }

    /// Content of the file of a name, where there is one.
    pub(crate) fn file(&self, name: &str) -> Result<Option<String>, Failure> {
        let file = self.files.iter().find(|(known, _)| known == name);
        file.map(|(_, content)| self.content(content)).transpose()
    }

    fn content(&self, content: &Content<'_>) -> Result<String, Failure> {
        match content {
            Content::Document => self.document.text(),
            Content::Page => Ok(self.findings.page()),
            Content::Made(make) => Ok(make()),
        }
    }

    fn show(&self, shown: AnswerForm) -> Result<(), Failure> {
        match shown {
            AnswerForm::Json => console::json_text(&self.document.text()?),
            AnswerForm::Text => console::findings(self.findings),
            AnswerForm::Made(content) => console::data(&content),
            AnswerForm::File(name) => console::data(&self.file(name)?.unwrap_or_default()),
        }
    }
}

/// A chart as a picture by itself; nothing where there is none.
pub(crate) fn picture(chart: Option<&Plot>) -> String {
    chart.map_or(String::new(), |chart| chart.svg(900.0, 480.0))
}
