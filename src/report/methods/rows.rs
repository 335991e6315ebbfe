//! Points as rows for other programs.

use crate::report::csv::{Field, Rows};
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

/// Every point as a row: method, setting, verdict with its cause, error, measured time (it varies
/// from run to run), counts, then the error of every determined figure. Empty: not known.
pub fn methods_rows(study: &Study) -> Rows {
    let figures = figures(std::iter::once(study));
    let rows = points(study).map(|(line, point)| row(line, point, &figures));
    Rows::new(column_names(&figures), rows)
}

/// The points over a parameter, whose value is the first column.
pub fn sweep_rows(sweep: &Sweep) -> Rows {
    let figures = figures(sweep.slices.iter().map(|slice| &slice.study));
    let rows = sweep.slices.iter().flat_map(|slice| {
        let rows = points(&slice.study).map(|(line, point)| row(line, point, &figures));
        rows.map(|row| [vec![Field::from(slice.x)], row].concat())
    });
    let x = match sweep.axis.unit.as_str() {
        "" => sweep.axis.path.clone(),
        unit => format!("{} [{unit}]", sweep.axis.path),
    };
    Rows::new(std::iter::once(x).chain(column_names(&figures)), rows)
}

fn points(study: &Study) -> impl Iterator<Item = (&MethodLine, &Point)> {
    let lines = study.methods.iter();
    lines.flat_map(|line| line.points.iter().map(move |point| (line, point)))
}

fn column_names(figures: &[&str]) -> Vec<String> {
    let errors = figures.iter().map(|figure| format!("error of {figure}"));
    let fixed = HEAD.iter().map(|name| (*name).to_owned());
    fixed.chain(errors).collect()
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

fn row(line: &MethodLine, point: &Point, figures: &[&str]) -> Vec<Field> {
    let count = |value: Option<u64>| value.map(|v| v.to_string()).unwrap_or_default();
    let verdict = serde_json::to_value(point.verdict).unwrap_or_default();
    let cells = [
        line.method.name().into(),
        point.tolerance.into(),
        point.step.into(),
        verdict.as_str().unwrap_or_default().into(),
        point.cause.as_str().into(),
        point.error.into(),
        point.is_reference.to_string().into(),
        point.measured_seconds.into(),
        point.repetitions.to_string().into(),
        count(point.evaluations).into(),
        count(point.steps).into(),
        count(point.rejected).into(),
        count(point.switches).into(),
        point.time.into(),
        point.rate_times_step.into(),
        point.growth.into(),
        point.energy_error.into(),
        point.worst_figure.clone().unwrap_or_default().into(),
    ];
    let errors = figures.iter().map(|wanted| {
        let found = point.figures.iter().find(|f| f.figure == *wanted);
        Field::from(found.and_then(|figure| figure.error))
    });
    cells.into_iter().chain(errors).collect()
}
