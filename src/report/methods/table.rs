//! Points as CSV.

use crate::report::csv::{number, write};
use crate::studies::methods::sweep::Sweep;
use crate::studies::methods::{MethodLine, Point, Study};
use std::collections::BTreeSet;

const HEAD: [&str; 18] = [
    "method",
    "tolerance",
    "step [s]",
    "verdict",
    "cause",
    "error",
    "is_reference",
    "measured_seconds [s]",
    "repetitions",
    "evaluations",
    "steps",
    "rejected",
    "switches",
    "time [s]",
    "rate_times_step",
    "growth",
    "energy_error",
    "worst_figure",
];

/// Every point as a row (RFC 4180): method, setting, verdict with its cause,
/// error, measured time (it varies from run to run), counts, then the error of
/// every determined figure. Empty: not known.
///
/// # Errors
/// Rows of unequal length.
pub fn methods_csv(study: &Study) -> Result<String, csv::Error> {
    let figures = figures(std::iter::once(study));
    let rows = study.methods.iter().flat_map(|line| {
        let points = line.points.iter();
        points.map(|point| row(line, point, &figures).collect::<Vec<_>>())
    });
    let head = HEAD.iter().map(|name| (*name).to_owned());
    write(head.chain(figure_heads(&figures)), rows)
}

/// CSV over a parameter, whose value is the first column.
///
/// # Errors
/// Rows of unequal length.
pub fn sweep_csv(sweep: &Sweep) -> Result<String, csv::Error> {
    let figures = figures(sweep.slices.iter().map(|slice| &slice.study));
    let figures = &figures;
    let rows = sweep.slices.iter().flat_map(|slice| {
        let points = slice.study.methods.iter();
        let points = points.flat_map(|line| line.points.iter().map(move |point| (line, point)));
        points.map(|(line, point)| {
            let x = std::iter::once(number(slice.x));
            x.chain(row(line, point, figures)).collect::<Vec<_>>()
        })
    });
    let x = match sweep.axis.unit.as_str() {
        "" => sweep.axis.path.clone(),
        unit => format!("{} [{unit}]", sweep.axis.path),
    };
    let head = HEAD.iter().map(|name| (*name).to_owned());
    let head = std::iter::once(x).chain(head);
    write(head.chain(figure_heads(figures)), rows)
}

/// All figures of all points.
fn figures<'s>(studies: impl Iterator<Item = &'s Study>) -> Vec<&'s str> {
    let lines = studies.flat_map(|study| &study.methods);
    let all: BTreeSet<&str> = lines
        .flat_map(|line| &line.points)
        .flat_map(|point| &point.figures)
        .map(|figure| figure.figure.as_str())
        .collect();
    all.into_iter().collect()
}

fn figure_heads(figures: &[&str]) -> impl Iterator<Item = String> {
    figures.iter().map(|figure| format!("error of {figure}"))
}

fn row(line: &MethodLine, point: &Point, figures: &[&str]) -> impl Iterator<Item = String> {
    let real = |value: Option<f64>| value.map(number).unwrap_or_default();
    let count = |value: Option<u64>| value.map(|v| v.to_string()).unwrap_or_default();
    let verdict = serde_json::to_value(point.verdict).unwrap_or_default();
    let cells = [
        line.method.name().to_owned(),
        real(point.tolerance),
        real(point.step),
        verdict.as_str().unwrap_or_default().to_owned(),
        point.cause.clone(),
        real(point.error),
        point.is_reference.to_string(),
        real(point.measured_seconds),
        point.repetitions.to_string(),
        count(point.evaluations),
        count(point.steps),
        count(point.rejected),
        count(point.switches),
        real(point.time),
        real(point.rate_times_step),
        real(point.growth),
        real(point.energy_error),
        point.worst_figure.clone().unwrap_or_default(),
    ];
    let errors: Vec<String> = figures
        .iter()
        .map(|wanted| {
            let found = point.figures.iter().find(|f| f.figure == *wanted);
            real(found.and_then(|figure| figure.error))
        })
        .collect();
    cells.into_iter().chain(errors)
}
