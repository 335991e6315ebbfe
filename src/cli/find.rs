//! `dam find`: the best value of a parameter under conditions.

use super::answer::{Answer, AnswerForm, Content, PAGE};
use super::args::{FindArgs, goal};
use super::asker::Asker;
use super::failure::Failure;
use super::input::{Ready, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::progress::Count;
use super::status::Status;
use crate::ask::{FindQuestion, ModelAssessment, find};
use crate::report::find::findings;
use crate::report::findings::Source;

const FILES: [&str; 2] = ["found.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &FindArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let question = FindQuestion {
        vary: args.vary.clone(),
        subject: args.subject.clone(),
        goal: goal(&args.maximize, &args.minimize),
        threads: args.threads.map(usize::from),
    };
    interrupt::enter(Stage::Answering);
    let _keeping = asker.guard_from_interrupt();
    let budget = asker.budget();
    let count = Count::new(&scene, "values", args.scene.quiet);
    let prepare = |settings: &[String]| {
        Ready::of_within(input.decode(settings)?, ModelAssessment::Needed, budget)
    };
    let found = find(&question, &prepare, budget, &|done| count.set(done));
    count.finish();
    let found = found?;
    let source = Source::scene(input.text(), &hash);
    let document = found.document(&scene);
    let answer = Answer {
        command: "find",
        findings: &findings(&scene, &found, source),
        document: document.into(),
        files: vec![
            (FILES[0].to_owned(), Content::Document),
            (FILES[1].to_owned(), Content::Page),
        ],
        quiet: args.scene.quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    Ok(match (found.found.complete, found.is_answered()) {
        (false, _) => interrupt::status(),
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
    })
}
