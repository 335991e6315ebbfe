//! `dam optimize`: the best values of several variables under conditions.

use super::answer::{Answer, AnswerForm, Content, PAGE};
use super::args::{OptimizeArgs, goal};
use super::failure::Failure;
use super::input::{Input, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::progress::Count;
use super::status::Status;
use crate::ask::{OptimizeQuestion, optimize};
use crate::report::findings::Source;
use crate::report::optimize::findings;

const FILES: [&str; 3] = ["optimized.json", "optimization.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &OptimizeArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let given = input.decode(&[])?;
    print_doubts(&given, args.scene.quiet);
    let (scene, hash) = (given.scene.name, given.scene.hash);
    let folder = OutputFolder::from_args(&args.out, &scene, &FILES)?;
    let question = OptimizeQuestion {
        vary: args.vary.clone(),
        subject: args.subject.clone(),
        goal: goal(&args.maximize, &args.minimize),
        starts: args.starts.map_or(0, usize::from),
        threads: args.threads.map(usize::from),
    };
    interrupt::enter(Stage::Answering);
    let _keeping = interrupt::hold_interrupt();
    let count = Count::new(&scene, "places", args.scene.quiet);
    let found = optimize(
        &question,
        &input.point_source(),
        interrupt::budget(),
        &|done| count.set(done),
    );
    count.finish();
    let found = found?;
    let optimized = || format!("{}\n", found.scene_text);
    let answer = Answer {
        command: "optimize",
        findings: &findings(&scene, &found, Source::scene(input.text(), &hash)),
        document: found.document(&scene).into(),
        files: [
            // Without an optimum there is no scene to write.
            (!found.scene_text.is_empty()).then(|| (FILES[0].to_owned(), Content::made(optimized))),
            Some((FILES[1].to_owned(), Content::Document)),
            Some((FILES[2].to_owned(), Content::Page)),
        ]
        .into_iter()
        .flatten()
        .collect(),
        quiet: args.scene.quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    answer.deliver(folder.as_ref(), shown)?;
    Ok(match (found.complete, found.is_answered()) {
        (false, _) => interrupt::status(),
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
    })
}
