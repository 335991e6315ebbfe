//! Result files of studies of methods.

use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::cli::output::ResultFile;
use crate::report::diagram::Diagram;
use crate::report::methods::charts::{
    Against, cost, height_of_regions, regions, stable_steps, work_precision,
};
use crate::report::methods::{MethodsReport, methods_csv, page, sweep_csv, sweep_page};
use crate::studies::methods::Study;
use crate::studies::methods::sweep::Sweep;

/// Files of a study.
pub(super) const OF_STUDY: [&str; 5] = [
    "methods.json",
    "methods.csv",
    "error-time.svg",
    "error-evaluations.svg",
    "report.html",
];

/// Files of a study over a parameter; without a method of fixed step there is
/// no chart of stable steps.
pub(super) const OF_SWEEP: [&str; 6] = [
    "methods.json",
    "methods.csv",
    "regions.svg",
    "cost.svg",
    "stable-steps.svg",
    "report.html",
];

/// Size of the pictures (pixels).
const SIZE: (f64, f64) = (900.0, 540.0);

/// The files of a study.
pub(super) fn of_study(
    text: &str,
    ready: &Ready,
    study: &Study,
) -> Result<Vec<ResultFile>, Failure> {
    let csv = methods_csv(study).map_err(|error| error.to_string())?;
    let chart = |against| work_precision(study, against).svg(SIZE.0, SIZE.1);
    let diagram = Diagram::of(ready.system.model());
    let page = page(&report(text, ready, &diagram), study);
    Ok(vec![
        ResultFile::new(OF_STUDY[0], document(study)?),
        ResultFile::new(OF_STUDY[1], csv),
        ResultFile::new(OF_STUDY[2], chart(Against::Time)),
        ResultFile::new(OF_STUDY[3], chart(Against::Evaluations)),
        ResultFile::new(OF_STUDY[4], page),
    ])
}

/// The files of a study over a parameter.
pub(super) fn of_sweep(
    text: &str,
    ready: &Ready,
    sweep: &Sweep,
) -> Result<Vec<ResultFile>, Failure> {
    let csv = sweep_csv(sweep).map_err(|error| error.to_string())?;
    let diagram = Diagram::of(ready.system.model());
    let page = sweep_page(&report(text, ready, &diagram), sweep);
    let mut files = vec![
        ResultFile::new(OF_SWEEP[0], document(sweep)?),
        ResultFile::new(OF_SWEEP[1], csv),
        ResultFile::new(
            OF_SWEEP[2],
            regions(sweep).svg(SIZE.0, height_of_regions(sweep)),
        ),
    ];
    let charts = [
        (OF_SWEEP[3], cost(sweep)),
        (OF_SWEEP[4], stable_steps(sweep)),
    ];
    for (name, chart) in charts {
        files.extend(chart.map(|chart| ResultFile::new(name, chart.svg(SIZE.0, SIZE.1))));
    }
    files.push(ResultFile::new(OF_SWEEP[5], page));
    Ok(files)
}

fn document(document: &impl serde::Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(document).map_err(|error| error.to_string())?;
    text.push('\n');
    Ok(text)
}

fn report<'a>(text: &'a str, ready: &'a Ready, diagram: &'a Diagram) -> MethodsReport<'a> {
    MethodsReport {
        title: &ready.scene().name,
        diagram,
        scene: text,
        version: env!("CARGO_PKG_VERSION"),
    }
}
