//! Error against cost over models.

use crate::frontend::scene::in_words;
use crate::report::accuracy::{LEAST, requested_error_line};
use crate::report::addresses::result_words;
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::with_unit;
use crate::studies::order::FigureAccuracy;
use crate::studies::reduce::{ModelTried, Reduction, Role};

/// How far each figure may be off by every model that was run, over the time of its run;
/// `None`: no figure has a limit that a share can be taken of.
pub(super) fn chart(reduction: &Reduction) -> Option<Plot> {
    let figures = reduction.certificate.accuracy.iter();
    let series: Vec<Series> = figures
        .filter_map(|(name, figure)| {
            let limit = figure.limit.filter(|limit| *limit != 0.0)?;
            let points = reduction.models.iter().filter_map(|model| {
                let error = (*model.errors.get(name)?)?;
                let share = (error / limit.abs()).max(LEAST);
                let point = (1e3 * model.seconds, share);
                Some((point, mark_of_model(model, figure, error)))
            });
            let mut points: Vec<_> = points.collect();
            points.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
            let (points, marks): (Vec<_>, Vec<_>) = points.into_iter().unzip();
            Some(Series::marked(&result_words(name), points, marks))
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    if series.is_empty() {
        return None;
    }
    Some(Plot {
        id: "models".to_owned(),
        title: "Error of each result against the time of a run, over models".to_owned(),
        x: Axis::logarithmic("time of a run", "ms"),
        y: Axis::logarithmic("error of the result", ""),
        series,
        rules: requested_error_line(&reduction.certificate),
        ..Plot::default()
    })
}

/// Filled for the reduced scene, crossed for the scene as given, open for the others.
fn mark_of_model(model: &ModelTried, figure: &FigureAccuracy, error: f64) -> Mark {
    let levels = in_words(&model.levels);
    let levels = Some(levels).filter(|levels| !levels.is_empty());
    let words = levels.into_iter().chain(model.without.iter().cloned());
    let words: Vec<String> = words.collect();
    let (shape, role) = match model.role {
        Role::Given => (Shape::Cross, "as given, "),
        Role::Tried => (Shape::Open, ""),
        Role::Reduced => (Shape::Good, "the reduced scene, "),
    };
    let off = with_unit(error, &figure.unit, 2);
    Mark::new(shape, format!("{role}{}: {off} off", words.join("; ")))
}
