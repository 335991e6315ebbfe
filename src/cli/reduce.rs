//! `dam reduce`: the smallest scene that gives figures within their accuracy.

use super::accuracy;
use super::args::ReduceArgs;
use super::console;
use super::failure::Failure;
use super::input::Input;
use super::interrupt;
use super::output::{self, OutputFolder, ResultFile};
use super::status::Status;
use crate::ask::Judging;
use crate::report::diagram::Diagram;
use crate::report::reduce::{ReduceReport, document, page, text};
use crate::studies::reduce::{Reduction, reduce};

const FILES: [&str; 3] = ["reduced.json", "reduction.json", "report.html"];

/// Runs the command.
pub(crate) fn command(args: &ReduceArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let accuracy = accuracy::setting(&args.accuracy, &args.figure)?;
    let ready = input.prepare_judging(&accuracy, Judging::Never)?;
    let folder = OutputFolder::asked(&args.out, &ready.scene().name, &FILES)?;
    let quiet = args.scene.quiet;
    if !quiet && !ready.reading.warnings.is_empty() {
        console::diagnose(&ready.reading.warnings);
    }
    let diagram = Diagram::of(ready.system.model());
    let hash = ready.scene().hash.clone();
    let _keeping = interrupt::keep();
    let found = reduce(
        input.document(),
        ready.reading,
        &ready.settings,
        interrupt::budget(),
    )?;
    let files = || Ok(files(&found, &diagram));
    let show = || match args.scene.json {
        true => console::json(&document(&found)),
        false => console::text(&text(&found)),
    };
    output::deliver(folder.as_ref(), "reduce", &hash, files, show)?;
    if let (Some(folder), false) = (&folder, quiet) {
        folder.tell_report();
    }
    Ok(match (found.complete, found.holds()) {
        (true, true) => Status::Answered,
        (true, false) => Status::NotTrusted,
        (false, _) => interrupt::status(),
    })
}

fn files(found: &Reduction, diagram: &Diagram) -> Vec<ResultFile> {
    let report = page(&ReduceReport {
        reduction: found,
        diagram,
        version: env!("CARGO_PKG_VERSION"),
    });
    vec![
        ResultFile::new("reduced.json", format!("{}\n", found.document.text())),
        ResultFile::new("reduction.json", format!("{:#}\n", document(found))),
        ResultFile::new("report.html", report),
    ]
}
