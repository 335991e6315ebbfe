//! `dam identify`: numbers of a scene from records of its motion.

use super::answer::{Answer, AnswerForm, Content, Files, PAGE};
use super::args::{IdentifyArgs, RecordEnd};
use super::failure::Failure;
use super::input::{Input, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::progress::Count;
use super::status::Status;
use crate::ask::{IdentifyQuestion, MeasuredRecord, identify};
use crate::frontend::scene::read_bounded;
use crate::report::findings::Source;
use crate::report::identify::{findings, rows};
use crate::studies::identify::Identification;
use std::fs::File;

const FILES: [&str; 4] = ["fit.csv", "identified.json", "identification.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &IdentifyArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let question = question(args)?;
    interrupt::enter(Stage::Answering);
    let _keeping = interrupt::hold_interrupt();
    let count = Count::new(&scene, "runs", args.scene.quiet);
    let budget = interrupt::budget();
    let found = identify(&question, &input.point_source(), budget, &|done| {
        count.set(done)
    });
    count.finish();
    let found = match found {
        Err(_) if budget.is_spent() => {
            let what = "ended before anything was known of the numbers: give it more time";
            return Err(Failure::Output(what.to_owned()));
        }
        found => found?,
    };
    let answer = Answer {
        command: "identify",
        findings: &findings(&scene, &found, Source::scene(input.text(), &hash)),
        document: found.document(&scene).into(),
        files: files(&found),
        quiet: args.scene.quiet,
    };
    let shown = match args.csv {
        true => AnswerForm::File(FILES[0]),
        false => AnswerForm::Text,
    };
    answer.deliver(folder.as_ref(), AnswerForm::json_or(args.scene.json, shown))?;
    Ok(match (found.complete, found.is_answered()) {
        (false, _) => interrupt::status(),
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
    })
}

/// The files. Without estimates there is no scene to write.
fn files(found: &Identification) -> Files<'_> {
    let scene = move || format!("{}\n", found.scene_text);
    let has_scene = !found.scene_text.is_empty();
    [
        Some((
            FILES[0].to_owned(),
            Content::made(move || rows(found).csv()),
        )),
        has_scene.then(|| (FILES[1].to_owned(), Content::made(scene))),
        Some((FILES[2].to_owned(), Content::Document)),
        Some((FILES[3].to_owned(), Content::Page)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// # Errors
/// The records that cannot be read.
fn question(args: &IdentifyArgs) -> Result<IdentifyQuestion, Failure> {
    let (mut records, mut wrong) = (Vec::new(), Vec::new());
    for text in &args.record {
        match record(text) {
            Ok(record) => records.push(record),
            Err(what) => wrong.push(what),
        }
    }
    if !wrong.is_empty() {
        return Err(Failure::Other(wrong.join("\n")));
    }
    Ok(IdentifyQuestion {
        records,
        signals: args.matched.clone(),
        vary: args.vary.clone(),
        sigmas: args.sigma.clone(),
        starts: args.starts,
        until_first_separation: args.until == Some(RecordEnd::FirstSeparation),
        threads: args.threads.map(usize::from),
    })
}

/// A record: its file, and the settings behind it.
fn record(text: &str) -> Result<MeasuredRecord, String> {
    let (name, settings) = MeasuredRecord::name_and_settings(text);
    let wrong = |what: String| format!("--record: cannot read `{name}`: {what}");
    let bytes = File::open(&name)
        .and_then(read_bounded)
        .map_err(|error| wrong(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| wrong("it is no UTF-8 text".to_owned()))?;
    Ok(MeasuredRecord {
        name,
        text,
        settings,
    })
}
