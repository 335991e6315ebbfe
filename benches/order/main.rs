//! How good are the errors that are stated of models? Random scenes of all regimes
//! ([`cases`]), judged by `dam` and held against long chains of masses, which share nothing
//! with the modes that are chosen where pairs stay closed. Prints a table in Markdown:
//! `cargo bench --package dam-benches --bench order -- docs/model-order.md` writes it.

// It prints, as a program does.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod cases;

use cases::{Case, OF_EACH, SEED, cases};
use dam::ask::ModelAssessment;
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::order::{Certainty, Certificate, FigureAccuracy};
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

/// Accuracy that is asked for.
const ASKED: &str = "1 %";
/// Masses of the long chains, each twice the one before.
const CHAINS: [usize; 4] = [64, 128, 256, 512];

/// A figure of a case, with where it leads by long chains.
struct Row {
    case: String,
    figure: &'static str,
    found: FigureAccuracy,
    limit: f64,
    /// How far the limit itself may be off: what the last doubling changed in it.
    doubt: f64,
    coordinates: usize,
    /// Coordinates of the finest model that was run to judge it.
    finest: usize,
}

impl Row {
    fn off(&self) -> f64 {
        (self.found.value - self.limit).abs()
    }

    /// True when the interval that is stated holds the limit; `doubt` allows for what is not
    /// known of the limit itself.
    fn covers(&self, doubt: f64) -> Option<bool> {
        let error = self.found.error?;
        Some(self.off() <= error + doubt)
    }
}

fn main() {
    let mut rows = Vec::new();
    for case in cases() {
        let begun = Instant::now();
        let certificate = judged(&case);
        let whole = begun.elapsed().as_secs_f64();
        let limits = limits(&case);
        for (&figure, (limit, doubt)) in case.figures.iter().zip(limits) {
            let found = certificate.accuracy[figure].clone();
            let coordinates = certificate.models.values().map(|one| one.coordinates).sum();
            let finest = certificate.tried.iter().map(|one| one.coordinates).max();
            let case = format!("{} {}", case.regime, case.number);
            rows.push(Row {
                case,
                figure,
                found,
                limit,
                doubt,
                coordinates,
                finest: finest.unwrap_or(coordinates),
            });
        }
        eprintln!("{} {}: {whole:.2} s", case.regime, case.number);
    }
    let text = document(&rows);
    // Cargo itself adds `--bench`.
    match std::env::args().skip(1).find(|path| !path.starts_with('-')) {
        Some(path) => {
            let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
            std::fs::write(root.join(path), text).expect("a file that can be written");
        }
        None => print!("{text}"),
    }
}

/// The model of a case chosen by `dam`, and what is said of its figures.
fn judged(case: &Case) -> Certificate {
    let asked: Vec<String> = (case.figures.iter())
        .map(|figure| format!(r#""{figure}": "{ASKED}""#))
        .collect();
    let text = case.scene(r#""masses": "auto""#);
    let text = text.replacen(
        r#""samples": 10"#,
        &format!(r#""samples": 10, "accuracy": {{ {} }}"#, asked.join(", ")),
        1,
    );
    let reading = Scene::from_json(&text).and_then(|scene| scene.decode());
    let reading = reading.unwrap_or_else(|error| panic!("{text}\n{error}"));
    let made = Mechanism::of_within(reading, ModelAssessment::Asked, &Control::default());
    let made = made.unwrap_or_else(|error| panic!("{text}\n{error}"));
    made.certificate.expect("a certificate")
}

/// Where each figure of a case leads by long chains, extrapolated in the order that they
/// show, and how far that may be off.
fn limits(case: &Case) -> Vec<(f64, f64)> {
    let runs: Vec<RunResult> = (CHAINS.iter())
        .map(|masses| {
            let lumping = case.lumping;
            let level = format!(r#""masses": {masses}, "lumping": "{lumping}""#);
            let text = case.scene(&level);
            let run = Scene::from_json(&text).and_then(|scene| scene.run());
            run.unwrap_or_else(|error| panic!("{text}\n{error}"))
        })
        .collect();
    let of = |figure: &&str| {
        let value = |run: &RunResult| run.figures.value(figure).expect("a figure");
        let values: Vec<f64> = runs.iter().map(value).collect();
        let before = extrapolated(&values[..3]);
        let limit = extrapolated(&values[1..]);
        (limit, (limit - before).abs())
    };
    case.figures.iter().map(of).collect()
}

/// The limit of three values, each of twice the masses; the last where they show no order.
fn extrapolated(values: &[f64]) -> f64 {
    let changes = [values[1] - values[0], values[2] - values[1]];
    let factor = changes[1] / changes[0];
    match factor > 0.0 && factor < 0.8 {
        true => values[2] + changes[1] * factor / (1.0 - factor),
        false => values[2],
    }
}

fn document(rows: &[Row]) -> String {
    let judged: Vec<&Row> = rows
        .iter()
        .filter(|row| row.found.error.is_some())
        .collect();
    let holding = |doubt: fn(&Row) -> f64| {
        let covers = |row: &&&Row| row.covers(doubt(row)) == Some(true);
        judged.iter().filter(covers).count()
    };
    let (covered, strictly) = (holding(|row| row.doubt), holding(|_| 0.0));
    let within = judged.iter().filter(|row| row.found.holds).count();
    let open = rows.len() - judged.len();
    let mut widths: Vec<f64> = (judged.iter())
        .map(|row| row.found.error.unwrap_or(0.0) / row.off().max(row.doubt).max(1e-300))
        .collect();
    widths.sort_by(f64::total_cmp);
    let median = widths.get(widths.len() / 2).copied().unwrap_or(f64::NAN);
    let finer = |row: &Row| row.finest as f64 / row.coordinates.max(1) as f64;
    let mut finers: Vec<f64> = rows.iter().map(finer).collect();
    finers.sort_by(f64::total_cmp);
    let mut text = format!(
        "# Are the errors that are stated of models true?\n\n\
         {} figures of {} scenes with random parameters (seed {SEED}, {OF_EACH} of each regime). Each is run with \
         `\"masses\": \"auto\"` and the accuracy\n{ASKED}. The truth here is the continuum that the objects' data \
         describe, not a machine.\n\n\
         - The limits are those of chains of {:?} masses of `dam` itself, extrapolated in the order that they show. \
         Their doubt is\n  the change by the last doubling.\n\
         - The chains are balanced if no contact may open. Else their masses are at the far ends of their cells.\n\
         - Models for closed contacts are chosen among modes, which share nothing with chains. If contacts open, they \
         are chosen among chains too.\n\
         - Behind a contact element they are chosen among modes that agree with chains.\n\n\
         `cargo bench --package dam-benches --bench order -- docs/model-order.md` makes this page. No command of the \
         program does.\n\n\
         - The stated interval holds the limit in {covered} of {} cases ({:.1} %) if the doubt of the limit is \
         allowed for, in {strictly} ({:.1} %) if it is not.\n\
         - The interval is {median:.1} times the true error in the median. The doubt of the limit stands for the \
         error if it is greater.\n\
         - {within} of {} figures are within the accuracy that is asked for.\n\
         - {open} of {} figures {} answered \"no limit\" or \"not determined\" ({:.1} %).\n\
         - To know that a model is enough, finer ones must be run. The finest has {} times the coordinates of the \
         chosen one in the median, and at\n  most {} times. That happens if the first values show nothing of the \
         limit, and a small model comes close to it all the same.\n\
         - The least model is chosen, whatever was run.\n\n\
         | scene | figure | value | stated ± | true error | limit ± doubt | coordinates | finest run | |\n\
         | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
        rows.len(),
        rows.len() / 2,
        CHAINS,
        judged.len(),
        100.0 * covered as f64 / judged.len() as f64,
        100.0 * strictly as f64 / judged.len() as f64,
        judged.len(),
        rows.len(),
        if open == 1 { "is" } else { "are" },
        100.0 * open as f64 / rows.len() as f64,
        finers[finers.len() / 2],
        finers[finers.len() - 1],
    );
    for row in rows {
        let percent = |value: f64| format!("{:.2e} %", 100.0 * value / row.limit.abs());
        let stated = row.found.error.map_or("–".to_owned(), percent);
        let remark = match (row.found.kind, row.covers(row.doubt)) {
            (Certainty::NoLimit, _) => "no limit",
            (Certainty::NotDetermined, _) => "not determined",
            (_, Some(false)) => "NOT COVERED",
            _ => "",
        };
        let _ = writeln!(
            text,
            "| {} | {} | {:.6e} | {stated} | {} | {:.6e} ± {} | {} | {} | {remark} |",
            row.case,
            row.figure,
            row.found.value,
            percent(row.off()),
            row.limit,
            percent(row.doubt),
            row.coordinates,
            row.finest,
        );
    }
    text
}
