//! `dam run`: the motion of a scene and its figures.

use super::answer::{Answer, AnswerForm, Content, Document as Written, PAGE, files as files_of};
use super::args::{Columns, RunArgs};
use super::asker::Asker;
use super::console;
use super::expected::Expectations;
use super::failure::Failure;
use super::input::{Ready, print_doubts};
use super::interrupt::{self, Stage};
use super::output::OutputFolder;
use super::progress::Progress;
use super::status::Status;
use crate::ask::ModelAssessment;
use crate::budget::Instant;
use crate::dynamics::integrate::{Sink, Stop};
use crate::dynamics::model::Model;
use crate::dynamics::record::Figures;
use crate::frontend::scene::Expected;
use crate::report::abscissa::Abscissa;
use crate::report::accuracy;
use crate::report::csv::record_csv;
use crate::report::diagram::Diagram;
use crate::report::findings::Source;
use crate::report::machine::Machine;
use crate::report::run::{RunReport, findings, switches_csv};
use crate::studies::cam::disc_cams;
use crate::studies::expectations::{Verdict, check};
use crate::studies::judgement::RunDocument;
use crate::studies::limit::without_limit;
use crate::studies::order::Certificate;
use crate::studies::rigid::{Rigid, elastic_objects};
use crate::studies::run::{RunResult, run};
use crate::studies::spread::{Spread, repeat_with_changes};
use crate::studies::{RunSettings, lookup, plausible};
use serde::Serialize;
use serde_json::Value;

const FILES: [&str; 5] = [
    "summary.json",
    "record.csv",
    "switches.csv",
    PAGE,
    "timing.json",
];

/// The document of a run: the figures, and what else was asked for.
#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    judged: RunDocument<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    spread: Option<&'a Spread>,
    /// The label of results in `studies` that take elastic objects for rigid.
    #[serde(skip_serializing_if = "Option::is_none")]
    rigid: Option<&'a Rigid>,
    #[serde(skip_serializing_if = "<[Verdict]>::is_empty")]
    expect: &'a [Verdict],
    /// Doubts about the scene's text, with its places.
    #[serde(skip_serializing_if = "Option::is_none")]
    diagnostics: Option<Value>,
}

/// A document, with what the figures are worth where that was judged.
#[derive(Serialize)]
#[serde(untagged)]
enum CertifiedDocument<'a> {
    Alone(&'a Document<'a>),
    With(Value),
}

impl<'a> CertifiedDocument<'a> {
    fn new(document: &'a Document<'a>, certificate: Option<&Certificate>) -> Self {
        let value = certificate.map(|certificate| {
            let mut value = serde_json::to_value(document).unwrap_or_default();
            accuracy::add_to(&mut value, certificate);
            value
        });
        value.map_or(Self::Alone(document), Self::With)
    }
}

/// Runs the command.
pub(crate) fn command(args: &RunArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let accuracy = super::accuracy::setting(&args.accuracy, &[])?;
    let mut ready = input.prepare_judging(&accuracy, ModelAssessment::Asked)?;
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let quiet = args.scene.quiet;
    print_doubts(&ready.reading, quiet);
    let known_before = &ready.system.model().warnings;
    if !quiet {
        for warning in known_before {
            console::print_message(&format!("warning: {warning}"));
        }
    }
    let control = asker.budget();
    let begun = Instant::now();
    let mut settings = ready.settings.clone();
    let files = folder.is_some() || asker.wants_files();
    let over = abscissa(args.abscissa.as_deref(), ready.system.model(), files)?;
    if let Some(columns) = args.record {
        refuse_unused(columns, files, ready.system.model())?;
        settings.masses = columns == Columns::All;
    }
    settings.closeups = files;
    if !files && !plausible::needs_samples(ready.system.model()) {
        // The record goes into files only.
        settings.samples = 0;
    }
    let mut result = run_with_progress((&ready, asker), &settings, quiet)?;
    warn_of_no_limit(&ready, &mut result.figures);
    let rigid = warn_of_rigid(ready.system.model(), &mut result.figures);
    let seconds = begun.elapsed().as_secs_f64();
    let spread = if args.spread {
        let found = repeat_with_changes(&ready.system, &ready.settings, &result, control)
            .map_err(|faults| ready.reading.places.diagnose(&faults))?;
        Some(found)
    } else {
        None
    };
    if let Some(spread) = &spread {
        let certificate = ready.certificate.take();
        ready.certificate = certificate.map(|found| found.with_spread(spread));
    }
    let shortfalls = ready.shortfalls();
    result.figures.warnings.extend(shortfalls.iter().cloned());
    // Another mechanism than the scene's has no expectations.
    let as_scene = args.scene.set.is_empty();
    let all = &ready.scene().expect;
    let expected = Expectations::judge_scene("run", all, as_scene, |all| check(all, &result));
    let document = Document {
        judged: RunDocument::of(&result.figures),
        spread: spread.as_ref(),
        rigid: rigid.as_ref(),
        expect: expected.verdicts(),
        diagnostics: doubts(&ready),
    };
    let certificate = ready.certificate.as_ref();
    let model = ready.system.model();
    let cams = disc_cams(ready.scene(), model);
    let report = RunReport {
        figures: &result.figures,
        record: &result.record,
        diagram: &Diagram::of(model),
        machine: Some(Machine { model, cams: &cams }),
        certificate,
        spread: spread.as_ref(),
        over: &over,
    };
    let timing = || {
        let timing = serde_json::json!({ "dam": 1, "scene": ready.scene().name, "run_s": seconds });
        format!("{timing:#}\n")
    };
    let record = match files {
        true => record_csv(&result.record, &over)?,
        false => String::new(),
    };
    let contents = [
        Content::Document,
        Content::made(|| record.clone()),
        Content::made(|| switches_csv(&result.record, &result.figures)),
        Content::Page,
        Content::made(timing),
    ];
    let answer = Answer {
        command: "run",
        findings: &findings(&report, Source::scene(input.text(), &ready.scene().hash)),
        document: Written::made(|| CertifiedDocument::new(&document, certificate)),
        files: files_of(FILES, contents),
        // Warnings are told in their time.
        quiet: true,
    };
    let shown = AnswerForm::json_or(args.scene.json, AnswerForm::Text);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    if !quiet {
        print_summary(&ready, &result, &expected, seconds);
        if let Some(folder) = &folder {
            folder.print_report_path();
        }
    }
    Ok(
        match (status(&result, expected.verdicts()), shortfalls.is_empty()) {
            (Status::Answered, false) => Status::NotTrusted,
            (status, _) => status,
        },
    )
}

/// What charts and the record are drawn over.
pub(super) fn abscissa(
    asked: Option<&str>,
    model: &Model,
    files: bool,
) -> Result<Abscissa, Failure> {
    match asked {
        None => Ok(Abscissa::Time),
        Some(_) if !files => Err(Failure::Other(
            "--abscissa has no effect: charts and records are files of --out".to_owned(),
        )),
        Some(text) => Abscissa::parse(text, model)
            .map_err(|what| Failure::Other(format!("--abscissa: {what}"))),
    }
}

/// Refuses columns that no record has.
fn refuse_unused(columns: Columns, files: bool, model: &Model) -> Result<(), Failure> {
    let why = match columns {
        _ if !files => "--record has no effect: the record is a file of --out",
        Columns::All if elastic_objects(model).is_empty() => {
            "--record all has no effect: no object has masses of its own"
        }
        Columns::All | Columns::Objects => return Ok(()),
    };
    Err(Failure::Other(why.to_owned()))
}

/// Warns of figures that the scene expects and that have no limit with the number of masses.
fn warn_of_no_limit(ready: &Ready, figures: &mut Figures) {
    let scene = ready.scene();
    let asked = scene.expect.iter().filter_map(|one| match &one.what {
        Expected::Figure { figure, .. } => Some(figure.as_str()),
        Expected::Stops { .. } => None,
    });
    let told = without_limit(scene, ready.system.model(), asked, Some(figures));
    figures.warnings.extend(told);
}

/// Warns of results of other studies that take elastic objects for rigid; their label.
fn warn_of_rigid(model: &Model, figures: &mut Figures) -> Option<Rigid> {
    let studies = figures.studies.keys();
    let found: Vec<&str> = (studies.map(String::as_str))
        .filter(|address| lookup::is_rigid(address))
        .collect();
    let label = Rigid::label(model, &["dam run"]).filter(|_| !found.is_empty())?;
    let what = match found.as_slice() {
        [one] => format!("{one} is"),
        several => format!("{} are", several.join(", ")),
    };
    figures.warnings.push(label.words(&what));
    Some(label)
}

/// Doubts about the scene's text, if any, as JSON.
pub(crate) fn doubts(ready: &Ready) -> Option<Value> {
    let warnings = &ready.reading.warnings;
    (!warnings.is_empty()).then(|| warnings.json())
}

/// A run with a progress bar.
pub(crate) fn run_with_progress(
    (ready, asker): (&Ready, &dyn Asker),
    settings: &RunSettings,
    quiet: bool,
) -> Result<RunResult, Failure> {
    interrupt::enter(Stage::Starting);
    let mut progress = Progress::new(&ready.scene().name, settings.duration, quiet, asker);
    let mut sinks: [&mut dyn Sink; 1] = [&mut progress];
    let result = run(&ready.system, settings, asker.budget(), &mut sinks);
    progress.finish();
    let mut result = result.map_err(|faults| ready.reading.places.diagnose(&faults))?;
    let named = lookup::named_in(ready.scene());
    ready.attach(&mut result.figures, named, asker.budget())?;
    Ok(result)
}

fn print_summary(ready: &Ready, result: &RunResult, expected: &Expectations<'_>, seconds: f64) {
    let known_before = &ready.system.model().warnings;
    let found = result.figures.warnings.iter();
    for warning in found.filter(|warning| !known_before.contains(warning)) {
        console::print_message(&format!("warning: {warning}"));
    }
    expected.print_verdicts();
    console::print_message(&format!("computed in {seconds:.3} s"));
}

/// A run that ends as the scene expects, be it by a stop, has answered.
fn status(result: &RunResult, verdicts: &[Verdict]) -> Status {
    if result.outcome.stop == Stop::Interrupted {
        return Status::Interrupted;
    }
    let all_hold = verdicts.iter().all(|verdict| verdict.holds);
    let expected_stop = verdicts
        .iter()
        .any(|verdict| verdict.holds && verdict.what.starts_with("stops"));
    if all_hold && result.is_trusted() && (result.is_complete() || expected_stop) {
        Status::Answered
    } else {
        Status::NotTrusted
    }
}
