//! Figures within a part of the motion: `rocker.delta_max from 30 deg to 120 deg`.
//!
//! Those of a run are found in the run itself (`dynamics::record::spans`), those of kinematics and
//! forces by the same study over that range of the input.

use super::document::blank;
use super::expectations::did_you_mean;
use super::kinematics::{KinematicsRequest, Over, Subject, several_of};
use super::studied::{self, forces_over, kinematics_over, question};
use crate::dynamics::model::{Coordinate, Model, Span, SpanAxis, owner_of};
use crate::dynamics::record::{AddressError, span_figures};
use crate::fault::Fault;
use crate::frontend::scene::{SpanAddress, StudyAddress};

fn fault(message: impl Into<String>, hint: impl Into<String>) -> Fault {
    Fault::new("", message.into(), hint.into())
}

/// SI unit of a figure within a span.
pub(super) fn unit(within: SpanAddress<'_>, model: &Model) -> String {
    match StudyAddress::of(within.figure) {
        Some(_) => studied::unit(within.figure, model).unwrap_or_default(),
        None => blank(model).unit(within.figure),
    }
}

/// Whether a model has a figure within a span.
///
/// # Errors
/// There is no such figure, or none within a span; no such span.
pub(super) fn check(within: SpanAddress<'_>, model: &Model) -> Result<(), Fault> {
    let span = within.span();
    let span = span.map_err(|(message, hint)| fault(message, hint))?;
    let axis = model.axis_of(&span);
    axis.map_err(|(message, hint)| fault(message, hint))?;
    let Some(study) = StudyAddress::of(within.figure) else {
        return check_of_run(within.figure, model);
    };
    let Some((_, object, name)) = study.of_course() else {
        return Err(not_within(
            within.figure,
            "results of the run, of kinematics and of forces have one",
        ));
    };
    if let Some((message, hint)) = studied::unknown(within.figure, model) {
        return Err(fault(message, hint));
    }
    let end = name.rsplit('.').next().unwrap_or_default();
    let is_end = ["least", "greatest", "least_at", "greatest_at"].contains(&end);
    if !is_end || name.starts_with("transmission_angles") {
        return Err(not_within(
            within.figure,
            "the columns have `least` and `greatest`",
        ));
    }
    let over = range_of(model, object, &span);
    over.map(drop).map_err(|why| fault(why, ""))
}

fn not_within(figure: &str, hint: &str) -> Fault {
    let message = format!(
        "`{figure}` is no greatest or least value of a motion: it has none over a part of it"
    );
    fault(message, hint)
}

fn check_of_run(figure: &str, model: &Model) -> Result<(), Fault> {
    if let Err(AddressError::Unknown { close }) = blank(model).value(figure) {
        let message = format!("there is no result `{figure}`");
        return Err(fault(message, did_you_mean(&close)));
    }
    let known = |id: &str| model.objects.iter().any(|part| part.id == id);
    let (owner, name) = owner_of(figure, known);
    match known(owner) && span_figures().any(|one| one == name) {
        true => Ok(()),
        false => {
            let names: Vec<&str> = span_figures().collect();
            let hint = format!(
                "over a part of the motion an object has {}",
                names.join(", ")
            );
            Err(not_within(figure, &hint))
        }
    }
}

/// A ratio is a whole number but for this rounding.
const WHOLE: f64 = 1e-9;

/// The range of the input that is a span.
fn range_of(model: &Model, object: &str, span: &Span) -> Result<Over, String> {
    if several_of(model, Some(object)).is_some() {
        return Err(format!(
            "`{object}` has several inputs: its figures are those of the whole course"
        ));
    }
    let SpanAxis::Displacement { of, .. } = &span.axis else {
        return Err(format!(
            "figures of `{object}` are over its input and not over time: give angles of the drive"
        ));
    };
    let asked = KinematicsRequest::new(model, &question(object, 1.0))?;
    if matches!(asked.over, Over::Time { .. }) {
        return Err(format!(
            "the input of `{object}` does not move uniformly: its figures are over the whole time"
        ));
    }
    let subject = Subject::of(model, Some(object))?;
    let node = subject.input_node();
    let axis = model.axis_of(span).map_err(|(message, _)| message)?;
    let source = axis.and_then(|part| model.objects[part].nodes.last().copied());
    let line = match of {
        Some(id) if id == object => Some([1.0, 0.0]),
        _ => source.and_then(|source| model.constant_ratio(node, source)),
    };
    let Some([ratio, offset]) = line else {
        return Err(format!(
            "the input of `{object}` does not follow this displacement at a constant ratio: give \
             its own, with `of {object}`"
        ));
    };
    // Angles count in every turn: the linkage must be where it was after each.
    let turns = matches!(
        span.axis,
        SpanAxis::Displacement {
            coordinate: Coordinate::Turning,
            ..
        }
    );
    let whole = subject.input == Coordinate::Turning && (ratio - ratio.round()).abs() < WHOLE;
    if turns && !whole {
        return Err(format!(
            "`{object}` is not where it was after each turn: its input goes on by {ratio} of a turn. \
             Give angles of its own, with `of {object}`"
        ));
    }
    let ends = [ratio * span.from + offset, ratio * span.to + offset];
    Ok(Over::Range {
        from: ends[0].min(ends[1]),
        to: ends[0].max(ends[1]),
    })
}

/// A figure of kinematics or forces within a span; `None`: it has no value there.
///
/// # Errors
/// Why there is none, in words.
pub(super) fn of_course(
    model: &Model,
    within: SpanAddress<'_>,
    duration: f64,
) -> Result<Option<f64>, String> {
    let study = StudyAddress::of(within.figure).and_then(StudyAddress::of_course);
    let Some((study, object, name)) = study else {
        return Ok(None);
    };
    let span = within.span().map_err(|(message, _)| message)?;
    let over = Some(range_of(model, object, &span)?);
    Ok(match study {
        "kinematics" => kinematics_over(model, object, duration, over)?.figure(name),
        _ => forces_over(model, object, duration, over)?.figure(name),
    })
}
