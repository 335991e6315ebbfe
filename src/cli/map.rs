//! `dam map`: a figure over one or two parameters, with a cause for every point.

use super::answer::{
    Answer, AnswerForm, Content, Document, DocumentWithWarnings, Files, PAGE, files,
};
use super::args::MapArgs;
use super::bar::Bar;
use super::console;
use super::failure::Failure;
use super::input::Input;
use super::interrupt;
use super::journal::{Journal, LARGEST};
use super::output::OutputFolder;
use super::status::Status;
use crate::budget::Instant;
use crate::report::findings::Source;
use crate::report::map::{document, findings, map_rows, picture};
use crate::studies::axis::Axis;
use crate::studies::limit::without_limit;
use crate::studies::map::{
    Cell, Listener, MapResult, Panels, Question, Study, StudyFault, journal, map, map_cells,
};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::{Path, PathBuf};

const FILES: [&str; 5] = ["map.csv", "map.json", "map.svg", PAGE, "timing.json"];

/// Runs the command.
pub(crate) fn command(args: &MapArgs) -> Result<Status, Failure> {
    let question = question(args)?;
    let input = Input::load(&args.scene)?;
    let catalogue = input.catalogue();
    let study =
        Study::new(input.document(), &catalogue, question).map_err(|fault| match fault {
            StudyFault::Scene(diagnostics) => Failure::Scene(diagnostics),
            StudyFault::Question(what) => Failure::Other(what),
        })?;
    if let Some(cells) = &args.cells {
        return print_cells(args, &study, cells);
    }
    let folder = match &args.out.out {
        Some(path) => Some(prepare_folder(args, &study, path)?),
        None => None,
    };
    let (folder, journal, known) = match folder {
        Some((folder, journal, known)) => (Some(folder), Some(journal), known),
        None => (None, None, BTreeMap::new()),
    };
    let known = match args.merge.as_slice() {
        [] => known,
        files => merge_parts(&study, files)?,
    };
    let begun = Instant::now();
    let kept: usize = known.values().map(Vec::len).sum();
    let watch = Watch::new(&study, kept, journal.as_ref(), args.scene.quiet);
    let threads = args.threads.map(usize::from);
    let keeping = interrupt::hold_interrupt();
    let result = map(&study, known, threads, interrupt::budget(), &watch);
    watch.finish();
    let result = result?;
    let seconds = begun.elapsed().as_secs_f64();
    let whole = folder.as_ref().filter(|_| result.complete);
    let command = command_of(args);
    // (A scene that is only whole with the values of the map says nothing.)
    let mut warnings = input
        .prepare_and_warn(args.scene.quiet)
        .map_or(Vec::new(), |ready| {
            let (scene, model) = (ready.scene(), ready.system.model());
            without_limit(scene, model, [study.figure.as_str()], None)
        });
    let source = Source {
        hashed: "the study",
        ..Source::scene(input.text(), &study.hash)
    };
    warnings.extend(study.shortfalls.iter().cloned());
    let told = warnings.clone();
    let answer = Answer {
        command: "map",
        findings: &findings(&study, &result, &command, warnings, source),
        document: Document::made(|| DocumentWithWarnings {
            document: document(&study, &result),
            warnings: &told,
        }),
        files: files_of(&study, &result, seconds),
        quiet: args.scene.quiet,
    };
    // With the files of the whole map its journal goes.
    answer.deliver(
        whole,
        AnswerForm::json_or(args.scene.json, AnswerForm::Text),
    )?;
    drop(keeping);
    if !args.scene.quiet {
        match args.merge.len() {
            0 => print_summary(&study, &result, folder.is_some(), seconds, kept),
            files => super::console::print_message(&format!("{kept} cells of {files} files")),
        }
    }
    Ok(match (status(&result), study.shortfalls.is_empty()) {
        (Status::Answered, false) => Status::NotTrusted,
        (status, _) => status,
    })
}

/// Works out some cells and prints them.
fn print_cells(args: &MapArgs, study: &Study<'_>, cells: &str) -> Result<Status, Failure> {
    let cells = range(cells)?;
    let watch = Watch::new(study, 0, None, args.scene.quiet);
    let threads = args.threads.map(usize::from);
    let budget = interrupt::budget();
    let first = cells.start;
    // What is interrupted is given up: a part is whole or not there.
    let found = map_cells(study, cells, threads, budget, &watch);
    watch.finish();
    let found = found.map_err(|what| format!("--{what}"))?;
    match found {
        Some(found) => console::data(&journal::text_of_cells(study, first, &found))?,
        None => return Ok(interrupt::status()),
    }
    Ok(Status::Answered)
}

/// `FROM:TO`.
fn range(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once(':');
    let ends = ends.and_then(|(from, to)| Some(from.trim().parse().ok()?..to.trim().parse().ok()?));
    ends.ok_or_else(|| format!("--cells {text}: give FROM:TO, as 0:100"))
}

/// The rows of all parts.
fn merge_parts(study: &Study<'_>, files: &[PathBuf]) -> Result<KnownCells, Failure> {
    let read = |path: &PathBuf| {
        let name = path.display().to_string();
        let mut bytes = Vec::new();
        let file = File::open(path).and_then(|file| file.take(LARGEST).read_to_end(&mut bytes));
        match file {
            Ok(_) => Ok((name, bytes)),
            Err(error) => Err(format!("--merge: cannot read `{name}`: {error}")),
        }
    };
    let parts: Result<Vec<(String, Vec<u8>)>, String> = files.iter().map(read).collect();
    let parts = parts?;
    let parts = parts
        .iter()
        .map(|(name, bytes)| (name.as_str(), bytes.as_slice()));
    Ok(journal::merge(study, parts).map_err(|what| format!("--merge: {what}"))?)
}

/// Every cell has its verdict: the question is answered, whatever they are.
fn status(result: &MapResult) -> Status {
    match result.complete {
        true => Status::Answered,
        false => interrupt::status(),
    }
}

fn question(args: &MapArgs) -> Result<Question, Failure> {
    let axis = |name: &str, text: &str| {
        Axis::parse(text).map_err(|what| Failure::Other(format!("--{name} {what}")))
    };
    Ok(Question {
        overrides: args.scene.set.clone(),
        x: axis("x", &args.x)?,
        y: args.y.as_deref().map(|text| axis("y", text)).transpose()?,
        panels: Panels::parse(&args.panels).map_err(|what| format!("--panels {what}"))?,
        figure: args.figure.clone(),
        check_determined: !args.unchecked,
        digits: args.digits,
    })
}

type KnownCells = BTreeMap<usize, Vec<Cell>>;

/// The folder, checked, with its journal and the rows that this one knows.
fn prepare_folder(
    args: &MapArgs,
    study: &Study<'_>,
    path: &Path,
) -> Result<(OutputFolder, Journal, KnownCells), Failure> {
    let folder = OutputFolder::prepare(path, &study.scene, &FILES, args.out.force)?;
    let (journal, known) = Journal::open_journal(path, study, args.resume, args.out.force)?;
    Ok((folder, journal, known))
}

/// The command that runs the scene with the settings of all cells, word by word.
fn command_of(args: &MapArgs) -> Vec<String> {
    let scene = args.scene.scene.display().to_string();
    let mut words = vec!["dam".to_owned(), "run".to_owned(), scene];
    for setting in &args.scene.set {
        words.extend(["--set".to_owned(), setting.clone()]);
    }
    words
}

fn files_of<'a>(study: &'a Study<'a>, result: &'a MapResult, seconds: f64) -> Files<'a> {
    let timing = move || {
        let timing = serde_json::json!({
            "dam": 1, "scene": study.scene, "cells": study.cells(), "map_s": seconds,
        });
        format!("{timing:#}\n")
    };
    let contents = [
        Content::made(|| map_rows(study, result).csv()),
        Content::Document,
        Content::made(|| picture::svg(study, result)),
        Content::Page,
        Content::made(timing),
    ];
    files(FILES, contents)
}

fn print_summary(
    study: &Study<'_>,
    result: &MapResult,
    kept_in_folder: bool,
    seconds: f64,
    kept: usize,
) {
    let known = result.panels.iter().flatten().flatten().count();
    let done = known - kept;
    console::print_message(&format!(
        "{done} cells in {seconds:.3} s, {:.0} cells/s",
        done as f64 / seconds.max(1e-9)
    ));
    if kept > 0 {
        console::print_message(&format!(
            "{kept} cells were known from before the interruption"
        ));
    }
    match (result.complete, kept_in_folder) {
        (false, true) => console::print_message(&format!(
            "interrupted: {known} of {} cells are kept; go on with --resume",
            study.cells()
        )),
        (false, false) => console::print_message("interrupted: nothing is kept without --out"),
        (true, _) => {}
    }
}

/// Keeps finished rows and shows how far the map is.
struct Watch<'a> {
    journal: Option<&'a Journal>,
    bar: Bar,
}

impl<'a> Watch<'a> {
    fn new(study: &Study<'_>, kept: usize, journal: Option<&'a Journal>, quiet: bool) -> Self {
        let template = "{prefix} {bar:30} {pos} of {len} cells, {per_sec}, {eta} left";
        let cells = (kept as u64, Some(study.cells() as u64));
        Self {
            journal,
            bar: Bar::new(template, &study.scene, cells, quiet),
        }
    }

    fn finish(&self) {
        self.bar.finish();
    }
}

impl Listener for Watch<'_> {
    fn cell(&self) {
        self.bar.advance();
    }

    fn row(&self, row: usize, cells: &[Cell]) -> Result<(), String> {
        match self.journal {
            Some(journal) => journal.add(row, cells),
            None => Ok(()),
        }
    }
}
