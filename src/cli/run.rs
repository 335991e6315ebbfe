//! `dam run`: the motion of a scene and its figures.

use super::args::{Columns, RunArgs};
use super::console;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::output::{self, OutputFolder, ResultFile};
use super::progress::Progress;
use super::status::Status;
use super::{interrupt, tables, terminal};
use crate::ask::Judging;
use crate::dynamics::integrate::{Sink, Stop};
use crate::dynamics::record::Figures;
use crate::frontend::scene::Expected;
use crate::report::accuracy;
use crate::report::csv::record_csv;
use crate::report::diagram::Diagram;
use crate::report::html::{RunReport, page};
use crate::report::machine::Machine;
use crate::studies::cam::disc_cams;
use crate::studies::expectations::{Verdict, check, of_run};
use crate::studies::limit::without_limit;
use crate::studies::order::Certificate;
use crate::studies::run::{RunResult, run};
use crate::studies::spread::{Spread, spread};
use crate::studies::{Control, RunSettings, plausible};
use serde::Serialize;
use serde_json::Value;
use std::time::Instant;

const FILES: [&str; 4] = ["summary.json", "record.csv", "report.html", "timing.json"];

/// The document of a run: the figures, and what else was asked for.
#[derive(Serialize)]
struct Document<'a> {
    #[serde(flatten)]
    figures: &'a Figures,
    #[serde(skip_serializing_if = "Option::is_none")]
    spread: Option<&'a Spread>,
    #[serde(skip_serializing_if = "<[Verdict]>::is_empty")]
    expect: &'a [Verdict],
    /// Doubts about the scene's text, with its places.
    #[serde(skip_serializing_if = "Option::is_none")]
    diagnostics: Option<Value>,
}

impl Document<'_> {
    /// As JSON, with what the figures are worth where that was judged.
    fn json(&self, certificate: Option<&Certificate>) -> Result<Value, Failure> {
        let mut document = serde_json::to_value(self).map_err(|error| error.to_string())?;
        if let Some(certificate) = certificate {
            accuracy::add_to(&mut document, certificate);
        }
        Ok(document)
    }
}

/// Runs the command.
pub(crate) fn command(args: &RunArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let accuracy = super::accuracy::setting(&args.accuracy, &[])?;
    let mut ready = input.prepare_judging(&accuracy, Judging::Asked)?;
    let folder = OutputFolder::asked(&args.out, &ready.scene().name, &FILES)?;
    let quiet = args.scene.quiet;
    if !quiet && !ready.reading.warnings.is_empty() {
        console::diagnose(&ready.reading.warnings);
    }
    let known_before = &ready.system.model().warnings;
    if !quiet {
        for warning in known_before {
            console::talk(&format!("warning: {warning}"));
        }
    }
    let control = interrupt::budget();
    let begun = Instant::now();
    let mut settings = ready.settings.clone();
    if let Some(columns) = args.record {
        settings.masses = columns == Columns::All;
    }
    settings.closeups = folder.is_some();
    if folder.is_none() && !plausible::looks_at_samples(ready.system.model()) {
        // The record goes into files only.
        settings.samples = 0;
    }
    let mut result = run_with_progress(&ready, &settings, control, quiet)?;
    warn_of_no_limit(&ready, &mut result.figures);
    let seconds = begun.elapsed().as_secs_f64();
    let spread = if args.spread {
        let found = spread(&ready.system, &ready.settings, &result, control)
            .map_err(|faults| ready.reading.places.diagnose(&faults))?;
        Some(found)
    } else {
        None
    };
    if let Some(spread) = &spread {
        let certificate = ready.certificate.take();
        ready.certificate = certificate.map(|found| found.with_spread(spread));
    }
    // Another mechanism than the scene's has no expectations.
    let changed = !args.scene.set.is_empty();
    let verdicts = if changed {
        Vec::new()
    } else {
        check(&ready.scene().expect, &result)
    };
    let document = Document {
        figures: &result.figures,
        spread: spread.as_ref(),
        expect: &verdicts,
        diagnostics: doubts(&ready),
    };
    let certificate = ready.certificate.as_ref();
    let files = || files(&input, &ready, &result, &document, seconds);
    let show = || match args.scene.json {
        true => match certificate {
            None => console::json(&document),
            Some(_) => console::json(&document.json(certificate)?),
        },
        false => {
            let spread = spread.as_ref().map_or(String::new(), tables::spread);
            let accuracy = certificate.map_or(String::new(), accuracy::text);
            console::text(&(terminal::summary(&result.figures) + &accuracy + &spread))
        }
    };
    output::deliver(folder.as_ref(), "run", &ready.scene().hash, files, show)?;
    if !quiet {
        talk(&ready, &result, &verdicts, seconds);
        if let Some(folder) = &folder {
            folder.tell_report();
        }
    }
    Ok(status(&result, &verdicts))
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

/// Doubts about the scene's text, if any, as JSON.
pub(crate) fn doubts(ready: &Ready) -> Option<Value> {
    let warnings = &ready.reading.warnings;
    (!warnings.is_empty()).then(|| warnings.json())
}

/// A run with a progress bar.
pub(crate) fn run_with_progress(
    ready: &Ready,
    settings: &RunSettings,
    control: &Control<'_>,
    quiet: bool,
) -> Result<RunResult, Failure> {
    let mut progress = Progress::new(&ready.scene().name, settings.duration, quiet);
    let mut sinks: [&mut dyn Sink; 1] = [&mut progress];
    let result = run(&ready.system, settings, control, &mut sinks);
    progress.finish();
    result.map_err(|faults| ready.reading.places.diagnose(&faults).into())
}

fn files(
    input: &Input,
    ready: &Ready,
    result: &RunResult,
    document: &Document<'_>,
    seconds: f64,
) -> Result<Vec<ResultFile>, Failure> {
    let certificate = ready.certificate.as_ref();
    let mut summary = match certificate {
        None => serde_json::to_string_pretty(document),
        Some(_) => serde_json::to_string_pretty(&document.json(certificate)?),
    }
    .map_err(|error| error.to_string())?;
    summary.push('\n');
    let model = ready.system.model();
    let cams = disc_cams(ready.scene(), model);
    let report = page(&RunReport {
        figures: &result.figures,
        record: &result.record,
        diagram: &Diagram::of(model),
        machine: Some(Machine { model, cams: &cams }),
        certificate,
        scene: input.text(),
        version: env!("CARGO_PKG_VERSION"),
    });
    let record = record_csv(&result.record).map_err(|error| error.to_string())?;
    let timing = serde_json::json!({ "dam": 1, "scene": ready.scene().name, "run_s": seconds });
    Ok(vec![
        ResultFile::new(FILES[0], summary),
        ResultFile::new(FILES[1], record),
        ResultFile::new(FILES[2], report),
        ResultFile::new(FILES[3], format!("{timing:#}\n")),
    ])
}

fn talk(ready: &Ready, result: &RunResult, verdicts: &[Verdict], seconds: f64) {
    let known_before = &ready.system.model().warnings;
    let found = result.figures.warnings.iter();
    for warning in found.filter(|warning| !known_before.contains(warning)) {
        console::talk(&format!("warning: {warning}"));
    }
    for verdict in verdicts.iter().filter(|verdict| !verdict.holds) {
        console::talk(&format!("expectation failed: {}", verdict.message));
    }
    let held = verdicts.iter().filter(|verdict| verdict.holds).count();
    if !verdicts.is_empty() {
        console::talk(&format!("expectations: {held} of {} hold", verdicts.len()));
    } else if ready.scene().expect.iter().any(of_run) {
        console::talk("expectations: not judged, --set changes the scene");
    }
    console::talk(&format!("computed in {seconds:.3} s"));
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
