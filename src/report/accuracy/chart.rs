//! Errors of the models that were tried.

use super::requested_error_line;
use crate::frontend::scene::in_words;
use crate::report::addresses::result_words;
use crate::report::findings::{Layout, Section};
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::with_unit;
use crate::studies::order::{Certificate, FigureAccuracy, TriedModel};

/// Relative errors below this are drawn at it.
pub(in crate::report) const LEAST: f64 = 1e-12;

/// Error of each figure over the coordinates of the model, every model tried a mark.
pub(in crate::report) fn chart_section<'a>(certificate: &Certificate) -> Section<'a> {
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
                    mark_of_model(tried, figure, value),
                ))
            });
            let (points, marks): (Vec<_>, Vec<_>) = points.unzip();
            Series {
                marks,
                ..Series::line(&result_words(name), points)
            }
        })
        .collect();
    if series.is_empty() {
        return Section::default();
    }
    let plot = Plot {
        id: "models".to_owned(),
        title: "Distance of each result from its converged value, over the size of the model"
            .to_owned(),
        x: match sizes_are_counts(certificate) {
            true => Axis::logarithmic("coordinates of all elastic objects", ""),
            false => Axis::new("coordinates of all elastic objects", ""),
        },
        y: Axis::logarithmic("relative distance", ""),
        series,
        rules: requested_error_line(certificate),
        ..Plot::default()
    };
    Section::default().charts(Layout::Wide(420.0), "", vec![plot])
}

/// Whether every model has a coordinate: a rigid one has no place on a logarithmic axis.
fn sizes_are_counts(certificate: &Certificate) -> bool {
    certificate.tried.iter().all(|tried| tried.coordinates > 0)
}

/// Filled for the model chosen, open for the others.
fn mark_of_model(tried: &TriedModel, figure: &FigureAccuracy, value: f64) -> Mark {
    let chosen = if tried.chosen { ", chosen" } else { "" };
    let shape = match tried.chosen {
        true => Shape::Good,
        false => Shape::Open,
    };
    let value = with_unit(value, &figure.unit, 6);
    Mark::new(
        shape,
        format!("{}{chosen}: {value}", in_words(&tried.levels)),
    )
}
