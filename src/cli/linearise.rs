//! `dam linearise`: linear equations, state space and natural modes.

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::LineariseArgs;
use super::asker::Asker;
use super::failure::Failure;
use super::output::OutputFolder;
use super::status::Status;
use crate::report::findings::Source;
use crate::report::linear::{MATLAB, PYTHON, equations_document, equations_findings};

const FILES: [&str; 4] = ["linear.json", "linear.py", "linear.m", PAGE];

/// Runs the command.
pub(crate) fn command(args: &LineariseArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let folder = OutputFolder::from_args(&args.out, name, &FILES)?;
    let found = ready.linearise()?;
    let document = equations_document(name, hash, &found).map_err(|error| error.to_string())?;
    let answer = Answer {
        command: "linearise",
        findings: &equations_findings(name, &found, Source::scene(input.text(), hash)),
        document: document.into(),
        files: files(
            FILES,
            [
                Content::Document,
                Content::made(|| PYTHON.to_owned()),
                Content::made(|| MATLAB.to_owned()),
                Content::Page,
            ],
        ),
        quiet: args.scene.quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    Ok(Status::Answered)
}
