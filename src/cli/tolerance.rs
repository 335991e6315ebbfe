//! `dam tolerance`: what tolerances of dimensions make of results.

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::ToleranceArgs;
use super::asker::Asker;
use super::bar::Bar;
use super::failure::Failure;
use super::input::{Ready, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::status::Status;
use crate::ask::{ModelAssessment, ToleranceQuestion, tolerance};
use crate::report::findings::Source;
use crate::report::tolerance::{findings, rows};

const FILES: [&str; 3] = ["samples.csv", "tolerance.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &ToleranceArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let question = ToleranceQuestion {
        tolerances: args.tol.clone(),
        figures: args.figures.clone(),
        limits: args.limit.clone(),
        samples: args.samples,
        seed: args.seed,
        threads: args.threads.map(usize::from),
    };
    interrupt::enter(Stage::Answering);
    let _keeping = asker.guard_from_interrupt();
    let budget = asker.budget();
    let template = "{prefix} {bar:30} {pos} of {len} runs, {eta} left";
    let bar = Bar::new(template, &scene, (0, Some(1)), args.scene.quiet);
    let prepare = |settings: &[String]| {
        Ready::of_within(input.decode(settings)?, ModelAssessment::Needed, budget)
    };
    let found = tolerance(
        &question,
        &input.point_source(),
        &prepare,
        budget,
        &|done, of| {
            bar.set_length(of as u64);
            bar.set(done as u64);
        },
    );
    bar.finish();
    let found = match found {
        Err(_) if budget.is_spent() => {
            let what = "ended before anything was known of the tolerances: give it more time";
            return Err(Failure::Output(what.to_owned()));
        }
        found => found?,
    };
    let answer = Answer {
        command: "tolerance",
        findings: &findings(&scene, &found, Source::scene(input.text(), &hash)),
        document: found.document(&scene).into(),
        files: files(
            FILES,
            [
                Content::made(|| rows(&found).csv()),
                Content::Document,
                Content::Page,
            ],
        ),
        quiet: args.scene.quiet,
    };
    let shown = match args.csv {
        true => AnswerForm::File(FILES[0]),
        false => AnswerForm::Text,
    };
    asker.deliver(
        &answer,
        folder.as_ref(),
        AnswerForm::json_or(args.scene.json, shown),
    )?;
    Ok(match (found.complete, found.is_answered()) {
        (false, _) => interrupt::status(),
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
    })
}
