//! `dam gradient`: derivatives of results by numbers of the scene.

use super::answer::{Answer, AnswerForm, Content, PAGE};
use super::args::GradientArgs;
use super::failure::Failure;
use super::input::{Input, Ready, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::status::Status;
use crate::ask::{GradientQuestion, ModelAssessment, gradient};
use crate::report::findings::Source;
use crate::report::gradient::{findings, rows};

const FILES: [&str; 3] = ["gradient.csv", "gradient.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &GradientArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let question = GradientQuestion {
        by: args.by.clone(),
        figures: args.figures.clone(),
        check: match (args.check, args.no_check) {
            (true, _) => Some(true),
            (false, true) => Some(false),
            (false, false) => None,
        },
    };
    interrupt::enter(Stage::Answering);
    let prepare = |settings: &[String]| {
        Ready::of_within(
            input.decode(settings)?,
            ModelAssessment::Needed,
            interrupt::budget(),
        )
    };
    let numbers = input.document().numbers(&input.catalogue());
    let found = gradient(&question, &prepare, &numbers, interrupt::budget())?;
    let answer = Answer {
        command: "gradient",
        findings: &findings(&scene, &found, Source::scene(input.text(), &hash)),
        document: found.document(&scene).into(),
        files: vec![
            (FILES[0].to_owned(), Content::made(|| rows(&found).csv())),
            (FILES[1].to_owned(), Content::Document),
            (FILES[2].to_owned(), Content::Page),
        ],
        quiet: args.scene.quiet,
    };
    let shown = match args.csv {
        true => AnswerForm::File(FILES[0]),
        false => AnswerForm::Text,
    };
    answer.deliver(folder.as_ref(), AnswerForm::json_or(args.scene.json, shown))?;
    Ok(match found.is_answered() {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}
