//! Derivatives of results by numbers of a scene.

use super::Mechanism;
use crate::Error;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::read::{did_you_mean, synonyms};
use crate::frontend::scene::Number;
use crate::studies::Control;
use crate::studies::axis::Axis;
use crate::studies::condition::Condition;
use crate::studies::gradient::{
    DEFAULT_FIGURES, Gradient, Parameter, Place, Subject, gradient as find_gradient, names,
};
use serde_json::Value;

/// What is differentiated, and by what.
#[derive(Clone, Debug, Default)]
pub struct GradientQuestion {
    /// Addresses of numbers of the scene: `rocker.inertia`, `rocker.loads.closing.constant`.
    pub by: Vec<String>,
    /// Addresses of results of the run: `rocker.delta_max`. Empty: those of every elastic object
    /// that are asked for most.
    pub figures: Vec<String>,
    /// Whether derivatives are compared with differences of runs. `None`: they are, up to five
    /// parameters and a thousand events.
    pub check: Option<bool>,
}

/// Makes the scene ready with further settings.
type Prepare<'p> = dyn Fn(&[String]) -> Result<Mechanism, Error> + 'p;

/// Finds the derivatives. `prepare`: the scene with further settings made ready; `numbers`: the
/// numbers of its text.
///
/// # Errors
/// As of [`Scene::gradient`](super::Scene::gradient).
pub(crate) fn gradient(
    question: &GradientQuestion,
    prepare: &Prepare<'_>,
    numbers: &[Number],
    control: &Control<'_>,
) -> Result<Gradient, Error> {
    let base = prepare(&[])?;
    let (mut wrong, mut parameters) = (Vec::new(), Vec::new());
    if question.by.is_empty() {
        let message = "no parameter is named";
        let hint = "name numbers of the scene: --by rocker.inertia,rocker.stiffness";
        wrong.push(Diagnostic::error("question", message).hint(hint));
    }
    for path in &question.by {
        match parameter(path, &base, prepare, numbers) {
            Ok(found)
                if parameters
                    .iter()
                    .any(|one: &Parameter| one.path == found.path) =>
            {
                wrong.push(Diagnostic::error(
                    "question",
                    format!("--by names `{path}` twice"),
                ));
            }
            Ok(found) => parameters.push(found),
            Err(mut faults) => wrong.append(&mut faults),
        }
    }
    let figures = match question.figures.is_empty() {
        true => default_figures(base.model()),
        false => named_figures(&question.figures, base.model(), &mut wrong),
    };
    if !wrong.is_empty() {
        return Err(Diagnostics::new(Sources::default(), wrong).into());
    }
    let axes: Vec<Axis> = (parameters.iter())
        .map(|one| Axis::linear(&one.path, 0.0, 1.0, 2))
        .collect();
    let at = |values: &[f64]| {
        let settings = axes.iter().zip(values).zip(&parameters);
        let changed = settings.filter(|((_, value), one)| **value != one.value);
        let settings: Vec<String> = changed
            .map(|((axis, value), _)| axis.setting(*value))
            .collect();
        prepare(&settings).ok().map(place)
    };
    let diagnose = base.reading.places.clone();
    let subject = Subject {
        parameters: parameters.clone(),
        figures,
        base: place(base),
        at: &at,
        control,
        check: question.check,
    };
    find_gradient(&subject).map_err(|faults| diagnose.diagnose(&faults).into())
}

fn place(ready: Mechanism) -> Place {
    Place {
        system: ready.system,
        settings: ready.settings,
    }
}

/// A number of the scene by its address.
fn parameter(
    path: &str,
    base: &Mechanism,
    prepare: &Prepare<'_>,
    numbers: &[Number],
) -> Result<Parameter, Vec<Diagnostic>> {
    let fault = |message: String, hint: String| {
        vec![Diagnostic::error("question", message).path(path).hint(hint)]
    };
    let compare = || format!("compare its values: dam compare --over {path}=…");
    let canonical = &base.reading.canonical;
    let written = numbers.iter().find(|one| one.address == path);
    let known = value_at(canonical, path);
    let value = match known {
        Some(Value::Number(number)) => number.as_f64(),
        Some(_) => {
            let message = format!("`{path}` is no number, and nothing has a derivative by it");
            return Err(fault(message, compare()));
        }
        None => written.and_then(|one| Some(one.value * one.factor?)),
    };
    let Some(value) = value.filter(|value| value.is_finite()) else {
        // What is wrong with the address is said by a setting of it.
        return Err(match prepare(&[format!("{path}=1")]) {
            Err(error) => at_address(error, path),
            Ok(_) => fault(
                format!("`{path}` has no value in this scene"),
                format!("write one into the scene, or give it: --set {path}=…"),
            ),
        });
    };
    let axis = Axis::linear(path, 0.0, 1.0, 2);
    let counts = |error: Error| error.faults().iter().any(Diagnostic::is_of_a_count);
    let between = prepare(&[axis.setting(value + 0.5)]);
    if written.is_some_and(|one| one.whole) || between.is_err_and(counts) {
        let message = format!("`{path}` counts, and nothing has a derivative by it");
        return Err(fault(message, compare()));
    }
    let unit = written.map_or_else(|| axis.display_unit(base.model()), |one| one.si.to_owned());
    Ok(Parameter {
        path: path.to_owned(),
        value,
        unit,
    })
}

/// Faults of a setting as those of its address.
fn at_address(error: Error, path: &str) -> Vec<Diagnostic> {
    let items = error.into_diagnostics().items.into_iter();
    let told = |fault: Diagnostic| {
        let own = Diagnostic::error(fault.code, fault.message).path(path);
        let hints = fault.hints.into_iter();
        hints.fold(own, |own, hint| own.hint(hint))
    };
    items.map(told).collect()
}

/// What stands at an address of the canonical scene.
fn value_at<'v>(canonical: &'v Value, path: &str) -> Option<&'v Value> {
    let first = path.split(['.', '[']).next().unwrap_or(path);
    let start = match canonical["objects"].get(first) {
        Some(_) => &canonical["objects"],
        None => canonical,
    };
    let parts = path
        .split(['.', '['])
        .map(|part| part.trim_end_matches(']'));
    parts.into_iter().try_fold(start, |here, part| match here {
        Value::Array(items) => items.get(part.parse::<usize>().ok()?),
        other => other
            .get(part)
            .or_else(|| synonyms(part).find_map(|name| other.get(name))),
    })
}

/// The results of every elastic object that are asked for most.
pub(super) fn default_figures(model: &Model) -> Vec<(String, String)> {
    let elastic = model.objects.iter().filter(|part| !part.links.is_empty());
    let mut all = Vec::new();
    for part in elastic {
        let names = DEFAULT_FIGURES.map(|name| format!("{}.{name}", part.id));
        all.extend(names.into_iter().filter_map(|name| {
            let unit = Condition::unit_of(&name, model).ok()?;
            Some((name, unit))
        }));
    }
    all
}

/// The results that are named, with their units; what is wrong with them.
fn named_figures(
    figures: &[String],
    model: &Model,
    wrong: &mut Vec<Diagnostic>,
) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for figure in figures {
        match figure_unit(figure, model) {
            Ok(unit) => found.push((figure.clone(), unit)),
            Err(fault) => wrong.push(*fault),
        }
    }
    found
}

/// The unit of a result; a fault where there is none of this name that has derivatives.
pub(super) fn figure_unit(figure: &str, model: &Model) -> Result<String, Box<Diagnostic>> {
    let elastic = model.objects.iter().filter(|part| !part.links.is_empty());
    let ids: Vec<&str> = elastic.map(|part| part.id.as_str()).collect();
    let own = ids.iter().find(|id| {
        figure
            .strip_prefix(**id)
            .is_some_and(|rest| rest.starts_with('.'))
    });
    // The least contact force is a result of every pair here, elastic objects included.
    if let Some(id) = own
        && figure == format!("{id}.pair.margin")
    {
        let force = format!("{id}.pair.max_contact_force");
        if let Ok(unit) = Condition::unit_of(&force, model) {
            return Ok(unit);
        }
    }
    let error = |message: String| Diagnostic::error("question", message).path(figure);
    let unit = Condition::unit_of(figure, model).map_err(|what| {
        let all = ids
            .iter()
            .flat_map(|id| names().iter().map(move |name| format!("{id}.{name}")));
        let all: Vec<String> = all.collect();
        Box::new(match what.contains("did you mean") {
            true => error(what),
            false => error(what).maybe_hint(did_you_mean(figure, all.iter().map(String::as_str))),
        })
    })?;
    match own {
        Some(_) => Ok(unit),
        None => {
            let message = format!("`{figure}` is no result of an elastic object of this scene");
            let hint = match ids.as_slice() {
                [] => "derivatives are those of elastic objects, and there is none".to_owned(),
                [first, ..] => format!("name one of an elastic object: {first}.delta_max"),
            };
            Err(Box::new(error(message).hint(hint)))
        }
    }
}
