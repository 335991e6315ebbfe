//! `dam identify`: numbers of a scene from records of its motion.

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::{IdentifyArgs, RecordEnd};
use super::asker::Asker;
use super::failure::Failure;
use super::input::{Ready, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::progress::Count;
use super::status::Status;
use crate::ask::{IdentifyQuestion, MeasuredRecord, ModelAssessment, identify};
use crate::frontend::scene::read_bounded;
use crate::report::findings::Source;
use crate::report::identify::{findings, rows};
use std::fs::File;

const FILES: [&str; 3] = ["fit.csv", "identify.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &IdentifyArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let records: Result<Vec<MeasuredRecord>, String> =
        args.record.iter().map(|text| record(text)).collect();
    let question = IdentifyQuestion {
        records: records?,
        signals: args.matched.clone(),
        vary: args.vary.clone(),
        sigmas: args.sigma.clone(),
        starts: args.starts,
        seed: args.seed,
        until_first_separation: args.until == Some(RecordEnd::FirstSeparation),
        threads: args.threads.map(usize::from),
    };
    interrupt::enter(Stage::Answering);
    let budget = asker.budget();
    let count = Count::new(&scene, "runs", args.scene.quiet);
    let prepare = |settings: &[String]| {
        Ready::of_within(input.decode(settings)?, ModelAssessment::Needed, budget)
    };
    let found = identify(&question, &prepare, budget, &|done| count.set(done));
    count.finish();
    let found = found?;
    let answer = Answer {
        command: "identify",
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
    Ok(match found.is_answered() {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

/// A record: its file, and the settings behind it.
fn record(text: &str) -> Result<MeasuredRecord, String> {
    let mut parts = text.split(';').map(str::trim);
    let name = parts.next().unwrap_or_default().to_owned();
    let wrong = |what: String| format!("--record: cannot read `{name}`: {what}");
    let bytes = File::open(&name)
        .and_then(read_bounded)
        .map_err(|error| wrong(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| wrong("it is no UTF-8 text".to_owned()))?;
    Ok(MeasuredRecord {
        text,
        settings: parts
            .filter(|part| !part.is_empty())
            .map(str::to_owned)
            .collect(),
        name,
    })
}
