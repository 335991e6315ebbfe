//! Which figures are asked for, and how accurately.

use crate::dynamics::model::Model;
use crate::dynamics::record::Figures;
use crate::frontend::scene::{
    Accuracy, AccuracySpec, AllowedValues, Elastic, Expected, TypedScene,
};
use crate::studies::expectations::of_run;
use crate::studies::limit::without_limit;

/// Share of a figure that it may be off by where nothing is said.
pub const USUAL_SHARE: f64 = 0.01;
/// The same as an accuracy.
pub(in crate::studies) const USUAL: Accuracy = Accuracy::Share(USUAL_SHARE);

/// A figure that is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedFigure {
    /// Its address.
    pub figure: String,
    /// How accurate it is to be.
    pub accuracy: Accuracy,
}

/// The figures that a scene asks for: those of `run.accuracy`; else those that it expects;
/// else the greatest |δ| and the contact force of its elastic objects.
pub(in crate::studies) fn requested_figures(
    scene: &TypedScene,
    elastic: &Elastic,
    first: &Figures,
) -> Vec<RequestedFigure> {
    let accuracy = match &scene.run.accuracy {
        Some(AccuracySpec::Figures(figures)) => {
            let one = |(figure, accuracy): &(String, Accuracy)| RequestedFigure {
                figure: figure.clone(),
                accuracy: *accuracy,
            };
            return figures.iter().map(one).collect();
        }
        Some(AccuracySpec::Share(share)) => Accuracy::Share(*share),
        None => USUAL,
    };
    let expected = scene.expect.iter().filter(|one| of_run(one));
    let expected = expected.filter_map(|one| match &one.what {
        Expected::Figure { figure, allowed } => Some((figure, size_of_expected(allowed))),
        Expected::Stops { .. } => None,
    });
    // A share of nothing is nothing.
    let says =
        |(figure, value): &(&String, f64)| depends(figure) && (*value != 0.0 || is_count(figure));
    let expected = expected.filter(says).map(|(figure, _)| figure.clone());
    let mut figures: Vec<String> = expected.collect();
    if figures.is_empty() {
        let open: Vec<&String> = elastic.open_levels().collect();
        let ids = elastic.objects.keys();
        let ids = ids.filter(|id| open.is_empty() || open.contains(id));
        figures = ids
            .flat_map(|id| {
                ["delta_abs", "pair.max_contact_force"].map(|name| format!("{id}.{name}"))
            })
            .filter(|figure| first.value(figure).is_ok())
            .collect();
    }
    figures.dedup();
    let one = |figure| RequestedFigure { figure, accuracy };
    figures.into_iter().map(one).collect()
}

/// Size of an expected value.
fn size_of_expected(allowed: &AllowedValues) -> f64 {
    match *allowed {
        AllowedValues::Near { value, .. } => value.abs(),
        AllowedValues::Between { least, most } => {
            let ends = [least, most].into_iter().flatten();
            ends.fold(0.0, |size, end| size.max(end.abs()))
        }
    }
}

/// False for figures of the computation, and for lists whose length depends on the model.
fn depends(figure: &str) -> bool {
    let of_motion = figure == "run.switches" || figure.starts_with("run.first_times.");
    let computation = figure.starts_with("run.") && !of_motion;
    !computation && !figure.contains(".switch_times.")
}

/// True for figures that count or answer: they are exact, or not.
pub(in crate::studies) fn is_count(figure: &str) -> bool {
    const COUNTS: [&str; 5] = [
        ".pair.separations",
        ".pair.closures",
        ".pair.in_working_order",
        ".standstills",
        "run.switches",
    ];
    COUNTS.iter().any(|count| figure.ends_with(count))
}

/// Why a figure has no limit with the number of masses; `None`: it has one.
pub(in crate::studies) fn no_limit(
    scene: &TypedScene,
    model: &Model,
    figure: &str,
    found: &Figures,
) -> Option<String> {
    let told = without_limit(scene, model, [figure], Some(found));
    told.into_iter().next()
}

impl Accuracy {
    /// The greatest error that it allows of a figure with this limit.
    pub fn bound(self, limit: f64) -> f64 {
        match self {
            Self::Share(share) => share * limit.abs(),
            Self::Bound(bound) => bound,
        }
    }
}
