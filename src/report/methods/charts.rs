//! Charts of methods: error against time and work, and over a parameter.

use crate::analysis::methods::sweep::Sweep;
use crate::analysis::methods::{MethodLine, Point, Study, Verdict, all_methods};
use crate::integrate::Method;
use crate::report::quantity::{significant, with_unit};
use crate::report::svg::log_chart::{LogChart, LogPoint, Mark, Series};
use crate::report::svg::strips::{Kind, Strips};

/// Errors above this are beyond the chart.
const CEILING: f64 = 10.0;

/// All verdicts with their colours, and whether they are failures.
const VERDICTS: [(Verdict, &str, bool); 10] = [
    (Verdict::Converged, "#8fc7a3", false),
    (Verdict::Inaccurate, "#f0c36b", true),
    (Verdict::Unstable, "#e0705a", true),
    (Verdict::StepFloor, "#b08ac6", true),
    (Verdict::SwitchesMissed, "#f0996b", true),
    (Verdict::Chatter, "#d97aa6", true),
    (Verdict::Refused, "#c9ced5", true),
    (Verdict::GaveUp, "#8d97a3", true),
    (Verdict::TimeLimit, "#9db8d6", true),
    (Verdict::NotJudged, "#eef0f3", false),
];

/// What an error is plotted against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// Median wall-clock time.
    Time,
    /// Evaluations of the right-hand side.
    Evaluations,
}

/// The same colour and shape for a method on every chart.
fn style(method: Method) -> usize {
    let place = all_methods().iter().position(|&known| known == method);
    place.unwrap_or(0)
}

/// Error against time or evaluations, one line a method.
pub fn work_precision(study: &Study, against: Against) -> LogChart {
    let (name, label) = match against {
        Against::Time => ("time", "median wall-clock time, s"),
        Against::Evaluations => ("evaluations", "evaluations of the right-hand side"),
    };
    let refused: Vec<&str> = study
        .methods
        .iter()
        .filter(|line| line.points.iter().all(|p| p.verdict == Verdict::Refused))
        .map(|line| line.method.name())
        .collect();
    let refused = match refused.is_empty() {
        true => String::new(),
        false => format!(" (refused: {})", refused.join(", ")),
    };
    let reference = study.reference.as_ref();
    let shaded = reference.filter(|r| r.resolution > 3e-15);
    LogChart {
        title: format!("{}: error against {name}{refused}", study.scene),
        x_label: label.to_owned(),
        y_label: "error of δ relative to max|δ|".to_owned(),
        linear_x: false,
        ceiling: Some(CEILING),
        series: study
            .methods
            .iter()
            .map(|line| series(line, against))
            .filter(|series| !series.points.is_empty())
            .collect(),
        rules: vec![(
            study.accuracy,
            format!("asked for: {}", significant(study.accuracy, 2)),
        )],
        shaded_below: shaded.map(|r| (r.resolution, "cannot be told from no error".to_owned())),
        lane: "failed".to_owned(),
    }
}

fn series(line: &MethodLine, against: Against) -> Series {
    let points = line.points.iter().filter_map(|point| {
        let x = match against {
            Against::Time => point.measured_seconds?,
            // A method that evaluates no right-hand side has no place here.
            Against::Evaluations => point.evaluations.filter(|&count| count > 0)? as f64,
        };
        Some(LogPoint {
            x,
            y: position(point),
            mark: mark(point),
            note: note(line.method, point),
        })
    });
    Series {
        label: line.method.name().to_owned(),
        style: style(line.method),
        bare: false,
        points: points.collect(),
    }
}

/// The error as it is drawn; a point that failed altogether has none.
fn position(point: &Point) -> Option<f64> {
    match point.verdict {
        Verdict::Converged | Verdict::Inaccurate | Verdict::SwitchesMissed => {
            // No difference at all lies at the foot of every chart.
            point.error.map(|error| error.max(1e-16))
        }
        _ => point
            .error
            .filter(|error| *error > 0.0 && *error <= CEILING),
    }
}

fn mark(point: &Point) -> Mark {
    match point.verdict {
        Verdict::Converged if point.is_reference => Mark::AtMost,
        Verdict::Converged => Mark::Good,
        Verdict::Inaccurate | Verdict::NotJudged => Mark::Open,
        _ => Mark::Cross,
    }
}

fn note(method: Method, point: &Point) -> String {
    let error = point.error.map_or(String::new(), |error| {
        format!(", error {}", significant(error, 2))
    });
    let time = point.measured_seconds.map_or(String::new(), |seconds| {
        format!(", {}", with_unit(seconds, "s", 3))
    });
    format!(
        "{method} at {}{error}{time}: {}: {}",
        point.setting(),
        point.verdict.words(),
        point.cause
    )
}

/// The axis of a study over a parameter, for labels.
fn axis_label(sweep: &Sweep) -> String {
    match sweep.axis.unit.as_str() {
        "" => sweep.axis.path.clone(),
        unit => format!("{}, {unit}", sweep.axis.path),
    }
}

/// The methods of a study over a parameter.
pub(super) fn methods(sweep: &Sweep) -> Vec<Method> {
    let first = sweep.slices.first();
    let lines = first.iter().flat_map(|slice| &slice.study.methods);
    lines.map(|line| line.method).collect()
}

/// Least time to the asked accuracy over the parameter; `None` without slices.
pub fn cost(sweep: &Sweep) -> Option<LogChart> {
    let study = &sweep.slices.first()?.study;
    let series = methods(sweep).into_iter().map(|method| Series {
        label: method.name().to_owned(),
        style: style(method),
        bare: false,
        points: sweep
            .slices
            .iter()
            .filter_map(|slice| {
                let standing = slice.standing(method)?;
                let reached = standing.measured_seconds.is_some();
                (standing.verdict != Verdict::Refused).then(|| LogPoint {
                    x: slice.x,
                    y: standing.measured_seconds,
                    mark: if reached { Mark::Good } else { Mark::Cross },
                    note: format!(
                        "{method} at {}: {}: {}",
                        sweep.axis.written(slice.x),
                        standing.verdict.words(),
                        standing.cause
                    ),
                })
            })
            .collect(),
    });
    Some(LogChart {
        title: format!(
            "{}: time to an error of {} of max|δ|",
            study.scene,
            significant(study.accuracy, 2)
        ),
        x_label: axis_label(sweep),
        y_label: "least median wall-clock time, s".to_owned(),
        linear_x: !sweep.axis.log,
        ceiling: None,
        series: series.filter(|series| !series.points.is_empty()).collect(),
        rules: Vec::new(),
        shaded_below: None,
        lane: "not reached".to_owned(),
    })
}

/// Greatest stable steps over the parameter, measured and by theory; `None`
/// when no method of fixed step is among the methods.
pub fn stable_steps(sweep: &Sweep) -> Option<LogChart> {
    let mut series = Vec::new();
    for method in methods(sweep) {
        let standings = || {
            let slices = sweep.slices.iter();
            slices.filter_map(move |slice| Some((slice.x, slice.standing(method)?)))
        };
        let point = |x: f64, y: f64| LogPoint {
            x,
            y: Some(y),
            mark: Mark::Good,
            note: format!("{method} at {}: {y:.3e} s", sweep.axis.written(x)),
        };
        let measured: Vec<LogPoint> = standings()
            .filter_map(|(x, s)| Some(point(x, s.stable_step?)))
            .collect();
        if measured.is_empty() {
            continue;
        }
        let theory = standings().filter_map(|(x, s)| Some(point(x, s.stable_step_by_theory?)));
        series.push(Series {
            label: format!("{method}, theory"),
            style: style(method),
            bare: true,
            points: theory.collect(),
        });
        series.push(Series {
            label: format!("{method}, measured"),
            style: style(method),
            bare: false,
            points: measured,
        });
    }
    let named = |step: f64| (step, "step of the verdicts".to_owned());
    (!series.is_empty()).then(|| LogChart {
        title: "Greatest stable step".to_owned(),
        x_label: axis_label(sweep),
        y_label: "step, s".to_owned(),
        linear_x: !sweep.axis.log,
        ceiling: None,
        series,
        rules: sweep.fixed_step.map(named).into_iter().collect(),
        shaded_below: None,
        lane: String::new(),
    })
}

/// Where each method fails over the parameter.
pub fn regions(sweep: &Sweep) -> Strips {
    let kind = |verdict: Verdict| VERDICTS.iter().position(|entry| entry.0 == verdict);
    let row = |method: Method| {
        let kinds = sweep.slices.iter();
        let kinds = kinds.map(|slice| kind(slice.standing(method)?.verdict));
        (method.name().to_owned(), kinds.collect())
    };
    let accuracy = sweep.slices.first().map_or(0.0, |s| s.study.accuracy);
    let fixed = sweep.fixed_step.map_or(String::new(), |step| {
        format!(", methods of fixed step at {}", with_unit(step, "s", 3))
    });
    Strips {
        title: format!(
            "What becomes of each method at tolerance {}{fixed}",
            significant(accuracy, 2)
        ),
        x_label: axis_label(sweep),
        log: sweep.axis.log,
        x: sweep.slices.iter().map(|slice| slice.x).collect(),
        rows: methods(sweep).into_iter().map(row).collect(),
        kinds: VERDICTS
            .iter()
            .map(|&(verdict, colour, hatched)| Kind {
                name: verdict.words().to_owned(),
                colour,
                hatched,
            })
            .collect(),
    }
}
