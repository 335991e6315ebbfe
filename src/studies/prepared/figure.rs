//! The figures of a point: what a run has to find for them, and where they are read.

use crate::dynamics::model::{Closure, Model, ObjectPart, SpanFigure, owner_of};
use crate::dynamics::record::{AddressError, Figures, ObjectFigures};
use crate::exact::RequestedFigures;
use crate::fault::Fault;
use crate::studies::document::{blank, document, summary};
use crate::studies::expectations::suggest_instead;
use crate::studies::run::Motion;
use crate::studies::{RunSettings, lookup};
use std::cell::OnceCell;

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

/// What a run has to find of each object for some figures and their scales, by the index of
/// the object (extremes of δ in any case). `None` where it has to find everything: for other
/// figures than those of elastic objects, or with rigid pairs, whose margins a mechanism is
/// judged by.
pub(super) fn requested(figures: &[String], model: &Model) -> Option<Vec<RequestedFigures>> {
    let mut all = vec![RequestedFigures::DEVIATION; model.objects.len()];
    for figure in figures {
        let (object, asked) = figure_of_object(figure, model)?;
        all[object] = all[object].union(asked);
    }
    Some(all)
}

/// The object of a figure (index in the model) with what a run has to find for it; `None`
/// where it has to find everything.
fn figure_of_object(figure: &str, model: &Model) -> Option<(usize, RequestedFigures)> {
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

/// The figures that a run found. Most are read without its document, which is made once.
pub(super) struct FoundFigures<'f> {
    model: &'f Model,
    settings: &'f RunSettings,
    found: &'f Motion,
    document: OnceCell<Figures>,
}

impl<'f> FoundFigures<'f> {
    pub(super) fn new(model: &'f Model, settings: &'f RunSettings, found: &'f Motion) -> Self {
        Self {
            model,
            settings,
            found,
            document: OnceCell::new(),
        }
    }

    /// The value of a figure; `None` when it has none in this run.
    pub(super) fn value(&self, figure: &str) -> Option<f64> {
        let own = object_and_figure(figure, self.model);
        let objects = &self.found.recorded.figures;
        let own = own.and_then(|(object, name)| of_object(&objects[object], name));
        own.or_else(|| self.document().value(figure).ok())
    }

    /// The value of a figure within a part of the motion that the run was asked for.
    pub(super) fn value_within(&self, span: &SpanFigure) -> Option<f64> {
        let extreme = self.found.recorded.spans.get(&span.address)?.as_ref()?;
        self.value(&span.figure).map(|_| extreme.value)
    }

    /// What a difference in a figure is measured against: see [`Figures::scale`].
    pub(super) fn scale(&self, figure: &str) -> f64 {
        let own = object_and_figure(figure, self.model).and_then(|(object, name)| {
            let found = self.found;
            scale_of_object(&found.recorded.figures[object], name, found.outcome.time)
        });
        own.unwrap_or_else(|| self.document().scale(figure))
    }

    /// The document of the run.
    fn document(&self) -> &Figures {
        self.document.get_or_init(|| {
            let (outcome, recorded) = (&self.found.outcome, &self.found.recorded);
            let window = self.found.window.clone();
            let run = summary(self.settings, outcome, &self.found.choice, recorded, window);
            document(self.model, self.settings, &recorded.figures, run, &[])
        })
    }
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
