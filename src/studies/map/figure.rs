//! The figure that a map shows.

use crate::dynamics::model::{Closure, Model, ObjectPart, owner_of};
use crate::dynamics::record::{AddressError, Figures, ObjectFigures};
use crate::exact::RequestedFigures;
use crate::fault::Fault;
use crate::studies::document::{blank, document, summary};
use crate::studies::expectations::suggest_instead;
use crate::studies::run::Motion;
use crate::studies::{RunSettings, lookup};

/// The figure of a map when none is asked for: the greatest |δ| of the last elastic
/// object, drivers before what they drive; `None` when nothing is elastic.
pub(super) fn default_figure(model: &Model, order: &[String]) -> Option<String> {
    let elastic = |id: &&String| {
        let part = model.objects.iter().find(|part| part.id == **id);
        part.is_some_and(|part| !part.links.is_empty() || part.driven_end.is_some())
    };
    let last = order.iter().rev().find(elastic)?;
    Some(format!("{last}.delta_abs"))
}

/// Why there is no figure to begin with, and which there are in every cell: those
/// of an object's whole motion, which rigid objects and drives have as well.
pub(super) fn no_elastic_object_message(model: &Model) -> String {
    let driven = model.objects.iter().rev().find(|part| !part.is_drive());
    let id = driven.or(model.objects.last());
    let id = id.map_or("object", |part| part.id.as_str());
    let all = ["peak_speed", "peak_acceleration", "peak_reaction"];
    let all = all.map(|name| format!("{id}.{name}")).join(", ");
    format!(
        "nothing in this scene is elastic at the corners and in the middle of the map: there is \
         no δ to map. Name a result with --figure; every cell has for example {all}"
    )
}

/// Checks that a run of a model has a figure.
pub(in crate::studies) fn check_figure(figure: &str, model: &Model) -> Result<(), Fault> {
    if let Some(known) = lookup::check(figure, model) {
        return known;
    }
    let Err(AddressError::Unknown { close }) = blank(model).value(figure) else {
        return Ok(());
    };
    // How many switches there will be is not known before a run.
    if figure.contains(".switch_times.") {
        return Ok(());
    }
    Err(Fault::new(
        "",
        format!("there is no result `{figure}`"),
        suggest_instead(figure, &close),
    ))
}

/// A figure of an object by its name, where it is a number in every run.
fn of_object(figures: &ObjectFigures, name: &str) -> Option<f64> {
    let (pair, stop) = (figures.pair.as_ref(), figures.stop.as_ref());
    Some(match name {
        "delta_abs" => figures.delta_abs,
        "delta_max" => figures.delta_max,
        "delta_min" => figures.delta_min,
        "sigma" => figures.sigma,
        "peak_speed" => figures.peak_speed,
        "peak_acceleration" => figures.peak_acceleration,
        "peak_reaction" => figures.peak_reaction,
        "final.displacement" => figures.end.displacement,
        "final.speed" => figures.end.speed,
        "pair.separations" => pair?.separations as f64,
        "pair.closures" => pair?.closures as f64,
        "pair.separated_time" => pair?.separated_time,
        "pair.longest_separation" => pair?.longest_separation,
        "pair.max_lift" => pair?.max_lift,
        "pair.max_approach_speed" => pair?.max_approach_speed,
        "pair.max_contact_force" => pair?.max_contact_force,
        "pair.impacts.count" => pair?.impacts?.count as f64,
        "pair.impacts.max_impulse" => pair?.impacts?.max_impulse,
        "pair.impacts.loss" => pair?.impacts?.loss,
        "stop.impacts.count" => stop?.impacts?.count as f64,
        "stop.impacts.max_impulse" => stop?.impacts?.max_impulse,
        "stop.impacts.loss" => stop?.impacts?.loss,
        "pressing.max_pressure" => figures.pressing?.max_pressure,
        "pressing.time" => figures.pressing?.time,
        "stop.closures" => stop?.closures as f64,
        "stop.contact_time" => stop?.contact_time,
        "stop.max_approach_speed" => stop?.max_approach_speed,
        "stop.max_contact_force" => stop?.max_contact_force,
        "stop.max_indentation" => stop?.max_indentation,
        _ => return None,
    })
}

/// The object of a figure (index in the model), if it is elastic, with what a run has to
/// find for the figure and its scale (extremes of δ in any case). `None` where a run has
/// to find everything: for other figures, or with rigid pairs, whose margins a mechanism
/// is judged by.
pub(super) fn figure_of_object(figure: &str, model: &Model) -> Option<(usize, RequestedFigures)> {
    let (object, name) = object_and_figure(figure, model)?;
    let margins = |part: &ObjectPart| {
        let pair = part.rigid_pair;
        pair.is_some_and(|pair| pair.closure == Closure::Force)
    };
    if model.objects[object].links.is_empty() || model.objects.iter().any(margins) {
        return None;
    }
    if name == "peak_reaction" && model.objects[object].driven_end.is_some() {
        return None;
    }
    let known = ObjectFigures {
        pair: Some(Default::default()),
        ..ObjectFigures::default()
    };
    of_object(&known, name)?;
    let mut asked = RequestedFigures::DEVIATION;
    match name {
        "sigma" => asked.mean = true,
        "peak_speed" | "final.speed" => asked.speed = true,
        "peak_acceleration" => asked.acceleration = true,
        "peak_reaction" | "pair.max_contact_force" => asked.force = true,
        "pair.max_lift" => asked.lift = true,
        _ => {}
    }
    Some((object, asked))
}

/// Object (index in the model) and name of a figure.
fn object_and_figure<'f>(figure: &'f str, model: &Model) -> Option<(usize, &'f str)> {
    let (id, name) = owner_of(figure, |id| model.objects.iter().any(|part| part.id == id));
    let object = model.objects.iter().position(|part| part.id == id)?;
    Some((object, name))
}

/// What a difference in a figure is measured against: see [`Figures::scale`].
pub(super) fn scale_of_figure(
    figure: &str,
    model: &Model,
    settings: &RunSettings,
    found: &Motion,
) -> f64 {
    let own = object_and_figure(figure, model);
    let own = own.and_then(|(object, name)| {
        scale_of_object(&found.recorded.figures[object], name, found.outcome.time)
    });
    own.unwrap_or_else(|| run_figures(model, settings, found).scale(figure))
}

/// The same of a figure that [`of_object`] knows; `time` is that of the run (s).
fn scale_of_object(figures: &ObjectFigures, name: &str, time: f64) -> Option<f64> {
    let own = of_object(figures, name)?;
    let delta = figures.delta_abs;
    Some(match name {
        "delta_abs" | "delta_max" | "delta_min" | "sigma" | "pair.max_lift" => delta,
        "final.displacement" if delta > 0.0 => delta,
        "final.speed" => figures.peak_speed,
        "pair.separations" | "pair.closures" => 1.0,
        "pair.separated_time" | "pair.longest_separation" => time,
        _ => own.abs(),
    })
}

/// The value of a figure; `None` when it has none in this run.
pub(super) fn read(
    figure: &str,
    model: &Model,
    settings: &RunSettings,
    found: &Motion,
) -> Option<f64> {
    let own = object_and_figure(figure, model);
    let own = own.and_then(|(object, name)| of_object(&found.recorded.figures[object], name));
    // (Most figures need no document to be read.)
    own.or_else(|| run_figures(model, settings, found).value(figure).ok())
}

/// The document of a run.
fn run_figures(model: &Model, settings: &RunSettings, found: &Motion) -> Figures {
    let (outcome, recorded) = (&found.outcome, &found.recorded);
    let window = found.window.clone();
    let run = summary(settings, outcome, &found.choice, recorded, window);
    document(model, settings, &recorded.figures, run, &[])
}

/// SI unit of a figure; empty for counts and answers.
pub(in crate::studies) fn unit(figure: &str, model: &Model) -> String {
    match lookup::is_address(figure) {
        true => lookup::unit(figure, model),
        false => blank(model).unit(figure),
    }
}

#[cfg(test)]
mod tests {
    use super::{of_object, scale_of_object};
    use crate::dynamics::record::{FinalState, PairFigures};
    use crate::studies::testing::result_with;

    #[test]
    fn figures_read_without_a_document_are_those_of_the_document() {
        let figures = result_with(|rocker| {
            rocker.delta_abs = 2.0;
            rocker.delta_max = 1.0;
            rocker.delta_min = -2.0;
            rocker.sigma = 3.0;
            rocker.peak_speed = 4.0;
            rocker.peak_acceleration = 5.0;
            rocker.peak_reaction = 6.0;
            rocker.end = FinalState {
                displacement: 7.0,
                speed: 8.0,
            };
            rocker.pair = Some(PairFigures {
                separations: 9,
                closures: 10,
                separated_time: 11.0,
                longest_separation: 12.0,
                max_lift: 13.0,
                max_approach_speed: 14.0,
                max_contact_force: 15.0,
                ..PairFigures::default()
            });
        })
        .figures;
        let rocker = &figures.objects["rocker"];
        let mut known = 0;
        for (address, value) in figures.addresses() {
            let name = address.split_once('.').unwrap().1;
            let Some(own) = of_object(rocker, name).filter(|_| address.starts_with("rocker"))
            else {
                continue;
            };
            known += 1;
            assert_eq!(Some(own), value, "{address}");
            let scale = scale_of_object(rocker, name, figures.run.time);
            assert_eq!(scale, Some(figures.scale(&address)), "{address}");
        }
        assert_eq!(known, 16);
    }
}
