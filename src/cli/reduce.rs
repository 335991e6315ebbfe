//! `dam reduce`: the smallest scene that gives figures within their accuracy.

use super::accuracy;
use super::answer::{Answer, AnswerForm, Content, PAGE};
use super::args::ReduceArgs;
use super::asker::Asker;
use super::failure::Failure;
use super::input::print_doubts;
use super::interrupt;
use super::output::OutputFolder;
use super::status::Status;
use crate::ask::ModelAssessment;
use crate::frontend::lower::lower;
use crate::frontend::scene::Overrides;
use crate::report::diagram::Diagram;
use crate::report::findings::Source;
use crate::report::reduce::{self as shown, findings};
use crate::studies::reduce::reduce;

const FILES: [&str; 3] = ["reduced.json", "reduction.json", PAGE];

/// Runs the command.
pub(crate) fn command(args: &ReduceArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let accuracy = accuracy::setting(&args.accuracy, &args.figure)?;
    let ready = input.prepare_judging(&accuracy, ModelAssessment::Never)?;
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let quiet = args.scene.quiet;
    print_doubts(&ready.reading, quiet);
    let given = Diagram::of(ready.system.model());
    let hash = ready.scene().hash.clone();
    let settings = ready.settings.clone();
    let mut keeping = None;
    let mut keep = || {
        keeping.get_or_insert_with(|| asker.guard_from_interrupt());
    };
    let (document, budget) = (input.document(), asker.budget());
    let found = reduce(document, ready.reading, &settings, budget, &mut keep)?;
    let reduced = || format!("{}\n", found.document.text());
    let source = Source::scene(found.document.text(), &hash);
    // (What was given stands for one mass where the level is open.)
    let catalogue = input.catalogue();
    let scene = found.document.scene(&catalogue, &Overrides::none());
    let model = scene.ok().and_then(|reading| lower(&reading.scene).ok());
    let diagram = model.as_ref().map_or(given, Diagram::of);
    let answer = Answer {
        command: "reduce",
        findings: &findings(&found, &diagram, source),
        document: shown::document(&found).into(),
        files: vec![
            (FILES[0].to_owned(), Content::made(reduced)),
            (FILES[1].to_owned(), Content::Document),
            (FILES[2].to_owned(), Content::Page),
        ],
        quiet,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    Ok(match (found.complete, found.holds()) {
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
        (false, _) => interrupt::status(),
    })
}
