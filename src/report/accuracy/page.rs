//! What the figures of a run are worth, on its page.

use super::{asked_rule, worth};
use crate::frontend::scene::in_words;
use crate::report::plot::{Axis, Mark, Plot, Plots, Series, Shape};
use crate::report::quantity::{escape, with_unit};
use crate::studies::order::{Certificate, FigureAccuracy, Tried};
use std::fmt::Write as _;

/// The section: a table of figures, one of objects, and the error of every model tried.
pub(in crate::report) fn section(certificate: &Certificate, plots: &mut Plots) -> String {
    let mut out = String::from(
        "<h2>Accuracy</h2>\n<p>How far each figure may be from that of the continuum that the \
         objects' data describe: the error of the model included.</p>\n",
    );
    out.push_str(&figures(certificate));
    if !certificate.models.is_empty() {
        out.push_str(&objects(certificate));
    }
    if let Some(chart) = chart(certificate) {
        out.push_str(&plots.figure(&chart, [900.0, 420.0], ""));
    }
    out
}

fn table(head: &[&str], rows: &str) -> String {
    let head: String = head.iter().map(|name| format!("<th>{name}</th>")).collect();
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}</tbody>\
         </table></div>\n"
    )
}

fn figures(certificate: &Certificate) -> String {
    let mut rows = String::new();
    for (name, figure) in &certificate.accuracy {
        let value = with_unit(figure.value, &figure.unit, 6);
        let limit = figure
            .limit
            .map_or(String::new(), |limit| with_unit(limit, &figure.unit, 6));
        let why = figure.why.as_ref().map_or(String::new(), |why| {
            format!("<br><span class=\"soft\">{}</span>", escape(why))
        });
        let _ = writeln!(
            rows,
            "<tr><th>{}</th><td>{value}</td><td>{}{why}</td><td>{limit}</td></tr>",
            escape(name),
            escape(&worth(figure)),
        );
    }
    table(&["Figure", "value", "error", "limit"], &rows)
}

fn objects(certificate: &Certificate) -> String {
    let mut rows = String::new();
    for (id, model) in &certificate.models {
        let less = model.next_cheaper.as_ref().map_or(String::new(), |less| {
            let unit = certificate
                .accuracy
                .get(&less.figure)
                .map_or("", |one| &one.unit);
            let off = with_unit(less.error, unit, 2);
            format!("{}: {} is {off} off", less.level, less.figure)
        });
        let _ = writeln!(
            rows,
            "<tr><th>{}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(id),
            escape(&model.level.to_string()),
            escape(&model.why),
            escape(&less),
        );
    }
    table(&["Object", "model", "why", "next cheaper"], &rows)
}

/// Relative errors below this are drawn at it.
const LEAST: f64 = 1e-12;

/// Error of each figure over the coordinates of the model, every model tried a mark.
fn chart(certificate: &Certificate) -> Option<Plot> {
    let limits = certificate.accuracy.iter().filter_map(|(name, figure)| {
        let limit = figure.limit.filter(|limit| *limit != 0.0)?;
        Some((name, figure, limit))
    });
    let series: Vec<Series> = limits
        .map(|(name, figure, limit)| {
            let points = certificate.tried.iter().filter_map(|tried| {
                let value = tried.values.get(name).copied().flatten()?;
                let error = ((value - limit) / limit).abs().max(LEAST);
                Some((
                    (tried.coordinates as f64, error),
                    mark(tried, figure, value),
                ))
            });
            let (points, marks): (Vec<_>, Vec<_>) = points.unzip();
            Series {
                marks,
                ..Series::line(name, points)
            }
        })
        .collect();
    if series.is_empty() {
        return None;
    }
    Some(Plot {
        id: "models".to_owned(),
        title: "Distance of each figure from its limit, over the size of the model".to_owned(),
        x: Axis::new("coordinates of all elastic objects", ""),
        y: Axis {
            log: true,
            ..Axis::new("distance from the limit", "")
        },
        series,
        rules: asked_rule(certificate),
        ..Plot::default()
    })
}

/// Filled for the model chosen, open for the others.
fn mark(tried: &Tried, figure: &FigureAccuracy, value: f64) -> Mark {
    let chosen = if tried.chosen { ", chosen" } else { "" };
    Mark {
        shape: if tried.chosen {
            Shape::Good
        } else {
            Shape::Open
        },
        note: format!(
            "{}{chosen}: {}",
            in_words(&tried.levels),
            with_unit(value, &figure.unit, 6)
        ),
    }
}
