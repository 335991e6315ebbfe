//! The page of a study of methods.

pub mod charts;
mod table;
mod words;

pub use table::{methods_csv, sweep_csv};

use crate::dynamics::integrate::Method;
use crate::frontend::scene::in_words;
use crate::report::diagram::Diagram;
use crate::report::html::{bar, facts, header, mechanism, scene, shell};
use crate::report::plot::Plots;
use crate::report::quantity::{escape, significant, with_unit};
use crate::report::verdict::{Sort, Verdict as Answer};
use crate::studies::methods::sweep::{Slice, Sweep};
use crate::studies::methods::{MethodLine, ModelError, Point, Study, Verdict};
use charts::{Against, cost, regions, stable_steps, work_precision};
use words::{limits, reference_facts, timing_note};

/// Width of the charts on the page (pixels).
const WIDTH: f64 = 1184.0;
/// Height of the charts.
const HEIGHT: f64 = 560.0;

/// Page of the methods: what it needs beside the study.
#[derive(Clone, Copy, Debug)]
pub struct MethodsReport<'a> {
    /// Title: the scene's name.
    pub title: &'a str,
    /// The object graph of the scene.
    pub diagram: &'a Diagram,
    /// The scene's text.
    pub scene: &'a str,
    /// Version of `dam`.
    pub version: &'a str,
}

/// The page of one study.
pub fn page(report: &MethodsReport<'_>, study: &Study) -> String {
    let subtitle = format!(
        "{} methods on {} of motion; errors of δ relative to max|δ|",
        study.methods.len(),
        with_unit(study.duration, "s", 4)
    );
    let mut body = header(report.title, &subtitle, None);
    body.push_str("<main>\n");
    body.push_str(&recommendation(study));
    body.push_str("<h2>Error against time</h2>\n");
    let mut plots = Plots::default();
    let mut chart = |against, link: &str| {
        let chart = work_precision(study, against);
        bar(link) + &plots.figure(&chart, [WIDTH, HEIGHT], link)
    };
    body.push_str(&chart(Against::Time, "time"));
    body.push_str(timing_note());
    body.push_str("<h2>Error against evaluations</h2>\n");
    body.push_str(&chart(Against::Evaluations, "evaluations"));
    body.push_str(&format!("<h2>Reference</h2>\n{}", reference_facts(study)));
    body.push_str(&models(study));
    body.push_str(&points(study));
    body.push_str(&limits(study));
    body.push_str(&ending(report, &study.hash));
    shell(report.title, &body, &plots.json())
}

/// The page of a study over a parameter.
pub fn sweep_page(report: &MethodsReport<'_>, sweep: &Sweep) -> String {
    let axis = &sweep.axis;
    let subtitle = format!(
        "methods over {} from {} to {}, {} values",
        axis.path,
        value(sweep, axis.from),
        value(sweep, axis.to),
        sweep.slices.len()
    );
    let mut body = header(report.title, &subtitle, Some(&sweep_answer(sweep)));
    body.push_str("<main>\n<h2>Where methods fail</h2>\n");
    let mut plots = Plots::default();
    let height = charts::height_of_regions(sweep);
    body.push_str(&plots.figure(&regions(sweep), [WIDTH, height], ""));
    if let Some(chart) = cost(sweep) {
        body.push_str("<h2>Cost</h2>\n");
        body.push_str(&plots.figure(&chart, [WIDTH, HEIGHT], ""));
        body.push_str(timing_note());
    }
    if let Some(chart) = stable_steps(sweep) {
        body.push_str("<h2>Stable steps</h2>\n");
        body.push_str(&plots.figure(&chart, [WIDTH, 420.0], ""));
    }
    body.push_str(&standings(sweep));
    let hash = sweep.slices.first().map_or("", |s| s.study.hash.as_str());
    body.push_str(&ending(report, hash));
    shell(report.title, &body, &plots.json())
}

/// The methods that are accurate everywhere.
fn sweep_answer(sweep: &Sweep) -> Answer {
    let good = |slice: &Slice, method: Method| {
        let standing = slice.standing(method);
        standing.is_some_and(|standing| standing.verdict == Verdict::Converged)
    };
    let everywhere: Vec<&str> = charts::methods(sweep)
        .into_iter()
        .filter(|&method| sweep.slices.iter().all(|slice| good(slice, method)))
        .map(Method::name)
        .collect();
    let count = sweep.slices.len();
    match everywhere.is_empty() {
        true => Answer::answer(
            Sort::Numerical,
            "No method is accurate at every value.".to_owned(),
            "The table of values says where each of them fails.".to_owned(),
        ),
        false => Answer::answer(
            Sort::Good,
            format!(
                "{} of the methods are accurate everywhere.",
                everywhere.len()
            ),
            format!("At all {count} values: {}.", everywhere.join(", ")),
        ),
    }
}

/// A value of the axis for reading.
fn value(sweep: &Sweep, x: f64) -> String {
    let text = format!("{} {}", significant(x, 6), sweep.axis.unit);
    text.trim_end().to_owned()
}

/// Mechanism, scene and provenance.
fn ending(report: &MethodsReport<'_>, hash: &str) -> String {
    let rows = [
        ("Scene", report.title.to_owned()),
        ("SHA-256 of the canonical scene", hash.to_owned()),
        ("Program", format!("dam {}", report.version)),
    ];
    format!(
        "{}{}</main>\n<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
        mechanism(report.diagram),
        scene(report.scene),
        facts(&rows)
    )
}

fn recommendation(study: &Study) -> String {
    let class = if study.recommendation.method.is_some() {
        "good"
    } else {
        "numerical"
    };
    let head = match &study.recommendation.method {
        Some(method) => format!("Take {method}."),
        None => "No method is known to be accurate enough.".to_owned(),
    };
    let interrupted = match study.complete {
        true => "",
        false => " Interrupted: points that were not run are missing.",
    };
    format!(
        "<p class=\"verdict {class}\"><span class=\"sort\">Recommendation</span><b>{}</b> {}.{interrupted}</p>\n",
        escape(&head),
        escape(&study.recommendation.text)
    )
}

/// The class of a verdict in a table.
fn class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Converged => "yes",
        Verdict::NotJudged => "soft",
        _ => "no",
    }
}

/// Table of the models with their errors; nothing where they were not asked for.
fn models(study: &Study) -> String {
    let Some(models) = &study.models else {
        return String::new();
    };
    let row = |model: &ModelError| {
        let role = match (model.levels == models.levels, model.given) {
            (true, true) => "as given; the methods run it",
            (true, false) => "the methods run it",
            (false, true) => "as given",
            (false, false) => "",
        };
        format!(
            "<tr><th>{}</th><td>{}</td><td>{} %</td><td class=\"left\">{role}</td></tr>\n",
            escape(&in_words(&model.levels)),
            model.coordinates,
            significant(100.0 * model.error, 2)
        )
    };
    let rows: String = models.tried.iter().map(row).collect();
    format!(
        "<h2>Models</h2>\n<p class=\"soft\">Error of max|δ| against the continuum that the \
         objects' data describe, of the worst object: the lines across the charts.</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>Model</th><th>coordinates</th>\
         <th>error</th><th class=\"left\"></th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// Table of all points.
fn points(study: &Study) -> String {
    let rows: String = study
        .methods
        .iter()
        .flat_map(|line| line.points.iter().map(|point| point_row(line, point)))
        .collect();
    format!(
        "<h2>Points</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>Method</th>\
         <th>setting</th><th>error of δ</th><th>worst figure</th><th>time</th>\
         <th>evaluations</th><th>switches</th><th>|λ|h</th>\
         <th class=\"left\">verdict</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

fn point_row(line: &MethodLine, point: &Point) -> String {
    let real = |value: Option<f64>| value.map_or("–".to_owned(), |v| significant(v, 2));
    let count = |value: Option<u64>| value.map_or("–".to_owned(), |v| v.to_string());
    let time = point.measured_seconds;
    let worst = point.worst_figure.as_deref();
    let figure = point
        .figures
        .iter()
        .find(|f| Some(f.figure.as_str()) == worst);
    let figure = match figure {
        Some(figure) => format!(
            "<td>{}<span class=\"sub\">{}</span></td>",
            real(figure.error),
            escape(&figure.figure)
        ),
        None => "<td>–</td>".to_owned(),
    };
    let error = match (point.is_reference, point.error) {
        (true, Some(error)) => format!("≤ {}", significant(error, 2)),
        (_, error) => real(error),
    };
    let cause = match point.is_reference {
        true => "the reference",
        false => &point.cause,
    };
    format!(
        "<tr><th>{}</th><td>{}</td><td>{error}</td>{figure}<td>{}</td><td>{}</td><td>{}</td>\
         <td>{}</td><td class=\"left\" style=\"white-space:normal;min-width:300px\">\
         <span class=\"{}\">{}</span><span class=\"sub\">{}</span></td></tr>\n",
        line.method.name(),
        escape(&point.setting()),
        time.map_or("–".to_owned(), |s| with_unit(s, "s", 3)),
        count(point.evaluations),
        count(point.switches),
        point
            .rate_times_step
            .map_or("–".to_owned(), |v| significant(v, 3)),
        class(point.verdict),
        point.verdict.words(),
        escape(cause)
    )
}

/// One row a value, one column a method.
fn standings(sweep: &Sweep) -> String {
    let methods = charts::methods(sweep);
    let head: String = methods
        .iter()
        .map(|method| format!("<th>{method}</th>"))
        .collect();
    let cell = |standing: Option<crate::studies::methods::sweep::Standing>| match standing {
        None => "<td>–</td>".to_owned(),
        Some(standing) => format!(
            "<td title=\"{}\"><span class=\"{}\">{}</span><span class=\"sub\">{}</span></td>",
            escape(&standing.cause),
            class(standing.verdict),
            standing.verdict.words(),
            standing
                .measured_seconds
                .map_or("–".to_owned(), |s| with_unit(s, "s", 3))
        ),
    };
    let rows: String = sweep
        .slices
        .iter()
        .map(|slice| {
            let cells = methods.iter().map(|&method| cell(slice.standing(method)));
            let x = escape(&value(sweep, slice.x));
            format!("<tr><th>{x}</th>{}</tr>\n", cells.collect::<String>())
        })
        .collect();
    format!(
        "<h2>Values</h2>\n<p class=\"soft\">The verdict at the tolerance (or step) asked for; \
         below it the least time in which the method came within the accuracy.</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>{}</th>{head}</tr></thead>\n\
         <tbody>\n{rows}</tbody></table></div>\n",
        escape(&sweep.axis.path)
    )
}
